// Views of nets and curves whose strides lead out of the memory that they come with are refused by
// every call, wherever that memory lies, and nothing outside of it is touched.
#include <algorithm>
#include <functional>

#include <sys/mman.h>

#include <gtest/gtest.h>

#include <simdbezier/simdbezier.hpp>

namespace simdbezier::tests::net_memory_test {
namespace {

__extension__ using Wide = __int128;

constexpr std::size_t kValues = 96; // two bicubic nets
constexpr std::size_t kAround = std::size_t{1} << 21;

/// Values between pages without access, at a low address or wherever the system likes. The way
/// down from a low one is short, so small strides lead past the beginning of the address space.
class Region {
public:
  explicit Region(bool low) {
    void* const wanted = low ? reinterpret_cast<void*>(std::size_t{1} << 22) : nullptr;
    all_ =
        mmap(wanted, 2 * kAround, PROT_NONE,
             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | (low ? MAP_FIXED_NOREPLACE : 0), -1, 0);
    if (all_ == MAP_FAILED) {
      return;
    }
    void* const middle = static_cast<char*>(all_) + kAround;
    EXPECT_EQ(mprotect(middle, 4096, PROT_READ | PROT_WRITE), 0);
    // At the end of the page: a value further begins the pages without access.
    values_ = {static_cast<float*>(middle) + 1024 - kValues, kValues};
    for (std::size_t k = 0; k < kValues; ++k) {
      values_[k] = 1 + static_cast<float>(k * k % 37) / 37;
    }
  }
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;
  ~Region() {
    if (all_ != MAP_FAILED) {
      munmap(all_, 2 * kAround);
    }
  }
  [[nodiscard]] bool is_there() const { return all_ != MAP_FAILED; }
  [[nodiscard]] std::span<float> values() const { return values_; }

private:
  void* all_ = MAP_FAILED;
  std::span<float> values_;
};

/// Room for whatever calls write.
struct Room {
  std::vector<float> floats = std::vector<float>(1024);
  std::vector<double> doubles = std::vector<double>(1024);
  std::vector<EdgeLink> links = std::vector<EdgeLink>(512);
  std::vector<std::uint32_t> nu = std::vector<std::uint32_t>(2);
  std::vector<std::uint32_t> nv = std::vector<std::uint32_t>(2);
  std::vector<std::uint16_t> diagonals = std::vector<std::uint16_t>(2);

  [[nodiscard]] MutableNets<float> nets(const ControlNets<float>& like) {
    return MutableNets<float>::packed(std::span<float>(floats), like.count, 3, 3);
  }
};

using Nets = ControlNets<float>;

ControlCurves<float> curves_of(const Nets& nets) {
  return {nets.points,       nets.count,        nets.degree_u,
          nets.patch_stride, nets.point_stride, nets.component_stride,
          nets.components,   nets.weights,      nets.memory};
}

struct Call {
  const char* name;
  bool has_rows; ///< false: a call for curves
  std::function<Status(const Nets&, Room&)> run;
};

/// A call of each way from a view to its values.
const Call kCalls[] = {
    {"pack", true,
     [](const Nets& nets, Room&) {
       PatchSet<double> set;
       return pack(nets, set).status;
     }},
    {"pack, curves", false,
     [](const Nets& nets, Room&) {
       CurveSet<float> set;
       return pack(curves_of(nets), set).status;
     }},
    {"flatten", false,
     [](const Nets& nets, Room&) { return flatten<float>(curves_of(nets), 0.01).report.status; }},
    {"iso_u", true,
     [](const Nets& nets, Room& room) {
       return iso_u(nets, 0.5, Values<double>(std::span(room.doubles))).status;
     }},
    {"find_adjacency", true,
     [](const Nets& nets, Room& room) {
       return find_adjacency(std::span(&nets, 1), Values<EdgeLink>(std::span(room.links)));
     }},
    {"find_topology", true,
     [](const Nets& nets, Room&) {
       Topology topology;
       return find_topology(std::span(&nets, 1), topology);
     }},
    {"certify_grids", true,
     [](const Nets& nets, Room& room) {
       const auto out = std::span(room.doubles).first(std::min<std::size_t>(nets.count, 100));
       return certify_grids(std::span(&nets, 1), 4, 4, {}, out).status;
     }},
    {"tessellate", true,
     [](const Nets& nets, Room&) {
       MeshOptions options;
       options.rates.tolerance = 0.1;
       return tessellate(nets, options).report.status;
     }},
    {"quantisation_box", true,
     [](const Nets& nets, Room&) {
       QuantisationBox box;
       return quantisation_box(std::span(&nets, 1), VertexFormat::unorm16, box);
     }},
    {"tight_boxes", true,
     [](const Nets& nets, Room& room) {
       const std::span<float> all(room.floats);
       return tight_boxes(nets, 2, {all.first(512), all.subspan(512)}).status;
     }},
    {"flatness", true,
     [](const Nets& nets, Room& room) { return flatness(nets, std::span(room.floats)).status; }},
    {"reverse_u", true,
     [](const Nets& nets, Room& room) { return reverse_u(nets, room.nets(nets)).status; }},
    {"to_bezier", true,
     [](const Nets& nets, Room& room) {
       return to_bezier(Basis::b_spline, nets, room.nets(nets)).status;
     }},
    {"reverse_u, output", true, [](const Nets& nets, Room& room) {
       const Nets in = Nets::packed(room.floats.data(), nets.count, 3, 3);
       const MutableNets<float> out{const_cast<float*>(nets.points),
                                    nets.count,
                                    3,
                                    3,
                                    nets.patch_stride,
                                    nets.row_stride,
                                    nets.point_stride,
                                    nets.component_stride,
                                    3,
                                    Weights::none,
                                    {const_cast<float*>(nets.memory.data()), nets.memory.size()}};
       return reverse_u(in, out).status;
     }}};

/// Whether all values lie in the memory, by numbers that never overflow.
bool is_inside(const Nets& nets, bool has_rows) {
  Wide lowest = nets.points - nets.memory.data();
  Wide highest = lowest;
  const auto add = [&](Wide last, Wide stride) {
    (last * stride < 0 ? lowest : highest) += last * stride;
  };
  add(static_cast<Wide>(nets.count) - 1, nets.patch_stride);
  add(has_rows ? nets.degree_v : 0, nets.row_stride);
  add(nets.degree_u, nets.point_stride);
  add(nets.components - 1, nets.component_stride);
  return lowest >= 0 && highest < static_cast<Wide>(nets.memory.size());
}

class NetMemory : public ::testing::TestWithParam<bool> {};

// Every call, stride, sign and magnitude, from both ends of the memory.
TEST_P(NetMemory, IsNotLeft) {
  const Region region(GetParam());
  if (!region.is_there()) {
    GTEST_SKIP() << "no memory at a low address";
  }
  const std::vector<float> before(region.values().begin(), region.values().end());
  Room room;
  std::size_t inside = 0;
  std::size_t outside = 0;
  std::ptrdiff_t Nets::*const strides[] = {&Nets::patch_stride, &Nets::row_stride,
                                           &Nets::point_stride, &Nets::component_stride};
  for (const Call& call : kCalls) {
    const bool writes = std::string(call.name).ends_with("output");
    for (const auto stride : strides) {
      for (int k = 0; k < 2 * 63; ++k) {
        for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{100},
                                        std::size_t{1} << 63, ~std::size_t{0}}) {
          for (const std::size_t first : {std::size_t{0}, std::size_t{48}, kValues - 1}) {
            Nets nets = Nets::packed(region.values());
            nets.points += first;
            nets.count = count;
            nets.*stride = (k % 2 == 0 ? 1 : -1) * (std::ptrdiff_t{1} << k / 2);
            const bool possible = is_inside(nets, call.has_rows);
            ++(possible ? inside : outside);
            if (possible && (writes || count > 2)) {
              continue; // which is another test's
            }
            const Status status = call.run(nets, room);
            EXPECT_TRUE(possible ? status != Status::input_too_small : !status)
                << call.name << ": " << to_string(status) << ", count " << count << ", stride "
                << nets.*stride << ", from value " << first;
          }
        }
      }
    }
  }
  EXPECT_GT(inside, 100U);
  EXPECT_GT(outside, 10000U);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), region.values().begin()));
}

// The way down is longer than the address of the nets, so that it goes on at the upper end of the
// address space. What lies on it is between the nets, as gaps are.
TEST_P(NetMemory, IsNotLeftUnnoticedByOverlaps) {
  const Region region(GetParam());
  if (!region.is_there()) {
    GTEST_SKIP() << "no memory at a low address";
  }
  for (int power = 46; power < 52; ++power) {
    Nets nets = Nets::packed(region.values().data() + 48, 2, 3, 3); // of unknown memory
    nets.patch_stride = -(std::ptrdiff_t{1} << power);
    const std::span<float> below = region.values().first(12);
    EXPECT_EQ(to_string(control_boxes(nets, {below.first(6), below.last(6)}).status),
              to_string(Status::overlapping_outputs));
    EXPECT_EQ(to_string(flatness(nets, below).status), to_string(Status::overlapping_outputs));
  }
}

INSTANTIATE_TEST_SUITE_P(Addresses, NetMemory, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Low" : "High"; });

} // namespace
} // namespace simdbezier::tests::net_memory_test
