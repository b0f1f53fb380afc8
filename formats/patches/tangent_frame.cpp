// A tangent is what the patch's own triangles say about growing u, weighted by their angles at the vertex, so that it
// depends on no neighbour. A texel is read by Cramer's rule in the interpolated frame, whose axes are not quite at
// right angles.
#include "formats/patches/tangent_frame.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

/// -0 is never stored.
Vec3f rounded(const Vec3d& v) { return Vec3f(v) + Vec3f(0, 0, 0); }

Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double length = v.length();
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

/// Any unit vector at a right angle to the unit vector `n`.
Vec3d perpendicular(const Vec3d& n) {
  const Vec3d axis = std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  return axis.cross(n).normalized();
}

/// The direction of `v` in the plane at a right angle to the unit vector `n`. A vector along n has none: what is left
/// of it is rounding, which may point anywhere.
Vec3d direction_in_plane(const Vec3d& v, const Vec3d& n, const Vec3d& otherwise) {
  constexpr double kAlong = 1e-8;
  const Vec3d left = v - n * n.dot(v);
  return left.length() > kAlong * v.length() ? unit_or(left, otherwise) : otherwise;
}

/// The angle between two edges; 0 where one of them has no length.
double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2(a.cross(b).length(), a.dot(b)); }

/// One vertex of a patch's grid.
struct GridPoint {
  std::int32_t i, j;
};

/// One patch as one level draws it, while its tangents are summed.
class PatchTangents {
 public:
  PatchTangents(const GeometryImage& image, std::int32_t level, std::int32_t patch)
      : image_(image),
        level_(level),
        patch_(patch),
        samples_(image.layout.samples_of(patch, level)),
        sums_(static_cast<std::size_t>(samples_) * samples_, Vec3d(0, 0, 0)) {
    const bool has_right = image.layout.places[patch].right.exists();
    for (std::int32_t j = 0; j + 1 < samples_; ++j) {
      for (std::int32_t i = 0; i + 1 < samples_; ++i) {
        if (has_right || i < j) add({i, j}, {i + 1, j}, {i, j + 1});
        if (has_right || i < j) add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
        // Only half of a quad on the boundary's diagonal is there.
        if (!has_right && i == j) add({i, i}, {i + 1, i + 1}, {i, i + 1});
      }
    }
  }

  Vec3d normal(GridPoint p) const { return unit_or(Vec3d(image_.normal(level_, patch_, p.i, p.j)), Vec3d(0, 0, 1)); }

  /// Sums are in the vertices' tangent planes, up to rounding.
  Vec3d tangent(GridPoint p) const {
    const Vec3d n = normal(p);
    return direction_in_plane(sums_[slot(p)], n, perpendicular(n));
  }

 private:
  std::size_t slot(GridPoint p) const { return static_cast<std::size_t>(p.j) * samples_ + p.i; }
  Vec3d position(GridPoint p) const { return Vec3d(image_.position(level_, patch_, p.i, p.j)); }

  /// Adds the triangle's direction of growing u at its three corners.
  void add(GridPoint a, GridPoint b, GridPoint c) {
    const std::array<GridPoint, 3> corners{a, b, c};
    const Vec3d p = position(a);
    // The gradient in steps of the grid; b - a and c - a span it with a determinant of 1.
    const Vec3d along_u = (position(b) - p) * (c.j - a.j) - (position(c) - p) * (b.j - a.j);
    for (int k = 0; k < 3; ++k) {
      const GridPoint at = corners[k];
      const Vec3d direction = direction_in_plane(along_u, normal(at), Vec3d(0, 0, 0));
      const double angle =
          angle_between(position(corners[(k + 1) % 3]) - position(at), position(corners[(k + 2) % 3]) - position(at));
      sums_[slot(at)] += direction * angle;
    }
  }

  const GeometryImage& image_;
  std::int32_t level_;
  std::int32_t patch_;
  std::int32_t samples_;
  std::vector<Vec3d> sums_;
};

}  // namespace

std::vector<Vec3f> vertex_tangents(const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals,
                                   const std::vector<Vec2f>& texcoords, const std::vector<std::uint32_t>& indices) {
  std::vector<Vec3d> sums(positions.size(), Vec3d(0, 0, 0));
  for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
    const std::array<std::uint32_t, 3> corners{indices[first], indices[first + 1], indices[first + 2]};
    const Vec3d p(positions[corners[0]]);
    const Vec2d uv(texcoords[corners[0]]);
    const Vec2d b = Vec2d(texcoords[corners[1]]) - uv;
    const Vec2d c = Vec2d(texcoords[corners[2]]) - uv;
    const Vec3d along_u = (Vec3d(positions[corners[1]]) - p) * c.y - (Vec3d(positions[corners[2]]) - p) * b.y;
    for (int k = 0; k < 3; ++k) {
      const Vec3d at(positions[corners[k]]);
      const Vec3d direction = direction_in_plane(along_u, Vec3d(normals[corners[k]]), Vec3d(0, 0, 0));
      sums[corners[k]] += direction * angle_between(Vec3d(positions[corners[(k + 1) % 3]]) - at,
                                                    Vec3d(positions[corners[(k + 2) % 3]]) - at);
    }
  }
  std::vector<Vec3f> tangents(positions.size());
  for (std::size_t v = 0; v < tangents.size(); ++v) {
    const Vec3d normal(normals[v]);
    tangents[v] = rounded(direction_in_plane(sums[v], normal, perpendicular(normal)));
  }
  return tangents;
}

FrameVertices frame_vertices(const GeometryImage& image, int level, const MapLayout& layout) {
  FrameVertices result;
  result.grids = PatchGrids(image.layout, level);
  result.vertices.resize(result.grids.size());
  FrameVertex* next = result.vertices.data();
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    const PatchTangents tangents(image, level, patch);
    const bool has_right = image.layout.places[patch].right.exists();
    const std::int32_t samples = result.grids.samples(patch);
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < samples; ++i, ++next) {
        if (i > j && !has_right) continue;
        const double last = samples - 1;
        *next = {rounded(tangents.normal({i, j})), rounded(tangents.tangent({i, j})),
                 Vec2f(layout.texcoord(patch, i / last, j / last))};
      }
    }
  }
  return result;
}

Vec3d ShadingFrame::to_object(const Vec3d& texel) const {
  return unit_or(tangent * texel.x + bitangent * texel.y + normal * texel.z, normal);
}

Vec3d ShadingFrame::to_texel(const Vec3d& direction) const {
  // Cramer's rule; the determinant is |normal x tangent|^2 times the sign.
  const double determinant = tangent.cross(bitangent).dot(normal);
  const Vec3d texel(bitangent.cross(normal).dot(direction), normal.cross(tangent).dot(direction),
                    tangent.cross(bitangent).dot(direction));
  return unit_or(texel / determinant, Vec3d(0, 0, 1));
}

ShadingFrame shading_frame(const std::array<const FrameVertex*, 3>& corners, const Vec3d& weights) {
  Vec3d normal(0, 0, 0);
  Vec3d tangent(0, 0, 0);
  for (int c = 0; c < 3; ++c) {
    normal += Vec3d(corners[c]->normal) * weights[c];
    tangent += Vec3d(corners[c]->tangent) * weights[c];
  }
  ShadingFrame frame;
  frame.normal = unit_or(normal, Vec3d(corners[0]->normal));
  frame.tangent = unit_or(tangent, Vec3d(0, 0, 0));
  // Where the tangents of a triangle cancel each other so far that nothing or the normal is left, any will do.
  if (frame.normal.cross(frame.tangent).length() < 1e-6) frame.tangent = perpendicular(frame.normal);
  frame.bitangent = frame.normal.cross(frame.tangent) * static_cast<double>(kBitangentSign);
  return frame;
}

}  // namespace lozenge
