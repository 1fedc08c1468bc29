// See evaluate_mesh.hpp: vertices come to planes in a cache, and from there to their formats.
#include <simdbezier/evaluate_mesh.hpp>

#include "src/calls/call.hpp"
#include "src/mesh/net_points.hpp"
#include "src/mesh/vertices/formatted_columns.hpp"
#include "src/mesh/vertices/vertex_work.hpp"
#include "src/nets/net_call.hpp"
#include "src/runtime/both_types.hpp"
#include "src/runtime/fp_environment.hpp"
#include "src/tables/format_table.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// One thread's planes of a chunk, and what becomes of them.
template <typename T>
class FormattingSink {
public:
  [[nodiscard]] static std::size_t bytes(std::size_t chunk) noexcept {
    return kPlanes * whole_lines(chunk * sizeof(T));
  }
  FormattingSink(Isa isa, const FormattedColumns& out, std::size_t first_vertex, std::size_t chunk,
                 unsigned char* memory) noexcept
      : format_(separate_table<FormatTable<T>>(isa).format), out_(out),
        first_vertex_(first_vertex) {
    for (T*& plane : plane_) {
      plane = reinterpret_cast<T*>(memory);
      memory += whole_lines(chunk * sizeof(T));
    }
  }

  void begin(std::size_t vertex, VertexTarget<T>& to) noexcept {
    begin_ = vertex - first_vertex_;
    to = {};
    to.first = to.parameters_first = vertex;
    for (std::size_t c = 0; c < kPositionComponents; ++c) {
      to.position.component[c] = out_.position.wanted() ? plane_[c] : nullptr;
      to.normal.component[c] = out_.normal.wanted() ? plane_[kPositionComponents + c] : nullptr;
    }
    if (out_.parameters.wanted()) {
      to.parameters.u = plane_[kPlanes - 2];
      to.parameters.v = plane_[kPlanes - 1];
    }
  }
  void end(std::size_t vertices) noexcept {
    const QuantisationBox unit{{0, 0, 0}, 1.0 / 65535};
    format(out_.position, plane_, kPositionComponents, out_.box, vertices);
    format(out_.normal, plane_ + kPositionComponents, kPositionComponents, unit, vertices);
    format(out_.parameters, plane_ + kPlanes - 2, kParameterComponents, unit, vertices);
  }
  DrainQueue<T>* queue() const noexcept { return nullptr; }
  void finish() const noexcept {}

private:
  static constexpr std::size_t kPlanes = 2 * kPositionComponents + kParameterComponents;

  void format(const FormattedColumn& column, const T* const* planes, std::size_t components,
              const QuantisationBox& box, std::size_t vertices) const noexcept {
    if (column.wanted()) {
      format_({{planes[0], planes[1], planes[components - 1]},
               vertices,
               column.at(begin_),
               column.stride,
               column.format,
               components,
               box});
    }
  }

  void (*format_)(const FormatTask<T>&);
  const FormattedColumns& out_;
  std::size_t first_vertex_;
  std::size_t begin_ = 0;
  T* plane_[kPlanes];
};

/// Units are vertices.
template <typename T>
class FormattedWork {
public:
  FormattedWork(const PatchKernels<T>& kernels, const VertexTask<T>& task,
                const FormattedColumns& out) noexcept
      : out_(out), task_(task), kernels_(kernels), chunk_(task.chunk(kChunk)) {
    task_.kernels = &kernels_;
  }
  FormattedWork(const FormattedWork&) = delete;
  FormattedWork& operator=(const FormattedWork&) = delete;

  [[nodiscard]] std::size_t units() const noexcept {
    return task_.last_vertex - task_.first_vertex;
  }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(units(), 4); }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return FormattingSink<T>::bytes(chunk_) + Worker::scratch_bytes(task_);
  }
  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    FormattingSink<T> sink(kernels_.table->isa, out_, task_.first_vertex, chunk_, scratch);
    Worker worker(task_, chunk_, sink, scratch + FormattingSink<T>::bytes(chunk_));
    return worker.run(task_.first_vertex + begin, task_.first_vertex + end);
  }

private:
  using Worker = VertexWorker<T, FormattingSink<T>>;
  static constexpr std::size_t kChunk = 1024; ///< planes of float in 32 KiB

  const FormattedColumns& out_;
  VertexTask<T> task_;
  PatchKernels<T> kernels_;
  std::size_t chunk_; ///< vertices
};

template <typename T>
class FormattedCall {
public:
  FormattedCall(const PatchSet<T>& set, const MeshLayout& layout, const FormattedOutputs& out,
                const Options& options, SetRange patches) noexcept
      : set_(set), layout_(layout), given_(out), out_(out), options_(options), patches_(patches) {}

  Status resolve() noexcept {
    if (set_.size() != (layout_.data() == nullptr ? 0 : layout_.data()->patches())) {
      return Status::unequal_lengths;
    }
    return request_.resolve(set_, patches_, 0, options_);
  }
  Status check() noexcept {
    return request_.components.space() ? out_.check(given_, last() - first())
                                       : Status(Status::bad_components);
  }
  [[nodiscard]] bool empty() const noexcept { return first() == last(); }
  [[nodiscard]] FormattedWork<T> plan() const noexcept {
    OutputSelection wishes;
    if (out_.position.wanted()) {
      wishes.add(Output::position);
    }
    if (out_.normal.wanted()) {
      wishes.add(Output::normal);
    }
    const VertexTask<T> task{layout_.data(),
                             nullptr,
                             out_.position.wanted() ? kPositionComponents : 0,
                             out_.normal.wanted(),
                             ValuesOf::owner,
                             first(),
                             last()};
    return FormattedWork<T>({*set_.storage(), request_, wishes, options_}, task, out_);
  }

private:
  [[nodiscard]] std::size_t first() const noexcept { return layout_.first_vertex(request_.first); }
  [[nodiscard]] std::size_t last() const noexcept {
    return layout_.first_vertex(request_.first + request_.count);
  }

  const PatchSet<T>& set_;
  const MeshLayout& layout_;
  const FormattedOutputs& given_;
  FormattedColumns out_;
  const Options& options_;
  SetRange patches_;
  Request<T> request_;
};

} // namespace
} // namespace detail

template <typename S>
Status quantisation_box(std::span<const ControlNets<S>> nets, VertexFormat format,
                        QuantisationBox& box) noexcept {
  if (format != VertexFormat::unorm16 && format != VertexFormat::snorm16) {
    return Status::bad_tolerance;
  }
  std::size_t patches = 0;
  if (const Status status = detail::count_patches(nets, patches); !status) {
    return status;
  }
  const detail::DefaultFpEnvironment environment;
  detail::PointBox points;
  bool finite = true;
  for (const ControlNets<S>& view : nets) {
    if (const Status status = detail::check_in_space(view); !status) {
      return status;
    }
    for (std::size_t patch = 0; patch < view.count; ++patch) {
      detail::for_points(view, patch, [&](const detail::Point3& point) {
        points.include(point);
        finite = finite && detail::is_finite(point);
      });
    }
  }
  if (!finite) {
    return Status::non_finite_input;
  }
  const bool centred = format == VertexFormat::snorm16;
  const double step = points.longest() / (centred ? 2 * 32767 : 65535);
  if (!(step > 0 && std::isfinite(step))) {
    return Status::bad_tolerance;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] = centred ? points.middle(c) : points.low(c);
  }
  box.step = step;
  return Status::ok;
}

template <typename T>
Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout, const FormattedOutputs& out,
                     const Options& options, SetRange patches) noexcept {
  return detail::make_call(detail::FormattedCall<T>(set, layout, out, options, patches), options);
}

SIMDBEZIER_EXPORT_BOTH_TYPES(quantisation_box);
template SIMDBEZIER_API Status evaluate_mesh(const PatchSet<float>&, const MeshLayout&,
                                             const FormattedOutputs&, const Options&,
                                             SetRange) noexcept;
template SIMDBEZIER_API Status evaluate_mesh(const PatchSet<double>&, const MeshLayout&,
                                             const FormattedOutputs&, const Options&,
                                             SetRange) noexcept;

} // namespace simdbezier
