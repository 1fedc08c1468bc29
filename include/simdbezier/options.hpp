// How a call runs, whatever it computes.
#pragma once

#include <cstdint>

#include <simdbezier/isa.hpp>

namespace simdbezier {

/// Where the outputs should end up. Streaming stores bypass the caches: up to four times as fast to
/// memory, depending on the machine, and much slower for whoever reads the result at once. They
/// take effect where the output consists of packed planes, packed triples or vertices without gaps;
/// any alignment of T will do.
///
/// automatic is cache for outputs of up to half of the last-level cache, and for scattered samples.
/// Beyond that the call takes what is faster on this machine. The first large call of its kind
/// (instruction set, shape, size of the grid if it is one, outputs and their layout, options, more
/// than four times the last-level cache or less) evaluates blocks in each way, and the rest in the
/// fastest one. So does the second, and the third where these two do not agree, since others who
/// use the machine can mislead one measurement; then the process keeps the answer. Ways are (1)
/// plain stores, (2) streaming ones, of kernels where these can make whole lines, else from staging
/// memory, a fifth of the second-level cache, (3) streaming ones from other staging: of that size
/// where kernels would turn rows to lines, else a quarter of the first-level cache (meshes have one
/// size). Blocks take a quarter of the output at most, and up to a third each goes before: by (2),
/// while caches write back what they hold, and by (1), to fill them before (1) is timed. Calls that
/// are too short, of a kind that is being measured or is one too many for the notes (some thousand)
/// take the last answer, else (2); so do those whose memory is new (Linux), after a first part by
/// (2). memory measures (2) and (3). No way changes a bit. SIMDBEZIER_DESTINATION=cache or =memory,
/// read once per process, stands for automatic in all large calls; other words count as none.
enum class Destination : std::uint8_t {
  automatic, ///< decided by the output's size, and beyond the caches by measurement
  cache,     ///< plain stores
  memory     ///< streaming stores, completed before the call returns
};

/// How a call runs. The defaults are what most callers want.
struct Options {
  /// 0 or less: as many as have some 20 microseconds of work each, which depends on the call's
  /// shape alone, and at most OpenMP's default (in builds without OpenMP: one a core); inside of a
  /// parallel region the calling thread alone. 1: the calling thread alone. Otherwise so many, but
  /// never more than 16, two a core or OpenMP's default, whichever is most.
  ///
  /// 1 enters no OpenMP region and never starts a thread: such a call always returns, with a
  /// status. Otherwise OpenMP's runtime starts the threads that its pool lacks. Where the system
  /// refuses one (ulimit -u, a container's limit of processes, no memory for a stack), GNU's
  /// runtime prints a line on stderr and calls exit(1); nothing above it can prevent that. Nor does
  /// its pool survive fork(): in a child of a process that has used several threads, only calls
  /// with 1 return.
  int threads = 0;
  /// false: edges and corners come from the interior's formula; derivatives along an edge that is a
  /// point are then of the size of rounding errors instead of zero.
  bool watertight = true;
  Isa isa = Isa::automatic; ///< see resolve_isa()
  Isa* executed = nullptr;  ///< where given, the kernel that ran writes its own name here
  Destination destination = Destination::automatic;
};

} // namespace simdbezier
