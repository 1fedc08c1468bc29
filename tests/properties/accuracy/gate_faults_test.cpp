// Each kind of fault is seen by the check that is there for it. Without a fault, a plain scalar
// copy of the scheme has the library's bits, so the order of evaluation is the documented one.
#include <string>

#include <gtest/gtest.h>

#include "tests/properties/accuracy/judge/evaluator.hpp"
#include "tests/properties/accuracy/judge/measure.hpp"
#include "tests/properties/accuracy/judge/model.hpp"
#include "tests/properties/accuracy/judge/scalar_evaluators.hpp"
#include "tests/properties/watertight/shared_edges.hpp"
#include "tests/support/evaluation.hpp"
#include "tests/support/isa_fixture.hpp"

namespace simdbezier::tests::gate_faults_test {
namespace {

/// The model as an evaluator of positions and tangents.
template <typename T, bool kFused>
class ModelEvaluator : public Evaluator<T> {
public:
  explicit ModelEvaluator(Fault fault) : fault_(fault) {}

  [[nodiscard]] std::string name() const override { return "model"; }
  [[nodiscard]] ResultClass result_class() const override {
    return kFused ? ResultClass::fma : ResultClass::nofma;
  }
  [[nodiscard]] Capabilities capabilities(const Net& /*net*/) const override {
    return {true, true, false};
  }
  [[nodiscard]] bool reads_centred() const override { return true; }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int /*grid*/,
                std::span<Result<T>> results) override {
    for (std::size_t c = 0; c < 3; ++c) {
      const Model<T, kFused> model(net, c, fault_);
      for (std::size_t k = 0; k < at.size(); ++k) {
        const auto sample = model.evaluate(at[k].x, at[k].y);
        results[k].position[c] = sample.position;
        results[k].du[c] = sample.du;
        results[k].dv[c] = sample.dv;
      }
    }
  }

private:
  Fault fault_;
};

class ModelTest : public IsaTest {
protected:
  template <typename T, bool kFused>
  [[nodiscard]] static std::size_t differing(const std::vector<Net>& nets, const Planes<T>& planes,
                                             int n, Fault fault) {
    std::size_t different = 0;
    for (std::size_t p = 0; p < nets.size(); ++p) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Model<T, kFused> model(nets[p], c, fault);
        for (int k = 0; k < n * n; ++k) {
          const auto sample =
              model.evaluate(model.centred(k % n, n - 1), model.centred(k / n, n - 1));
          const std::size_t at = p * static_cast<std::size_t>(n * n) + static_cast<std::size_t>(k);
          different += same_bits(planes.at(0, c, at), sample.position) ? 0 : 1;
          different += same_bits(planes.at(1, c, at), sample.du) ? 0 : 1;
          different += same_bits(planes.at(2, c, at), sample.dv) ? 0 : 1;
          different += same_bits(planes.at(4, c, at), sample.duu) ? 0 : 1;
          different += same_bits(planes.at(5, c, at), sample.duv) ? 0 : 1;
          different += same_bits(planes.at(6, c, at), sample.dvv) ? 0 : 1;
        }
      }
    }
    return different;
  }

  template <typename T>
  void expect_model(Fault fault, bool equal) {
    const std::vector<Net> nets = mixed_nets(40);
    for (const int n : {9, 16, 21}) {
      const auto count = static_cast<std::size_t>(n);
      Planes<T> planes(nets.size() * count * count, {.second = true});
      grid(packed<T>(nets), Grid<T>::uniform(count, count), planes.outputs());
      const std::size_t different = fuses_multiply_add(isa())
                                        ? differing<T, true>(nets, planes, n, fault)
                                        : differing<T, false>(nets, planes, n, fault);
      if (equal) {
        EXPECT_EQ(different, 0u) << "grid " << n;
      } else {
        EXPECT_GT(different, 0u) << "grid " << n;
      }
    }
  }
};

TEST_P(ModelTest, SameOrderOfEvaluationFloat) { expect_model<float>(Fault::none, true); }
TEST_P(ModelTest, SameOrderOfEvaluationDouble) { expect_model<double>(Fault::none, true); }
TEST_P(ModelTest, ContractionChangesBits) { expect_model<float>(Fault::contracted, false); }
INSTANTIATE_FOR_EVERY_ISA(ModelTest);

/// Samples on shared edges that differ between the two patches, by the model with a fault.
template <typename T>
[[nodiscard]] std::size_t open_edge_samples(Fault fault) {
  Random random(60);
  std::size_t different = 0;
  for (int round = 0; round < 60; ++round) {
    const EdgeBatch batch = make_edge_batch(EdgeKind::plain, random);
    const int intervals = random.integer(1, 60);
    for (const auto& [first, second] : batch.pairs) {
      for (int t = 0; t <= intervals; ++t) {
        T values[2];
        int side = 0;
        for (const Placed* placed : {&first, &second}) {
          const Net& net = batch.nets[placed->along_v ? 1 : 0][placed->index];
          const Model<T, true> model(net, 0, fault);
          const T along = model.centred(placed->place.reversed ? intervals - t : t, intervals);
          const T across = placed->place.side % 2 == 0 ? T(-1) : T(1);
          values[side++] = placed->place.side < 2 ? model.evaluate(along, across).position
                                                  : model.evaluate(across, along).position;
        }
        different += same_bits(values[0], values[1]) ? 0 : 1;
      }
    }
  }
  return different;
}

TEST(FaultTest, WatertightCheckSeesReciprocals) {
  EXPECT_EQ(open_edge_samples<float>(Fault::none), 0u);
  EXPECT_GT(open_edge_samples<float>(Fault::reciprocal_step), 0u);
  EXPECT_EQ(open_edge_samples<double>(Fault::none), 0u);
  EXPECT_GT(open_edge_samples<double>(Fault::reciprocal_step), 0u);
}

TEST(FaultTest, CornerCheckSeesDroppedCorners) {
  Random random(61);
  std::size_t wrong = 0;
  for (int k = 0; k < 100; ++k) {
    const Net net = rounded_to<float>(random_net(random));
    const Model<float, true> sound(net, 0, Fault::none);
    const Model<float, true> faulty(net, 0, Fault::no_corner_store);
    EXPECT_EQ(sound.evaluate(1, 1).position, static_cast<float>(net.at(3, 3)[0]));
    wrong += faulty.evaluate(1, 1).position == static_cast<float>(net.at(3, 3)[0]) ? 0 : 1;
  }
  EXPECT_GT(wrong, 10u);
}

/// RMS of positions over the family "wave".
template <typename T>
[[nodiscard]] double wave_rms(Evaluator<T>& evaluator) {
  static const Family<T> family = all_families<T>(60, 60).front();
  static const Reference reference = make_reference(family, true);
  return measure(evaluator, family, reference)[Quantity::position].rms();
}

template <typename T>
void expect_coefficients_in_type_seen() {
  ModelEvaluator<T, true> sound(Fault::none);
  ModelEvaluator<T, true> faulty(Fault::coefficients_in_type);
  ScalarEvaluator<T, DeCasteljau<T, WeightedLerp<T>>> weighted;
  ScalarEvaluator<T, DeCasteljau<T, DifferenceLerp<T>>> difference;
  const double allowed =
      kRmsAgainstDeCasteljau * std::min(wave_rms<T>(weighted), wave_rms<T>(difference));
  EXPECT_LE(wave_rms<T>(sound), allowed);
  EXPECT_GT(wave_rms<T>(faulty), allowed) << "gate G5 must catch coefficients formed in T";
  EXPECT_GT(wave_rms<T>(faulty), 1.05 * wave_rms<T>(sound)) << "gate G2 must catch them";
}

TEST(FaultTest, RmsGateSeesCoefficientsInFloat) { expect_coefficients_in_type_seen<float>(); }
TEST(FaultTest, RmsGateSeesCoefficientsInDouble) { expect_coefficients_in_type_seen<double>(); }

} // namespace
} // namespace simdbezier::tests::gate_faults_test
