#include "formats/patches/edge_cuts.h"

#include <algorithm>

namespace lozenge {

namespace {

std::vector<double> shares_of_cuts(const ImageLayout& layout, LatticePoint p, LatticePoint q) {
  std::vector<double> shares;
  for (const Spoke& spoke : spokes_below(layout)) {
    if (const auto share = crossing(spoke, p, q)) shares.push_back(*share);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

}  // namespace

void EdgeCuts::add(const ImageLayout& layout) {
  const auto& corners = mesh_.triangles[layout.source];
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const Edge edge = edge_of(corners[c], corners[next]);
    const auto [entry, is_new] = cuts_.try_emplace(edge);
    if (!is_new) continue;
    const bool forward = corners[c] == edge[0];
    const LatticePoint p = layout.image.corners[forward ? c : next];
    const LatticePoint q = layout.image.corners[forward ? next : c];
    const double length = (in_sides(q) - in_sides(p)).length();
    entry->second = add_cuts(edge, shares_of_cuts(layout, p, q), layout.together / length);
  }
}

/// Cuts in one place are one, and one in a vertex is none.
CutsOfEdge EdgeCuts::add_cuts(const Edge& edge, const std::vector<double>& shares, double together) {
  CutsOfEdge cuts{static_cast<std::int32_t>(points_.size()), 0};
  double last = 0;
  for (const double share : shares) {
    if (share - last <= together || 1 - share <= together) continue;
    points_.push_back({edge, share});
    ++cuts.count;
    last = share;
  }
  return cuts;
}

}  // namespace lozenge
