// Parts of a model with their ghosts: they have the vertices and triangles of the whole one.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <simdbezier/mesh_layout.hpp>
#include <simdbezier/simdbezier.hpp>

#include "tests/mesh/support/mesh_models.hpp"
#include "tests/mesh/support/random_gluing.hpp"

namespace simdbezier::tests::mesh_parts_test {
namespace {

using PatchValues = std::array<double, 48>;
using Model = std::vector<PatchValues>;

// Several gluings, whose patches are dealt like cards.
Model random_model(unsigned seed) {
  Model model;
  for (unsigned k = 0; k < 3; ++k) {
    const RandomGluing gluing(3 * seed + k);
    for (std::size_t p = 0; p < gluing.patches; ++p) {
      std::copy_n(&gluing.values[48 * p], 48, model.emplace_back().begin());
    }
  }
  std::shuffle(model.begin(), model.end(), std::mt19937(seed));
  return model;
}

Model model_of(const MeshModel& from) {
  Model model(from.patches.size());
  const std::vector<double> values = from.values();
  for (std::size_t p = 0; p < model.size(); ++p) {
    std::copy_n(&values[48 * p], 48, model[p].begin());
  }
  return model;
}

// The oracle of neighbourhood: corners with equal coordinates.
std::set<std::array<double, 3>> places_of(const PatchValues& patch) {
  std::set<std::array<double, 3>> places;
  for (const std::size_t at : {0U, 9U, 36U, 45U}) {
    places.insert({patch[at] + 0.0, patch[at + 1] + 0.0, patch[at + 2] + 0.0});
  }
  return places;
}

enum class Split : std::uint8_t { none, creases, parameters };

struct Mesh {
  std::vector<std::uint32_t> patches; // numbers in the whole model
  MeshLayout layout;
  PatchSet<double> set;
};

Mesh make_mesh(const Model& model, const std::vector<std::uint32_t>& patches,
               std::span<const std::uint32_t> nu, std::span<const std::uint32_t> nv, Split split) {
  Mesh mesh{patches, {}, {}};
  std::vector<double> values;
  std::vector<std::uint32_t> own_nu;
  std::vector<std::uint32_t> own_nv;
  for (const std::uint32_t p : patches) {
    values.insert(values.end(), model[p].begin(), model[p].end());
    own_nu.push_back(nu[p]);
    own_nv.push_back(nv[p]);
  }
  const auto nets = ControlNets<double>::packed(values.data(), patches.size(), 3, 3);
  Topology topology;
  EXPECT_EQ(find_topology(nets, topology), Status::ok);
  EXPECT_EQ(lay_out_mesh(topology, {own_nu, own_nv, {}}, mesh.layout), Status::ok);
  EXPECT_EQ(pack(nets, mesh.set).status, Status::ok);
  if (split == Split::creases) {
    EXPECT_EQ(split_creases(mesh.set, mesh.layout, 29, mesh.layout), Status::ok);
  } else if (split == Split::parameters) {
    EXPECT_EQ(split_parameters(mesh.layout, mesh.layout), Status::ok);
  }
  return mesh;
}

std::vector<std::uint32_t> triangles_of(const Mesh& mesh, SetRange range) {
  const MeshLayout& layout = mesh.layout;
  std::vector<std::uint32_t> triangles(
      3 * (layout.first_triangle(range.first + range.count) - layout.first_triangle(range.first)));
  EXPECT_EQ(write_triangles<std::uint32_t>(layout, triangles, {}, range), Status::ok);
  return triangles;
}

std::vector<double> positions_of(const Mesh& mesh, SetRange range) {
  const MeshLayout& layout = mesh.layout;
  std::vector<double> values(
      6 * (layout.first_vertex(range.first + range.count) - layout.first_vertex(range.first)));
  if (!values.empty()) {
    MeshOutputs<double> out;
    out.position = Vectors<double>::xyz(values.data(), 6);
    out.normal = Vectors<double>::xyz(values.data() + 3, 6);
    EXPECT_EQ(evaluate_mesh(mesh.set, layout, out, {}, range), Status::ok);
  }
  return values;
}

// Cuts the model into parts, and compares each with the whole.
void expect_parts_of_whole(const Model& model, std::size_t parts, unsigned seed, Split split) {
  const std::size_t count = model.size();
  std::mt19937 random(seed);
  std::vector<std::uint32_t> nu(count);
  std::vector<std::uint32_t> nv(count);
  std::vector<std::uint32_t> all(count);
  for (std::uint32_t p = 0; p < count; ++p) {
    nu[p] = 1 + static_cast<std::uint32_t>(random() % 5);
    nv[p] = 1 + static_cast<std::uint32_t>(random() % 5);
    all[p] = p;
  }
  const Mesh whole = make_mesh(model, all, nu, nv, split);
  std::vector<PatchVertices> told(count);
  ASSERT_EQ(owned_vertices(whole.layout, {0, count}, 0, told), Status::ok);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = count * part / parts;
    const std::size_t end = count * (part + 1) / parts;
    SCOPED_TRACE("patches " + std::to_string(begin) + " to " + std::to_string(end));
    std::set<std::array<double, 3>> places;
    for (std::size_t p = begin; p < end; ++p) {
      places.merge(places_of(model[p]));
    }
    std::vector<std::uint32_t> patches;
    SetRange own{0, end - begin};
    std::vector<PatchVertices> ghosts;
    for (std::uint32_t p = 0; p < count; ++p) {
      const auto corners = places_of(model[p]);
      if ((p >= begin && p < end) ||
          std::any_of(corners.begin(), corners.end(),
                      [&](const auto& x) { return places.contains(x); })) {
        patches.push_back(p);
        if (p < begin) {
          ++own.first;
          ghosts.push_back(told[p]);
        }
      }
    }
    const Mesh mesh = make_mesh(model, patches, nu, nv, split);
    const std::uint64_t first = whole.layout.first_vertex(begin);
    std::vector<PatchVertices> owned(own.count);
    ASSERT_EQ(owned_vertices(mesh.layout, own, first, owned), Status::ok);
    for (std::size_t p = 0; p < own.count; ++p) {
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(owned[p].corners[k], told[begin + p].corners[k]);
        EXPECT_EQ(owned[p].edges[k], told[begin + p].edges[k]);
      }
    }
    std::vector<std::uint64_t> numbers(mesh.layout.first_vertex(own.first + own.count));
    ASSERT_EQ(number_part(mesh.layout, own, first, ghosts, numbers), Status::ok);
    std::vector<std::uint32_t> triangles = triangles_of(mesh, own);
    for (std::uint32_t& vertex : triangles) {
      vertex = static_cast<std::uint32_t>(numbers.at(vertex));
    }
    EXPECT_EQ(triangles, triangles_of(whole, {begin, end - begin}));
    EXPECT_EQ(positions_of(mesh, own), positions_of(whole, {begin, end - begin}));
  }
}

TEST(MeshParts, have_the_vertices_of_the_whole) {
  for (const MeshModel& from : mesh_models()) {
    const Model model = model_of(shuffled(from, 1));
    SCOPED_TRACE(from.name);
    for (const std::size_t parts : {1U, 2U, 3U, 7U}) {
      expect_parts_of_whole(model, std::min(parts, model.size()), 1, Split::none);
    }
  }
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = random_model(seed);
    for (const Split split : {Split::none, Split::creases, Split::parameters}) {
      expect_parts_of_whole(model, std::min<std::size_t>(2 + seed % 4, model.size()), seed, split);
    }
  }
}

// Vertices one by one are those that triangles have: of a single cell, and where edges are finer.
TEST(MeshParts, single_vertices_are_those_of_the_triangles) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = random_model(seed);
    std::vector<std::uint32_t> rates(model.size());
    std::vector<std::uint32_t> all(model.size());
    for (std::uint32_t p = 0; p < model.size(); ++p) {
      rates[p] = 1 + p % 4;
      all[p] = p;
    }
    const Mesh mesh = make_mesh(model, all, rates, rates, static_cast<Split>(seed % 3));
    const MeshLayout& layout = mesh.layout;
    for (std::uint32_t p = 0; p < model.size(); ++p) {
      std::set<std::uint32_t> single;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto edge = static_cast<PatchEdge>(k);
        const std::size_t begin = k == 1 ? 2 : k == 3 ? 1 : 0;
        const std::size_t end = k == 0 ? 1 : k == 2 ? 2 : 3;
        EXPECT_EQ(layout.along(p, edge, 0), layout.corner(p, begin));
        EXPECT_EQ(layout.along(p, edge, layout.segments(p, edge)), layout.corner(p, end));
        for (std::uint32_t j = 0; j <= layout.segments(p, edge); ++j) {
          single.insert(layout.along(p, edge, j));
        }
        EXPECT_EQ(layout.along(p, edge, layout.segments(p, edge) + 1), kNoLayoutVertex);
      }
      for (std::uint32_t j = 1; j < rates[p]; ++j) {
        for (std::uint32_t i = 1; i < rates[p]; ++i) {
          single.insert(layout.inner(p, i, j));
        }
      }
      EXPECT_EQ(layout.inner(p, rates[p], 1), kNoLayoutVertex);
      const std::vector<std::uint32_t> triangles = triangles_of(mesh, {p, 1});
      const std::set<std::uint32_t> used(triangles.begin(), triangles.end());
      EXPECT_TRUE(std::includes(single.begin(), single.end(), used.begin(), used.end()));
    }
  }
}

// Keys say the same as find_adjacency() and as equal coordinates.
TEST(MeshParts, keys_are_equal_where_corners_and_edges_are) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = random_model(seed);
    const auto nets = ControlNets<double>::packed(model[0].data(), model.size(), 3, 3);
    const std::span views(&nets, 1);
    std::vector<PatchKeys> keys(model.size());
    ASSERT_EQ(find_patch_keys<double>(views, keys), Status::ok);
    std::vector<EdgeLink> links(4 * model.size());
    ASSERT_EQ(find_adjacency(nets, Values<EdgeLink>(std::span(links))), Status::ok);
    std::map<std::array<double, 3>, std::uint64_t> places;
    std::set<std::uint64_t> different;
    for (std::size_t p = 0; p < model.size(); ++p) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double* const at = &model[p][(k % 2 == 0 ? 0 : 9) + (k < 2 ? 0 : 36)];
        const auto known =
            places.emplace(std::array{at[0] + 0.0, at[1] + 0.0, at[2] + 0.0}, keys[p].corners[k]);
        EXPECT_EQ(known.first->second, keys[p].corners[k]);
        different.insert(keys[p].corners[k]);
        const EdgeLink& link = links[4 * p + k];
        EXPECT_EQ((keys[p].points >> k & 1) != 0, link.kind == EdgeKind::collapsed);
        for (std::size_t other = 0; other < 4 * model.size(); ++other) {
          const bool same = keys[other / 4].edges[other % 4] == keys[p].edges[k];
          if (link.kind == EdgeKind::boundary) {
            EXPECT_EQ(same, other == 4 * p + k);
          }
        }
        if (link.kind == EdgeKind::shared) {
          EXPECT_EQ(keys[link.patch].edges[static_cast<std::size_t>(link.edge)], keys[p].edges[k]);
        }
      }
    }
    EXPECT_EQ(different.size(), places.size());
  }
}

// Weights of 1 count as none, homogeneous points are quotients, and -0 is 0.
TEST(MeshParts, keys_do_not_depend_on_the_form_of_points) {
  const std::vector<float> plain = {-0.0F, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<float> weighted;
  std::vector<float> doubled;
  for (std::size_t k = 0; k < plain.size(); k += 3) {
    for (const float w : {1.0F, 2.0F}) {
      std::vector<float>& to = w == 1 ? weighted : doubled;
      to.insert(to.end(), {plain[k] * w, plain[k + 1] * w, plain[k + 2] * w, w});
    }
  }
  const ControlNets<float> nets[] = {
      ControlNets<float>::packed(plain.data(), 1, 1, 1),
      ControlNets<float>::packed(weighted.data(), 1, 1, 1, 3, Weights::homogeneous),
      ControlNets<float>::packed(weighted.data(), 1, 1, 1, 3, Weights::cartesian),
      ControlNets<float>::packed(doubled.data(), 1, 1, 1, 3, Weights::homogeneous)};
  std::vector<PatchKeys> keys(4);
  ASSERT_EQ(find_patch_keys<float>(nets, keys), Status::ok);
  for (std::size_t p = 1; p < 4; ++p) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(keys[p].corners[k], keys[0].corners[k]);
      EXPECT_EQ(keys[p].edges[k] == keys[0].edges[k], p < 3); // weights of 2 are not none
    }
  }
}

TEST(MeshParts, refuse_what_is_not_theirs) {
  const Model model = random_model(1);
  const std::vector<std::uint32_t> rates(model.size(), 2);
  std::vector<std::uint32_t> all(model.size());
  std::iota(all.begin(), all.end(), 0U);
  const Mesh mesh = make_mesh(model, all, rates, rates, Split::none);
  std::vector<PatchVertices> told(model.size());
  std::vector<std::uint64_t> numbers(mesh.layout.size().vertices);
  const SetRange behind{0, model.size() + 1};
  EXPECT_EQ(owned_vertices(mesh.layout, behind, 0, told), Status::bad_patch_range);
  EXPECT_EQ(owned_vertices(mesh.layout, {0, model.size()}, 0, std::span(told).first(1)),
            Status::output_too_small);
  EXPECT_EQ(number_part(mesh.layout, behind, 0, {}, numbers), Status::bad_patch_range);
  EXPECT_EQ(number_part(mesh.layout, {1, 1}, 0, {}, numbers), Status::unequal_lengths);
  EXPECT_EQ(number_part(mesh.layout, {0, 1}, 0, {}, {}), Status::output_too_small);
  EXPECT_EQ(number_part({}, {0, 0}, 0, {}, {}), Status::ok);
  EXPECT_EQ(mesh.layout.corner(model.size(), 0), kNoLayoutVertex);
  EXPECT_EQ(MeshLayout().corner(0, 0), kNoLayoutVertex);
  EXPECT_EQ(MeshLayout().segments(0, PatchEdge::v0), 0U);
}

} // namespace
} // namespace simdbezier::tests::mesh_parts_test
