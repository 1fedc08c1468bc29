// Rays through Embree's user geometry: every patch is one primitive, whose box and triangles come
// from a mesh. They hit what they hit in Embree's own triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <embree3/rtcore.h>
#include <simdbezier/simdbezier.hpp>

#include "seed/wavy_sheet.hpp"

using namespace simdbezier;

namespace {

constexpr std::size_t kSide = 4;
constexpr double kEdge = 1e-9;

using Vec = std::array<double, 3>;
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A mesh, and where each patch's triangles begin.
struct Scene {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::size_t> first;

  [[nodiscard]] Vec at(std::uint32_t vertex) const {
    return {positions[vertex][0], positions[vertex][1], positions[vertex][2]};
  }
};

Status make(Scene& scene) {
  const auto points = seed::wavy_sheet(kSide);
  MeshOptions options;
  options.rates.tolerance = 1e-3;
  const auto nets = ControlNets<float>::packed(points);
  const MeshPlan<float> plan = plan_mesh<float>(nets, options);
  if (!plan) {
    return plan.report.status;
  }
  scene.positions.resize(plan.layout.size().vertices);
  scene.triangles.resize(plan.layout.size().triangles);
  for (std::size_t patch = 0; patch <= plan.set.size(); ++patch) {
    scene.first.push_back(plan.layout.first_triangle(patch));
  }
  MeshOutputs<float> out;
  out.position = Vectors<float>::xyz(scene.positions);
  const Status status = evaluate_mesh(plan.set, plan.layout, out);
  const std::span numbers(scene.triangles.front().data(), 3 * scene.triangles.size());
  return status ? write_triangles(plan.layout, numbers) : status;
}

void find_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {kFar, kFar, kFar};
  std::array<float, 3> high = {-kFar, -kFar, -kFar};
  for (std::size_t t = scene.first[arguments->primID]; t < scene.first[arguments->primID + 1];
       ++t) {
    for (const std::uint32_t vertex : scene.triangles[t]) {
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], scene.positions[vertex][c]);
        high[c] = std::max(high[c], scene.positions[vertex][c]);
      }
    }
  }
  *arguments->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
}

/// One ray and the triangles of one patch, by Moeller and Trumbore; edges count to both sides.
void intersect(const RTCIntersectFunctionNArguments* arguments) {
  const auto& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  if (arguments->valid[0] == 0) {
    return;
  }
  const Vec from = {hit.ray.org_x, hit.ray.org_y, hit.ray.org_z};
  const Vec along = {hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z};
  for (std::size_t t = scene.first[arguments->primID]; t < scene.first[arguments->primID + 1];
       ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    const Vec ab = scene.at(b) - scene.at(a);
    const Vec ac = scene.at(c) - scene.at(a);
    const Vec p = cross(along, ac);
    const double determinant = dot(ab, p);
    const Vec s = from - scene.at(a);
    const Vec q = cross(s, ab);
    const double u = dot(s, p) / determinant;
    const double v = dot(along, q) / determinant;
    const double distance = dot(ac, q) / determinant;
    if (u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge && distance > hit.ray.tnear &&
        distance < hit.ray.tfar) {
      hit.ray.tfar = static_cast<float>(distance);
      hit.hit.primID = arguments->primID;
      hit.hit.geomID = arguments->geomID;
    }
  }
}

RTCScene commit(RTCDevice device, RTCGeometry geometry) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST); // no ray slips through between triangles
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

RTCScene patches_of(RTCDevice device, Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.first.size() - 1));
  rtcSetGeometryUserData(geometry, &scene);
  rtcSetGeometryBoundsFunction(geometry, find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  return commit(device, geometry);
}

RTCScene triangles_of(RTCDevice device, const Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, scene.positions.size()));
  std::copy_n(scene.positions.front().data(), 3 * scene.positions.size(), vertices);
  auto* const numbers = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, scene.triangles.size()));
  std::copy_n(scene.triangles.front().data(), 3 * scene.triangles.size(), numbers);
  return commit(device, geometry);
}

/// Straight down; the distance of the hit.
float shoot(RTCScene scene, float x, float y) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.org_x = x;
  ray.ray.org_y = y;
  ray.ray.org_z = 1;
  ray.ray.dir_z = -1;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &ray);
  return ray.ray.tfar;
}

} // namespace

int main() {
  Scene scene;
  if (Status status = make(scene); !status) {
    return std::puts(to_string(status).data());
  }
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene patches = patches_of(device, scene);
  RTCScene triangles = triangles_of(device, scene);
  int hits = 0;
  int same = 0;
  for (int k = 0; k < 10000; ++k) {
    const float x = 0.005F + static_cast<float>(k % 100) * 0.0399F;
    const float y = 0.005F + static_cast<float>(k / 100) * 0.0399F;
    const float distance = shoot(patches, x, y);
    hits += std::isfinite(distance) ? 1 : 0;
    same += std::fabs(distance - shoot(triangles, x, y)) < 1e-3F ? 1 : 0;
  }
  rtcReleaseScene(patches);
  rtcReleaseScene(triangles);
  rtcReleaseDevice(device);
  std::printf("%d of 10000 rays hit, %d where Embree's own triangles are\n", hits, same);
}
