// Pictures of a source and of its map, all from the same place: what light does is found once for all of them.
#pragma once

#include <functional>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/render/tracer.h"

namespace lozenge {

/// Linear colour of a source's surface, at a point of a triangle.
using SourceColour = std::function<Vec3f(TriangleId, const Vec3d& weights)>;

class SourceStudio {
 public:
  /// Keeps a reference to the mesh.
  SourceStudio(const SourceMesh& mesh, const RenderOptions& options);

  /// Its own normals; plain clay where no colour is given.
  Picture shaded(const SourceColour& colour = {}) const;
  /// Each triangle of the domain in its own colour; neighbours differ.
  Picture patches(const Parameterization& map) const;
  /// White where the map keeps areas, towards pure blue where it shrinks them, pure red where it expands them, full at
  /// a factor 2 (paper, Fig. 9).
  Picture distortion(const Parameterization& map) const;

 private:
  const SourceMesh& mesh_;
  ShadingNormals shading_;
  Studio studio_;
};

}  // namespace lozenge
