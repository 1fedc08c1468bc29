// A plug-in is checked in its own process first, with at most as many patches as its memory shares.
// Then its file is loaded here, its results are compared with the reference, and its calls timed.
#include "bench/rows/plugin_rows.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <dlfcn.h>

#include <tools/process/failure.hpp>

#include "bench/rows/timed_grid.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::tools::EvaluatorDied;
using simdbezier::tools::EvaluatorFunctions;
using simdbezier::tools::kPluginVectors;
using simdbezier::tools::PluginGridTask;
using simdbezier::tools::PluginLayout;
using simdbezier::tools::PluginOutputs;
using simdbezier::tools::PluginPatchTask;

constexpr Size kSizes[] = {{4, 4}, {8, 8}, {16, 16}, {17, 17}, {32, 32}, {33, 33}, {65, 65}};
constexpr std::size_t kTriedPatches = 64;

/// Which of a plug-in's vectors the k-th group of a row's outputs is.
std::size_t vector_of(OutputGroups outputs, std::size_t group) {
  const bool is_normal = outputs == OutputGroups::position_normal && group == 1;
  return is_normal ? std::size_t{simdbezier::tools::kNormal} : group;
}

/// A row of one plug-in in one of its layouts.
template <typename T>
class TimedPlugin {
public:
  TimedPlugin(PluginProcess process, OutputGroups outputs, Size size, MemoryLevel level,
              PluginLayout layout)
      : process_(std::move(process)), layout_(layout),
        by_grid_(process_->facts().forms<T>().has_grid(layout)) {
    const std::vector<T> u = uniform_parameters<T>(size.nu);
    const std::vector<T> v = uniform_parameters<T>(size.nv);
    for (std::size_t k = 0; k < size.nu * size.nv; ++k) {
      u_.push_back(u[k % size.nu]);
      v_.push_back(v[k / size.nu]);
    }
    const GridRow row{outputs, Algorithm::de_casteljau, simdbezier::Isa::automatic, size, level};
    job_.patches = grid_patch_count<T>(row);
    job_.nu = size.nu;
    job_.nv = size.nv;
    job_.input = shared_nets<T>(job_.patches);
    const bool planes = layout == PluginLayout::planes;
    job_.out = place_results<T>(outputs, job_.patches * u_.size(),
                                planes ? Layout::planes : Layout::triples);
  }

  std::string check() {
    poison_grid(job_);
    try {
      const std::size_t patches = std::min(job_.patches, kTriedPatches);
      const int answer = run(patches, [&](const auto& task) { return process_->evaluate(task); });
      if (std::string fault = answer != 0 ? refused(answer) : find_nan(patches); !fault.empty()) {
        return fault;
      }
    } catch (const EvaluatorDied& died) {
      return died.what();
    }
    functions_ = load();
    if (!functions_) {
      return process_->facts().file + ": cannot be loaded a second time";
    }
    poison_grid(job_);
    (*this)();
    if (answer_ != 0) {
      return refused(answer_);
    }
    return check_grid(job_, job_.input);
  }

  void operator()() {
    if (!functions_) {
      functions_ = load();
    }
    answer_ = run(job_.patches, *functions_);
  }

  [[nodiscard]] double items() const { return static_cast<double>(job_.patches * u_.size()); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(value_count(job_.out.groups) * sizeof(T));
  }

private:
  /// Calls with one task for all patches, or with one for each. Returns an answer that is not 0,
  /// or 0.
  template <typename Call>
  int run(std::size_t patches, const Call& call) {
    PluginPatchTask<T> task{{}, 3, 3, {}, u_, v_, {layout_, {}}};
    std::array<T**, 3 * kMostGroups> wanted;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3 * group_count(job_.out.groups); ++k) {
      if (k % 3 == 0 || layout_ == PluginLayout::planes) {
        wanted[count] = &task.out.at[vector_of(job_.out.groups, k / 3)][k % 3];
        *wanted[count++] = job_.out.component[k];
      }
    }
    if (by_grid_) {
      return call(
          PluginGridTask<T>{{job_.input, 48 * patches}, patches, job_.nu, job_.nv, task.out});
    }
    int answer = 0;
    for (std::size_t p = 0; p < patches && answer == 0; ++p) {
      task.net = {job_.input + 48 * p, 48};
      answer = call(task);
      for (std::size_t k = 0; k < count; ++k) {
        *wanted[k] += u_.size() * job_.out.stride;
      }
    }
    return answer;
  }

  [[nodiscard]] std::string refused(int answer) const {
    return process_->facts().file + ": returned " + std::to_string(answer) + " for bicubic patches";
  }

  [[nodiscard]] std::string find_nan(std::size_t patches) const {
    for (std::size_t k = 0; k < 3 * group_count(job_.out.groups); ++k) {
      for (std::size_t sample = 0; sample < patches * u_.size(); ++sample) {
        if (std::isnan(job_.out.component[k][sample * job_.out.stride])) {
          return process_->facts().file + ": " +
                 simdbezier::tools::kPluginVectorNames[vector_of(job_.out.groups, k / 3)] +
                 " is nan, or was not written, at sample " + std::to_string(sample % u_.size()) +
                 " of patch " + std::to_string(sample / u_.size());
        }
      }
    }
    return {};
  }

  [[nodiscard]] std::optional<EvaluatorFunctions<T>> load() const {
    const auto file = std::filesystem::absolute(process_->facts().file);
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    return library == nullptr ? std::nullopt : std::optional(EvaluatorFunctions<T>(library));
  }

  PluginProcess process_;
  PluginLayout layout_;
  bool by_grid_;
  std::vector<T> u_;
  std::vector<T> v_;
  GridJob<T> job_;
  std::optional<EvaluatorFunctions<T>> functions_;
  int answer_ = 0;
};

/// Whether a plug-in has rows of these outputs: positions always, since a row says best what is
/// wrong with them, and others that it does not refuse.
template <typename T>
bool offers(const PluginProcess& plugin, OutputGroups outputs, PluginLayout layout) {
  const simdbezier::tools::EvaluatorForms& forms = plugin->facts().forms<T>();
  if (!forms.has_patch(layout) && !forms.has_grid(layout)) {
    return false;
  }
  if (outputs == OutputGroups::position) {
    return true;
  }
  if (layout == PluginLayout::triples && outputs != OutputGroups::position_derivatives) {
    return false;
  }
  const std::vector<T> net(kValuesPerPatch);
  const T parameters[] = {0, 1, 0, 1};
  T values[3 * kPluginVectors][4];
  PluginOutputs<T> out{layout, {}};
  for (std::size_t k = 0; k < group_count(outputs); ++k) {
    for (std::size_t c = 0; c < (layout == PluginLayout::planes ? 3 : 1); ++c) {
      out.at[vector_of(outputs, k)][c] = values[3 * k + c];
    }
  }
  try {
    return (forms.has_grid(layout) ? plugin->evaluate(PluginGridTask<T>{net, 1, 2, 2, out})
                                   : plugin->evaluate(PluginPatchTask<T>{
                                         net, 3, 3, {}, parameters, parameters, out})) == 0;
  } catch (const EvaluatorDied&) {
    return true; // its rows say how
  }
}

template <typename T>
void add_rows(const PluginProcess& plugin) {
  for (const PluginLayout layout : simdbezier::tools::kPluginLayouts) {
    for (const OutputGroups outputs :
         {OutputGroups::position, OutputGroups::position_normal, OutputGroups::position_derivatives,
          OutputGroups::second_derivatives}) {
      if (!offers<T>(plugin, outputs, layout)) {
        continue;
      }
      const auto add = [&](Size size, MemoryLevel level) {
        const RowName name{"grid",  outputs, sizeof(T) == 4, plugin->facts().name,
                           size.nu, size.nv, level};
        register_row(name.text() + (layout == PluginLayout::triples ? "/layout:aos" : ""),
                     benchmark::kMicrosecond, 1,
                     [=] { return TimedPlugin<T>(plugin, outputs, size, level, layout); });
      };
      for (const Size size : kSizes) {
        add(size, MemoryLevel::cache);
        add(size, MemoryLevel::memory);
      }
      for (const Size size : swept_beside(kSizes)) {
        add(size, MemoryLevel::cache);
      }
    }
  }
}

} // namespace

std::vector<PluginProcess> start_plugins(const std::vector<std::string>& files, bool& faulty) {
  std::vector<PluginProcess> plugins;
  for (const std::string& file : files) {
    try {
      plugins.push_back(std::make_shared<simdbezier::tools::EvaluatorProcess>(file));
    } catch (const simdbezier::tools::Failure& failure) {
      std::fprintf(stderr, "simdbezier_bench: %s\n", failure.what());
      faulty = true;
    }
  }
  return plugins;
}

void register_plugin_rows(const std::vector<PluginProcess>& plugins) {
  std::string names;
  for (const PluginProcess& plugin : plugins) {
    add_rows<float>(plugin);
    add_rows<double>(plugin);
    names += (names.empty() ? "" : " ") + plugin->facts().name;
  }
  if (!plugins.empty()) {
    benchmark::AddCustomContext("evaluators", names);
  }
}

} // namespace simdbezier_bench
