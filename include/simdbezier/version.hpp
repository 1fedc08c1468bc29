// Version numbers and the export macro.
#pragma once

#define SIMDBEZIER_VERSION_MAJOR 0
#define SIMDBEZIER_VERSION_MINOR 1
#define SIMDBEZIER_VERSION_PATCH 0

// SIMDBEZIER_STATIC is set by the build system for consumers of the static library.
#if defined(SIMDBEZIER_STATIC)
#define SIMDBEZIER_API
#elif defined(__GNUC__)
#define SIMDBEZIER_API __attribute__((visibility("default")))
#else
#define SIMDBEZIER_API
#endif
