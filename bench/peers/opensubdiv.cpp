// OpenSubdiv (Pixar), Osd::CpuEvaluator::EvalPatches: float.
//
// Its public calls know no Bézier patches. A bicubic Bézier patch is a uniform bicubic B-spline
// patch with other control points, which is its fastest kind ("regular").
#include <opensubdiv/far/patchDescriptor.h>
#include <opensubdiv/far/patchParam.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/types.h>

#include <numeric>
#include <vector>

#include "bench/peers/peers.hpp"

namespace simdbezier_bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

/// Converts one cubic from Bézier to B-spline points, in place.
void to_bspline(double* b, int stride) {
  const double b0 = b[0];
  const double b1 = b[stride];
  const double b2 = b[2 * stride];
  const double b3 = b[3 * stride];
  b[0] = 6 * b0 - 7 * b1 + 2 * b2;
  b[stride] = 2 * b1 - b2;
  b[2 * stride] = 2 * b2 - b1;
  b[3 * stride] = 2 * b1 - 7 * b2 + 6 * b3;
}

struct Batch {
  std::vector<float> points;
  std::vector<int> indices;
  std::vector<Osd::PatchCoord> coordinates;
  std::vector<Osd::PatchParam> parameters;

  Batch(const GridJob<float>& job, const float* nets)
      : points(48 * job.patches), indices(16 * job.patches) {
    std::iota(indices.begin(), indices.end(), 0);
    for (std::size_t patch = 0; patch < job.patches; ++patch) {
      for (std::size_t c = 0; c < 3; ++c) {
        double b[16];
        for (std::size_t k = 0; k < 16; ++k) {
          b[k] = static_cast<double>(nets[48 * patch + 3 * k + c]);
        }
        for (int k = 0; k < 4; ++k) {
          to_bspline(b + 4 * k, 1);
        }
        for (int k = 0; k < 4; ++k) {
          to_bspline(b + k, 4);
        }
        for (std::size_t k = 0; k < 16; ++k) {
          points[48 * patch + 3 * k + c] = static_cast<float>(b[k]);
        }
      }
      Far::PatchParam parameter;
      parameter.Set(static_cast<int>(patch), 0, 0, 0, false, 0, 0, true);
      Osd::PatchParam raw;
      raw.field0 = parameter.field0;
      raw.field1 = parameter.field1;
      raw.sharpness = 0;
      parameters.push_back(raw);
      Far::PatchTable::PatchHandle handle;
      handle.arrayIndex = 0;
      handle.patchIndex = static_cast<int>(patch);
      handle.vertIndex = 16 * handle.patchIndex;
      for (std::size_t iv = 0; iv < job.nv; ++iv) {
        for (std::size_t iu = 0; iu < job.nu; ++iu) {
          coordinates.emplace_back(handle, job.u[iu], job.v[iv]);
        }
      }
    }
  }
};

} // namespace

std::function<void()> prepare_opensubdiv(const GridJob<float>& job, const float* nets) {
  return [batch = Batch(job, nets), out = job.out] {
    const Osd::BufferDescriptor triples(0, 3, 3);
    const Osd::PatchArray array(Far::PatchDescriptor(Far::PatchDescriptor::REGULAR),
                                static_cast<int>(batch.parameters.size()), 0, 0);
    const int count = static_cast<int>(batch.coordinates.size());
    if (out.groups == OutputGroups::position) {
      Osd::CpuEvaluator::EvalPatches(batch.points.data(), triples, out.component[0], triples, count,
                                     batch.coordinates.data(), &array, batch.indices.data(),
                                     batch.parameters.data());
    } else {
      Osd::CpuEvaluator::EvalPatches(batch.points.data(), triples, out.component[0], triples,
                                     out.component[3], triples, out.component[6], triples, count,
                                     batch.coordinates.data(), &array, batch.indices.data(),
                                     batch.parameters.data());
    }
  };
}

} // namespace simdbezier_bench
