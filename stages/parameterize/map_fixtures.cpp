#include "stages/parameterize/map_fixtures.h"

#include <gtest/gtest.h>

#include "formats/domain/distortion.h"
#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/consistency.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/search/decimation.h"

namespace lozenge::test {

void expect_sound_domain(const WorkingMap& map) {
  const Domain domain = finished(map).domain;
  EXPECT_EQ(domain.size(), map.domain_faces);
  EXPECT_EQ(find_defect(domain), std::nullopt);
}

namespace {

/// A vertex lies on the domain's boundary where the surface has one there, and only then.
void expect_boundary_on_boundary(const WorkingMap& map, VertexId v) {
  if (map.pin[v] >= 0) {
    EXPECT_EQ(valence(map, map.pin[v]).on_boundary, map.mesh.on_boundary(v)) << "vertex " << v;
  } else if (map.mesh.on_boundary(v)) {
    const BoundaryPlace place = boundary_place(map, v);
    ASSERT_GE(place.side.side, 0) << "vertex " << v;
    EXPECT_LT((position_of(place) - map.at[v]).length(), 1e-9) << "vertex " << v;
    EXPECT_GE(place.along, -1e-9);
    EXPECT_LE(place.along, 1 + 1e-9);
  }
}

}  // namespace

void expect_sound(const WorkingMap& map) {
  expect_sound_domain(map);
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    if (map.mesh.outgoing[v] < 0) continue;
    ASSERT_TRUE(is_sound(map, v)) << "vertex " << v;
    expect_boundary_on_boundary(map, v);
  }
  double area = 0;
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    if (map.mesh.removed(t)) continue;
    EXPECT_TRUE(agrees_with_domain(map, t)) << "triangle " << t;
    area += doubled_image_area(map, t);
  }
  EXPECT_NEAR(area / (map.domain_faces * kHalfRoot3), 1, 1e-9);
}

void expect_whole(const WorkingMap& map, const SourceMesh& mesh) {
  expect_sound(map);
  const Distortion d = measure_distortion(mesh, finished(map));
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
}

WorkingMap decimated_map(const SourceMesh& mesh, int faces, std::vector<Removal>* removals) {
  HalfedgeMesh proxy = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
  std::vector<Removal> removed;
  if (removals) removed = simplify(proxy, mesh.positions, 20 * faces);
  WorkingMap map = trivial_map(mesh.positions, std::move(proxy));
  DecimationOptions options;
  options.min_faces = options.max_faces = faces;
  options.mesh_size.triangles_per_face = removals ? 20 : 0;
  decimate(map, options, removed, {});
  if (removals) {
    *removals = std::move(removed);
  } else {
    EXPECT_TRUE(removed.empty());
  }
  return map;
}

}  // namespace lozenge::test
