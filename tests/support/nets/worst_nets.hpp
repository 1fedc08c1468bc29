// Control nets found by hill-climbing on the error of the library's order of operations: columns by
// Horner's rule, rows by even and odd parts (positions, FMA).
//
// Random nets come nowhere near the certified bound of 21 u max|b|; these reach 9.3 to 11.2 u.
// Found with a scalar model of the scheme from 700 starts of 1.5e6 steps in float and 500 of 1e6 in
// double, over the signs, the magnitudes 1 - k u with k in 0..255, and x, y: the best ones with
// different signs. Another evaluation order, or other rounding of the coefficients, has its own
// worst nets: run the climb again when the scheme changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/support/nets/net.hpp"

namespace simdbezier::tests {

/// One scalar net: value j*4+i is (bit of `signs` set ? -1 : 1) * (1 - below_one * u).
struct WorstNet {
  bool is_double;
  std::uint16_t signs;
  std::string_view below_one; ///< 16 numbers of two hexadecimal digits
  double x;
  double y;
};

inline constexpr WorstNet kWorstNets[] = {
    {false, 0x6c9a, "e9b61eb4ec0a03981a03ff3a9bfcdb69", 0x1.fe9ec8p-1, 0x1.f99b2cp-1}, // 11.209 u
    {false, 0x7c9b, "ec96507e87413f8f8a19521887bab474", 0x1.ff1e0ap-1, 0x1.fa5044p-1}, // 10.856 u
    {false, 0x6d9b, "82ed1eb7e40904e7e82ffd2d1b91ff7e", 0x1.fb6dfcp-1, 0x1.ff937cp-1}, // 10.745 u
    {false, 0x7c97, "43b5c2864543de92a1b335a795708257", 0x1.f65f52p-1, 0x1.ffbbccp-1}, // 10.727 u
    {false, 0x2946, "901e0916861f73bf25e9902a2e8e9f96", 0x1.f84888p-1, 0x1.fdb41ep-1}, // 10.711 u
    {false, 0xc6bd, "f3fbf134bb32f70fd7200081ffdb3f78", 0x1.fe91ecp-1, 0x1.fedd6p-1},  // 10.240 u
    {false, 0x7892, "e7d0d38eb49b55dbfaf5f3b76a370e14", 0x1.feb6d2p-1, 0x1.ffd89cp-1}, // 10.041 u
    {false, 0x7c92, "6455dba5148bab4ce7eaefc74e6000d6", 0x1.fc361ap-1, 0x1.fe2d7ep-1}, // 10.030 u
    {false, 0x689a, "1e769bee81f218abcaad7bd2832f1542", 0x1.f06c94p-1, 0x1.feb2cp-1},  // 10.015 u
    {false, 0xa7d9, "07b20fa42e4cc3f231f6ffa060fe0025", 0x1.ff38dp-1, 0x1.fdd54p-1},   // 9.851 u
    {false, 0xbd63, "a653101850c8fd40f221fc4b56f9067f", 0x1.fffebp-1, 0x1.fb31fcp-1},  // 9.447 u
    {false, 0xb765, "9523579741ec0d947facfefb230364ee", 0x1.e777d6p-1, 0x1.f7df18p-1}, // 9.359 u
    {true, 0x7c97, "22c7d96da5473f86bc491f21cd2d376e", 0x1.fffeb00e01d8p-1,
     0x1.fff9b0f7799a3p-1}, // 11.132 u
    {true, 0x7c9b, "ac304438ae6420af9c5ea66508fa9102", 0x1.fe1a6e02c53dep-1,
     0x1.fda9f8f42fb98p-1}, // 10.588 u
    {true, 0x6c9a, "1f7b516d32e30109587a06ba228d8b35", 0x1.ee64e43947e35p-1,
     0x1.f96df8b58bef4p-1}, // 10.534 u
    {true, 0x689a, "3ea700d5a9ebd27ff30115614adbea80", 0x1.fe35870914deap-1,
     0x1.fab4f9f8c0da6p-1}, // 10.339 u
    {true, 0x749b, "41b24cc6e95fd1ee4f465ad44cd6208c", 0x1.fffeb074a771dp-1,
     0x1.fc33d9e1b5931p-1}, // 10.215 u
    {true, 0x7c92, "9217ff9ed5ab82bb67300899c2bb8f2e", 0x1.ff190fba79079p-1,
     0x1.fffeacc73758dp-1}, // 10.187 u
    {true, 0x699b, "daff7c89de782e3b5b720be959d76b86", 0x1.f89a53bb21017p-1,
     0x1.f8b56b2886319p-1}, // 10.101 u
    {true, 0x6d9b, "22a1b6462db20013f0ef18bdb69734aa", 0x1.f326c56051f21p-1,
     0x1.fe7ea3fd81538p-1}, // 10.033 u
};

/// The scalar net in all three components: in x as found, in y with all signs turned, in z at
/// twice the size; the errors must then be equal in units of u max|b|.
[[nodiscard]] inline Net worst_net(const WorstNet& worst) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  const double roundoff = worst.is_double ? kUnitRoundoff<double> : kUnitRoundoff<float>;
  Net net;
  for (std::size_t k = 0; k < 16; ++k) {
    const int below = 16 * digit(worst.below_one[2 * k]) + digit(worst.below_one[2 * k + 1]);
    const double sign = ((worst.signs >> k) & 1) != 0 ? -1.0 : 1.0;
    const double value = sign * (1 - below * roundoff);
    net.points[k] = {value, -value, 2 * value};
  }
  return net;
}

} // namespace simdbezier::tests
