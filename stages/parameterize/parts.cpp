// Parts are found by joining the corners of every triangle, and domain triangles shared out by area. Where the largest
// part has the size that is best for all of them, the others follow.
#include "stages/parameterize/parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/surface/attribute_streams.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/map/topology.h"

namespace lozenge {

namespace {

/// Parts of up to so many triangles may map to themselves.
constexpr std::int32_t kTiny = 16;

/// [triangle] the number of the part that it belongs to; parts are numbered in the order of their first triangles.
std::vector<std::int32_t> number_parts(const SourceMesh& mesh) {
  std::vector<VertexId> leader(mesh.positions.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](VertexId v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    for (int c = 1; c < 3; ++c) {
      const VertexId a = find(t[0]);
      const VertexId b = find(t[c]);
      leader[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::int32_t> part_of_leader(mesh.positions.size(), -1);
  std::vector<std::int32_t> part(mesh.triangles.size());
  std::int32_t count = 0;
  for (std::size_t t = 0; t < part.size(); ++t) {
    std::int32_t& p = part_of_leader[find(mesh.triangles[t][0])];
    if (p < 0) p = count++;
    part[t] = p;
  }
  return part;
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void name_like(SourceMesh& mesh, const SourceMesh& other) {
  mesh.material_names = other.material_names;
  mesh.cap_of = other.cap_of;
  mesh.double_sided = other.double_sided;
  mesh.repeats = other.repeats;
  mesh.scene_name = other.scene_name;
  mesh.origin = other.origin;
  mesh.generator = other.generator;
}

}  // namespace

bool is_connected(const SourceMesh& mesh) {
  const std::vector<std::int32_t> part_of = number_parts(mesh);
  return std::all_of(part_of.begin(), part_of.end(), [](std::int32_t part) { return part == 0; });
}

std::vector<Part> split_into_parts(const SourceMesh& mesh) {
  const std::vector<std::int32_t> part_of = number_parts(mesh);
  const auto last = std::max_element(part_of.begin(), part_of.end());
  std::vector<Part> parts(last == part_of.end() ? 0 : static_cast<std::size_t>(*last) + 1);
  for (Part& part : parts) {
    name_like(part.mesh, mesh);
    part.mesh.corner_attributes = empty_like(mesh.corner_attributes);
  }
  std::vector<VertexId> number(mesh.positions.size(), -1);
  for (std::size_t t = 0; t < part_of.size(); ++t) {
    Part& part = parts[part_of[t]];
    auto corners = mesh.triangles[t];
    part.area += triangle_area(mesh.positions, corners);
    for (VertexId& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(part.vertices.size());
        part.vertices.push_back(v);
        part.mesh.positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    part.mesh.triangles.push_back(corners);
    append_triangle(part.mesh.corner_attributes, mesh.corner_attributes, static_cast<TriangleId>(t));
    if (!mesh.materials.empty()) part.mesh.materials.push_back(mesh.materials[t]);
  }
  return parts;
}

MappedPart join_parts(std::vector<MappedPart> parts) {
  MappedPart whole;
  name_like(whole.surface, parts.front().surface);
  SourceMesh& mesh = whole.surface;
  Domain& domain = whole.map.domain;
  for (MappedPart& part : parts) {
    const auto first_vertex = static_cast<VertexId>(mesh.positions.size());
    join(mesh.corner_attributes, 3 * mesh.triangles.size(), part.surface.corner_attributes,
         3 * part.surface.triangles.size());
    for (const auto& t : part.surface.triangles) {
      mesh.triangles.push_back({t[0] + first_vertex, t[1] + first_vertex, t[2] + first_vertex});
    }
    append(mesh.positions, part.surface.positions);
    append(mesh.materials, part.surface.materials);
    const DomainTriangleId first_triangle = domain.size();
    for (DomainTriangle& t : part.map.domain.triangles) {
      for (DomainVertex& n : t.corners) n += domain.vertex_count;
      for (DomainSide& side : t.neighbours) {
        if (side.exists()) side.triangle += first_triangle;
      }
    }
    append(domain.triangles, part.map.domain.triangles);
    domain.vertex_count += part.map.domain.vertex_count;
    for (DomainPoint& p : part.map.phi) p.triangle += first_triangle;
    append(whole.map.phi, part.map.phi);
    part = {};
  }
  make_canonical_with_map(whole.surface, whole.map);
  return whole;
}

Parameterization map_to_itself(const SourceMesh& mesh) {
  Parameterization map;
  map.domain = make_domain(mesh.triangles, static_cast<DomainVertex>(mesh.positions.size()));
  map.phi.resize(mesh.positions.size());
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int c = 0; c < 3; ++c) map.phi[map.domain.corner(t, c)] = corner_point({t, c});
  }
  return map;
}

std::vector<Allotment> allot(const std::vector<Part>& parts, std::int32_t min_faces, std::int32_t max_faces) {
  double area = 0;
  for (const Part& part : parts) area += part.area;
  std::vector<Allotment> shares;
  for (const Part& part : parts) {
    const double share = area > 0 ? part.area / area : 1.0 / static_cast<double>(parts.size());
    const auto count = static_cast<std::int32_t>(part.mesh.triangles.size());
    if (count <= kTiny && share * max_faces < count) {
      shares.push_back({count, count, true});
      continue;
    }
    const HalfedgeMesh halfedges =
        make_halfedge_mesh(part.mesh.triangles, static_cast<std::int32_t>(part.mesh.positions.size()));
    const std::int32_t need = least_domain_faces(topology_of(halfedges));
    const auto low = static_cast<std::int32_t>(std::ceil(share * min_faces));
    const auto high = static_cast<std::int32_t>(std::floor(share * max_faces));
    // A closed surface has an even number of triangles: an interval holds one.
    if (high >= need) shares.push_back({std::max(need, low), std::max(std::max(need, low) + 1, high), false});
    else shares.push_back({need, need + 1, false});
  }
  return shares;
}

namespace {

/// The distortion of areas that comes of triangles that are larger in one part than in another.
/// \param faces  [part] of its domain
double mismatch_of_areas(const std::vector<Part>& parts, const std::vector<double>& faces) {
  double all_faces = 0;
  double area = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    all_faces += faces[p];
    area += parts[p].area;
  }
  double sum = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!(parts[p].area > 0)) continue;
    const double ratio = faces[p] / all_faces * area / parts[p].area;
    sum += parts[p].area / area * ((ratio + 1 / ratio) / 2 - 1);
  }
  return sum;
}

}  // namespace

double weighed_whole(const std::vector<Part>& parts, const std::vector<Allotment>& shares, std::size_t largest,
                     const TraceRow& row) {
  std::vector<double> faces;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double wanted = row.domain_faces * parts[p].area / parts[largest].area;
    const double least = shares[p].min_faces;
    faces.push_back(p == largest ? row.domain_faces
                                 : std::clamp(wanted, least, std::max<double>(least, shares[p].max_faces)));
  }
  const double aggregate = aggregate_of((1 + row.area) * (1 + mismatch_of_areas(parts, faces)), 1 + row.angle);
  return weighed_by_size(aggregate, std::accumulate(faces.begin(), faces.end(), 0.0));
}

}  // namespace lozenge
