// The parameters of an IGES entity, one by one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <tools/formats/iges/records.hpp>

namespace simdbezier::tools {

/// Reads numbers, strings and pointers in free form, which may be left out and then are 0. Where it
/// refuses something, it throws a Failure that names the file and the line of the parameter.
class IgesParameters {
public:
  /// Begins behind the entity's type, which has to be that of its directory entry. Throws Failure
  /// where the parameters of entities have been read too often.
  IgesParameters(IgesRecords& records, std::size_t entity);

  /// Reads the next parameter, which has to be a finite number …
  double real(const char* what);
  /// … or a number that can be a weight: more than 0, …
  double weight();
  /// … or an integer within limits, …
  std::size_t integer(const std::string& what, std::size_t least, std::size_t most);
  /// … or the directory's number of an entity, which becomes its index; nothing where it is 0.
  std::optional<std::size_t> pointer(const char* what);
  /// … or anything.
  void skip(std::size_t count, const char* what);
  /// Reads what may stand behind an entity's own parameters, and has to be the last: pointers to
  /// associativities and notes, and pointers to properties, each behind their number.
  void finish();

  /// Returns whether there are more parameters.
  [[nodiscard]] bool more() const noexcept { return !ended_; }
  /// Returns whether the last one that was read is left out.
  [[nodiscard]] bool left_out() const noexcept { return text_.empty() && !is_string_; }
  /// Returns the line of the last one that was read.
  [[nodiscard]] std::size_t line() const noexcept;
  [[noreturn]] void fail(const std::string& expected) const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

private:
  void next(const std::string& what);

  IgesRecords& records_;
  std::size_t first_line_;
  std::string_view data_; // the columns of all lines that the entity has
  std::size_t next_ = 0;  // where the next parameter begins in it
  std::size_t begin_ = 0; // where this one does
  std::string_view text_;
  bool is_string_ = false;
  bool ended_ = false;
};

} // namespace simdbezier::tools
