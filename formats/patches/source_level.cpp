// Every vertex gets its position once, and what lies on an edge is made of the edge's ends alone, in one order: so
// neighbours agree by bits wherever the source does.
#include "formats/patches/source_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/base/parallel.h"
#include "formats/patches/leave_out_flat_vertices.h"
#include "formats/surface/distinct_positions.h"
#include "formats/surface/look_classes.h"

namespace lozenge {

namespace {

/// The corners that a place lies between.
struct Between {
  std::array<WeightedElement, 3> corners;
  std::size_t count = 0;
};

int corner_of_vertex(const SourceMesh& mesh, TriangleId t, VertexId v) {
  const auto& corners = mesh.triangles[t];
  return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

Between between(const SourceMesh& mesh, const CutSurface& cut, TriangleId t, const CutCorner& corner) {
  const auto vertices = static_cast<VertexId>(mesh.positions.size());
  const std::size_t first = 3 * static_cast<std::size_t>(t);
  if (corner.vertex < vertices) {
    return {{WeightedElement{first + static_cast<std::size_t>(corner_of_vertex(mesh, t, corner.vertex)), 1}}, 1};
  }
  const CutPoint& point = cut.points[corner.vertex - vertices];
  if (point.ends[0] >= 0) {
    const auto low = static_cast<std::size_t>(corner_of_vertex(mesh, t, point.ends[0]));
    const auto high = static_cast<std::size_t>(corner_of_vertex(mesh, t, point.ends[1]));
    return {{WeightedElement{first + low, 1 - point.share}, WeightedElement{first + high, point.share}}, 2};
  }
  return {{WeightedElement{first, corner.weights[0]}, WeightedElement{first + 1, corner.weights[1]},
           WeightedElement{first + 2, corner.weights[2]}},
          3};
}

Vec3d position_between(const SourceMesh& mesh, const Between& place) {
  Vec3d sum(0, 0, 0);
  for (std::size_t i = 0; i < place.count; ++i) {
    const auto& [corner, weight] = place.corners[i];
    sum += Vec3d(mesh.positions[mesh.triangles[corner / 3][corner % 3]]) * weight;
  }
  return sum;
}

Vec3f plane_normal(const SourceMesh& mesh, TriangleId t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d p(mesh.positions[a]);
  const Vec3d normal = (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p);
  const double length = normal.length();
  return length > 0 && std::isfinite(length) ? Vec3f(normal / length) : Vec3f(0, 0, 0);
}

/// The source's normals between corners, as a renderer sees them.
class NormalsBetween {
 public:
  explicit NormalsBetween(const SourceMesh& mesh)
      : mesh_(mesh), stream_(find_stream(mesh.corner_attributes, kNormals)) {
    if (stream_ == nullptr) smooth_ = vertex_normals(mesh);
  }

  Vec3f operator()(std::span<const WeightedElement> corners) const {
    Vec3d sum(0, 0, 0);
    for (const auto& [corner, weight] : corners) sum += Vec3d(at(corner)) * weight;
    constexpr double kCancelled = 1e-6;  // what rounding leaves has no direction
    if (sum.length() > kCancelled) return without_negative_zeros(Vec3f(sum.normalized()));
    const Vec3f plane = plane_normal(mesh_, static_cast<TriangleId>(corners.front().element / 3));
    return plane.length2() > 0 ? without_negative_zeros(plane) : Vec3f(0, 0, 1);
  }

 private:
  Vec3f at(std::size_t corner) const {
    return stream_ != nullptr ? vector_at<Vec3f>(*stream_, corner) : smooth_[mesh_.triangles[corner / 3][corner % 3]];
  }

  const SourceMesh& mesh_;
  const AttributeStream* stream_;
  std::vector<Vec3f> smooth_;
};

/// [vertex of the source] a corner of it, the first.
std::vector<std::size_t> first_corners(const SourceMesh& mesh) {
  std::vector<std::size_t> first(mesh.positions.size(), 0);
  for (std::size_t c = 3 * mesh.triangles.size(); c-- > 0;) first[mesh.triangles[c / 3][c % 3]] = c;
  return first;
}

/// [vertex of the cut surface] its joints and weights, one for all corners, whichever triangle they are of.
std::vector<float> influences_of(const SourceMesh& mesh, const CutSurface& cut) {
  const AttributeStream* stream = find_stream(mesh.corner_attributes, kInfluences);
  if (stream == nullptr || !mesh.bodies.has_skin()) return {};
  constexpr std::size_t kWidth = kInfluences.components;
  const std::vector<std::size_t> corner_of = first_corners(mesh);
  const auto vertices = static_cast<VertexId>(mesh.positions.size());
  std::vector<float> influences(kWidth * (mesh.positions.size() + cut.points.size()), 0.0F);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::copy_n(stream->at(corner_of[v]), kWidth, &influences[kWidth * v]);
  }
  for (const CutTriangle& t : cut.triangles) {
    for (const CutCorner& corner : t.corners) {
      if (corner.vertex < vertices) continue;
      Between place = between(mesh, cut, t.source, corner);
      for (WeightedElement& element : place.corners) {
        element.element = corner_of[mesh.triangles[element.element / 3][element.element % 3]];
      }
      interpolate(*stream, {place.corners.data(), place.count},
                  &influences[kWidth * static_cast<std::size_t>(corner.vertex)]);
    }
  }
  return influences;
}

/// [vertex of the cut surface] where it lies on the source, by the first triangle that has it.
std::vector<SourcePoint> origins_of(const SourceMesh& mesh, const CutSurface& cut) {
  if (!mesh.bodies.has_targets()) return {};
  std::vector<SourcePoint> origins(mesh.positions.size() + cut.points.size());
  for (const CutTriangle& t : cut.triangles) {
    for (const CutCorner& corner : t.corners) {
      SourcePoint& origin = origins[corner.vertex];
      if (origin.triangle >= 0) continue;
      const Between place = between(mesh, cut, t.source, corner);
      origin.triangle = t.source;
      for (std::size_t i = 0; i < place.count; ++i) {
        origin.weights[static_cast<int>(place.corners[i].element % 3)] = place.corners[i].weight;
      }
    }
  }
  return origins;
}

/// Whether a triangle bends: vertices that lie flat at rest may not do so in other poses.
bool bends(const SourceMesh& mesh, TriangleId t) {
  if (mesh.bodies.empty()) return false;
  const std::int32_t body = mesh.bodies.owner_of(mesh.materials[t]);
  return body >= 0 && (mesh.bodies.bodies[body].skin >= 0 || !mesh.bodies.bodies[body].targets.empty());
}

}  // namespace

ChartedSurface charted_surface(const SourceMesh& mesh, const CutSurface& cut, const CarriedBetween& carried,
                               const std::function<std::int32_t(TriangleId)>& group_of) {
  ChartedSurface surface;
  surface.positions = mesh.positions;
  surface.positions.resize(mesh.positions.size() + cut.points.size());
  surface.triangles.resize(cut.triangles.size());
  for_each_part(cut.triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const CutTriangle& from = cut.triangles[n];
      ChartedTriangle& to = surface.triangles[n];
      to.patch = from.patch;
      to.group = group_of(from.source);
      to.normal = plane_normal(mesh, from.source);
      for (int c = 0; c < 3; ++c) {
        const Between place = between(mesh, cut, from.source, from.corners[c]);
        to.corners[c] = {from.corners[c].vertex, from.corners[c].place, carried({place.corners.data(), place.count})};
      }
    }
  });
  for (const CutTriangle& t : cut.triangles) {
    for (const CutCorner& corner : t.corners) {
      if (corner.vertex < static_cast<VertexId>(mesh.positions.size())) continue;
      const Vec3d p = position_between(mesh, between(mesh, cut, t.source, corner));
      surface.positions[corner.vertex] = without_negative_zeros(Vec3f(p));
    }
  }
  return surface;
}

ChartedSurface source_level(const SourceMesh& mesh, const Parameterization& map, const PatchLayout& patches,
                            const MapLayout& layout) {
  const NormalsBetween normals(mesh);
  const CutSurface cut = cut_along_patches(mesh, map, patches.places);
  const LookClasses looks = look_classes(mesh);
  ChartedSurface surface = charted_surface(
      mesh, cut, [&](auto corners) { return normals(corners); },
      [&](TriangleId t) {
        return is_cap(mesh, t)         ? kCapGroup
               : bends(mesh, t)        ? group_of_bent(t)
               : looks.of(mesh, t) > 0 ? kCapGroup + looks.of(mesh, t)
                                       : 0;
      });
  surface.influences = influences_of(mesh, cut);
  surface.origins = origins_of(mesh, cut);
  FlatVertexOptions options;
  options.carries_directions = true;
  leave_out_flat_vertices(surface, chart_scales(layout, patches.size()), patches.adjacency, options);
  make_distinct(surface.positions);
  return surface;
}

std::vector<std::int32_t> parts_of_patches(const std::vector<std::array<PatchSide, 4>>& adjacency) {
  std::vector<std::int32_t> part(adjacency.size(), -1);
  std::int32_t count = 0;
  std::vector<std::int32_t> open;
  for (std::size_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] >= 0) continue;
    part[seed] = count;
    open.push_back(static_cast<std::int32_t>(seed));
    while (!open.empty()) {
      const std::int32_t patch = open.back();
      open.pop_back();
      for (const PatchSide& side : adjacency[patch]) {
        if (side.patch < 0 || part[side.patch] >= 0) continue;
        part[side.patch] = count;
        open.push_back(side.patch);
      }
    }
    ++count;
  }
  return part;
}

}  // namespace lozenge
