// See limit_tally.hpp.
#include "tests/properties/limits/limit_tally.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include <gtest/gtest.h>

namespace simdbezier::tests {
namespace {

[[nodiscard]] const char* name_of(SampleStatus status) {
  switch (status) {
  case SampleStatus::regular:
    return "regular";
  case SampleStatus::limit:
    return "limit";
  case SampleStatus::degenerate:
    return "degenerate";
  default:
    return "non_finite";
  }
}

constexpr int kBucket = 8; ///< binary digits of kappa

} // namespace

void LimitTally::add(const LimitNet& net, const LimitSample& sample, const FoundDirection& found,
                     const char* call) {
  const Place at{&net, &sample, call};
  ++samples_[static_cast<std::size_t>(sample.status)];
  const double angle = degrees_apart(found.direction, sample.direction);
  if (found.status != sample.status) {
    ++wrong_[{sample.status, found.status}];
    ++wrong_kinds_[net.kind];
    fail(at, found, "status");
  } else if (sample.status == SampleStatus::regular) {
    add_regular(at, found, angle);
  } else {
    limit_ = std::max(limit_, angle);
    if (!(angle <= allowed_.limit)) {
      fail(at, found, "direction of a limit");
    }
  }
  if (found.nan_curvatures >= 0 && sample.status != SampleStatus::regular &&
      found.nan_curvatures != 4) {
    fail(at, found, "curvature that is not nan");
  }
}

void LimitTally::add_regular(const Place& at, const FoundDirection& found, double angle) {
  const double lightness = at.sample->lightness;
  const double kappa = std::clamp(at.sample->kappa * lightness, 1.0, 0x1p60);
  double& largest = regular_[std::ilogb(kappa) / kBucket * kBucket];
  largest = std::max(largest, angle);
  if (!(angle <= allowed_.regular_at(lightness))) {
    fail(at, found, "regular direction");
  }
}

void LimitTally::fail(const Place& at, const FoundDirection& found, const char* what) {
  auto& [count, first] = failures_[what];
  if (count++ > 0) {
    return;
  }
  std::ostringstream text;
  const auto add = [&](SampleStatus status, const Vector3& direction, const char* end) {
    text << name_of(status) << std::setprecision(17);
    for (const double value : direction) {
      text << ' ' << value;
    }
    text << end;
  };
  text << at.call << ": ";
  add(at.sample->status, at.sample->direction, " expected, ");
  add(found.status, found.direction, " found\n");
  first = text.str() + described(*at.net, *at.sample);
}

void LimitTally::report(const std::string& title) const {
  std::printf("%s: samples regular %zu, limit %zu, degenerate %zu\n  largest angle of limits %.3g "
              "degrees; of regular directions, by the magnification of errors:",
              title.c_str(), samples_[0], samples_[1], samples_[2], limit_);
  for (const auto& [bucket, angle] : regular_) {
    std::printf(" 2^%d %.3g", bucket, angle);
  }
  std::printf("\n");
  for (const auto& [pair, count] : wrong_) {
    std::printf("  %s expected, %s found: %zu\n", name_of(pair.first), name_of(pair.second), count);
  }
  for (const auto& [kind, count] : wrong_kinds_) {
    std::printf("    wrong statuses of %s: %zu\n", kind.c_str(), count);
  }
  for (const auto& [what, failure] : failures_) {
    ADD_FAILURE() << title << ", " << what << ": " << failure.first << " times, first by "
                  << failure.second;
  }
}

} // namespace simdbezier::tests
