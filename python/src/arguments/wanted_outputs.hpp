// Outputs of a call: which ones, in whose arrays, and as the library sees them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <simdbezier/outputs.hpp>
#include <simdbezier/status.hpp>

#include "python/src/arguments/arrays.hpp"

namespace simdbezier::python {

/// The outputs that a kind of call knows: vectors, values of one number a sample, and "status".
struct OutputNames {
  std::vector<std::string> vectors;
  std::vector<std::string> values;

  [[nodiscard]] bool is_vector(const std::string& name) const {
    return std::find(vectors.begin(), vectors.end(), name) != vectors.end();
  }
  [[nodiscard]] bool is_value(const std::string& name) const {
    return std::find(values.begin(), values.end(), name) != values.end();
  }
};

/// The names of the first kCount outputs. Name: Output, Curvature or CurveOutput.
template <typename Name, std::size_t kCount>
std::vector<std::string> output_names() {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kCount; ++k) {
    names.emplace_back(output_name(static_cast<Name>(k)));
  }
  return names;
}

/// Refuses more samples than memory can address, for which numpy's arrays have no shape.
void require_addressable(std::size_t samples, int components, const std::string& argument);

/// The names in `outputs` (a name, or several) and the keys of `out` (None, or a dict). To be
/// called once, since `outputs` may be a generator, which has its names only once.
[[nodiscard]] std::vector<std::string>
wanted_outputs(const OutputNames& known, const py::object& outputs, const py::object& out);

/// The dict of arrays that `out` is; an empty one for None.
[[nodiscard]] py::dict output_dict(const py::object& out);

/// Arrays, and the names of the arguments that they are.
using NamedArrays = std::vector<std::pair<std::string, py::array>>;

/// Refuses outputs that share memory with one another or with an input, with the names of both. It
/// refuses all that the library does, since more than three components take several calls, of which
/// none may have written when another one is refused. `samples` are the dimensions of the outputs
/// in front of the components.
void refuse_overlaps(const NamedArrays& outputs, std::size_t samples, const NamedArrays& inputs);

/// One output of a call: the caller's array, found to be usable, or a new one. The samples of
/// usable ones are evenly spaced, and no two of their values share one place.
class OutputArray {
public:
  /// key: what `out` (None, or a dict) and the results call it. shape: `samples` dimensions, and
  /// behind them the components where it has vectors.
  OutputArray(py::object key, const py::object& out, const py::dtype& dtype,
              const std::vector<py::ssize_t>& shape, std::size_t samples);

  [[nodiscard]] const py::object& key() const { return key_; }
  /// "out['position']"
  [[nodiscard]] const std::string& argument() const { return argument_; }
  [[nodiscard]] const py::array& array() const { return array_; }
  /// How far apart samples lie, in elements.
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

  /// Where the first value is, in an array of V.
  template <typename V>
  [[nodiscard]] V* first() const {
    return static_cast<V*>(first_);
  }
  /// `count` components from `first_component` on.
  template <typename T>
  [[nodiscard]] Vectors<T> vectors(int first_component, int count) const {
    T* const x = first<T>() + first_component * component_stride_;
    return {x, count > 1 ? x + component_stride_ : nullptr,
            count > 2 ? x + 2 * component_stride_ : nullptr, stride_};
  }

private:
  py::object key_;
  std::string argument_;
  py::array array_;
  void* first_;
  std::ptrdiff_t stride_;
  std::ptrdiff_t component_stride_;
};

template <typename T>
class OutputArrays {
public:
  /// wanted: what wanted_outputs() found. samples: the dimensions in front of the components.
  OutputArrays(const OutputNames& known, const std::vector<std::string>& wanted,
               const py::object& out, const std::vector<py::ssize_t>& samples, int components,
               const NamedArrays& inputs) {
    NamedArrays arrays;
    for (const std::string& name : wanted) {
      std::vector<py::ssize_t> shape = samples;
      if (known.is_vector(name)) {
        shape.push_back(components);
      }
      const py::dtype dtype = name == "status" ? py::dtype::of<std::uint8_t>() : py::dtype::of<T>();
      OutputArray output(py::str(name), out, dtype, shape, samples.size());
      if (!known.is_vector(name) && output.stride() != 1 && output.array().size() > 1) {
        throw_value_error(output.argument(), "its values have to lie side by side");
      }
      arrays.emplace_back(output.argument(), output.array());
      entries_.push_back({name, std::move(output)});
    }
    refuse_overlaps(arrays, samples.size(), inputs);
  }

  /// `count` components of a vector output from `first` on; nothing where it is not wanted.
  [[nodiscard]] Vectors<T> vectors(const std::string& name, int first, int count) const {
    const OutputArray* const output = find(name);
    return output == nullptr ? Vectors<T>() : output->vectors<T>(first, count);
  }
  [[nodiscard]] Values<T> values(const std::string& name) const {
    const OutputArray* const output = find(name);
    return output == nullptr ? Values<T>() : Values<T>(output->first<T>());
  }
  [[nodiscard]] Values<SampleStatus> status() const {
    const OutputArray* const output = find("status");
    return output == nullptr ? Values<SampleStatus>()
                             : Values<SampleStatus>(output->first<SampleStatus>());
  }
  [[nodiscard]] bool any_vector(const OutputNames& known) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const Entry& entry) { return known.is_vector(entry.name); });
  }
  [[nodiscard]] py::dict result() const {
    py::dict all;
    for (const Entry& entry : entries_) {
      all[entry.output.key()] = entry.output.array();
    }
    return all;
  }

private:
  struct Entry {
    std::string name;
    OutputArray output;
  };

  [[nodiscard]] const OutputArray* find(const std::string& name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries_.end() ? nullptr : &found->output;
  }

  std::vector<Entry> entries_;
};

/// Calls evaluate(to) for three components after three others, until a call is refused. `to` is of
/// the type To, the library's outputs, whose vectors have the order of known.vectors.
template <typename To, typename T, typename Evaluate>
Status evaluate_by_threes(const OutputNames& known, const OutputArrays<T>& arrays, int components,
                          const Evaluate& evaluate) {
  Status status;
  const int end = arrays.any_vector(known) ? components : 1; // the rest has no components
  for (int first = 0; status && first < end; first += 3) {
    To to;
    for (std::size_t k = 0; k < known.vectors.size(); ++k) {
      to[static_cast<typename To::Name>(k)] =
          arrays.vectors(known.vectors[k], first, std::min(3, components - first));
    }
    to.status = arrays.status();
    to.first_component = first;
    status = evaluate(to);
  }
  return status;
}

} // namespace simdbezier::python
