// Operations on control nets of simdbezier.h.
#include <simdbezier/bounds.hpp>
#include <simdbezier/nets.hpp>

#include "src/c_api/views.hpp"
#include "src/nets/net_call.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kNets{"nets"};
constexpr Path kOut{"out"};

static_assert(SIMDBEZIER_BASIS_B_SPLINE == static_cast<int>(Basis::b_spline));
static_assert(int{SIMDBEZIER_MOST_BOX_LEVELS} == kMostBoxLevels);

/// What an operation was refused for: faults of outputs are those of `out`. What nets and outputs
/// may both have is an output's fault where the nets are sound.
Path blamed_in(Status status, bool sound, const Path& out) {
  return blamed(status,
                {{{Status::null_output, Status::output_too_small, Status::overlapping_outputs,
                   Status::bad_patch_range},
                  blamed_nets(status, out)},
                 {{Status::bad_components},
                  sound ? out / "components or weights" : blamed_nets(status, kNets)},
                 {{Status::bad_degree, Status::bad_stride, Status::size_overflow},
                  blamed_nets(status, sound ? out : kNets)}},
                blamed_nets(status, kNets));
}

/// body(ControlNets<T>, options) of the nets' type; `out` names the outputs.
template <typename Body>
simdbezier_status operate(const char* function, const simdbezier_nets* nets,
                          const simdbezier_options* options, const Path& out, Body body) noexcept {
  return answer(function, [&] {
    const auto given = read(nets, kNets);
    const Options how = call_options_of(options);
    with_view(given, [&](const auto& in) {
      require_ok(body(in, how), [&](Status status) {
        return blamed_in(status, detail::check_input(in) == Status::ok, out);
      });
    });
  });
}

template <typename T>
MutableNets<T> written_to(const simdbezier_mutable_nets* out, const Path& path) {
  require(out != nullptr, SIMDBEZIER_NULL_OUTPUT, path);
  return view_of<T>(read(out, path));
}

/// The operations from nets to nets that take no further arguments.
template <typename Call>
simdbezier_status operate(const char* function, const simdbezier_nets* nets,
                          const simdbezier_mutable_nets* out, const simdbezier_options* options,
                          Call call) noexcept {
  return operate(function, nets, options, kOut,
                 [&]<typename T>(const ControlNets<T>& in, const Options& how) {
                   return call(in, written_to<T>(out, kOut), how);
                 });
}

template <typename Call>
simdbezier_status split_in_two(const char* function, const simdbezier_nets* nets,
                               const simdbezier_parameter& at, const Path& path,
                               const simdbezier_mutable_nets* low,
                               const simdbezier_mutable_nets* high,
                               const simdbezier_options* options, Call call) noexcept {
  return operate(function, nets, options, {"low or high"},
                 [&]<typename T>(const ControlNets<T>& in, const Options& how) {
                   return call(in, parameter_of<T>(at, path), written_to<T>(low, {"low"}),
                               written_to<T>(high, {"high"}), how);
                 });
}

template <typename Call>
simdbezier_status change_basis(const char* function, simdbezier_basis basis,
                               const simdbezier_nets* nets, const simdbezier_mutable_nets* out,
                               const simdbezier_options* options, Call call) noexcept {
  return operate(function, nets, options, kOut,
                 [&]<typename T>(const ControlNets<T>& in, const Options& how) {
                   const auto from = choice(basis, Basis::b_spline, {"basis"});
                   const MutableNets<T> to = written_to<T>(out, kOut);
                   const auto report = call(from, in, to, how);
                   const bool alike = to.degree_u == in.degree_u && to.degree_v == in.degree_v;
                   require(!alike || report.status != Status::bad_degree, SIMDBEZIER_BAD_DEGREE,
                           kNets / "degree_u or degree_v"); // of another basis than powers
                   return report;
                 });
}

template <typename Call>
simdbezier_status boxes(const char* function, const simdbezier_nets* nets, simdbezier_values low,
                        simdbezier_values high, const simdbezier_options* options,
                        Call call) noexcept {
  return operate(function, nets, options, {"low or high"},
                 [&]<typename T>(const ControlNets<T>& in, const Options& how) {
                   const Boxes<T> out{output_of<T>(low, {"low"}), output_of<T>(high, {"high"})};
                   return call(in, out, how);
                 });
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

// Overloads and templates cannot be handed over as they are.
#define SIMDBEZIER_CALL(function)                                                                  \
  [](const auto&... arguments) { return simdbezier::function(arguments...); }

simdbezier_status simdbezier_split_u(const simdbezier_nets* nets, simdbezier_parameter u,
                                     const simdbezier_mutable_nets* low,
                                     const simdbezier_mutable_nets* high,
                                     const simdbezier_options* options) {
  return split_in_two(__func__, nets, u, {"u"}, low, high, options, SIMDBEZIER_CALL(split_u));
}

simdbezier_status simdbezier_split_v(const simdbezier_nets* nets, simdbezier_parameter v,
                                     const simdbezier_mutable_nets* low,
                                     const simdbezier_mutable_nets* high,
                                     const simdbezier_options* options) {
  return split_in_two(__func__, nets, v, {"v"}, low, high, options, SIMDBEZIER_CALL(split_v));
}

simdbezier_status simdbezier_split(const simdbezier_nets* nets, simdbezier_parameter u,
                                   simdbezier_parameter v, const simdbezier_mutable_nets* out,
                                   const simdbezier_options* options) {
  return operate(
      __func__, nets, options, kOut, [&]<typename T>(const ControlNets<T>& in, const Options& how) {
        require(out != nullptr, SIMDBEZIER_NULL_OUTPUT, kOut);
        std::array<MutableNets<T>, 4> quarters;
        for (std::size_t k = 0; k < 4; ++k) {
          quarters[k] = view_of<T>(read_element(out, k, "out"));
        }
        return split(in, parameter_of<T>(u, {"u"}), parameter_of<T>(v, {"v"}), quarters, how);
      });
}

simdbezier_status simdbezier_segment(const simdbezier_nets* nets, simdbezier_parameter u0,
                                     simdbezier_parameter u1, simdbezier_parameter v0,
                                     simdbezier_parameter v1, const simdbezier_mutable_nets* out,
                                     const simdbezier_options* options) {
  return operate(
      __func__, nets, options, kOut, [&]<typename T>(const ControlNets<T>& in, const Options& how) {
        const SubPatch<T> piece{parameter_of<T>(u0, {"u0"}), parameter_of<T>(u1, {"u1"}),
                                parameter_of<T>(v0, {"v0"}), parameter_of<T>(v1, {"v1"})};
        return segment(in, piece, written_to<T>(out, kOut), how);
      });
}

// The operations from nets to nets that take no further arguments.
#define SIMDBEZIER_OPERATION(operation)                                                            \
  simdbezier_status simdbezier_##operation(const simdbezier_nets* nets,                            \
                                           const simdbezier_mutable_nets* out,                     \
                                           const simdbezier_options* options) {                    \
    return operate(__func__, nets, out, options, SIMDBEZIER_CALL(operation));                      \
  }
SIMDBEZIER_OPERATION(elevate)
SIMDBEZIER_OPERATION(hodograph_u)
SIMDBEZIER_OPERATION(hodograph_v)
SIMDBEZIER_OPERATION(reverse_u)
SIMDBEZIER_OPERATION(reverse_v)
SIMDBEZIER_OPERATION(transpose)

simdbezier_status simdbezier_to_bezier(simdbezier_basis basis, const simdbezier_nets* nets,
                                       const simdbezier_mutable_nets* out,
                                       const simdbezier_options* options) {
  return change_basis(__func__, basis, nets, out, options, SIMDBEZIER_CALL(to_bezier));
}

simdbezier_status simdbezier_from_bezier(simdbezier_basis basis, const simdbezier_nets* nets,
                                         const simdbezier_mutable_nets* out,
                                         const simdbezier_options* options) {
  return change_basis(__func__, basis, nets, out, options, SIMDBEZIER_CALL(from_bezier));
}

simdbezier_status simdbezier_control_boxes(const simdbezier_nets* nets, simdbezier_values low,
                                           simdbezier_values high,
                                           const simdbezier_options* options) {
  return boxes(__func__, nets, low, high, options, SIMDBEZIER_CALL(control_boxes));
}

simdbezier_status simdbezier_tight_boxes(const simdbezier_nets* nets, int32_t levels,
                                         simdbezier_values low, simdbezier_values high,
                                         const simdbezier_options* options) {
  return boxes(__func__, nets, low, high, options,
               [&](const auto& in, const auto& out, const Options& how) {
                 require(levels >= 0 && levels <= kMostBoxLevels, SIMDBEZIER_BAD_GRID, {"levels"});
                 return tight_boxes(in, levels, out, how);
               });
}

simdbezier_status simdbezier_flatness(const simdbezier_nets* nets, simdbezier_values flatness,
                                      const simdbezier_options* options) {
  return operate(__func__, nets, options, {"flatness"},
                 [&]<typename T>(const ControlNets<T>& in, const Options& how) {
                   return simdbezier::flatness(in, output_of<T>(flatness, {"flatness"}), how);
                 });
}
