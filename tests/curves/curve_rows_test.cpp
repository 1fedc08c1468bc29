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

/// Triples, or planes of which the second and the third are so many values out of step.
struct Rows {
  bool triples;
  std::size_t y;
  std::size_t z;
};
const Rows kRows[] = {{true, 0, 0}, {false, 0, 0}, {false, 1, 0}, {false, 0, 5}, {false, 1, 5}};

/// Fewer than a register, whole registers, and so many that coefficients are asked for ahead.
const RowCase kRowCases[] = {{3, false, 1},  {3, false, 16},  {3, false, 1201}, {3, true, 523},
                             {1, false, 37}, {2, false, 300}, {4, false, 35},   {5, true, 267}};

class CurveRows : public CurveTest {
protected:
  /// Rows `shift` values behind the start of a line.
  template <typename T>
  void rows(const CurveSet<T>& set, const CurveGrid<T>& grid, std::size_t shift, const Rows& kind,
            const CallOptions& options, const CurveResults<T>& expected) {
    const std::size_t n = grid.n;
    const std::size_t samples = (set.size() - options.first_patch) * n;
    const std::size_t step = (samples + 63) / 16 * 16;
    std::vector<T> memory(3 * step + 48, T(-1));
    const std::size_t misaligned = reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
    const std::size_t begin = (64 - misaligned) % 64 / sizeof(T) + shift;
    T* const first = memory.data() + begin;
    CurveOutputs<T> out;
    const bool triples = kind.triples;
    out.position =
        triples ? Vectors<T>::xyz(first)
                : Vectors<T>::planes(first, first + step + kind.y, first + 2 * step + kind.z);
    evaluate(set, grid, out, options);
    const T* const plane[] = {out.position.x, out.position.y, out.position.z};
    const std::size_t stride = triples ? 3 : 1;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        T& value = memory[static_cast<std::size_t>(plane[c] - memory.data()) + stride * k];
        const T wanted = expected.at(0, c, k + options.first_patch * n);
        ASSERT_TRUE(std::isnan(wanted) ? std::isnan(value) : same_bits(value, wanted))
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
    for (const std::size_t n : {2, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 65, 1024, 1025}) {
      if (n * row.curves <= 100000) {
        all_places(set, CurveGrid<T>::uniform(n));
      }
    }
  }

  template <typename T>
  void all_places(const CurveSet<T>& set, const CurveGrid<T>& grid) {
    // With derivatives and tangents, other kernels run.
    CurveResults<T> expected(set.size() * grid.n, 3);
    evaluate(set, grid, expected.outputs());
    for (const Destination destination : {Destination::cache, Destination::memory}) {
      for (const std::size_t shift : {0, 1, 6}) {
        CallOptions options;
        options.destination = destination;
        options.threads = shift == 1 ? 3 : 1;
        options.first_patch = shift == 6 ? set.size() / 3 : 0;
        for (const Rows& kind : kRows) {
          rows(set, grid, shift, kind, options, expected);
        }
      }
    }
  }

  /// Ends in the middle, several times, or none; and parameters that are no numbers.
  template <typename T>
  void all_parameters() {
    const CurveSet<T> set = packed<T>(random_curves<T>(37, 3, 3, 0, 6));
    for (const std::size_t n : {6, 9, 17, 40}) {
      for (const std::size_t end : {std::size_t(0), n / 2, n - 1, n}) {
        std::vector<T> t(n);
        for (std::size_t i = 0; i < n; ++i) {
          t[i] = i == end ? T(1) : T(i + 1) / T(n + 2);
        }
        if (end > 0 && end < n) {
          t[end - 1] = 0;
          t[(end + 3) % n] = static_cast<T>(NAN);
          t[(end + 1) % n] = 1; // where `end` is the last sample, the next curve begins with it
        }
        all_places(set, CurveGrid<T>::at(t));
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
  all_parameters<float>();
  all_parameters<double>();
}

INSTANTIATE_FOR_EVERY_ISA(CurveRows);

} // namespace
} // namespace simdbezier::tests::curve_rows_test
