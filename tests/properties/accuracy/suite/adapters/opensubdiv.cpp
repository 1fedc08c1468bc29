// OpenSubdiv (Pixar), Osd::CpuEvaluator::EvalPatches: float.
//
// Its public calls know no Bézier patches. A Gregory patch whose two points at each inner corner
// coincide is the bicubic Bézier patch with those inner points, whatever the blending weights.
#include <opensubdiv/far/patchDescriptor.h>
#include <opensubdiv/far/patchParam.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/types.h>

#include "tests/properties/accuracy/suite/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

/// The Bézier point j*4+i of each Gregory point: per corner, counter-clockwise from (0,0), the
/// corner, its outgoing and incoming edge points, and the inner point twice.
constexpr int kGregoryPoints[20] = {0,  1,  4,  5,  5,  3,  7, 2,  6, 6,
                                    15, 14, 11, 10, 10, 12, 8, 13, 9, 9};

class OpenSubdivEvaluator : public Evaluator<float> {
public:
  [[nodiscard]] std::string name() const override { return "opensubdiv"; }
  [[nodiscard]] bool handles(const Net& net) const override { return net.is_bicubic(); }

  void evaluate(const Net& net, std::span<const Parameters2<float>> at, int /*grid*/,
                std::span<Result<float>> results) override {
    std::vector<float> points;
    for (const Vector3& point : net.points) {
      for (const double value : point) {
        points.push_back(static_cast<float>(value));
      }
    }
    std::vector<Osd::PatchCoord> coordinates;
    for (const Parameters2<float>& parameters : at) {
      Far::PatchTable::PatchHandle handle;
      handle.arrayIndex = handle.patchIndex = handle.vertIndex = 0;
      coordinates.emplace_back(handle, parameters.u, parameters.v);
    }
    const std::size_t count = at.size();
    std::vector<float> values(9 * count);
    float* const first = values.data();
    const Osd::BufferDescriptor triples(0, 3, 3);
    const Osd::PatchArray array(Far::PatchDescriptor(Far::PatchDescriptor::GREGORY_BASIS), 1, 0, 0);
    Far::PatchParam parameter;
    parameter.Set(0, 0, 0, 0, false, 0, 0, false);
    Osd::PatchParam raw;
    raw.field0 = parameter.field0;
    raw.field1 = parameter.field1;
    raw.sharpness = 0;
    Osd::CpuEvaluator::EvalPatches(points.data(), triples, first, triples, first + 3 * count,
                                   triples, first + 6 * count, triples, static_cast<int>(count),
                                   coordinates.data(), &array, kGregoryPoints, &raw);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        results[k].position[c] = values[3 * k + c];
        results[k].du[c] = values[3 * (count + k) + c];
        results[k].dv[c] = values[3 * (2 * count + k) + c];
      }
      set_normal_from_tangents(results[k]);
    }
  }
};

} // namespace

void add_opensubdiv(Evaluators<float>& list) {
  list.push_back(std::make_unique<OpenSubdivEvaluator>());
}

} // namespace simdbezier::tests
