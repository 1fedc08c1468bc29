// SISL (SINTEF), s1421 on a B-spline surface without inner knots: double.
#include <stdexcept>

#include <sisl.h>

#include "tests/properties/accuracy/suite/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

[[nodiscard]] std::vector<double> clamped_knots(int degree) {
  std::vector<double> knots(2 * static_cast<std::size_t>(degree) + 2, 0.0);
  std::fill(knots.begin() + degree + 1, knots.end(), 1.0);
  return knots;
}

class SislEvaluator : public Evaluator<double> {
public:
  [[nodiscard]] std::string name() const override { return "sisl"; }
  [[nodiscard]] bool handles(const Net& net) const override { return !net.is_rational(); }

  void evaluate(const Net& net, std::span<const Parameters2<double>> at, int /*grid*/,
                std::span<Result<double>> results) override {
    std::vector<double> points;
    for (const Vector3& point : net.points) {
      points.insert(points.end(), point.begin(), point.end());
    }
    std::vector<double> knots_u = clamped_knots(net.degree_u);
    std::vector<double> knots_v = clamped_knots(net.degree_v);
    constexpr int kPolynomial = 1;
    constexpr int kCopy = 1;
    const std::unique_ptr<SISLSurf, void (*)(SISLSurf*)> surface(
        newSurf(net.degree_u + 1, net.degree_v + 1, net.degree_u + 1, net.degree_v + 1,
                knots_u.data(), knots_v.data(), points.data(), kPolynomial, 3, kCopy),
        freeSurf);
    int left_u = 0;
    int left_v = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      double parameters[2] = {at[k].u, at[k].v};
      double derivatives[9]; // position, du, dv
      double normal[3];
      int status = 0;
      s1421(surface.get(), 1, parameters, &left_u, &left_v, derivatives, normal, &status);
      if (status < 0) {
        throw std::runtime_error("sisl: s1421 failed");
      }
      for (int c = 0; c < 3; ++c) {
        results[k].position[c] = derivatives[c];
        results[k].du[c] = derivatives[3 + c];
        results[k].dv[c] = derivatives[6 + c];
      }
      set_normal_from_tangents(results[k]);
    }
  }
};

} // namespace

void add_sisl(Evaluators<double>& list) { list.push_back(std::make_unique<SislEvaluator>()); }

} // namespace simdbezier::tests
