// Positions alone, in triples and planes at any place in memory: kernels of their own.
#include <cmath>
#include <cstdint>

#include "tests/curves/curve_results.hpp"
#include "tests/support/call_options.hpp"

namespace simdbezier::tests::curve_rows_test {
namespace {

/// A batch of positions alone.
struct RowCase {
  int degree;
  bool origins;
  std::size_t curves;
};

/// Fewer than a register, whole registers, and so many that rings go round.
const RowCase kRowCases[] = {{3, false, 1},  {3, false, 16},  {3, false, 1201}, {3, true, 523},
                             {1, false, 37}, {2, false, 300}, {4, false, 35},   {5, true, 267}};

class CurveRows : public CurveTest {
protected:
  /// Triples and planes `shift` values behind the start of a line.
  template <typename T>
  void rows(const CurveSet<T>& set, std::size_t n, std::size_t shift, bool triples,
            const CallOptions& options, const CurveResults<T>& expected) {
    const std::size_t samples = (set.size() - options.first_patch) * n;
    const std::size_t step = (samples + 63) / 16 * 16;
    std::vector<T> memory(3 * step + 48, T(-1));
    const std::size_t misaligned = reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
    const std::size_t begin = (64 - misaligned) % 64 / sizeof(T) + shift;
    T* const first = memory.data() + begin;
    CurveOutputs<T> out;
    // Planes are out of step with each other.
    out.position = triples ? Vectors<T>::xyz(first)
                           : Vectors<T>::planes(first, first + step + 1, first + 2 * step + 5);
    evaluate(set, CurveGrid<T>::uniform(n), out, options);
    const T* const plane[] = {out.position.x, out.position.y, out.position.z};
    const std::size_t stride = triples ? 3 : 1;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        T& value = memory[static_cast<std::size_t>(plane[c] - memory.data()) + stride * k];
        ASSERT_TRUE(same_bits(value, expected.at(0, c, k + options.first_patch * n)))
            << "n " << n << " shift " << shift << " triples " << triples << " sample " << k;
        value = T(-1);
      }
    }
    for (const T& value : memory) {
      ASSERT_EQ(value, T(-1)) << "not an output: " << &value - first;
    }
  }

  template <typename T>
  void all_rows(const RowCase& row) {
    PackOptions packing;
    packing.local_origin = row.origins;
    const CurveSet<T> set = packed<T>(random_curves<T>(row.curves, row.degree, 3, 0, 12), packing);
    for (const std::size_t n : {2, 4, 5, 7, 8, 9, 15, 16, 17, 31, 64, 65}) {
      // With derivatives and tangents, other kernels run.
      CurveResults<T> expected(row.curves * n, 3);
      evaluate(set, CurveGrid<T>::uniform(n), expected.outputs());
      for (const Destination destination : {Destination::cache, Destination::memory}) {
        for (const std::size_t shift : {0, 1, 6}) {
          CallOptions options;
          options.destination = destination;
          options.threads = shift == 1 ? 3 : 1;
          options.first_patch = shift == 6 ? row.curves / 3 : 0;
          rows(set, n, shift, true, options, expected);
          rows(set, n, shift, false, options, expected);
        }
      }
    }
  }
};

TEST_P(CurveRows, GoAnywhereInMemory) {
  for (const RowCase& row : kRowCases) {
    all_rows<float>(row);
    all_rows<double>(row);
  }
}

TEST_P(CurveRows, TakeParametersInAnyOrder) {
  constexpr std::size_t kFew = 37;
  constexpr std::size_t kSamples = 6;
  const float t[kSamples] = {1, 0.25F, 0, NAN, 0.5F, 1};
  const CurveSet<float> set = packed<float>(random_curves<float>(kFew, 3, 3, 0, 6));
  CurveResults<float> expected(kFew * kSamples, 3);
  evaluate(set, CurveGrid<float>{kSamples, t}, expected.outputs());
  for (const Destination destination : {Destination::cache, Destination::memory}) {
    std::vector<float> points(3 * kFew * kSamples);
    CurveOutputs<float> out;
    out.position = Vectors<float>::xyz(points.data());
    CallOptions options;
    options.destination = destination;
    evaluate(set, CurveGrid<float>{kSamples, t}, out, options);
    for (std::size_t k = 0; k < kFew * kSamples; ++k) {
      const float value = points[3 * k + 1];
      ASSERT_TRUE(k % kSamples == 3 ? std::isnan(value) : same_bits(value, expected.at(0, 1, k)));
    }
  }
}

INSTANTIATE_FOR_EVERY_ISA(CurveRows);

} // namespace
} // namespace simdbezier::tests::curve_rows_test
