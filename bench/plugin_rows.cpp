// A plug-in is checked in its own process first, with at most as many patches as its memory shares.
// Then its file is loaded here, its results are compared with the reference, and its calls timed.
#include "bench/plugin_rows.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <dlfcn.h>

#include <simdbezier/evaluator_plugin.h>

#include <tools/process/failure.hpp>

#include "bench/timed_grid.hpp"

namespace simdbezier_bench {
namespace {

using simdbezier::tools::EvaluatorDied;
using simdbezier::tools::PluginGridTask;
using simdbezier::tools::PluginPatchTask;

constexpr Size kSizes[] = {{4, 4}, {8, 8}, {16, 16}, {17, 17}, {32, 32}, {33, 33}, {65, 65}};
constexpr std::size_t kTriedPatches = 64;

template <typename T>
using PatchFunction = int (*)(const T*, int, int, const T*, const T*, const T*, std::size_t, T*, T*,
                              T*);
using GridFunction = decltype(&sbe_grid_f32);

template <typename F>
F symbol(void* library, const char* name) {
  return library == nullptr ? nullptr : reinterpret_cast<F>(dlsym(library, name));
}

/// A row of one plug-in, which writes x y z triples as de_casteljau does.
template <typename T>
class TimedPlugin {
public:
  TimedPlugin(PluginProcess process, OutputGroups outputs, Size size, MemoryLevel level)
      : process_(std::move(process)) {
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
    job_.out = place_results<T>(outputs, job_.patches * u_.size(), Layout::triples);
  }

  std::string check() {
    try {
      if (const std::string fault = tried(); !fault.empty()) {
        return fault;
      }
    } catch (const EvaluatorDied& died) {
      return died.what();
    }
    load();
    if (patch_ == nullptr && grid_ == nullptr) {
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
    load();
    T* const* const out = job_.out.component;
    if (grid_ != nullptr) {
      if constexpr (std::is_same_v<T, float>) {
        answer_ = grid_(job_.input, job_.patches, job_.nu, job_.nv, out[0], out[3], out[6]);
      }
      return;
    }
    for (std::size_t p = 0; p < job_.patches; ++p) {
      const std::size_t first = 3 * p * u_.size();
      answer_ |= patch_(job_.input + 48 * p, 3, 3, nullptr, u_.data(), v_.data(), u_.size(),
                        out[0] + first, part(out[3], first), part(out[6], first));
    }
  }

  [[nodiscard]] double items() const { return static_cast<double>(job_.patches * u_.size()); }
  [[nodiscard]] double bytes() const {
    return items() * static_cast<double>(value_count(job_.out.groups) * sizeof(T));
  }

private:
  static T* part(T* values, std::size_t first) {
    return values == nullptr ? nullptr : values + first;
  }

  [[nodiscard]] std::string refused(int answer) const {
    return process_->facts().file + ": returned " + std::to_string(answer) + " for bicubic patches";
  }

  /// Runs some patches in the plug-in's own process. Returns an empty string, or what went wrong.
  std::string tried() {
    const std::size_t patches = std::min(job_.patches, kTriedPatches);
    const bool tangents = job_.out.groups == OutputGroups::position_derivatives;
    const std::size_t values = 3 * patches * u_.size();
    std::vector<T> position(values);
    std::vector<T> du(tangents ? values : 0);
    std::vector<T> dv(du.size());
    const std::span<const T> nets(job_.input, 48 * patches);
    int answer = 0;
    if constexpr (std::is_same_v<T, float>) {
      if (process_->facts().grid_f32) {
        answer =
            process_->evaluate(PluginGridTask{nets, patches, job_.nu, job_.nv, position, du, dv});
        return answer != 0 ? refused(answer) : find_nan(position, du, dv);
      }
    }
    const std::size_t count = 3 * u_.size();
    for (std::size_t p = 0; p < patches && answer == 0; ++p) {
      const auto of = [&](std::vector<T>& all) {
        return all.empty() ? std::span<T>() : std::span<T>(all).subspan(p * count, count);
      };
      answer = process_->evaluate(PluginPatchTask<T>{
          nets.subspan(48 * p, 48), 3, 3, {}, u_, v_, of(position), of(du), of(dv)});
    }
    return answer != 0 ? refused(answer) : find_nan(position, du, dv);
  }

  std::string find_nan(const std::vector<T>& position, const std::vector<T>& du,
                       const std::vector<T>& dv) const {
    const std::pair<const std::vector<T>*, const char*> all[] = {
        {&position, "position"}, {&du, "du"}, {&dv, "dv"}};
    for (const auto& [values, name] : all) {
      for (std::size_t k = 0; k < values->size(); ++k) {
        if (std::isnan((*values)[k])) {
          return process_->facts().file + ": " + name + " is nan, or was not written, at sample " +
                 std::to_string(k / 3 % u_.size()) + " of patch " +
                 std::to_string(k / 3 / u_.size());
        }
      }
    }
    return {};
  }

  void load() {
    if (patch_ != nullptr || grid_ != nullptr) {
      return;
    }
    const auto file = std::filesystem::absolute(process_->facts().file);
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    constexpr bool kSingle = std::is_same_v<T, float>;
    patch_ = symbol<PatchFunction<T>>(library, kSingle ? "sbe_evaluate_f32" : "sbe_evaluate_f64");
    if (kSingle) {
      grid_ = symbol<GridFunction>(library, "sbe_grid_f32");
    }
  }

  PluginProcess process_;
  std::vector<T> u_;
  std::vector<T> v_;
  GridJob<T> job_;
  PatchFunction<T> patch_ = nullptr;
  GridFunction grid_ = nullptr;
  int answer_ = 0;
};

template <typename T>
void add_rows(const PluginProcess& plugin) {
  for (const OutputGroups outputs : {OutputGroups::position, OutputGroups::position_derivatives}) {
    for (const Size size : kSizes) {
      for (const MemoryLevel level : {MemoryLevel::cache, MemoryLevel::memory}) {
        RowName name{"grid", outputs, sizeof(T) == 4, plugin->facts().name};
        name.nu = size.nu;
        name.nv = size.nv;
        name.level = level;
        register_row(name.text(), benchmark::kMicrosecond, 1,
                     [=] { return TimedPlugin<T>(plugin, outputs, size, level); });
      }
    }
  }
}

} // namespace

std::vector<std::string> take_evaluators(std::vector<char*>& arguments) {
  constexpr char kFlag[] = "--evaluator";
  std::vector<std::string> files;
  for (std::size_t k = 1; k < arguments.size();) {
    const std::string word = arguments[k];
    const bool next = word == kFlag && k + 1 < arguments.size();
    if (!next && word.rfind(std::string(kFlag) + "=", 0) != 0) {
      ++k;
      continue;
    }
    files.push_back(next ? arguments[k + 1] : word.substr(sizeof kFlag));
    const auto at = arguments.begin() + static_cast<std::ptrdiff_t>(k);
    arguments.erase(at, at + (next ? 2 : 1));
  }
  return files;
}

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
  for (const PluginProcess& plugin : plugins) {
    if (plugin->facts().f32 || plugin->facts().grid_f32) {
      add_rows<float>(plugin);
    }
    if (plugin->facts().f64) {
      add_rows<double>(plugin);
    }
  }
}

} // namespace simdbezier_bench
