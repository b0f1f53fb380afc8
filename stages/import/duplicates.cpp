#include "stages/import/duplicates.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>

#include "stages/import/leave_out.h"

namespace lozenge {

namespace {

/// [triangle] its three vertices in rising order.
std::vector<std::array<VertexId, 3>> sorted_corners(const SourceMesh& mesh) {
  std::vector<std::array<VertexId, 3>> sorted = mesh.triangles;
  for (auto& corners : sorted) std::sort(corners.begin(), corners.end());
  return sorted;
}

/// Which corner of a triangle is at a vertex.
std::size_t corner_at(const SourceMesh& mesh, TriangleId t, VertexId v) {
  const auto& corners = mesh.triangles[t];
  return 3 * static_cast<std::size_t>(t) + (corners[0] == v ? 0U : corners[1] == v ? 1U : 2U);
}

/// Whether two triangles with the same vertices run the same way round.
bool run_alike(const SourceMesh& mesh, TriangleId a, TriangleId b) {
  const auto& first = mesh.triangles[a];
  const auto& other = mesh.triangles[b];
  const auto at = static_cast<std::size_t>(std::find(other.begin(), other.end(), first[0]) - other.begin());
  return other[(at + 1) % 3] == first[1];
}

/// Whether two triangles with the same vertices have the same material, colours and texture coordinates.
bool look_alike(const SourceMesh& mesh, TriangleId a, TriangleId b) {
  if (!mesh.materials.empty() && mesh.materials[a] != mesh.materials[b]) return false;
  for (const AttributeStream& stream : mesh.corner_attributes) {
    if (!(stream.kind == kTextureCoordinates) && !(stream.kind == kColors)) continue;
    for (const VertexId v : mesh.triangles[a]) {
      const float* one = stream.at(corner_at(mesh, a, v));
      if (!std::equal(one, one + stream.kind.components, stream.at(corner_at(mesh, b, v)))) return false;
    }
  }
  return true;
}

struct Verdict {
  std::vector<bool> keep;          ///< [triangle]
  std::vector<bool> is_two_sided;  ///< [triangle]
  std::vector<bool> is_layer;      ///< [triangle] the other way round on another one, and looks otherwise
};

/// \param group  triangles with the same vertices, by their numbers
void judge(const SourceMesh& mesh, std::span<const TriangleId> group, Verdict& verdict, RepairReport& report) {
  const TriangleId first = group.front();
  bool has_layer = false;
  for (const TriangleId t : group.subspan(1)) {
    const Vec3f& where = mesh.positions[mesh.triangles[t][0]];
    verdict.keep[t] = false;
    if (run_alike(mesh, first, t)) {
      report.add(RepairKind::kDuplicateTriangles, where);
    } else if (look_alike(mesh, first, t)) {
      report.add(RepairKind::kTwoSidedTriangles, where);
      verdict.is_two_sided[first] = true;
    } else if (!has_layer) {
      report.add(RepairKind::kLayers, where);
      verdict.keep[t] = has_layer = verdict.is_layer[t] = true;
    } else {
      report.add(RepairKind::kDuplicateTriangles, where);
    }
  }
}

Verdict judge_all(const SourceMesh& mesh, RepairReport& report) {
  const auto corners = sorted_corners(mesh);
  std::vector<TriangleId> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](TriangleId a, TriangleId b) { return corners[a] != corners[b] ? corners[a] < corners[b] : a < b; });
  Verdict verdict{std::vector<bool>(order.size(), true), std::vector<bool>(order.size(), false),
                  std::vector<bool>(order.size(), false)};
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && corners[order[end]] == corners[order[begin]]) ++end;
    if (end - begin > 1) judge(mesh, std::span(order).subspan(begin, end - begin), verdict, report);
    begin = end;
  }
  return verdict;
}

/// Gives layers vertices of their own, at the same places.
void detach(SourceMesh& mesh, const std::vector<bool>& is_layer) {
  std::map<VertexId, VertexId> own;
  for (std::size_t t = 0; t < is_layer.size(); ++t) {
    if (!is_layer[t]) continue;
    for (VertexId& v : mesh.triangles[t]) {
      const auto [place, is_new] = own.try_emplace(v, static_cast<VertexId>(mesh.positions.size()));
      if (is_new) mesh.positions.push_back(Vec3f(mesh.positions[v]));
      v = place->second;
    }
  }
}

/// The same material, to be seen from both sides.
std::int32_t add_two_sided(SourceMesh& mesh, std::int32_t material) {
  mesh.material_names.push_back(std::string(mesh.material_names[material]));
  mesh.double_sided.push_back(true);
  if (!mesh.material_looks.empty()) mesh.material_looks.push_back(Material(mesh.material_looks[material]));
  if (!mesh.cap_of.empty()) mesh.cap_of.push_back(mesh.cap_of[material]);
  if (!mesh.bodies.empty()) mesh.bodies.owner.push_back(mesh.bodies.owner[material]);
  return static_cast<std::int32_t>(mesh.material_names.size()) - 1;
}

void show_from_both_sides(SourceMesh& mesh, const Verdict& verdict) {
  const std::vector<bool>& is_two_sided = verdict.is_two_sided;
  if (std::find(is_two_sided.begin(), is_two_sided.end(), true) == is_two_sided.end()) return;
  if (mesh.materials.empty()) {
    mesh.materials.assign(mesh.triangles.size(), 0);
    if (mesh.material_names.empty()) mesh.material_names = {"default"};
  }
  mesh.double_sided.resize(mesh.material_names.size(), false);
  std::vector<bool> has_others(mesh.material_names.size(), false);  // [material] triangles of one side
  for (std::size_t t = 0; t < is_two_sided.size(); ++t) {
    if (!is_two_sided[t] && verdict.keep[t]) has_others[mesh.materials[t]] = true;
  }
  std::map<std::int32_t, std::int32_t> two_sided;  // [material] the one for triangles of both sides
  for (std::size_t t = 0; t < is_two_sided.size(); ++t) {
    std::int32_t& material = mesh.materials[t];
    if (!is_two_sided[t] || mesh.double_sided[material]) continue;
    if (!has_others[material]) {
      mesh.double_sided[material] = true;
      continue;
    }
    if (!two_sided.contains(material)) two_sided[material] = add_two_sided(mesh, material);
    material = two_sided[material];
  }
}

}  // namespace

void part_duplicates(SourceMesh& mesh, RepairReport& report) {
  const Verdict verdict = judge_all(mesh, report);
  detach(mesh, verdict.is_layer);
  show_from_both_sides(mesh, verdict);
  leave_out(mesh, verdict.keep);
}

}  // namespace lozenge
