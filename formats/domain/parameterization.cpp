#include "formats/domain/parameterization.h"

namespace lozenge {

std::optional<Development> image_of(const SourceMesh& mesh, const Parameterization& map, TriangleId t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return develop(map.domain, {map.phi[a], map.phi[b], map.phi[c]});
}

}  // namespace lozenge
