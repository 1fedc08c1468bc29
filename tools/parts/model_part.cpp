#include <tools/parts/model_part.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include <tools/patches/library_status.hpp>
#include <tools/patches/patch_box.hpp>

namespace simdbezier::tools {

namespace {

template <typename T>
std::vector<PatchKeys> keys_of(const PatchFile& file) {
  const PatchNets<T> nets = file.nets<T>();
  std::vector<PatchKeys> keys(file.count);
  check(find_patch_keys<T>(nets.nets, keys));
  return keys;
}

bool overlap(const MeshBox& a, const MeshBox& b) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (a.low[c] > b.high[c] || b.low[c] > a.high[c]) {
      return false;
    }
  }
  return true;
}

/// All patches that have a corner in one of some places, which may become more.
template <typename T>
class Neighbourhood {
public:
  Neighbourhood(const PatchSource& source, SetRange own) : source_(source), own_(own) {
    // Points that rounding to T puts in one place are this far apart at most; quotients of
    // homogeneous points are rounded as well.
    margin_ = 16 * static_cast<double>(std::numeric_limits<T>::epsilon()) *
              largest_coordinate(source.box());
    const PatchFile file = source.read(own.first, own.count);
    const std::vector<PatchKeys> keys = keys_of<T>(file);
    for (std::size_t k = 0; k < own.count; ++k) {
      found_.emplace(static_cast<std::uint32_t>(own.first + k), keys[k]);
    }
    for (const PatchKeys& key : keys) {
      add_places(key);
    }
    box_ = with_margin(box_of(file));
  }

  /// Adds all places of what has been found, and what is there.
  void grow() {
    for (const auto& [patch, key] : found_) {
      add_places(key);
    }
    for (const std::uint32_t patch : ghosts_) {
      extend_to(patch);
    }
    find();
  }
  /// Adds the places of neighbours of these patches, and what is there, where they are new.
  bool grow_around(const std::vector<std::uint32_t>& patches) {
    const std::size_t before = places_.size();
    std::unordered_set<std::uint64_t> around;
    for (const std::uint32_t patch : patches) {
      const PatchKeys& key = found_.at(patch);
      around.insert(std::begin(key.corners), std::end(key.corners));
    }
    for (const auto& [patch, key] : found_) {
      if (std::any_of(std::begin(key.corners), std::end(key.corners),
                      [&](std::uint64_t corner) { return around.contains(corner); })) {
        add_places(key);
        if (!is_own(patch)) {
          extend_to(patch);
        }
      }
    }
    if (places_.size() == before) {
      return false;
    }
    find();
    return true;
  }

  /// Finds what is in the places so far. Sides that are points join the places of both ends, also
  /// where these were rounded differently.
  void find() {
    for (bool more = true; more;) {
      for (const SbpBlock& block : source_.blocks()) {
        if (overlap(box_, {block.low, block.high})) {
          find_in(block);
        }
      }
      const std::size_t before = places_.size();
      for (const auto& [patch, key] : found_) {
        for (std::size_t side = 0; side < kPatchEdges && key.points != 0; ++side) {
          const auto [a, b] = ends_of(key, side);
          if ((key.points >> side & 1) != 0 && places_.contains(a) != places_.contains(b)) {
            places_.insert({a, b});
            if (!is_own(patch)) {
              extend_to(patch);
            }
          }
        }
      }
      more = places_.size() != before;
    }
  }

  /// Returns whether all patches that share a place with this one have been found.
  [[nodiscard]] bool is_inside(std::uint32_t patch) const {
    const PatchKeys& key = found_.at(patch);
    return std::all_of(std::begin(key.corners), std::end(key.corners),
                       [&](std::uint64_t corner) { return places_.contains(corner); });
  }
  [[nodiscard]] std::vector<std::uint32_t> ghosts() const {
    std::vector<std::uint32_t> ghosts = ghosts_;
    std::ranges::sort(ghosts);
    return ghosts;
  }
  [[nodiscard]] bool is_own(std::uint32_t patch) const {
    return patch >= own_.first && patch - own_.first < own_.count;
  }

  /// Returns which own patches share places with later ones, among those found so far.
  [[nodiscard]] std::vector<ModelPart::Lent> lent() const {
    std::unordered_map<std::uint64_t, std::uint64_t> joined; // places to what stands for them
    const auto name = [&](std::uint64_t place) {
      for (auto at = joined.find(place); at != joined.end(); at = joined.find(place)) {
        place = at->second;
      }
      return place;
    };
    for (const auto& [patch, key] : found_) {
      for (std::size_t side = 0; side < kPatchEdges && key.points != 0; ++side) {
        const auto [a, b] = ends_of(key, side);
        if ((key.points >> side & 1) != 0 && name(a) != name(b)) {
          joined.emplace(name(a), name(b));
        }
      }
    }
    std::unordered_multimap<std::uint64_t, std::uint32_t> later;
    for (const auto& [patch, key] : found_) {
      for (std::size_t k = 0; k < 4 && patch >= own_.first + own_.count; ++k) {
        later.emplace(name(key.corners[k]), patch);
      }
    }
    std::vector<ModelPart::Lent> lent;
    for (const auto& [patch, key] : found_) {
      for (std::size_t k = 0; k < 4 && is_own(patch); ++k) {
        const auto [begin, end] = later.equal_range(name(key.corners[k]));
        for (auto at = begin; at != end; ++at) {
          lent.push_back({patch, at->second});
        }
      }
    }
    std::ranges::sort(lent);
    lent.erase(std::unique(lent.begin(), lent.end()), lent.end());
    return lent;
  }

private:
  static std::pair<std::uint64_t, std::uint64_t> ends_of(const PatchKeys& key, std::size_t side) {
    constexpr std::size_t kEnds[kPatchEdges][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    return {key.corners[kEnds[side][0]], key.corners[kEnds[side][1]]};
  }
  void add_places(const PatchKeys& key) {
    places_.insert(std::begin(key.corners), std::end(key.corners));
  }
  [[nodiscard]] MeshBox with_margin(MeshBox box) const {
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] -= margin_;
      box.high[c] += margin_;
    }
    return box;
  }
  void extend_to(std::uint32_t patch) {
    const MeshBox box = with_margin(boxes_.at(patch));
    for (std::size_t c = 0; c < 3; ++c) {
      box_.low[c] = std::min(box_.low[c], box.low[c]);
      box_.high[c] = std::max(box_.high[c], box.high[c]);
    }
  }
  void find_in(const SbpBlock& block) {
    const std::size_t own_end = own_.first + own_.count;
    if (block.first_patch >= own_.first && block.first_patch + block.count <= own_end) {
      return;
    }
    const PatchFile file = source_.read(block.first_patch, block.count);
    const std::vector<PatchKeys> keys = keys_of<T>(file);
    for (std::size_t k = 0; k < block.count; ++k) {
      const auto patch = static_cast<std::uint32_t>(block.first_patch + k);
      if (!is_own(patch) &&
          std::any_of(std::begin(keys[k].corners), std::end(keys[k].corners),
                      [&](std::uint64_t corner) { return places_.contains(corner); }) &&
          found_.emplace(patch, keys[k]).second) {
        ghosts_.push_back(patch);
        boxes_.emplace(patch, box_of(file, k, 1));
      }
    }
  }

  const PatchSource& source_;
  SetRange own_;
  double margin_;
  MeshBox box_; // around all places
  std::unordered_set<std::uint64_t> places_;
  std::unordered_map<std::uint32_t, PatchKeys> found_;
  std::vector<std::uint32_t> ghosts_;
  std::unordered_map<std::uint32_t, MeshBox> boxes_; // of ghosts
};

/// Returns the patches that share their rates' fate with others, and of which this has to be known.
template <typename T>
std::vector<std::uint32_t> entangled(const PatchFile& file,
                                     const std::vector<std::uint32_t>& numbers,
                                     const Neighbourhood<T>& around) {
  Topology topology;
  const PatchNets<T> nets = file.nets<T>();
  check(find_topology<T>(nets.nets, topology));
  std::vector<std::uint32_t> found;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (topology.is_entangled(k) && around.is_inside(numbers[k])) {
      found.push_back(numbers[k]);
    }
  }
  return found;
}

} // namespace

ModelPart whole_model(PatchFile file) {
  ModelPart part;
  part.own = {0, file.count};
  part.patches = file.count;
  part.box = box_of(file);
  part.file = std::move(file);
  return part;
}

std::vector<std::uint32_t> ModelPart::ghosts() const {
  const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(own.first);
  std::vector<std::uint32_t> ghosts(numbers.begin(), begin);
  ghosts.insert(ghosts.end(), begin + static_cast<std::ptrdiff_t>(own.count), numbers.end());
  return ghosts;
}

ModelPart part_with(const PatchSource& source, SetRange own, std::vector<std::uint32_t> ghosts) {
  ModelPart part;
  const auto first = std::ranges::lower_bound(ghosts, own.first);
  part.own = {static_cast<std::size_t>(first - ghosts.begin()), own.count};
  part.patches = source.patches();
  part.box = source.box();
  const auto at = ghosts.insert(first, own.count, 0);
  std::iota(at, at + static_cast<std::ptrdiff_t>(own.count), static_cast<std::uint32_t>(own.first));
  part.numbers = std::move(ghosts);
  part.file = source.read(part.numbers);
  return part;
}

ModelPart loose_part(const PatchSource& source, SetRange own) { return part_with(source, own, {}); }

template <typename T>
ModelPart joined_part(const PatchSource& source, SetRange own) {
  Neighbourhood<T> around(source, own);
  around.find();
  std::vector<ModelPart::Lent> lent = around.lent();
  around.grow();
  ModelPart part = part_with(source, own, around.ghosts());
  while (around.grow_around(entangled<T>(part.file, part.numbers, around))) {
    part = part_with(source, own, around.ghosts());
  }
  part.lent = std::move(lent);
  return part;
}

template ModelPart joined_part<float>(const PatchSource&, SetRange);
template ModelPart joined_part<double>(const PatchSource&, SetRange);

} // namespace simdbezier::tools
