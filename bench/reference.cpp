#include "bench/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace simdbezier_bench {
namespace {

constexpr std::size_t kCheckedPatches = 64;

// In units of the type's roundoff, relative to max|P| or, for tangents, to three times that (a
// unit normal: to 1). Seen on 4000 patches: de Casteljau at most 8, 6, 25, the library no more, the
// power basis 19, 20, 84.
constexpr double kTolerance[3] = {100, 100, 500};
enum Quantity { kPosition, kTangent, kNormal };

struct Sample {
  double position[3] = {};
  double du[3] = {};
  double dv[3] = {};
  double normal[3] = {};
};

void bernstein(double t, double* value, double* slope) {
  const double s = 1 - t;
  value[0] = s * s * s;
  value[1] = 3 * s * s * t;
  value[2] = 3 * s * t * t;
  value[3] = t * t * t;
  slope[0] = -3 * s * s;
  slope[1] = 3 * s * (s - 2 * t);
  slope[2] = 3 * t * (2 * s - t);
  slope[3] = 3 * t * t;
}

template <typename T>
Sample evaluate(const T* net, double u, double v) {
  double bu[4], bu_slope[4], bv[4], bv_slope[4];
  bernstein(u, bu, bu_slope);
  bernstein(v, bv, bv_slope);
  Sample s;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c) {
        const double b = static_cast<double>(net[12 * j + 3 * i + c]);
        s.position[c] += b * bu[i] * bv[j];
        s.du[c] += b * bu_slope[i] * bv[j];
        s.dv[c] += b * bu[i] * bv_slope[j];
      }
    }
  }
  const double n[3] = {s.du[1] * s.dv[2] - s.du[2] * s.dv[1], s.du[2] * s.dv[0] - s.du[0] * s.dv[2],
                       s.du[0] * s.dv[1] - s.du[1] * s.dv[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int c = 0; c < 3; ++c) {
    s.normal[c] = n[c] / length;
  }
  return s;
}

/// Calls visit(patch) for the patches that are checked: all of a few, the ends of many included.
template <typename Visit>
void for_checked_patches(std::size_t patches, Visit visit) {
  const std::size_t checked = std::min(patches, kCheckedPatches);
  for (std::size_t k = 0; k < checked; ++k) {
    if (!visit(checked == 1 ? 0 : k * (patches - 1) / (checked - 1))) {
      return;
    }
  }
}

/// Component c of group g at one sample.
template <typename T>
T& element(const GridJob<T>& job, bool interleaved, std::size_t group, std::size_t c,
           std::size_t sample) {
  return interleaved ? job.planes[3 * group][3 * sample + c] : job.planes[3 * group + c][sample];
}

struct Expected {
  const double* value;
  Quantity quantity;
  const char* name;
};

Expected expected(const Sample& sample, OutputGroups groups, std::size_t group) {
  if (group == 0) {
    return {sample.position, kPosition, "position"};
  }
  if (groups == OutputGroups::position_normal) {
    return {sample.normal, kNormal, "normal"};
  }
  return group == 1 ? Expected{sample.du, kTangent, "du"} : Expected{sample.dv, kTangent, "dv"};
}

template <typename T>
std::string check_sample(const GridJob<T>& job, bool interleaved, const Sample& reference,
                         double scale, std::size_t patch, std::size_t within) {
  const double roundoff = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  for (std::size_t group = 0; group < group_count(job.groups); ++group) {
    const Expected want = expected(reference, job.groups, group);
    const double size = want.quantity == kNormal    ? 1
                        : want.quantity == kTangent ? 3 * scale
                                                    : scale;
    for (std::size_t c = 0; c < 3; ++c) {
      const double got =
          static_cast<double>(element(job, interleaved, group, c, patch * job.n * job.n + within));
      if (!(std::abs(got - want.value[c]) <= kTolerance[want.quantity] * roundoff * size)) {
        char line[160];
        std::snprintf(line, sizeof line,
                      "wrong %s: patch %zu sample %zu: expected %.9g, found %.9g", want.name, patch,
                      within, want.value[c], got);
        return line;
      }
    }
  }
  return {};
}

} // namespace

template <typename T>
void poison_grid(const GridJob<T>& job, bool interleaved) {
  const std::size_t samples = job.n * job.n;
  for_checked_patches(job.patches, [&](std::size_t patch) {
    for (std::size_t k = patch * samples; k < (patch + 1) * samples; ++k) {
      for (std::size_t group = 0; group < group_count(job.groups); ++group) {
        for (std::size_t c = 0; c < 3; ++c) {
          element(job, interleaved, group, c, k) = std::numeric_limits<T>::quiet_NaN();
        }
      }
    }
    return true;
  });
}

template <typename T>
std::string check_grid(const GridJob<T>& job, const T* nets, bool interleaved) {
  std::string failure;
  const double last = static_cast<double>(job.n - 1);
  for_checked_patches(job.patches, [&](std::size_t patch) {
    const T* net = nets + 48 * patch;
    double scale = 0;
    for (int k = 0; k < 48; ++k) {
      scale = std::max(scale, std::abs(static_cast<double>(net[k])));
    }
    for (std::size_t k = 0; k < job.n * job.n && failure.empty(); ++k) {
      const Sample reference = evaluate(net, static_cast<double>(k % job.n) / last,
                                        static_cast<double>(k / job.n) / last);
      failure = check_sample(job, interleaved, reference, scale, patch, k);
    }
    return failure.empty();
  });
  return failure;
}

template void poison_grid<float>(const GridJob<float>&, bool);
template void poison_grid<double>(const GridJob<double>&, bool);
template std::string check_grid<float>(const GridJob<float>&, const float*, bool);
template std::string check_grid<double>(const GridJob<double>&, const double*, bool);

} // namespace simdbezier_bench
