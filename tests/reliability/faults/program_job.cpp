#include "tests/reliability/faults/program_job.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

namespace simdbezier::tests {

namespace {

constexpr const char* kBefore = "what was there before";

std::string input_text() {
  std::string text;
  for (int k = 0; k < 8; ++k) {
    text += "5\n3 3\n";
    for (int point = 0; point < 16; ++point) {
      text += std::to_string(point % 4 + 4 * k) + " " + std::to_string(point / 4) + " " +
              std::to_string((point * (k + 3)) % 5) + "\n";
    }
  }
  return text;
}

std::string samples_text() {
  std::string text = "patch,u,v\n";
  for (int k = 0; k < 5000; ++k) {
    text += std::to_string(k % 8) + ",0." + std::to_string(k % 997) + ",0.5\n";
  }
  return text;
}

} // namespace

const std::vector<Job>& jobs() {
  static const std::vector<Job> all = {
      {"obj", {"tessellate", "--grid", "32", "--threads", "2"}, "out.obj"},
      {"ply", {"tessellate", "--grid", "48", "--threads", "1"}, "out.ply"},
      {"stats", {"tessellate", "--grid", "24", "--threads", "1", "--stats=json"}, "out.stl"},
      {"csv", {"evaluate", "--outputs", "position,normal", "--samples", "SAMPLES"}, "out.csv"},
      {"stream", {"evaluate", "--grid", "24", "--threads", "1"}, "-"},
      {"info", {"info", "--json"}, ""}};
  return all;
}

std::vector<const Job*> job_pointers() {
  std::vector<const Job*> list;
  for (const Job& job : jobs()) {
    list.push_back(&job);
  }
  return list;
}

Scene::Scene(const Job& job, bool replaces) : job_(job) {
  const std::string in = folder_.write("in.bv", input_text());
  arguments_ = job.options;
  arguments_.insert(arguments_.begin() + 1, in);
  for (std::string& argument : arguments_) {
    if (argument == "SAMPLES") {
      argument = folder_.write("samples.csv", samples_text());
    }
  }
  const std::string_view out = job.out;
  if (!out.empty()) {
    arguments_.insert(arguments_.end(), {"-o", out == "-" ? "-" : folder_.path(job.out)});
  }
  const Outcome untroubled = run(arguments_);
  EXPECT_EQ(untroubled.exit_code, 0) << untroubled.err;
  complete_ = writes_file() ? output() : untroubled.out;
  EXPECT_GT(complete_.value_or("").size(), 0U);
  if (replaces) {
    before_ = kBefore;
  }
  reset();
}

bool Scene::writes_file() const {
  const std::string_view out = job_.out;
  return !out.empty() && out != "-";
}

bool Scene::is_told() const {
  return std::ranges::find(job_.options, "--stats=json") != job_.options.end();
}

void Scene::reset() {
  for (const std::string& name : folder_.names()) {
    if (name != "in.bv" && name != "samples.csv") {
      std::filesystem::remove(folder_.path(name));
    }
  }
  if (before_) {
    folder_.write(job_.out, *before_);
  }
}

std::optional<std::string> Scene::output() const {
  if (!std::filesystem::exists(folder_.path(job_.out))) {
    return std::nullopt;
  }
  return read_file(folder_.path(job_.out));
}

void Scene::expect_sound(const Outcome& outcome, int signal) const {
  for (const std::string& name : folder_.names()) {
    EXPECT_TRUE(name == "in.bv" || name == "samples.csv" || name == job_.out)
        << name << " was left behind";
  }
  const bool done = outcome.exit_code == 0;
  if (writes_file()) {
    const auto now = output();
    EXPECT_TRUE((outcome.exit_code != 1 && now == complete_) || (!done && now == before_))
        << "the output has " << (now ? std::to_string(now->size()) + " bytes" : "gone");
    if (is_told()) {
      EXPECT_TRUE(!done || outcome.out.ends_with("}\n")) << "found: " << outcome.out;
    } else {
      EXPECT_EQ(outcome.out, "");
    }
  } else {
    EXPECT_TRUE(done ? outcome.out == complete_ : complete_->starts_with(outcome.out))
        << "other output than without trouble";
  }
  if (done) {
    EXPECT_EQ(outcome.err, "");
  } else if (outcome.signal != 0) {
    EXPECT_EQ(outcome.signal, signal) << outcome.err;
  } else {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with('\n')) << "no message: " << outcome.err;
  }
}

bool every_place() {
  const char* const wish = std::getenv("SIMDBEZIER_FAULTS");
  return wish != nullptr && std::string_view(wish) == "all";
}

std::vector<long> places(long count, long most) {
  const long chosen = every_place() ? count : std::min(count, most);
  std::vector<long> list;
  for (long k = 0; k < chosen; ++k) {
    list.push_back(chosen == 1 ? 1 : 1 + k * (count - 1) / (chosen - 1));
  }
  return list;
}

} // namespace simdbezier::tests
