// SISL (SINTEF), s1424 on B-spline surfaces without inner knots: double, sample by sample.
#include <sisl.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace {

struct Batch {
  std::vector<std::shared_ptr<SISLSurf>> surfaces;
  std::vector<double> u, v;
  Results<double> out;

  Batch(const GridJob<double>& job, const double* nets)
      : u(job.u, job.u + job.nu), v(job.v, job.v + job.nv), out(job.out) {
    double knots_u[8] = {0, 0, 0, 0, 1, 1, 1, 1};
    double knots_v[8] = {0, 0, 0, 0, 1, 1, 1, 1};
    for (std::size_t patch = 0; patch < job.patches; ++patch, nets += 48) {
      constexpr int kPolynomial = 1;
      constexpr int kCopy = 1;
      std::vector<double> points(nets, nets + 48);
      surfaces.emplace_back(
          newSurf(4, 4, 4, 4, knots_u, knots_v, points.data(), kPolynomial, 3, kCopy), freeSurf);
    }
  }

  void operator()() const {
    const int order = out.groups == OutputGroups::position ? 0 : 1;
    std::size_t k = 0;
    int left_u = 0;
    int left_v = 0;
    for (const auto& surface : surfaces) {
      for (const double at_v : v) {
        for (const double at_u : u) {
          double parameters[2] = {at_u, at_v};
          double derivatives[12]; // position, du, dv, duv
          int status = 0;
          s1424(surface.get(), order, order, parameters, &left_u, &left_v, derivatives, &status);
          for (std::size_t group = 0; group < group_count(out.groups); ++group) {
            std::copy_n(derivatives + 3 * group, 3, out.component[3 * group] + k);
          }
          k += 3;
        }
      }
    }
  }
};

} // namespace

std::function<void()> prepare_sisl(const GridJob<double>& job, const double* nets) {
  return Batch(job, nets);
}

} // namespace simdbezier_bench
