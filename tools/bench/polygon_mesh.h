// A mesh while it is read: points, and polygons that become fans of triangles.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tools/surface_file.h"

namespace lozenge::bench {

/// Gathers points and polygons and checks each. The readers of all formats fill one of these.
class PolygonMesh {
 public:
  /// \param file  begins every message
  explicit PolygonMesh(std::string file) : file_(std::move(file)) {}

  std::int64_t vertices() const { return static_cast<std::int64_t>(surface_.positions.size()); }

  /// \throws Error(kUnusableInput) where a coordinate isn't finite as a float
  void add_vertex(double x, double y, double z);
  /// A fan around its first corner. Polygons of one or two corners, which some files have for points and lines, are
  /// left out.
  /// \throws Error(kUnusableInput) where a corner is no vertex that was added
  void add_polygon(std::span<const std::int64_t> corners);

  /// The mesh. \throws Error(kUnusableInput) where it has no triangle
  Surface finish();

 private:
  std::string file_;
  Surface surface_;
  std::int64_t polygons_ = 0;
};

}  // namespace lozenge::bench
