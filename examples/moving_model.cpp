// A model that moves: 20 frames of 20 000 bicubic patches, meshed anew for half a pixel, and the
// milliseconds of each stage. docs/guide/moving_models.md explains them.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "seed/moving_model.hpp"

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const double pixels = argc > 1 ? std::atof(argv[1]) : 0.5;
  simdbezier::Options run;
  run.threads = argc > 2 ? std::atoi(argv[2]) : 1;
  constexpr int kFrames = 20;
  seed::MovingModel model(pixels, run);
  const auto stages = seed::MovingModel::stages();
  std::vector<std::vector<double>> milliseconds(stages.size());
  for (int frame = 0; frame < kFrames; ++frame) {
    model.move(0.05 * frame);
    for (std::size_t k = 0; k < stages.size(); ++k) {
      const auto begin = Clock::now();
      if (const simdbezier::Status status = (model.*stages[k].run)(); !status) {
        return std::printf("%s: %s\n", stages[k].name, to_string(status).data());
      }
      const std::chrono::duration<double, std::milli> elapsed = Clock::now() - begin;
      if (frame > 0) { // the first one joins edges, and meets all memory for the first time
        milliseconds[k].push_back(elapsed.count());
      }
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const double one = median(milliseconds[k]);
    std::printf("%-10s %7.2f ms\n", stages[k].name, one);
    sum += one;
  }
  std::printf("%-10s %7.2f ms\n", "frame", sum);
  std::printf("%s\n", model.size().triangles > 40000 ? "more than 40000 triangles" : "too few");
}
