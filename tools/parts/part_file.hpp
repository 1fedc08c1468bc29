// The mesh of a part, kept in a file of its own until all parts are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/parts/part_links.hpp>
#include <tools/process/temporary_file.hpp>

namespace simdbezier::tools {

/// What is known of a part before its first vertex.
struct PartHeader {
  std::string fingerprint; ///< of the model, the options and the program: equal for parts that fit
  std::size_t shard = 0;   ///< from 0
  std::size_t shards = 1;
  bool doubles = false; ///< the type of the mesh's numbers
  MeshFormat format = MeshFormat::ply;
  MeshContents contents; ///< of the part
};

/// Returns the name of a part's file, beside the mesh that it is for.
[[nodiscard]] std::string part_path(const std::string& mesh, std::size_t shard, std::size_t shards);

/// Writes a part. Its faces have vertices of other parts by their place among the links.
template <typename T>
[[nodiscard]] std::unique_ptr<MeshWriter<T>>
make_part_writer(const std::string& path, const PartHeader& header, const PartLinks& links);

/// Reads a part whose bytes are those that were written.
class PartReader {
public:
  /// Throws Failure where the file cannot be read, or is not as it was written.
  explicit PartReader(const std::string& path);
  /// Returns nothing where the constructor would throw.
  [[nodiscard]] static std::optional<PartHeader> header_of(const std::string& path);

  [[nodiscard]] const PartHeader& header() const noexcept { return header_; }
  [[nodiscard]] const PartLinks& links() const noexcept { return links_; }
  /// Hands all vertices to a writer.
  template <typename T>
  void vertices(MeshWriter<T>& writer);
  /// Hands all faces to a writer. first: the number of the part's first vertex; foreign: those of
  /// its foreign ones.
  template <typename T>
  void faces(MeshWriter<T>& writer, std::uint32_t first, std::span<const std::uint32_t> foreign);

private:
  void read(std::uint64_t at, void* to, std::size_t bytes) const;
  [[noreturn]] void refuse() const;
  void verify();
  void read_header();
  template <typename Visit>
  void for_chunks(std::uint64_t kind, const Visit& visit) const;

  std::string path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
  std::uint64_t chunks_ = 0; // where they begin
  PartHeader header_;
  PartLinks links_;
};

} // namespace simdbezier::tools
