// Eigen: every component of a patch as a product of three matrices, B_u P B_v^T, over SoA planes.
// Inner dimensions are known to be 4, so that products are unrolled and vectorised along u.
//
// Eigen's templates get a namespace of their own in every object. They are inline functions, of
// which the linker would otherwise keep one, compiled for any of the instruction sets.
#define SIMDBEZIER_BENCH_JOIN2(a, b) a##b
#define SIMDBEZIER_BENCH_JOIN(a, b) SIMDBEZIER_BENCH_JOIN2(a, b)
#define Eigen SIMDBEZIER_BENCH_JOIN(Eigen_, SIMDBEZIER_BENCH_ISA)

#include <Eigen/Core>

#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace SIMDBEZIER_BENCH_ISA {
namespace {

using Eigen::Dynamic;
template <typename T>
using Columns = Eigen::Matrix<T, Dynamic, 4>;

template <typename T>
Columns<T> bernstein(const T* parameters, std::size_t count) {
  const Eigen::Map<const Eigen::Array<T, Dynamic, 1>> t(parameters,
                                                        static_cast<Eigen::Index>(count));
  Columns<T> basis(t.size(), 4);
  basis.col(0) = (1 - t).cube();
  basis.col(1) = 3 * t * (1 - t).square();
  basis.col(2) = 3 * t.square() * (1 - t);
  basis.col(3) = t.cube();
  return basis;
}

template <typename T>
Columns<T> slopes(const T* parameters, std::size_t count) {
  const Eigen::Map<const Eigen::Array<T, Dynamic, 1>> t(parameters,
                                                        static_cast<Eigen::Index>(count));
  Columns<T> basis(t.size(), 4);
  basis.col(0) = -3 * (1 - t).square();
  basis.col(1) = 3 * (1 - t) * (1 - 3 * t);
  basis.col(2) = 3 * t * (2 - 3 * t);
  basis.col(3) = 3 * t.square();
  return basis;
}

template <typename T>
void run(const GridJob<T>& job) {
  const Columns<T> bu = bernstein(job.u, job.nu);
  const Columns<T> bv = bernstein(job.v, job.nv);
  const bool tangents = job.out.groups != OutputGroups::position;
  const Columns<T> su = tangents ? slopes(job.u, job.nu) : Columns<T>();
  const Columns<T> sv = tangents ? slopes(job.v, job.nv) : Columns<T>();
  Columns<T> rows(bu.rows(), 4);
  using Plane = Eigen::Map<Eigen::Matrix<T, Dynamic, Dynamic>>;
  using Points = Eigen::Map<const Eigen::Matrix<T, 4, 4>, 0, Eigen::Stride<12, 3>>;
  const std::size_t samples = job.nu * job.nv;
  for (std::size_t patch = 0; patch < job.patches; ++patch) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Matrix<T, 4, 4> points = Points(job.input + 48 * patch + c);
      const auto plane = [&](std::size_t group) {
        return Plane(job.out.component[3 * group + c] + patch * samples, bu.rows(), bv.rows());
      };
      rows.noalias() = bu.lazyProduct(points);
      plane(0).noalias() = rows.lazyProduct(bv.transpose());
      if (tangents) {
        plane(2).noalias() = rows.lazyProduct(sv.transpose());
        rows.noalias() = su.lazyProduct(points);
        plane(1).noalias() = rows.lazyProduct(bv.transpose());
      }
    }
  }
}

} // namespace

void eigen(const GridJob<float>& job);
void eigen(const GridJob<double>& job);
void eigen(const GridJob<float>& job) { run(job); }
void eigen(const GridJob<double>& job) { run(job); }

} // namespace SIMDBEZIER_BENCH_ISA
} // namespace simdbezier_bench
