#include <simdbezier/evaluate_mesh.hpp>

#include <algorithm>

#include "src/calls/call.hpp"
#include "src/mesh/vertices/vertex_work.hpp"
#include "src/output/delivery.hpp"

namespace simdbezier {
namespace detail {
namespace {

/// Places of vectors in the lists of outputs that calls here deliver.
enum Delivered : std::uint8_t { kPositions, kNormals, kParameters, kDelivered };

/// A delivery to the caller's memory, as a sink of vertices.
template <typename T>
class DeliverySink {
public:
  DeliverySink(const OutputPlan<T>& plan, const KernelTable<T>& table, std::size_t chunk,
               const ParameterOutputs<T>& parameters, std::size_t first_vertex,
               void* scratch) noexcept
      : plan_(plan), parameters_(parameters), first_vertex_(first_vertex),
        delivery_(plan, table, chunk, scratch) {}

  void begin(std::size_t vertex, VertexTarget<T>& to) noexcept {
    const Planes<T>* const planes = delivery_.begin(vertex - first_vertex_);
    to = {planes[kPositions], planes[kNormals], plan_.record(), vertex, parameters_, first_vertex_};
    if (plan_.is_staged(kParameters)) {
      std::uint32_t* const patch = parameters_.patch;
      to.parameters = {planes[kParameters].component[0], planes[kParameters].component[1], 1,
                       patch == nullptr ? nullptr : patch + (vertex - first_vertex_)};
      to.parameters_first = vertex;
    }
  }
  void end(std::size_t vertices) noexcept { delivery_.end(vertices); }
  void finish() noexcept { delivery_.finish(); }
  DrainQueue<T>* queue() noexcept { return delivery_.queue(); }

private:
  const OutputPlan<T>& plan_;
  const ParameterOutputs<T>& parameters_;
  std::size_t first_vertex_;
  Delivery<T> delivery_;
};

/// Units are vertices; a share has the boundaries and rows that begin in it.
template <typename T>
class MeshWork {
public:
  MeshWork(const PatchKernels<T>& kernels, const OutputList<T>& out, const VertexTask<T>& task,
           const ParameterOutputs<T>& parameters, Way way) noexcept
      : outputs_(out, way), task_(task), parameters_(parameters), kernels_(kernels) {
    task_.kernels = &kernels_;
    DirectRows rows = kernels_.direct_rows(task.mesh->least_nu - 1);
    rows.vertices = kernels_.choice.outputs == kPositionNormal;
    outputs_.put_directly(rows);
    chunk_ = task_.chunk(std::min(chunk(), kMostChunk));
    delivery_bytes_ = whole_lines(
        Delivery<T>::scratch_bytes(outputs_.staged_planes(), outputs_.streaming(), chunk_));
  }
  MeshWork(const MeshWork&) = delete;
  MeshWork& operator=(const MeshWork&) = delete;

  [[nodiscard]] std::size_t units() const noexcept {
    return task_.last_vertex - task_.first_vertex;
  }
  [[nodiscard]] std::size_t duration() const noexcept { return duration_of(units(), 2); }
  [[nodiscard]] std::size_t grain() const noexcept { return 1; }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return delivery_bytes_ + VertexWorker<T, DeliverySink<T>>::scratch_bytes(task_);
  }
  Isa run(int /*worker*/, std::size_t begin, std::size_t end,
          unsigned char* scratch) const noexcept {
    DeliverySink<T> sink(outputs_, *kernels_.table, chunk_, parameters_, task_.first_vertex,
                         scratch);
    VertexWorker<T, DeliverySink<T>> worker(task_, chunk_, sink, scratch + delivery_bytes_);
    return worker.run(task_.first_vertex + begin, task_.first_vertex + end);
  }

private:
  /// Two chunks leave the first-level cache, but edges are computed together, and shorter ones
  /// leave fewer of them to be.
  [[nodiscard]] std::size_t chunk() const noexcept {
    constexpr std::size_t kStreamed = (std::size_t{32} << 10) / sizeof(T);
    return outputs_.streaming() && outputs_.staged() ? kStreamed / outputs_.staged_planes()
                                                     : Delivery<T>::chunk_samples(outputs_);
  }

  /// Boundaries of so many vertices stay in a cache until their samples are evaluated.
  static constexpr std::size_t kMostChunk = 8192;

  OutputPlan<T> outputs_;
  VertexTask<T> task_;
  ParameterOutputs<T> parameters_;
  PatchKernels<T> kernels_;
  std::size_t chunk_ = 0; ///< vertices
  std::size_t delivery_bytes_ = 0;
};

/// The values of single components, each in memory of its own.
template <typename T>
struct SinglePlanes {
  Vectors<T> plane[kVectorOutputs];
  std::size_t count = 0;

  void add(const Vectors<T>& group) noexcept {
    for (T* const first : {group.x, group.y, group.z}) {
      if (first != nullptr) {
        plane[count++] = Vectors<T>{first, nullptr, nullptr, group.stride};
      }
    }
  }
};

/// The outputs of a call besides positions and normals.
template <typename T>
struct VertexAttributes {
  Vectors<T> parameters;
  Values<std::uint32_t> patch;

  [[nodiscard]] bool wanted() const noexcept { return parameters.wanted() || patch.wanted(); }

  /// Checks the attributes as check_outputs() does; vectors have been checked.
  [[nodiscard]] Status check(const Outputs<T>& vectors, std::size_t vertices) const noexcept {
    if (patch.capacity < vertices) {
      return Status::output_too_small;
    }
    if (!parameters.wanted()) {
      return Status::ok;
    }
    const MemoryRange patches[] = {range(vertices)};
    if (const Status status = check_outputs(OutputList<T>(&parameters, 1), vertices, 2, patches);
        !status) {
      return status;
    }
    for (const Vectors<T>* const other : {&vectors.position, &vectors.normal}) {
      SinglePlanes<T> planes;
      planes.add(parameters);
      planes.add(*other);
      if (const Status status = check_outputs(OutputList<T>(planes.plane, planes.count), vertices,
                                              1, std::span<const MemoryRange>());
          !status) {
        return status;
      }
    }
    return Status::ok;
  }
  /// The parameters where they are members of the vertices that vectors are members of, so that
  /// whole vertices are put together; nothing where they are not.
  [[nodiscard]] Vectors<T> beside(const Outputs<T>& vectors) const noexcept {
    const auto joins = [this](const Vectors<T>& other) {
      return other.wanted() && other.stride == parameters.stride;
    };
    return parameters.stride != 1 && (joins(vectors.position) || joins(vectors.normal))
               ? parameters
               : Vectors<T>();
  }
  [[nodiscard]] MemoryRange range(std::size_t vertices) const noexcept {
    return {patch.first, vertices * sizeof(std::uint32_t)};
  }
  [[nodiscard]] ParameterOutputs<T> outputs() const noexcept {
    return {parameters.x, parameters.y, parameters.stride, patch.first};
  }
};

/// What both calls are given.
template <typename T>
struct MeshGiven {
  const PatchSet<T>& set;
  const MeshLayout& layout;
  Outputs<T> vectors; ///< position and normal
  VertexAttributes<T> attributes;
  ValuesOf values;
  const Options& options;
  SetRange patches;
};

template <typename T>
class MeshCall {
public:
  explicit MeshCall(const MeshGiven<T>& in) noexcept
      : in_(in), out_(in_.vectors), delivered_{in_.vectors.position, in_.vectors.normal,
                                               in_.attributes.beside(in_.vectors)},
        delivery_(delivered_, kDelivered) {}
  MeshCall(const MeshCall&) = delete;
  MeshCall& operator=(const MeshCall&) = delete;

  Status resolve() noexcept {
    const std::size_t patches = in_.layout.data() == nullptr ? 0 : in_.layout.data()->patches();
    if (in_.set.size() != patches) {
      return Status::unequal_lengths;
    }
    return request_.resolve(in_.set, in_.patches, in_.vectors.first_component, in_.options);
  }
  Status check() noexcept {
    if (in_.values == ValuesOf::owner && request_.components.of_set != 3) {
      return Status::bad_components;
    }
    const std::size_t vertices = last_vertex() - first_vertex();
    if (out_.wants_vectors() || !in_.attributes.wanted()) {
      const MemoryRange patches[] = {in_.attributes.range(vertices)};
      if (const Status status = check_patch_outputs(out_, vertices, request_.components, patches);
          !status) {
        return status;
      }
    }
    return in_.attributes.check(in_.vectors, vertices);
  }
  [[nodiscard]] bool empty() const noexcept { return last_vertex() == first_vertex(); }
  [[nodiscard]] std::size_t written() const noexcept {
    return written_bytes(delivery_, last_vertex() - first_vertex());
  }
  [[nodiscard]] CallKind kind() const noexcept {
    return kind_of_outputs(CallName::mesh, out_, *request_.table, false)
        .add(2 * static_cast<std::uint64_t>(in_.values) + (delivery_.wants(kParameters) ? 1 : 0));
  }
  [[nodiscard]] MeshWork<T> plan(Way way) const noexcept {
    VertexTask<T> task{};
    task.mesh = in_.layout.data();
    task.dimension = out_.holds(Output::position) ? request_.components.dimension : 0;
    task.normals = out_.holds(Output::normal);
    task.values = in_.values;
    task.first_vertex = first_vertex();
    task.last_vertex = last_vertex();
    return MeshWork<T>({*in_.set.storage(), request_, out_, in_.options}, delivery_, task,
                       in_.attributes.outputs(), way);
  }

private:
  [[nodiscard]] std::size_t first_vertex() const noexcept {
    return in_.layout.first_vertex(request_.first);
  }
  [[nodiscard]] std::size_t last_vertex() const noexcept {
    return in_.layout.first_vertex(request_.first + request_.count);
  }

  MeshGiven<T> in_;
  OutputList<T> out_; ///< what kernels compute
  Vectors<T> delivered_[kDelivered];
  OutputList<T> delivery_;
  Request<T> request_;
};

} // namespace
} // namespace detail

template <typename T>
Status evaluate_mesh(const PatchSet<T>& set, const MeshLayout& layout, const MeshOutputs<T>& out,
                     const Options& options, SetRange patches) noexcept {
  Outputs<T> vectors;
  vectors.position = out.position;
  vectors.normal = out.normal;
  return detail::make_call(detail::MeshCall<T>({set,
                                                layout,
                                                vectors,
                                                {out.parameters, out.patch},
                                                detail::ValuesOf::owner,
                                                options,
                                                patches}),
                           options);
}

template <typename T>
Status evaluate_mesh_attributes(const PatchSet<T>& set, const MeshLayout& layout,
                                const Vectors<T>& out, int first_component, const Options& options,
                                SetRange patches) noexcept {
  Outputs<T> vectors;
  vectors.position = out;
  vectors.first_component = first_component;
  return detail::make_call(
      detail::MeshCall<T>(
          {set, layout, vectors, {}, detail::ValuesOf::own_patch, options, patches}),
      options);
}

#define SIMDBEZIER_INSTANTIATE(T)                                                                  \
  template SIMDBEZIER_API Status evaluate_mesh(const PatchSet<T>&, const MeshLayout&,              \
                                               const MeshOutputs<T>&, const Options&,              \
                                               SetRange) noexcept;                                 \
  template SIMDBEZIER_API Status evaluate_mesh_attributes(const PatchSet<T>&, const MeshLayout&,   \
                                                          const Vectors<T>&, int, const Options&,  \
                                                          SetRange) noexcept;
SIMDBEZIER_INSTANTIATE(float)
SIMDBEZIER_INSTANTIATE(double)
#undef SIMDBEZIER_INSTANTIATE

} // namespace simdbezier
