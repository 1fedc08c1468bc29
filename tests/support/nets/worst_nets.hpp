// Control nets found by hill-climbing on the error of the centred Horner form (positions, FMA).
//
// Random nets come nowhere near the certified bound of 21 u max|b|; these reach 7 to 9.5 u. Found
// with a scalar model of the scheme: 1.5e6 steps a net in float, 3e5 in double, over the signs,
// the magnitudes 1 - k u with k in 0..255, and x, y. Another evaluation order, or other rounding
// of the coefficients, has its own worst nets: run the climb again when the scheme changes.
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
    {false, 0x2946, "459c688c803724c306bef8214d25ee01", 0x1.fff2d6p-1, 0x1.ff8dcep-1}, // 9.451 u
    {false, 0x6c9a, "72eb1b06f21105112847e517128f763d", 0x1.f1b4bcp-1, 0x1.fd8f32p-1}, // 9.338 u
    {false, 0x7c9b, "3115023f00559c313e132c2322200461", 0x1.e76f58p-1, 0x1.ffcb06p-1}, // 9.307 u
    {false, 0x6c9b, "7eb42f17bd0bbe0a0b2793c617f2fd22", 0x1.f982e8p-1, 0x1.ffe666p-1}, // 9.170 u
    {false, 0x689b, "12d5633900cf35281646840017453bac", 0x1.f1946ep-1, 0x1.ff1dap-1},  // 9.086 u
    {false, 0xc6bd, "27301629052aa31e6b0d5f1bff01a75d", 0x1.d630e6p-1, 0x1.ff464ep-1}, // 8.469 u
    {false, 0x2c9b, "0c1c792f4d0a8b30be5680567e4e2800", 0x1.f31b68p-1, 0x1.fa5ep-1},   // 8.461 u
    {false, 0x6c92, "367a33cbe41b13232d103619a5434e03", 0x1.fa857p-1, 0x1.fefdbep-1},  // 8.438 u
    {false, 0x3c89, "39b0ee123dbe0306041c2d8b24610d03", 0x1.c9f63ap-1, 0x1.fb2676p-1}, // 8.171 u
    {false, 0xd79a, "f8fe32131d1860c51756750eb934c36f", 0x1.ec641p-1, 0x1.ff5978p-1},  // 7.944 u
    {false, 0x678b, "0523173c8a4f2d0110317a745b24163b", 0x1.e1c016p-1, 0x1.ffcc16p-1}, // 7.757 u
    {false, 0x6c99, "2058173912df1f0a5f92142321b41c20", 0x1.e0402cp-1, 0x1.ff0e6ap-1}, // 7.679 u
    {true, 0x6d9b, "d317dc0368f8fe0318fc0c0bd61601bf", 0x1.fff2e4818063p-1,
     0x1.fb0b87fb53c23p-1}, // 9.152 u
    {true, 0x6c9f, "205bba3829b53b07e3f9b50ee820dfe2", 0x1.dda189d57b4c4p-1,
     0x1.fff2e1b264009p-1}, // 8.785 u
    {true, 0xa7d9, "56f0c33415f3001f0c000837ee1f4cf0", 0x1.fe3175d75aad5p-1,
     0x1.fd519c52ed68p-1}, // 8.158 u
    {true, 0x6d13, "2db88c041b26121637a3012f0a1a3b36", 0x1.e14c90e475e3ap-1,
     0x1.feca2efe99173p-1}, // 8.143 u
    {true, 0x6c9b, "9103fc2303f9feb9e6d70114c00b0530", 0x1.fff2e45b051abp-1,
     0x1.fabe7d3deec94p-1}, // 7.963 u
    {true, 0xa37e, "09093f9fdbeb24d53318058610513d14", 0x1.ea434df4cee82p-1,
     0x1.fb1feb9ca218fp-1}, // 7.448 u
    {true, 0x6c99, "3fa0051d0536271446ad1b1ea03d6b15", 0x1.d08a0a2d4248ap-1,
     0x1.ffe7003518fb3p-1}, // 7.229 u
    {true, 0x8221, "2f3619e0d0522d3fea0c4014ac487c37", 0x1.ec9fe7e2d4229p-1,
     0x1.ffd91300227fdp-1}, // 7.136 u
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
