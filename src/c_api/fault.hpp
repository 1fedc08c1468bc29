// How functions of simdbezier.h end: in a status, and in a fault that is kept for the thread.
//
// Inside of this folder a refused call throws a Fault, which answer() catches: nothing leaves it.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <new>
#include <stdexcept>
#include <string_view>

#include <simdbezier.h>
#include <simdbezier/status.hpp>

namespace simdbezier::c_api {

/// An argument or a part of one: "nets[1].points", "out->normal.stride". All strings are literals.
struct Path {
  static constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

  const char* root = "";
  std::size_t index = kNoIndex; ///< of an array
  const char* member = nullptr;
  const char* part = nullptr; ///< of the member

  /// Whether the roots are the same. Equal literals may stand in different places.
  [[nodiscard]] constexpr bool is_of(const Path& other) const noexcept {
    return std::string_view(root) == other.root;
  }
  /// One level down.
  [[nodiscard]] constexpr Path operator/(const char* name) const noexcept {
    Path path = *this;
    (path.member == nullptr ? path.member : path.part) = name;
    return path;
  }
};

/// A row of a table that says what the statuses of a call are about.
struct Blame {
  std::initializer_list<Status::Code> statuses;
  Path path;
};
/// The path of the first row that has the status.
inline Path blamed(Status status, std::initializer_list<Blame> rows, const Path& otherwise) {
  for (const Blame& row : rows) {
    for (const Status::Code code : row.statuses) {
      if (status == code) {
        return row.path;
      }
    }
  }
  return otherwise;
}

struct Fault {
  simdbezier_status status = SIMDBEZIER_OK;
  Path path;
  std::size_t patch = 0;
  int point = -1; ///< not known
  int component = 0;
  const char* whole = "patch"; ///< what `patch` numbers
};

/// Keeps a fault for simdbezier_last_fault(), and returns its status.
simdbezier_status record(const char* function, const Fault& fault) noexcept;

inline simdbezier_status code_of(Status status) noexcept {
  return static_cast<simdbezier_status>(status.code());
}

/// Refuses the call where a condition of its arguments does not hold.
inline void require(bool holds, simdbezier_status otherwise, const Path& path) {
  if (!holds) {
    throw Fault{otherwise, path};
  }
}

/// Refuses the call if the C++ function refused it; path_of(status) names the argument.
template <typename PathOf>
void require_ok(Status status, PathOf path_of) {
  if (!status) {
    throw Fault{code_of(status), path_of(status)};
  }
}
template <typename PathOf>
void require_ok(const Report& report, PathOf path_of) {
  if (!report) {
    throw Fault{code_of(report.status), path_of(report.status), report.item,
                static_cast<int>(report.point), report.component};
  }
}

/// The same for reports that name a patch or a curve, but none of its points.
template <typename PathOf>
void require_item(const Report& report, PathOf path_of) {
  if (!report) {
    throw Fault{code_of(report.status), path_of(report.status), report.item};
  }
}

/// The body of a function: runs it and says how it ended.
template <typename Body>
simdbezier_status answer(const char* function, Body body) noexcept {
  try {
    body();
    return record(function, {});
  } catch (const Fault& fault) {
    return record(function, fault);
  } catch (const std::bad_alloc&) {
    return record(function, {SIMDBEZIER_OUT_OF_MEMORY, {}});
  } catch (const std::length_error&) {
    return record(function, {SIMDBEZIER_SIZE_OVERFLOW, {}});
  }
}

/// The body of a function that returns a size instead of a status: 0 where it is refused.
template <typename Body>
std::size_t size_or_zero(Body body) noexcept {
  try {
    return body();
  } catch (...) {
    return 0;
  }
}

} // namespace simdbezier::c_api
