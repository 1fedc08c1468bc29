#include <tools/formats/rib/trims.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tools/process/counts.hpp>
#include <tools/process/failure.hpp>
#include <tools/process/output_file.hpp>

namespace simdbezier::tools {

namespace {

using Corner = std::array<double, 2>;
using Numbers = std::vector<double>;

/// The lists of a TrimCurve, which have to fit together.
class TrimLists {
public:
  explicit TrimLists(RibTokens& tokens) : tokens_(tokens) {
    const std::string each_curve = "of each curve";
    curves_ = read("the number of curves of each loop");
    const double curves = sum(curves_, "a number of curves", 1);
    orders_ = read("the order " + each_curve, curves);
    const double orders = sum(orders_, "an order", 2);
    knots_ = read("the knots " + each_curve);
    least_ = read("the beginning " + each_curve, curves);
    most_ = read("the end " + each_curve, curves);
    counts_ = read("the number of points " + each_curve, curves);
    const double points = sum(counts_, "a number of points", 2);
    require_size(knots_, points + orders, "the knots " + each_curve);
    for (Numbers* const list : {&u_, &v_, &w_}) {
      *list = read("a coordinate of each point", points);
    }
  }

  [[nodiscard]] bool is_empty() const { return curves_.empty(); }

  /// Returns the corners of the only loop, where that consists of straight lines, and nothing
  /// otherwise. The last one is the first one again.
  [[nodiscard]] std::vector<Corner> corners() const {
    std::vector<Corner> all;
    std::size_t point = 0;
    std::size_t knot = 0;
    bool is_straight = curves_.size() == 1;
    for (std::size_t k = 0; k < orders_.size() && is_straight; ++k) {
      const auto count = static_cast<std::size_t>(counts_[k]);
      const auto spans = knots_.begin() + static_cast<std::ptrdiff_t>(knot) + 1;
      const auto last = spans + static_cast<std::ptrdiff_t>(count) - 1;
      is_straight = orders_[k] == 2 && least_[k] == *spans && most_[k] == *last &&
                    std::is_sorted(spans, last + 1, std::less_equal<>()) &&
                    (all.empty() || all.back() == corner(point));
      for (std::size_t i = 0; i < count; ++i) {
        all.push_back(corner(point + i));
      }
      point += count;
      knot += count + 2;
    }
    is_straight = is_straight && all.front() == all.back();
    return is_straight ? all : std::vector<Corner>();
  }

private:
  [[nodiscard]] Corner corner(std::size_t k) const { return {u_[k] / w_[k], v_[k] / w_[k]}; }

  Numbers read(const std::string& what) { return tokens_.numbers_of(what + " of the TrimCurve"); }

  Numbers read(const std::string& what, double size) {
    Numbers numbers = read(what);
    require_size(numbers, size, what);
    return numbers;
  }

  void require_size(const Numbers& numbers, double size, const std::string& what) const {
    if (static_cast<double>(numbers.size()) != size) {
      bad_input_at(tokens_.name(), tokens_.line(),
                   quantity(static_cast<std::size_t>(size), "number", "numbers") + " (" + what +
                       " of the TrimCurve)",
                   std::to_string(numbers.size()));
    }
  }

  /// Adds up counts.
  [[nodiscard]] double sum(const Numbers& numbers, const std::string& what, double least) const {
    double all = 0;
    for (const double number : numbers) {
      if (!(number >= least && number <= RibTokens::kMostPoints) ||
          number != static_cast<double>(static_cast<std::size_t>(number))) {
        bad_input_at(tokens_.name(), tokens_.line(),
                     what + " of the TrimCurve (" + shortest(least) + " or more)",
                     shortest(number));
      }
      all += number;
    }
    return all;
  }

  RibTokens& tokens_;
  Numbers curves_; // of each loop
  Numbers orders_; // of each curve, and so are the next four
  Numbers knots_;
  Numbers least_;
  Numbers most_;
  Numbers counts_;
  Numbers u_; // of each point, and so are the next two
  Numbers v_;
  Numbers w_;
};

/// Where a corner is on its way around a rectangle: the side, and how far along it.
std::optional<std::pair<int, double>> place_around(const Corner& corner, const Interval& u,
                                                   const Interval& v) {
  const double at_u = corner[0];
  const double at_v = corner[1];
  const bool is_inside = at_u >= u.begin && at_u <= u.end && at_v >= v.begin && at_v <= v.end;
  if (is_inside && at_v == v.begin && at_u < u.end) {
    return std::pair(0, at_u);
  }
  if (is_inside && at_u == u.end && at_v < v.end) {
    return std::pair(1, at_v);
  }
  if (is_inside && at_v == v.end && at_u > u.begin) {
    return std::pair(2, -at_u);
  }
  return is_inside && at_u == u.begin ? std::optional(std::pair(3, -at_v)) : std::nullopt;
}

/// Returns the rectangle around which the corners run once, the last one being the first one again.
std::optional<RibRectangle> rectangle_of(const std::vector<Corner>& corners) {
  if (corners.empty()) {
    return std::nullopt;
  }
  const auto [left, right] =
      std::ranges::minmax(corners, {}, [](const Corner& corner) { return corner[0]; });
  const auto [lower, upper] =
      std::ranges::minmax(corners, {}, [](const Corner& corner) { return corner[1]; });
  const RibRectangle around{{left[0], right[0]}, {lower[1], upper[1]}};
  std::vector<std::pair<int, double>> places;
  for (const Corner& corner : corners) {
    const auto place = place_around(corner, around.u, around.v);
    if (!place) {
      return std::nullopt;
    }
    if (places.empty() || places.back() != *place) {
      places.push_back(*place);
    }
  }
  if (places.size() < 5) {
    return std::nullopt;
  }
  places.pop_back();
  const auto rises = [&] { // from its least place on
    std::rotate(places.begin(), std::ranges::min_element(places), places.end());
    return std::ranges::is_sorted(places, std::less_equal<>());
  };
  const bool is_once_around = rises() || (std::ranges::reverse(places), rises());
  const std::pair<int, double> needed[] = {
      {0, around.u.begin}, {1, around.v.begin}, {2, -around.u.end}, {3, -around.v.end}};
  return is_once_around && std::ranges::includes(places, needed) ? std::optional(around)
                                                                 : std::nullopt;
}

} // namespace

RibTrim read_rib_trim(RibTokens& tokens) {
  RibTrim trim{tokens.line(), {}};
  const TrimLists lists(tokens);
  if (lists.is_empty()) {
    trim.line = 0;
  } else {
    trim.rectangle = rectangle_of(lists.corners());
  }
  return trim;
}

} // namespace simdbezier::tools
