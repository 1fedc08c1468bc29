// Outputs of a call: which ones, in whose arrays, and as the library sees them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <simdbezier/outputs.hpp>
#include <simdbezier/status.hpp>

#include "python/src/arrays.hpp"

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

/// The caller's array, found to have the shape, or a new one.
[[nodiscard]] py::array output_array(const std::string& name, const py::object& out,
                                     const py::dtype& dtype, const std::vector<py::ssize_t>& shape);

/// How far apart samples lie, in elements, the array having `samples` dimensions of them. They have
/// to be evenly spaced, and no two values of the array may share one place.
[[nodiscard]] std::ptrdiff_t sample_stride(const py::array& array, std::size_t samples,
                                           const std::string& argument);

/// Arrays, and the names of the arguments that they are.
using NamedArrays = std::vector<std::pair<std::string, py::array>>;

/// Refuses outputs that share memory with one another or with an input, with the names of both. It
/// refuses all that the library does, since more than three components take several calls, of which
/// none may have written when another one is refused. `samples` are the dimensions of the outputs
/// in front of the components.
void refuse_overlaps(const NamedArrays& outputs, std::size_t samples, const NamedArrays& inputs);

template <typename T>
class OutputArrays {
public:
  /// wanted: what wanted_outputs() found. samples: the dimensions in front of the components.
  OutputArrays(const OutputNames& known, const std::vector<std::string>& wanted,
               const py::object& out, const std::vector<py::ssize_t>& samples, int components,
               const NamedArrays& inputs) {
    for (const std::string& name : wanted) {
      std::vector<py::ssize_t> shape = samples;
      if (known.is_vector(name)) {
        shape.push_back(components);
      }
      const py::dtype dtype = name == "status" ? py::dtype::of<std::uint8_t>() : py::dtype::of<T>();
      py::array array = output_array(name, out, dtype, shape);
      const std::ptrdiff_t stride = sample_stride(array, samples.size(), argument(name));
      if (!known.is_vector(name) && stride != 1 && array.size() > 1) {
        throw_value_error(argument(name), "its values have to lie side by side");
      }
      entries_.push_back({name, array, array.mutable_data(), stride, component_stride(array)});
      arrays_.emplace_back(name, std::move(array));
    }
    refuse_overlaps(arrays_, samples.size(), inputs);
  }

  /// `count` components of a vector output from `first` on; nothing where it is not wanted.
  [[nodiscard]] Vectors<T> vectors(const std::string& name, int first, int count) const {
    const Entry* const entry = find(name);
    if (entry == nullptr) {
      return {};
    }
    T* const x = static_cast<T*>(entry->first) + first * entry->components;
    return {x, count > 1 ? x + entry->components : nullptr,
            count > 2 ? x + 2 * entry->components : nullptr, entry->stride};
  }
  [[nodiscard]] Values<T> values(const std::string& name) const {
    const Entry* const entry = find(name);
    return entry == nullptr ? Values<T>() : Values<T>(static_cast<T*>(entry->first));
  }
  [[nodiscard]] Values<SampleStatus> status() const {
    const Entry* const entry = find("status");
    return entry == nullptr ? Values<SampleStatus>()
                            : Values<SampleStatus>(static_cast<SampleStatus*>(entry->first));
  }
  [[nodiscard]] bool any_vector(const OutputNames& known) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const Entry& entry) { return known.is_vector(entry.name); });
  }
  [[nodiscard]] py::dict result() const {
    py::dict all;
    for (const auto& [name, array] : arrays_) {
      all[py::str(name)] = array;
    }
    return all;
  }

  [[nodiscard]] static std::string argument(const std::string& name) {
    return "out['" + name + "']";
  }

private:
  struct Entry {
    std::string name;
    py::array array;
    void* first;
    std::ptrdiff_t stride;
    std::ptrdiff_t components;
  };

  static std::ptrdiff_t component_stride(const py::array& array) {
    const py::ssize_t last = array.ndim() - 1;
    return array.shape(last) > 1 ? array.strides(last) / array.itemsize() : 1;
  }
  [[nodiscard]] const Entry* find(const std::string& name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries_.end() ? nullptr : &*found;
  }

  std::vector<Entry> entries_;
  NamedArrays arrays_;
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
