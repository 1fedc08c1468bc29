// What has been compared, cell by cell, and what was found to differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/properties/metamorphic/axes.hpp"

namespace simdbezier::tests {

class Table {
public:
  Table() : filled_(cell_count()) {}

  void fill(const Cell& cell) { filled_[cell.index()] = 1; }
  /// One value that is not what the relation says; `text` describes the first of its sort.
  void fail(const Cell& cell, const std::string& text);
  [[nodiscard]] std::size_t sorts_of_failures() const { return failures_.size(); }

  /// Fails the test where values differed, where a cell is neither filled nor impossible, and where
  /// it is both. Prints the whole table where SIMDBEZIER_TABLE is in the environment.
  void judge(const std::string& title) const;

private:
  [[nodiscard]] char letter(Relation relation, Call call, std::size_t shape, Output output,
                            std::map<std::string, char>& legend) const;
  void print() const;

  struct Failures {
    std::size_t count = 0;
    std::string first;
  };
  std::vector<std::uint8_t> filled_;
  std::map<std::string, Failures> failures_;
};

} // namespace simdbezier::tests
