// simdbezier join: the mesh of parts that tessellate has made.
#include <tools/commands/commands.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <unistd.h>

#include <tools/parts/joined_contents.hpp>
#include <tools/parts/part_file.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

using Readers = std::vector<std::unique_ptr<PartReader>>;

Readers open_parts(const Arguments& arguments) {
  Readers parts;
  for (std::size_t shard = 0; shard < arguments.shards; ++shard) {
    const std::string path = part_path(arguments.out, shard, arguments.shards);
    parts.push_back(std::make_unique<PartReader>(path));
    const PartHeader& header = parts.back()->header();
    if (header.shard != shard || header.shards != arguments.shards ||
        header.fingerprint != parts.front()->header().fingerprint ||
        header.format != arguments.mesh.format) {
      bad_input(path + ": expected a part of the same mesh as " +
                part_path(arguments.out, 0, arguments.shards) + ", found one of " +
                in_quotes(header.fingerprint));
    }
  }
  return parts;
}

template <typename T>
void join(const Arguments& arguments, Readers& parts) {
  JoinedContents joined;
  VertexDirectory directory;
  std::vector<std::uint64_t> first;
  for (const auto& part : parts) {
    first.push_back(joined.contents().vertices);
    directory.add(part->links().lent, first.back());
    joined.add(part->header().contents);
  }
  const auto writer = make_mesh_writer<T>(arguments.out, arguments.mesh.format, joined.contents());
  for (const auto& part : parts) {
    part->vertices(*writer);
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k]->faces(*writer, static_cast<std::uint32_t>(first[k]),
                    directory.numbers(parts[k]->links().foreign));
  }
  writer->finish();
}

} // namespace

void run_join(const Arguments& arguments) {
  Readers parts = open_parts(arguments);
  parts.front()->header().doubles ? join<double>(arguments, parts) : join<float>(arguments, parts);
  for (std::size_t shard = 0; shard < arguments.shards && arguments.remove_parts; ++shard) {
    static_cast<void>(unlink(part_path(arguments.out, shard, arguments.shards).c_str()));
  }
}

} // namespace simdbezier::tools
