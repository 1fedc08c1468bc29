// What a module without files, terminals and zlib has in place of stored_file.cpp,
// output_target.cpp, spill_file.cpp, temporary_file.cpp, progress.cpp and gunzip.cpp: bytes come
// from memory and go to memory.
#include <tools/formats/input/byte_source.hpp>
#include <tools/formats/input/gunzip.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>
#include <tools/process/progress.hpp>
#include <tools/process/spill_file.hpp>

struct z_stream_s {};

namespace simdbezier::tools {

std::unique_ptr<StoredBytes> open_file(const std::string& path) {
  bad_input(path + ": expected bytes in memory, found the name of a file");
}

std::unique_ptr<OutputTarget> open_target(const std::string& path) {
  bad_input(path + ": expected an output in memory, found the name of a file");
}

Gunzip::Gunzip(std::string_view /*first*/) {
  throw DamagedInput{"bytes that are unpacked already", "what gzip has compressed"};
}
Gunzip::~Gunzip() = default;
std::size_t Gunzip::unpack(char* /*data*/, std::size_t /*size*/) { return 0; }
void Gunzip::fed(std::size_t /*size*/) noexcept {}
void Gunzip::expect_end() const {}

// Outputs in memory can be rewritten, so that nothing has to wait elsewhere.
SpillFile::SpillFile(const std::string& output) {
  bad_input(output + ": expected a file of less than 4 GiB, found a larger one");
}
void SpillFile::append(const void* /*data*/, std::size_t /*size*/) {}
void SpillFile::read(std::uint64_t /*at*/, void* /*data*/, std::size_t /*size*/) {}
std::error_code Descriptor::close() noexcept { return {}; }

Progress::Progress(std::string_view work, std::string_view unit, std::uint64_t total,
                   bool /*wanted*/)
    : work_(work), unit_(unit), total_(total), wanted_(false) {}
Progress::~Progress() = default;
void Progress::show_when_due() {}

} // namespace simdbezier::tools
