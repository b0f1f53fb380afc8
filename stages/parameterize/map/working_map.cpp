// A trivial map is its own mesh: frames, pins and charts follow from the numbers of corners. A finished map is taken in
// by developing each source triangle's exact image and looking for the short way from there to each corner's home.
#include "stages/parameterize/map/working_map.h"

#include <optional>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/domain/development.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/pins.h"

namespace lozenge {

namespace {

/// The chart of a corner of an exact image: the motion, along some short way from the frame of the image to the
/// corner's home, that takes the point to where the image has it.
std::optional<UnitMotion> chart_of_image(const Domain& domain, const DomainPoint& p, DomainTriangleId frame,
                                         LatticePoint image) {
  struct NearbyFrame {
    DomainTriangleId triangle;
    LatticeMotion motion;
  };
  constexpr int kDepth = 4;
  std::vector<NearbyFrame> reached{{frame, {}}};
  for (std::size_t first = 0, depth = 0; depth <= kDepth; ++depth) {
    const std::size_t last = reached.size();
    for (; first < last; ++first) {
      const NearbyFrame here = reached[first];
      if (here.triangle == p.triangle && here.motion(lattice_point(p)) == image) {
        const auto steps = [](std::int64_t x) { return static_cast<std::int16_t>(x / kLatticeOne); };
        return UnitMotion{static_cast<std::int16_t>(here.motion.sixths),
                          {steps(here.motion.shift.u), steps(here.motion.shift.v)}};
      }
      for (int s = 0; s < 3; ++s) {
        const DomainSide n = domain.neighbour({here.triangle, s});
        if (n.exists()) reached.push_back({n.triangle, composed(here.motion, transition(s, n.side))});
      }
    }
  }
  return std::nullopt;
}

}  // namespace

void measure_rest_shapes(WorkingMap& map) {
  const std::size_t count = map.mesh.triangles.size();
  map.surface_area = sum_of_parts(count, [&](std::size_t begin, std::size_t end) {
    double area = 0;
    for (std::size_t t = begin; t < end; ++t) {
      if (map.mesh.triangles[t][0] >= 0) area += triangle_area(*map.positions, map.mesh.triangles[t]);
    }
    return area;
  });
  map.rest.resize(count);
  for_each_part(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& corners = map.mesh.triangles[t];
      if (corners[0] >= 0) map.rest[t] = rest_shape(*map.positions, corners, map.surface_area, map.flattest);
    }
  });
}

void put_vertices_nowhere(WorkingMap& map) {
  const std::size_t vertices = map.mesh.outgoing.size();
  map.home.assign(vertices, -1);
  map.at.assign(vertices, Vec2d(0, 0));
  map.pin.assign(vertices, -1);
  map.next_in.assign(vertices, -1);
  map.last_in.assign(vertices, -1);
}

WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh, const MapSettings& settings) {
  WorkingMap map;
  map.settings() = settings;
  map.positions = &positions;
  map.mesh = std::move(mesh);
  measure_rest_shapes(map);
  put_vertices_nowhere(map);
  const std::size_t vertices = map.home.size();

  // Domain triangles and vertices are numbered without the gaps that removed source triangles leave.
  std::vector<DomainTriangleId> number(map.mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (map.mesh.triangles[t][0] >= 0) number[t] = map.domain_faces++;
  }
  std::vector<DomainVertex> vertex_number(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (map.mesh.outgoing[v] >= 0) vertex_number[v] = map.domain.vertex_count++;
  }
  map.domain.triangles.resize(map.domain_faces);
  map.first_in.assign(map.domain_faces, -1);
  map.corner_of.assign(map.domain.vertex_count, {});
  map.anchor.assign(map.domain.vertex_count, -1);
  map.kept.assign(map.domain.vertex_count, 0);
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (number[t] < 0) continue;
    DomainTriangle& d = map.domain.triangles[number[t]];
    for (int s = 0; s < 3; ++s) {
      d.corners[s] = vertex_number[map.mesh.triangles[t][s]];
      map.corner_of[d.corners[s]] = {number[t], s};
      const Halfedge twin = map.mesh.twins[3 * t + s];
      if (twin >= 0) d.neighbours[s] = {number[twin / 3], twin % 3};
    }
  }
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    if (vertex_number[v] >= 0) pin_to(map, v, vertex_number[v]);
  }
  map.chart.resize(map.mesh.twins.size());
  for (std::size_t t = 0; t < number.size(); ++t) {
    for (int s = 0; s < 3 && number[t] >= 0; ++s) {
      const DomainVertex n = vertex_number[map.mesh.triangles[t][s]];
      map.chart[3 * t + s] = chart_of_pinned(map.corner_of[n].corner, corner_step(s));
    }
  }
  return map;
}

WorkingMap working_map(const SourceMesh& mesh, const Parameterization& finished_map) {
  WorkingMap map;
  map.positions = &mesh.positions;
  const std::size_t vertices = mesh.positions.size();
  map.mesh = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(vertices));
  measure_rest_shapes(map);
  map.domain = finished_map.domain;
  map.domain_faces = map.domain.size();
  map.corner_of = corner_of_each_vertex(map.domain);
  map.anchor.assign(map.corner_of.size(), -1);
  map.kept.assign(map.corner_of.size(), 0);
  map.first_in.assign(map.domain.triangles.size(), -1);
  put_vertices_nowhere(map);
  for (VertexId v = 0; v < static_cast<VertexId>(vertices); ++v) {
    const DomainPoint& p = finished_map.phi[v];
    if (const DomainVertex corner = vertex_at(map.domain, p); corner >= 0) pin_to(map, v, corner);
    else set_home(map, v, p.triangle, at_barycentrics(p.beta, p.gamma()));
  }
  map.chart.resize(map.mesh.twins.size());
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    const auto image = image_of(mesh, finished_map, t);
    for (int c = 0; c < 3 && image; ++c) {
      const VertexId v = map.mesh.triangles[t][c];
      if (map.pin[v] >= 0) {
        const LatticePoint p = image->corners[c];
        const UnitPoint step{static_cast<std::int16_t>(p.u / kLatticeOne),
                             static_cast<std::int16_t>(p.v / kLatticeOne)};
        map.chart[3 * t + c] = chart_of_pinned(map.corner_of[map.pin[v]].corner, step);
      } else if (const auto chart = chart_of_image(map.domain, finished_map.phi[v], image->home, image->corners[c])) {
        map.chart[3 * t + c] = *chart;
      }
    }
  }
  return map;
}

}  // namespace lozenge
