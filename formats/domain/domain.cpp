// A domain is its adjacency: all walks go from side to neighbouring side, and a fan around a vertex is turned through
// until it closes or the surface ends.
#include "formats/domain/domain.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "formats/base/error.h"

namespace lozenge {

namespace {

std::string name(DomainSide s) {
  return "side " + std::to_string(s.side) + " of domain triangle " + std::to_string(s.triangle);
}

/// The neighbour's id, side and corners fit together with ours.
std::optional<std::string> find_side_defect(const Domain& d, DomainSide s) {
  const DomainSide n = d.neighbour(s);
  if (!n.exists()) return std::nullopt;
  if (n.triangle >= d.size() || n.side < 0 || n.side > 2) return name(s) + " has a neighbour that does not exist";
  if (n == s) return name(s) + " is its own neighbour";
  if (!(d.neighbour(n) == s)) return name(s) + " has a neighbour that does not know it";
  if (d.start(s) != d.end(n) || d.end(s) != d.start(n)) return name(s) + " and its neighbour run between other corners";
  return std::nullopt;
}

}  // namespace

Domain make_domain(const std::vector<std::array<DomainVertex, 3>>& corners, DomainVertex vertex_count) {
  Domain domain;
  domain.vertex_count = vertex_count;
  domain.triangles.resize(corners.size());
  std::unordered_map<std::uint64_t, DomainSide> sides;
  sides.reserve(corners.size() * 3);
  const auto key = [](DomainVertex a, DomainVertex b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
  };
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    domain.triangles[t].corners = corners[t];
    for (int s = 0; s < 3; ++s) {
      const auto [at, fresh] = sides.emplace(key(corners[t][s], corners[t][(s + 1) % 3]), DomainSide{t, s});
      if (!fresh) {
        throw Error(ExitCode::kUnsupported, name({t, s}) + " runs in the same direction as " + name(at->second) +
                                                "; the surface is not an oriented manifold there");
      }
    }
  }
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const auto other = sides.find(key(corners[t][(s + 1) % 3], corners[t][s]));
      if (other != sides.end()) domain.triangles[t].neighbours[s] = other->second;
    }
  }
  return domain;
}

std::optional<std::string> find_defect(const Domain& domain) {
  std::vector<std::int32_t> shared(static_cast<std::size_t>(std::max(domain.vertex_count, 0)), 0);
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const DomainVertex v = domain.corner(t, s);
      if (v < 0 || v >= domain.vertex_count) return "domain triangle " + std::to_string(t) + " has no such corner";
      if (v == domain.corner(t, (s + 1) % 3)) return name({t, s}) + " joins a vertex to itself";
      ++shared[v];
    }
  }
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      if (auto defect = find_side_defect(domain, {t, s})) return defect;
    }
  }
  const std::vector<DomainCorner> first = corner_of_each_vertex(domain);
  for (DomainVertex v = 0; v < domain.vertex_count; ++v) {
    if (shared[v] == 0) return "domain vertex " + std::to_string(v) + " belongs to no triangle";
    if (static_cast<std::int32_t>(corners_around(domain, first[v]).size()) != shared[v]) {
      return "the triangles around domain vertex " + std::to_string(v) + " form more than one fan";
    }
  }
  return std::nullopt;
}

DomainCorner next_around(const Domain& domain, DomainCorner c) {
  // Counter-clockwise around corner c, the next triangle lies across the side that ends in c.
  const DomainSide n = domain.neighbour({c.triangle, (c.corner + 2) % 3});
  if (!n.exists()) return {};
  return {n.triangle, n.side};
}

DomainCorner previous_around(const Domain& domain, DomainCorner c) {
  const DomainSide n = domain.neighbour({c.triangle, c.corner});
  if (!n.exists()) return {};
  return {n.triangle, (n.side + 1) % 3};
}

std::vector<DomainCorner> corner_of_each_vertex(const Domain& domain) {
  std::vector<DomainCorner> corner(static_cast<std::size_t>(domain.vertex_count));
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      DomainCorner& seen = corner[domain.corner(t, c)];
      const bool starts_a_fan = !domain.neighbour({t, c}).exists();
      if (seen.triangle < 0 || starts_a_fan) seen = {t, c};
    }
  }
  return corner;
}

std::vector<DomainCorner> corners_around(const Domain& domain, DomainCorner first) {
  std::vector<DomainCorner> around;
  const std::size_t most = domain.triangles.size();  // a broken domain must not turn forever
  for (DomainCorner c = first; c.triangle >= 0 && around.size() <= most; c = next_around(domain, c)) {
    if (!around.empty() && c == first) break;
    around.push_back(c);
  }
  return around;
}

std::vector<std::int32_t> valences(const Domain& domain) {
  std::vector<std::int32_t> valence(static_cast<std::size_t>(domain.vertex_count), 0);
  for (const DomainTriangle& t : domain.triangles) {
    for (const DomainVertex v : t.corners) ++valence[v];
  }
  return valence;
}

std::vector<DomainSide> edges(const Domain& domain) {
  std::vector<DomainSide> found;
  found.reserve(domain.triangles.size() * 3 / 2);
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const DomainSide n = domain.neighbour({t, s});
      if (!n.exists() || 3 * t + s < 3 * n.triangle + n.side) found.push_back({t, s});
    }
  }
  return found;
}

std::int32_t euler_characteristic(const Domain& domain) {
  return domain.vertex_count - static_cast<std::int32_t>(edges(domain).size()) + domain.size();
}

std::int32_t count_irregular(const Domain& domain) {
  const std::vector<std::int32_t> valence = valences(domain);
  std::vector<bool> on_boundary(valence.size(), false);
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      if (domain.neighbour({t, s}).exists()) continue;
      on_boundary[domain.start({t, s})] = true;
      on_boundary[domain.end({t, s})] = true;
    }
  }
  std::int32_t irregular = 0;
  for (std::size_t v = 0; v < valence.size(); ++v) irregular += valence[v] != (on_boundary[v] ? 3 : 6);
  return irregular;
}

}  // namespace lozenge
