// Boxes, flatness and adjacency: equal bits on all instruction sets and for any strides, bounds
// that hold, edges that a plain comparison finds as well.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/run_case.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"
#include "tests/reliability/fuzz/inputs/hostile.hpp"
#include "tests/reliability/fuzz/inputs/made_grids.hpp"

namespace simdbezier::fuzz {
namespace {

template <typename T>
class MeasureCase {
public:
  explicit MeasureCase(ByteSource& bytes)
      : bytes_(bytes), levels_(bytes.between(0, 3)),
        nets_(any_nets<T>(bytes, 12, components(bytes))) {}

  void run() {
    const Arrangement arrangement(bytes_);
    StridedNets<T> strided(nets_, arrangement, placement(bytes_));
    strided.fill(nets_.values);
    std::optional<Measures> expected;
    for (const Isa isa : available_isas()) {
      Measures measures(*this, isa == available_isas().front() ? nets_.view() : strided.view(),
                        with({}, isa, isa == Isa::sse2 ? 2 : 1));
      if (!expected) {
        expected.emplace(std::move(measures));
      } else {
        measures.require_same(*expected, isa);
      }
    }
    if (expected->status == Status::ok) {
      judge(*expected);
    }
    adjacency();
    hostile();
  }

private:
  /// What is measured of all patches.
  struct Measures {
    Measures(MeasureCase& from, const ControlNets<T>& nets, const Options& options) {
      const std::size_t values = nets.count * static_cast<std::size_t>(nets.components);
      const Placement place = placement(from.bytes_);
      for (std::size_t k = 0; k < 4; ++k) {
        boxes.emplace_back(values, place, T(-7));
      }
      flat.emplace(nets.count, place, T(-7));
      status = control_boxes(nets, {boxes[0].data(), boxes[1].data()}, options).status;
      const Status tight =
          tight_boxes(nets, from.levels_, {boxes[2].data(), boxes[3].data()}, options).status;
      const Status last = flatness(nets, flat->data(), options).status;
      require_status(status, {Status::ok, Status::bad_weight, Status::non_finite_input},
                     "control_boxes");
      require(tight == status && last == status, "measures have different statuses");
      require(status == Status::ok || !from.nets_.moderate, "measures refuse moderate nets");
      for (const Block<T>& block : boxes) {
        block.check_surroundings();
      }
      flat->check_surroundings();
    }
    void require_same(const Measures& other, Isa isa) const {
      require(status == other.status, named("measures have another status", isa));
      require_equal(flat->span(), other.flat->span(), named("flatness", isa));
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        require_equal(boxes[k].span(), other.boxes[k].span(), named("boxes", isa));
      }
    }
    Status status = Status::ok;
    std::vector<Block<T>> boxes; // low, high; tight low, tight high
    std::optional<Block<T>> flat;
  };

  void judge(const Measures& measures) {
    constexpr Real kParameters[] = {0, 0.125L, 0.5L, 0.8125L, 1};
    for (std::size_t p = 0; p < nets_.count; ++p) {
      const ReferencePatch patch(nets_, p);
      for (const Real u : kParameters) {
        for (const Real v : kParameters) {
          judge_sample(measures, p, patch, u, v);
        }
      }
    }
  }

  void judge_sample(const Measures& measures, std::size_t p, const ReferencePatch& patch, Real u,
                    Real v) {
    const RealSample sample = patch.evaluate(RealParameter::unit(u), RealParameter::unit(v));
    const int m = patch.degree_u();
    const int n = patch.degree_v();
    Real square = 0;
    Real largest = 0;
    for (int c = 0; c < patch.components(); ++c) {
      const auto plane = static_cast<std::size_t>(c);
      const std::size_t at = p * static_cast<std::size_t>(patch.components()) + plane;
      const Real own = 0x1p-57L * patch.size(c) + std::numeric_limits<T>::denorm_min();
      const Real value = sample.position[plane];
      for (std::size_t k = 0; k < 4; k += 2) {
        require(static_cast<Real>(measures.boxes[k].data()[at]) <= value + own &&
                    static_cast<Real>(measures.boxes[k + 1].data()[at]) >= value - own,
                k == 0 ? "a control box misses its surface" : "a tight box misses its surface");
      }
      require(measures.boxes[2].data()[at] >= measures.boxes[0].data()[at] &&
                  measures.boxes[3].data()[at] <= measures.boxes[1].data()[at],
              "a tight box is larger than the control box");
      const Real line = (1 - v) * ((1 - u) * patch.point(0, 0, c) + u * patch.point(0, m, c)) +
                        v * ((1 - u) * patch.point(n, 0, c) + u * patch.point(n, m, c));
      square += (value - line) * (value - line);
      largest = std::max(largest, patch.size(c));
    }
    const Real own = 0x1p-56L * largest + std::numeric_limits<T>::denorm_min();
    require(static_cast<Real>(measures.flat->data()[p]) >= std::sqrt(square) - own,
            "flatness is no bound");
  }

  /// The points of one edge, first to last, as values without the sign of zero.
  [[nodiscard]] std::vector<T> edge_points(std::size_t edge) const {
    const std::size_t patch = edge / kPatchEdges;
    const auto side = static_cast<PatchEdge>(edge % kPatchEdges);
    const bool along_u = side == PatchEdge::v0 || side == PatchEdge::v1;
    std::vector<T> points;
    for (int k = 0; k <= (along_u ? nets_.degree_u : nets_.degree_v); ++k) {
      const int j = along_u ? (side == PatchEdge::v1 ? nets_.degree_v : 0) : k;
      const int i = along_u ? k : (side == PatchEdge::u1 ? nets_.degree_u : 0);
      for (std::size_t c = 0; c < nets_.channels(); ++c) {
        points.push_back(nets_.point(patch, j, i)[c] + T(0));
      }
    }
    return points;
  }

  [[nodiscard]] std::vector<T> backwards(const std::vector<T>& points) const {
    std::vector<T> reversed;
    const auto each = static_cast<std::ptrdiff_t>(nets_.channels());
    for (auto end = points.end(); end != points.begin(); end -= each) {
      reversed.insert(reversed.end(), end - each, end);
    }
    return reversed;
  }

  [[nodiscard]] bool is_point(const std::vector<T>& points) const {
    const auto each = nets_.channels();
    for (std::size_t k = each; k < points.size(); ++k) {
      const bool weight = nets_.rational() && k % each == each - 1;
      if (!weight && points[k] != points[k % each]) {
        return false;
      }
    }
    return true;
  }

  void adjacency() {
    const std::size_t edges = nets_.count * kPatchEdges;
    const Block<EdgeLink> links(edges, placement(bytes_));
    Options options;
    options.threads = 1 + static_cast<int>(bytes_.below(2));
    require_status(find_adjacency(nets_.view(), links.data(), options), {Status::ok},
                   "find_adjacency");
    links.check_surroundings();
    const bool finite = std::ranges::all_of(nets_.values, [](T v) { return std::isfinite(v); });
    if (!finite || nets_.weights == Weights::homogeneous) {
      return; // nan by bits and divided points: left to the tests
    }
    std::vector<std::vector<T>> points;
    for (std::size_t e = 0; e < edges; ++e) {
      points.push_back(edge_points(e));
    }
    for (std::size_t e = 0; e < edges; ++e) {
      require(links.span()[e] == link_of(points, e), "an edge's link is another one");
    }
  }

  [[nodiscard]] EdgeLink link_of(const std::vector<std::vector<T>>& points, std::size_t e) const {
    if (is_point(points[e])) {
      return {EdgeKind::collapsed};
    }
    const std::vector<T> turned = backwards(points[e]);
    std::size_t found = 0;
    std::size_t next = e;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const std::size_t other = (e + k) % points.size();
      if (points[other] == points[e] || points[other] == turned) {
        next = found++ == 0 ? other : next;
      }
    }
    if (found == 0) {
      return {};
    }
    return {found == 1 ? EdgeKind::shared : EdgeKind::non_manifold,
            static_cast<PatchEdge>(next % kPatchEdges), points[next] != points[e],
            next / kPatchEdges};
  }

  void hostile() {
    const Block<T> block(nets_.values.size(), placement(bytes_));
    std::ranges::copy(nets_.values, block.data());
    ControlNets<T> nets = nets_.view();
    nets.points = block.data();
    nets.memory = block.span();
    spoil(bytes_, nets);
    const Verdict verdict = verdict_on(nets);
    const bool sound = verdict == Verdict::possible;
    const std::size_t values = sound ? nets.count * static_cast<std::size_t>(nets.components) : 64;
    const Block<T> low(values, placement(bytes_), T(-7));
    const Block<T> high(values, placement(bytes_), T(-7));
    const Block<EdgeLink> links(sound ? nets.count * kPatchEdges : 64, placement(bytes_));
    const Options options = with({}, Isa::automatic, 1);
    const Status statuses[] = {
        control_boxes(nets, {low.data(), high.data()}, options).status,
        tight_boxes(nets, levels_, {low.data(), high.data()}, options).status,
        flatness(nets, low.data(), options).status,
        find_adjacency(nets, links.data(), options),
    };
    for (const Status status : statuses) {
      require(sound || status != Status::ok, "a measure takes nets that make no sense");
      require(verdict != Verdict::overflow || status == Status::size_overflow ||
                  status == Status::bad_stride,
              "a measure takes strides that overflow");
    }
    const Report written = reverse_u(nets_.view(), as_output(nets), options);
    require(sound || !written, "an operation writes to nets that make no sense");
    block.check_surroundings();
  }

  ByteSource& bytes_;
  int levels_;
  Nets<T> nets_;
};

} // namespace
} // namespace simdbezier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return simdbezier::fuzz::run_case<simdbezier::fuzz::MeasureCase>(data, size);
}
