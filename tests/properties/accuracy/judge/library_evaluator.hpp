// This library as an evaluator, one for each instruction set.
#pragma once

#include <stdexcept>
#include <string>

#include "tests/properties/accuracy/judge/evaluator.hpp"
#include "tests/support/evaluation.hpp"

namespace simdbezier::tests {

template <typename T>
class LibraryEvaluator : public Evaluator<T> {
public:
  explicit LibraryEvaluator(Isa isa, const PackOptions& packing = {})
      : isa_(isa), packing_(packing) {}

  [[nodiscard]] std::string name() const override { return std::string(to_string(isa_)); }
  [[nodiscard]] ResultClass result_class() const override {
    return fuses_multiply_add(isa_) ? ResultClass::fma : ResultClass::nofma;
  }
  [[nodiscard]] Capabilities capabilities(const Net& /*net*/) const override {
    return {.second_derivatives = true, .curvature = true};
  }
  [[nodiscard]] bool reads_centred() const override { return true; }
  [[nodiscard]] std::string variant() const override {
    return packing_.local_origin ? "+origin" : "";
  }
  [[nodiscard]] std::optional<Certificate> certificate(const Net& net) const override {
    const ErrorBounds bounds = error_bounds(packed<T>(std::span(&net, 1), packing_), 0, isa_);
    Certificate certificate;
    for (std::size_t c = 0; c < 3; ++c) {
      certificate.position[c] = bounds.position[c];
      certificate.du[c] = bounds.du[c];
      certificate.dv[c] = bounds.dv[c];
    }
    return certificate;
  }
  /// The instruction set that the last call ran on, by the kernel's own word.
  [[nodiscard]] Isa executed() const { return executed_; }

  void evaluate(const Net& net, std::span<const Parameters2<T>> at, int grid,
                std::span<Result<T>> results) override {
    const PatchSet<T> set = packed<T>(std::span(&net, 1), packing_);
    Planes<T> planes(at.size(), {.second = true, .curvature = true});
    const Options options{.threads = 1, .isa = isa_};
    const Status status =
        grid > 0 ? run_grid(set, grid, planes, options) : run_scattered(set, at, planes, options);
    executed_ = take_executed_isa();
    if (status != Status::ok || executed_ != isa_) {
      throw std::runtime_error(name() + ": " + std::string(to_string(status)) + ", ran on " +
                               std::string(to_string(executed_)));
    }
    for (std::size_t k = 0; k < at.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        results[k].position[c] = planes.at(0, c, k);
        results[k].du[c] = planes.at(1, c, k);
        results[k].dv[c] = planes.at(2, c, k);
        results[k].normal[c] = planes.at(3, c, k);
        results[k].duu[c] = planes.at(4, c, k);
        results[k].duv[c] = planes.at(5, c, k);
        results[k].dvv[c] = planes.at(6, c, k);
      }
      for (std::size_t c = 0; c < 4; ++c) {
        results[k].curvature[c] = planes.curvature(c, k);
      }
      results[k].status = planes.status()[k];
    }
  }

private:
  [[nodiscard]] static Status run_grid(const PatchSet<T>& set, int grid, Planes<T>& planes,
                                       const Options& options) {
    const auto n = static_cast<std::size_t>(grid);
    return simdbezier::evaluate(set, Grid<T>::uniform(n, n), planes.outputs(), options);
  }

  [[nodiscard]] static Status run_scattered(const PatchSet<T>& set,
                                            std::span<const Parameters2<T>> at, Planes<T>& planes,
                                            const Options& options) {
    SampleArrays<T> samples;
    for (const Parameters2<T>& parameters : at) {
      samples.add(0, parameters.x, parameters.y);
    }
    return simdbezier::evaluate(set, samples.view(Parameters::centred), planes.outputs(), options);
  }

  Isa isa_;
  PackOptions packing_;
  Isa executed_ = Isa::automatic;
};

} // namespace simdbezier::tests
