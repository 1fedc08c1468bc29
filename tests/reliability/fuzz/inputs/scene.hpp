// A packed set of patches from bytes, and the reference's opinion on them.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <simdbezier/simdbezier.hpp>

#include "tests/reliability/fuzz/checks/require.hpp"
#include "tests/reliability/fuzz/checks/surface_reference.hpp"

namespace simdbezier::fuzz {

/// What pack() may return; sizes, pointers and strides are sound here.
inline void require_packed(const Report& report, bool moderate) {
  require_status(
      report.status,
      {Status::ok, Status::bad_weight, Status::non_finite_input, Status::coefficient_overflow},
      "pack");
  require(report || !moderate, "pack refuses moderate control points");
}

[[nodiscard]] inline PackOptions pack_options(ByteSource& bytes) {
  PackOptions options;
  const std::uint8_t choice = bytes.byte();
  options.local_origin = (choice & 1) != 0;
  options.threads = (choice & 2) != 0 ? 2 : 1;
  if ((choice & 12) == 12) {
    for (double& coordinate : options.relative_to) {
      const auto digits = static_cast<double>(bytes.raw<std::int16_t>());
      coordinate = std::ldexp(digits, bytes.between(-8, 8));
    }
  }
  return options;
}

/// How far the library may be from the reference, besides what it certifies: the reference's own
/// errors, and what the certificate does not count.
template <typename T>
[[nodiscard]] Real slack(const ReferencePatch& patch, int c, const PackOptions& options) {
  const Real shift = c < 3 ? static_cast<Real>(std::fabs(options.relative_to[c])) : 0;
  // Differences from relative_to are rounded to double where all is float.
  return (sizeof(T) == 4 ? 0x1p-50L : 0x1p-57L) * patch.size(c) + 0x1p-61L * shift +
         0x1p-1000L * std::numeric_limits<T>::min();
}

template <typename T>
class Scene {
public:
  /// Up to three kinds of nets; `packed()` tells whether the library took them.
  Scene(ByteSource& bytes, std::size_t most_patches) : options_(pack_options(bytes)) {
    const int with_components = fuzz::components(bytes);
    bytes.flag() ? add_nets<float>(bytes, with_components, most_patches)
                 : add_nets<T>(bytes, with_components, most_patches);
  }

  [[nodiscard]] bool packed() const { return packed_; }
  [[nodiscard]] const PatchSet<T>& set() const { return set_; }
  [[nodiscard]] const PackOptions& options() const { return options_; }
  [[nodiscard]] const ReferencePatch& patch(std::size_t k) const { return patches_[k]; }
  [[nodiscard]] int components() const { return set_.components(); }

private:
  template <typename S>
  void add_nets(ByteSource& bytes, int with_components, std::size_t most) {
    std::vector<Nets<S>> nets;
    bool moderate = true;
    for (std::size_t left = 1 + bytes.below(3); left > 0; --left) {
      nets.push_back(any_nets<S>(bytes, most, with_components));
      moderate = moderate && nets.back().moderate;
    }
    std::vector<ControlNets<S>> views;
    for (const Nets<S>& one : nets) {
      views.push_back(one.view());
    }
    const Report report = pack(std::span<const ControlNets<S>>(views), set_, options_);
    require_packed(report, moderate);
    packed_ = report.status == Status::ok;
    for (const Nets<S>& one : nets) {
      for (std::size_t p = 0; packed_ && p < one.count; ++p) {
        patches_.emplace_back(one, p, options_.relative_to);
      }
    }
    require(!packed_ || set_.size() == patches_.size(), "a set has another number of patches");
  }

  PackOptions options_;
  PatchSet<T> set_;
  std::vector<ReferencePatch> patches_;
  bool packed_ = false;
};

/// Judges positions and first derivatives of one patch by the library's certificate.
template <typename T>
class Judge {
public:
  Judge(const Scene<T>& scene, std::size_t patch, Isa isa)
      : scene_(scene), patch_(scene.patch(patch)), number_(patch),
        bounds_(error_bounds(scene.set(), patch, isa)) {}

  void position(const RealSample& exact, int c, T computed) const {
    const auto k = static_cast<std::size_t>(c);
    judge("position", exact.position[k], computed, bounds_.position[k],
          slack<T>(patch_, c, scene_.options()), c);
  }
  void derivative(const RealSample& exact, bool of_u, int c, T computed) const {
    const auto k = static_cast<std::size_t>(c);
    const Real steep = 8 * (of_u ? patch_.degree_u() : patch_.degree_v()) *
                       (patch_.rational() ? patch_.weight_ratio() : 1);
    judge(of_u ? "du" : "dv", of_u ? exact.du[k] : exact.dv[k], computed,
          of_u ? bounds_.du[k] : bounds_.dv[k], steep * slack<T>(patch_, c, scene_.options()), c);
  }

private:
  void judge(const char* what, Real exact, T computed, double bound, Real more, int c) const {
    // What T cannot hold is infinite; certificates say nothing of it.
    if (!std::isfinite(bound) || std::fabs(exact) > std::numeric_limits<T>::max() / 2) {
      return;
    }
    const Real error = std::fabs(static_cast<Real>(computed) - exact);
    require(error <= static_cast<Real>(bound) + more, [&] {
      return std::string(what) + " of patch " + std::to_string(number_) + ", component " +
             std::to_string(c) + " (degrees " + std::to_string(patch_.degree_u()) + " x " +
             std::to_string(patch_.degree_v()) + (patch_.rational() ? ", rational" : "") +
             "): computed " + std::to_string(computed) + ", exact " + std::to_string(exact) +
             ", error / bound " + std::to_string(error / static_cast<Real>(bound));
    });
  }

  const Scene<T>& scene_;
  const ReferencePatch& patch_;
  std::size_t number_;
  ErrorBounds bounds_;
};

} // namespace simdbezier::fuzz
