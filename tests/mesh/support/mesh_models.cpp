#include "tests/mesh/support/mesh_models.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace simdbezier::tests {
namespace {

using Point = std::array<double, 3>;

/// Control points of a patch whose corners and edges are shared through their parameters: point
/// (i, j) of patch (p, q) is at (3 p + i, 3 q + j) of a common net.
std::vector<PatchPoints> from_net(int columns, int rows,
                                  const std::function<Point(int, int)>& net) {
  std::vector<PatchPoints> patches;
  for (int q = 0; q < rows; ++q) {
    for (int p = 0; p < columns; ++p) {
      PatchPoints& patch = patches.emplace_back();
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          patch[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] =
              net(3 * p + i, 3 * q + j);
        }
      }
    }
  }
  return patches;
}

constexpr double kTurn = 6.283185307179586;

/// Net points (k, l) of a torus of c x r patches. Both ends are computed from the same numbers.
MeshModel torus(int columns, int rows) {
  const auto net = [=](int k, int l) {
    const double a = kTurn * (k % (3 * columns)) / (3 * columns);
    const double b = kTurn * (l % (3 * rows)) / (3 * rows);
    const double r = 3 + std::cos(b);
    return Point{r * std::cos(a), r * std::sin(a), std::sin(b)};
  };
  return {"torus " + std::to_string(columns) + " x " + std::to_string(rows),
          from_net(columns, rows, net), 0, 0};
}

/// A ball of c x r patches; the first and the last row of points are the poles.
MeshModel ball(int columns, int rows) {
  const auto net = [=](int k, int l) {
    const double a = kTurn * (k % (3 * columns)) / (3 * columns);
    const double b = kTurn / 2 * l / (3 * rows);
    const double r = l == 0 || l == 3 * rows ? 0 : std::sin(b);
    return Point{r * std::cos(a) + 0.0, r * std::sin(a) + 0.0, -std::cos(b)};
  };
  return {"ball " + std::to_string(columns) + " x " + std::to_string(rows),
          from_net(columns, rows, net), 2, 0};
}

/// The six faces of a cube, whose inner points are moved outwards. Points that faces share are the
/// same because they are formed from the same coordinates.
MeshModel cube() {
  MeshModel model{"cube", {}, 2, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {-3, 3}) {
      PatchPoints patch;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          Point p;
          const int u = 2 * i - 3;
          const int v = 2 * j - 3;
          p[axis] = side;
          p[(axis + 1) % 3] = side > 0 ? u : v;
          p[(axis + 2) % 3] = side > 0 ? v : u;
          const double bulge = 1 + (27 - p[0] * p[0] - p[1] * p[1] - p[2] * p[2]) / 40;
          for (double& x : p) {
            x *= bulge;
          }
          patch[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = p;
        }
      }
      model.patches.push_back(patch);
    }
  }
  return model;
}

/// Two patches with all four edges in common.
MeshModel pillow() {
  MeshModel model{"pillow", {}, 2, 0};
  for (const double side : {1.0, -1.0}) {
    PatchPoints patch;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const bool inner = i > 0 && i < 3 && j > 0 && j < 3;
        // The lower one is transposed, so that its normal points outwards as well.
        const int k = side > 0 ? i : j;
        const int l = side > 0 ? j : i;
        patch[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = {1.0 * k, 1.0 * l,
                                                                           inner ? side : 0.0};
      }
    }
    model.patches.push_back(patch);
  }
  return model;
}

/// A ring of patches whose width turns by half a turn.
MeshModel moebius(int columns) {
  const auto net = [=](int k, int l) {
    const bool wraps = k == 3 * columns;
    const double a = wraps ? 0 : kTurn * k / (3 * columns);
    const double width = (2 * (wraps ? 3 - l : l) - 3) / 4.0;
    const double r = 3 + width * std::cos(a / 2);
    return Point{r * std::cos(a), r * std::sin(a), width * std::sin(a / 2)};
  };
  MeshModel model{"ring turned by half", from_net(columns, 1, net), 0, 1};
  model.orientable = model.agree = false;
  return model;
}

/// Sheets that share the edge u = 0, by angle.
MeshModel book(int sheets) {
  MeshModel model{"book of " + std::to_string(sheets), {}, 1, 0};
  for (int s = 0; s < sheets; ++s) {
    const double a = kTurn * s / sheets;
    const auto net = [=](int k, int l) {
      return Point{k * std::cos(a) + 0.0, k * std::sin(a) + 0.0, l + (k == 0 ? 0.0 : 0.1 * k * l)};
    };
    model.patches.push_back(from_net(1, 1, net)[0]);
  }
  model.manifold = false;
  return model;
}

Point wavy(int k, int l) { return {1.0 * k, 1.0 * l, std::sin(k + 0.7 * l)}; }

PatchPoints transposed(const PatchPoints& patch) {
  PatchPoints result;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      result[i][j] = patch[j][i];
    }
  }
  return result;
}

} // namespace

std::vector<double> MeshModel::values() const {
  std::vector<double> all;
  for (const PatchPoints& patch : patches) {
    for (const auto& row : patch) {
      for (const auto& point : row) {
        all.insert(all.end(), point.begin(), point.end());
      }
    }
  }
  return all;
}

std::vector<MeshModel> mesh_models() {
  std::vector<MeshModel> models = {{"patch", from_net(1, 1, wavy), 1, 1},
                                   {"sheet", from_net(3, 2, wavy), 1, 1},
                                   cube(),
                                   torus(1, 1),
                                   torus(2, 1),
                                   torus(1, 2),
                                   torus(2, 2),
                                   torus(4, 3),
                                   ball(1, 1),
                                   ball(2, 1),
                                   ball(4, 2),
                                   ball(3, 3),
                                   pillow(),
                                   moebius(3),
                                   moebius(4),
                                   book(3),
                                   book(4)};
  MeshModel touching{"touching in a corner", {}, 2, 2};
  touching.patches = {from_net(1, 1, wavy)[0],
                      from_net(1, 1, [](int k, int l) { return wavy(k + 3, l + 3); })[0]};
  models.push_back(touching);
  // Its two meshes coincide: no surface to count.
  MeshModel twice{"one patch twice", {}, 1, 0};
  twice.repeated = true;
  twice.patches = {from_net(1, 1, wavy)[0], from_net(1, 1, wavy)[0]};
  twice.agree = false;
  models.push_back(twice);
  return models;
}

MeshModel shuffled(const MeshModel& model, unsigned seed) {
  std::mt19937 random(seed);
  MeshModel result = model;
  std::shuffle(result.patches.begin(), result.patches.end(), random);
  for (PatchPoints& patch : result.patches) {
    if (random() % 2 != 0) {
      patch = transposed(patch);
    }
    if (random() % 2 != 0) {
      std::reverse(patch.begin(), patch.end());
    }
    if (random() % 2 != 0) {
      for (auto& row : patch) {
        std::reverse(row.begin(), row.end());
      }
    }
  }
  result.name += ", shuffled";
  result.agree = false;
  return result;
}

} // namespace simdbezier::tests
