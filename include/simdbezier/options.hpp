// How a call runs, whatever it computes, and the instruction sets on which it can.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <simdbezier/status.hpp>

namespace simdbezier {

/// The instruction sets that kernels are compiled for. Results are bit-equal inside a class:
/// avx2, avx512 and neon64 fuse multiply and add; scalar, sse2, simd128 round after each one.
enum class Isa : std::uint8_t {
  automatic, ///< SIMDBEZIER_ISA if it is set, otherwise the widest that the machine can run, or for
             ///< some grids the next one: see resolve_isa()
  scalar,
  sse2,
  avx2,   ///< AVX2 and FMA
  avx512, ///< AVX-512 F, CD, DQ, BW, VL
  neon64, ///< the aarch64 baseline
  simd128 ///< WebAssembly's vectors of 128 bits
};

/// The name used by SIMDBEZIER_ISA and in benchmark names: "scalar", "sse2", …
[[nodiscard]] SIMDBEZIER_API std::string_view to_string(Isa isa) noexcept;

/// The instruction set of that name, or nothing. "automatic" is a name too.
[[nodiscard]] SIMDBEZIER_API std::optional<Isa> isa_from_name(std::string_view name) noexcept;

/// The instruction sets that this build contains (SIMDBEZIER_ISAS when it was configured) and this
/// machine can run, narrowest first. Empty only if the build leaves out what every machine has; all
/// calls then return unsupported_isa. Probed once, thread-safe, static lifetime.
[[nodiscard]] SIMDBEZIER_API std::span<const Isa> available_isas() noexcept;

/// True for the instruction sets that round once per multiply-add (the FMA class of results).
[[nodiscard]] SIMDBEZIER_API bool fuses_multiply_add(Isa isa) noexcept;

/// What a call with `requested` will run on. Isa::automatic reads the environment variable
/// SIMDBEZIER_ISA at the first use in the process and keeps that answer.
///
/// If nobody names an instruction set, evaluate() on a Grid may use the next narrower one of the
/// same class (avx2 instead of avx512) for outputs that stay in the caches, because some processors
/// are faster with it on small grids. The first two calls of a kind (shape, size of the grid,
/// outputs and their layout) with 1024 samples or more measure both, in 20 microseconds to two
/// milliseconds. If they disagree, a third call decides, and the process keeps the answer. The
/// bits are equal; take_executed_isa() tells which one ran.
///
/// Returns ok | unknown_isa | unsupported_isa; `chosen` is written on ok only.
[[nodiscard]] SIMDBEZIER_API Status resolve_isa(Isa requested, Isa& chosen) noexcept;

/// The instruction set that ran this thread's last call that evaluated samples, wrote triangles or
/// made nets, whichever threads shared its work. Each answer is given once: Isa::automatic means
/// that there was no such call since the last question.
[[nodiscard]] SIMDBEZIER_API Isa take_executed_isa() noexcept;

/// On how many threads and on which instruction set a call runs. Neither changes a bit of the
/// results within a class of instruction sets (Isa).
struct RunOptions {
  /// 1: the calling thread alone. Such a call starts no thread, enters no OpenMP region, and always
  /// returns. 0 or less: one thread for every 20 microseconds of estimated work, up to OpenMP's
  /// default number (up to the number of cores if the library has threads of its own). Inside of a
  /// parallel region, the call stays on the calling thread. The estimate depends only on the shape
  /// of the call. If earlier calls of the same thread have shown that their threads wait for cores
  /// that others use, the call takes fewer threads; after 0.1 to 1.6 s, calls try more again.
  /// Larger numbers: so many threads, but never more than the largest of these: 16, two per core,
  /// OpenMP's default.
  ///
  /// If the system refuses OpenMP a thread (ulimit -u, a container's limit of processes, no memory
  /// for a stack), GNU's runtime prints a line on stderr and calls exit(1), which no library can
  /// prevent. Its pool does not survive fork() either: in a child of a process that has used
  /// several threads, only calls with `threads` = 1 return.
  int threads = 0;
  Isa isa = Isa::automatic; ///< see resolve_isa(); calls that run no kernel ignore it
};

/// Where the outputs should end up. No choice changes a bit of them. Streaming stores bypass the
/// caches. Depending on the machine, they are up to four times as fast to memory, but reading the
/// result at once is then much slower. They take effect for packed planes, packed triples and
/// vertices without gaps, at any alignment of T.
///
/// automatic is right for most callers. Outputs of up to half of the last-level cache, and
/// scattered samples, get plain stores. The first two larger calls of a kind (instruction set,
/// shape, size of the grid, outputs and their layout, options) measure on a part of their samples
/// which stores are faster. If they disagree, a third call decides. The process then keeps the
/// answer. The environment variable SIMDBEZIER_DESTINATION=cache or =memory, read once per process,
/// decides for all such calls; other words are ignored.
enum class Destination : std::uint8_t {
  automatic, ///< decided by the output's size, and beyond the caches by measurement
  cache,     ///< plain stores
  memory     ///< streaming stores, completed before the call returns
};

/// How a call that evaluates runs. It contains the members of RunOptions, and converts to these.
struct Options {
  int threads = 0;          ///< as in RunOptions
  Isa isa = Isa::automatic; ///< as in RunOptions
  /// false: edges and corners are evaluated by the formula of the interior. Derivatives along an
  /// edge that is a point are then of the size of rounding errors instead of zero.
  bool watertight = true;
  Destination destination = Destination::automatic;

  constexpr operator RunOptions() const noexcept { return {threads, isa}; } // NOLINT: it is one
};

} // namespace simdbezier
