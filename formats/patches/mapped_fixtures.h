// Surfaces with maps, closed and open, for tests of whatever is made of both.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"

namespace lozenge::fixtures {

struct MappedSurface {
  std::string name;
  SourceMesh mesh;
  Parameterization map;
};

/// Spheres of cones of three, four and five triangles, n^2 source triangles on each of the domain's for each of
/// `sizes`; with `moved`, each of them once more with its map moved about. Then `open_surfaces`.
inline std::vector<MappedSurface> mapped_surfaces(const std::vector<int>& sizes, bool moved) {
  std::vector<MappedSurface> all;
  for (const auto& [name, domain] : {std::pair{"tetrahedron", tetrahedron()}, std::pair{"octahedron", octahedron()},
                                     std::pair{"icosahedron", icosahedron()}}) {
    for (const int n : sizes) {
      auto [mesh, map] = subdivided_sphere(domain, n);
      all.push_back({name + std::string(" ") + std::to_string(n), mesh, map});
      if (!moved) continue;
      jitter(map, 0.3 / n, static_cast<unsigned>(n));
      all.push_back({name + std::string(" moved ") + std::to_string(n), mesh, map});
    }
  }
  for (OpenSurface& open : open_surfaces()) all.push_back({open.name, open.mesh, open.map});
  return all;
}

}  // namespace lozenge::fixtures
