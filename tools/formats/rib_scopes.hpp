// What ends with its scope in RIB files: the bases, and what moves patches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tools/formats/rib_requests.hpp>

namespace simdbezier::tools {

class RibScopes {
public:
  struct Basis {
    std::string name = "bezier";
    std::size_t step = 3;
  };
  struct Bases {
    Basis u;
    Basis v;
  };
  /// The first transformation that moves the patches here.
  struct Mover {
    std::string name;
    std::size_t line = 0; ///< 0: there is none
  };

  [[nodiscard]] Bases& bases() noexcept { return scopes_.back().bases; }
  [[nodiscard]] const Mover& mover() const noexcept { return scopes_.back().mover; }

  /// Of the transformations before a world, its camera has been made.
  void begin(std::string_view request) {
    const Scope scope = scopes_.back();
    scopes_.push_back(scope);
    if (request == "WorldBegin") {
      scopes_.back().mover.line = 0;
    }
  }

  void end(std::string_view request) {
    const Bases inner = bases();
    scopes_.resize(std::max<std::size_t>(scopes_.size() - 1, 1));
    if (request == "TransformEnd") {
      bases() = inner;
    }
  }

  /// A transformation joins those before it, or replaces them (Identity, Transform).
  void transform(const RibTransformation& known, std::span<const double> numbers,
                 std::size_t line) {
    if (known.name == "Identity" || known.name == "Transform") {
      scopes_.back().mover.line = 0;
    }
    if (!std::ranges::equal(numbers.first(known.compared),
                            std::span(known.identity).first(known.compared))) {
      move(known.name, line);
    }
  }

  void move(std::string_view name, std::size_t line) {
    if (mover().line == 0) {
      scopes_.back().mover = {std::string(name), line};
    }
  }

private:
  struct Scope {
    Bases bases;
    Mover mover;
  };
  std::vector<Scope> scopes_ = std::vector<Scope>(1);
};

} // namespace simdbezier::tools
