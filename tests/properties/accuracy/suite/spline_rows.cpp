// Rows of splines: errors of Bézier control values in units of u max|d|, against knot insertion in
// fractions.
#include <cmath>
#include <regex>

#include "tests/properties/accuracy/suite/report.hpp"
#include "tests/properties/accuracy/suite/spline_rows.hpp"
#include "tests/splines/spline_oracle.hpp"

namespace simdbezier::tests {
namespace {

/// Surfaces of one kind of knots in either direction, of any degrees and forms of weights.
template <typename T>
std::vector<ExactCase<T>> spline_family(KnotKind kind, std::size_t count) {
  Random random(static_cast<std::uint64_t>(kind) + 500);
  std::vector<ExactCase<T>> cases;
  for (std::size_t k = 0; k < count; ++k) {
    const int degree = k % 8 == 7 ? random.integer(6, 15) : random.integer(1, 5);
    const AxisModel axis = random_axis(random, kind, degree, k % 3 == 1);
    const KnotKind other_kind = kKnotKinds[random.below(std::size(kKnotKinds))];
    const AxisModel other = random_axis(random, other_kind, random.integer(1, 3), false);
    cases.push_back(exact_case("", random_surface<T>(random, k % 2 == 0 ? axis : other,
                                                     k % 2 == 0 ? other : axis, 1,
                                                     static_cast<Weights>(k % 3))));
  }
  return cases;
}

/// Adds the errors of one surface to a metric.
template <typename T>
void judge(const ExactCase<T>& item, const CutSurface<T>& cut, std::size_t number, Metric& metric) {
  const double unit = sizeof(T) == sizeof(float) ? 0x1p-24 : 0x1p-53;
  const std::size_t channels = item.model.channels();
  const double relative =
      spline_error(item.model.u.degree, item.model.v.degree, item.model.weights);
  for (std::size_t c = 0; c < channels; ++c) {
    const Rational largest = item.bound[c] / Rational(relative);
    for (std::size_t k = 0; k < item.exact[c].size() && largest > 0; ++k) {
      const T value = cut.values[k * channels + c];
      const Rational apart = abs(Rational(static_cast<double>(value)) - item.exact[c][k]) / largest;
      const double rounding = sizeof(T) == sizeof(float) ? unit : 0;
      const double error = apart.get_d();
      metric.add(error / unit, error / (relative + rounding),
                 {.net = number, .component = static_cast<int>(c), .x = 0, .y = 0});
      metric.hash.add(value);
    }
  }
}

} // namespace

template <typename T>
void measure_splines(const char* type, std::size_t nets, const std::string& filter,
                     AccuracyReport& report) {
  const std::regex wanted(filter);
  for (const KnotKind kind : kKnotKinds) {
    const FamilyInfo family{"spline_" + name_of(kind), 3, 3, 1};
    std::vector<ExactCase<T>> cases;
    for (const Isa isa : available_isas()) {
      const std::string evaluator(to_string(isa));
      if (!std::regex_search(family.name + "/" + type + "/" + evaluator, wanted)) {
        continue;
      }
      if (cases.empty()) {
        std::fprintf(stderr, "%s/%s\n", family.name.c_str(), type);
        cases = spline_family<T>(kind, nets / 8 + 1);
      }
      Measurement measurement;
      for (std::size_t k = 0; k < cases.size(); ++k) {
        const CutSurface<T> cut(cases[k].model.view(), {.threads = 1, .isa = isa});
        if (!cut.report || take_executed_isa() != isa) {
          report.failures.push_back(family.name + "/" + type + "/" + evaluator + ": spline " +
                                    std::to_string(k) + ": " +
                                    std::string(to_string(cut.report.status)));
          continue;
        }
        judge(cases[k], cut, k, measurement.metrics[static_cast<std::size_t>(Quantity::position)]);
      }
      // Nothing is fused, so that all instruction sets have the bits of one class.
      report.add(family, type, ResultClass::nofma, evaluator, measurement);
    }
  }
}

template void measure_splines<float>(const char*, std::size_t, const std::string&, AccuracyReport&);
template void measure_splines<double>(const char*, std::size_t, const std::string&,
                                      AccuracyReport&);

} // namespace simdbezier::tests
