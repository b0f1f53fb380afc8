#include <fmt/format.h>

#include "formats/mesh_statistics.h"
#include "formats/source_mesh_file.h"
#include "stages/check/check.h"

namespace lozenge {

CheckReport check_source_mesh(const SourceMesh& mesh) {
  CheckReport report;
  report.kind = "source mesh";
  const auto defect = find_defect(mesh);
  report.add("canonical form", !defect, defect.value_or(fmt::format("{} vertices", mesh.positions.size())));
  if (defect) return report;
  const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
  report.add(
      "closed, oriented, 2-manifold", is_closed_manifold(s),
      is_closed_manifold(s)
          ? fmt::format("{} triangles, {} component(s), Euler characteristic {}", s.triangles, s.components, s.euler)
          : fmt::format("{} boundary edges, {} edges of too many or turned triangles, {} pinched vertices",
                        s.boundary_edges, s.tangled_edges, s.pinched_vertices));
  return report;
}

}  // namespace lozenge
