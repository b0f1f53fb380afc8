// Rays and nearest points against the triangles of one mesh: Embree, behind a few functions.
//
// Positions go to Embree relative to the middle of the mesh's bounding box, so that an asset far from the origin loses
// no precision. Intersections are watertight along edges; of rays aimed exactly at a vertex one in hundreds may slip
// through. Everything is a function of the mesh and the query alone, on any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// A part of a line. The direction need not be a unit vector; distances along the ray are in multiples of it.
struct Ray {
  Vec3d origin{0, 0, 0};
  Vec3d direction{0, 0, 1};
  double nearest = 0;
  double farthest = std::numeric_limits<double>::infinity();
};

struct RayHit {
  TriangleId triangle = -1;  ///< -1 where the ray hits nothing; the rest then means nothing
  Vec3d weights{1, 0, 0};    ///< barycentric, none below 0
  double distance = 0;       ///< along the ray, in multiples of its direction
  bool front = false;        ///< the ray comes from the outside: it runs against the triangle's normal

  bool exists() const { return triangle >= 0; }
};

struct NearestPoint {
  TriangleId triangle = -1;  ///< -1 where no triangle is near enough; the rest then means nothing
  Vec3d weights{1, 0, 0};    ///< barycentric, none below 0
  Vec3d point{0, 0, 0};
  double distance = 0;  ///< in the mesh's units

  bool exists() const { return triangle >= 0; }
};

/// A mesh, ready to be asked. All questions may be asked by several threads at once.
class RayScene {
 public:
  /// Copies what it needs. Triangles without area are allowed; rays pass them by.
  /// \pre  the triangles' vertices exist and are finite
  /// \throws Error(kLimit) where memory runs out, Error(kInternal) where Embree can't start
  RayScene(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// The first triangle along the ray, seen from either side.
  /// \pre  finite origin, finite direction that is not zero (`occluded` too)
  RayHit closest_hit(const Ray& ray) const;

  /// The same of many rays, which go down the tree side by side: faster where neighbours go the same way, slower where
  /// they don't.
  /// \pre  `hits` has a place for each ray
  void closest_hits(std::span<const Ray> rays, std::span<RayHit> hits) const;

  /// Whether anything lies on the ray. Faster than `closest_hit`.
  bool occluded(const Ray& ray) const;

  /// The same of many rays, which are traced side by side. \pre  `blocked` has a place for each ray, and gets 1 or 0.
  /// \return of how many
  std::int32_t occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  /// So many are traced at a time.
  static constexpr std::size_t kPacket = 16;

  /// The point of the mesh that is nearest to `p`, where one lies within `radius`; of equally near ones, the one of the
  /// lowest triangle.
  NearestPoint nearest(const Vec3d& p, double radius = std::numeric_limits<double>::infinity()) const;

  /// The same, sooner found: the search begins at `close`, a triangle that is near, as the one that was nearest to a
  /// point beside this one is; -1 where none is known.
  NearestPoint nearest_from(TriangleId close, const Vec3d& p) const;

  /// The same, of the triangles that count alone.
  NearestPoint nearest_of(const std::function<bool(TriangleId)>& counts, const Vec3d& p,
                          double radius = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lozenge
