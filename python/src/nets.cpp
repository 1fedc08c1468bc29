// Operations on control nets: arrays (patches, rows, columns, components) in and out.
#include <array>
#include <limits>

#include <simdbezier/bounds.hpp>
#include <simdbezier/nets.hpp>

#include "python/src/arguments/calls.hpp"
#include "python/src/module.hpp"

namespace simdbezier::python {
namespace {

/// The nets of an operation, which takes those of one shape.
template <typename S>
const ControlNets<S>& only_one(const PointViews<S, ControlNets>& nets) {
  if (nets.views.size() != 1) {
    throw_value_error("points", "expected one array");
  }
  return nets.views.front();
}

/// A new array for nets like these, but of other degrees.
template <typename S>
py::array_t<S> room_for(const ControlNets<S>& like, int degree_u, int degree_v) {
  const int values = like.components + (like.weights == Weights::none ? 0 : 1);
  return py::array_t<S>(std::vector<py::ssize_t>{static_cast<py::ssize_t>(like.count), degree_v + 1,
                                                 degree_u + 1, values});
}

template <typename S>
MutableNets<S> view_of(py::array_t<S>& array, const ControlNets<S>& like) {
  return MutableNets<S>::packed(
      array.mutable_data(), like.count, static_cast<int>(array.shape(2) - 1),
      static_cast<int>(array.shape(1) - 1), like.components, like.weights);
}

/// What an operation makes of nets: `degrees(nets)` says what the degrees of `count` results are,
/// call(nets, outputs) runs it.
template <std::size_t N, typename Degrees, typename Call>
py::object operate(const GivenPoints& given, Degrees degrees, Call call) {
  const AnyPointViews<ControlNets> any = control_nets(given);
  return std::visit(
      [&]<typename S>(const PointViews<S, ControlNets>& nets) -> py::object {
        const ControlNets<S>& in = only_one(nets);
        const auto [degree_u, degree_v] = degrees(in);
        std::array<py::array_t<S>, N> arrays;
        std::array<MutableNets<S>, N> out;
        for (std::size_t k = 0; k < N; ++k) {
          arrays[k] = room_for(in, degree_u, degree_v);
          out[k] = view_of(arrays[k], in);
        }
        Report report;
        {
          const py::gil_scoped_release release;
          report = call(in, out);
        }
        require_ok(report, nets.weights_argument(), "points");
        if constexpr (N == 1) {
          return given_back(arrays[0], in.weights);
        } else {
          py::tuple results(N);
          for (std::size_t k = 0; k < N; ++k) {
            results[k] = given_back(arrays[k], in.weights);
          }
          return results;
        }
      },
      any);
}

// Degrees of results.
const auto kSame = [](const auto& nets) { return std::pair(nets.degree_u, nets.degree_v); };
const auto kSwapped = [](const auto& nets) { return std::pair(nets.degree_v, nets.degree_u); };
int lowered(int degree) { return degree > 1 ? degree - 1 : 1; }

#define SIMDBEZIER_OPERATION(function, degrees)                                                    \
  [](const py::object& given, const py::object& given_weights, const py::object& form) {           \
    return operate<1>(                                                                             \
        {given, given_weights, form}, degrees,                                                     \
        [](const auto& nets, const auto& out) { return simdbezier::function(nets, out[0]); });     \
  }

py::object elevated(const py::object& points, const py::object& degree_u,
                    const py::object& degree_v, const py::object& weights,
                    const py::object& homogeneous) {
  const auto degrees = [&](const auto& nets) {
    const auto check = [](const py::object& wanted, int found, const char* argument) {
      const std::size_t degree = integer(wanted, 1, argument);
      if (degree < static_cast<std::size_t>(found) || degree > std::size_t{kMostDegree}) {
        throw_value_error(argument, "expected " + std::to_string(found) + " to " +
                                        std::to_string(kMostDegree) + ", found " +
                                        py::str(wanted).cast<std::string>());
      }
      return static_cast<int>(degree);
    };
    const int u = check(degree_u, nets.degree_u, "degree_u");
    return std::pair(u, check(degree_v, nets.degree_v, "degree_v"));
  };
  return operate<1>({points, weights, homogeneous}, degrees, [](const auto& nets, const auto& out) {
    return simdbezier::elevate(nets, out[0]);
  });
}

/// A parameter that nets are cut at.
struct Cut {
  const char* argument;
  double at;

  Cut(const py::object& value, const char* name) : argument(name), at(number(value, name)) {}
};

/// Degrees of parts: those of the whole. Checks the parameters, whose type is that of the points.
template <typename... Cuts>
auto same_cut_at(const Cuts&... cuts) {
  return [cuts...]<typename S>(const ControlNets<S>& nets) {
    constexpr auto kMost = static_cast<double>(std::numeric_limits<S>::max());
    (require_finite(cuts.at, kMost, cuts.argument), ...);
    return kSame(nets);
  };
}

py::object split_in_u(const py::object& points, const py::object& u, const py::object& weights,
                      const py::object& homogeneous) {
  const Cut cut(u, "u");
  return operate<2>({points, weights, homogeneous}, same_cut_at(cut),
                    [&]<typename S>(const ControlNets<S>& nets, const auto& out) {
                      return split_u(nets, static_cast<S>(cut.at), out[0], out[1]);
                    });
}

py::object split_in_v(const py::object& points, const py::object& v, const py::object& weights,
                      const py::object& homogeneous) {
  const Cut cut(v, "v");
  return operate<2>({points, weights, homogeneous}, same_cut_at(cut),
                    [&]<typename S>(const ControlNets<S>& nets, const auto& out) {
                      return split_v(nets, static_cast<S>(cut.at), out[0], out[1]);
                    });
}

py::object split_in_four(const py::object& points, const py::object& u, const py::object& v,
                         const py::object& weights, const py::object& homogeneous) {
  const Cut cut_u(u, "u");
  const Cut cut_v(v, "v");
  return operate<4>({points, weights, homogeneous}, same_cut_at(cut_u, cut_v),
                    [&]<typename S>(const ControlNets<S>& nets, const auto& out) {
                      return split(nets, static_cast<S>(cut_u.at), static_cast<S>(cut_v.at), out);
                    });
}

py::object segment_of(const py::object& points, const py::object& u0, const py::object& u1,
                      const py::object& v0, const py::object& v1, const py::object& weights,
                      const py::object& homogeneous) {
  const Cut low_u(u0, "u0");
  const Cut high_u(u1, "u1");
  const Cut low_v(v0, "v0");
  const Cut high_v(v1, "v1");
  return operate<1>({points, weights, homogeneous}, same_cut_at(low_u, high_u, low_v, high_v),
                    [&]<typename S>(const ControlNets<S>& nets, const auto& out) {
                      const SubPatch<S> piece{static_cast<S>(low_u.at), static_cast<S>(high_u.at),
                                              static_cast<S>(low_v.at), static_cast<S>(high_v.at)};
                      return segment(nets, piece, out[0]);
                    });
}

/// Boxes: (low, high), each (patches, components).
template <typename Call>
py::object boxes(const GivenPoints& given, Call call) {
  const AnyPointViews<ControlNets> any = control_nets(given);
  return std::visit(
      [&]<typename S>(const PointViews<S, ControlNets>& nets) -> py::object {
        const ControlNets<S>& in = only_one(nets);
        const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(in.count), in.components};
        py::array_t<S> low(shape);
        py::array_t<S> high(shape);
        const Boxes<S> out{low.mutable_data(), high.mutable_data()};
        Report report;
        {
          const py::gil_scoped_release release;
          report = call(in, out);
        }
        require_ok(report, nets.weights_argument(), "points");
        return py::make_tuple(low, high);
      },
      any);
}

py::object tight_boxes_of(const py::object& points, const py::object& levels,
                          const py::object& weights, const py::object& homogeneous) {
  const std::size_t depth = integer(levels, 0, "levels");
  if (depth > kMostBoxLevels) {
    throw_value_error("levels", "expected 0 to " + std::to_string(kMostBoxLevels));
  }
  return boxes({points, weights, homogeneous}, [&](const auto& nets, const auto& out) {
    return tight_boxes(nets, static_cast<int>(depth), out);
  });
}

py::object flatness_of(const py::object& points, const py::object& weights,
                       const py::object& homogeneous) {
  const AnyPointViews<ControlNets> any = control_nets({points, weights, homogeneous});
  return std::visit(
      [&]<typename S>(const PointViews<S, ControlNets>& nets) -> py::object {
        const ControlNets<S>& in = only_one(nets);
        py::array_t<S> values(static_cast<py::ssize_t>(in.count));
        const Values<S> out(values.mutable_data());
        Report report;
        {
          const py::gil_scoped_release release;
          report = flatness(in, out);
        }
        require_ok(report, nets.weights_argument(), "points");
        return values;
      },
      any);
}

} // namespace

void add_nets(py::module_& module) {
  const auto points = py::arg("points");
  const auto weights = py::arg("weights") = py::none();
  const py::kw_only named;
  const auto homogeneous = py::arg("homogeneous") = false;
  define(module, "elevate", &elevated, points, py::arg("degree_u"), py::arg("degree_v"), weights,
         named, homogeneous, "The same patches with higher degrees.");
  define(module, "reverse_u", SIMDBEZIER_OPERATION(reverse_u, kSame), points, weights, named,
         homogeneous, "The same surfaces, run through backwards in u.");
  define(module, "reverse_v", SIMDBEZIER_OPERATION(reverse_v, kSame), points, weights, named,
         homogeneous, "The same surfaces, run through backwards in v.");
  define(module, "transpose", SIMDBEZIER_OPERATION(transpose, kSwapped), points, weights, named,
         homogeneous, "The same surfaces with u and v exchanged.");
  const auto lower_u = [](const auto& nets) {
    return std::pair(lowered(nets.degree_u), nets.degree_v);
  };
  const auto lower_v = [](const auto& nets) {
    return std::pair(nets.degree_u, lowered(nets.degree_v));
  };
  define(
      module, "hodograph_u",
      [lower_u](const py::object& p) {
        return operate<1>(
            {p, py::none(), py::bool_(false)}, lower_u,
            [](const auto& nets, const auto& out) { return hodograph_u(nets, out[0]); });
      },
      points, "Control points of dS/du.");
  define(
      module, "hodograph_v",
      [lower_v](const py::object& p) {
        return operate<1>(
            {p, py::none(), py::bool_(false)}, lower_v,
            [](const auto& nets, const auto& out) { return hodograph_v(nets, out[0]); });
      },
      points, "Control points of dS/dv.");
  define(module, "split_u", &split_in_u, points, py::arg("u") = 0.5, weights, named, homogeneous,
         "Cuts every patch at u: (low, high).");
  define(module, "split_v", &split_in_v, points, py::arg("v") = 0.5, weights, named, homogeneous,
         "Cuts every patch at v: (low, high).");
  define(module, "split", &split_in_four, points, py::arg("u") = 0.5, py::arg("v") = 0.5, weights,
         named, homogeneous, "Cuts every patch in four: element 2 * (v half) + (u half).");
  define(module, "segment", &segment_of, points, py::arg("u0"), py::arg("u1"), py::arg("v0"),
         py::arg("v1"), weights, named, homogeneous,
         "The piece of every patch over [u0, u1] x [v0, v1].");
  define(
      module, "control_boxes",
      [](const py::object& p, const py::object& w, const py::object& form) {
        return boxes({p, w, form},
                     [](const auto& nets, const auto& out) { return control_boxes(nets, out); });
      },
      points, weights, named, homogeneous, "Boxes of the control points: (low, high).");
  define(module, "tight_boxes", &tight_boxes_of, points, py::arg("levels") = 2, weights, named,
         homogeneous, "Certified boxes of the surfaces: (low, high).");
  define(module, "flatness", &flatness_of, points, weights, named, homogeneous,
         "Certified distances from the bilinear patches of the corners.");
}

} // namespace simdbezier::python
