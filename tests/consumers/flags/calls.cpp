// A consumer that prints a hash of the bits of each kind of call, and before them how it was
// compiled. Its inputs are integers times powers of two, which no compiler's flag changes.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <span>
#include <vector>

#include <simdbezier.h>
#include <simdbezier/simdbezier.hpp>

using namespace simdbezier;

namespace {

/// FNV-1a over bits.
class Hash {
public:
  template <typename T>
  void add(std::span<T> values) {
    for (const std::byte byte : std::as_bytes(values)) {
      state_ = (state_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ULL;
    }
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  void add(Status status) {
    const int code = status.code();
    add(std::span<const int>(&code, 1));
  }
  void print(const char* type, const char* model, const char* call) const {
    std::printf("%s %s %s %016llx\n", type, model, call, static_cast<unsigned long long>(state_));
  }

private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

// Parameters are constants where what they are made of is.
static_assert(UnitParameter<float>::fraction(1, 4).complement() == 0.75f);
static_assert(UnitParameter<double>(0.25).complement() == 0.75);

/// What the compiler cannot know.
volatile int secret_one = 1;

/// Integers of at most 2^11 in all directions.
int scattered_integer(std::size_t k) {
  return static_cast<int>((k * 2654435761U >> 7) % 4095) - 2047;
}

/// Numbers with exponents below those of normal ones, from their bits: arithmetic that a caller's
/// -Ofast sets up for itself takes them for zero.
template <typename T>
T denormal(std::size_t k) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  const Bits bits = static_cast<Bits>(scattered_integer(k) + 2048) << (sizeof(T) == 4 ? 10 : 38);
  T value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

struct Model {
  const char* name;
  int degree_u;
  int degree_v;
  Weights weights;
  bool collapsed; ///< one edge is a point: normals there are limits
  bool denormal;
};
constexpr Model kModels[] = {
    {"bicubic", 3, 3, Weights::none, false, false},
    {"collapsed", 3, 3, Weights::none, true, false},
    {"rational", 4, 2, Weights::cartesian, false, false},
    {"denormal", 3, 3, Weights::none, false, true},
};
constexpr std::size_t kPatches = 5;

template <typename T>
std::vector<T> points_of(const Model& model) {
  std::vector<T> points;
  const std::size_t row = static_cast<std::size_t>(model.degree_u) + 1;
  const std::size_t net = row * (static_cast<std::size_t>(model.degree_v) + 1);
  for (std::size_t point = 0; point < kPatches * net; ++point) {
    const bool on_point = model.collapsed && point % net < row;
    const std::size_t key = on_point ? point / net : point;
    for (std::size_t c = 0; c < 3; ++c) {
      points.push_back(model.denormal ? denormal<T>(3 * key + c)
                                      : static_cast<T>(scattered_integer(3 * key + c)) * T(0x1p-6));
    }
    if (model.weights != Weights::none) {
      points.push_back(T(1) + static_cast<T>(point % 7) * T(0x1p-3));
    }
  }
  return points;
}

template <typename T>
class Calls {
public:
  Calls(const char* type, const Model& model)
      : type_(type), model_(model), points_(points_of<T>(model)),
        nets_(ControlNets<T>::packed(points_, model.degree_u, model.degree_v, 3, model.weights)) {}

  void run() {
    Hash packing;
    packing.add(pack(nets_, set_).status);
    packing.print(type_, model_.name, "pack");
    surfaces();
    derivatives();
    curves();
    operations();
    bounds();
    meshes();
  }

private:
  void add_surface(const char* call, const SurfaceSamples<T>& samples) {
    Hash hash;
    hash.add(samples.status);
    for (std::size_t k = 0; k < kVectorOutputs; ++k) {
      auto copy = samples;
      hash.add(copy[static_cast<Output>(k)]);
    }
    for (const auto* const values :
         {&samples.gaussian, &samples.mean, &samples.minimum, &samples.maximum}) {
      hash.add(*values);
    }
    hash.add(samples.sample_status);
    hash.print(type_, model_.name, call);
  }
  void surfaces() {
    const OutputSelection all{Output::position, Output::du,        Output::dv,
                              Output::duu,      Output::duv,       Output::dvv,
                              Output::normal,   Output::curvature, Output::status};
    add_surface("grid", evaluate(set_, Grid<T>::uniform(17, 6), all, options_));
    add_surface("scattered", evaluate(set_, Samples<T>{patch_, u_, v_}, all, options_));
  }
  void derivatives() {
    std::vector<T> third(3 * patch_.size());
    std::vector<T> mixed(3 * patch_.size());
    const std::vector<PartialDerivative<T>> wanted{{3, 0, Vectors<T>::xyz(third)},
                                                   {2, 1, Vectors<T>::xyz(mixed)}};
    Hash hash;
    hash.add(evaluate_derivatives(set_, Samples<T>{patch_, u_, v_}, wanted, options_));
    hash.add(third);
    hash.add(mixed);
    hash.print(type_, model_.name, "derivatives");
  }
  void curves() {
    const auto rows = ControlCurves<T>::packed(points_, model_.degree_u, 3, model_.weights);
    CurveSet<T> set;
    Hash hash;
    hash.add(pack(rows, set).status);
    constexpr std::size_t kSamples = 13;
    std::vector<T> vectors[kCurveVectorOutputs];
    std::vector<T> curvature(kSamples * set.size());
    CurveOutputs<T> out;
    for (std::size_t k = 0; k < kCurveVectorOutputs; ++k) {
      vectors[k].resize(3 * kSamples * set.size());
      out[static_cast<CurveOutput>(k)] = Vectors<T>::xyz(vectors[k]);
    }
    out.curvature = curvature;
    hash.add(evaluate(set, CurveGrid<T>::uniform(kSamples), out, options_));
    for (const auto& values : vectors) {
      hash.add(values);
    }
    hash.add(curvature);
    const Polylines<T> lines = flatten<T>(rows, 0x1p-4, options_);
    hash.add(lines.report.status);
    hash.add(lines.points);
    hash.print(type_, model_.name, "curves");
  }

  /// Pieces at parameters of every kind: a number, its complement, a fraction.
  void operations() {
    const T tenth = T(0x1.99999ap-4) * static_cast<T>(secret_one);
    const UnitParameter<T> parameters[] = {tenth, T(1) - tenth, UnitParameter<T>::from_end(tenth),
                                           UnitParameter<T>::fraction(secret_one, 3),
                                           UnitParameter<T>::fraction(2, 6 + secret_one)};
    Hash hash;
    for (const UnitParameter<T>& at : parameters) {
      std::vector<T> low(points_.size());
      std::vector<T> high(points_.size());
      hash.add(split_u(nets_, at, packed(low), packed(high), options_).status);
      hash.add(low);
      hash.add(high);
      hash.add(segment(nets_, {at, T(1), T(0), at.mirrored()}, packed(low), options_).status);
      hash.add(low);
    }
    hash.print(type_, model_.name, "operations");
  }
  [[nodiscard]] MutableNets<T> packed(std::vector<T>& values) const {
    return MutableNets<T>::packed(values.data(), nets_.count, nets_.degree_u, nets_.degree_v, 3,
                                  nets_.weights);
  }

  void bounds() {
    std::vector<T> low(3 * kPatches);
    std::vector<T> high(3 * kPatches);
    std::vector<T> distance(kPatches);
    Hash hash;
    hash.add(tight_boxes(nets_, 1, {low, high}, options_).status);
    hash.add(flatness(nets_, distance, options_).status);
    hash.add(low);
    hash.add(high);
    hash.add(distance);
    const ErrorBounds errors = error_bounds(set_, 1);
    hash.add(std::span<const double>(errors.position));
    hash.print(type_, model_.name, "bounds");
  }
  void meshes() {
    const Mesh<T> mesh = tessellate<T>(nets_, {.relative_tolerance = 0x1p-5});
    Hash hash;
    hash.add(mesh.report.status);
    hash.add(mesh.positions);
    hash.add(mesh.normals);
    hash.add(mesh.triangles);
    hash.add(mesh.deviations);
    hash.print(type_, model_.name, "mesh");
  }

  const char* type_;
  const Model& model_;
  std::vector<T> points_;
  ControlNets<T> nets_;
  PatchSet<T> set_;
  Options options_{.threads = 2};
  std::vector<std::uint32_t> patch_{0, 0, 4, 2, 3, 1, 1};
  std::vector<T> u_{T(0), T(0x1p-3), T(0x1.8p-1), T(1), T(0x1.2345p-2), T(0), T(0x1.fp-1)};
  std::vector<T> v_{T(0), T(0x1.7p-1), T(0x1p-1), T(0), T(0x1.9999p-4), T(1), T(0x1p-9)};
};

/// The C header's own functions, of one call.
void from_c() {
  const std::vector<double> points = points_of<double>(kModels[0]);
  const simdbezier_nets nets =
      simdbezier_packed_nets_f64(points.data(), points.size(), 3, 3, 3, SIMDBEZIER_POLYNOMIAL);
  std::vector<double> low(points.size());
  std::vector<double> high(points.size());
  const auto packed = [](std::vector<double>& values) {
    return simdbezier_packed_mutable_nets_f64(values.data(), values.size(), 3, 3, 3,
                                              SIMDBEZIER_POLYNOMIAL);
  };
  const simdbezier_mutable_nets to_low = packed(low);
  const simdbezier_mutable_nets to_high = packed(high);
  const simdbezier_status status =
      simdbezier_split_u(&nets, simdbezier_fraction(secret_one, 3), &to_low, &to_high, nullptr);
  Hash hash;
  hash.add(std::span<const simdbezier_status>(&status, 1));
  hash.add(low);
  hash.add(high);
  hash.print("C", "bicubic", "operations");
}

} // namespace

int main() {
#if defined(__FAST_MATH__)
  std::puts("compiled with -Ofast");
#elif defined(__OPTIMIZE__)
  std::puts("compiled with -O");
#else
  std::puts("compiled with -O0");
#endif
  for (const Model& model : kModels) {
    Calls<float>("float", model).run();
    Calls<double>("double", model).run();
  }
  from_c();
  return 0;
}
