// A part's file: a line of JSON; its links; chunks of vertices and faces, each behind its kind and
// size; the sums of all bytes before. It is read on machines of the same kind only.
#include <tools/parts/part_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <tools/formats/sbp_index.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

constexpr const char* kKind = "part of a mesh, version 1";
constexpr std::uint64_t kVertices = 1;
constexpr std::uint64_t kFaces = 2;
constexpr std::size_t kMostHeader = std::size_t{1} << 16;

struct Chunk {
  std::uint64_t kind = 0;
  std::uint64_t bytes = 0;
};

using Json = nlohmann::ordered_json;

Json to_json(const PartHeader& header, const PartLinks& links) {
  const MeshContents& mesh = header.contents;
  Json json = Json::object();
  json["simdbezier"] = kKind;
  json["fingerprint"] = header.fingerprint;
  json["shard"] = header.shard + 1;
  json["shards"] = header.shards;
  json["doubles"] = header.doubles;
  json["format"] = mesh_format_name(header.format);
  json["vertices"] = mesh.vertices;
  json["faces"] = mesh.faces;
  json["corners"] = mesh.corners;
  json["among_quads"] = mesh.among_quads;
  json["normals"] = mesh.normals;
  json["uv"] = mesh.uv;
  json["patches"] = mesh.patches;
  json["storage"] = static_cast<int>(mesh.storage);
  json["floats"] = mesh.floats;
  json["margin"] = mesh.margin;
  json["generator"] = mesh.generator;
  if (mesh.origin) {
    json["origin"] = *mesh.origin;
  }
  if (mesh.box) {
    json["low"] = mesh.box->low;
    json["high"] = mesh.box->high;
  }
  if (mesh.deviation) {
    json["deviation"] = *mesh.deviation;
  }
  json["data"] = Json::array();
  for (const PointData& item : mesh.data) {
    json["data"].push_back({item.name, item.type.name, item.type.bytes, item.components});
  }
  json["lent"] = links.lent.size();
  json["foreign"] = links.foreign.size();
  return json;
}

PartHeader from_json(const Json& json) {
  PartHeader header;
  MeshContents& mesh = header.contents;
  header.fingerprint = json.at("fingerprint");
  header.shard = json.at("shard").get<std::size_t>() - 1;
  header.shards = json.at("shards");
  header.doubles = json.at("doubles");
  header.format = mesh_format_of("mesh." + json.at("format").get<std::string>()).value();
  mesh.vertices = json.at("vertices");
  mesh.faces = json.at("faces");
  mesh.corners = json.at("corners");
  mesh.among_quads = json.at("among_quads");
  mesh.normals = json.at("normals");
  mesh.uv = json.at("uv");
  mesh.patches = json.at("patches");
  mesh.storage = static_cast<VertexStorage>(json.at("storage").get<int>());
  mesh.floats = json.at("floats");
  mesh.margin = json.at("margin");
  mesh.generator = json.at("generator");
  if (json.contains("origin")) {
    mesh.origin = json["origin"].get<std::array<double, 3>>();
  }
  if (json.contains("low")) {
    mesh.box = {json.at("low").get<std::array<double, 3>>(),
                json.at("high").get<std::array<double, 3>>()};
  }
  if (json.contains("deviation")) {
    mesh.deviation = // JSON has null for infinity
        json["deviation"].is_null() ? HUGE_VAL : json["deviation"].get<double>();
  }
  for (const Json& item : json.at("data")) {
    mesh.data.push_back({item.at(0), {item.at(1), item.at(2)}, item.at(3)});
  }
  return header;
}

template <typename T>
class PartWriter final : public MeshWriter<T> {
public:
  PartWriter(const std::string& path, const PartHeader& header, const PartLinks& links)
      : MeshWriter<T>(path, header.contents), foreign_(links.foreign.size()), file_(path) {
    const std::string line = to_json(header, links).dump() + "\n";
    bytes(line.data(), line.size());
    bytes(links.lent.data(), links.lent.size() * sizeof(LentVertices));
    bytes(links.foreign.data(), links.foreign.size() * sizeof(ForeignVertex));
  }

  [[nodiscard]] std::uint64_t foreign_vertices() const noexcept override { return foreign_; }

private:
  void bytes(const void* data, std::size_t size) {
    check_.add({static_cast<const std::byte*>(data), size});
    file_.bytes(data, size);
  }
  void take_vertices(const VertexBlock<T>& block) override {
    const Chunk chunk{kVertices,
                      block.values.size_bytes() + block.patch.size_bytes() + block.data.size()};
    bytes(&chunk, sizeof chunk);
    bytes(block.values.data(), block.values.size_bytes());
    bytes(block.patch.data(), block.patch.size_bytes());
    bytes(block.data.data(), block.data.size());
  }
  void take_faces(std::span<const std::uint32_t> corners) override {
    const Chunk chunk{kFaces, corners.size_bytes()};
    bytes(&chunk, sizeof chunk);
    bytes(corners.data(), corners.size_bytes());
  }
  void put_on_disk() override {
    const SbpCheck check = check_.value();
    file_.bytes(&check, sizeof check);
    file_.complete();
  }
  void put_in_place() override { file_.commit(); }

  std::size_t foreign_;
  RunningCheck check_;
  OutputFile file_;
};

} // namespace

std::string part_path(const std::string& mesh, std::size_t shard, std::size_t shards) {
  return mesh + ".shard-" + std::to_string(shard + 1) + "-of-" + std::to_string(shards);
}

template <typename T>
std::unique_ptr<MeshWriter<T>> make_part_writer(const std::string& path, const PartHeader& header,
                                                const PartLinks& links) {
  return std::make_unique<PartWriter<T>>(path, header, links);
}

PartReader::PartReader(const std::string& path)
    : path_(path), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (!file_.is_open()) {
    bad_input(path + ": expected a part of a mesh, found " + in_quotes(std::strerror(errno)));
  }
  struct stat status = {};
  if (fstat(file_.number(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::uint64_t>(status.st_size) < sizeof(SbpCheck)) {
    refuse();
  }
  size_ = static_cast<std::uint64_t>(status.st_size) - sizeof(SbpCheck);
  verify();
  read_header();
}

std::optional<PartHeader> PartReader::header_of(const std::string& path) {
  try {
    return PartReader(path).header();
  } catch (const Failure&) {
    return std::nullopt;
  }
}

void PartReader::refuse() const {
  bad_input(path_ + ": expected a part of a mesh as it was written, found other bytes");
}

void PartReader::read(std::uint64_t at, void* to, std::size_t bytes) const {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t more = pread(file_.number(), static_cast<char*>(to) + done, bytes - done,
                               static_cast<off_t>(at + done));
    if (more == 0 || (more < 0 && errno != EINTR)) {
      refuse();
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(more, 0));
  }
}

void PartReader::verify() {
  RunningCheck check;
  std::vector<std::byte> bytes(std::size_t{1} << 20);
  for (std::uint64_t at = 0; at < size_; at += bytes.size()) {
    bytes.resize(std::min<std::uint64_t>(bytes.size(), size_ - at));
    read(at, bytes.data(), bytes.size());
    check.add(bytes);
  }
  SbpCheck written;
  read(size_, &written, sizeof written);
  if (check.value() != written) {
    refuse();
  }
}

void PartReader::read_header() {
  std::string line(std::min<std::uint64_t>(kMostHeader, size_), '\0');
  read(0, line.data(), line.size());
  line.resize(std::min(line.find('\n'), line.size()));
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || json.value("simdbezier", "") != kKind) {
    refuse();
  }
  try {
    header_ = from_json(json);
    links_.lent.resize(json.at("lent"));
    links_.foreign.resize(json.at("foreign"));
  } catch (const Json::exception&) {
    refuse();
  }
  chunks_ = line.size() + 1;
  read(chunks_, links_.lent.data(), links_.lent.size() * sizeof(LentVertices));
  chunks_ += links_.lent.size() * sizeof(LentVertices);
  read(chunks_, links_.foreign.data(), links_.foreign.size() * sizeof(ForeignVertex));
  chunks_ += links_.foreign.size() * sizeof(ForeignVertex);
}

// Calls visit(the bytes of a chunk) for all of a kind.
template <typename Visit>
void PartReader::for_chunks(std::uint64_t kind, const Visit& visit) const {
  std::vector<std::byte> bytes;
  for (std::uint64_t at = chunks_; at < size_;) {
    Chunk chunk;
    read(at, &chunk, sizeof chunk);
    at += sizeof chunk;
    if (chunk.kind == kind) {
      bytes.resize(chunk.bytes);
      read(at, bytes.data(), bytes.size());
      visit(bytes);
    }
    at += chunk.bytes;
  }
}

template <typename T>
void PartReader::vertices(MeshWriter<T>& writer) {
  const MeshContents& mesh = header_.contents;
  const std::size_t values = mesh.stride() * sizeof(T);
  const std::size_t patch = mesh.patches > 0 ? sizeof(std::uint32_t) : 0;
  for_chunks(kVertices, [&](const std::vector<std::byte>& bytes) {
    const std::size_t count = bytes.size() / (values + patch + mesh.data_bytes());
    // Vectors begin where any number may.
    const auto* const at = reinterpret_cast<const T*>(bytes.data());
    VertexBlock<T> block{{at, count * mesh.stride()}};
    const std::byte* next = bytes.data() + count * values;
    block.patch = {reinterpret_cast<const std::uint32_t*>(next), patch == 0 ? 0 : count};
    block.data = {next + count * patch, count * mesh.data_bytes()};
    writer.vertices(block);
  });
}

template <typename T>
void PartReader::faces(MeshWriter<T>& writer, std::uint32_t first,
                       std::span<const std::uint32_t> foreign) {
  const auto own = static_cast<std::uint32_t>(header_.contents.vertices);
  std::vector<std::uint32_t> corners;
  for_chunks(kFaces, [&](const std::vector<std::byte>& bytes) {
    corners.resize(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(corners.data(), bytes.data(), bytes.size());
    for (std::uint32_t& corner : corners) {
      if (corner != kNoVertex) {
        corner = corner < own ? corner + first : foreign[corner - own];
      }
    }
    writer.faces(corners);
  });
}

template std::unique_ptr<MeshWriter<float>> make_part_writer(const std::string&, const PartHeader&,
                                                             const PartLinks&);
template std::unique_ptr<MeshWriter<double>> make_part_writer(const std::string&, const PartHeader&,
                                                              const PartLinks&);
template void PartReader::vertices(MeshWriter<float>&);
template void PartReader::vertices(MeshWriter<double>&);
template void PartReader::faces(MeshWriter<float>&, std::uint32_t, std::span<const std::uint32_t>);
template void PartReader::faces(MeshWriter<double>&, std::uint32_t, std::span<const std::uint32_t>);

} // namespace simdbezier::tools
