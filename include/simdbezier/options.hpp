// How a call runs, whatever it computes.
#pragma once

#include <cstdint>

#include <simdbezier/isa.hpp>

namespace simdbezier {

/// Where the outputs should end up. No choice changes a bit of them. Streaming stores bypass the
/// caches: up to four times as fast to memory, depending on the machine, and much slower for
/// whoever reads the result at once. They take effect for packed planes, packed triples and
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

/// How a call runs. The defaults are what most callers want.
struct Options {
  /// 1: the calling thread alone. Such a call starts no thread, enters no OpenMP region, and always
  /// returns. 0 or less: one thread for every 20 microseconds of estimated work, up to OpenMP's
  /// default number (without OpenMP: the number of cores); inside of a parallel region the calling
  /// thread alone. The estimate depends only on the shape of the call. Larger numbers: so many
  /// threads, but never more than the largest of 16, two per core and OpenMP's default.
  ///
  /// If the system refuses OpenMP a thread (ulimit -u, a container's limit of processes, no memory
  /// for a stack), GNU's runtime prints a line on stderr and calls exit(1), which no library can
  /// prevent. Its pool does not survive fork() either: in a child of a process that has used
  /// several threads, only calls with 1 return.
  int threads = 0;
  /// false: edges and corners are evaluated by the formula of the interior. Derivatives along an
  /// edge that is a point are then of the size of rounding errors instead of zero.
  bool watertight = true;
  Isa isa = Isa::automatic; ///< see resolve_isa()
  Isa* executed = nullptr;  ///< if given, receives the instruction set that ran
  Destination destination = Destination::automatic;
};

} // namespace simdbezier
