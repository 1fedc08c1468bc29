// limit/…: what the machine can do, measured in the same run as the rows it limits.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <simdbezier/options.hpp>

#include "bench/limits/limit_kernels.hpp"
#include "bench/rows/rows.hpp"
#include "bench/subjects/shared_data.hpp"
#include "simdbezier_bench/isa_list.hpp"

namespace simdbezier_bench {

SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_DECLARE_LIMITS)

namespace {

constexpr std::size_t kRounds = 4096;
constexpr std::size_t kHornerBytes = 32 * kHornerBlockBytes; // half of a small first-level cache

template <typename T>
std::string type_name() {
  return sizeof(T) == 4 ? "f32" : "f64";
}

template <typename T>
void register_multiply_add(const std::string& isa, LimitKernels<T> kernels) {
  auto run = [kernels](benchmark::State& state) {
    alignas(64) T sink[16];
    const auto items = static_cast<double>(kRounds * kernels.multiply_add(1, sink));
    time_calls(state, 1, items, 0, [&] {
      kernels.multiply_add(kRounds, sink);
      benchmark::DoNotOptimize(sink);
    });
    // From 0 on, some number of steps x/2 + 1 brings every lane to 2.
    if (sink[0] != T(24)) {
      fail_row(state, "wrong sum of the chains");
    }
  };
  benchmark::RegisterBenchmark(("limit/fma/" + type_name<T>() + "/" + isa).c_str(), run)
      ->Unit(benchmark::kMicrosecond);
}

/// The time of the fastest of a thousand short calls.
template <typename Call>
double least_seconds(Call call) {
  using Clock = std::chrono::steady_clock;
  double least = 1;
  for (int k = 0; k < 1000; ++k) {
    const auto start = Clock::now();
    call();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

template <typename T>
void register_horner(const std::string& call, const std::string& isa, LimitKernels<T> kernels,
                     int degree) {
  const auto& forms = kernels.horner_store[degree - kLeastHornerDegree];
  auto run = [forms = std::to_array(forms), degree](benchmark::State& state) {
    constexpr std::size_t kCount = kHornerBytes / sizeof(T);
    T* const out = reinterpret_cast<T*>(output_buffer());
    if (out == nullptr) {
      return fail_row(state, "no memory for the output");
    }
    const T inputs[kMostHornerDegree + 2] = {T(0.5), 1, 2, 4, 8, 16};
    auto horner_store = forms[0];
    double least = 0;
    for (const auto form : forms) {
      for (std::size_t k = 0; k < kCount; ++k) {
        out[k] = 0;
      }
      form(out, kCount, inputs);
      for (std::size_t k = 0; k < kCount; ++k) {
        if (out[k] != T(degree + 1)) { // 1 + 2/2 + 4/4 + …
          return fail_row(state, "wrong value of the polynomial");
        }
      }
      const double seconds = least_seconds([&] { form(out, kCount, inputs); });
      if (least == 0 || seconds < least) {
        least = seconds;
        horner_store = form;
      }
    }
    time_calls(state, 1, static_cast<double>(kCount) / 3, static_cast<double>(kHornerBytes),
               [&] { horner_store(out, kCount, inputs); });
  };
  const std::string suffix = degree == 3 ? "" : "/degree:" + std::to_string(degree);
  benchmark::RegisterBenchmark(
      ("limit/" + call + "/" + type_name<T>() + "/" + isa + suffix).c_str(), run)
      ->Unit(benchmark::kMicrosecond);
}

/// Pairs of rows, as the library computes them, from registers.
template <typename T>
void register_pairs(const std::string& isa, LimitKernels<T> kernels) {
  auto run = [pairs_store = kernels.pairs_store](benchmark::State& state) {
    constexpr std::size_t kCount = kHornerBytes / sizeof(T);
    T* const out = reinterpret_cast<T*>(output_buffer());
    if (out == nullptr) {
      return fail_row(state, "no memory for the output");
    }
    const T inputs[5] = {T(0.5), 1, 2, 4, 8};
    std::fill_n(out, kCount, T(0));
    pairs_store(out, kCount, inputs);
    for (std::size_t k = 0; k < kCount; ++k) {
      if (out[k] != T(k < kCount / 2 ? 4 : 0)) { // 1 +- 2/2 + 4/4 +- 8/8
        return fail_row(state, "wrong value of the polynomial");
      }
    }
    time_calls(state, 1, static_cast<double>(kCount) / 3, static_cast<double>(kHornerBytes),
               [&] { pairs_store(out, kCount, inputs); });
  };
  benchmark::RegisterBenchmark(("limit/pairs_store/" + type_name<T>() + "/" + isa).c_str(), run)
      ->Unit(benchmark::kMicrosecond);
}

template <typename T>
void register_arithmetic(const std::string& isa, LimitKernels<T> fused, LimitKernels<T> separate) {
  register_multiply_add(isa, fused);
  for (const int degree : {3, 2, 4}) {
    register_horner("horner_store", isa, fused, degree);
  }
  register_horner("horner_store_muladd", isa, separate, 3);
  register_pairs(isa, fused);
}

/// A call fills `all` bytes, which the threads share, `behind` bytes from a line's start on.
void register_fill(const std::string& name, int threads, void (*fill)(unsigned char*, std::size_t),
                   std::size_t all = kMemoryBytes, std::size_t behind = 0) {
  auto run = [threads, fill, all, behind](benchmark::State& state) {
    unsigned char* const buffer = output_buffer();
    if (buffer == nullptr) {
      return fail_row(state, "no memory for the output");
    }
    unsigned char* const out = buffer + behind;
    const std::size_t share = all / static_cast<std::size_t>(threads) / 4096 * 4096;
    const auto bytes = static_cast<double>(share) * threads;
    time_calls(state, threads, bytes / 12, bytes, [&] { // 12 bytes: one f32 position
      if (threads == 1) {
        fill(out, share);
      } else {
#pragma omp parallel for num_threads(threads) schedule(static, 1)
        for (int k = 0; k < threads; ++k) {
          fill(out + static_cast<std::size_t>(k) * share, share);
        }
      }
    });
    for (std::size_t k = 0; k < share * static_cast<std::size_t>(threads); k += 4096) {
      if (*reinterpret_cast<const double*>(out + k) != 1.5) {
        return fail_row(state, "memory was not filled");
      }
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(all < kMemoryBytes ? benchmark::kMicrosecond : benchmark::kMillisecond);
}

// Instructions that do nothing show how many the processor takes in beside whoever shares its core.
void issue(benchmark::State& state) {
  time_calls(state, 1, 64 * kRounds, 0, [] {
    for (std::size_t k = 0; k < kRounds; ++k) {
      asm volatile(".rept 64\n\tnop\n\t.endr");
    }
  });
}

// A scattered call whose patches are in memory reads three lines a sample in random order.
// Prefetching 16 samples at a time, 64 ahead, is the best of 8 to 192 ahead, singly or in batches.
void random_lines(benchmark::State& state) {
  constexpr std::size_t kPatches = 1'000'000;
  constexpr std::size_t kPatchBytes = 3 * kLineBytes;
  constexpr std::size_t kSamples = std::size_t{1} << 20;
  constexpr std::size_t kAhead = 64; // samples
  constexpr std::size_t kBatch = 16;
  static_assert(kPatches * kPatchBytes <= kMemoryBytes);
  const unsigned char* const patches = output_buffer();
  if (patches == nullptr) {
    return fail_row(state, "no memory for the patches");
  }
  std::vector<std::uint32_t> ids(kSamples + kAhead);
  std::uint64_t seed = 1;
  for (std::uint32_t& id : ids) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    id = static_cast<std::uint32_t>((seed >> 32) % kPatches);
  }
  using Sums = std::uint64_t __attribute__((vector_size(16)));
  time_calls(state, 1, kSamples, static_cast<double>(kSamples * kPatchBytes), [&] {
    Sums sum{};
    for (std::size_t k = 0; k < kSamples; k += kBatch) {
      for (std::size_t j = k; j < k + kBatch; ++j) {
        const unsigned char* const ahead = patches + ids[j + kAhead] * kPatchBytes;
        for (std::size_t line = 0; line < kPatchBytes; line += kLineBytes) {
          __builtin_prefetch(ahead + line);
        }
      }
      for (std::size_t j = k; j < k + kBatch; ++j) {
        const unsigned char* const here = patches + ids[j] * kPatchBytes;
        for (std::size_t part = 0; part < kPatchBytes; part += sizeof(Sums)) {
          Sums values;
          __builtin_memcpy(&values, here + part, sizeof values);
          sum += values;
        }
      }
    }
    benchmark::DoNotOptimize(sum);
  });
}

} // namespace

void register_limit_rows() {
  FillKernels fill;
  for (const simdbezier::Isa isa : simdbezier::available_isas()) { // narrowest first
    const std::string name(simdbezier::to_string(isa));
#define SIMDBEZIER_BENCH_REGISTER(isa_name)                                                        \
  if (name == #isa_name) {                                                                         \
    register_arithmetic<float>(name, isa_name::fused::limits(0.0F),                                \
                               isa_name::separate::limits(0.0F));                                  \
    register_arithmetic<double>(name, isa_name::fused::limits(0.0),                                \
                                isa_name::separate::limits(0.0));                                  \
    fill = isa_name::fills();                                                                      \
  }
    SIMDBEZIER_BENCH_EACH_ISA(SIMDBEZIER_BENCH_REGISTER)
#undef SIMDBEZIER_BENCH_REGISTER
  }
  for (int threads = 1; threads <= max_threads(); ++threads) {
    const std::string suffix = "/threads:" + std::to_string(threads);
    register_fill("limit/fill_stream" + suffix, threads, fill.stream);
    register_fill("limit/fill_plain" + suffix, threads, fill.plain);
  }
  register_fill("limit/fill_l1", 1, fill.plain, kHornerBytes);
  register_fill("limit/fill_cache", 1, fill.plain, kCacheBytes);
  register_fill("limit/fill_cache/align:8", 1, fill.plain, kCacheBytes, 8);
  benchmark::RegisterBenchmark("limit/issue", issue)->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("limit/random_lines", random_lines)->Unit(benchmark::kMillisecond);
}

} // namespace simdbezier_bench
