// What library.js calls. A call that fails returns 0 and leaves a message behind; no exception
// leaves the module.
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include <tools/formats/teapot.hpp>
#include <tools/process/failure.hpp>

#include "web/src/web_model.hpp"

#define SIMDBEZIER_WEB_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

using namespace simdbezier;
using web::MeshWish;
using web::Model;
using web::SampleWish;

namespace {

std::string message;

/// What a model is made with.
enum ModelFlags : unsigned { kDoubles = 1, kIgnoreTrims = 2 };

/// Returns what body() does, or 0.
template <typename Body>
auto guarded(const Body& body) noexcept -> decltype(body()) {
  message.clear();
  try {
    return body();
  } catch (const tools::Failure& failure) {
    message = failure.what();
  } catch (const std::bad_alloc&) {
    message = "not enough memory";
  } catch (const std::length_error&) {
    message = "not enough memory";
  }
  return {};
}

template <typename Body>
int done(const Body& body) noexcept {
  return guarded([&] {
    body();
    return 1;
  });
}

} // namespace

SIMDBEZIER_WEB_EXPORT(allocate) void* web_allocate(std::size_t bytes) { return std::malloc(bytes); }
SIMDBEZIER_WEB_EXPORT(release) void web_release(void* memory) { std::free(memory); }
SIMDBEZIER_WEB_EXPORT(message) const char* web_message() { return message.data(); }
SIMDBEZIER_WEB_EXPORT(message_bytes) std::size_t web_message_bytes() { return message.size(); }

/// Reads the bytes of a file of that name, or what is built in.
SIMDBEZIER_WEB_EXPORT(read_model)
Model* web_read_model(const char* name, std::size_t name_bytes, const char* bytes, std::size_t size,
                      unsigned flags) {
  return guarded([&]() -> Model* {
    const std::string path(name, name_bytes);
    if (path == "builtin:teapot") {
      return web::make_model(tools::teapot(), (flags & kDoubles) != 0).release();
    }
#if SIMDBEZIER_WEB_FILES
    tools::PatchFile file =
        tools::read_patches(path, {bytes, size}, {.ignore_trims = (flags & kIgnoreTrims) != 0});
    return web::make_model(std::move(file), (flags & kDoubles) != 0).release();
#else
    static_cast<void>(bytes);
    static_cast<void>(size);
    tools::bad_usage(path + ": expected no files, which the package reads by its other modules");
#endif
  });
}

/// points: those of all patches as they are, u fastest. weights: as in Weights.
SIMDBEZIER_WEB_EXPORT(make_model)
Model* web_make_model(const double* points, std::size_t patches, int degree_u, int degree_v,
                      int weights, unsigned flags) {
  return guarded([&]() -> Model* {
    tools::PatchFile file;
    file.name = "patches";
    const auto per_patch = static_cast<std::size_t>((degree_u + 1) * (degree_v + 1)) *
                           (static_cast<Weights>(weights) == Weights::none ? 3 : 4);
    file.points.reserve(patches * per_patch);
    for (std::size_t p = 0; p < patches; ++p, points += per_patch) {
      file.points.insert(file.points.end(), points, points + per_patch);
      file.close_patch(degree_u, degree_v, static_cast<Weights>(weights));
    }
    return web::make_model(std::move(file), (flags & kDoubles) != 0).release();
  });
}

SIMDBEZIER_WEB_EXPORT(free_model) void web_free_model(Model* model) { delete model; }
SIMDBEZIER_WEB_EXPORT(results) const web::Results* web_results(const Model* model) {
  return &model->results();
}

SIMDBEZIER_WEB_EXPORT(tessellate) int web_tessellate(Model* model, const MeshWish* wish) {
  return done([&] { model->tessellate(*wish); });
}
/// format: 0 GLB, 1 PLY.
SIMDBEZIER_WEB_EXPORT(write_file)
int web_write_file(Model* model, int format, const MeshWish* wish) {
  return done([&] {
    model->write_file(format == 0 ? tools::MeshFormat::glb : tools::MeshFormat::ply, *wish);
  });
}
SIMDBEZIER_WEB_EXPORT(grid)
int web_grid(Model* model, std::size_t nu, std::size_t nv, unsigned outputs, unsigned layout,
             unsigned watertight) {
  return done([&] { model->grid(nu, nv, {outputs, layout, watertight}); });
}
SIMDBEZIER_WEB_EXPORT(samples)
int web_samples(Model* model, const std::uint32_t* patches, const void* u, const void* v,
                std::size_t count, unsigned outputs, unsigned layout, unsigned watertight) {
  return done([&] { model->samples({patches, count}, u, v, {outputs, layout, watertight}); });
}
