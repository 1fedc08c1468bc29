// tessellate/position/f64/<peer>/8x8/memory/threads:1/part:mesh: another library on some patches of
// the sheet of tessellate_rows.cpp, to the tolerance of 8x8. Items are triangles.
#include <memory>
#include <string>

#include "bench/peers/peers.hpp"
#include "bench/rows/mesh_stages.hpp"
#include "bench/rows/rows.hpp"

namespace simdbezier_bench {
namespace {

using MakeMesher = std::unique_ptr<PeerMesher> (*)(std::span<const double>);

class MeshPeerRow {
public:
  explicit MeshPeerRow(MakeMesher make) : stages_(shared_stages<double>({.adaptive = true})) {
    if (stages_ != nullptr) {
      mesher_ = make(std::span<const double>(stages_->nets).first(48 * kPeerPatches));
    }
  }
  void operator()() { mesher_->run(stages_->tolerance); }
  std::string check() {
    if (stages_ == nullptr) {
      return "the sheet could not be laid out";
    }
    (*this)();
    counts_ = mesher_->counts();
    return counts_.triangles >= 2 * kPeerPatches ? std::string() : "triangles are missing";
  }
  [[nodiscard]] double items() const { return static_cast<double>(counts_.triangles); }
  [[nodiscard]] double bytes() const {
    return 3 * sizeof(double) * static_cast<double>(counts_.vertices) + 12.0 * items();
  }

private:
  std::shared_ptr<MeshStages<double>> stages_;
  std::shared_ptr<PeerMesher> mesher_;
  MeshCounts counts_;
};

[[maybe_unused]] void add(const char* peer, MakeMesher make) {
  const RowName name{
      "tessellate", OutputGroups::position, false, peer, 8, 8, MemoryLevel::memory, 1};
  register_row(name.text() + "/part:mesh", benchmark::kMillisecond, 1,
               [make] { return MeshPeerRow(make); });
}

} // namespace

void register_mesh_peer_rows() {
#if defined(SIMDBEZIER_BENCH_WITH_OPENCASCADE_MESH)
  add("opencascade", make_opencascade_mesher);
#endif
}

} // namespace simdbezier_bench
