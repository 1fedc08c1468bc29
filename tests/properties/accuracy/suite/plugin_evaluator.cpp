#include "tests/properties/accuracy/suite/plugin_evaluator.hpp"

#include <vector>

namespace simdbezier::tests {
namespace {

/// What of a net the plug-in evaluates: found by asking for its middle.
enum class Given : std::uint8_t { nothing, positions, tangents };

template <typename T>
class PluginEvaluator : public Evaluator<T> {
public:
  explicit PluginEvaluator(PluginProcess process) : process_(std::move(process)) {}

  [[nodiscard]] std::string name() const override { return process_->facts().name; }
  [[nodiscard]] ResultClass result_class() const override { return ResultClass::plugin; }

  [[nodiscard]] bool handles(const Net& net) const override {
    // Homogeneous points would have to be divided first, and that rounds.
    return !net.homogeneous && given(net) != Given::nothing;
  }
  [[nodiscard]] Capabilities capabilities(const Net& net) const override {
    Capabilities gives;
    gives.tangents = given(net) == Given::tangents;
    gives.normal = false;
    return gives;
  }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int /*grid*/,
                std::span<Result<T>> results) override {
    std::vector<T> u;
    std::vector<T> v;
    for (const Parameters2<T>& sample : at) {
      u.push_back(sample.u);
      v.push_back(sample.v);
    }
    const bool tangents = given(net) == Given::tangents;
    std::vector<T> position(3 * at.size());
    std::vector<T> du(tangents ? position.size() : 0);
    std::vector<T> dv(du.size());
    if (const int answer = run(net, u, v, position, du, dv); answer != 0) {
      throw tools::EvaluatorDied(process_->facts().file + ": returned " + std::to_string(answer) +
                                 " for a patch whose middle it had evaluated");
    }
    for (std::size_t k = 0; k < at.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        results[k].position[c] = position[3 * k + c];
        if (tangents) {
          results[k].du[c] = du[3 * k + c];
          results[k].dv[c] = dv[3 * k + c];
        }
      }
    }
  }

private:
  [[nodiscard]] Given given(const Net& net) const {
    const T middle[] = {T(0.5)};
    T position[3];
    T du[3];
    T dv[3];
    if (run(net, middle, middle, position, du, dv) == 0) {
      return Given::tangents;
    }
    return run(net, middle, middle, position, {}, {}) == 0 ? Given::positions : Given::nothing;
  }

  int run(const Net& net, std::span<const T> u, std::span<const T> v, std::span<T> position,
          std::span<T> du, std::span<T> dv) const {
    std::vector<T> points;
    for (const Vector3& point : net.points) {
      for (const double value : point) {
        points.push_back(static_cast<T>(value));
      }
    }
    const std::vector<T> weights(net.weights.begin(), net.weights.end());
    return process_->evaluate(tools::PluginPatchTask<T>{points, net.degree_u, net.degree_v, weights,
                                                        u, v, position, du, dv});
  }

  PluginProcess process_;
};

} // namespace

template <typename T>
void add_plugin(const PluginProcess& process, Evaluators<T>& list) {
  const tools::EvaluatorFacts& facts = process->facts();
  if (sizeof(T) == sizeof(float) ? facts.f32 : facts.f64) {
    list.push_back(std::make_unique<PluginEvaluator<T>>(process));
  }
}

template void add_plugin<float>(const PluginProcess&, Evaluators<float>&);
template void add_plugin<double>(const PluginProcess&, Evaluators<double>&);

} // namespace simdbezier::tests
