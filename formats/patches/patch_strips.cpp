// The longest run of patches that no strip has yet is found by asking again those that were longest when they were last
// asked: runs only shrink.
#include "formats/patches/patch_strips.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace lozenge {

namespace {

class StripFinder {
 public:
  StripFinder(const PatchLayout& patches, std::int32_t longest)
      : patches_(patches), longest_(longest), taken_(patches.places.size(), false), seen_(patches.places.size(), 0) {}

  std::vector<PatchStrip> run() {
    std::priority_queue<Candidate> candidates;
    for (std::int32_t patch = 0; patch < patches_.size(); ++patch) {
      for (const int entry : {3, 0}) candidates.push(candidate(patch, entry));
    }
    while (!candidates.empty()) {
      const Candidate best = candidates.top();
      candidates.pop();
      if (taken_[best.patch]) continue;
      std::vector<StripCell> cells = run_through(best.patch, best.entry);
      if (static_cast<std::int32_t>(cells.size()) < best.length) {
        candidates.push({static_cast<std::int32_t>(cells.size()), best.patch, best.entry});
        continue;
      }
      for (const StripCell& cell : cells) taken_[cell.patch] = true;
      strips_.push_back({std::move(cells), patches_.first_level(best.patch)});
    }
    return std::move(strips_);
  }

 private:
  struct Candidate {
    std::int32_t length = 0;
    std::int32_t patch = -1;
    int entry = 3;  ///< the side that becomes its left one
    bool operator<(const Candidate& other) const {
      return std::tuple(length, -patch, entry) < std::tuple(other.length, -other.patch, other.entry);
    }
  };

  Candidate candidate(std::int32_t patch, int entry) {
    return {static_cast<std::int32_t>(run_through(patch, entry).size()), patch, entry};
  }

  static int turns_for(int entry) { return (3 - entry + 4) % 4; }
  static int opposite(int side) { return (side + 2) % 4; }

  /// Whether a patch without its right half has a side; it has nothing to go on over.
  bool is_half(std::int32_t patch) const { return !patches_.places[patch].right.exists(); }

  /// The patch across, entered over its side; none where that ends, is in a strip, or in this run.
  PatchSide onward(std::int32_t patch, int exit) const {
    const PatchSide next = patches_.adjacency[patch][exit];
    if (next.patch < 0 || taken_[next.patch] || seen_[next.patch] == stamp_) return {};
    return next;
  }

  /// Patches from this one on, over opposite sides, both ways; the first is the leftmost.
  std::vector<StripCell> run_through(std::int32_t patch, int entry) {
    ++stamp_;
    seen_[patch] = stamp_;
    std::vector<StripCell> right{{patch, turns_for(entry)}};
    std::int32_t count = 1;
    for (PatchSide at{patch, entry}; count < longest_; ++count) {
      // A half patch goes on over no side that lies opposite one it was entered over.
      if (is_half(at.patch) && count > 1) break;
      const PatchSide next = onward(at.patch, opposite(at.side));
      if (next.patch < 0) break;
      right.push_back({next.patch, turns_for(next.side)});
      seen_[next.patch] = stamp_;
      at = next;
    }
    std::vector<StripCell> left;
    for (PatchSide at{patch, opposite(entry)}; count < longest_; ++count) {
      if (is_half(at.patch) && !left.empty()) break;
      const PatchSide next = onward(at.patch, opposite(at.side));
      if (next.patch < 0) break;
      // What is entered over a side on its right has the opposite one on its left.
      left.push_back({next.patch, turns_for(opposite(next.side))});
      seen_[next.patch] = stamp_;
      at = next;
    }
    std::reverse(left.begin(), left.end());
    left.insert(left.end(), right.begin(), right.end());
    return left;
  }

  const PatchLayout& patches_;
  std::int32_t longest_;
  std::vector<bool> taken_;
  std::vector<std::int64_t> seen_;  ///< [patch] the last run that it was in
  std::int64_t stamp_ = 0;
  std::vector<PatchStrip> strips_;
};

Vec2d turned(Vec2d place, int quarters) {
  for (int i = 0; i < quarters; ++i) place = {1 - place.y, place.x};
  return place;
}

}  // namespace

std::vector<PatchStrip> patch_strips(const PatchLayout& patches, std::int32_t longest) {
  return StripFinder(patches, std::max(longest, 1)).run();
}

void join_into_strips(ChartedSurface& surface, const std::vector<PatchStrip>& strips) {
  struct Where {
    std::int32_t strip = -1;
    std::int32_t cell = 0;
    int turns = 0;
  };
  std::unordered_map<std::int32_t, Where> where;  // [patch]
  for (std::size_t s = 0; s < strips.size(); ++s) {
    for (std::int32_t c = 0; c < strips[s].length(); ++c) {
      where[strips[s].cells[c].patch] = {static_cast<std::int32_t>(s), c, strips[s].cells[c].turns};
    }
  }
  struct Known {
    std::int32_t strip;
    Vec2d place;
  };
  std::vector<std::vector<Known>> known(surface.positions.size());
  for (ChartedTriangle& t : surface.triangles) {
    const Where& here = where.at(t.patch);
    t.patch = here.strip;
    for (ChartedCorner& corner : t.corners) {
      corner.place = turned(corner.place, here.turns) + Vec2d(here.cell, 0);
      constexpr double kSame = 1e-7;  // sides of a patch; the same point in another patch's numbers
      auto& places = known[corner.vertex];
      const auto at = std::find_if(places.begin(), places.end(), [&](const Known& k) {
        return k.strip == t.patch && (k.place - corner.place).length() < kSame;
      });
      if (at != places.end()) corner.place = at->place;
      else places.push_back({t.patch, corner.place});
    }
  }
}

}  // namespace lozenge
