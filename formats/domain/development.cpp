// A point on a side lies in two triangles, one in a corner in all around it: its closure. The smallest domain that has
// all three closures wins: a triangle, two across a side, the fan around a vertex (Sec. 4.1). A fan is unfolded by
// turning each corner's place by as many sixths as there are slots between, both ways round where it is closed.
#include "formats/domain/development.h"

#include <algorithm>
#include <vector>

namespace lozenge {

namespace {

/// A position seen from one of the triangles that it lies in.
struct Placed {
  DomainTriangleId triangle;
  LatticePoint at;
};
using Closure = std::vector<Placed>;

/// The side that the point lies on, or -1. \pre not a corner
int side_at(const DomainPoint& p) {
  if (p.gamma() == 0) return 0;
  if (p.alpha == 0) return 1;
  if (p.beta == 0) return 2;
  return -1;
}

/// Every closed triangle that the point lies in.
Closure closure_of(const Domain& domain, const DomainPoint& p) {
  Closure closure{{p.triangle, lattice_point(p)}};
  if (const int corner = corner_at(p); corner >= 0) {
    // Clockwise first, for a boundary fan may start before us.
    DomainCorner first{p.triangle, corner};
    for (std::size_t i = 0; i < domain.triangles.size(); ++i) {
      const DomainSide back = domain.neighbour({first.triangle, first.corner});
      if (!back.exists()) break;
      first = {back.triangle, (back.side + 1) % 3};
      if (first.triangle == p.triangle) break;
    }
    closure.clear();
    for (const DomainCorner c : corners_around(domain, first)) {
      closure.push_back({c.triangle, lattice_point(corner_point(c))});
    }
  } else if (const int side = side_at(p); side >= 0) {
    const DomainSide n = domain.neighbour({p.triangle, side});
    if (n.exists()) closure.push_back({n.triangle, inverse(transition(side, n.side))(lattice_point(p))});
  }
  return closure;
}

const Placed* find(const Closure& closure, DomainTriangleId triangle) {
  const auto at = std::find_if(closure.begin(), closure.end(), [&](const Placed& p) { return p.triangle == triangle; });
  return at == closure.end() ? nullptr : &*at;
}

using Closures = std::array<Closure, 3>;

std::optional<Development> develop_in_face(const Closures& points) {
  for (const Placed& p : points[0]) {
    const Placed* q = find(points[1], p.triangle);
    const Placed* r = find(points[2], p.triangle);
    if (q && r) return Development{Span::kFace, p.triangle, {p.at, q->at, r->at}};
  }
  return std::nullopt;
}

LatticeArea squared_length(LatticePoint e) {
  return static_cast<LatticeArea>(e.u) * e.u + static_cast<LatticeArea>(e.u) * e.v +
         static_cast<LatticeArea>(e.v) * e.v;
}

/// How good an unfolding is: positive area first, then short edges.
struct Rank {
  bool positive;
  LatticeArea edges;
  bool better_than(const Rank& other) const { return positive != other.positive ? positive : edges < other.edges; }
};

Rank rank_of(const std::array<LatticePoint, 3>& c) {
  return {doubled_area(c[0], c[1], c[2]) > 0,
          squared_length(c[1] - c[0]) + squared_length(c[2] - c[1]) + squared_length(c[0] - c[2])};
}

std::optional<Development> develop_in_diamond(const Domain& domain, const Closures& points) {
  std::optional<Development> best;
  for (const Placed& p : points[0]) {
    for (int side = 0; side < 3; ++side) {
      const DomainSide n = domain.neighbour({p.triangle, side});
      if (!n.exists()) continue;
      const LatticeMotion across = transition(side, n.side);
      Development result{Span::kDiamond, p.triangle, {p.at, {}, {}}};
      bool complete = true;
      for (int i = 1; i < 3 && complete; ++i) {
        if (const Placed* here = find(points[i], p.triangle)) result.corners[i] = here->at;
        else if (const Placed* there = find(points[i], n.triangle)) result.corners[i] = across(there->at);
        else complete = false;
      }
      if (complete && (!best || rank_of(result.corners).better_than(rank_of(best->corners)))) best = result;
    }
  }
  return best;
}

/// A position in a star: its slot (counter-clockwise number of the triangle) and where it lies in the slot's frame,
/// whose origin is the star's vertex.
struct InStar {
  int slot;
  LatticePoint at;
  bool at_centre() const { return at == LatticePoint{}; }
};

std::optional<InStar> find_in_star(const std::vector<DomainCorner>& star, const Closure& closure) {
  for (std::size_t slot = 0; slot < star.size(); ++slot) {
    if (const Placed* p = find(closure, star[slot].triangle)) {
      return InStar{static_cast<int>(slot), corner_frame(star[slot].corner)(p->at)};
    }
  }
  return std::nullopt;
}

/// Turning from a to b by `slots` sixths (before both places inside their slots are counted) stays below half a turn.
bool below_half_turn(LatticePoint a, LatticePoint b, int slots) {
  if (slots > -3 && slots < 3) return true;
  if (slots < -3 || slots > 3) return false;
  const LatticeArea turn = doubled_area({}, a, b);
  return slots > 0 ? turn > 0 : turn < 0;
}

/// Three places of a star laid out from the slot of one of them.
struct Unfolded {
  std::array<int, 3> turn{};  ///< [corner] slots from there to its own
  std::array<LatticePoint, 3> corners{};
};

/// By how many slots the middle of the corners is away from the slot that they are laid out from, which may touch the
/// image in a side or a point alone.
int slots_to_middle(const Unfolded& image) {
  const LatticePoint three_times = image.corners[0] + image.corners[1] + image.corners[2];
  for (const int slots : {0, 1, -1, 2, -2}) {
    const LatticePoint there = rotated(three_times, -slots);
    if (there.u >= 0 && there.v >= 0) return slots;
  }
  // Three slots either way look the same, but the corners reach as far to one side alone.
  return *std::max_element(image.turn.begin(), image.turn.end()) >= 3 ? 3 : -3;
}

/// Unfolds the star around its vertex; `closed` tells whether slots wrap around.
std::optional<Development> develop_in_star(const std::vector<DomainCorner>& star, bool closed, const Closures& points) {
  std::array<InStar, 3> p{};
  for (int i = 0; i < 3; ++i) {
    const auto found = find_in_star(star, points[i]);
    if (!found) return std::nullopt;
    p[i] = *found;
  }
  int reference = 0;
  while (reference < 2 && p[reference].at_centre()) ++reference;
  const int valence = static_cast<int>(star.size());
  const bool regular = closed && valence == 6;
  std::optional<Unfolded> best;
  for (int choice = 0; choice < (closed ? 4 : 1); ++choice) {
    Unfolded image;
    auto& [turn, corners] = image;
    for (int i = 0; i < 3; ++i) {
      turn[i] = p[i].slot - p[reference].slot;
      if (closed && i != reference) {
        const bool second_way = (choice >> ((i + 2 - reference) % 3 == 0 ? 0 : 1)) & 1;
        turn[i] = ((turn[i] % valence) + valence) % valence - (second_way ? valence : 0);
      }
      corners[i] = rotated(p[i].at, turn[i]);
    }
    bool possible = true;
    for (int i = 0; i < 3 && possible && !regular; ++i) {
      const int j = (i + 1) % 3;
      if (p[i].at_centre() || p[j].at_centre()) continue;
      possible = below_half_turn(corners[i], corners[j], turn[j] - turn[i]);
    }
    if (possible && (!best || rank_of(corners).better_than(rank_of(best->corners)))) best = image;
  }
  if (!best) return std::nullopt;
  const int slots = slots_to_middle(*best);
  const DomainCorner home = star[((p[reference].slot + slots) % valence + valence) % valence];
  const LatticeMotion back = inverse(corner_frame(home.corner));
  Development result{Span::kStar, home.triangle, {}};
  for (int i = 0; i < 3; ++i) result.corners[i] = back(rotated(best->corners[i], -slots));
  return result;
}

/// The whole fan around a corner, from its start where it lies on the boundary.
std::vector<DomainCorner> star_of(const Domain& domain, DomainCorner corner) {
  DomainCorner first = corner;
  for (std::size_t i = 0; i < domain.triangles.size(); ++i) {
    const DomainSide back = domain.neighbour({first.triangle, first.corner});
    if (!back.exists()) break;
    first = {back.triangle, (back.side + 1) % 3};
    if (first == corner) break;
  }
  return corners_around(domain, first);
}

/// One of the triangle's corners has but three triangles around it.
bool touches_valence_three(const Domain& domain, DomainTriangleId triangle) {
  for (int c = 0; c < 3; ++c) {
    const DomainCorner first{triangle, c};
    DomainCorner turned = first;
    for (int i = 0; i < 3 && turned.triangle >= 0; ++i) turned = next_around(domain, turned);
    if (turned == first) return true;
  }
  return false;
}

}  // namespace

int corner_at(const DomainPoint& p) {
  if (p.alpha == 1) return 0;
  if (p.beta == 1) return 1;
  if (p.alpha == 0 && p.beta == 0) return 2;
  return -1;
}

DomainVertex vertex_at(const Domain& domain, const DomainPoint& p) {
  const int corner = corner_at(p);
  return corner < 0 ? -1 : domain.corner(p.triangle, corner);
}

std::optional<Development> develop(const Domain& domain, const std::array<DomainPoint, 3>& p) {
  if (p[0].triangle == p[1].triangle && p[0].triangle == p[2].triangle) {
    return Development{Span::kFace, p[0].triangle, {lattice_point(p[0]), lattice_point(p[1]), lattice_point(p[2])}};
  }
  const Closures points{closure_of(domain, p[0]), closure_of(domain, p[1]), closure_of(domain, p[2])};
  if (auto in_face = develop_in_face(points)) return in_face;
  // Around a vertex of three triangles the diamond may hold all three points on the wrong side of it: a star may do
  // better.
  std::optional<Development> best = develop_in_diamond(domain, points);
  if (best && rank_of(best->corners).positive && !touches_valence_three(domain, best->home)) return best;
  std::vector<DomainVertex> tried;
  for (const Placed& q : points[0]) {
    for (int c = 0; c < 3; ++c) {
      const DomainVertex vertex = domain.corner(q.triangle, c);
      if (std::find(tried.begin(), tried.end(), vertex) != tried.end()) continue;
      tried.push_back(vertex);
      const std::vector<DomainCorner> star = star_of(domain, {q.triangle, c});
      const bool closed = next_around(domain, star.back()) == star.front();
      const auto found = develop_in_star(star, closed, points);
      if (found && (!best || rank_of(found->corners).better_than(rank_of(best->corners)))) best = found;
    }
  }
  return best;
}

}  // namespace lozenge
