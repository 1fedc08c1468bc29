// The requests of RIB files by what the reader does with them. All are listed, because an unknown
// request could be geometry of a newer version, binary code or a patch with its name misspelt.
// Sources: The RenderMan Interface, version 3.2, appendix C; RenderMan 21 for those added since.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include <tools/formats/surfaces/affine_map.hpp>

namespace simdbezier::tools {

/// These requests are geometry that is no Bézier patch and no spline, or decide where, when or
/// whether geometry appears.
inline constexpr std::string_view kRibOtherGeometry =
    " ArchiveBegin Blobby Cone Curves Cylinder Disk Else ElseIf GeneralPolygon Geometry "
    "HierarchicalSubdivisionMesh Hyperboloid IfBegin MotionBegin Paraboloid Points "
    "PointsGeneralPolygons PointsPolygons Polygon Procedural Procedural2 ReadArchive Sphere "
    "SubdivisionMesh Torus Volume ";

using RibNumbers = std::array<double, 16>;

/// Returns nothing where the fourth column of the matrix is no 0 0 0 1: straight lines that are
/// parallel would not stay so.
[[nodiscard]] inline std::optional<AffineMap> rib_matrix_map(const RibNumbers& m) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    return std::nullopt;
  }
  return AffineMap(
      {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}}});
}

/// These requests change where patches are, with so many numbers.
struct RibTransformation {
  std::string_view name;
  std::size_t numbers;
  bool replaces; ///< those before it
  std::optional<AffineMap> (*map)(const RibNumbers&);
};
inline constexpr RibTransformation kRibTransformations[] = {
    {"Transform", 16, true, rib_matrix_map},
    {"ConcatTransform", 16, false, rib_matrix_map},
    {"Translate", 3, false,
     [](const RibNumbers& n) {
       return std::optional(AffineMap::translation({n[0], n[1], n[2]}));
     }},
    {"Rotate", 4, false,
     [](const RibNumbers& n) {
       return AffineMap::rotation(n[0], {n[1], n[2], n[3]});
     }},
    {"Scale", 3, false,
     [](const RibNumbers& n) {
       return std::optional(AffineMap::scaling({n[0], n[1], n[2]}));
     }},
    {"Skew", 7, false,
     [](const RibNumbers& n) {
       return AffineMap::skew(n[0], {n[1], n[2], n[3]}, {n[4], n[5], n[6]});
     }},
    {"Identity", 0, true, [](const RibNumbers&) { return std::optional(AffineMap()); }}};
inline constexpr std::string_view kRibUnknownTransformations = " Deformation Perspective ";

/// What the name behind these requests says is not passed over.
inline constexpr std::string_view kRibNamesBehind =
    " Attribute CoordinateSystem CoordSysTransform ObjectBegin Orientation "
    "ScopedCoordinateSystem ";

/// These requests, and ObjectBegin, open and close a scope of the bases, transformations and so on;
/// TransformBegin and TransformEnd one of the transformations alone.
inline constexpr std::string_view kRibScopeBegins =
    " AttributeBegin FrameBegin SolidBegin TransformBegin WorldBegin ";
inline constexpr std::string_view kRibScopeEnds =
    " AttributeEnd FrameEnd ObjectEnd SolidEnd TransformEnd WorldEnd ";

/// These requests change neither the shape of a patch nor its place.
inline constexpr std::string_view kRibPassedOver =
    " ArchiveEnd ArchiveRecord AreaLightSource Atmosphere Bound Bxdf Camera "
    "Clipping ClippingPlane Color ColorSamples "
    "CropWindow Declare DepthOfField Detail DetailRange Displace Displacement Display "
    "DisplayChannel DisplayFilter EditAttributeBegin EditAttributeEnd EditBegin EditEnd "
    "EnableLightFilter ErrorHandler Exposure Exterior Format FrameAspectRatio "
    "GeometricApproximation GeometricRepresentation Hider Illuminate Imager Integrator "
    "Interior Light LightFilter LightSource MakeBrickMap MakeBump MakeCubeFaceEnvironment "
    "MakeLatLongEnvironment MakeShadow MakeTexture Matte MotionEnd Opacity Option "
    "Pattern PixelFilter PixelSamples PixelSampleImager PixelVariance Projection "
    "Quantize RelativeDetail Resource ResourceBegin ResourceEnd "
    "SampleFilter ScreenWindow Shader ShadingInterpolation "
    "ShadingRate Shutter Sides Surface System TextureCoordinates "
    "VPAtmosphere VPInterior VPSurface version ";

/// Whether `name` is one of the words of `list`, each of which has a space on both sides.
[[nodiscard]] constexpr bool is_listed(std::string_view name, std::string_view list) noexcept {
  for (std::size_t at = list.find(name); at != std::string_view::npos;
       at = list.find(name, at + 1)) {
    if (list[at - 1] == ' ' && list[at + name.size()] == ' ') {
      return true;
    }
  }
  return false;
}

} // namespace simdbezier::tools
