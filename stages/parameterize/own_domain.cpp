// Triangles are paired over their flattest edges first; a box has no choice, as its diagonals are the only flat ones.
// Then colours alternate along the sides of quadrangles, and corners of three quadrangles become domain triangles.
#include "stages/parameterize/own_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "formats/domain/distortion.h"
#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

namespace {

/// Cosine of the angle between the two triangles of a quadrangle: five degrees.
constexpr double kNearlyFlat = 0.9962;
/// Triangles around a domain vertex (see "Valence" in docs/parameterization.md).
constexpr int kFewest = 3;
constexpr int kMost = 10;

using Quad = std::array<VertexId, 4>;  ///< corners, counter-clockwise

Vec3d scaled_normal(const SourceMesh& mesh, TriangleId t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d p(mesh.positions[a]);
  return (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p);
}

bool is_convex(const SourceMesh& mesh, const Quad& quad, const Vec3d& normal) {
  constexpr double kLeastSine = 1e-3;
  for (int c = 0; c < 4; ++c) {
    const Vec3d here(mesh.positions[quad[c]]);
    const Vec3d in = here - Vec3d(mesh.positions[quad[(c + 3) % 4]]);
    const Vec3d out = Vec3d(mesh.positions[quad[(c + 1) % 4]]) - here;
    if (!(in.cross(out).dot(normal) > kLeastSine * in.length() * out.length())) return false;
  }
  return true;
}

/// The quadrangles that the triangles pair up into; nothing where one is left over, bent or not convex.
std::optional<std::vector<Quad>> pair_triangles(const SourceMesh& mesh, const HalfedgeMesh& halfedges) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Vec3d> normals(count);
  for (std::size_t t = 0; t < count; ++t) {
    normals[t] = scaled_normal(mesh, static_cast<TriangleId>(t));
    if (!(normals[t].length() > 0)) return std::nullopt;
    normals[t].normalize();
  }
  std::vector<std::pair<double, Halfedge>> flat;
  for (Halfedge h = 0; h < static_cast<Halfedge>(3 * count); ++h) {
    const Halfedge twin = halfedges.twins[h];
    if (twin < 0) return std::nullopt;
    const double cosine = normals[h / 3].dot(normals[twin / 3]);
    if (twin > h && cosine > kNearlyFlat) flat.emplace_back(-cosine, h);
  }
  std::sort(flat.begin(), flat.end());
  std::vector<char> taken(count, 0);
  std::vector<Quad> quads;
  for (const auto& [order, h] : flat) {
    const Halfedge twin = halfedges.twins[h];
    if (taken[h / 3] || taken[twin / 3]) continue;
    taken[h / 3] = taken[twin / 3] = 1;
    quads.push_back({halfedges.start(h), halfedges.opposite(twin), halfedges.end(h), halfedges.opposite(h)});
    if (!is_convex(mesh, quads.back(), (normals[h / 3] + normals[twin / 3]).normalized())) return std::nullopt;
  }
  if (2 * quads.size() != count) return std::nullopt;
  return quads;
}

/// [vertex] 0 or 1, alternating along the quadrangles' sides, 0 for the first vertex; nothing where that can't be.
std::optional<std::vector<int>> two_colours(const std::vector<Quad>& quads, std::size_t vertices) {
  std::vector<std::vector<VertexId>> beside(vertices);
  for (const Quad& quad : quads) {
    for (int c = 0; c < 4; ++c) beside[quad[c]].push_back(quad[(c + 1) % 4]);
  }
  std::vector<int> colour(vertices, -1);
  std::vector<VertexId> waiting{0};
  colour[0] = 0;
  while (!waiting.empty()) {
    const VertexId v = waiting.back();
    waiting.pop_back();
    for (const VertexId w : beside[v]) {
      if (colour[w] < 0) {
        colour[w] = 1 - colour[v];
        waiting.push_back(w);
      } else if (colour[w] == colour[v]) {
        return std::nullopt;
      }
    }
  }
  return colour;
}

/// The corners of the domain's triangles, whose barycentres are the vertices of one colour.
struct Faces {
  std::vector<VertexId> barycentres;
  std::vector<std::array<VertexId, 3>> corners;
};

/// Nothing where other than three quadrangles touch one of the colour, or too few or too many one of the other.
std::optional<Faces> faces_around(const std::vector<Quad>& quads, const std::vector<int>& colour, int barycentre) {
  std::vector<std::vector<std::pair<VertexId, VertexId>>> sides(colour.size());  // of its quads: before, after it
  for (const Quad& quad : quads) {
    for (int c = 0; c < 4; ++c) sides[quad[c]].emplace_back(quad[(c + 3) % 4], quad[(c + 1) % 4]);
  }
  Faces faces;
  for (VertexId v = 0; v < static_cast<VertexId>(colour.size()); ++v) {
    const auto count = static_cast<int>(sides[v].size());
    if (colour[v] != barycentre) {
      if (count < kFewest || count > kMost) return std::nullopt;
      continue;
    }
    if (count != 3) return std::nullopt;
    // Counter-clockwise, the next quadrangle leaves along the side by which this one came.
    std::array<VertexId, 3> corners{sides[v][0].second, sides[v][0].first, -1};
    for (const auto& [before, after] : sides[v]) {
      if (after == corners[1]) corners[2] = before;
    }
    if (corners[2] < 0 || corners[2] == corners[0]) return std::nullopt;
    faces.barycentres.push_back(v);
    faces.corners.push_back(corners);
  }
  return faces;
}

/// Two triangles that share two sides are no domain, nor two sides in one direction.
bool has_repeated_side(const Faces& faces) {
  std::vector<std::array<VertexId, 2>> sides;
  for (const auto& corners : faces.corners) {
    for (int c = 0; c < 3; ++c) sides.push_back({corners[c], corners[(c + 1) % 3]});
  }
  std::sort(sides.begin(), sides.end());
  return std::adjacent_find(sides.begin(), sides.end()) != sides.end();
}

std::optional<Parameterization> map_onto(const SourceMesh& mesh, const Faces& faces) {
  if (has_repeated_side(faces)) return std::nullopt;
  std::vector<DomainVertex> number(mesh.positions.size(), -1);
  DomainVertex count = 0;
  std::vector<std::array<DomainVertex, 3>> corners = faces.corners;
  for (auto& triangle : corners) {
    for (DomainVertex& n : triangle) {
      if (number[n] < 0) number[n] = count++;
      n = number[n];
    }
  }
  Parameterization map{make_domain(corners, count), std::vector<DomainPoint>(mesh.positions.size())};
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    map.phi[faces.barycentres[t]] = make_point(t, 1.0 / 3, 1.0 / 3);
    for (int c = 0; c < 3; ++c) map.phi[faces.corners[t][c]] = corner_point({t, c});
  }
  const Distortion distortion = measure_distortion(mesh, map);
  if (find_defect(map.domain) || distortion.folded_triangles > 0 || distortion.area_sum_error > 0) return std::nullopt;
  return map;
}

}  // namespace

Parameterization map_to_itself(const SourceMesh& mesh) {
  Parameterization map;
  map.domain = make_domain(mesh.triangles, static_cast<DomainVertex>(mesh.positions.size()));
  map.phi.resize(mesh.positions.size());
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int c = 0; c < 3; ++c) map.phi[map.domain.corner(t, c)] = corner_point({t, c});
  }
  return map;
}

std::optional<Parameterization> map_to_its_faces(const SourceMesh& mesh) {
  constexpr std::size_t kFewestTriangles = 12;  // of a box
  constexpr std::size_t kMostTriangles = 600;   // 200 domain triangles
  const std::size_t count = mesh.triangles.size();
  if (count < kFewestTriangles || count > kMostTriangles || count % 2 != 0) return std::nullopt;
  const HalfedgeMesh halfedges = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
  const auto quads = pair_triangles(mesh, halfedges);
  if (!quads) return std::nullopt;
  const auto colour = two_colours(*quads, mesh.positions.size());
  if (!colour) return std::nullopt;
  // The first vertex on the domain's, where both kinds would do.
  for (const int barycentre : {1, 0}) {
    const auto faces = faces_around(*quads, *colour, barycentre);
    if (!faces) continue;
    if (auto map = map_onto(mesh, *faces)) return map;
  }
  return std::nullopt;
}

}  // namespace lozenge
