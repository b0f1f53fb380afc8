#include "formats/domain/parameterization.h"

#include <array>

#include "formats/domain/first_levels.h"

namespace lozenge {

std::optional<Development> image_of(const SourceMesh& mesh, const Parameterization& map, TriangleId t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return develop(map.domain, {map.phi[a], map.phi[b], map.phi[c]});
}

double scaled_size(const Parameterization& map) {
  if (map.first_levels.empty()) return map.domain.size();
  double size = 0;
  for (const std::int32_t level : map.first_levels) size += area_at_level(level);
  return size;
}

std::vector<std::int64_t> parts_by_first_level(const Parameterization& map) {
  std::vector<char> seen(map.domain.triangles.size(), 0);
  std::vector<std::int64_t> parts;
  std::vector<DomainTriangleId> waiting;
  for (DomainTriangleId first = 0; first < map.domain.size(); ++first) {
    if (seen[first]) continue;
    const auto level = static_cast<std::size_t>(map.first_level(first));
    if (parts.size() <= level) parts.resize(level + 1, 0);
    ++parts[level];
    seen[first] = 1;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const DomainTriangleId t = waiting.back();
      waiting.pop_back();
      for (const DomainSide& side : map.domain.triangles[t].neighbours) {
        if (!side.exists() || seen[side.triangle]) continue;
        seen[side.triangle] = 1;
        waiting.push_back(side.triangle);
      }
    }
  }
  return parts;
}

std::optional<std::string> find_first_level_defect(const Domain& domain,
                                                   const std::vector<std::int32_t>& first_levels) {
  if (first_levels.empty()) return std::nullopt;
  std::vector<std::array<std::int32_t, 2>> touching;
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (const DomainSide& side : domain.triangles[t].neighbours) {
      if (side.exists()) touching.push_back({t, side.triangle});
    }
  }
  return find_first_level_defect(first_levels, domain.triangles.size(), kMostFirstLevel, "domain triangle", touching);
}

}  // namespace lozenge
