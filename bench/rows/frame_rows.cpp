// frame/position_normal/f32/<isa>/1x1/memory/threads:<t>/pixels:<p>: a frame of a model that moves,
// as examples/moving_model.cpp has it, from control points to triangles. Items are patches.
#include <memory>
#include <string>

#include "bench/rows/rows.hpp"
#include "examples/seed/moving_model.hpp"

namespace simdbezier_bench {
namespace {

using seed::MovingModel;
using simdbezier::Isa;

class FrameRow {
public:
  FrameRow(double pixels, Isa isa, int threads) {
    simdbezier::Options run;
    run.isa = isa;
    run.threads = threads;
    model_ = std::make_shared<MovingModel>(pixels, run);
  }
  void operator()() { (void)run(); }
  std::string check() { return std::string(run() ? "" : simdbezier::to_string(run())); }
  [[nodiscard]] double items() const { return MovingModel::kPatches; }
  [[nodiscard]] double bytes() const {
    const simdbezier::MeshSize size = model_->size();
    return 4 * (static_cast<double>(MovingModel::kVertex) * static_cast<double>(size.vertices) +
                3 * static_cast<double>(size.triangles));
  }

private:
  simdbezier::Status run() {
    model_->move(0.05 * frame_++);
    for (const MovingModel::Stage& stage : MovingModel::stages()) {
      if (const simdbezier::Status status = (*model_.*stage.run)(); !status) {
        return status;
      }
    }
    return simdbezier::Status::ok;
  }

  std::shared_ptr<MovingModel> model_;
  int frame_ = 0;
};

} // namespace

void register_frame_rows() {
  for (const Isa isa : simdbezier::available_isas()) {
    for (int threads = 1; threads <= max_threads(); ++threads) {
      for (const char* const pixels : {"0.5", "0.05"}) {
        const RowName name{"frame",
                           OutputGroups::position_normal,
                           true,
                           std::string(simdbezier::to_string(isa)),
                           1,
                           1,
                           MemoryLevel::memory,
                           threads};
        register_row(name.text() + "/pixels:" + pixels, benchmark::kMillisecond, threads,
                     [=] { return FrameRow(std::stod(pixels), isa, threads); });
      }
    }
  }
}

} // namespace simdbezier_bench
