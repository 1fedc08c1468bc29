// Function templates for both number types.
#pragma once

#include <simdbezier/version.hpp>

/// Instantiates a function template for float and double. It has to be the only one of its name.
#define SIMDBEZIER_OF_BOTH_TYPES(name)                                                             \
  template decltype(name<float>) name<float>;                                                      \
  template decltype(name<double>) name<double>
/// The same of a public call.
#define SIMDBEZIER_EXPORT_BOTH_TYPES(name)                                                         \
  template SIMDBEZIER_API decltype(name<float>) name<float>;                                       \
  template SIMDBEZIER_API decltype(name<double>) name<double>
