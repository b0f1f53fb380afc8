#include "stages/import/repair.h"

#include <algorithm>

#include "formats/surface/canonical_form.h"
#include "stages/import/fans.h"
#include "stages/import/leave_out.h"
#include "stages/import/orient.h"
#include "stages/import/part.h"
#include "stages/import/sheets.h"
#include "stages/import/surface.h"

namespace lozenge {

namespace {

bool has_flat_triangle(const SourceMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_flat(mesh, static_cast<TriangleId>(t))) return true;
  }
  return false;
}

/// Two triangles with the same three edges, on what is a manifold otherwise: lying on each other.
bool has_pillow(const std::vector<HalfEdge>& twins) {
  for (std::size_t h = 0; h < twins.size(); h += 3) {
    if (twins[h] < 0) continue;
    const HalfEdge other = twins[h] / 3;
    if (twins[h + 1] >= 0 && twins[h + 1] / 3 == other && twins[h + 2] >= 0 && twins[h + 2] / 3 == other) return true;
  }
  return false;
}

}  // namespace

void repair_surface(SourceMesh& mesh, RepairReport& report) {
  bool changed = false;
  if (HalfEdgeLinks links = link_half_edges(mesh); !is_manifold(mesh, links) || has_pillow(links.twins)) {
    changed = true;
    leave_out_superfluous_triangles(mesh, report);
    orient_patches(mesh, report);
    links = link_half_edges(mesh);
    const std::vector<HalfEdge> twins = pair_sheets(mesh, links, report);
    part_vertices(mesh, twins, links, report);
    divide_double_edges(mesh, twins, report);
  }
  if (has_flat_triangle(mesh)) {
    const std::size_t before = mesh.triangles.size();
    leave_out_flat_pieces(mesh, report);
    changed = changed || mesh.triangles.size() != before;
  }
  if (changed) make_canonical(mesh);
}

}  // namespace lozenge
