#include "tools/bench/polygon_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "formats/base/error.h"

namespace lozenge::bench {
namespace {

/// Half-edges are counted in 32 bits.
constexpr std::size_t kMostTriangles = std::numeric_limits<std::int32_t>::max() / 3;

}  // namespace

void PolygonMesh::add_vertex(double x, double y, double z) {
  const Vec3f position(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: position of vertex {} isn't finite as floats: {} {} {}", file_, vertices(), x, y, z));
  }
  if (vertices() == std::numeric_limits<std::int32_t>::max()) {
    throw Error(ExitCode::kLimit, file_ + ": has more vertices than 32-bit indices can name; split it");
  }
  surface_.positions.push_back(position);
}

void PolygonMesh::add_polygon(std::span<const std::int64_t> corners) {
  const std::int64_t polygon = polygons_++;
  for (const std::int64_t corner : corners) {
    if (corner >= 0 && corner < vertices()) continue;
    throw Error(ExitCode::kUnusableInput, fmt::format("{}: face {} names vertex {}, but there are {}, counted from 0",
                                                      file_, polygon, corner, vertices()));
  }
  for (std::size_t k = 2; k < corners.size(); ++k) {
    if (surface_.triangles.size() == kMostTriangles) {
      throw Error(ExitCode::kLimit, fmt::format("{}: has more than {} triangles; split it", file_, kMostTriangles));
    }
    surface_.triangles.push_back(
        {static_cast<VertexId>(corners[0]), static_cast<VertexId>(corners[k - 1]), static_cast<VertexId>(corners[k])});
  }
}

Surface PolygonMesh::finish() {
  if (surface_.triangles.empty()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: has {} vertices, but no triangles; a surface is needed", file_, vertices()));
  }
  return std::move(surface_);
}

}  // namespace lozenge::bench
