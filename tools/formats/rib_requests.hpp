// The requests of RIB files by what the reader does with them. All are listed, because an unknown
// request could be geometry of a newer version, binary code or a patch with its name misspelt.
// Sources: The RenderMan Interface, version 3.2, appendix C; RenderMan 21 for those added since.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace simdbezier::tools {

/// These requests are geometry that is no Bézier patch, or decide where, when or whether geometry
/// appears.
inline constexpr std::string_view kRibOtherGeometry =
    " Blobby Cone Curves Cylinder Disk Else ElseIf GeneralPolygon Geometry "
    "HierarchicalSubdivisionMesh Hyperboloid IfBegin MotionBegin NuPatch ObjectInstance Paraboloid "
    "Points PointsGeneralPolygons PointsPolygons Polygon Procedural Procedural2 ReadArchive Sphere "
    "SubdivisionMesh Torus TrimCurve Volume ";

/// These requests change where patches are, with how many numbers; those of others are unknown.
struct RibTransformation {
  std::string_view name;
  std::size_t numbers;
  std::array<double, 16> identity; ///< the numbers with which nothing changes
  std::size_t compared;            ///< how many of them decide that
};
inline constexpr std::array<double, 16> kRibIdentity = {1, 0, 0, 0, 0, 1, 0, 0,
                                                        0, 0, 1, 0, 0, 0, 0, 1};
inline constexpr RibTransformation kRibTransformations[] = {
    {"Transform", 16, kRibIdentity, 16},
    {"ConcatTransform", 16, kRibIdentity, 16},
    {"Translate", 3, {}, 3},
    {"Rotate", 4, {}, 1},
    {"Scale", 3, {1, 1, 1}, 3},
    {"Skew", 7, {}, 1},
    {"Identity", 0, {}, 0}};
inline constexpr std::string_view kRibUnknownTransformations =
    " CoordSysTransform Deformation Perspective ";

/// These requests open and close a scope of the bases and of the transformations; TransformBegin
/// and TransformEnd one of the transformations alone.
inline constexpr std::string_view kRibScopeBegins =
    " AttributeBegin FrameBegin ObjectBegin SolidBegin TransformBegin WorldBegin ";
inline constexpr std::string_view kRibScopeEnds =
    " AttributeEnd FrameEnd ObjectEnd SolidEnd TransformEnd WorldEnd ";

/// These requests change neither the shape of a patch nor its place.
inline constexpr std::string_view kRibPassedOver =
    " ArchiveBegin ArchiveEnd ArchiveRecord AreaLightSource Atmosphere Attribute Bound Bxdf Camera "
    "Clipping ClippingPlane Color ColorSamples CoordinateSystem "
    "CropWindow Declare DepthOfField Detail DetailRange Displace Displacement Display "
    "DisplayChannel DisplayFilter EditAttributeBegin EditAttributeEnd EditBegin EditEnd "
    "EnableLightFilter ErrorHandler Exposure Exterior Format FrameAspectRatio "
    "GeometricApproximation GeometricRepresentation Hider Illuminate Imager Integrator "
    "Interior Light LightFilter LightSource MakeBrickMap MakeBump MakeCubeFaceEnvironment "
    "MakeLatLongEnvironment MakeShadow MakeTexture Matte MotionEnd Opacity Option Orientation "
    "Pattern PixelFilter PixelSamples PixelSampleImager PixelVariance Projection "
    "Quantize RelativeDetail Resource ResourceBegin ResourceEnd ReverseOrientation "
    "SampleFilter ScopedCoordinateSystem ScreenWindow Shader ShadingInterpolation "
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
