#include "bench/subjects/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/subjects/reference_sample.hpp"

namespace simdbezier_bench {
namespace {

constexpr std::size_t kCheckedPatches = 64;
constexpr std::size_t kCheckedSamples = 4000;

enum Quantity { kPosition, kNormal, kTangent, kSecond };

/// What is allowed, in units of roundoff of scale_of().
// On 4000 patches, de Casteljau needed at most 8, 25, 6, 4, the library no more, and the power
// basis 19, 84, 20, 12.
constexpr double kUnits[] = {100, 500, 100, 100};
/// What is allowed of curvatures, in units of roundoff of one plus the largest principal curvature
/// there.
constexpr double kCurvatureUnits = 1000;

/// How large a quantity may be where no coordinate exceeds `size`, and what its error is relative
/// to: a derivative multiplies by the degree, and by the ratio of the weights, which is up to 4.
double scale_of(Quantity quantity, BatchShape shape, double size) {
  const double degree = std::max(shape.degree_u, shape.degree_v);
  const double ratio = shape.rational ? 4 : 1;
  switch (quantity) {
  case kPosition:
    return size;
  case kNormal:
    return ratio;
  case kTangent:
    return ratio * degree * size;
  case kSecond:
    break;
  }
  return ratio * ratio * std::max(degree * (degree - 1), 1.0) * size;
}

/// Returns the k-th of the checked patches.
std::size_t checked_patch(std::size_t k, std::size_t patches) {
  const std::size_t checked = std::min(patches, kCheckedPatches);
  return checked == 1 ? 0 : k * (patches - 1) / (checked - 1);
}

struct Expected {
  const double* value;
  Quantity quantity;
  const char* name;
};

Expected expected(const Sample& sample, OutputGroups groups, std::size_t group) {
  if (groups == OutputGroups::position_normal && group == 1) {
    return {sample.normal, kNormal, "normal"};
  }
  const Expected all[kMostGroups] = {{sample.position, kPosition, "position"},
                                     {sample.du, kTangent, "du"},
                                     {sample.dv, kTangent, "dv"},
                                     {sample.duu, kSecond, "duu"},
                                     {sample.duv, kSecond, "duv"},
                                     {sample.dvv, kSecond, "dvv"}};
  return all[group];
}

std::string message(const char* what, std::size_t patch, std::size_t sample, double expected,
                    double found) {
  char line[160];
  std::snprintf(line, sizeof line, "wrong %s: patch %zu sample %zu: expected %.9g, found %.9g",
                what, patch, sample, expected, found);
  return line;
}

template <typename T>
double largest_coordinate(const T* net, BatchShape shape) {
  const std::size_t per_point = values_per_point(shape);
  double size = 0;
  for (std::size_t k = 0; k < values_per_patch(shape); ++k) {
    if (k % per_point < 3) {
      size = std::max(size, std::abs(static_cast<double>(net[k])));
    }
  }
  return size;
}

/// Compares principal curvatures by their sum and product, because they themselves have only half
/// of the digits where they are nearly equal.
template <typename T>
std::string check_curvatures(const Results<T>& results, std::size_t index, const Sample& reference,
                             std::size_t patch, std::size_t sample) {
  const double roundoff = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  const auto plane = [&](std::size_t k) {
    return static_cast<double>(results.component[3 + k][index * results.stride]);
  };
  const double largest = std::abs(reference.mean) +
                         std::sqrt(std::abs(reference.mean * reference.mean - reference.gaussian));
  const double most = kCurvatureUnits * roundoff * (1 + largest);
  const struct {
    const char* name;
    double found;
    double expected;
    double most;
  } checks[] = {
      {"Gaussian curvature", plane(0), reference.gaussian, most * (1 + largest)},
      {"mean curvature", plane(1), reference.mean, most},
      {"mean of the principal curvatures", (plane(2) + plane(3)) / 2, reference.mean, most},
      {"product of the principal curvatures", plane(2) * plane(3), reference.gaussian,
       most * (1 + largest)},
      {"order of the principal curvatures", std::min(plane(3) - plane(2), 0.0), 0, 0},
  };
  for (const auto& check : checks) {
    if (!(std::abs(check.found - check.expected) <= check.most)) {
      return message(check.name, patch, sample, check.expected, check.found);
    }
  }
  return {};
}

} // namespace

template <typename T>
std::string check_sample(const Results<T>& results, std::size_t index, const T* net, double u,
                         double v, std::size_t patch, std::size_t sample, BatchShape shape) {
  const double roundoff = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  const double size = largest_coordinate(net, shape);
  const Sample reference = reference_sample(net, shape, u, v);
  for (std::size_t group = 0; group < group_count(results.groups); ++group) {
    const Expected want = expected(reference, results.groups, group);
    const double most = kUnits[want.quantity] * roundoff * scale_of(want.quantity, shape, size);
    for (std::size_t c = 0; c < 3; ++c) {
      const double got =
          static_cast<double>(results.component[3 * group + c][index * results.stride]);
      if (!(std::abs(got - want.value[c]) <= most)) {
        return message(want.name, patch, sample, want.value[c], got);
      }
    }
  }
  if (results.groups == OutputGroups::curvature) {
    return check_curvatures(results, index, reference, patch, sample);
  }
  return {};
}

template <typename T>
void poison(const Results<T>& results, std::size_t first, std::size_t last) {
  for (std::size_t k = 0; k < value_count(results.groups); ++k) {
    for (std::size_t sample = first; sample < last; ++sample) {
      results.component[k][sample * results.stride] = std::numeric_limits<T>::quiet_NaN();
    }
  }
}

bool is_checked(std::size_t patch, std::size_t patches) {
  if (patches <= kCheckedPatches) {
    return true;
  }
  // The first k whose patch is not before this one.
  const std::size_t k = (patch * (kCheckedPatches - 1) + patches - 2) / (patches - 1);
  return checked_patch(k, patches) == patch;
}

template <typename T>
void poison_grid(const GridJob<T>& job) {
  const std::size_t samples = job.nu * job.nv;
  for (std::size_t k = 0; k < std::min(job.patches, kCheckedPatches); ++k) {
    const std::size_t patch = checked_patch(k, job.patches);
    poison(job.out, patch * samples, (patch + 1) * samples);
  }
}

template <typename T>
std::string check_grid(const GridJob<T>& job, const T* nets) {
  std::string failure;
  const std::size_t samples = job.nu * job.nv;
  for (std::size_t k = 0; k < std::min(job.patches, kCheckedPatches); ++k) {
    const std::size_t patch = checked_patch(k, job.patches);
    for (std::size_t sample = 0; sample < samples && failure.empty(); ++sample) {
      failure = check_sample(job.out, patch * samples + sample,
                             nets + values_per_patch(job.shape) * patch,
                             static_cast<double>(sample % job.nu) / static_cast<double>(job.nu - 1),
                             static_cast<double>(sample / job.nu) / static_cast<double>(job.nv - 1),
                             patch, sample, job.shape);
    }
  }
  return failure;
}

template <typename T>
void poison_scattered(const ScatteredJob<T>& job) {
  poison(job.out, 0, job.count);
}

template <typename T>
std::string check_scattered(const ScatteredJob<T>& job, const T* nets) {
  std::string failure;
  const std::size_t step = std::max<std::size_t>(1, job.count / kCheckedSamples) | 1;
  for (std::size_t k = 0; k < job.count && failure.empty(); k += step) {
    failure =
        check_sample(job.out, k, nets + std::size_t{48} * job.patch[k],
                     static_cast<double>(job.u[k]), static_cast<double>(job.v[k]), job.patch[k], k);
  }
  return failure;
}

#define SIMDBEZIER_BENCH_INSTANTIATE(T)                                                            \
  template std::string check_sample<T>(const Results<T>&, std::size_t, const T*, double, double,   \
                                       std::size_t, std::size_t, BatchShape);                      \
  template void poison<T>(const Results<T>&, std::size_t, std::size_t);                            \
  template void poison_grid<T>(const GridJob<T>&);                                                 \
  template std::string check_grid<T>(const GridJob<T>&, const T*);                                 \
  template void poison_scattered<T>(const ScatteredJob<T>&);                                       \
  template std::string check_scattered<T>(const ScatteredJob<T>&, const T*);
SIMDBEZIER_BENCH_INSTANTIATE(float)
SIMDBEZIER_BENCH_INSTANTIATE(double)
#undef SIMDBEZIER_BENCH_INSTANTIATE

} // namespace simdbezier_bench
