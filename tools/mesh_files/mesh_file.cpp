#include <tools/mesh_files/mesh_file.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <tools/mesh_files/mesh_formats.hpp>
#include <tools/mesh_files/vertex_records.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/length.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

struct FormatEntry {
  const char* extension;
  const char* name; // with its article
  MeshAbilities can;
};
#define SIMDBEZIER_MESH_FORMAT_ROW(NAME, FILE, ...) {#NAME, FILE, __VA_ARGS__},
constexpr FormatEntry kFormats[] = {SIMDBEZIER_EACH_MESH_FORMAT(
    SIMDBEZIER_MESH_FORMAT_ROW) SIMDBEZIER_EACH_FORMAT_OF_RANKS(SIMDBEZIER_MESH_FORMAT_ROW)};
#undef SIMDBEZIER_MESH_FORMAT_ROW
constexpr auto kFormatsOfOne =
    std::span(kFormats).first(static_cast<std::size_t>(MeshFormat::hdf)); // those of ranks follow

const FormatEntry& entry_of(MeshFormat format) {
  return kFormats[static_cast<std::size_t>(format)];
}

void expect_at_most(const std::string& path, const char* format, const char* what,
                    std::uint64_t most, std::uint64_t found) {
  if (found > most) {
    bad_input(path + ": expected at most " + std::to_string(most) + " " + what + " in " + format +
              ", found " + std::to_string(found));
  }
}

template <typename T>
bool is_rounded(MeshFormat format, const MeshContents& contents) {
  return sizeof(T) > sizeof(float) && (contents.floats || !mesh_abilities(format).doubles);
}

// A mesh that storing rounds away would be points on top of each other.
template <typename T>
void check_size(const std::string& path, MeshFormat format, const MeshContents& contents) {
  const double size = diagonal_of(*contents.box);
  const double error = storage_error<T>(format, contents);
  if (size > 0 && !(error < size)) {
    bad_input(path + ": expected a mesh larger than the error of storing its vertices, " +
              shortest(error) + ", found one of size " + shortest(size) +
              (size < largest_coordinate(*contents.box) ? " far from its origin" : ""));
  }
}

} // namespace

template <typename T>
void check_contents(const std::string& path, MeshFormat format, const MeshContents& contents) {
  const FormatEntry& entry = entry_of(format);
  expect_at_most(path, entry.name, "vertices", kMostMeshVertices, contents.vertices);
  expect_at_most(path, entry.name, "faces", entry.can.most_faces, contents.faces);
  expect_at_most(path, entry.name, "numbered patches", entry.can.most_patches, contents.patches);
  if (contents.storage != VertexStorage::full && !entry.can.quantised) {
    bad_input(path + ": expected floating-point vertices in " + entry.name +
              ", found quantised vertices");
  }
  if (contents.corners != 3 && !entry.can.quads) {
    bad_input(path + ": expected triangles in " + entry.name + ", found quads");
  }
  if (contents.box && (is_rounded<T>(format, contents) || !entry.can.doubles)) {
    static_cast<void>(as_float(path, largest_coordinate(*contents.box)));
    check_size<T>(path, format, contents);
  }
  assert(contents.storage == VertexStorage::full || contents.box);
  assert(contents.data.empty() || entry.can.point_data);
}

std::optional<MeshFormat> mesh_format_of(const std::string& path, bool ranks) {
  const std::string extension = extension_of(path);
  const std::span<const FormatEntry> formats = ranks ? kFormats : kFormatsOfOne;
  const auto entry = std::ranges::find(formats, extension, &FormatEntry::extension);
  return entry == formats.end() ? std::nullopt
                                : std::optional(static_cast<MeshFormat>(entry - formats.begin()));
}

std::string mesh_format_hint(const std::string& path) {
  return extension_of(path) == "gltf" ? " (.glb is the form of glTF that is one file)"
         : mesh_format_of(path, true) ? " (which simdbezier-mpi writes)"
                                      : "";
}

std::string mesh_format_name(MeshFormat format) { return entry_of(format).extension; }

const MeshAbilities& mesh_abilities(MeshFormat format) { return entry_of(format).can; }

std::string mesh_format_names(const std::string& prefix, bool MeshAbilities::*ability) {
  std::vector<std::string> wanted;
  for (const FormatEntry& entry : kFormatsOfOne) {
    if (ability == nullptr || entry.can.*ability) {
      wanted.push_back(prefix + entry.extension);
    }
  }
  return alternatives(wanted);
}

double diagonal_of(const MeshBox& box) {
  return length_of({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

double largest_coordinate(const MeshBox& box) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    largest = std::max({largest, std::abs(box.low[c]), std::abs(box.high[c])});
  }
  return largest;
}

template <typename T>
double storage_error(MeshFormat format, const MeshContents& contents) {
  constexpr double kHalfFloat = 0x1p-24; // unit roundoff
  const bool quantised = contents.storage != VertexStorage::full;
  if (!quantised && !is_rounded<T>(format, contents)) {
    return 0;
  }
  assert(contents.box);
  const double size = largest_coordinate(*contents.box);
  // Whoever reads quantised positions computes in floats. 1 / 65535, the extent and both products
  // are rounded, which are parts of the extent; so are the box's corner and the sum. Where there
  // is an origin, the node's translation is the sum of it and the corner, as a double, and the
  // deviation is for those who add it in doubles.
  const double extent = quantised ? quantised_space(*contents.box).extent : 0;
  const double corner =
      contents.origin ? 0x1p-52 * (largest_coordinate({*contents.origin, *contents.origin}) + size)
                      : kHalfFloat * 2 * size;
  const double component =
      quantised ? extent / 65535 / 2 + kHalfFloat * 4 * extent + corner : kHalfFloat * size;
  return std::sqrt(3.0) * (component * (1 + 0x1p-32) + 0x1p-148);
}

template <typename T>
double stated_deviation(MeshFormat format, const MeshContents& contents) {
  const double error = storage_error<T>(format, contents);
  return error > 0 ? std::nextafter(*contents.deviation + error, HUGE_VAL) : *contents.deviation;
}

std::uintmax_t checked_file_size(const std::string& path, Count bytes) {
  if (!bytes.value()) {
    bad_input(path + ": expected a file whose bytes can be counted, found " + to_string(bytes));
  }
  return *bytes.value();
}

std::string spaced(const std::array<double, 3>& point) {
  return shortest(point[0]) + " " + shortest(point[1]) + " " + shortest(point[2]);
}

std::string worded_deviation(double deviation) {
  return std::isfinite(deviation) ? "deviation " + shortest(deviation)
                                  : "no bound on the deviation is known";
}

template <typename T>
float as_float(const std::string& path, T value) {
  if (!(std::abs(value) <= static_cast<T>(std::numeric_limits<float>::max()))) {
    bad_input(path + ": expected coordinates that a float can hold, found " +
              shortest(static_cast<double>(value)));
  }
  return static_cast<float>(value);
}

template <typename T>
void MeshWriter<T>::vertices(const VertexBlock<T>& block) {
  const std::size_t stride = contents_.stride();
  assert(block.values.size() % stride == 0);
  assert(block.patch.size() == (contents_.patches > 0 ? block.values.size() / stride : 0));
  assert(block.data.size() == block.values.size() / stride * contents_.data_bytes());
  // The loop has no branch, so that a register of values takes one step.
  bool finite = true;
  for (const T value : block.values) {
    finite &= std::abs(value) <= std::numeric_limits<T>::max();
  }
  if (!finite) {
    const auto bad =
        std::ranges::find_if(block.values, [](T value) { return !std::isfinite(value); });
    const auto place = static_cast<std::size_t>(bad - block.values.begin()) / stride;
    bad_input(path_ + ": expected finite numbers, found " + shortest(static_cast<double>(*bad)) +
              " at vertex " + std::to_string(vertices_done_ + place));
  }
  vertices_done_ += block.values.size() / stride;
  assert(vertices_done_ <= contents_.vertices);
  take_vertices(block);
}

template <typename T>
void MeshWriter<T>::faces(std::span<const std::uint32_t> corners) {
  assert(corners.size() % contents_.corners == 0);
  assert(takes_faces_early() || vertices_done_ == contents_.vertices);
  assert(std::ranges::all_of(corners, [&](std::uint32_t corner) {
    return corner < vertices_done_ + foreign_vertices() ||
           (corner == kNoVertex && contents_.corners == 4);
  }));
  faces_done_ += corners.size() / contents_.corners;
  assert(faces_done_ <= contents_.faces);
  take_faces(corners);
}

template <typename T>
void MeshWriter<T>::complete() {
  assert(vertices_done_ == contents_.vertices && faces_done_ == contents_.faces && !complete_);
  put_on_disk();
  complete_ = true;
}

template <typename T>
void MeshWriter<T>::finish() {
  if (!complete_) {
    complete();
  }
  put_in_place();
}

template <typename T>
MeshContents stated_contents(const std::string& path, MeshFormat format,
                             const MeshContents& contents) {
  check_contents<T>(path, format, contents);
  MeshContents stated = contents;
  if (contents.deviation) {
    stated.deviation = stated_deviation<T>(format, contents);
  }
  return stated;
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_mesh_writer(const std::string& path, MeshFormat format,
                                                const MeshContents& contents) {
  const MeshContents stated = stated_contents<T>(path, format, contents);
#define SIMDBEZIER_MESH_WRITER(NAME, ...) make_##NAME##_writer<T>,
  constexpr std::unique_ptr<MeshWriter<T>> (*kWriters[])(const std::string&,
                                                         const MeshContents&) = {
      SIMDBEZIER_EACH_MESH_FORMAT(SIMDBEZIER_MESH_WRITER)};
#undef SIMDBEZIER_MESH_WRITER
  return kWriters[static_cast<std::size_t>(format)](path, stated);
}

template void check_contents<float>(const std::string&, MeshFormat, const MeshContents&);
template void check_contents<double>(const std::string&, MeshFormat, const MeshContents&);
template class MeshWriter<float>;
template class MeshWriter<double>;
template std::unique_ptr<MeshWriter<float>> make_mesh_writer(const std::string&, MeshFormat,
                                                             const MeshContents&);
template std::unique_ptr<MeshWriter<double>> make_mesh_writer(const std::string&, MeshFormat,
                                                              const MeshContents&);
template MeshContents stated_contents<float>(const std::string&, MeshFormat, const MeshContents&);
template MeshContents stated_contents<double>(const std::string&, MeshFormat, const MeshContents&);
template double storage_error<float>(MeshFormat, const MeshContents&);
template double storage_error<double>(MeshFormat, const MeshContents&);
template double stated_deviation<float>(MeshFormat, const MeshContents&);
template double stated_deviation<double>(MeshFormat, const MeshContents&);
template float as_float(const std::string&, float);
template float as_float(const std::string&, double);

} // namespace simdbezier::tools
