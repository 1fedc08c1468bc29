// VTK (Kitware), vtkBezierQuadrilateral: double.
//
// Positions are its EvaluateLocation. Its Derivatives gives gradients in space, by way of an
// inverted Jacobian and 0 where that is singular; so the tangents are that Jacobian's rows, formed
// as Derivatives does, from InterpolateDerivs. That one leaves weights out, so rational cells give
// positions only.
#include <vtkBezierQuadrilateral.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include "tests/properties/accuracy/suite/adapters/adapters.hpp"

namespace simdbezier::tests {
namespace {

class VtkEvaluator : public Evaluator<double> {
public:
  [[nodiscard]] std::string name() const override { return "vtk"; }
  [[nodiscard]] Capabilities capabilities(const Net& net) const override {
    return {.tangents = !net.is_rational(), .normal = !net.is_rational()};
  }

  void evaluate(const Net& net, std::span<const Parameters2<double>> at, int /*grid*/,
                std::span<Result<double>> results) override {
    const std::vector<Vector3> points = place_points(net);
    std::vector<double> weights(points.size());
    std::vector<double> slopes(2 * points.size()); // of each weight: in u, in v
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double parameters[3] = {at[k].u, at[k].v, 0};
      int part = 0;
      cell_->EvaluateLocation(part, parameters, results[k].position, weights.data());
      if (net.is_rational()) {
        continue;
      }
      cell_->InterpolateDerivs(parameters, slopes.data());
      for (std::size_t c = 0; c < 3; ++c) {
        results[k].du[c] = 0;
        results[k].dv[c] = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
          results[k].du[c] += points[p][c] * slopes[2 * p];
          results[k].dv[c] += points[p][c] * slopes[2 * p + 1];
        }
      }
      set_normal_from_tangents(results[k]);
    }
  }

private:
  /// Makes the net the cell's; returns its points in the cell's order: corners, edges, inside.
  [[nodiscard]] std::vector<Vector3> place_points(const Net& net) {
    const auto count = static_cast<vtkIdType>(net.points.size());
    const int order[2] = {net.degree_u, net.degree_v};
    cell_->GetPointIds()->SetNumberOfIds(count);
    cell_->GetPoints()->SetNumberOfPoints(count);
    cell_->SetOrder(order[0], order[1]);
    cell_->GetRationalWeights()->SetNumberOfTuples(net.is_rational() ? count : 0);
    const Net polygon = control_polygon(net);
    std::vector<Vector3> points(net.points.size());
    for (int j = 0; j <= net.degree_v; ++j) {
      for (int i = 0; i <= net.degree_u; ++i) {
        const int p = vtkBezierQuadrilateral::PointIndexFromIJK(i, j, order);
        points[static_cast<std::size_t>(p)] = polygon.at(j, i);
        cell_->GetPointIds()->SetId(p, p);
        cell_->GetPoints()->SetPoint(p, polygon.at(j, i).data());
        if (net.is_rational()) {
          cell_->GetRationalWeights()->SetValue(p, net.weight(j, i));
        }
      }
    }
    return points;
  }

  vtkNew<vtkBezierQuadrilateral> cell_;
};

} // namespace

void add_vtk(Evaluators<double>& list) { list.push_back(std::make_unique<VtkEvaluator>()); }

} // namespace simdbezier::tests
