// Parts are found by joining the corners of every triangle.
#include "stages/parameterize/parts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "formats/surface/attribute_streams.h"
#include "stages/parameterize/certify.h"

namespace lozenge {

namespace {

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

/// What there is one of for a whole surface. There may be thousands of parts, and as many materials.
void name_like(SourceMesh& mesh, const SourceMesh& other) {
  mesh.material_names = other.material_names;
  mesh.material_looks = other.material_looks;
  mesh.images = other.images;
  mesh.cap_of = other.cap_of;
  mesh.double_sided = other.double_sided;
  mesh.translation = other.translation;
  mesh.bodies = other.bodies;
  mesh.scene_name = other.scene_name;
  mesh.origin = other.origin;
  mesh.generator = other.generator;
}

void append(SourceMesh& whole, const SourceMesh& part) {
  const auto first_vertex = static_cast<VertexId>(whole.positions.size());
  join(whole.corner_attributes, 3 * whole.triangles.size(), part.corner_attributes, 3 * part.triangles.size());
  for (const auto& t : part.triangles) {
    whole.triangles.push_back({t[0] + first_vertex, t[1] + first_vertex, t[2] + first_vertex});
  }
  append(whole.positions, part.positions);
  append(whole.materials, part.materials);
}

void append(Domain& whole, const Domain& part) {
  const DomainTriangleId first_triangle = whole.size();
  for (DomainTriangle t : part.triangles) {
    for (DomainVertex& n : t.corners) n += whole.vertex_count;
    for (DomainSide& side : t.neighbours) {
      if (side.exists()) side.triangle += first_triangle;
    }
    whole.triangles.push_back(t);
  }
  whole.vertex_count += part.vertex_count;
}

/// The numbers of the parts, by ascending first level.
std::vector<std::size_t> by_first_level(const std::vector<MappedPart>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].first_level < parts[b].first_level; });
  return order;
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
    part.mesh.origin = mesh.origin;
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

MappedPart join_parts(std::vector<MappedPart> parts, const SourceMesh& like) {
  MappedPart whole;
  name_like(whole.surface, like);
  const std::vector<std::size_t> order = by_first_level(parts);
  std::vector<DomainTriangleId> first_triangle(parts.size());
  for (const std::size_t p : order) {
    first_triangle[p] = whole.map.domain.size();
    append(whole.map.domain, parts[p].map.domain);
    whole.map.first_levels.resize(whole.map.domain.triangles.size(), parts[p].first_level);
  }
  if (parts[order.back()].first_level == 0) whole.map.first_levels.clear();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    append(whole.surface, parts[p].surface);
    for (DomainPoint point : parts[p].map.phi) {
      point.triangle += first_triangle[p];
      whole.map.phi.push_back(point);
    }
    parts[p] = {};
  }
  make_canonical_with_map(whole.surface, whole.map);
  return whole;
}

}  // namespace lozenge
