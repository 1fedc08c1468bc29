// The requests of RIB files by what the reader does with them. All are listed, because an unknown
// request could be geometry of a newer version, binary code or a patch with its name misspelt.
// Sources: The RenderMan Interface, version 3.2, appendix C; RenderMan 21 for those added since.
#pragma once

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

/// These requests open and close a scope of the bases.
inline constexpr std::string_view kRibScopeBegins =
    " AttributeBegin FrameBegin ObjectBegin SolidBegin WorldBegin ";
inline constexpr std::string_view kRibScopeEnds =
    " AttributeEnd FrameEnd ObjectEnd SolidEnd WorldEnd ";

/// These requests do not change the shape of a patch in its own coordinates.
inline constexpr std::string_view kRibPassedOver =
    " ArchiveBegin ArchiveEnd ArchiveRecord AreaLightSource Atmosphere Attribute Bound Bxdf Camera "
    "Clipping ClippingPlane Color ColorSamples ConcatTransform CoordSysTransform CoordinateSystem "
    "CropWindow Declare Deformation DepthOfField Detail DetailRange Displace Displacement Display "
    "DisplayChannel DisplayFilter EditAttributeBegin EditAttributeEnd EditBegin EditEnd "
    "EnableLightFilter ErrorHandler Exposure Exterior Format FrameAspectRatio "
    "GeometricApproximation GeometricRepresentation Hider Identity Illuminate Imager Integrator "
    "Interior Light LightFilter LightSource MakeBrickMap MakeBump MakeCubeFaceEnvironment "
    "MakeLatLongEnvironment MakeShadow MakeTexture Matte MotionEnd Opacity Option Orientation "
    "Pattern Perspective PixelFilter PixelSamples PixelSampleImager PixelVariance Projection "
    "Quantize RelativeDetail Resource ResourceBegin ResourceEnd ReverseOrientation Rotate "
    "SampleFilter Scale ScopedCoordinateSystem ScreenWindow Shader ShadingInterpolation "
    "ShadingRate Shutter Sides Skew Surface System TextureCoordinates Transform TransformBegin "
    "TransformEnd Translate VPAtmosphere VPInterior VPSurface version ";

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
