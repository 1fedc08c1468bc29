// Streaming stores are completed before a call returns. No result can show it: a processor may
// complete them in time a thousand times. So the instructions themselves are watched, one by one:
// behind the last streaming store of a call there has to be a fence.
#include <ucontext.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/canvas.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::streaming_order_test {
namespace {

enum class Kind : std::uint8_t { other, streaming_store, fence };

/// movntps, movntpd (2B), movntdq (E7), movnti (C3) in all encodings; sfence and mfence.
Kind kind_of(const unsigned char* code) {
  const auto streams = [](unsigned char opcode) {
    return opcode == 0x2b || opcode == 0xe7 ? Kind::streaming_store : Kind::other;
  };
  while (*code == 0x2e) { // without meaning: assemblers make instructions longer by it
    ++code;
  }
  if (*code == 0xc5) { // VEX, two bytes: the map is 0F
    return streams(code[2]);
  }
  if (*code == 0xc4) {
    return (code[1] & 0x1f) == 1 ? streams(code[3]) : Kind::other;
  }
  if (*code == 0x62) { // EVEX
    return (code[1] & 0x07) == 1 ? streams(code[4]) : Kind::other;
  }
  while (*code == 0x66 || (*code & 0xf0) == 0x40) {
    ++code;
  }
  if (*code != 0x0f) {
    return Kind::other;
  }
  if (code[1] == 0xae && (code[2] == 0xf8 || code[2] == 0xf0)) {
    return Kind::fence;
  }
  return code[1] == 0xc3 ? Kind::streaming_store : streams(code[1]);
}

/// What a call did, instruction by instruction.
struct Watched {
  long instructions = 0;
  long streamed = 0;
  long unfenced = 0; ///< streaming stores since the last fence
};
Watched g_watched;

constexpr long kTrapFlag = 0x100; ///< of EFLAGS: SIGTRAP before every instruction

extern "C" void on_instruction(int /*signal*/, siginfo_t* /*info*/, void* context) {
  const auto* const state = static_cast<const ucontext_t*>(context);
  const auto at = static_cast<std::uintptr_t>(state->uc_mcontext.gregs[REG_RIP]);
  const Kind kind = kind_of(reinterpret_cast<const unsigned char*>(at)); // NOLINT
  ++g_watched.instructions;
  if (kind == Kind::streaming_store) {
    ++g_watched.streamed;
    ++g_watched.unfenced;
  } else if (kind == Kind::fence) {
    g_watched.unfenced = 0;
  }
}

extern "C" void begin_watching(int /*signal*/, siginfo_t* /*info*/, void* context) {
  static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] |= kTrapFlag;
}
extern "C" void end_watching(int /*signal*/, siginfo_t* /*info*/, void* context) {
  static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~kTrapFlag;
}

void handle(int signal, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO;
  sigaction(signal, &action, nullptr);
}

template <typename Call>
Watched watch(const Call& call) {
  handle(SIGTRAP, on_instruction);
  handle(SIGUSR1, begin_watching);
  handle(SIGUSR2, end_watching);
  g_watched = {};
  raise(SIGUSR1);
  call();
  raise(SIGUSR2);
  return g_watched;
}

constexpr std::size_t n = 4; // one line a plane: each instruction costs an interrupt
constexpr std::size_t kSamples = n * n;

struct Call {
  const char* name;
  std::function<Status(const Options&)> run;
};

/// One patch, and memory in which lines begin where they do.
struct Memory {
  PatchSet<float> set = packed<float>(mixed_nets(1));
  CurveSet<float> curves;
  Canvas<float> canvas{6 * kSamples};
  std::vector<std::uint32_t> sizes = std::vector<std::uint32_t>(4, n);
  std::vector<std::uint32_t> numbers = std::vector<std::uint32_t>(kSamples, 0);
  std::vector<float> parameters = std::vector<float>(kSamples, 0.25F);

  Memory() {
    const std::vector<float> points(4 * 12, 1.5F);
    EXPECT_TRUE(pack(ControlCurves<float>::packed(points.data(), 4, 3), curves));
  }
  [[nodiscard]] Vectors<float> planes() {
    return Vectors<float>::planes(canvas.at(0), canvas.at(kSamples), canvas.at(2 * kSamples));
  }
  [[nodiscard]] Vectors<float> triples() { return Vectors<float>::xyz(canvas.at(0)); }
};

std::vector<Call> calls() {
  static Memory m;
  const auto grid = [](const Vectors<float>& to) {
    return [to](const Options& options) {
      Outputs<float> out;
      out.position = to;
      return evaluate(m.set, Grid<float>::uniform(n, n), out, options);
    };
  };
  const auto curve_out = [] {
    CurveOutputs<float> out;
    out.position = m.planes();
    return out;
  };
  return {{"grid_planes", grid(m.planes())},
          {"grid_triples", grid(m.triples())},
          {"patch_grids",
           [](const Options& options) {
             Outputs<float> out;
             out.position = m.planes();
             const auto size = std::span<const std::uint32_t>(m.sizes).first(m.set.size());
             return evaluate(m.set, PatchGrids{size, size}, out, options);
           }},
          {"scattered",
           [](const Options& options) {
             Outputs<float> out;
             out.position = m.planes();
             const Samples<float> samples{m.numbers, m.parameters, m.parameters, Parameters::unit};
             return evaluate(m.set, samples, out, options);
           }},
          {"curves",
           [curve_out](const Options& options) {
             return evaluate(m.curves, CurveGrid<float>::uniform(n), curve_out(), options);
           }},
          {"curve_counts",
           [curve_out](const Options& options) {
             return evaluate(m.curves, CurveGrids{m.sizes}, curve_out(), options);
           }},
          {"curve_samples", [curve_out](const Options& options) {
             const CurveSamples<float> samples{m.numbers, m.parameters, Parameters::unit};
             return evaluate(m.curves, samples, curve_out(), options);
           }}};
}

class StreamingOrder : public IsaTest {};

TEST_P(StreamingOrder, AFenceFollowsTheLastStore) {
  if (isa() == Isa::scalar) {
    GTEST_SKIP() << "has no streaming stores";
  }
  for (const Call& call : calls()) {
    SCOPED_TRACE(call.name);
    run({.threads = 1, .destination = Destination::memory}, call.run); // it works, and is warm
    const Watched memory = watch(
        [&] { (void)call.run({.threads = 1, .isa = isa(), .destination = Destination::memory}); });
    EXPECT_EQ(memory.unfenced, 0);
    EXPECT_GT(memory.streamed, 0) << "nothing was streamed: nothing was tested";
  }
}

INSTANTIATE_FOR_EVERY_ISA(StreamingOrder);

} // namespace
} // namespace simdbezier::tests::streaming_order_test
