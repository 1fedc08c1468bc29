// See wanted_outputs.hpp.
#include "python/src/arguments/wanted_outputs.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>

#include <pybind11/stl.h>

namespace simdbezier::python {
namespace {

/// What can be asked for alone: a status belongs to another output.
std::string main_names(const OutputNames& known) {
  std::string text;
  for (const auto* const list : {&known.vectors, &known.values}) {
    for (const std::string& name : *list) {
      text += (text.empty() ? "" : ", ") + name;
    }
  }
  return text;
}
std::string all_names(const OutputNames& known) { return main_names(known) + ", status"; }

class Wanted {
public:
  explicit Wanted(const OutputNames& known) : known_(known) {}

  void add(const py::handle& given, const char* argument) {
    if (!py::isinstance<py::str>(given)) {
      throw_type_error(argument, "expected names, found " + py::repr(given).cast<std::string>());
    }
    std::string name;
    try {
      name = given.cast<std::string>();
    } catch (const py::cast_error&) { // what is no valid Unicode has no bytes
      throw_value_error(argument,
                        py::repr(given).cast<std::string>() + " is none of " + all_names(known_));
    }
    if (!known_.is_vector(name) && !known_.is_value(name) && name != "status") {
      throw_value_error(argument, "'" + name + "' is none of " + all_names(known_));
    }
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
      names_.push_back(name);
    }
  }
  [[nodiscard]] std::vector<std::string> names() const {
    const bool only_status = names_.size() == 1 && names_.front() == "status";
    if (names_.empty() || only_status) {
      throw_value_error("outputs", "expected at least one of " + main_names(known_));
    }
    return names_;
  }

private:
  const OutputNames& known_;
  std::vector<std::string> names_;
};

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  return py::repr(py::tuple(py::cast(shape))).cast<std::string>();
}

/// One component of an output, or a whole input: the bytes from its first to behind its last, and
/// how far apart its samples lie, 0 where there is only one.
struct Column {
  std::uintptr_t low;
  std::uintptr_t high;
  std::uintptr_t first;
  py::ssize_t stride;

  [[nodiscard]] bool meets(const Column& other) const {
    return low < other.high && other.low < high;
  }
  /// Members of one vertex lie between each other, and share nothing.
  [[nodiscard]] bool collides(const Column& other) const {
    const auto distance = static_cast<py::ssize_t>(other.first - first);
    return meets(other) && (stride != other.stride || stride == 0 || distance % stride == 0);
  }
};

/// The component of an array that begins at an address, `samples` being its dimensions in front of
/// the components.
Column column_at(std::uintptr_t first, const py::array& array, std::size_t samples) {
  Column column{first, first + static_cast<std::uintptr_t>(array.itemsize()), first, 0};
  for (py::ssize_t k = 0; k < static_cast<py::ssize_t>(samples); ++k) {
    if (array.shape(k) > 1) {
      const py::ssize_t reach = (array.shape(k) - 1) * array.strides(k);
      (reach < 0 ? column.low : column.high) += static_cast<std::uintptr_t>(reach);
      column.stride = array.strides(k); // that of the last such dimension stays
    }
  }
  return column;
}

/// All components of an array; none of an empty one.
std::vector<Column> columns_of(const py::array& array, std::size_t samples) {
  std::vector<Column> columns;
  const bool vectors = array.ndim() > static_cast<py::ssize_t>(samples);
  const py::ssize_t last = array.ndim() - 1;
  const py::ssize_t components = array.size() == 0 ? 0 : vectors ? array.shape(last) : 1;
  const auto first = reinterpret_cast<std::uintptr_t>(array.data());
  for (py::ssize_t c = 0; c < components; ++c) {
    const py::ssize_t offset = vectors ? c * array.strides(last) : 0;
    columns.push_back(column_at(first + static_cast<std::uintptr_t>(offset), array, samples));
  }
  return columns;
}

/// Whether together(a, b) holds for any column of one array and any of the other.
template <typename Together>
bool any_pair(const std::vector<Column>& some, const std::vector<Column>& others,
              Together together) {
  return std::any_of(some.begin(), some.end(), [&](const Column& a) {
    return std::any_of(others.begin(), others.end(),
                       [&](const Column& b) { return together(a, b); });
  });
}

/// Whether every stride exceeds what the smaller ones span, so that no two values share one place.
bool nests(const py::array& array) {
  struct Direction {
    py::ssize_t stride;
    py::ssize_t last; // the highest index
  };
  std::vector<Direction> directions;
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    directions.push_back({std::abs(array.strides(k)), array.shape(k) - 1});
  }
  std::sort(directions.begin(), directions.end(),
            [](const Direction& a, const Direction& b) { return a.stride < b.stride; });
  py::ssize_t span = array.itemsize();
  for (const Direction& direction : directions) {
    if (direction.last > 0) {
      if (direction.stride < span) {
        return false;
      }
      span += direction.stride * direction.last;
    }
  }
  return true;
}

/// The caller's array, found to have the shape, or a new one.
py::array output_array(const py::object& key, const std::string& argument, const py::object& out,
                       const py::dtype& dtype, const std::vector<py::ssize_t>& shape) {
  if (out.is_none() || !py::reinterpret_borrow<py::dict>(out).contains(key)) {
    return py::array(dtype, shape);
  }
  const py::object given = out[key];
  if (!py::isinstance<py::array>(given)) {
    throw_type_error(argument, "expected a numpy array, found " +
                                   py::str(py::type::of(given)).cast<std::string>());
  }
  const auto array = py::reinterpret_borrow<py::array>(given);
  if (!array.dtype().equal(dtype)) {
    throw_type_error(argument, "expected " + py::str(py::object(dtype)).cast<std::string>() +
                                   ", found " + dtype_name(array));
  }
  const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
  if (found != shape) {
    throw_value_error(argument,
                      "expected shape " + shape_text(shape) + ", found " + shape_text(found));
  }
  if (!array.writeable()) {
    throw_value_error(argument, "is read-only");
  }
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    if (array.shape(k) > 1 && array.strides(k) % array.itemsize() != 0) {
      throw_value_error(argument, "its strides are no multiples of its items");
    }
  }
  if (!is_aligned(array)) {
    throw_value_error(argument, "is not aligned");
  }
  return array;
}

/// How far apart samples lie, in elements, the array having `samples` dimensions of them. They have
/// to be evenly spaced, and no two values of the array may share one place.
std::ptrdiff_t sample_stride(const py::array& array, std::size_t samples,
                             const std::string& argument) {
  if (array.size() > 0 && !nests(array)) {
    throw_value_error(argument, "its strides let two values share one place");
  }
  std::ptrdiff_t stride = 0; // of the last dimension that has more than one sample
  std::ptrdiff_t next = 0;   // what that of the one before has to be
  for (auto k = static_cast<py::ssize_t>(samples) - 1; k >= 0; --k) {
    if (array.shape(k) <= 1) {
      continue;
    }
    if (stride == 0) {
      stride = array.strides(k);
    } else if (array.strides(k) != next) {
      throw_value_error(argument, "its samples have to be evenly spaced: the next row begins where "
                                  "the last one ends");
    }
    next = array.strides(k) * array.shape(k);
  }
  const py::ssize_t last = array.ndim() - 1;
  const bool vectors = array.ndim() > static_cast<py::ssize_t>(samples);
  return stride == 0 ? (vectors ? array.shape(last) : 1) : stride / array.itemsize();
}

/// How far apart the components of one sample lie, in elements.
std::ptrdiff_t component_stride(const py::array& array) {
  const py::ssize_t last = array.ndim() - 1;
  return array.shape(last) > 1 ? array.strides(last) / array.itemsize() : 1;
}

} // namespace

void require_addressable(std::size_t samples, int components, const std::string& argument) {
  const std::size_t bytes = static_cast<std::size_t>(components) * sizeof(double);
  if (samples > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / bytes) {
    throw_value_error(argument, "the samples exceed what memory can address");
  }
}

std::vector<std::string> wanted_outputs(const OutputNames& known, const py::object& outputs,
                                        const py::object& out) {
  Wanted wanted(known);
  if (py::isinstance<py::str>(outputs)) {
    wanted.add(outputs, "outputs");
  } else if (py::isinstance<py::iterable>(outputs)) {
    for (const py::handle name : outputs) {
      wanted.add(name, "outputs");
    }
  } else if (!outputs.is_none()) {
    throw_type_error("outputs", "expected names, found " + py::repr(outputs).cast<std::string>());
  }
  for (const auto& item : output_dict(out)) {
    wanted.add(item.first, "out");
  }
  return wanted.names();
}

py::dict output_dict(const py::object& out) {
  if (out.is_none()) {
    return {};
  }
  if (!py::isinstance<py::dict>(out)) {
    throw_type_error("out", "expected a dict of arrays, found " +
                                py::str(py::type::of(out)).cast<std::string>());
  }
  return py::reinterpret_borrow<py::dict>(out);
}

OutputArray::OutputArray(py::object key, const py::object& out, const py::dtype& dtype,
                         const std::vector<py::ssize_t>& shape, std::size_t samples)
    : key_(std::move(key)), argument_("out[" + py::repr(key_).cast<std::string>() + "]"),
      array_(output_array(key_, argument_, out, dtype, shape)), first_(array_.mutable_data()),
      stride_(sample_stride(array_, samples, argument_)),
      component_stride_(component_stride(array_)) {}

void refuse_overlaps(const NamedArrays& outputs, std::size_t samples, const NamedArrays& inputs) {
  std::vector<std::vector<Column>> columns;
  for (const auto& [argument, array] : outputs) {
    const std::vector<Column> mine = columns_of(array, samples);
    for (const auto& [input_name, input] : inputs) {
      const auto meet = [](const Column& a, const Column& b) { return a.meets(b); };
      if (any_pair(mine, columns_of(input, static_cast<std::size_t>(input.ndim())), meet)) {
        throw_value_error(argument, "overlaps " + input_name);
      }
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto collide = [](const Column& a, const Column& b) { return a.collides(b); };
      if (any_pair(mine, columns[k], collide)) {
        throw_value_error(argument, "overlaps " + outputs[k].first);
      }
    }
    columns.push_back(mine);
  }
}

} // namespace simdbezier::python
