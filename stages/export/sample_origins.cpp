// A sample lies where its place on the domain does, but for those that were moved into a corner of the boundary: they
// are looked for along that.
#include "stages/export/sample_origins.h"

#include <algorithm>
#include <limits>
#include <map>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/patch_grids.h"
#include "formats/patches/patch_place.h"
#include "formats/surface/nearest_point.h"

namespace lozenge {

namespace {

class OriginFinder {
 public:
  OriginFinder(const GeometryImage& image, const SourceSurface& source)
      : image_(image), mesh_(*source.mesh), locator_(*source.mesh, *source.map), along_boundary_(find_boundary()) {
    // Samples of different places are told apart by some of their last bits.
    constexpr double kRounding = 1e-5;
    most_off_ = kRounding * diagonal(bounds_of(mesh_.positions));
  }

  SourcePoint at(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    const PatchPlace& place = image_.layout.places[patch];
    const double last = image_.layout.samples_of(patch) - 1;
    const auto found = locator_.find(domain_point_at(place, i / last, j / last));
    if (!found) {
      throw Error(ExitCode::kUnusableInput, mesh_.origin + ": the map leaves a place of patch " +
                                                std::to_string(patch) + " uncovered; parameterize the mesh again");
    }
    const Vec3f& sample = image_.position(0, patch, i, j);
    const bool is_there = Vec3d(position_at(mesh_, *found) - sample).length() <= most_off_;
    return is_there || along_boundary_.empty() ? *found : nearest_on_boundary(Vec3d(sample));
  }

 private:
  /// Triangles with a side that no other one has.
  std::vector<TriangleId> find_boundary() const {
    std::map<std::array<VertexId, 2>, std::pair<TriangleId, int>> sides;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int side = 0; side < 3; ++side) {
        const VertexId a = mesh_.triangles[t][side];
        const VertexId b = mesh_.triangles[t][(side + 1) % 3];
        auto& [triangle, count] = sides[{std::min(a, b), std::max(a, b)}];
        triangle = static_cast<TriangleId>(t);
        ++count;
      }
    }
    std::vector<TriangleId> found;
    for (const auto& [side, use] : sides) {
      if (use.second == 1) found.push_back(use.first);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  SourcePoint nearest_on_boundary(const Vec3d& p) const {
    SourcePoint nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const TriangleId t : along_boundary_) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const std::array<Vec3d, 3> corners{Vec3d(mesh_.positions[a]), Vec3d(mesh_.positions[b]),
                                         Vec3d(mesh_.positions[c])};
      const Vec3d weights = nearest_weights(p, corners);
      const double distance = (point_at(corners, weights) - p).length2();
      if (!(distance < least)) continue;
      least = distance;
      nearest = {t, weights};
    }
    return nearest;
  }

  const GeometryImage& image_;
  const SourceMesh& mesh_;
  DomainLocator locator_;
  std::vector<TriangleId> along_boundary_;
  double most_off_ = 0;
};

}  // namespace

std::vector<SourcePoint> sample_origins(const GeometryImage& image, const SourceSurface& source) {
  const Bodies& bodies = image.layout.bodies;
  const std::vector<Body>& of_source = source.mesh->bodies.bodies;
  if (!source.mesh->bodies.has_targets()) return {};
  const OriginFinder finder(image, source);
  const PatchGrids grids(image.layout, 0);
  std::vector<SourcePoint> origins(grids.size());
  for_each_index(static_cast<std::size_t>(image.size()), true, [&](std::size_t n) {
    const auto patch = static_cast<std::int32_t>(n);
    const std::int32_t body = bodies.owner_of(n);
    const bool has_targets =
        body >= 0 && body < static_cast<std::int32_t>(of_source.size()) && !of_source[body].targets.empty();
    if (!has_targets) return;
    for (std::int32_t j = 0; j < grids.samples(patch); ++j) {
      for (std::int32_t i = 0; i < grids.samples(patch); ++i) {
        if (i > j && !image.layout.places[patch].right.exists()) continue;
        origins[grids.index(patch, i, j)] = finder.at(patch, i, j);
      }
    }
  });
  return origins;
}

}  // namespace lozenge
