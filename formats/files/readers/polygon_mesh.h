// A mesh while it is read from a format that knows lists of points, and polygons that name them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "formats/base/vector.h"
#include "formats/files/readers/corner_indices.h"
#include "formats/files/readers/corner_vertices.h"
#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"

namespace lozenge {

/// What a corner names of each list, counted from 0; -1 for nothing.
struct PolygonCorner {
  std::int64_t position = -1;
  std::int64_t uv = -1;
  std::int64_t normal = -1;
};

/// How a format counts, for messages.
struct PolygonPlaces {
  const char* unit = "line";  ///< of the places that are given with points and polygons
  int first = 0;              ///< the number of the first point
};

/// Gathers points and polygons, checks each, and cuts polygons into triangles. The readers of all formats but glTF fill
/// one of these. Memory is counted while it is taken.
class PolygonMesh {
 public:
  /// \param file  its name, which begins every message
  PolygonMesh(std::string file, const InputLimits& limits, PolygonPlaces places);

  std::int64_t positions() const { return static_cast<std::int64_t>(positions_.size() / 3); }
  std::int64_t uvs() const { return static_cast<std::int64_t>(uvs_.size() / 2); }
  std::int64_t normals() const { return static_cast<std::int64_t>(normals_.size() / 3); }

  /// Takes the memory for so many at once. \throws Error(kLimit) where that is too much
  void reserve(std::uint64_t positions, std::uint64_t triangles);

  /// \throws Error(kUnusableInput) where a coordinate isn't finite
  void add_position(const Vec3f& position, std::int64_t place);
  /// Of the position that was added last; as the file has it (vertex_colors.h).
  void add_color(const Vec4f& color);
  void add_normal(const Vec3f& normal);
  /// \param uv  with v up, as in all formats but glTF; it is turned over
  void add_uv(const Vec2f& uv);
  /// The polygons that follow have this material.
  void use_material(const std::string& name);

  /// What a polygon of so many corners takes memory for, before it is read.
  /// \throws Error(kUnusableInput) for more than anybody draws
  void require_sensible_polygon(std::uint64_t corners, std::int64_t place) const;

  /// Polygons of one or two corners, which some files have for points and lines, are left out. Corners may name what
  /// is added later.
  /// \throws Error(kUnusableInput) where a corner has no position, Error(kLimit) for too many triangles
  void add_polygon(std::span<const PolygonCorner> corners, std::int64_t place);

  /// Counts something that is no polygon.
  void leave_out() { ++ignored_; }

  /// One mesh, of a primitive for each material; the PolygonMesh is empty then.
  /// \throws Error(kUnusableInput) where it has no triangle, or a corner names what isn't there
  InputAsset finish();

 private:
  /// The largest index into a list, and where it is named.
  struct Furthest {
    std::int64_t index = -1;
    std::int64_t place = 0;
  };
  /// Triangles from here on have that material.
  struct Run {
    std::size_t first_triangle = 0;
    std::int32_t material = -1;
  };

  void watch_memory() const;
  void note_indices(const PolygonCorner& corner, std::int64_t place);
  void require_index(const Furthest& furthest, std::int64_t count, const char* what) const;
  void require_room_for(std::int64_t count) const;
  void cut(std::span<const PolygonCorner> corners);
  void add_triangle(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c);
  std::size_t end_of(std::size_t run) const {
    return run + 1 < runs_.size() ? runs_[run + 1].first_triangle : triangles_.size();
  }
  Primitive whole();
  std::vector<Primitive> by_material();
  void add_run(std::size_t run, CornerVertices& vertices, Primitive& primitive) const;
  void set_vertices(const std::vector<Combination>& vertices, Primitive& primitive) const;

  std::string file_;
  InputLimits limits_;
  PolygonPlaces places_;
  std::vector<float> positions_;
  std::vector<float> colors_;  ///< [position], or empty
  std::vector<float> normals_;
  std::vector<float> uvs_;
  CornerIndices::Triangles triangles_;
  CornerIndices uv_of_;
  CornerIndices normal_of_;
  Furthest furthest_position_;
  Furthest furthest_uv_;
  Furthest furthest_normal_;
  std::vector<Run> runs_;
  std::vector<std::string> material_names_;
  std::map<std::string, std::int32_t> material_of_name_;
  std::int64_t ignored_ = 0;
  std::vector<Vec3f> cut_corners_;  ///< of the polygon at hand
  CornerIndices::Triangles cut_triangles_;
};

}  // namespace lozenge
