// Every call of the C API with arguments that make no sense: what is refused names the argument.
#include <climits>
#include <cmath>
#include <fstream>
#include <set>
#include <string_view>

#include "tests/c_api/support/every_call.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::every_call_test {
namespace {

using World = EveryArgument;

/// One argument, or one member of it, with a value that makes no sense.
struct Spoil {
  std::string name;
  std::function<void(World&)> apply;
};

class Spoils {
public:
  /// Each of the values in each of the places, which are functions from a World to a member.
  template <typename Value, typename... Place>
  void add(const char* names, const std::vector<Value>& values, Place... places) {
    const auto one = [&](auto place) {
      for (const Value value : values) {
        all_.push_back({std::string(names) + " = " + std::to_string(static_cast<double>(value)),
                        [=](World& w) {
                          auto& member = place(w);
                          member = static_cast<std::remove_reference_t<decltype(member)>>(value);
                        }});
      }
    };
    (one(places), ...);
  }
  template <typename... Place>
  void add_null(const char* names, Place... places) {
    (all_.push_back({names, [=](World& w) { places(w) = nullptr; }}), ...);
  }
  template <typename... Place>
  void add_gone(const char* names, Place... places) {
    (all_.push_back({names, [=](World& w) { w.gone = places(w); }}), ...);
  }
  [[nodiscard]] const std::vector<Spoil>& all() const { return all_; }

private:
  std::vector<Spoil> all_;
};

#define IN(member)                                                                                 \
  [](World & w) -> auto& { return w.member; }
#define AT(member) [](World& w) -> const void* { return &w.member; }

Spoils make_spoils() {
  Spoils spoils;
  const std::vector<int> numbers = {-1, 0, 1, 2, 3, 5, 15, 16, 17, 99, INT_MIN, INT_MAX};
  const std::vector<int> names = {-1, 2, 3, 4, 5, 6, 7, 99, INT_MIN, INT_MAX};
  const std::vector<int> scalars = {-1, 0, 3, 99, INT_MIN, INT_MAX}; // the memory holds floats
  const std::vector<double> reals = {NAN, INFINITY, -INFINITY, -1, 0, 1e-300, 1e300};
  const std::vector<std::size_t> lengths = {0, 1, 2};
  constexpr auto kBit = [](int k) { return std::size_t{1} << k; };
  const std::vector<std::size_t> counts = {0,        1,        3,        4,       kBit(40),
                                           kBit(52), kBit(62), kBit(63), SIZE_MAX};
  const std::vector<std::size_t> samples = {0, 1, kBit(62), kBit(63), SIZE_MAX};
  const std::vector<std::uint32_t> cells = {0, 1, 4098, 1U << 31, UINT32_MAX};
  const std::vector<std::ptrdiff_t> records = {-1, 0, 1, 2, PTRDIFF_MIN, PTRDIFF_MAX};
  std::vector<std::ptrdiff_t> strides;
  for (int k = 0; k < 63; k += 5) {
    strides.insert(strides.end(), {std::ptrdiff_t{1} << k, -(std::ptrdiff_t{1} << k)});
  }
  spoils.add("struct_size", std::vector<std::size_t>{0, 4, 4104, SIZE_MAX}, IN(nets.struct_size),
             IN(curves.struct_size), IN(low.struct_size), IN(high.struct_size),
             IN(spline.struct_size), IN(spline_curve.struct_size), IN(places.struct_size),
             IN(pack_options.struct_size), IN(options.struct_size), IN(grid.struct_size),
             IN(grids.struct_size), IN(samples.struct_size), IN(out.struct_size),
             IN(curve_grid.struct_size), IN(curve_grids.struct_size), IN(curve_samples.struct_size),
             IN(curve_out.struct_size), IN(derivative.struct_size), IN(format.struct_size),
             IN(edge.struct_size), IN(flatten_options.struct_size), IN(rates.struct_size),
             IN(rate_options.struct_size), IN(topology_options.struct_size),
             IN(mesh_options.struct_size), IN(camera.struct_size), IN(formatted.struct_size),
             IN(mesh_out.struct_size), IN(primitives.struct_size), IN(topology_counts.struct_size),
             IN(shape.struct_size), IN(patch_bounds.struct_size), IN(curve_bounds.struct_size),
             IN(mesh_arrays.struct_size), IN(plan_parts.struct_size),
             IN(polyline_arrays.struct_size), IN(quarters[2].struct_size));
  spoils.add("a number", numbers, IN(nets.degree_u), IN(nets.degree_v), IN(nets.components),
             IN(curves.degree), IN(curves.components), IN(low.degree_u), IN(low.degree_v),
             IN(low.components), IN(high.degree_u), IN(quarters[3].components),
             IN(slope_u.degree_u), IN(spline.components), IN(spline.degree_u), IN(spline.degree_v),
             IN(spline_curve.degree), IN(spline_curve.components), IN(derivative.order_u),
             IN(derivative.order_v), IN(first_component), IN(out.first_component),
             IN(curve_out.first_component), IN(format.first_component), IN(levels),
             IN(u.denominator), IN(v.denominator));
  spoils.add("an enumeration", names, IN(nets.weights), IN(curves.weights), IN(low.weights),
             IN(spline.weights), IN(spline_curve.weights), IN(options.isa), IN(pack_options.isa),
             IN(rate_options.isa), IN(mesh_options.isa), IN(isa), IN(options.destination),
             IN(primitives.destination), IN(grid.parameters), IN(samples.parameters),
             IN(curve_grid.parameters), IN(curve_samples.parameters), IN(format.layout),
             IN(format.outputs), IN(side), IN(basis), IN(as), IN(formatted.position.format),
             IN(formatted.normal.format), IN(formatted.parameters.format));
  spoils.add("a scalar", scalars, IN(nets.scalar), IN(curves.scalar), IN(low.scalar),
             IN(high.scalar), IN(spline.scalar), IN(spline_curve.scalar), IN(pieces.scalar),
             IN(scalar), IN(samples.scalar), IN(curve_samples.scalar), IN(out.position.scalar),
             IN(out.gaussian.scalar), IN(curve_out.tangent.scalar), IN(derivative.out.scalar),
             IN(mesh_out.position.scalar), IN(low_corners.scalar), IN(high_corners.scalar));
  spoils.add("a length", lengths, IN(nets.length), IN(curves.length), IN(low.length),
             IN(high.length), IN(spline.length), IN(spline.knots_u_length),
             IN(spline.knots_v_length), IN(spline_curve.length), IN(spline_curve.knots_length),
             IN(places.length), IN(pieces.length), IN(intervals_length), IN(spline_length),
             IN(samples.patch_length), IN(samples.u_length), IN(samples.v_length),
             IN(grids.nu_length), IN(grids.nv_length), IN(grid.u_length), IN(grid.v_length),
             IN(grids.offset_length), IN(curve_grids.n_length), IN(curve_grids.offset_length),
             IN(curve_grid.t_length), IN(curve_samples.curve_length), IN(curve_samples.t_length),
             IN(out.position.capacity), IN(out.normal.capacity), IN(out.gaussian.length),
             IN(out.status_length), IN(curve_out.position.capacity), IN(curve_out.curvature.length),
             IN(curve_out.status_length), IN(derivative.out.capacity), IN(low_corners.length),
             IN(high_corners.length), IN(doubles_length), IN(links_length), IN(numbers_length),
             IN(keys_length), IN(owned_length), IN(indices_length), IN(sizes_length),
             IN(clusters_length), IN(rates.cells_u_length), IN(rates.cells_v_length),
             IN(rates.diagonals_length), IN(rates.deviation_length),
             IN(rate_options.tolerances_length), IN(rate_options.errors_length),
             IN(flatten_options.tolerances_length), IN(flatten_options.errors_length),
             IN(mesh_options.tolerances_length), IN(mesh_out.position.capacity),
             IN(formatted.position.capacity), IN(formatted.normal.capacity), IN(views));
  spoils.add("a count", counts, IN(nets.count), IN(curves.count), IN(low.count), IN(high.count),
             IN(spline.rows), IN(spline.columns), IN(spline_curve.count), IN(grid.first_patch),
             IN(grid.patch_count), IN(grids.first_patch), IN(curve_grid.first_curve),
             IN(curve_grid.curve_count), IN(curve_grids.first_curve), IN(first_patch),
             IN(patch_count), IN(primitives.first_patch), IN(primitives.patch_count), IN(which),
             IN(own_first), IN(own_count));
  std::vector<std::size_t> long_arrays = {kBit(62), SIZE_MAX};
#ifndef __SANITIZE_ADDRESS__ // which ends the process instead of refusing so much memory
  long_arrays.push_back(kBit(46));
#endif
  spoils.add("a long array", long_arrays, IN(views));
  spoils.add("samples", samples, IN(grid.nu), IN(grid.nv), IN(curve_grid.n), IN(format.samples));
  spoils.add("cells", cells, IN(counts[0]), IN(eight[3]), IN(patch[1]), IN(nu[0]), IN(nv[1]),
             IN(cells), IN(mesh_options.nu), IN(mesh_options.nv), IN(rate_options.most_segments),
             IN(flatten_options.most_points), IN(diagonals[1]));
  spoils.add("first", strides, IN(nets.first), IN(spline.first), IN(spline_curve.first),
             IN(curves.first), IN(low.first), IN(high.first));
  spoils.add("a stride", strides, IN(nets.net_stride), IN(nets.row_stride), IN(nets.point_stride),
             IN(nets.component_stride), IN(curves.curve_stride), IN(curves.point_stride),
             IN(curves.component_stride), IN(low.net_stride), IN(low.row_stride),
             IN(low.point_stride), IN(low.component_stride), IN(high.net_stride),
             IN(quarters[3].net_stride), IN(slope_v.row_stride), IN(spline.row_stride),
             IN(spline.point_stride), IN(spline.component_stride), IN(spline_curve.point_stride),
             IN(spline_curve.component_stride));
  spoils.add("records", records, IN(out.position.stride), IN(out.normal.stride),
             IN(curve_out.position.stride), IN(derivative.out.stride), IN(mesh_out.position.stride),
             IN(formatted.position.stride), IN(formatted.parameters.stride));
  spoils.add("a real number", reals, IN(number), IN(knots[4]), IN(knots[8]), IN(spline.u_begin),
             IN(spline.v_end), IN(spline.knot_tolerance), IN(spline_curve.end),
             IN(spline_curve.knot_tolerance), IN(spline_u[1]), IN(spline_v[0]), IN(u.value),
             IN(v.value), IN(flatten_options.tolerance), IN(rate_options.tolerance),
             IN(rate_options.longest_edge), IN(rate_options.normal_degrees),
             IN(topology_options.point_size), IN(topology_options.snap), IN(mesh_options.tolerance),
             IN(mesh_options.relative_tolerance), IN(mesh_options.pixels),
             IN(mesh_options.longest_edge), IN(mesh_options.normal_degrees),
             IN(mesh_options.point_size), IN(mesh_options.snap), IN(mesh_options.crease_degrees),
             IN(camera.focal_length), IN(camera.width), IN(camera.nearest), IN(camera.direction[0]),
             IN(camera.eye[2]), IN(formatted.box.step), IN(pack_options.relative_to[1]),
             IN(numbers[1]), IN(values[5]), IN(values[95]), IN(parameters[1]));
  spoils.add_null("null", IN(nets.points), IN(curves.points), IN(low.points), IN(high.points),
                  IN(spline.points), IN(spline.knots_u), IN(spline_curve.points),
                  IN(spline_curve.knots), IN(places.u), IN(pieces.first), IN(samples.patch),
                  IN(samples.u), IN(samples.v), IN(grids.nu), IN(grids.nv), IN(curve_grids.n),
                  IN(curve_samples.curve), IN(curve_samples.t), IN(out.position.x),
                  IN(out.position.y), IN(out.position.z), IN(out.normal.x), IN(out.normal.z),
                  IN(out.gaussian.first), IN(out.status), IN(curve_out.status),
                  IN(curve_out.position.y), IN(curve_out.tangent.z), IN(curve_out.curvature.first),
                  IN(derivative.out.x), IN(derivative.out.z), IN(rates.cells_u), IN(rates.cells_v),
                  IN(rates.diagonals), IN(rates.deviation), IN(low_corners.first),
                  IN(high_corners.first), IN(mesh_out.position.x), IN(mesh_out.position.y),
                  IN(formatted.position.first), IN(formatted.normal.first));
  spoils.add_gone(
      "gone", AT(nets), AT(curves), AT(low), AT(high), AT(quarters[0]), AT(slope_u), AT(slope_v),
      AT(spline), AT(spline_curve), AT(spline_u[0]), AT(spline_v[0]), AT(intervals[0]),
      AT(curve_intervals[0]), AT(places), AT(spans_u), AT(spans_v), AT(pack_options), AT(options),
      AT(grid), AT(grids), AT(samples), AT(out), AT(curve_grid), AT(curve_grids), AT(curve_samples),
      AT(curve_out), AT(derivative), AT(format), AT(edge), AT(flatten_options), AT(rates),
      AT(rate_options), AT(topology_options), AT(mesh_options), AT(camera), AT(formatted),
      AT(mesh_out), AT(mesh_out.position), AT(primitives), AT(topology_counts), AT(fits), AT(shape),
      AT(patch_bounds), AT(curve_bounds), AT(mesh_arrays), AT(plan_parts), AT(polyline_arrays),
      AT(bound), AT(doubles[0]), AT(isa_found), AT(isa_name[0]), AT(which), AT(counted[0]),
      AT(links[0]), AT(keys[0]), AT(owned[0]), AT(part_numbers[0]), AT(numbers[0]),
      AT(deviation[0]), AT(indices[0]), AT(short_indices[0]), AT(sizes[0]), AT(clusters[0]),
      AT(polygons), AT(corners), AT(vertices_found), AT(box), AT(made), AT(made_curves),
      AT(made_topology), AT(made_layout), AT(made_mesh), AT(made_plan), AT(made_polylines),
      [](World& w) { return static_cast<const void*>(w.set.get()); },
      [](World& w) { return static_cast<const void*>(w.curve_set.get()); },
      [](World& w) { return static_cast<const void*>(w.topology); },
      [](World& w) { return static_cast<const void*>(w.layout); },
      [](World& w) { return static_cast<const void*>(w.mesh); },
      [](World& w) { return static_cast<const void*>(w.planned); },
      [](World& w) { return static_cast<const void*>(w.polylines); });
  return spoils;
}

/// Runs every call; returns how many were refused. Whatever is refused names an argument, but for
/// memory that is not there.
std::size_t run_all(World& world, const std::string& spoiled) {
  std::size_t refused = 0;
  for (const CCall& call : kEveryCall) {
    const simdbezier_status status = call.run(world);
    auto fault = sized<simdbezier_fault>();
    EXPECT_EQ(simdbezier_last_fault(&fault), SIMDBEZIER_OK);
    EXPECT_EQ(fault.status, status) << call.name;
    refused += status == SIMDBEZIER_OK ? 0 : 1;
    if (status != SIMDBEZIER_OK && status != SIMDBEZIER_OUT_OF_MEMORY) {
      EXPECT_STREQ(fault.function, call.name);
      EXPECT_STRNE(fault.argument, "") << simdbezier_last_message() << " where " << spoiled;
    }
  }
  return refused;
}

TEST(EveryCCall, IsInTheTable) {
  std::set<std::string> known = {"simdbezier_available_isas",
                                 "simdbezier_curve_grid_sample_count",
                                 "simdbezier_curve_grids_sample_count",
                                 "simdbezier_format_bytes",
                                 "simdbezier_fuses_multiply_add",
                                 "simdbezier_grid_sample_count",
                                 "simdbezier_isa_name",
                                 "simdbezier_take_executed_isa",
                                 "simdbezier_largest_tile",
                                 "simdbezier_last_fault",
                                 "simdbezier_last_message",
                                 "simdbezier_patch_grids_sample_count",
                                 "simdbezier_status_text",
                                 "simdbezier_to_centred_f32",
                                 "simdbezier_to_centred_f64",
                                 "simdbezier_topology_is_entangled",
                                 "simdbezier_topology_is_repeated",
                                 "simdbezier_topology_is_turned",
                                 "simdbezier_version"}; // they return no status of their own
  for (const CCall& call : kEveryCall) {
    EXPECT_TRUE(known.insert(call.name).second) << call.name;
  }
  std::ifstream list(SIMDBEZIER_ABI_LIST);
  for (std::string name; list >> name && name != "struct";) {
    const bool asks = name.ends_with("_free") || name.find("_set_") < name.find("_shape") ||
                      name.find("mesh_layout_") != std::string::npos;
    EXPECT_TRUE(asks || known.count(name) == 1) << name;
    known.erase(name);
  }
  EXPECT_TRUE(list.good());
  EXPECT_TRUE(known.empty()) << *known.begin();
}

TEST(EveryCCall, IsDoneWhereNothingIsSpoiled) {
  World world;
  EXPECT_EQ(run_all(world, "nothing is spoiled"), 0U) << simdbezier_last_message();
}

TEST(EveryCCall, NamesTheArgumentThatIsSpoiled) {
  const Spoils spoils = make_spoils();
  for (const Spoil& one : spoils.all()) {
    World world;
    one.apply(world);
    run_all(world, one.name);
  }
}

TEST(EveryCCall, NamesOneOfTwoThatAreSpoiled) {
  const Spoils made = make_spoils();
  const std::vector<Spoil>& spoils = made.all();
  const std::size_t share = by_form<std::size_t>(6000, 100);
  Random random(57);
  for (std::size_t left = spoils.size() * spoils.size() / share; left > 0; --left) {
    const Spoil& one = spoils[random.below(spoils.size())];
    const Spoil& other = spoils[random.below(spoils.size())];
    World world;
    one.apply(world);
    other.apply(world);
    run_all(world, one.name + " and " + other.name);
  }
}

/// A description whose memory is known, and what faults in it are called.
struct Described {
  const char* name;
  std::vector<std::string_view> arguments;
  std::vector<std::function<std::ptrdiff_t&(World&)>> strides;
  std::function<const void*(World&)> place;
};

#define STRIDE(member) [](World& w) -> std::ptrdiff_t& { return w.member; }
#define STRIDES(nets)                                                                              \
  {                                                                                                \
    STRIDE(nets.net_stride), STRIDE(nets.row_stride), STRIDE(nets.point_stride),                   \
        STRIDE(nets.component_stride)                                                              \
  }

// Strides of any size and sign lead out of the memory, at whatever end: no call follows them.
TEST(EveryCCall, StaysInTheMemoryThatItIsGiven) {
  const Described described[] = {
      {"nets", {"nets"}, STRIDES(nets), AT(nets)},
      {"curves",
       {"curves"},
       {STRIDE(curves.curve_stride), STRIDE(curves.point_stride), STRIDE(curves.component_stride)},
       AT(curves)},
      {"spline",
       {"surfaces"},
       {STRIDE(spline.row_stride), STRIDE(spline.point_stride), STRIDE(spline.component_stride)},
       AT(intervals[0])},
      {"spline_curve",
       {"curve"},
       {STRIDE(spline_curve.point_stride), STRIDE(spline_curve.component_stride)},
       AT(curve_intervals[0])},
      {"low", {"low", "out"}, STRIDES(low), AT(low)},
      {"high", {"low or high", "high"}, STRIDES(high), AT(high)},
      {"slope_u", {"out"}, STRIDES(slope_u), AT(slope_u)},
      {"slope_v", {"out"}, STRIDES(slope_v), AT(slope_v)},
      {"quarters", {"out"}, STRIDES(quarters[0]), AT(quarters[0])}};
  for (const Described& one : described) {
    std::vector<const CCall*> users;
    for (const CCall& call : kEveryCall) {
      World world;
      world.gone = one.place(world);
      if (call.run(world) != SIMDBEZIER_OK) {
        users.push_back(&call);
      }
    }
    EXPECT_FALSE(users.empty()) << one.name;
    for (const auto& stride : one.strides) {
      for (int power = 7; power < 63; ++power) {
        for (const int sign : {1, -1}) {
          World world;
          stride(world) = sign * (std::ptrdiff_t{1} << power);
          for (const CCall* const call : users) {
            EXPECT_NE(call->run(world), SIMDBEZIER_OK) << call->name << ", 2^" << power;
            const std::string_view message = simdbezier_last_message();
            const auto named = [&](std::string_view argument) {
              return message.substr(message.find(": ") + 2).starts_with(argument);
            };
            EXPECT_TRUE(std::ranges::any_of(one.arguments, named)) << message;
          }
          EXPECT_EQ(std::ranges::count(world.room, -7.0F), std::ssize(world.room)) << one.name;
        }
      }
    }
  }
}

// The case that was reported: the way down from the first net is longer than its address.
TEST(EveryCCall, StaysInTheMemoryOfManyNets) {
  for (int power = 8; power < 60; ++power) {
    World world;
    world.nets.count = world.low.count = world.curves.count = 100;
    world.nets.net_stride = world.low.net_stride = world.curves.curve_stride =
        -(std::ptrdiff_t{1} << power);
    EXPECT_NE(world.pack(), SIMDBEZIER_OK) << power;
    EXPECT_NE(world.join(), SIMDBEZIER_OK) << power;
    EXPECT_NE(world.tessellate(), SIMDBEZIER_OK) << power;
    EXPECT_NE(simdbezier_pack_curves(&world.curves, SIMDBEZIER_F32, nullptr, &world.made_curves),
              SIMDBEZIER_OK)
        << power;
    EXPECT_NE(simdbezier_reverse_u(&world.nets, &world.low, nullptr), SIMDBEZIER_OK) << power;
  }
}

} // namespace
} // namespace simdbezier::tests::every_call_test
