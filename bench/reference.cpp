#include "bench/reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace simdbezier_bench {
namespace {

constexpr std::size_t kCheckedPatches = 64;
constexpr std::size_t kCheckedSamples = 4000;

enum Quantity { kPosition, kNormal, kTangent, kSecond };

struct Tolerance {
  double units; ///< of roundoff
  double scale; ///< what they are relative to, in units of max|P|; 0: absolutely
};

// Seen on 4000 patches: de Casteljau at most 8, 25, 6, 4, the library no more, the power basis
// 19, 84, 20, 12.
constexpr Tolerance kTolerances[] = {{100, 1}, {500, 0}, {100, 3}, {100, 6}};

struct Sample {
  double position[3] = {};
  double du[3] = {};
  double dv[3] = {};
  double duu[3] = {};
  double duv[3] = {};
  double dvv[3] = {};
  double normal[3] = {};
};

/// The four Bernstein polynomials and their first two derivatives at t.
struct Basis {
  double value[4];
  double slope[4];
  double curvature[4];

  explicit Basis(double t) {
    const double s = 1 - t;
    const double values[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    const double slopes[] = {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
    const double curvatures[] = {6 * s, 6 * (t - 2 * s), 6 * (s - 2 * t), 6 * t};
    std::copy_n(values, 4, value);
    std::copy_n(slopes, 4, slope);
    std::copy_n(curvatures, 4, curvature);
  }
};

template <typename T>
Sample evaluate(const T* net, double u, double v) {
  const Basis bu(u);
  const Basis bv(v);
  Sample s;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c) {
        const double b = static_cast<double>(net[12 * j + 3 * i + c]);
        s.position[c] += b * bu.value[i] * bv.value[j];
        s.du[c] += b * bu.slope[i] * bv.value[j];
        s.dv[c] += b * bu.value[i] * bv.slope[j];
        s.duu[c] += b * bu.curvature[i] * bv.value[j];
        s.duv[c] += b * bu.slope[i] * bv.slope[j];
        s.dvv[c] += b * bu.value[i] * bv.curvature[j];
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

/// The k-th of the checked patches.
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

} // namespace

template <typename T>
std::string check_sample(const Results<T>& results, std::size_t index, const T* net, double u,
                         double v, std::size_t patch, std::size_t sample) {
  const double roundoff = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  double size = 0;
  for (int k = 0; k < 48; ++k) {
    size = std::max(size, std::abs(static_cast<double>(net[k])));
  }
  const Sample reference = evaluate(net, u, v);
  for (std::size_t group = 0; group < group_count(results.groups); ++group) {
    const Expected want = expected(reference, results.groups, group);
    const Tolerance tolerance = kTolerances[want.quantity];
    const double most =
        tolerance.units * roundoff * (tolerance.scale > 0 ? tolerance.scale * size : 1);
    for (std::size_t c = 0; c < 3; ++c) {
      const double got =
          static_cast<double>(results.component[3 * group + c][index * results.stride]);
      if (!(std::abs(got - want.value[c]) <= most)) {
        char line[160];
        std::snprintf(line, sizeof line,
                      "wrong %s: patch %zu sample %zu: expected %.9g, found %.9g", want.name, patch,
                      sample, want.value[c], got);
        return line;
      }
    }
  }
  return {};
}

template <typename T>
void poison(const Results<T>& results, std::size_t first, std::size_t last) {
  for (std::size_t k = 0; k < 3 * group_count(results.groups); ++k) {
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
      failure = check_sample(job.out, patch * samples + sample, nets + 48 * patch,
                             static_cast<double>(sample % job.nu) / static_cast<double>(job.nu - 1),
                             static_cast<double>(sample / job.nu) / static_cast<double>(job.nv - 1),
                             patch, sample);
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
                                       std::size_t, std::size_t);                                  \
  template void poison<T>(const Results<T>&, std::size_t, std::size_t);                            \
  template void poison_grid<T>(const GridJob<T>&);                                                 \
  template std::string check_grid<T>(const GridJob<T>&, const T*);                                 \
  template void poison_scattered<T>(const ScatteredJob<T>&);                                       \
  template std::string check_scattered<T>(const ScatteredJob<T>&, const T*);
SIMDBEZIER_BENCH_INSTANTIATE(float)
SIMDBEZIER_BENCH_INSTANTIATE(double)
#undef SIMDBEZIER_BENCH_INSTANTIATE

} // namespace simdbezier_bench
