// Every picture is the same studio (tracer.h) with another answer to "what does the surface look like here?".
#include "stages/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/base/srgb.h"
#include "formats/domain/development.h"
#include "formats/patches/level_mesh.h"
#include "formats/patches/tangent_frame.h"
#include "stages/render/canvas.h"
#include "stages/render/palette.h"
#include "stages/render/source_studio.h"
#include "stages/render/tracer.h"

namespace lozenge {

namespace {

constexpr double kWireWidth = 1.15;   ///< pixels
constexpr double kBorderWidth = 2.2;  ///< pixels, of the domain's edges
const Vec3f kWireColour = srgb(0x23303B);
const Vec3f kBorderColour = srgb(0x2A2F36);

Vec3f mixed(const Vec3f& a, const Vec3f& b, double share) { return a + (b - a) * static_cast<float>(share); }

std::vector<Vec3f> smooth_normals(const SurfaceView& surface) {
  SourceMesh mesh;
  mesh.positions.assign(surface.positions.begin(), surface.positions.end());
  mesh.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  return vertex_normals(mesh);
}

Vec3d interpolated(const std::vector<Vec3f>& normals, const std::array<VertexId, 3>& corners, const Vec3d& weights) {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3; ++c) sum += Vec3d(normals[corners[c]]) * weights[c];
  return sum.length() > 0 ? sum.normalized() : Vec3d(0, 0, 1);
}

/// How much of a pixel the nearest edge of the triangle covers. Where triangles are as small as the lines, the lines
/// fade into a tone instead of turning black.
double wire_cover(const SurfaceView& surface, const SurfaceHit& hit, const Camera& camera) {
  std::array<Vec2d, 3> p;
  for (int c = 0; c < 3; ++c) p[c] = camera.pixel(Vec3d(surface.positions[surface.triangles[hit.triangle][c]]));
  double nearest = 1e30;
  double longest = 0;
  for (int c = 0; c < 3; ++c) {
    const Vec2d e = p[(c + 1) % 3] - p[c];
    const Vec2d f = hit.pixel - p[c];
    longest = std::max(longest, e.length());
    if (e.length() > 0) nearest = std::min(nearest, std::abs(e.x * f.y - e.y * f.x) / e.length());
  }
  const double fade = std::clamp(longest / 9, 0.25, 1.0);
  return fade * std::clamp(kWireWidth / 2 + 0.5 - nearest, 0.0, 1.0);
}

/// The triangles of a mesh laid out on the domain.
class DomainImages {
 public:
  DomainImages(const SourceMesh& mesh, const Parameterization& map) : map_(map), images_(mesh.triangles.size()) {
    for_each_part(images_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) images_[t] = image_of(mesh, map, static_cast<TriangleId>(t));
    });
    const double area = surface_area(mesh.positions, mesh.triangles);
    side_ = std::sqrt(area / (std::max(scaled_size(map), 1.0) * std::sqrt(3.0) / 4));
  }

  /// Where a point of a source triangle lies on the domain; nothing where the map is broken there.
  std::optional<std::pair<DomainTriangleId, LatticePoint>> place(TriangleId t, const Vec3d& weights) const {
    if (!images_[t]) return std::nullopt;
    const auto& c = images_[t]->corners;
    double u = 0;
    double v = 0;
    for (int i = 0; i < 3; ++i) {
      u += static_cast<double>(c[i].u) * weights[i];
      v += static_cast<double>(c[i].v) * weights[i];
    }
    DomainTriangleId triangle = images_[t]->home;
    LatticePoint p{std::llround(u), std::llround(v)};
    // A corner of the image is at most a few triangles away from its home.
    constexpr int kMostSteps = 16;
    for (int step = 0; step < kMostSteps && !in_triangle(p); ++step) {
      const int side = p.v < 0 ? 0 : p.u < 0 ? 2 : 1;
      const DomainSide next = map_.domain.neighbour({triangle, side});
      if (!next.exists()) break;
      p = inverse(transition(side, next.side))(p);
      triangle = next.triangle;
    }
    return std::pair(triangle, p);
  }

  /// Image area at its part's scale, in triangles of the largest scale; 0 where there is no image.
  double scaled_area_of(TriangleId t) const {
    if (!images_[t]) return 0;
    const LatticeArea doubled = doubled_area(images_[t]->corners[0], images_[t]->corners[1], images_[t]->corners[2]);
    return static_cast<double>(doubled) / static_cast<double>(kUnitTriangleDoubledArea) *
           area_at_level(map_.first_level(images_[t]->home));
  }

  /// About how long a domain edge is on the surface, asset's units.
  double side() const { return side_; }

 private:
  const Parameterization& map_;
  std::vector<std::optional<Development>> images_;
  double side_ = 1;
};

/// Distance to the nearest side in units of a side.
double distance_to_border(const LatticePoint& p) {
  const std::int64_t nearest = std::max<std::int64_t>(std::min({p.u, p.v, kLatticeOne - p.u - p.v}), 0);
  return static_cast<double>(nearest) / static_cast<double>(kLatticeOne) * std::sqrt(3.0) / 2;
}

std::vector<std::vector<std::int32_t>> triangles_around_vertices(const Domain& domain) {
  std::vector<std::vector<std::int32_t>> groups(static_cast<std::size_t>(domain.vertex_count));
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (const DomainVertex v : domain.triangles[t].corners) groups[v].push_back(t);
  }
  return groups;
}

/// Patches that meet at a domain vertex or share a domain triangle.
std::vector<std::vector<std::int32_t>> patches_that_meet(const std::vector<PatchPlace>& places) {
  DomainVertex vertices = 0;
  DomainTriangleId triangles = 0;
  for (const PatchPlace& p : places) {
    vertices = std::max({vertices, p.a + 1, p.b + 1});
    triangles = std::max({triangles, p.left.triangle + 1, p.right.triangle + 1});
  }
  std::vector<std::vector<std::int32_t>> groups(static_cast<std::size_t>(vertices) + triangles);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto patch = static_cast<std::int32_t>(i);
    groups[places[i].a].push_back(patch);
    groups[places[i].b].push_back(patch);
    groups[static_cast<std::size_t>(vertices) + places[i].left.triangle].push_back(patch);
    if (places[i].right.exists())
      groups[static_cast<std::size_t>(vertices) + places[i].right.triangle].push_back(patch);
  }
  return groups;
}

void require_level(const GeometryImage& image, std::int32_t level) {
  if (level >= 0 && level < static_cast<std::int32_t>(image.levels.size())) return;
  throw Error(ExitCode::kUsage, fmt::format("the geometry image has no level {}; it has 0 to {}", level,
                                            static_cast<int>(image.levels.size()) - 1));
}

/// A level's welded mesh with its normals at the vertices.
struct Level {
  LevelMesh mesh;
  std::vector<Vec3f> normals;

  Level(const GeometryImage& image, std::int32_t level) {
    require_level(image, level);
    mesh = level_mesh(image, level);
    normals.resize(mesh.positions.size());
    for (std::int32_t p = 0; p < image.size(); ++p) {
      for (std::int32_t j = 0; j < mesh.grids.samples(p); ++j) {
        for (std::int32_t i = 0; i < mesh.grids.samples(p); ++i) {
          const std::int32_t v = mesh.vertex(p, i, j);
          if (v >= 0) normals[v] = image.normal(level, p, i, j);
        }
      }
    }
  }
};

/// A map as the texture that an engine would have, without the rounding to bits.
AssetTexture texture_of(const BakedMap& map) {
  AssetTexture texture;
  texture.width = map.width();
  texture.height = map.height();
  texture.channels = map.channels;
  texture.bits = 32;
  texture.pixels = map.texels;
  for (std::size_t i = 0; i < texture.pixels.size(); ++i) {
    const auto channel = static_cast<std::int32_t>(i % map.channels);
    texture.pixels[i] = static_cast<float>(stored_share(traits_of(map.kind), channel, map.texels[i]));
  }
  return texture;
}

/// Vertices of a level in the frames of the level that the map was baked for, as the exporter stores them: of a coarser
/// level every second one, or fourth, ...; a finer level has frames of its own.
FrameVertices frames_of(const GeometryImage& image, std::int32_t level, const BakedMap& map) {
  const bool has_baked_level = map.level >= 0 && map.level < static_cast<std::int32_t>(image.levels.size());
  if (!has_baked_level || level <= map.level) return frame_vertices(image, level, map.layout);
  const FrameVertices finer = frame_vertices(image, map.level, map.layout);
  FrameVertices coarser;
  coarser.grids = PatchGrids(image.layout, level);
  for (std::int32_t p = 0; p < image.size(); ++p) {
    const std::int32_t samples = coarser.grids.samples(p);
    const std::int32_t step = (finer.grids.samples(p) - 1) / (samples - 1);
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < samples; ++i) coarser.vertices.push_back(finer.at(p, i * step, j * step));
    }
  }
  return coarser;
}

/// One level of detail as an engine would have it: a vertex for each sample that a patch has.
AssetLevel engine_level(const GeometryImage& image, std::int32_t level, const FrameVertices& frames) {
  AssetLevel geometry;
  geometry.material = 0;
  std::vector<VertexId> vertices;  // of the current patch
  for (std::int32_t p = 0; p < image.size(); ++p) {
    const bool half = !image.layout.places[p].right.exists();
    const std::int32_t n = frames.grids.samples(p);
    vertices.assign(static_cast<std::size_t>(n) * n, -1);
    for (std::int32_t j = 0; j < n; ++j) {
      for (std::int32_t i = 0; i < (half ? j + 1 : n); ++i) {
        vertices[static_cast<std::size_t>(j) * n + i] = static_cast<VertexId>(geometry.positions.size());
        const FrameVertex& frame = frames.at(p, i, j);
        geometry.positions.push_back(image.position(level, p, i, j));
        geometry.normals.push_back(frame.normal);
        geometry.tangents.push_back(frame.tangent_with_sign());
        geometry.uvs.push_back(frame.texcoord);
      }
    }
    for_each_patch_triangle(n, half, [&](const auto& a, const auto& b, const auto& c) {
      const auto id = [&](const auto& s) { return vertices[static_cast<std::size_t>(s[1]) * n + s[0]]; };
      geometry.triangles.push_back({id(a), id(b), id(c)});
    });
  }
  return geometry;
}

Asset asset_of(const GeometryImage& image, std::int32_t level, const BakedMaps& maps) {
  const BakedMap* normal = maps.find_in_level_frames();
  if (!normal) throw Error(ExitCode::kUsage, "there is no tangent-space normal map to draw; bake one");
  if (!normal->layout.fits(image.layout)) {
    throw Error(ExitCode::kUnusableInput, "the normal map is of another atlas than the geometry image; bake it again");
  }
  Asset asset;
  AssetMaterial material;
  for (const BakedMap& map : maps.maps) {
    const auto& slots = traits_of(map.kind).slots;
    // What is drawn is resampled: the source's frames are none of its.
    if (slots.front() == MaterialSlot::kNone || traits_of(map.kind).frames == Frames::kSource) continue;
    for (const MaterialSlot slot : slots) {
      if (slot != MaterialSlot::kNone) material.texture(slot) = static_cast<std::int32_t>(asset.textures.size());
    }
    asset.textures.push_back(texture_of(map));
  }
  asset.materials.push_back(material);
  asset.levels.push_back(engine_level(image, level, frames_of(image, level, *normal)));
  return asset;
}

}  // namespace

Vec3f distortion_colour(double ratio) {
  // By the logarithm, so that a factor and its inverse weigh the same.
  const double share = std::clamp(std::log2(std::max(ratio, 1e-30)), -1.0, 1.0);
  const Vec3f white(1, 1, 1);
  return share < 0 ? mixed(white, Vec3f(0, 0, 1), -share) : mixed(white, Vec3f(1, 0, 0), share);
}

Picture render_surface(const SurfaceView& surface, bool wires, const RenderOptions& options) {
  const std::vector<Vec3f> normals = smooth_normals(surface);
  const LookFunction look = [&](const SurfaceHit& hit, const Camera& camera) {
    Look result;
    result.normal = interpolated(normals, surface.triangles[hit.triangle], hit.weights);
    result.albedo = wires ? mixed(clay(), kWireColour, wire_cover(surface, hit, camera)) : clay();
    return result;
  };
  return trace(surface, normals, look, options);
}

SourceStudio::SourceStudio(const SourceMesh& mesh, const RenderOptions& options)
    : mesh_(mesh), shading_(mesh), studio_({mesh.positions, mesh.triangles}, vertex_normals(mesh), options) {}

Picture SourceStudio::shaded(const SourceColour& colour) const {
  return studio_.picture([&](const SurfaceHit& hit, const Camera&) {
    return Look{Vec3d(shading_.at(hit.triangle, hit.weights)), colour ? colour(hit.triangle, hit.weights) : clay()};
  });
}

Picture render_shaded(const GeometryImage& image, std::int32_t level, const RenderOptions& options) {
  const Level shown(image, level);
  const LookFunction look = [&](const SurfaceHit& hit, const Camera&) {
    return Look{interpolated(shown.normals, shown.mesh.triangles[hit.triangle], hit.weights), clay()};
  };
  return trace(shown.mesh.view(), shown.normals, look, options);
}

Picture SourceStudio::patches(const Parameterization& map) const {
  const DomainImages images(mesh_, map);
  const std::vector<std::int32_t> colours = colour_items(map.domain.size(), triangles_around_vertices(map.domain));
  const LookFunction look = [&](const SurfaceHit& hit, const Camera& camera) {
    Look result{Vec3d(shading_.at(hit.triangle, hit.weights)), kBorderColour};
    if (const auto place = images.place(hit.triangle, hit.weights)) {
      const double distance = distance_to_border(place->second) * images.side() / camera.pixel_size(hit.point);
      const double border = std::clamp(kBorderWidth / 2 + 0.5 - distance, 0.0, 1.0);
      result.albedo = mixed(patch_colour(colours[place->first]), kBorderColour, 0.8 * border);
    }
    return result;
  };
  return studio_.picture(look);
}

Picture render_patches(const GeometryImage& image, std::int32_t level, const RenderOptions& options) {
  const Level shown(image, level);
  const std::vector<std::int32_t> colours = colour_items(image.size(), patches_that_meet(image.layout.places));
  const LookFunction look = [&](const SurfaceHit& hit, const Camera&) {
    return Look{interpolated(shown.normals, shown.mesh.triangles[hit.triangle], hit.weights),
                patch_colour(colours[shown.mesh.patches[hit.triangle]])};
  };
  return trace(shown.mesh.view(), shown.normals, look, options);
}

Picture SourceStudio::distortion(const Parameterization& map) const {
  const DomainImages images(mesh_, map);
  std::vector<double> areas(mesh_.triangles.size());
  double total = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    areas[t] = triangle_area(mesh_.positions, mesh_.triangles[t]);
    total += areas[t];
  }
  std::vector<Vec3f> colours(areas.size());
  const double domain_area = scaled_size(map);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const double image_share = images.scaled_area_of(static_cast<TriangleId>(t)) / domain_area;
    colours[t] = distortion_colour(areas[t] > 0 ? image_share * total / areas[t] : 1);
  }
  const LookFunction look = [&](const SurfaceHit& hit, const Camera&) {
    // Pure colours are dark beside white: a little of the clay's brightness keeps forms readable.
    return Look{Vec3d(shading_.at(hit.triangle, hit.weights)),
                mixed(colours[hit.triangle], Vec3f(1, 1, 1), 0.04) * 0.66F};
  };
  return studio_.picture(look);
}

Picture render_shaded(const SourceMesh& mesh, const RenderOptions& options) {
  return SourceStudio(mesh, options).shaded();
}

Picture render_patches(const SourceMesh& mesh, const Parameterization& map, const RenderOptions& options) {
  return SourceStudio(mesh, options).patches(map);
}

Picture render_distortion(const SourceMesh& mesh, const Parameterization& map, const RenderOptions& options) {
  return SourceStudio(mesh, options).distortion(map);
}

Picture render_wires(const GeometryImage& image, std::int32_t level, const RenderOptions& options) {
  const Level shown(image, level);
  const LookFunction look = [&](const SurfaceHit& hit, const Camera& camera) {
    const double cover = wire_cover(shown.mesh.view(), hit, camera);
    return Look{interpolated(shown.normals, shown.mesh.triangles[hit.triangle], hit.weights),
                mixed(clay(), kWireColour, cover)};
  };
  return trace(shown.mesh.view(), shown.normals, look, options);
}

namespace {

/// Linear; clay where nobody made a colour.
Vec3f colour_of(const Asset& asset, const AssetMaterial& material, const Vec2d& uv) {
  const Vec3d& factor = material.base_colour;
  const std::int32_t map = material.texture(MaterialSlot::kBaseColour);
  if (map < 0 && factor.x == factor.y && factor.x == factor.z) return clay();
  if (map < 0) return Vec3f(factor);
  const std::array<float, 4> texel = sample_texture(asset.textures[map], uv);
  const auto channel = [&](int c) {
    const int of_texel = asset.textures[map].channels < 3 ? 0 : c;
    return static_cast<float>(factor[c] * linear_of_srgb(std::clamp<double>(texel[of_texel], 0, 1)));
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

Picture render_baked(const Asset& asset, std::int32_t level, const RenderOptions& options) {
  if (level < 0 || level >= static_cast<std::int32_t>(asset.levels.size())) {
    throw Error(ExitCode::kUsage, fmt::format("the asset has no level {}; it has 0 to {}", level,
                                              static_cast<int>(asset.levels.size()) - 1));
  }
  const AssetLevel& shown = asset.levels[level];
  const std::vector<Vec3f> normals = shown.normals.empty() ? smooth_normals(shown.view()) : shown.normals;
  const LookFunction look = [&](const SurfaceHit& hit, const Camera&) {
    Look result{Vec3d(0, 0, 1), clay()};
    const std::int32_t number = shown.material_of(hit.triangle);
    const auto& corners = shown.triangles[hit.triangle];
    result.normal = shown.normals.empty() ? interpolated(normals, corners, hit.weights)
                                          : Vec3d(mapped_normal(asset, shown, hit.triangle, hit.weights));
    if (number < 0) return result;
    const AssetMaterial& material = asset.materials[number];
    Vec2d uv(0, 0);
    for (int c = 0; c < 3 && !shown.uvs.empty(); ++c) uv += Vec2d(shown.uvs[corners[c]]) * hit.weights[c];
    result.albedo = colour_of(asset, material, uv);
    if (const std::int32_t occlusion = material.texture(MaterialSlot::kOcclusion); occlusion >= 0) {
      result.occlusion = std::sqrt(std::clamp<double>(sample_texture(asset.textures[occlusion], uv)[0], 0, 1));
    }
    return result;
  };
  return trace(shown.view(), normals, look, options);
}

Picture render_baked(const GeometryImage& image, std::int32_t level, const BakedMaps& maps,
                     const RenderOptions& options) {
  require_level(image, level);
  return render_baked(asset_of(image, level, maps), 0, options);
}

}  // namespace lozenge
