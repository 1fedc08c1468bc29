// Control nets of every shape the suite uses, each a function of a random stream.
//
// Only + - * / and sqrt, and draws only in statements of their own or braced lists, whose order is
// fixed: a seed gives the same net with every compiler, on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tests/support/nets/net.hpp"
#include "tests/support/random.hpp"

namespace simdbezier::tests {

using Matrix3 = std::array<Vector3, 3>;

/// A rotation from a random quaternion.
[[nodiscard]] inline Matrix3 random_rotation(Random& random) {
  std::array<double, 4> q{};
  double size = 0;
  do {
    size = 0;
    for (double& value : q) {
      value = random.symmetric();
      size += value * value;
    }
  } while (size < 0.01 || size > 1);
  const double s = 1 / std::sqrt(size);
  const double a = q[0] * s;
  const double b = q[1] * s;
  const double c = q[2] * s;
  const double d = q[3] * s;
  return {{{1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)},
           {2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)},
           {2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)}}};
}

[[nodiscard]] inline Net rotated(Net net, const Matrix3& rotation) {
  for (Vector3& point : net.points) {
    const Vector3 old = point;
    for (std::size_t c = 0; c < 3; ++c) {
      point[c] = rotation[c][0] * old[0] + rotation[c][1] * old[1] + rotation[c][2] * old[2];
    }
  }
  return net;
}

[[nodiscard]] inline Net scaled_by(Net net, const Vector3& factors) {
  for (Vector3& point : net.points) {
    for (std::size_t c = 0; c < 3; ++c) {
      point[c] *= factors[c];
    }
  }
  return net;
}

[[nodiscard]] inline Net translated(Net net, const Vector3& offset) {
  for (Vector3& point : net.points) {
    for (std::size_t c = 0; c < 3; ++c) {
      point[c] += offset[c];
    }
  }
  return net;
}

/// A bicubic net whose point (j, i) is make(j, i).
template <typename Make>
[[nodiscard]] Net bicubic(Make make) {
  Net net;
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 3; ++i) {
      net.at(j, i) = make(j, i);
    }
  }
  return net;
}

/// A height field over [-1,1]^2 on slightly uneven lines: what most patches of models are like.
[[nodiscard]] inline Net wave_net(Random& random) {
  return bicubic([&](int j, int i) {
    return Vector3{(2 * i - 3) / 3.0 + 0.2 * random.symmetric(),
                   (2 * j - 3) / 3.0 + 0.2 * random.symmetric(), 0.5 * random.symmetric()};
  });
}

/// Every coordinate uniform in [-1,1).
[[nodiscard]] inline Net random_net(Random& random) {
  return bicubic([&](int, int) {
    return Vector3{random.symmetric(), random.symmetric(), random.symmetric()};
  });
}

/// Every coordinate 1 or -1: near the extreme points of any error bound convex in the net.
[[nodiscard]] inline Net signs_net(Random& random) {
  return bicubic([&](int, int) { return Vector3{random.sign(), random.sign(), random.sign()}; });
}

[[nodiscard]] inline Net offset_net(Random& random, double distance) {
  const Net net = wave_net(random);
  return translated(net,
                    {distance * random.sign(), distance * random.sign(), distance * random.sign()});
}

/// Heights of 1e-4 over a unit square, turned at random.
[[nodiscard]] inline Net flat_net(Random& random) {
  const Net net = scaled_by(wave_net(random), {1, 1, 1e-4});
  return rotated(net, random_rotation(random));
}

/// A patch `ratio` times as long as it is wide and high, turned at random.
[[nodiscard]] inline Net aspect_net(Random& random, double ratio) {
  const Net net = scaled_by(wave_net(random), {1, 1 / ratio, 1 / ratio});
  return rotated(net, random_rotation(random));
}

/// Tangents that enclose an angle of about 1e-5.
[[nodiscard]] inline Net sheared_net(Random& random) {
  Net net = bicubic([&](int j, int i) {
    return Vector3{(i + j) / 3.0, 1e-5 * j / 3.0, 1e-6 * random.symmetric()};
  });
  return rotated(net, random_rotation(random));
}

/// The four sides, in the order v = 0, v = 1, u = 0, u = 1.
[[nodiscard]] inline Vector3& side_point(Net& net, int side, int k) {
  switch (side) {
  case 0:
    return net.at(0, k);
  case 1:
    return net.at(net.degree_v, k);
  case 2:
    return net.at(k, 0);
  default:
    return net.at(k, net.degree_u);
  }
}

/// A patch with one side drawn together to a pole, turned and moved: a smooth cap, or the tip of
/// a cone, whose normal depends on the direction from which one comes.
[[nodiscard]] inline Net collapsed_net(Random& random, int side) {
  constexpr std::array<double, 4> kParabola{0, 0, 1 / 3.0, 1};
  const double bend = 0.3 + 0.2 * random.unit();
  const double cone = random.below(2) == 0 ? 0.0 : 0.4;
  Net net = bicubic([&](int j, int i) {
    const double along = (2 * (side < 2 ? i : j) - 3) / 3.0;
    const int ring = side == 0 ? j : side == 1 ? 3 - j : side == 2 ? i : 3 - i;
    const double radius = ring / 3.0;
    return Vector3{radius * along, radius * (1.5 - 0.5 * along * along),
                   bend * kParabola[static_cast<std::size_t>(ring)] + cone * radius};
  });
  net = rotated(net, random_rotation(random));
  net = translated(net, {random.symmetric(), 1.5, 0.25});
  for (int k = 1; k <= 3; ++k) {
    side_point(net, side, k) = side_point(net, side, 0);
  }
  return net;
}

/// Neighbouring control points that coincide: (0,1) with (0,0), and one interior pair.
[[nodiscard]] inline Net coincident_net(Random& random) {
  Net net = wave_net(random);
  net.at(0, 1) = net.at(0, 0);
  net.at(2, 2) = net.at(1, 2);
  return net;
}

/// dS/du = 0 along the whole of u = 0: a cusp ridge.
[[nodiscard]] inline Net cusp_net(Random& random) {
  Net net = wave_net(random);
  for (int j = 0; j <= 3; ++j) {
    net.at(j, 1) = net.at(j, 0);
  }
  return net;
}

[[nodiscard]] inline Net constant_net(Random& random) {
  const Vector3 point{random.symmetric(), random.symmetric(), random.symmetric()};
  return bicubic([&](int, int) { return point; });
}

/// A parabolic dish whose parameter lines are bunched at two sides: regular, but du and dv shrink
/// by `grade` there, against what an absolute test for vanishing normals expects. Turned only
/// where float keeps the lines apart afterwards: rounded onto each other they make a pole.
[[nodiscard]] inline Net graded_net(Random& random, double grade) {
  const std::array<double, 4> lines{0, grade / 3, grade, 1};
  const double bend = random.between(0.2, 0.5);
  const Net net = bicubic([&](int j, int i) {
    const double x = lines[static_cast<std::size_t>(i)];
    const double y = lines[static_cast<std::size_t>(j)];
    return Vector3{x, y, bend * (x * x + y * y) + 0.25 * x * y};
  });
  const Matrix3 rotation = random_rotation(random);
  return grade >= 0x1p-18 && random.below(2) == 0 ? rotated(net, rotation) : net;
}

} // namespace simdbezier::tests
