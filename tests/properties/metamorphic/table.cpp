// See table.hpp.
#include "tests/properties/metamorphic/table.hpp"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

namespace simdbezier::tests {
namespace {

constexpr std::size_t kMostMessages = 12;

template <typename Axis>
[[nodiscard]] std::size_t number(Axis value) {
  return static_cast<std::size_t>(value);
}

/// Sorts of failures: everything but the instance of a side.
[[nodiscard]] std::string sort_of(const Cell& cell) {
  std::ostringstream text;
  text << kRelationNames[number(cell.relation)] << ", " << kOutputNames[number(cell.output)] << ", "
       << kShapeRows[cell.shape].name << ", " << kKindNames[number(cell.kind)] << ", "
       << kOriginNames[number(cell.origin)] << (cell.is_double ? ", double" : ", float");
  return text.str();
}

[[nodiscard]] std::string words(const Cell& cell) {
  return sort_of(cell) + ", " + kCallNames[number(cell.call)] + ", side " + kSideNames[cell.side];
}

} // namespace

void Table::fail(const Cell& cell, const std::string& text) {
  Failures& failures = failures_[sort_of(cell)];
  if (failures.count++ == 0) {
    failures.first = std::string(kCallNames[number(cell.call)]) + ", side " +
                     kSideNames[cell.side] + ": " + text;
  }
}

void Table::judge(const std::string& title) const {
  std::size_t filled = 0;
  std::size_t impossible = 0;
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < filled_.size(); ++k) {
    const Cell cell = cell_at(k);
    const char* const reason = impossible_because(cell);
    filled += filled_[k];
    impossible += reason != nullptr ? 1 : 0;
    if ((filled_[k] != 0) == (reason != nullptr) && ++wrong <= kMostMessages) {
      ADD_FAILURE() << (reason != nullptr ? "filled, but said to be impossible: "
                                          : "neither filled nor impossible: ")
                    << words(cell);
    }
  }
  EXPECT_EQ(wrong, 0U) << "cells";
  std::size_t values = 0;
  std::size_t messages = 0;
  for (const auto& [sort, failures] : failures_) {
    values += failures.count;
    if (++messages <= kMostMessages) {
      ADD_FAILURE() << title << ", " << sort << ": " << failures.count << " values, first by "
                    << failures.first;
    }
  }
  EXPECT_EQ(values, 0U) << "values in " << failures_.size() << " sorts of cells";
  std::printf("%s: %zu cells filled, %zu impossible\n", title.c_str(), filled, impossible);
  if (std::getenv("SIMDBEZIER_TABLE") != nullptr) {
    for (const auto& [sort, failures] : failures_) {
      std::printf("differs: %s: %zu, %s\n", sort.c_str(), failures.count, failures.first.c_str());
    }
    print();
  }
}

/// One letter for all sides, kinds, origins and types: # filled, ! a hole, a reason, or + where
/// some are filled and the others impossible.
char Table::letter(Relation relation, Call call, std::size_t shape, Output output,
                   std::map<std::string, char>& legend) const {
  bool some = false;
  std::string why;
  for (std::size_t side = 0; side < std::size(kSideNames); ++side) {
    for (std::size_t rest = 0; rest < 2 * std::size(kKindNames) * std::size(kOriginNames); ++rest) {
      const Cell cell{relation,
                      call,
                      shape,
                      output,
                      side,
                      static_cast<Kind>(rest / 2 / std::size(kOriginNames)),
                      static_cast<Origin>(rest / 2 % std::size(kOriginNames)),
                      rest % 2 == 1};
      const char* const reason = impossible_because(cell);
      if (reason == nullptr && filled_[cell.index()] == 0) {
        return '!';
      }
      some = some || reason == nullptr;
      why = reason != nullptr ? reason : why;
    }
  }
  if (why.empty()) {
    return '#';
  }
  const char next = static_cast<char>('a' + static_cast<int>(legend.size()));
  const char found = legend.try_emplace(why, next).first->second;
  return some ? '+' : found;
}

void Table::print() const {
  std::map<std::string, char> legend;
  for (std::size_t shape = 0; shape < std::size(kShapeRows); ++shape) {
    std::printf("column %zu: %s\n", shape + 1, kShapeRows[shape].name);
  }
  for (std::size_t relation = 0; relation < std::size(kRelationNames); ++relation) {
    for (std::size_t output = 0; output < std::size(kOutputNames); ++output) {
      std::printf("%s, %s\n", kRelationNames[relation], kOutputNames[output]);
      for (std::size_t call = 0; call < std::size(kCallNames); ++call) {
        std::printf("  %-20s", kCallNames[call]);
        for (std::size_t shape = 0; shape < std::size(kShapeRows); ++shape) {
          std::printf("%c", letter(static_cast<Relation>(relation), static_cast<Call>(call), shape,
                                   static_cast<Output>(output), legend));
        }
        std::printf("\n");
      }
    }
  }
  std::printf("# every side, kind, origin and type; + those that are possible\n");
  for (const auto& [reason, found] : legend) {
    std::printf("%c %s\n", found, reason.c_str());
  }
}

} // namespace simdbezier::tests
