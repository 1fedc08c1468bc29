// What must hold between the results of two nets of which one is made of the other, for every call,
// shape, output, side, kind of degeneracy, choice of origins and type: a table without holes.
#include <gtest/gtest.h>

#include "tests/properties/metamorphic/comparison.hpp"
#include "tests/support/isa_fixture.hpp"
#include "tests/support/isas.hpp"
#include "tests/support/long_form.hpp"

namespace simdbezier::tests::metamorphic_test {
namespace {

template <typename Axis, std::size_t count>
[[nodiscard]] std::vector<Axis> all(const char* const (&)[count]) {
  std::vector<Axis> values;
  for (std::size_t k = 0; k < count; ++k) {
    values.push_back(static_cast<Axis>(k));
  }
  return values;
}

/// Every kind at every side of one shape; two ends of curves.
void add_entries(std::size_t shape, Origin origin, Random& random, std::vector<MetaEntry>& list) {
  const ShapeRow& row = kShapeRows[shape];
  for (const Kind kind : all<Kind>(kKindNames)) {
    for (std::size_t side = row.is_curve() ? 2 : 0; side < std::size(kSideNames); ++side) {
      if (!row.is_curve() || kind == Kind::regular || kind == Kind::doubled_row) {
        list.push_back({shape, kind, side, meta_net(row, kind, side, origin, random)});
      }
    }
  }
}

/// The nets of one column of the table.
[[nodiscard]] std::vector<MetaEntry> entries_of(std::size_t shape, Origin origin) {
  Random random(7 * shape + static_cast<std::size_t>(origin));
  std::vector<MetaEntry> list;
  if (shape != kMixedShape) {
    add_entries(shape, origin, random, list);
    return list;
  }
  for (std::size_t k = 0; k < kMixedShape; ++k) {
    const ShapeRow& row = kShapeRows[k];
    if (!row.is_curve() && row.components == 3 && row.degree_u < kMostDegree &&
        row.weights != Weights::cartesian) {
      add_entries(k, origin, random, list);
    }
  }
  return list;
}

[[nodiscard]] std::vector<MetaNet> nets_of(const std::vector<MetaEntry>& entries) {
  std::vector<MetaNet> nets;
  for (const MetaEntry& entry : entries) {
    nets.push_back(entry.net);
  }
  return nets;
}

/// Whether any output of the pair is in the table.
[[nodiscard]] bool is_possible(Relation relation, Call call, std::size_t shape) {
  const Cell cell{relation, call, shape, Output::position, 2, Kind::regular, Origin::none, false};
  return impossible_because(cell) == nullptr;
}

class Metamorphic : public IsaTest {
protected:
  void compare_column(std::size_t shape, Origin origin, bool is_double) {
    const std::vector<MetaEntry> entries = entries_of(shape, origin);
    const MetaBatch batch(nets_of(entries), placement_of(origin), is_double, isa());
    const std::vector<MetaBatch> others = related_batches(entries, batch, shape, is_double);
    for (const Call call : all<Call>(kCallNames)) {
      compare_call({{}, call, shape, origin, is_double, fuses_multiply_add(isa())}, entries, batch,
                   others);
    }
  }

  Table table_;

  [[nodiscard]] Sheet evaluate(const MetaBatch& batch, Call call, std::size_t nu, std::size_t nv) {
    Sheet sheet;
    run({}, [&](const CallOptions& forced) {
      return batch.set->evaluate(call, nu, nv, forced, sheet);
    });
    return sheet;
  }

private:
  /// One for each relation.
  [[nodiscard]] static std::vector<MetaBatch> related_batches(const std::vector<MetaEntry>& entries,
                                                              const MetaBatch& batch,
                                                              std::size_t shape, bool is_double) {
    std::vector<MetaBatch> result;
    for (const Relation relation : all<Relation>(kRelationNames)) {
      std::vector<MetaNet> nets;
      // Where nothing is possible, the nets themselves keep the place.
      const bool possible = is_possible(relation, Call::grid, shape) ||
                            is_possible(relation, Call::curve_rows, shape);
      for (const MetaEntry& entry : entries) {
        nets.push_back(possible ? related(entry.net, relation) : entry.net);
      }
      result.emplace_back(std::move(nets),
                          related(batch.placement, relation, entries[0].net.components), is_double,
                          isa());
    }
    return result;
  }

  void compare_call(Comparison what, const std::vector<MetaEntry>& entries, const MetaBatch& batch,
                    const std::vector<MetaBatch>& others) {
    const ShapeRow& row = kShapeRows[what.shape];
    const auto nu = static_cast<std::size_t>(row.nu);
    const auto nv = static_cast<std::size_t>(row.nv);
    Sheet sheet;
    for (const Relation relation : all<Relation>(kRelationNames)) {
      if (!is_possible(relation, what.call, what.shape)) {
        continue;
      }
      if (sheet.nu == 0) {
        sheet = evaluate(batch, what.call, nu, nv);
      }
      what.relation = relation;
      const MetaBatch& other = others[static_cast<std::size_t>(relation)];
      const bool swapped = relation == Relation::transposed;
      const Sheet found =
          evaluate(other, related(what.call, relation), swapped ? nv : nu, swapped ? nu : nv);
      compare(what, entries, batch, sheet, other, found, table_);
    }
  }
};

TEST_P(Metamorphic, EveryCellIsFilledOrImpossible) {
  for (std::size_t shape = 0; shape < std::size(kShapeRows); ++shape) {
    for (const Origin origin : all<Origin>(kOriginNames)) {
      for (const bool is_double : {false, true}) {
        compare_column(shape, origin, is_double);
      }
    }
  }
  table_.judge(std::string(to_string(isa())));
}
/// One value of a sheet, for all groups that it has; null behind the last one.
[[nodiscard]] double* value_of_group(Sheet& sheet, std::size_t group, std::size_t at) {
  std::vector<std::vector<double>*> groups{&sheet.direction, &sheet.curvature};
  for (auto& row : sheet.derivatives) {
    for (std::vector<double>& values : row) {
      groups.push_back(&values);
    }
  }
  for (std::vector<double>* const values : groups) {
    if (!values->empty() && group-- == 0) {
      return &(*values)[at % values->size()];
    }
  }
  return nullptr;
}

// A table without holes says nothing where wrong values pass: one of them in each group in turn.
TEST_P(Metamorphic, OneWrongValueIsNoticed) {
  for (const std::size_t shape : {std::size_t{0}, std::size_t{3}, std::size_t{16}}) {
    const std::vector<MetaEntry> entries = entries_of(shape, Origin::none);
    const MetaBatch batch(nets_of(entries), {}, true, isa());
    const ShapeRow& row = kShapeRows[shape];
    const Call call = row.is_curve() ? Call::curve_rows : Call::grid;
    const Sheet right =
        evaluate(batch, call, static_cast<std::size_t>(row.nu), static_cast<std::size_t>(row.nv));
    const Comparison what{Relation::reweighted, call, shape, Origin::none, true, true};
    const std::size_t inner = static_cast<std::size_t>(row.is_curve() ? 2 : row.nu + 1);
    for (std::size_t group = 0;; ++group) {
      Sheet wrong = right;
      double* const value = value_of_group(wrong, group, inner);
      if (value == nullptr) {
        EXPECT_GE(group, row.is_curve() ? 5U : 8U);
        break;
      }
      *value += 1e-6;
      Table table;
      compare(what, entries, batch, right, batch, wrong, table);
      EXPECT_EQ(table.sorts_of_failures(), 1U) << "shape " << shape << ", group " << group;
    }
    Table none;
    compare(what, entries, batch, right, batch, right, none);
    EXPECT_EQ(none.sorts_of_failures(), 0U);
  }
}

/// The widest instruction set of each class, for the others have their bits
/// (tests/properties/bits); all of them in the long form.
[[nodiscard]] std::vector<Isa> tested_isas() {
  const std::span<const Isa> available = available_isas();
  return long_form() ? std::vector<Isa>(available.begin(), available.end())
                     : widest_of_each_class();
}
INSTANTIATE_TEST_SUITE_P(Isa, Metamorphic, ::testing::ValuesIn(tested_isas()), isa_test_name);

} // namespace
} // namespace simdbezier::tests::metamorphic_test
