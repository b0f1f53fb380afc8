// Reads back the glTF binary that `export` writes, the way an engine does: levels of detail, material, decoded
// textures.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/map_kinds.h"
#include "formats/surface/attribute.h"
#include "formats/surface/bodies.h"
#include "formats/surface/rig.h"
#include "formats/surface/surface_view.h"

namespace lozenge {

/// What of a level the scene places as one.
struct AssetPart {
  std::size_t first_vertex = 0;
  std::size_t vertices = 0;
  std::size_t first_triangle = 0;
  std::size_t triangles = 0;
  std::vector<Placement> places;    ///< from the part's own space to the scene, at rest
  std::vector<Imath::M44d> joints;  ///< instead, of each joint, where a skin places it; else empty
  std::vector<std::int32_t> nodes;  ///< [place] of the rig, that moves it, or -1; of a skin, where weights are animated
  std::int32_t skin = -1;           ///< of the rig, or -1
  std::vector<MorphTarget> targets;  ///< what the first so many targets of the level are to it
  std::vector<double> weights;       ///< of those, in a pose; at rest none, and the surface stands without them
  std::string name;                  ///< of its first node
};

/// What a morph target does to all vertices of a level, [vertex]; nothing where its part has fewer.
struct AssetTarget {
  std::vector<Vec3f> offsets;
  std::vector<Vec3f> normals;   ///< differences; empty where no part has any
  std::vector<Vec3f> tangents;  ///< the same
};

/// One level of detail of all parts, each once, in its own space (`at_rest` has them in the scene's).
struct AssetLevel {
  std::string name;
  std::vector<Vec3f> positions;  ///< [vertex]
  std::vector<Vec3f> normals;    ///< [vertex], empty where the file has none
  std::vector<Vec4f> tangents;   ///< [vertex], w the sign of the bitangent; empty where the file has none
  std::vector<Vec2f> uvs;        ///< [vertex], glTF's convention (v down); empty where the file has none
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<float> influences;     ///< elements of `kInfluences`, [vertex]; empty where nothing has a skin
  std::vector<AssetTarget> targets;  ///< as many as the part with the most has
  std::int32_t material = -1;
  /// [triangle], where not all have one; else empty, and `material` is theirs. Of a level with triangles of the
  /// source's own and resampled ones.
  std::vector<std::int32_t> materials;
  std::vector<AssetPart> parts;

  const float* influence(std::size_t vertex) const { return &influences[kInfluences.components * vertex]; }

  std::int32_t material_of(TriangleId t) const { return materials.empty() ? material : materials[t]; }

  SurfaceView view() const { return {positions, triangles}; }
};

/// One texture, decoded: values 0..1 (integers divided by their largest), row by row from the top.
struct AssetTexture {
  std::string name;
  std::string mime_type;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t channels = 0;
  std::int32_t bits = 0;  ///< a channel, as stored
  std::vector<float> pixels;
};

struct AssetMaterial {
  std::string name;
  std::array<std::int32_t, kMaterialSlots> textures;  ///< [slot] index of a texture, or -1
  double normal_scale = 1;
  Vec3d base_colour{1, 1, 1};  ///< linear; multiplies the texture's
  bool double_sided = false;

  AssetMaterial() { textures.fill(-1); }
  std::int32_t texture(MaterialSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
  std::int32_t& texture(MaterialSlot slot) { return textures[static_cast<std::size_t>(slot)]; }
};

/// By how much rounding to integers may have moved what vertices have; 0 where all are floats.
struct AssetRounding {
  double position = 0;   ///< in the scene, along each axis
  double direction = 0;  ///< of a component of a unit vector
  double texcoord = 0;
};

/// What the engine loads. Level 0 is the finest.
struct Asset {
  std::vector<AssetLevel> levels;
  std::vector<AssetMaterial> materials;
  std::vector<AssetTexture> textures;
  Rig rig;  ///< what moves its parts
  std::string scene_name;
  std::string generator;
  AssetRounding rounding;
  Vec3d translation{0, 0, 0};     ///< what places are counted from in the scene, as the file says
  std::int32_t samples = 0;       ///< a side of each patch in level 0, as the file says; 0 where it doesn't
  std::int32_t half_patches = 0;  ///< whose diagonals are the surface's boundary; 0 where it is closed
  /// [level] sides of triangles on the surface's boundary, as the file says; empty where it doesn't.
  std::vector<std::int32_t> boundary_sides;
  std::int32_t source_triangles = 0;  ///< of level 0, that are the source's own, as the file says
  bool is_fitted = false;             ///< its levels are the source's triangles or fitted to them, not samples
  std::int32_t cap_triangles = 0;     ///< left out of its levels, so that holes are open; 0 where all is there
};

/// \throws Error(kUnusableInput) where the file is broken, an index is out of range, a texture cannot be decoded, or
///         the levels of a part aren't in one place, or not the same in all places;
///         Error(kUnsupported) where it is a glTF that Lozenge didn't write (more meshes than it says, ...)
Asset read_asset(const std::filesystem::path& path);
/// The same without textures and materials, for who asks for shapes alone.
Asset read_asset_shapes(const std::filesystem::path& path);

/// Bilinear look-up as an engine does it, repeating at the borders; `channels` values 0..1 (at most 4).
std::array<float, 4> sample_texture(const AssetTexture& texture, const Vec2d& uv);

/// Unit normal of the surface in the frame of the asset: the tangent-space normal of `material`'s normal map at a point
/// of triangle `t`, turned by the interpolated tangent frame. Without a map, the interpolated normal.
Vec3f mapped_normal(const Asset& asset, const AssetLevel& level, TriangleId t, const Vec3d& weights);

}  // namespace lozenge
