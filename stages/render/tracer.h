// The studio: a camera that frames a surface, soft lights that move with the camera, a floor that takes a shadow.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "formats/surface/surface_view.h"
#include "stages/render/picture.h"
#include "stages/render/render.h"

namespace lozenge {

/// A perspective camera that looks at an object from a direction, with all of it in the picture.
class Camera {
 public:
  Camera(const SurfaceView& surface, const RenderOptions& options);

  /// Unit direction from the eye through a place of the picture, in pixels from its top left corner.
  Vec3d direction(double x, double y) const;
  /// Where a point is seen, in pixels.
  Vec2d pixel(const Vec3d& point) const;
  /// Size of a pixel on a surface at this point that faces the eye, asset's units.
  double pixel_size(const Vec3d& point) const;

  const Vec3d& eye() const { return eye_; }
  /// A direction of the camera's frame (right, up, towards the camera) in the asset's.
  Vec3d world(const Vec3d& local) const { return right_ * local.x + up_ * local.y + back_ * local.z; }

 private:
  Vec3d eye_, right_, up_, back_;
  double focal_ = 1;  ///< pixels at distance 1
  double width_, height_;
};

/// A point that the camera sees.
struct SurfaceHit {
  TriangleId triangle = -1;
  Vec3d weights{1, 0, 0};
  Vec3d point{0, 0, 0};
  Vec2d pixel{0, 0};
};

/// What the surface looks like there.
struct Look {
  Vec3d normal{0, 0, 1};           ///< unit
  Vec3f albedo{0.6F, 0.6F, 0.6F};  ///< linear
  double occlusion = 1;            ///< of the ambient light; multiplies what the studio finds itself
};
using LookFunction = std::function<Look(const SurfaceHit&, const Camera&)>;

/// A surface before a camera, lit: for any number of pictures of it.
class Studio {
 public:
  /// Keeps a reference to the surface.
  /// \param vertex_normals  [position], for the studio's own ambient occlusion
  /// \throws Error(kUsage) where a picture can't have the size
  Studio(const SurfaceView& surface, const std::vector<Vec3f>& vertex_normals, const RenderOptions& options);
  ~Studio();

  /// \param look  may be called by several threads at once
  Picture picture(const LookFunction& look) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// One picture.
Picture trace(const SurfaceView& surface, const std::vector<Vec3f>& vertex_normals, const LookFunction& look,
              const RenderOptions& options);

}  // namespace lozenge
