// Runs a target without a fuzzer: on every file of the given folders, on inputs without a seed, and
// on mutations of all of them that are the same in every run.
//
//     fuzz_replay_TARGET MUTATIONS PATH…
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/reliability/fuzz/inputs/fuzz_bytes.hpp"
#include "tests/reliability/fuzz/inputs/mutator.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using simdbezier::fuzz::Bytes;
namespace fs = std::filesystem;

Bytes contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Files and folders of files, in the order of their names.
std::vector<fs::path> files_of(std::span<char*> arguments) {
  std::vector<fs::path> files;
  for (const char* const argument : arguments) {
    if (fs::is_directory(argument)) {
      for (const auto& entry : fs::recursive_directory_iterator(argument)) {
        if (entry.is_regular_file()) {
          files.push_back(entry.path());
        }
      }
    } else {
      files.emplace_back(argument);
    }
  }
  std::ranges::sort(files);
  return files;
}

/// A run that ends here has told what it was doing: the last line names the input.
void run(const Bytes& bytes, const std::string& name) {
  std::printf("%s\n", name.c_str());
  std::fflush(stdout);
  // Exactly as many bytes as there are, for sanitizers.
  const std::vector<std::uint8_t> exact(bytes);
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

void mutate(const std::vector<Bytes>& seeds, std::size_t count) {
  simdbezier::fuzz::Mutator mutator(seeds);
  for (std::size_t k = 0; k < count; ++k) {
    const Bytes bytes = mutator.next();
    // Where the next run ends, this file has what it ran on.
    std::ofstream("fuzz_replay.last", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    run(bytes, "mutation " + std::to_string(k));
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  std::size_t mutations = 0;
  const std::string_view number = argc > 1 ? argv[1] : "";
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), mutations);
  if (number.empty() || error != std::errc{} || end != number.data() + number.size()) {
    std::fprintf(stderr, "usage: %s MUTATIONS PATH...\n", argv[0]);
    return 2;
  }
  std::vector<Bytes> seeds = {{}};
  run(seeds[0], "nothing");
  for (const fs::path& path : files_of(arguments.subspan(2))) {
    seeds.push_back(contents(path));
    run(seeds.back(), path.string());
  }
  mutate(seeds, mutations);
  return 0;
}
