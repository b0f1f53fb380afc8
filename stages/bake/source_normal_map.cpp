// The triangles of the source level are drawn into their patches' tiles, so that each texel knows the one whose frame
// it is seen in; they reach into gutters where cuts close to a border were left out. Texels that none covers aren't
// seen but by filters: they have the triangle of a texel beside them.
#include "stages/bake/source_normal_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/base/parallel.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/source_level.h"

namespace lozenge {

namespace {

constexpr std::int32_t kNone = -1;

/// The texels of one tile, gutters too, and the triangle that each is seen on.
class TriangleTile {
 public:
  TriangleTile(const MapTile& tile, double last) : tile_(tile), last_(last), triangles_(tile.size * tile.size, kNone) {}

  void draw(const ChartedTriangle& triangle, std::int32_t number) {
    std::array<Vec2d, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = triangle.corners[c].place * last_;
    const auto [left, right] = range(p[0].x, p[1].x, p[2].x);
    const auto [top, bottom] = range(p[0].y, p[1].y, p[2].y);
    for (std::int32_t y = top; y <= bottom; ++y) {
      for (std::int32_t x = left; x <= right; ++x) {
        std::int32_t& texel = at(x, y);
        constexpr double kRounding = 1e-6;
        const Vec3d w = weights_in(p, Vec2d(x, y));
        if (texel == kNone && std::min({w.x, w.y, w.z}) >= -kRounding) texel = number;
      }
    }
  }

  /// Texels that have none take that of one beside them, and so on.
  void spread() {
    std::vector<std::int32_t> done;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(triangles_.size()); ++i) {
      if (triangles_[i] != kNone) done.push_back(i);
    }
    for (std::size_t next = 0; next < done.size(); ++next) {
      const std::int32_t x = done[next] % tile_.size;
      const std::int32_t y = done[next] / tile_.size;
      const auto reach = [&](std::int32_t i, std::int32_t j) {
        if (i < 0 || j < 0 || i >= tile_.size || j >= tile_.size) return;
        const std::int32_t index = j * tile_.size + i;
        if (triangles_[index] != kNone) return;
        triangles_[index] = triangles_[done[next]];
        done.push_back(index);
      };
      reach(x - 1, y);
      reach(x + 1, y);
      reach(x, y - 1);
      reach(x, y + 1);
    }
  }

  std::int32_t& at(std::int32_t x, std::int32_t y) {
    return triangles_[static_cast<std::size_t>((y + tile_.gutter) * tile_.size + x + tile_.gutter)];
  }

  static Vec3d weights_in(const std::array<Vec2d, 3>& p, const Vec2d& at) {
    const auto area = [](const Vec2d& a, const Vec2d& b, const Vec2d& c) { return (b - a).cross(c - a); };
    const double whole = area(p[0], p[1], p[2]);
    if (!(std::abs(whole) > 0)) return {-1, -1, -1};
    return Vec3d(area(at, p[1], p[2]), area(at, p[2], p[0]), area(at, p[0], p[1])) / whole;
  }

 private:
  /// Whole numbers between three, inside of the tile.
  std::pair<std::int32_t, std::int32_t> range(double a, double b, double c) const {
    const auto [low, high] = std::minmax({a, b, c});
    const double first = -tile_.gutter;
    const double end = tile_.size - tile_.gutter - 1;
    return {static_cast<std::int32_t>(std::clamp(std::ceil(low - 1e-6), first, end + 1)),
            static_cast<std::int32_t>(std::clamp(std::floor(high + 1e-6), first - 1, end))};
  }

  MapTile tile_;
  double last_;
  std::vector<std::int32_t> triangles_;
};

/// The frame at a place of a triangle's patch; where it lies beyond the triangle, that of a point on it.
ShadingFrame frame_at(const FramedSurface& framed, const ChartedTriangle& triangle, std::int32_t number,
                      const Vec2d& place) {
  std::array<Vec2d, 3> p;
  std::array<const FrameVertex*, 3> corners{};
  for (int c = 0; c < 3; ++c) {
    p[c] = triangle.corners[c].place;
    corners[c] = &framed.vertices[framed.indices[3 * static_cast<std::size_t>(number) + static_cast<std::size_t>(c)]];
  }
  Vec3d weights = TriangleTile::weights_in(p, place);
  for (int c = 0; c < 3; ++c) weights[c] = std::max(weights[c], 0.0);
  const double sum = weights.x + weights.y + weights.z;
  return shading_frame(corners, sum > 0 ? weights / sum : Vec3d(1, 0, 0));
}

std::vector<std::vector<std::int32_t>> triangles_by_patch(const ChartedSurface& surface, std::int32_t patches) {
  std::vector<std::vector<std::int32_t>> lists(static_cast<std::size_t>(patches));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    lists[surface.triangles[t].patch].push_back(static_cast<std::int32_t>(t));
  }
  return lists;
}

/// In object space.
struct SourceNormals {
  BakedMap textured;
  BakedMap shading;  ///< without those of textures
};

SourceNormals bake_in_object_space(AtlasBaker& baker) {
  SourceNormals made{baker.neutral(MapKind::kObjectNormal), baker.neutral(MapKind::kObjectNormal)};
  baker.bake_inner_texels("baking the source's normals", [&](const AtlasPlace& place, std::size_t texel, BakeTally&) {
    const SourceFootprint footprint = baker.footprint(place);
    store(made.textured, texel, Vec3f(baker.look().normal(footprint)));
    store(made.shading, texel, baker.normals().at(footprint.at.triangle, footprint.at.weights));
  });
  baker.continue_beyond_borders(made.textured);
  baker.continue_beyond_borders(made.shading);
  return made;
}

/// The frame with the normal of the texel's own side of a hard edge, whichever side the renderer's is of: so that what
/// a filter mixes there is how normals differ from the shading, not the edge.
ShadingFrame with_normal(ShadingFrame frame, const Vec3d& normal) {
  const Vec3d tangent = frame.tangent - normal * normal.dot(frame.tangent);
  constexpr double kAlong = 1e-6;
  if (!(normal.length() > 0) || !(tangent.length() > kAlong)) return frame;
  frame.normal = normal;
  frame.tangent = tangent.normalized();
  frame.bitangent = normal.cross(frame.tangent) * static_cast<double>(kBitangentSign);
  return frame;
}

}  // namespace

BakedMap bake_source_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                             const GeometryImage& image) {
  const SourceNormals source = bake_in_object_space(baker);
  const Atlas& atlas = baker.atlas();
  const ChartedSurface surface = source_level(mesh, map, image.layout, atlas.layout());
  const FramedSurface framed = framed_surface(surface, atlas.layout());
  const auto triangles = triangles_by_patch(surface, atlas.patches());
  BakedMap normals = baker.neutral(MapKind::kSourceNormal);
  for_each_index(triangles.size(), true, [&](std::size_t p) {
    const auto patch = static_cast<std::int32_t>(p);
    const MapTile& tile = atlas.tile(patch);
    TriangleTile seen(tile, atlas.last(patch));
    for (const std::int32_t t : triangles[p]) seen.draw(surface.triangles[t], t);
    seen.spread();
    for (std::int32_t y = -tile.gutter; y < tile.size - tile.gutter; ++y) {
      for (std::int32_t x = -tile.gutter; x < tile.size - tile.gutter; ++x) {
        const std::int32_t t = seen.at(x, y);
        if (t == kNone) continue;
        const AtlasPlace place{patch, static_cast<double>(x), static_cast<double>(y)};
        const std::size_t texel = atlas.texel_of(place);
        const ShadingFrame frame = with_normal(frame_at(framed, surface.triangles[t], t, atlas.share_of(place)),
                                               Vec3d(load(source.shading, texel)));
        store(normals, texel, Vec3f(frame.to_texel(Vec3d(load(source.textured, texel)))));
      }
    }
  });
  return normals;
}

}  // namespace lozenge
