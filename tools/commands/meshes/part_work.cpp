#include <tools/commands/meshes/part_work.hpp>

#include <array>
#include <charconv>

#include <tools/patches/library_status.hpp>
#include <tools/patches/move_patches.hpp>
#include <tools/patches/patch_box.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

void move_to_origin(PatchFile& patches, MeshArguments& mesh, MeshStats& stats) {
  if (mesh.own_origin) {
    mesh.origin = own_origin(box_of(patches));
  }
  if (!mesh.origin || *mesh.origin == std::array<double, 3>{}) {
    mesh.origin.reset();
    return;
  }
  stats.origin = mesh.origin;
  move_patches(patches, *mesh.origin);
  for (std::size_t c = 0; c < 3; ++c) {
    mesh.camera.eye[c] -= (*mesh.origin)[c];
  }
}

std::unique_ptr<PatchSource> open_source(const Arguments& arguments) {
  // Origins move all points, and what that rounds counts for all of them.
  const bool moved = arguments.mesh.own_origin || arguments.mesh.origin;
  const bool may_be_binary =
      arguments.format == PatchFormat::by_name || arguments.format == PatchFormat::sbp;
  if (!moved && may_be_binary && arguments.in != "-" && extension_of(arguments.in) == "sbp") {
    if (auto source = PatchSource::open(arguments.in)) {
      return source;
    }
  }
  return std::make_unique<PatchSource>(read_input(arguments));
}

std::unique_ptr<PatchSource> open_moved_source(Arguments& arguments, MeshStats& stats) {
  const Stopwatch watch(stats.seconds.read);
  std::unique_ptr<PatchSource> source = open_source(arguments);
  stats.ignored_trims = source->ignored_trims();
  stats.merged_splines = source->merged_splines();
  if (arguments.mesh.own_origin || arguments.mesh.origin) {
    PatchFile patches = source->take();
    move_to_origin(patches, arguments.mesh, stats);
    source = std::make_unique<PatchSource>(std::move(patches));
  }
  return source;
}

void expect_shards(const PatchSource& source, std::size_t shards, const char* option) {
  if (shards > source.patches()) {
    bad_input(std::string(option) + ": expected at most as many as there are patches, " +
              std::to_string(source.patches()) + ", found " + std::to_string(shards));
  }
}

template <typename T>
ModelPart find_part(const PatchSource& source, const Arguments& arguments, SetRange own) {
  return arguments.mesh.weld ? joined_part<T>(source, own) : loose_part(source, own);
}

template <typename T>
void expect_exact_storage(const PatchSource& source, const Arguments& arguments,
                          const char* option) {
  MeshContents contents;
  contents.storage = arguments.mesh.storage;
  contents.floats = arguments.mesh.floats;
  contents.origin = arguments.mesh.origin;
  contents.box = source.box();
  if (arguments.mesh.adaptive() && storage_error<T>(arguments.mesh.format, contents) > 0) {
    bad_usage(std::string(option) +
              ": expected --grid, or vertices that are stored as they are computed, found " +
              "a mesh that storing rounds");
  }
}

std::string part_fingerprint(const PatchSource& source, const Arguments& arguments) {
  std::array<char, 16> digits;
  char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), source.fingerprint(), 16).ptr;
  return program_version() + (fuses_multiply_add(chosen_isa()) ? " fused " : " unfused ") +
         std::string(digits.data(), end) + arguments.words;
}

template ModelPart find_part<float>(const PatchSource&, const Arguments&, SetRange);
template ModelPart find_part<double>(const PatchSource&, const Arguments&, SetRange);
template void expect_exact_storage<float>(const PatchSource&, const Arguments&, const char*);
template void expect_exact_storage<double>(const PatchSource&, const Arguments&, const char*);

} // namespace simdbezier::tools
