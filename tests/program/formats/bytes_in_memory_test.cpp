// Inputs and outputs in memory are those of files.
#include <gtest/gtest.h>

#include <tools/mesh_files/mesh_file.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

#include "tests/program/formats/format_files.hpp"
#include "tests/program/process/program.hpp"

namespace simdbezier::tests::bytes_in_memory_test {
namespace {

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const tools::Failure& failure) {
    return failure.what();
  }
  return "nothing was thrown";
}

TEST(BytesInMemory, are_read_as_a_file_of_their_name) {
  for (const std::string format : kSampleFormats) {
    const std::string text = read_file(sample_path(format));
    const tools::PatchFile file =
        tools::read_patches(sample_path(format), tools::PatchFormat::by_name);
    const tools::PatchFile memory = tools::read_patches("some." + format, text);
    EXPECT_EQ(memory.name, "some." + format);
    EXPECT_EQ(memory.count, file.count);
    EXPECT_EQ(memory.points, file.points) << format;
    EXPECT_EQ(memory.lines, file.lines) << format;
  }
}

TEST(BytesInMemory, have_the_messages_of_a_file) {
  const auto read = [](const std::string& name, const std::string& text) {
    return message_of([&] { static_cast<void>(tools::read_patches(name, text)); });
  };
  EXPECT_EQ(read("m.bez", "1\n0 0 z"), "m.bez:2: expected a finite number, found 'z'");
  EXPECT_NE(read("m.bez.gz", "\x1f\x8b\x08").find("m.bez.gz:1: expected"), std::string::npos);
  EXPECT_NE(read("m.xyz", "1").find("m.xyz: expected a name that ends in"), std::string::npos);
  EXPECT_NE(read("m.bez", "").find("m.bez:1: expected"), std::string::npos);
}

void write(const std::string& path) {
  tools::OutputFile file(path);
  file.text("0123456789");
  const std::string many(1 << 20, 'x'); // more than is kept before it goes on
  file.bytes(many.data(), many.size());
  EXPECT_TRUE(file.can_rewrite());
  file.rewrite(3, "abc");
  file.number(0.1);
  file.complete();
  file.commit();
}

TEST(BytesInMemory, are_written_as_a_file_is) {
  const TemporaryFolder folder;
  const std::string path = folder.path("out.ply");
  std::string first;
  {
    tools::OutputInMemory outer(path);
    write(path);
    first = std::string(outer.bytes.begin(), outer.bytes.end());
    {
      tools::OutputInMemory inner("another.ply");
      write("another.ply");
      EXPECT_EQ(inner.bytes, outer.bytes);
    }
    write(path); // once more from the beginning
    EXPECT_EQ(first, std::string(outer.bytes.begin(), outer.bytes.end()));
    EXPECT_TRUE(folder.names().empty());
  }
  write(path); // nobody takes it any more
  EXPECT_EQ(first, read_file(path));
  EXPECT_EQ(first.substr(0, 12), "012abc6789xx");
}

TEST(BytesInMemory, are_a_mesh_file) {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> triangle = {0, 1, 2};
  const TemporaryFolder folder;
  for (const std::string name : {"obj", "ply", "stl", "glb", "vtu", "raw"}) {
    const std::string path = folder.path("mesh." + name);
    tools::MeshContents contents;
    contents.vertices = 3;
    contents.faces = 1;
    const auto write_mesh = [&] {
      const auto writer =
          tools::make_mesh_writer<float>(path, *tools::mesh_format_of(path), contents);
      writer->vertices({corners});
      writer->faces(triangle);
      writer->finish();
    };
    std::string in_memory;
    {
      tools::OutputInMemory memory(path);
      write_mesh();
      in_memory = std::string(memory.bytes.begin(), memory.bytes.end());
    }
    write_mesh();
    EXPECT_EQ(in_memory, read_file(path)) << name;
  }
}

} // namespace
} // namespace simdbezier::tests::bytes_in_memory_test
