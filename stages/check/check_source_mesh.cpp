// Indices first; then positions, attributes, and the edges: at most two triangles each, that run against each other.
#include "stages/check/check_source_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/check/check_adjacency.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

bool check_indices(const SourceMesh& mesh, CheckReport& report) {
  Finding wrong;
  if (mesh.triangles.empty()) wrong.add([] { return std::string("there are no triangles"); });
  // Numbers grow by one at each first use.
  VertexId next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t]) {
      if (v < 0 || v > next || static_cast<std::size_t>(v) >= mesh.positions.size()) {
        wrong.add([&] { return fmt::format("triangle {} names vertex {} where at most {} is due", t, v, next); });
      }
      next = std::max(next, v + 1);
    }
  }
  if (wrong.none() && static_cast<std::size_t>(next) != mesh.positions.size()) {
    wrong.add([&] { return fmt::format("vertex {} belongs to no triangle", next); });
  }
  wrong.report_to(report, "vertices are numbered in the order of their first use",
                  fmt::format("{} vertices, {} triangles", mesh.positions.size(), mesh.triangles.size()));
  return wrong.none();
}

void check_positions(const SourceMesh& mesh, CheckReport& report) {
  Finding infinite;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& p = mesh.positions[v];
    const bool negative_zero =
        (p.x == 0 && std::signbit(p.x)) || (p.y == 0 && std::signbit(p.y)) || (p.z == 0 && std::signbit(p.z));
    if (!is_finite(p) || negative_zero) infinite.add([&] { return fmt::format("vertex {}", v); });
  }
  infinite.report_to(report, "positions are finite, zeros positive", fmt::format("{} vertices", mesh.positions.size()));
}

/// "12 normals, 0 texture coordinates": what readers take along, and what else there is.
std::string count_attributes(const AttributeStreams& streams) {
  AttributeStreams counted = empty_like(streams);
  for (const AttributeKind& kind : kAttributeKinds) {
    if (!kind.tells_vertices_apart) stream_for(counted, kind);
  }
  std::string words;
  for (const AttributeStream& each : counted) {
    const AttributeStream* stream = find_stream(streams, each.kind, each.set);
    words += fmt::format("{} {}, ", stream ? stream->count() : 0, label_of(each));
  }
  return words;
}

void check_attributes(const SourceMesh& mesh, CheckReport& report) {
  const std::size_t corners = mesh.triangles.size() * 3;
  const bool complete =
      std::all_of(mesh.corner_attributes.begin(), mesh.corner_attributes.end(),
                  [&](const AttributeStream& stream) {
                    return stream.values.size() == corners * static_cast<std::size_t>(stream.kind.components);
                  }) &&
      (mesh.materials.empty() || mesh.materials.size() == mesh.triangles.size());
  report.add("attributes at every corner or at none", complete,
             fmt::format("{}{} materials", count_attributes(mesh.corner_attributes), mesh.materials.size()));
  if (!mesh.materials.empty()) {
    report.add("triangles are sorted by material", std::is_sorted(mesh.materials.begin(), mesh.materials.end()),
               fmt::format("{} materials", mesh.material_names.size()));
  }
}

}  // namespace

CheckReport check_source_mesh(const SourceMesh& mesh) {
  CheckReport report;
  report.kind = "source mesh";
  const bool indexed = check_indices(mesh, report);
  check_positions(mesh, report);
  check_attributes(mesh, report);
  if (!indexed) return report;
  const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
  const std::string shape = fmt::format("{} component(s), Euler characteristic {}, {} boundary loop(s) of {} edges",
                                        s.components, s.euler, s.boundary_loops, s.boundary_edges);
  report.add("oriented 2-manifold", is_manifold(s),
             is_manifold(s) ? shape
                            : fmt::format("{} edges of too many or turned triangles, {} pinched vertices",
                                          s.tangled_edges, s.pinched_vertices));
  return report;
}

}  // namespace lozenge
