// Streamed and plain stores: equal bits in every layout, at every alignment, and not one element
// touched that is no output, however the stores are combined to whole cache lines.
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/output/layouts.hpp"
#include "tests/support/call_options.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/long_form.hpp"
#include "tests/support/nets/generators.hpp"

namespace simdbezier::tests::destinations_test {
namespace {

struct Size {
  std::size_t nu;
  std::size_t nv;
};

[[nodiscard]] std::vector<Size> sizes() {
  std::vector<Size> all;
  for (std::size_t n = 2; n <= 20; ++n) {
    all.push_back({n, n});
  }
  for (const std::size_t n : {32U, 33U, 64U, 65U}) {
    all.push_back({n, n});
  }
  // Rows of three lines, of no whole registers, of many, of eight and sixteen lines; and more rows
  // than are swept in one go.
  for (const Size size : {Size{100, 7}, Size{48, 5}, Size{31, 6}, Size{127, 3}, Size{129, 3},
                          Size{128, 4}, Size{256, 2}, Size{25, 140}, Size{32, 140}}) {
    all.push_back(size);
  }
  return all;
}

constexpr Destination kDestinations[] = {Destination::memory, Destination::cache};
constexpr std::size_t kMostPatches = 9;
constexpr Wanted kEverything{.second = true};

/// Sequences that go through patch counts and threads while the other loops run; threads are dear,
/// so most calls have one.
struct Turns {
  std::size_t turn = 0;
  std::size_t patches = 1;
  int threads = 1;
  void next() {
    ++turn;
    patches = turn * 5 % kMostPatches + 1;
    threads = turn % 8 == 3 ? 2 : turn % 8 == 6 ? 3 : 1;
  }
};

class DestinationTest : public IsaTest {
protected:
  template <typename T>
  void check(const PatchSet<T>& set, const Grid<T>& samples, const Planes<T>& reference,
             Canvas<T>& canvas, const Outputs<T>& out, const CallOptions& options,
             const std::string& what) {
    const std::size_t count = options.patch_count * samples.nu * samples.nv;
    grid(set, samples, out, options);
    EXPECT_EQ(canvas.defects(out, reference, count), 0U)
        << what << ", " << samples.nu << "x" << samples.nv << ", " << options.patch_count
        << " patches, " << options.threads << " threads, "
        << (options.destination == Destination::memory ? "memory" : "cache");
  }

  template <typename T>
  [[nodiscard]] Planes<T> reference_of(const PatchSet<T>& set, const Grid<T>& samples) {
    Planes<T> reference(set.size() * samples.nu * samples.nv, kEverything);
    grid(set, samples, reference.outputs(), {.threads = 1, .destination = Destination::cache});
    return reference;
  }

  template <typename T>
  void planes_at_every_alignment() {
    const PatchSet<T> set = packed<T>(mixed_nets(kMostPatches));
    Canvas<T> canvas(0);
    Turns turns;
    std::size_t number = 0;
    for (const Size size : sizes()) {
      std::size_t place = ++number;
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const PlaneCase& layout : kPlaneCases) {
        ++place;
        for (std::size_t shift = 0; shift < 16; ++shift) {
          if (!in_form(place + shift, 4)) {
            continue;
          }
          turns.next();
          const std::size_t count = turns.patches * size.nu * size.nv;
          const Destination destination = kDestinations[turns.turn % 5 == 0 ? 1 : 0];
          canvas.reset(plane_elements(layout, count));
          check(
              set, samples, reference, canvas, plane_outputs(layout, count, shift, canvas.at(0)),
              {.threads = turns.threads, .destination = destination, .patch_count = turns.patches},
              std::string(layout.name) + " + " + std::to_string(shift));
        }
      }
    }
  }

  template <typename T>
  void vertices_at_every_alignment() {
    const PatchSet<T> set = packed<T>(mixed_nets(kMostPatches));
    Canvas<T> canvas(0);
    Turns turns;
    std::size_t number = 0;
    for (const Size size : sizes()) {
      std::size_t place = ++number;
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const VertexCase& layout : vertex_cases()) {
        ++place;
        for (std::size_t shift = 0; shift < 16; ++shift) {
          if (!in_form(place + shift, 4)) {
            continue;
          }
          turns.next();
          const std::size_t count = turns.patches * size.nu * size.nv;
          const auto order = turns.turn % 7 == 0 ? PlaneOrder::zyx : PlaneOrder::xyz;
          const Destination destination = kDestinations[turns.turn % 5 == 0 ? 1 : 0];
          canvas.reset(vertex_elements(layout, count) + shift);
          check(
              set, samples, reference, canvas,
              vertex_outputs(layout, count, canvas.at(shift), order),
              {.threads = turns.threads, .destination = destination, .patch_count = turns.patches},
              std::string(layout.name) + " + " + std::to_string(shift));
        }
      }
    }
  }

  /// Long rows on cache lines, of sets whose positions have origins added to them.
  template <typename T>
  void local_origins() {
    const PatchSet<T> set = packed<T>(mixed_nets(4), {.local_origin = true});
    Canvas<T> canvas(0);
    for (const Size size : {Size{16, 5}, Size{33, 4}, Size{64, 3}, Size{128, 4}, Size{256, 2}}) {
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const PlaneCase& layout : kPlaneCases) {
        for (const std::size_t shift : {0U, 4U}) {
          canvas.reset(plane_elements(layout, reference.count()));
          check(set, samples, reference, canvas,
                plane_outputs(layout, reference.count(), shift, canvas.at(0)),
                {.threads = 1, .destination = Destination::memory, .patch_count = 4}, layout.name);
        }
      }
    }
  }

  /// Some groups in planes, some in vertices, two kinds of vertices, all at once.
  template <typename T>
  void mixtures() {
    const PatchSet<T> set = packed<T>(mixed_nets(kMostPatches));
    Turns turns;
    Canvas<T> canvas(0);
    std::vector<Size> all = sizes();
    all.push_back({3000, 2}); // rows longer than what is staged at a time
    all.push_back({2, 700});
    all.push_back({200, 150}); // patches that are staged in strips
    for (const Size size : all) {
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      const Planes<T> reference = reference_of(set, samples);
      for (const Destination destination : kDestinations) {
        turns.next();
        const std::size_t count = turns.patches * size.nu * size.nv;
        canvas.reset(18 * count + 4 * 48);
        Outputs<T> out;
        T* const planes = canvas.at(3);
        out.position = Vectors<T>::planes(planes, planes + count + 40, planes + 2 * (count + 40));
        T* const vertices = planes + 3 * (count + 40);
        out.normal = Vectors<T>::xyz(vertices + 3, 6);
        out.duv = Vectors<T>::xyz(vertices, 6);
        T* const triples = vertices + 6 * count;
        out.dv = Vectors<T>::xyz(triples);
        out.dvv = {triples + 3 * count, triples + 4 * count, triples + 5 * count, 1};
        std::vector<SampleStatus> status(count + 256, static_cast<SampleStatus>(77));
        out.status = status.data() + 128 + turns.turn % 64;
        check(set, samples, reference, canvas, out,
              {.threads = turns.threads, .destination = destination, .patch_count = turns.patches},
              "mixture");
        expect_status(status, static_cast<std::size_t>(out.status.first - status.data()), reference,
                      count);
      }
    }
  }

  template <typename T>
  static void expect_status(const std::vector<SampleStatus>& status, std::size_t first,
                            const Planes<T>& reference, std::size_t count) {
    std::vector<SampleStatus> expected(status.size(), static_cast<SampleStatus>(77));
    std::copy_n(reference.status().begin(), count,
                expected.begin() + static_cast<std::ptrdiff_t>(first));
    EXPECT_TRUE(status == expected);
  }

  /// Statuses beside planes that begin at one place within a line.
  template <typename T>
  void streams_normals(const PatchSet<T>& set, const Grid<T>& samples, Turns& turns,
                       Canvas<T>& canvas) {
    constexpr PlaneCase kLayout{"planes_position_normal", kP | kN, 1, 0};
    const Planes<T> reference = reference_of(set, samples);
    for (std::size_t shift = 0; shift < 16; shift += 3) {
      turns.next();
      const std::size_t count = turns.patches * samples.nu * samples.nv;
      canvas.reset(plane_elements(kLayout, count));
      Outputs<T> out = plane_outputs(kLayout, count, shift, canvas.at(0));
      std::vector<SampleStatus> status(count + 128, static_cast<SampleStatus>(77));
      out.status = status.data() + 64;
      check(set, samples, reference, canvas, out,
            {.threads = turns.threads,
             .destination = Destination::memory,
             .patch_count = turns.patches},
            kLayout.name);
      expect_status(status, 64, reference, count);
    }
  }

  /// Statuses beside normals that are streamed from registers: those of degenerate patches, of
  /// samples outside and of parameters that are no numbers.
  template <typename T>
  void normals_with_status() {
    const PatchSet<T> set = packed<T>(mixed_nets(kMostPatches));
    Canvas<T> canvas(0);
    Turns turns;
    for (const Size size :
         {Size{9, 9}, Size{12, 4}, Size{16, 4}, Size{17, 17}, Size{17, 5}, Size{24, 3}, Size{28, 3},
          Size{31, 6}, Size{32, 5}, Size{33, 4}, Size{64, 4}, Size{65, 9}}) {
      std::vector<T> x;
      for (std::size_t k = 0; k < size.nu; ++k) {
        x.push_back(static_cast<T>(2 * k) / static_cast<T>(size.nu - 1) - T(1));
      }
      for (const std::size_t column : {std::size_t{5}, size.nu - 1}) {
        const T usual = x[column];
        for (const T odd : {usual, T(1.25), std::numeric_limits<T>::quiet_NaN()}) {
          x[column] = odd;
          streams_normals<T>(set, {size.nu, size.nv, x.data(), x.data(), Parameters::centred},
                             turns, canvas);
        }
        x[column] = usual;
      }
    }
  }

  /// More patches than any queue of finished rows or blocks is long.
  template <typename T>
  void many_patches() {
    const PatchSet<T> set = packed<T>(mixed_nets(100));
    Canvas<T> canvas(0);
    std::size_t number = 0;
    for (const Size size :
         {Size{3, 3}, Size{5, 4}, Size{6, 6}, Size{9, 9}, Size{11, 11}, Size{13, 3}, Size{16, 16},
          Size{17, 5}, Size{17, 17}, Size{26, 2}, Size{31, 2}, Size{32, 3}, Size{33, 9}}) {
      const Grid<T> samples = Grid<T>::uniform(size.nu, size.nv);
      const Planes<T> reference = reference_of(set, samples);
      const std::size_t count = reference.count();
      ++number;
      for (const int threads : {1, 2, 3}) {
        const CallOptions options{
            .threads = threads, .destination = Destination::memory, .patch_count = 100};
        std::size_t place = number + static_cast<std::size_t>(threads);
        for (const PlaneCase& layout : kPlaneCases) {
          if (!in_form(++place, 3)) {
            continue;
          }
          canvas.reset(plane_elements(layout, count));
          check(set, samples, reference, canvas, plane_outputs(layout, count, 5, canvas.at(0)),
                options, layout.name);
        }
        for (const VertexCase& layout : vertex_cases()) {
          if (!in_form(++place, 3)) {
            continue;
          }
          canvas.reset(vertex_elements(layout, count) + 1);
          check(set, samples, reference, canvas, vertex_outputs(layout, count, canvas.at(1)),
                options, layout.name);
        }
      }
    }
  }

  /// Squares whose given parameters are pairs, which may take code that is made for uniform ones.
  template <typename T>
  void mirrored_parameters() {
    const PatchSet<T> set = packed<T>(mixed_nets(4));
    Random random(33);
    Canvas<T> canvas(0);
    for (std::size_t n = 3; n <= 18; ++n) {
      std::vector<T> x(n, T(0));
      for (std::size_t k = 0; k < n / 2; ++k) {
        x[k] = k == 0 ? T(-1) : static_cast<T>(-random.between(0.01, 0.99));
        x[n - 1 - k] = -x[k];
      }
      const Grid<T> samples{n, n, x.data(), x.data(), Parameters::centred};
      const Planes<T> reference = reference_of(set, samples);
      const std::size_t count = reference.count();
      const CallOptions options{.threads = 1, .destination = Destination::memory, .patch_count = 4};
      for (const PlaneCase& layout : kPlaneCases) {
        for (const std::size_t shift : {n % 16, (3 * n + 5) % 16}) {
          canvas.reset(plane_elements(layout, count));
          check(set, samples, reference, canvas, plane_outputs(layout, count, shift, canvas.at(0)),
                options, layout.name);
        }
      }
    }
  }

  /// Given parameters: edges in the middle of rows, samples outside, and a single row or column.
  template <typename T>
  void given_parameters() {
    const PatchSet<T> set = packed<T>(mixed_nets(4));
    Random random(31);
    Canvas<T> canvas(0);
    for (std::size_t nu = 1; nu <= 70; nu += nu < 36 ? 1 : 11) {
      const std::size_t nv = nu % 5 + 1;
      std::vector<T> x;
      std::vector<T> y;
      for (std::size_t k = 0; k < nu; ++k) {
        x.push_back(boundary_centred<T>(random));
      }
      for (std::size_t k = 0; k < nv; ++k) {
        y.push_back(k == 2 ? T(1.5) : boundary_centred<T>(random));
      }
      const Grid<T> samples{nu, nv, x.data(), y.data(), Parameters::centred};
      const Planes<T> reference = reference_of(set, samples);
      const std::size_t count = reference.count();
      const CallOptions options{.threads = 1, .destination = Destination::memory, .patch_count = 4};
      for (const PlaneCase& layout : kPlaneCases) {
        canvas.reset(plane_elements(layout, count));
        check(set, samples, reference, canvas, plane_outputs(layout, count, nu % 16, canvas.at(0)),
              options, layout.name);
      }
      for (const VertexCase& layout : vertex_cases()) {
        canvas.reset(vertex_elements(layout, count) + nu % 16);
        check(set, samples, reference, canvas, vertex_outputs(layout, count, canvas.at(nu % 16)),
              options, layout.name);
      }
    }
  }
};

TEST_P(DestinationTest, PlanesAtEveryAlignmentF32) { planes_at_every_alignment<float>(); }
TEST_P(DestinationTest, PlanesAtEveryAlignmentF64) { planes_at_every_alignment<double>(); }
TEST_P(DestinationTest, VerticesAtEveryAlignmentF32) { vertices_at_every_alignment<float>(); }
TEST_P(DestinationTest, VerticesAtEveryAlignmentF64) { vertices_at_every_alignment<double>(); }
TEST_P(DestinationTest, LocalOriginsF32) { local_origins<float>(); }
TEST_P(DestinationTest, LocalOriginsF64) { local_origins<double>(); }
TEST_P(DestinationTest, MirroredParametersF32) { mirrored_parameters<float>(); }
TEST_P(DestinationTest, MirroredParametersF64) { mirrored_parameters<double>(); }
TEST_P(DestinationTest, MixturesF32) { mixtures<float>(); }
TEST_P(DestinationTest, MixturesF64) { mixtures<double>(); }
TEST_P(DestinationTest, NormalsWithStatusF32) { normals_with_status<float>(); }
TEST_P(DestinationTest, NormalsWithStatusF64) { normals_with_status<double>(); }
TEST_P(DestinationTest, ManyPatchesF32) { many_patches<float>(); }
TEST_P(DestinationTest, ManyPatchesF64) { many_patches<double>(); }
TEST_P(DestinationTest, GivenParametersF32) { given_parameters<float>(); }
TEST_P(DestinationTest, GivenParametersF64) { given_parameters<double>(); }
INSTANTIATE_FOR_EVERY_ISA(DestinationTest);

} // namespace
} // namespace simdbezier::tests::destinations_test
