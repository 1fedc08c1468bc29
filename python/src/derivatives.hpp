// Partial derivatives of any order: which ones a call is asked for, and their arrays.
#pragma once

#include <algorithm>
#include <vector>

#include <simdbezier/evaluate.hpp>

#include "python/src/arguments/wanted_outputs.hpp"
#include "python/src/module.hpp"

namespace simdbezier::python {

/// Orders of a partial derivative, and its key in the results.
struct WantedDerivative {
  int u = 0;
  int v = 0;
  py::object key;
};

/// Pairs of orders, or for curves orders, each once; None: none. An argument that can be run
/// through only once has its orders only once.
[[nodiscard]] std::vector<WantedDerivative> wanted_derivatives(const py::object& derivatives,
                                                               bool of_curve);
/// The pairs in `derivatives`, and behind them the keys of `out` (None, or a dict); at least one of
/// both.
[[nodiscard]] std::vector<WantedDerivative> wanted_pairs(const py::object& derivatives,
                                                         const py::object& out);

/// Derivatives by u and v where `where` says: a dict of arrays, whose keys are those of `wanted`.
/// samples: the dimensions of arrays in front of the components.
template <typename T, typename Where>
py::dict evaluate_derivatives_at(const PatchSet<T>& set, const Where& where,
                                 const std::vector<WantedDerivative>& wanted,
                                 const std::vector<py::ssize_t>& samples, const py::object& out,
                                 const NamedArrays& inputs, const py::object& threads) {
  const int components = set.components();
  std::vector<py::ssize_t> shape = samples;
  shape.push_back(components);
  std::vector<OutputArray> outputs;
  NamedArrays named;
  for (const WantedDerivative& one : wanted) {
    outputs.emplace_back(one.key, out, py::dtype::of<T>(), shape, samples.size());
    named.emplace_back(outputs.back().argument(), outputs.back().array());
  }
  refuse_overlaps(named, samples.size(), inputs);
  Options options;
  options.threads = thread_count(threads);
  Status status;
  for (int first = 0; status && first < components; first += 3) {
    const int count = std::min(3, components - first);
    std::vector<PartialDerivative<T>> to;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      to.push_back({wanted[k].u, wanted[k].v, outputs[k].template vectors<T>(first, count)});
    }
    const py::gil_scoped_release release;
    status = simdbezier::evaluate_derivatives(set, where, {to, first}, options);
  }
  require_ok(status, status == Status::bad_patch_index ? "patch"
                     : out.is_none()                   ? "derivatives"
                                                       : "out");
  py::dict result;
  for (const OutputArray& output : outputs) {
    result[output.key()] = output.array();
  }
  return result;
}

} // namespace simdbezier::python
