// Samples that are read and results that are written as comma-separated values.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <simdbezier/outputs.hpp>
#include <tools/formats/input/text_input.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

/// One sample as its line gives it. u and v may be centred, which the header tells.
struct CsvSample {
  std::uint32_t patch = 0;
  double u = 0;
  double v = 0;
};

/// Reads a file line by line. Its header is patch,u,v or patch,x,y, or patch,centred_u,centred_v,
/// which is what results have in place of patch,x,y. Throws Failure with file and line on anything
/// else.
class SampleReader {
public:
  /// Patch numbers must be below `patches`.
  SampleReader(const std::string& path, std::size_t patches);

  [[nodiscard]] bool centred() const noexcept { return centred_; }
  /// Returns the next sample, or nothing at the end.
  [[nodiscard]] std::optional<CsvSample> next();
  /// Throws the Failure for a parameter of the last sample that the chosen precision cannot hold.
  [[noreturn]] void refuse(double parameter, const std::string& precision) const;

private:
  bool next_line();
  [[nodiscard]] double parameter(std::string_view field) const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

  TextInput input_;
  std::string line_;
  std::size_t patches_;
  bool centred_ = false;
};

/// How many outputs have columns: those before the status.
inline constexpr auto kColumnOutputs = static_cast<std::size_t>(Output::status);

/// Returns "position, du, … curvature", in the order of their columns.
[[nodiscard]] std::string output_names();
/// Counts the columns: vectors have three, and the curvatures of a sample have four.
[[nodiscard]] std::size_t column_count(std::span<const Output> outputs);

/// Returns the line that names the columns, with its end.
[[nodiscard]] std::string result_header(bool centred, std::span<const Output> outputs);

/// Writes one line a sample, with numbers that read back to the same bits.
class ResultWriter {
public:
  explicit ResultWriter(OutputFile& file) : file_(file) {}

  template <typename T>
  void line(const CsvSample& sample, std::span<const T> values) {
    file_.number(sample.patch);
    separated(sample.u);
    separated(sample.v);
    for (const T value : values) {
      separated(value);
    }
    file_.character('\n');
  }

private:
  template <typename T>
  void separated(T value) {
    file_.character(',');
    if (std::isnan(value)) {
      file_.text("nan"); // without its sign, which depends on the machine
    } else {
      file_.number(value);
    }
  }

  OutputFile& file_;
};

} // namespace simdbezier::tools
