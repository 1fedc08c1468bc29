#include "tests/properties/accuracy/suite/plugin_evaluator.hpp"

#include <optional>
#include <vector>

namespace simdbezier::tests {
namespace {

using tools::PluginLayout;

/// How a net is evaluated, and what the plug-in gives there: found by asking for its middle.
struct Given {
  PluginLayout layout = PluginLayout::triples;
  bool tangents = false;
  bool second = false;
  bool normal = false;
};

template <typename T>
class PluginEvaluator : public Evaluator<T> {
public:
  explicit PluginEvaluator(PluginProcess process) : process_(std::move(process)) {}

  [[nodiscard]] std::string name() const override { return process_->facts().name; }
  [[nodiscard]] ResultClass result_class() const override { return ResultClass::plugin; }

  [[nodiscard]] bool handles(const Net& net) const override {
    // Homogeneous points would have to be divided first, and that rounds.
    return !net.homogeneous && given(net).has_value();
  }
  [[nodiscard]] Capabilities capabilities(const Net& net) const override {
    const Given gives = given(net).value_or(Given());
    return {.tangents = gives.tangents, .normal = gives.normal, .second_derivatives = gives.second};
  }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int /*grid*/,
                std::span<Result<T>> results) override {
    std::vector<T> u;
    std::vector<T> v;
    for (const Parameters2<T>& sample : at) {
      u.push_back(sample.u);
      v.push_back(sample.v);
    }
    const Given wanted = given(net).value_or(Given());
    std::vector<T> values(3 * tools::kPluginVectors * at.size());
    if (const int answer = run(net, u, v, wanted, values); answer != 0) {
      throw tools::EvaluatorDied(process_->facts().file + ": returned " + std::to_string(answer) +
                                 " for a patch whose middle it had evaluated");
    }
    const bool planes = wanted.layout == PluginLayout::planes;
    for (std::size_t k = 0; k < at.size(); ++k) {
      Result<T>& result = results[k];
      T* const vectors[] = {result.position, result.du,  result.dv,    result.duu,
                            result.duv,      result.dvv, result.normal};
      for (std::size_t vector = 0; vector < tools::kPluginVectors; ++vector) {
        for (std::size_t c = 0; c < 3; ++c) {
          vectors[vector][c] =
              values[3 * vector * at.size() + (planes ? c * at.size() + k : 3 * k + c)];
        }
      }
      const bool zero = result.normal[0] == 0 && result.normal[1] == 0 && result.normal[2] == 0;
      result.status = zero ? SampleStatus::degenerate : SampleStatus::regular;
    }
  }

private:
  /// Everything, or what is not refused alone; nothing where even positions are refused.
  [[nodiscard]] std::optional<Given> given(const Net& net) const {
    const T middle[] = {T(0.5)};
    T unused[3 * tools::kPluginVectors];
    const auto gives = [&](const Given& wanted) {
      return run(net, middle, middle, wanted, unused) == 0;
    };
    const tools::EvaluatorForms& forms = process_->facts().forms<T>();
    for (const PluginLayout layout : {PluginLayout::planes, PluginLayout::triples}) {
      const bool planes = layout == PluginLayout::planes; // triples have no more than tangents
      const Given all{layout, true, planes, planes};
      if (!forms.has_patch(layout)) {
        continue;
      }
      if (gives(all)) {
        return all;
      }
      if (gives({.layout = layout})) {
        return Given{layout, gives({.layout = layout, .tangents = true}),
                     planes && gives({.layout = layout, .second = true}),
                     planes && gives({.layout = layout, .normal = true})};
      }
    }
    return std::nullopt;
  }

  /// Writes vector after vector, as far as they are wanted.
  int run(const Net& net, std::span<const T> u, std::span<const T> v, const Given& wanted,
          std::span<T> values) const {
    std::vector<T> points;
    for (const Vector3& point : net.points) {
      for (const double value : point) {
        points.push_back(static_cast<T>(value));
      }
    }
    const std::vector<T> weights(net.weights.begin(), net.weights.end());
    const bool asked[] = {true,          wanted.tangents, wanted.tangents, wanted.second,
                          wanted.second, wanted.second,   wanted.normal};
    tools::PluginPatchTask<T> task{points, net.degree_u,       net.degree_v, weights, u,
                                   v,      {wanted.layout, {}}};
    for (std::size_t k = 0; k < 3 * tools::kPluginVectors; ++k) {
      if (asked[k / 3] && (k % 3 == 0 || wanted.layout == PluginLayout::planes)) {
        task.out.at[k / 3][k % 3] = &values[k * u.size()];
      }
    }
    return process_->evaluate(task);
  }

  PluginProcess process_;
};

} // namespace

template <typename T>
void add_plugin(const PluginProcess& process, Evaluators<T>& list) {
  const tools::EvaluatorForms& forms = process->facts().forms<T>();
  if (forms.has_patch(PluginLayout::triples) || forms.has_patch(PluginLayout::planes)) {
    list.push_back(std::make_unique<PluginEvaluator<T>>(process));
  }
}

template void add_plugin<float>(const PluginProcess&, Evaluators<float>&);
template void add_plugin<double>(const PluginProcess&, Evaluators<double>&);

} // namespace simdbezier::tests
