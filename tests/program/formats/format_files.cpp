#include "tests/program/formats/format_files.hpp"

#include <gtest/gtest.h>

#include <tools/process/failure.hpp>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

std::vector<WeightedPoint> patch_points(const tools::PatchFile& file, std::size_t patch) {
  std::vector<WeightedPoint> points;
  const tools::PatchNets<double> all = file.nets<double>();
  for (const ControlNets<double>& nets : all.nets) {
    if (patch >= nets.count) {
      patch -= nets.count;
      continue;
    }
    for (int j = 0; j <= nets.degree_v; ++j) {
      for (int i = 0; i <= nets.degree_u; ++i) {
        const double* const p = nets.points +
                                static_cast<std::ptrdiff_t>(patch) * nets.patch_stride +
                                j * nets.row_stride + i * nets.point_stride;
        const double weight = nets.weights == Weights::none ? 1 : p[3];
        const double divisor = nets.weights == Weights::homogeneous ? weight : 1;
        points.push_back({p[0] / divisor, p[1] / divisor, p[2] / divisor, weight});
      }
    }
    break;
  }
  return points;
}

std::vector<WeightedPoint> expected_points(const ExpectedPatch& patch) {
  std::vector<WeightedPoint> points;
  for (int j = 0; j <= patch.degree_v; ++j) {
    for (int i = 0; i <= patch.degree_u; ++i) {
      points.push_back(patch.point(i, j));
      points.back().w = patch.rational ? points.back().w : 1;
    }
  }
  return points;
}

tools::PatchFile read_text(const std::string& format, const std::string& text) {
  const TemporaryFolder folder;
  return tools::read_patches(folder.write("in." + format, text), tools::PatchFormat::by_name);
}

std::string refusal(const std::string& format, const std::string& text) {
  try {
    static_cast<void>(read_text(format, text));
    return {};
  } catch (const tools::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), 1);
    const std::string message = failure.what();
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const std::string end_of_name = "in." + format;
    const std::size_t at = message.find(end_of_name);
    EXPECT_NE(at, std::string::npos) << message;
    return message.substr(at + end_of_name.size());
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) {
    result += c == '\n' ? end : std::string(1, c);
  }
  return result;
}

} // namespace simdbezier::tests
