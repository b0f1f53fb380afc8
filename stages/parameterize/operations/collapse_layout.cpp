// Before the side vanishes, both of its ends are points of the new star's polygon, each amid the rim's corners that it
// was joined to, so that the domain triangles of both fans, and the two at the side, tile the polygon. Each is mapped
// into it linearly.
#include "stages/parameterize/operations/collapse_layout.h"

#include <algorithm>
#include <array>

#include "stages/parameterize/relax/wedge.h"

namespace lozenge {

namespace {

/// Weights of an equilateral triangle of unit sides, as a rest shape.
RestShape equilateral() {
  RestShape rest;
  rest.weight.fill(2.0F / 3.0F);
  rest.inverse_area = static_cast<float>(1 / kHalfRoot3);
  rest.share = 1;
  return rest;
}

/// The mean of the rim's corners around one end.
Vec2d mean_of_rim(const Fans& fans, bool of_a) {
  const StarPolygon polygon = fans.polygon();
  Vec2d sum(0, 0);
  int count = 0;
  for (int m = 0; m < fans.count(); ++m) {
    if (fans.slices[m].of_a != of_a) continue;
    const bool continues = m > 0 && fans.slices[m - 1].of_a == of_a;
    for (int i = continues ? m + 1 : m; i <= m + 1; ++i, ++count) sum += polygon.corner(i);
  }
  return count > 0 ? sum / count : Vec2d(0, 0);
}

/// Both ends on their own side of the chord between the two rim corners that they share: no triangle is folded.
StarEnds first_guess(const Fans& fans) {
  const StarPolygon polygon = fans.polygon();
  StarEnds ends{mean_of_rim(fans, true), mean_of_rim(fans, false)};
  // What lies on the boundary lies on the diameter, below the other end.
  if (fans.a_on_boundary) ends.a = {fans.b_on_boundary ? ends.a.x : ends.b.x, 0};
  if (fans.b_on_boundary) ends.b = {fans.a_on_boundary ? ends.b.x : ends.a.x, 0};
  const auto between_chord_and = [&](const Vec2d& other) {
    return (polygon.corner(fans.shared_of_a.before) + polygon.corner(fans.shared_of_a.behind) + other) / 3;
  };
  if (count_slices(fans, true) == 1 && !fans.a_on_boundary) ends.a = between_chord_and(ends.b);
  if (count_slices(fans, false) == 1 && !fans.b_on_boundary) ends.b = between_chord_and(ends.a);
  return ends;
}

}  // namespace

StarEnds place_ends(const Energy& energy, const Fans& fans) {
  constexpr int kRounds = 8;  // two points in a plane: Newton's steps settle them in a few
  const StarPolygon polygon = fans.polygon();
  const RestShape rest = equilateral();
  StarEnds ends = first_guess(fans);
  Wedges wedges;
  const auto improve = [&](bool of_a) {
    Vec2d& mine = of_a ? ends.a : ends.b;
    const Vec2d& other = of_a ? ends.b : ends.a;
    const Fans::Shared& shared = of_a ? fans.shared_of_a : fans.shared_of_b;
    wedges.start(1);
    for (int m = 0; m < fans.count(); ++m) {
      if (fans.slices[m].of_a == of_a) wedges.add(rest, 0, polygon.corner(m) - mine, polygon.corner(m + 1) - mine);
    }
    if (shared.behind >= 0) {
      wedges.add(rest, 0, polygon.corner(shared.behind) - mine, other - mine);
    }
    if (shared.before >= 0) {
      wedges.add(rest, 0, other - mine, polygon.corner(shared.before) - mine);
    }
    wedges.close();
    const bool slides = of_a ? fans.a_on_boundary : fans.b_on_boundary;
    const NewtonStep newton = slides ? newton_step_along(energy, wedges, {1, 0}) : newton_step(energy, wedges);
    if (energy_at(energy, wedges, newton.step) < newton.energy) mine += newton.step;
  };
  for (int round = 0; round < kRounds; ++round) {
    improve(true);
    improve(false);
  }
  return ends;
}

StarLayout lay_out_fans(const WorkingMap& map, const Fans& fans, const StarEnds& ends) {
  const StarPolygon polygon = fans.polygon();
  StarLayout layout;
  const auto add = [&](DomainTriangleId t, const std::array<Vec2d, 3>& corners) {
    for (VertexId v = map.first_in[t]; v >= 0; v = map.next_in[v]) {
      if (map.pin[v] >= 0) continue;
      const auto w = barycentrics(map.at[v]);
      layout.add(v, corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2]);
    }
  };
  const auto corners_from = [](int corner, const Vec2d& first, const Vec2d& second, const Vec2d& third) {
    std::array<Vec2d, 3> corners;
    corners[corner] = first;
    corners[(corner + 1) % 3] = second;
    corners[(corner + 2) % 3] = third;
    return corners;
  };
  for (int m = 0; m < fans.count(); ++m) {
    const auto& [c, of_a] = fans.slices[m];
    add(c.triangle, corners_from(c.corner, of_a ? ends.a : ends.b, polygon.corner(m), polygon.corner(m + 1)));
  }
  add(fans.side.triangle, corners_from(fans.side.side, ends.a, ends.b, polygon.corner(fans.shared_of_a.before)));
  if (fans.across.exists()) {
    add(fans.across.triangle, corners_from(fans.across.side, ends.b, ends.a, polygon.corner(fans.shared_of_a.behind)));
  }
  const auto add_anchor = [&](DomainVertex n, const Vec2d& at) {
    if (map.anchor[n] >= 0) layout.add(map.anchor[n], at);
  };
  add_anchor(fans.a, ends.a);
  add_anchor(fans.b, ends.b);
  return layout;
}

Region region_of(const WorkingMap& map, const Fans& fans, const StarLayout& layout) {
  Region region;
  region.moving = layout.vertices;
  region.triangles = vanishing(fans);
  const auto add_rim = [&](const Slice& s, int corner) {
    region.rim.push_back(map.domain.corner(s.corner.triangle, (s.corner.corner + corner) % 3));
  };
  for (const Slice& s : fans.slices) {
    region.triangles.push_back(s.corner.triangle);
    add_rim(s, 1);
  }
  if (fans.on_boundary) add_rim(fans.slices.back(), 2);
  return region;
}

}  // namespace lozenge
