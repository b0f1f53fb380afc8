// Which class of looks (formats/surface/look_classes.h) the triangles of a level belong to. The atlas says: where a
// triangle lies there, it shows that part of the source.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/patches/geometry_image.h"
#include "formats/patches/map_layout.h"
#include "formats/surface/look_classes.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/export.h"

namespace lozenge {

/// Triangles of one class: a primitive.
struct LookedMesh {
  std::int32_t look = 0;
  EngineMesh mesh;
};

class Looks {
 public:
  /// Keeps references to `image` and what `source` points to. \param source  null where it isn't known: then triangles
  /// are of the class of most of their patch
  Looks(const GeometryImage& image, const MapLayout& layout, const SourceSurface* source);
  ~Looks();

  const std::vector<LookClass>& classes() const { return looks_.classes; }

  /// The mesh in its classes, in their order; of one class it stays as it is. A triangle is of the class of most of its
  /// area. What is blended is in the order of the source's triangles, which is that in which it was drawn.
  std::vector<LookedMesh> split(const EngineMesh& mesh) const;

 private:
  struct Locator;
  struct Verdict {
    std::int32_t look = 0;
    TriangleId source = 0;  ///< at its middle
  };
  Verdict judge(const EngineMesh& mesh, std::size_t triangle) const;
  Verdict at(const Vec2d& texcoord) const;

  const GeometryImage& image_;
  MapLayout layout_;
  const SourceSurface* source_;
  LookClasses looks_;
  std::vector<std::int32_t> of_patch_;  ///< [patch], where there is no source
  std::unique_ptr<Locator> locator_;    ///< null where all is of one class
};

}  // namespace lozenge
