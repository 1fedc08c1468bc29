// A mesh by many processes: each finds the parts that are its own (model_part.hpp), counts their
// vertices, learns from others where those begin that it shares with earlier parts, and writes.
#include <tools/mpi/mpi_tessellate.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tools/commands/meshes/grid_mesh.hpp>
#include <tools/commands/meshes/part_work.hpp>
#include <tools/commands/meshes/welded_mesh.hpp>
#include <tools/mpi/rank_stats.hpp>
#include <tools/mpi/rank_writers.hpp>
#include <tools/parts/joined_contents.hpp>
#include <tools/patches/library_status.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

/// A mesh of either kind.
template <typename T>
struct ShardMesh {
  std::unique_ptr<ModelPart> part; // in whose memory a mesh of loose patches is
  std::unique_ptr<WeldedMesh<T>> welded;
  std::unique_ptr<GridMesh<T>> loose;

  [[nodiscard]] MeshSource<T>& source() {
    return welded ? static_cast<MeshSource<T>&>(*welded) : *loose;
  }
};

/// What is kept of a shard while others are worked on.
template <typename T>
struct KnownShard {
  SetRange own;
  bool known = false;
  std::vector<std::uint32_t> ghosts;
  MeshContents contents;
  std::vector<ModelPart::Lent> lenders; // `to` is the rank that has the patch
  std::vector<LentVertices> lent;       // empty when other ranks know it
  ShardPlace place;
  std::optional<ShardMesh<T>> mesh; // where a rank has a single shard
};

template <typename T>
class MpiTessellation {
public:
  MpiTessellation(Ranks& ranks, const Arguments& arguments, const PatchSource& source,
                  MeshStats& stats)
      : ranks_(ranks), arguments_(arguments), source_(source), stats_(stats) {
    const auto count = static_cast<std::size_t>(ranks.count());
    constexpr std::size_t kUsualPatches = 65536;
    const std::size_t most = arguments.shard_patches.value_or(kUsualPatches);
    const std::size_t needed = (source.patches() + most - 1) / most;
    shards_ = std::min(source.patches(), (needed + count - 1) / count * count);
  }

  void run() {
    ranks_.together([&] { count(); });
    const MeshContents whole = agree();
    tell();
    write(whole);
  }

  /// Of all ranks, where rank 0 has it.
  [[nodiscard]] std::uint64_t written() const noexcept { return written_; }

private:
  [[nodiscard]] std::size_t first_of(std::size_t rank) const {
    const auto count = static_cast<std::size_t>(ranks_.count());
    return (shards_ * rank + count - 1) / count;
  }
  [[nodiscard]] std::size_t rank_of_patch(std::uint32_t patch) const {
    std::size_t low = 0;
    for (std::size_t high = static_cast<std::size_t>(ranks_.count()); high - low > 1;) {
      const std::size_t middle = low + (high - low) / 2;
      const std::size_t shard = first_of(middle);
      const bool is_after =
          shard < shards_ && shard_range(source_.patches(), shard, shards_).first <= patch;
      (is_after ? low : high) = middle;
    }
    return low;
  }

  // A shard's links are small beside its patches, but a rank has those of all of its shards.
  [[nodiscard]] std::vector<ModelPart::Lent> lenders_of(const ModelPart& part) const {
    std::vector<ModelPart::Lent> found = part.lent;
    for (ModelPart::Lent& each : found) {
      each.to = static_cast<std::uint32_t>(rank_of_patch(each.to));
    }
    found.erase(std::unique(found.begin(), found.end()), found.end()); // ranks ascend with patches
    found.shrink_to_fit();
    return found;
  }

  ShardMesh<T> make_mesh(KnownShard<T>& shard, MeshStats& stats) {
    ShardMesh<T> mesh;
    ModelPart part;
    {
      const Stopwatch watch(stats.seconds.read);
      part = shard.known ? part_with(source_, shard.own, shard.ghosts)
                         : find_part<T>(source_, arguments_, shard.own);
    }
    if (!std::exchange(shard.known, true)) {
      shard.ghosts = part.ghosts();
      shard.lenders = lenders_of(part);
    }
    if (arguments_.mesh.weld) {
      mesh.welded = std::make_unique<WeldedMesh<T>>(std::move(part), arguments_, stats);
    } else {
      mesh.part = std::make_unique<ModelPart>(std::move(part));
      mesh.loose = std::make_unique<GridMesh<T>>(*mesh.part, arguments_, stats);
    }
    return mesh;
  }

  void count() {
    const auto rank = static_cast<std::size_t>(ranks_.rank());
    for (std::size_t k = first_of(rank); k < first_of(rank + 1); ++k) {
      KnownShard<T>& shard = own_.emplace_back();
      shard.own = shard_range(source_.patches(), k, shards_);
      MeshStats found;
      ShardMesh<T> mesh = make_mesh(shard, found);
      add(found);
      shard.contents = mesh.source().contents();
      shard.lent = mesh.source().links().lent;
      if (first_of(rank) + 1 == first_of(rank + 1)) {
        shard.mesh = std::move(mesh);
      }
    }
  }

  void add(const MeshStats& found) {
    stats_.patches += found.patches;
    stats_.vertices += found.vertices;
    stats_.triangles += found.triangles;
    stats_.samples += found.samples;
    stats_.deviation = std::max(stats_.deviation, found.deviation);
    stats_.open_edges += found.open_edges;
    stats_.non_manifold_edges += found.non_manifold_edges;
    if (found.joined) {
      stats_.joined = stats_.joined ? stats_.joined : TopologyCounts{};
      stats_.joined->turned_edges += found.joined->turned_edges;
      stats_.joined->repeated_patches += found.joined->repeated_patches;
    }
    add(found.seconds);
  }
  void add(const StageSeconds& found) {
    for (double StageSeconds::*const stage :
         {&StageSeconds::read, &StageSeconds::pack, &StageSeconds::rates, &StageSeconds::topology,
          &StageSeconds::evaluate, &StageSeconds::write}) {
      stats_.seconds.*stage += found.*stage;
    }
  }

  // Finds the places of all shards, and what the whole mesh has.
  MeshContents agree() {
    JoinedContents joined;
    ShardPlace next;
    for (KnownShard<T>& shard : own_) {
      shard.place = next;
      next.first_vertex += shard.contents.vertices;
      next.first_face += shard.contents.faces;
      next.quads_before += shard.contents.among_quads;
      joined.add(shard.contents);
    }
    const ShardPlace before{ranks_.sum_before(next.first_vertex),
                            ranks_.sum_before(next.first_face),
                            ranks_.sum_before(next.quads_before)};
    for (KnownShard<T>& shard : own_) {
      shard.place.first_vertex += before.first_vertex;
      shard.place.first_face += before.first_face;
      shard.place.quads_before += before.quads_before;
    }
    MeshContents whole = joined.contents();
    whole.vertices = ranks_.sum(next.first_vertex);
    whole.faces = ranks_.sum(next.first_face);
    whole.among_quads = ranks_.sum(next.quads_before);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double deviation = ranks_.most(whole.deviation.value_or(0));
    whole.deviation = whole.deviation ? std::optional(deviation) : std::nullopt;
    MeshBox box = whole.box.value_or(
        MeshBox{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}});
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] = ranks_.least(box.low[c]);
      box.high[c] = ranks_.most(box.high[c]);
    }
    whole.box = box;
    ranks_.together([&] {
      if (!own_.empty()) {
        whole = stated_contents<T>(arguments_.out, arguments_.mesh.format, whole);
      }
    });
    return whole;
  }

  // Tells other ranks where the vertices begin that they share.
  void tell() {
    std::vector<std::vector<LentVertices>> to(static_cast<std::size_t>(ranks_.count()));
    for (KnownShard<T>& shard : own_) {
      VertexDirectory directory;
      directory.add(shard.lent, shard.place.first_vertex);
      for (const ModelPart::Lent& each : shard.lenders) {
        to[each.to].push_back(directory.of(each.patch));
      }
      shard.lenders = {};
      shard.lent = {};
    }
    std::vector<LentVertices> told = ranks_.exchange(std::move(to));
    std::ranges::sort(told, {}, &LentVertices::patch);
    directory_.add(told, 0);
  }

  void write(const MeshContents& whole) {
    const MeshFormat format = arguments_.mesh.format;
    std::uint64_t bytes = 0;
    if (!own_.empty()) {
      bytes = ranked_bytes<T>(format, whole);
    }
    bytes = static_cast<std::uint64_t>(ranks_.most(static_cast<double>(bytes)));
    RankFile file(ranks_, MPI_COMM_WORLD, arguments_.out, bytes);
    std::vector<std::uint64_t> arrays;
    ranks_.together([&] {
      if (ranks_.is_first()) {
        arrays = write_head<T>(file, format, whole);
      }
    });
    arrays = ranks_.of_first(std::move(arrays));
    ranks_.together([&] {
      Progress progress("tessellating", "patches", stats_.patches, ranks_.is_first());
      for (KnownShard<T>& shard : own_) {
        write(shard, file, whole, arrays, progress);
      }
    });
    {
      const Stopwatch watch(stats_.seconds.write);
      file.finish();
    }
    written_ = file.written();
  }

  void write(KnownShard<T>& shard, RankFile& file, const MeshContents& whole,
             std::span<const std::uint64_t> arrays, Progress& progress) {
    const MeshFormat format = arguments_.mesh.format;
    MeshStats again;
    ShardMesh<T> mesh = shard.mesh ? std::move(*shard.mesh) : make_mesh(shard, again);
    shard.mesh.reset();
    add(again.seconds);
    std::vector<T> foreign;
    if (format == MeshFormat::stl) {
      foreign = mesh.welded ? mesh.welded->foreign_values() : std::vector<T>();
    } else {
      const auto first = static_cast<std::uint32_t>(shard.place.first_vertex);
      const std::vector<std::uint32_t> numbers = directory_.numbers(mesh.source().links().foreign);
      mesh.welded ? mesh.welded->place(first, numbers) : mesh.loose->place(first);
    }
    const auto writer = make_rank_writer<T>(file, format, whole, arrays, shard.contents,
                                            shard.place, std::span<const T>(foreign));
    StageSeconds seconds;
    mesh.source().write(*writer, seconds, progress);
    {
      const Stopwatch watch(seconds.write);
      writer->finish();
    }
    add(seconds);
  }

  Ranks& ranks_;
  const Arguments& arguments_;
  const PatchSource& source_;
  MeshStats& stats_;
  std::size_t shards_ = 0;
  std::vector<KnownShard<T>> own_;
  VertexDirectory directory_;
  std::uint64_t written_ = 0;
};

template <typename T>
void tessellate(Ranks& ranks, const Arguments& arguments, const PatchSource& source,
                MeshStats& stats) {
  ranks.together([&] { expect_exact_storage<T>(source, arguments, "-o"); });
  stats.diagonal = diagonal_of(source.box());
  MpiTessellation<T> work(ranks, arguments, source, stats);
  work.run();
  print_rank_stats(ranks, arguments, stats, work.written());
}

} // namespace

void run_mpi_tessellate(Ranks& ranks, const Arguments& asked) {
  Arguments arguments = asked;
  MeshStats stats;
  std::unique_ptr<PatchSource> source;
  ranks.together([&] {
    chosen_isa();
    if (!is_written_by_ranks(arguments.mesh.format)) {
      bad_usage("-o: expected a mesh in " + formats_of_ranks() + ", found " +
                mesh_format_name(arguments.mesh.format));
    }
    if (arguments.in == "-") {
      bad_usage("IN: expected a file that all ranks can read, found standard input");
    }
    refuse_input_as_output(arguments.out, inputs_of(arguments));
    source = open_moved_source(arguments, stats);
  });
  arguments.precision == Precision::f32 ? tessellate<float>(ranks, arguments, *source, stats)
                                        : tessellate<double>(ranks, arguments, *source, stats);
}

} // namespace simdbezier::tools
