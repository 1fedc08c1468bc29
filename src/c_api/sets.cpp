// Packed sets of simdbezier.h, and their error bounds.
#include <simdbezier/bounds.hpp>
#include <simdbezier/flatten.hpp>
#include <simdbezier/rates.hpp>

#include "src/c_api/handles.hpp"
#include "src/c_api/views.hpp"

namespace simdbezier::c_api {
namespace {

constexpr Path kSet{"set"};

static_assert(int{SIMDBEZIER_MOST_DEGREE} == kMostDegree);
static_assert(int{SIMDBEZIER_MOST_COMPONENTS} == kMostComponents);

/// What packing was refused for: an option where no point is at fault.
template <typename PathOf>
void require_packed(const Report& report, PathOf path_of) {
  require_ok(report, [&](Status status) {
    const bool option = status == Status::non_finite_input && report.point < 0;
    return option ? kOptions / "relative_to" : path_of(status);
  });
}

template <typename Set>
void require_member(const Set& set, std::size_t member, const Path& path) {
  require(member < set.size(), SIMDBEZIER_BAD_PATCH_RANGE, path);
}

/// error_bounds() answers with infinities where an instruction set cannot be resolved.
Isa resolved(simdbezier_isa isa) {
  Isa chosen = Isa::automatic;
  require_ok(resolve_isa(isa_of(isa, {"isa"}), chosen), [](Status) { return Path{"isa"}; });
  return chosen;
}

void copy(const ErrorBounds& from, simdbezier_error_bounds_of_patch& to) {
  std::ranges::copy(from.position, to.position);
  std::ranges::copy(from.du, to.du);
  std::ranges::copy(from.dv, to.dv);
}
void copy(const CurveErrorBounds& from, simdbezier_error_bounds_of_curve& to) {
  std::ranges::copy(from.position, to.position);
  std::ranges::copy(from.d1, to.d1);
  std::ranges::copy(from.d2, to.d2);
}

/// error_bounds() of one patch or curve; path: the argument that says which.
template <typename Handle, typename Known>
simdbezier_status bounds_of(const char* function, const Handle* set, std::size_t member,
                            const Path& path, simdbezier_isa isa, Known* bounds) noexcept {
  return answer(function, [&] {
    require_writable(bounds, {"bounds"});
    with_object(set, kSet, [&](const auto& members) {
      require_member(members, member, path);
      Known known{};
      copy(error_bounds(members, member, resolved(isa)), known);
      write(bounds, known);
    });
  });
}

/// position_errors() of patches and of curves.
template <typename Handle>
simdbezier_status errors_of(const char* function, const Handle* set, double* errors,
                            std::size_t length, const simdbezier_options* options) noexcept {
  return answer(function, [&] {
    const std::span<double> out = span_of(errors, length, {"errors"});
    const Options how = call_options_of(options);
    with_object(set, kSet, [&](const auto& members) {
      require_ok(position_errors(members, out, how), [](Status status) {
        return status == Status::output_too_small ? Path{"length"} : kOptions / "isa";
      });
    });
  });
}

/// A number that is asked of a handle; 0 for a null handle.
template <typename Handle, typename Ask>
auto ask(const Handle* handle, Ask question) noexcept
    -> decltype(std::visit(question, handle->of)) {
  return handle == nullptr ? 0 : std::visit(question, handle->of);
}

} // namespace
} // namespace simdbezier::c_api

using namespace simdbezier;
using namespace simdbezier::c_api;

simdbezier_status simdbezier_pack(const simdbezier_nets* nets, size_t length,
                                  simdbezier_scalar scalar, const simdbezier_pack_options* options,
                                  simdbezier_patch_set** set) {
  return answer(__func__, [&] {
    require_place(set, kSet);
    const PackOptions how = pack_options_of(options);
    with_net_array(nets, length, [&]<typename S>(std::span<const ControlNets<S>> views) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        PatchSet<T> packed;
        const Report report = pack(views, packed, how);
        require_packed(report,
                       [&](Status status) { return blamed_nets(status, views, report.item); });
        give(set, std::move(packed));
      });
    });
  });
}

void simdbezier_patch_set_free(simdbezier_patch_set* set) { delete set; }

simdbezier_status simdbezier_pack_curves(const simdbezier_control_curves* curves,
                                         simdbezier_scalar scalar,
                                         const simdbezier_pack_options* options,
                                         simdbezier_curve_set** set) {
  return answer(__func__, [&] {
    require_place(set, kSet);
    const PackOptions how = pack_options_of(options);
    const Path path{"curves"};
    with_view(read(curves, path), [&](const auto& view) {
      with_scalar(scalar, {"scalar"}, [&]<typename T>() {
        CurveSet<T> packed;
        require_packed(pack(view, packed, how),
                       [&](Status status) { return blamed_curves(status, path); });
        give(set, std::move(packed));
      });
    });
  });
}

void simdbezier_curve_set_free(simdbezier_curve_set* set) { delete set; }

// Numbers that sets are asked for; 0 of null.
#define SIMDBEZIER_ASK(result, handle, question)                                                   \
  result simdbezier_##handle##_##question(const simdbezier_##handle* set) {                        \
    return ask(set, [](const auto& of) { return static_cast<result>(of.question()); });            \
  }
SIMDBEZIER_ASK(size_t, patch_set, size)
SIMDBEZIER_ASK(int32_t, patch_set, components)
SIMDBEZIER_ASK(int32_t, patch_set, has_local_origins)
SIMDBEZIER_ASK(size_t, curve_set, size)
SIMDBEZIER_ASK(int32_t, curve_set, degree)
SIMDBEZIER_ASK(int32_t, curve_set, components)
SIMDBEZIER_ASK(int32_t, curve_set, rational)
SIMDBEZIER_ASK(int32_t, curve_set, has_local_origins)

simdbezier_scalar simdbezier_patch_set_scalar(const simdbezier_patch_set* set) {
  return ask(set, []<typename T>(const PatchSet<T>&) { return kScalar<T>; });
}

simdbezier_scalar simdbezier_curve_set_scalar(const simdbezier_curve_set* set) {
  return ask(set, []<typename T>(const CurveSet<T>&) { return kScalar<T>; });
}

simdbezier_status simdbezier_patch_set_shape(const simdbezier_patch_set* set, size_t patch,
                                             simdbezier_patch_shape* shape) {
  return answer(__func__, [&] {
    require_writable(shape, {"shape"});
    with_object(set, kSet, [&](const auto& patches) {
      require_member(patches, patch, {"patch"});
      const PatchShape of = patches.shape(patch);
      write(shape, {0, of.degree_u, of.degree_v, of.components, of.rational ? 1 : 0});
    });
  });
}

simdbezier_status simdbezier_patch_error_bounds(const simdbezier_patch_set* set, size_t patch,
                                                simdbezier_isa isa,
                                                simdbezier_error_bounds_of_patch* bounds) {
  return bounds_of(__func__, set, patch, {"patch"}, isa, bounds);
}

simdbezier_status simdbezier_curve_error_bounds(const simdbezier_curve_set* set, size_t curve,
                                                simdbezier_isa isa,
                                                simdbezier_error_bounds_of_curve* bounds) {
  return bounds_of(__func__, set, curve, {"curve"}, isa, bounds);
}

simdbezier_status simdbezier_largest_position_bound(const simdbezier_patch_set* set,
                                                    simdbezier_isa isa, double* bound) {
  return answer(__func__, [&] {
    require(bound != nullptr, SIMDBEZIER_NULL_OUTPUT, {"bound"});
    with_object(set, kSet, [&](const auto& patches) {
      *bound = largest_position_bound(patches, resolved(isa));
    });
  });
}

simdbezier_status simdbezier_position_errors(const simdbezier_patch_set* set, double* errors,
                                             size_t length, const simdbezier_options* options) {
  return errors_of(__func__, set, errors, length, options);
}

simdbezier_status simdbezier_curve_position_errors(const simdbezier_curve_set* set, double* errors,
                                                   size_t length,
                                                   const simdbezier_options* options) {
  return errors_of(__func__, set, errors, length, options);
}
