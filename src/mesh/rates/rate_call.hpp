// One call for rates: which patches go to a kernel, and which to PatchBound.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <new>
#include <vector>

#include <simdbezier/rates.hpp>

#include "src/mesh/rates/patch_bound.hpp"
#include "src/mesh/topology/topology_data.hpp"
#include "src/nets/net_call.hpp"
#include "src/tables/rate_task.hpp"

namespace simdbezier::detail {

/// Raises rates until no segment has more than `most` of what is measured in u and in v.
inline CellCounts at_least(const CellCounts& cells, const std::array<double, 2>& measured,
                           double most) {
  const auto segments = [&](std::uint32_t n, double all) {
    const double wanted = std::ceil(all / most);
    return wanted > n ? static_cast<std::uint32_t>(std::min(wanted, 1e9)) : n;
  };
  return {segments(cells.nu, measured[0]), segments(cells.nv, measured[1])};
}

/// One call: bicubic polynomial patches go to a kernel, and all that it leaves goes to PatchBound.
template <typename S>
class RateCall {
public:
  /// isa: one that is there, for options.isa.
  RateCall(std::span<const ControlNets<S>> nets, const Topology& topology,
           const RateOptions& options, Isa isa, const CertifiedRates& out)
      : nets_(nets), flags_(topology.data()->flags), options_(options), isa_(isa),
        errors_(options.errors), out_(out),
        most_(std::clamp(options.most_segments, 1U, kMostSegments)) {
    const std::vector<double>& displacement = topology.data()->displacement;
    if (!displacement.empty()) {
      own_errors_ = displacement;
      for (std::size_t patch = 0; patch < errors_.size(); ++patch) {
        own_errors_[patch] += errors_[patch];
      }
      errors_ = own_errors_;
    }
    deviations_ = out.deviation;
    if (deviations_.empty()) {
      own_deviations_.resize(out.nu.size());
      deviations_ = own_deviations_;
    }
  }

  /// Chooses rates, with their certificates.
  RateReport choose() {
    if (const RateReport checked = find_faults(); !checked) {
      return checked;
    }
    const RateReport ran = run_kernels(true);
    if (!ran) {
      return ran;
    }
    const bool measures =
        std::isfinite(options_.longest_edge) || std::isfinite(options_.normal_angle);
    const auto is_open = [&](std::size_t patch, bool kernel) {
      return !kernel || measures || has_corner(patch) || out_.nu[patch] == kUndecided;
    };
    const RateReport report =
        for_patches(is_open, [&](std::size_t patch, const PatchBound& bound) -> Status {
          const double t = tolerance(patch);
          if (!(t > 0)) {
            return Status::bad_tolerance;
          }
          CellCounts cells = bound.choose(t, most_);
          if (measures) {
            cells = at_least(cells, bound.lengths(), options_.longest_edge);
            cells = at_least(cells, bound.normal_turns(), options_.normal_angle);
          }
          put(patch, cells);
          return raise_until(patch, bound, t);
        });
    return report && measures ? certify() : report;
  }

  /// Looks at the bound again where rates have been raised, since it does not fall with every step.
  RateReport settle(bool& changed) {
    const RateReport certified = certify();
    if (!certified) {
      return certified;
    }
    std::atomic<bool> any = false;
    const auto exceeds = [&](std::size_t patch, bool) {
      return !(deviations_[patch] <= wanted(patch));
    };
    const RateReport report =
        for_patches(exceeds, [&](std::size_t patch, const PatchBound& bound) -> Status {
          any = true;
          return raise_until(patch, bound, tolerance(patch));
        });
    changed = any;
    return report;
  }

  /// Certifies the caller's rates, for nets that have not been checked yet.
  RateReport certify_given() {
    for (std::size_t patch = 0; patch < out_.nu.size(); ++patch) {
      const auto is_rate = [](std::uint32_t n) { return n >= 1 && n <= kMostSegments; };
      if (!is_rate(out_.nu[patch]) || !is_rate(out_.nv[patch])) {
        return {Status::bad_rates, patch};
      }
    }
    const RateReport checked = find_faults();
    return checked ? certify() : checked;
  }

  /// Forms the certificate of the rates that are there: the kernel's, and where that one is coarser
  /// than the tolerance by which PatchBound may have chosen them, PatchBound's.
  RateReport certify() {
    const RateReport ran = run_kernels(false);
    if (!ran) {
      return ran;
    }
    const auto is_open = [&](std::size_t patch, bool kernel) {
      return !kernel || has_corner(patch) || deviations_[patch] < 0 ||
             !(deviations_[patch] <= wanted(patch));
    };
    return for_patches(is_open, [&](std::size_t patch, const PatchBound& bound) -> Status {
      const CellCounts cells{out_.nu[patch], out_.nv[patch]};
      certify_patch(patch, bound, cells);
      return Status::ok;
    });
  }

private:
  static bool suits_kernel(const ControlNets<S>& nets) {
    return nets.degree_u == 3 && nets.degree_v == 3 && nets.weights == Weights::none;
  }
  [[nodiscard]] bool has_corner(std::size_t patch) const {
    return has_forced_diagonal(flags_[patch]);
  }
  [[nodiscard]] double error(std::size_t patch) const {
    return errors_.empty() ? 0 : errors_[patch];
  }
  [[nodiscard]] double wanted(std::size_t patch) const {
    return options_.tolerances.empty() ? options_.tolerance : options_.tolerances[patch];
  }
  [[nodiscard]] double tolerance(std::size_t patch) const {
    return tolerance_less(wanted(patch), error(patch));
  }

  void put(std::size_t patch, const CellCounts& cells) {
    out_.nu[patch] = cells.nu;
    out_.nv[patch] = cells.nv;
  }
  void certify_patch(std::size_t patch, const PatchBound& bound, const CellCounts& cells) {
    deviations_[patch] = bound.bound(cells, &out_.diagonals[patch]) + error(patch);
  }
  Status raise_until(std::size_t patch, const PatchBound& bound, double t) {
    const CellCounts cells = bound.raise({out_.nu[patch], out_.nv[patch]}, t, most_);
    put(patch, cells);
    certify_patch(patch, bound, cells);
    return cells.nu <= most_ && cells.nv <= most_ ? Status::ok : Status::bad_tolerance;
  }

  RateReport find_faults() const {
    std::size_t first = 0;
    for (const ControlNets<S>& nets : nets_) {
      const NetReport checked = find_fault(nets, options_.threads);
      if (!checked) {
        return {checked.status, first + checked.patch};
      }
      first += nets.count;
    }
    return {};
  }

  RateReport run_kernels(bool choose) {
    std::size_t first = 0;
    Options run;
    run.threads = options_.threads;
    run.isa = isa_;
    for (const ControlNets<S>& nets : nets_) {
      if (suits_kernel(nets) && nets.count > 0) {
        RateTask<S> task{};
        task.in = view_of(nets);
        task.choose = choose;
        task.tolerance = options_.tolerance;
        task.tolerances = options_.tolerances.empty() ? nullptr : &options_.tolerances[first];
        task.errors = errors_.empty() ? nullptr : &errors_[first];
        task.most = most_;
        task.nu = &out_.nu[first];
        task.nv = &out_.nv[first];
        task.diagonals = &out_.diagonals[first];
        task.deviations = &deviations_[first];
        const Status status =
            run_net_kernel<S, RateTask<S>>(&NetTable<S>::rates, task, nets.count, kRateValues, run);
        if (status != Status::ok) {
          return {status};
        }
      }
      first += nets.count;
    }
    return {};
  }

  /// Calls visit(patch, bound) for all patches with is_open(patch, whether a kernel has seen it),
  /// in parallel; the report names the lowest one at fault.
  template <typename IsOpen, typename Visit>
  RateReport for_patches(const IsOpen& is_open, const Visit& visit) {
    std::size_t first = 0;
    for (const ControlNets<S>& nets : nets_) {
      std::vector<std::uint32_t> open;
      for (std::size_t patch = 0; patch < nets.count; ++patch) {
        if (is_open(first + patch, suits_kernel(nets))) {
          open.push_back(static_cast<std::uint32_t>(patch));
        }
      }
      std::vector<Status> found(open.size(), Status::ok);
      auto body = [&](int, std::size_t begin, std::size_t end) noexcept {
        try {
          PatchBound bound(isa_);
          for (std::size_t k = begin; k < end; ++k) {
            const std::size_t patch = first + open[k];
            found[k] = bound.read(nets, open[k], flags_[patch]) ? visit(patch, bound)
                                                                : Status::non_finite_input;
          }
        } catch (const std::bad_alloc&) {
          found[begin] = Status::out_of_memory;
        }
      };
      divide_work(open.size(), 5000, options_.threads, body);
      for (std::size_t k = 0; k < open.size(); ++k) {
        if (found[k] != Status::ok) {
          return {found[k], first + open[k]};
        }
      }
      first += nets.count;
    }
    return {};
  }

  std::span<const ControlNets<S>> nets_;
  const std::vector<std::uint8_t>& flags_;
  const RateOptions& options_;
  Isa isa_;
  std::span<const double> errors_; ///< of vertices, by rounding and by snapping
  std::vector<double> own_errors_;
  const CertifiedRates& out_;
  std::uint32_t most_;
  std::span<double> deviations_;
  std::vector<double> own_deviations_;
};

} // namespace simdbezier::detail
