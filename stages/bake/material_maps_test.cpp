// Textures of known functions, on a sphere of a known map.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/atlas.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/shrunk_atlas.h"
#include "formats/surface/attribute_streams.h"
#include "stages/bake/bake.h"
#include "stages/bake/projector.h"

namespace lozenge {
namespace {

/// A texture that shows its own coordinates, and in alpha 1; counts footprints that are larger than a texel.
class Coordinates : public Textures {
 public:
  Vec4f look_up(const TextureUse&, TextureRole role, const TextureFootprint& at) const override {
    if (role == TextureRole::kNormal) return {0.5F, 0.5F, 1, 1};
    return {static_cast<float>(at.place.x), static_cast<float>(at.place.y), 0.5F, 1};
  }
  bool can_look_up(const TextureUse&, TextureRole) const override { return true; }
};

struct Case {
  SourceMesh mesh;
  Parameterization map;
  GeometryImage image;
};

/// Texture coordinates are linear in x and y: 0.5 + 0.4 x.
Case textured_sphere() {
  const Domain base = fixtures::icosahedron();
  auto [mesh, map] = fixtures::subdivided_sphere(base, 12);
  fixtures::jitter(map, 0.01, 5);
  AttributeStream& uv = stream_for(mesh.corner_attributes, kTextureCoordinates);
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) {
      uv.values.push_back(0.5F + 0.4F * mesh.positions[v].x);
      uv.values.push_back(0.5F + 0.4F * mesh.positions[v].y);
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.material_names = {"paint"};
  mesh.material_looks.resize(1);
  mesh.images.push_back({"coordinates", "image/png", nullptr});
  for (const TextureRole role : {TextureRole::kBaseColour, TextureRole::kMetallicRoughness, TextureRole::kEmissive}) {
    mesh.material_looks[0].texture(role).image = 0;
  }
  mesh.material_looks[0].emissive = {1, 0.5, 1};
  return {std::move(mesh), std::move(map), fixtures::sphere_image(base, 3)};
}

BakeOptions small(std::vector<MapKind> maps = {}) {
  BakeOptions options;
  options.maps = std::move(maps);
  options.size = 320;
  options.occlusion_size = 80;
  options.occlusion_rays = 4;
  return options;
}

/// Calls `visit(texel of the map, the source's position there)` for all inner texels.
template <typename Visit>
void for_each_inner_texel(const Case& c, const BakedMap& map, const BakedMap& positions, const Visit& visit) {
  for (std::int32_t patch = 0; patch < c.image.size(); ++patch) {
    const MapTile tile = map.layout.tile_of(patch);
    for (std::int32_t y = tile.y + tile.gutter; y < tile.y + tile.gutter + tile.inner(); ++y) {
      for (std::int32_t x = tile.x + tile.gutter; x < tile.x + tile.gutter + tile.inner(); ++x) {
        const std::size_t texel = static_cast<std::size_t>(y) * map.layout.width + x;
        const float* p = &positions.texels[3 * texel];
        visit(&map.texels[texel * map.channels], Vec3d(p[0], p[1], p[2]));
      }
    }
  }
}

TEST(MaterialMaps, EveryTexelHasTheTextureOfItsOwnSourcePoint) {
  const Case c = textured_sphere();
  const Coordinates textures;
  const BakedMaps maps = bake(c.mesh, c.map, c.image,
                              small({MapKind::kBaseColour, MapKind::kPosition, MapKind::kEmissive}), {}, &textures);
  EXPECT_EQ(maps.maps[0].channels, 3) << "opaque";
  // The mean over a texel that straddles triangles is that of its middle but for the edges' bend.
  constexpr double kBend = 2e-3;
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* colour, const Vec3d& p) {
    EXPECT_NEAR(colour[0], 0.5 + 0.4 * p.x, kBend);
    EXPECT_NEAR(colour[1], 0.5 + 0.4 * p.y, kBend);
  });
  for_each_inner_texel(c, maps.maps[2], maps.maps[1], [&](const float* light, const Vec3d& p) {
    EXPECT_NEAR(light[0], 0.5 + 0.4 * p.x, kBend);
    EXPECT_NEAR(light[1], 0.5 * (0.5 + 0.4 * p.y), kBend);
  });
}

TEST(MaterialMaps, WhatTheSourceHasIsBakedWhereNobodyAsksForOtherMaps) {
  Case c = textured_sphere();
  using Kinds = std::vector<MapKind>;
  EXPECT_EQ(usual_maps({}, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kOcclusionRoughnessMetal,
                                           MapKind::kBaseColour, MapKind::kEmissive}));
  c.mesh.material_looks[0] = Material();
  EXPECT_EQ(usual_maps({}, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kOcclusion})) << "factors need no map";
}

/// The same everywhere, but for half a step of 8 bits.
class Plain : public Textures {
 public:
  Vec4f look_up(const TextureUse&, TextureRole, const TextureFootprint& at) const override {
    const auto noise = static_cast<float>(1e-4 * at.place.x);
    return {0.5F + noise, 0.25F + noise, 0.75F, 1};
  }
  bool can_look_up(const TextureUse&, TextureRole) const override { return true; }
};

TEST(MaterialMaps, WhatIsTheSameEverywhereIsANumberAndNoMapUnlessItIsAskedFor) {
  Case c = textured_sphere();
  c.mesh.material_looks[0].metallic = 0.5;
  const Plain textures;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small(), {}, &textures);
  ASSERT_EQ(maps.maps.size(), 1) << "normals";
  const std::vector<ConstantMap> constants = maps.constants();
  using Kinds = std::vector<MapKind>;
  const Kinds kinds{MapKind::kOcclusionRoughnessMetal, MapKind::kBaseColour, MapKind::kEmissive};
  EXPECT_EQ(maps.statistics.constant_maps, kinds);
  ASSERT_EQ(constants.size(), 3);
  constexpr double kNoise = 2e-4;
  EXPECT_NEAR(constants[0].value[1], 0.25, kNoise);
  EXPECT_NEAR(constants[0].value[2], 0.5 * 0.75, kNoise);
  EXPECT_NEAR(constants[1].value[0], 0.5, kNoise);
  EXPECT_EQ(constants[1].value[3], 1) << "opaque";
  EXPECT_NEAR(constants[2].value[1], 0.5 * 0.25, kNoise);
  EXPECT_EQ(bake(c.mesh, c.map, c.image, small(kinds), {}, &textures).maps.size(), 3);
}

TEST(MaterialMaps, OcclusionThatIsTheSameEverywhereButNotAllLightHasNoFactor) {
  Case c = textured_sphere();
  c.mesh.material_looks[0].texture(TextureRole::kOcclusion).image = 0;
  const Plain textures;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small(), {}, &textures);
  EXPECT_NE(maps.find(MapKind::kOcclusionRoughnessMetal), nullptr);
  EXPECT_EQ(maps.find(MapKind::kBaseColour), nullptr);
}

TEST(MaterialMaps, AMapOfItsOwnSizeHoldsTheMeansOfTheAtlass) {
  const Case c = textured_sphere();
  const Coordinates textures;
  BakeOptions options = small({MapKind::kBaseColour, MapKind::kTangentNormal});
  const BakedMaps whole = bake(c.mesh, c.map, c.image, options, {}, &textures);
  options.sizes = {{MapKind::kBaseColour, 160}, {MapKind::kTangentNormal, 80}};
  const BakedMaps parts = bake(c.mesh, c.map, c.image, options, {}, &textures);
  ASSERT_EQ(parts.maps[0].shrink, 2);
  ASSERT_EQ(parts.maps[1].shrink, 4);
  EXPECT_EQ(parts.maps[0].layout, whole.maps[0].layout);
  for (const BakedMap& map : parts.maps) {
    const BakedMap& from = whole.maps[&map - parts.maps.data()];
    const Atlas atlas(c.image, map.layout);
    const ShrunkAtlas shrunk(atlas, map.shrink);
    for (std::int32_t y = 0; y < map.height(); ++y) {
      for (std::int32_t x = 0; x < map.width(); ++x) {
        Vec3d sum(0, 0, 0);
        for (std::int32_t j = 0; j < map.shrink; ++j) {
          for (std::int32_t i = 0; i < map.shrink; ++i) {
            const float* texel =
                &from.texels[3 * (static_cast<std::size_t>(y * map.shrink + j) * from.width() + x * map.shrink + i)];
            sum += Vec3d(texel[0], texel[1], texel[2]) / (map.shrink * map.shrink);
          }
        }
        // Beyond borders, mixes of others are (formats/patches/shrunk_atlas.h).
        if (const AtlasPlace place = shrunk.place_of(x, y); place.patch >= 0 && !shrunk.is_own(place)) continue;
        if (map.kind == MapKind::kTangentNormal) sum.normalize();
        const float* texel = &map.texels[3 * (static_cast<std::size_t>(y) * map.width() + x)];
        ASSERT_NEAR((Vec3d(texel[0], texel[1], texel[2]) - sum).length(), 0, 1e-6) << x << ", " << y;
      }
    }
  }
}

TEST(MaterialMaps, ASizeThatWouldMixTilesBecomesTheNextLarger) {
  const Case c = textured_sphere();
  const Coordinates textures;
  BakeOptions options = small({MapKind::kBaseColour});
  options.gutter = 2;
  options.sizes = {{MapKind::kBaseColour, 20}};
  EXPECT_EQ(bake(c.mesh, c.map, c.image, options, {}, &textures).maps[0].width(), 160) << "two texels of gutter";
}

TEST(MaterialMaps, OcclusionIsBakedIntoALookThatSomeoneMadeOnlyWhereItIsAskedFor) {
  Case c = textured_sphere();
  using Kinds = std::vector<MapKind>;
  c.mesh.material_looks[0] = Material();
  stream_for(c.mesh.corner_attributes, kColors).values.assign(12 * c.mesh.triangles.size(), 0.5F);
  EXPECT_EQ(usual_maps({}, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kBaseColour}));
  BakeOptions baked;
  baked.occlusion = OcclusionOf::kBaked;
  EXPECT_EQ(usual_maps(baked, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kOcclusion, MapKind::kBaseColour}));
}

TEST(MaterialMaps, ALookIsMadeByPaintToo) {
  Case c = textured_sphere();
  using Kinds = std::vector<MapKind>;
  Material& paint = c.mesh.material_looks[0];
  paint = Material();
  paint.base_colour = {0.4, 0.4, 0.4, 1};
  EXPECT_EQ(usual_maps({}, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kOcclusion})) << "grey, as tools give it";
  paint.base_colour = {0.4, 0.3, 0.2, 1};
  EXPECT_EQ(usual_maps({}, c.mesh), Kinds{MapKind::kTangentNormal});
}

TEST(MaterialMaps, ColoursOfVerticesMultiplyTexturesAndFactors) {
  Case c = textured_sphere();
  c.mesh.material_looks[0].base_colour = {0.5, 1, 1, 1};
  AttributeStream& colours = stream_for(c.mesh.corner_attributes, kColors);
  for (std::size_t corner = 0; corner < 3 * c.mesh.triangles.size(); ++corner) {
    colours.values.insert(colours.values.end(), {0.5F, 0.25F, 1, 1});
  }
  const Coordinates textures;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kBaseColour, MapKind::kPosition}), {}, &textures);
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* colour, const Vec3d& p) {
    EXPECT_NEAR(colour[0], 0.25 * (0.5 + 0.4 * p.x), 1e-3);
    EXPECT_NEAR(colour[1], 0.25 * (0.5 + 0.4 * p.y), 1e-3);
  });
}

TEST(MaterialMaps, MaterialsMeetWithoutMixingButOnTexelsThatBothCover) {
  Case c = textured_sphere();
  c.mesh.material_names = {"red", "blue"};
  c.mesh.material_looks.assign(2, Material());
  c.mesh.material_looks[0].base_colour = {1, 0, 0, 1};
  c.mesh.material_looks[1].base_colour = {0, 0, 1, 1};
  for (std::size_t t = c.mesh.triangles.size() / 2; t < c.mesh.triangles.size(); ++t) c.mesh.materials[t] = 1;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kBaseColour, MapKind::kPosition}));
  std::int64_t pure = 0;
  std::int64_t all = 0;
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* colour, const Vec3d&) {
    EXPECT_NEAR(colour[0] + colour[2], 1, 1e-6);
    pure += colour[0] == 0 || colour[2] == 0;
    ++all;
  });
  EXPECT_LT(pure, all) << "their border has texels of both";
  EXPECT_GT(static_cast<double>(pure), 0.9 * static_cast<double>(all));
}

TEST(MaterialMaps, AlphaIsThatOfTheMaterialAndACutoffBecomesAHalf) {
  Case c = textured_sphere();
  Material& material = c.mesh.material_looks[0];
  material = Material();
  material.alpha_mode = AlphaMode::kMask;
  material.alpha_cutoff = 0.8;
  material.base_colour = {1, 1, 1, 0.8};
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kBaseColour, MapKind::kPosition}));
  EXPECT_EQ(maps.maps[0].channels, 4);
  for_each_inner_texel(c, maps.maps[0], maps.maps[1],
                       [&](const float* colour, const Vec3d&) { EXPECT_NEAR(colour[3], 0.5, 1e-6); });
}

TEST(MaterialMaps, OcclusionOfRaysAndOfTheSourcesTextureMultiply) {
  Case c = textured_sphere();
  Material& material = c.mesh.material_looks[0];
  material.texture(TextureRole::kOcclusion).image = 0;
  material.occlusion_strength = 0.5;
  const Coordinates textures;
  const BakedMaps maps =
      bake(c.mesh, c.map, c.image, small({MapKind::kOcclusionRoughnessMetal, MapKind::kPosition}), {}, &textures);
  // Nothing occludes on a ball but, hardly, its facets.
  double least = 1;
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* orm, const Vec3d& p) {
    const double of_texture = 1 + 0.5 * (0.5 + 0.4 * p.x - 1);
    least = std::min(least, orm[0] / of_texture);
    EXPECT_LT(orm[0], of_texture + 5e-3);
    EXPECT_NEAR(orm[1], 0.5 + 0.4 * p.y, 5e-3);
    EXPECT_NEAR(orm[2], 0.5, 1e-6);
  });
  EXPECT_GT(least, 0.9);
}

TEST(MaterialMaps, AFlatNormalTextureLeavesTheShadingNormals) {
  Case c = textured_sphere();
  c.mesh.material_looks[0].texture(TextureRole::kNormal).image = 0;
  const Coordinates textures;
  const BakedMaps maps =
      bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal, MapKind::kPosition, MapKind::kSourceNormal}), {},
           &textures);
  const ShadingNormals shading(c.mesh);
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* n, const Vec3d& p) {
    EXPECT_GT(Vec3d(n[0], n[1], n[2]).dot(p.normalized()), 0.99);
  });
  for_each_inner_texel(c, maps.maps[2], maps.maps[1],
                       [&](const float* n, const Vec3d&) { EXPECT_GT(n[2], 0.9999) << "flat in its own frames"; });
}

/// Normals that lean by 0.6 along the bitangent; and what else there is, the same everywhere.
class Leaning : public Plain {
 public:
  Vec4f look_up(const TextureUse& use, TextureRole role, const TextureFootprint& at) const override {
    const bool is_normal = role == TextureRole::kNormal || role == TextureRole::kClearcoatNormal;
    return is_normal ? Vec4f(0.5F, 0.8F, 0.9F, 1) : Plain::look_up(use, role, at);
  }
};

/// Around the z axis, wherever the texture lies.
Vec3f eastward(const Vec3f& p) { return Vec3f(-p.y, p.x, 0).normalized(); }

TEST(MaterialMaps, TheSourcesOwnTangentsTellWhatNormalTexturesMean) {
  Case c = textured_sphere();
  c.mesh.material_looks[0].texture(TextureRole::kNormal).image = 0;
  AttributeStream& tangents = stream_for(c.mesh.corner_attributes, kTangents);
  for (const auto& t : c.mesh.triangles) {
    for (const VertexId v : t) {
      const Vec3f east = eastward(c.mesh.positions[v]);
      tangents.values.insert(tangents.values.end(), {east.x, east.y, east.z, -1});
    }
  }
  const Leaning textures;
  const BakedMaps maps =
      bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal, MapKind::kPosition}), {}, &textures);
  for_each_inner_texel(c, maps.maps[0], maps.maps[1], [&](const float* n, const Vec3d& p) {
    if (std::abs(p.z) > 0.9) return;  // tangents turn fast around the poles
    const Vec3d up = p.normalized();
    const Vec3d bitangent = -up.cross(Vec3d(eastward(Vec3f(p))));
    EXPECT_NEAR(Vec3d(n[0], n[1], n[2]).dot(bitangent), 0.6, 0.05);
  });
}

TEST(MaterialMaps, ExtensionsTexturesGoIntoTheChannelsThatTheyHave) {
  Case c = textured_sphere();
  Material& material = c.mesh.material_looks[0];
  material = Material();
  material.extensions = R"({"KHR_materials_clearcoat":{},"KHR_materials_sheen":{},"KHR_materials_anisotropy":{}})";
  for (const TextureRole role :
       {TextureRole::kClearcoatRoughness, TextureRole::kClearcoatNormal, TextureRole::kSheenColour}) {
    material.texture(role).image = 0;
  }
  using Kinds = std::vector<MapKind>;
  BakeOptions plain = small();
  plain.occlusion = OcclusionOf::kSource;
  EXPECT_EQ(usual_maps(plain, c.mesh), (Kinds{MapKind::kTangentNormal, MapKind::kClearcoat, MapKind::kClearcoatNormal,
                                              MapKind::kSheen, MapKind::kAnisotropy}));
  const Leaning textures;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, plain, {}, &textures);
  const std::vector<ConstantMap> constants = maps.constants();
  ASSERT_EQ(constants.size(), 2) << "those of directions differ";
  EXPECT_EQ(constants[0].kind, MapKind::kClearcoat);
  EXPECT_EQ(constants[0].value[0], 1) << "no texture";
  EXPECT_NEAR(constants[0].value[1], 0.25, 1e-3);
  EXPECT_NEAR(constants[1].value[2], 0.75, 1e-3);
  for (const BakedMap* map : {maps.find(MapKind::kClearcoatNormal), maps.find(MapKind::kAnisotropy)}) {
    ASSERT_NE(map, nullptr);
    for (std::size_t i = 0; i < map->texels.size(); i += 3) {
      const float* t = &map->texels[i];
      if (map->kind == MapKind::kAnisotropy) {
        EXPECT_NEAR(std::hypot(2 * t[0] - 1, 2 * t[1] - 1), 1, 1e-5) << "a direction";
      } else if (t[2] < 0.99F) {  // no margin
        EXPECT_NEAR(t[2], 0.8, 0.02) << "leans as it did, out of the same normal";
      }
    }
  }
}

/// What a look-up at borders of tiles mixes in the mip that has four texels to a tile: the mean square of the
/// difference of the red ones on both sides.
double mixed_from_afar(const BakedMap& map) {
  const std::int32_t side = map.layout.tile / 4;
  const auto mean = [&](std::int32_t column, std::int32_t row) {
    double sum = 0;
    for (std::int32_t y = row * side; y < (row + 1) * side; ++y) {
      for (std::int32_t x = column * side; x < (column + 1) * side; ++x) {
        sum += double{
            map.texels[static_cast<std::size_t>(map.channels) * (static_cast<std::size_t>(y) * map.width() + x)]};
      }
    }
    return sum / side / side;
  };
  double squares = 0;
  std::int32_t count = 0;
  for (std::int32_t along = 0; along < 4 * std::min(map.layout.columns, map.layout.rows()); ++along) {
    for (std::int32_t border = 4; border < 4 * map.layout.rows(); border += 4) {
      const double across = mean(border, along) - mean(border - 1, along);
      const double down = mean(along, border) - mean(along, border - 1);
      squares += across * across + down * down;
      count += 2;
    }
  }
  return squares / count;
}

TEST(MaterialMaps, PatchesOfTwoColoursLieApartSoThatCoarseMipsHardlyMixThem) {
  // Quarters of the sphere take turns.
  Case c = textured_sphere();
  c.mesh.images.clear();
  c.mesh.material_looks[0] = {};
  AttributeStream& colours = stream_for(c.mesh.corner_attributes, kColors);
  for (const auto& t : c.mesh.triangles) {
    Vec3f middle(0, 0, 0);
    for (const VertexId v : t) middle += c.mesh.positions[v] / 3;
    const float grey = middle.x * middle.y > 0 ? 1.0F : 0.1F;
    for (int k = 0; k < 3; ++k) colours.values.insert(colours.values.end(), {grey, grey, grey, 1});
  }
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kBaseColour}));
  BakedMap ordered = maps.maps.front();
  ASSERT_TRUE(ordered.layout.order.is_given());
  // The same tiles where they would have been.
  BakedMap plain = ordered;
  plain.layout.order = {};
  for (std::int32_t p = 0; p < c.image.size(); ++p) {
    const MapTile from = ordered.layout.tile_of(p);
    const MapTile to = plain.layout.tile_of(p);
    for (std::int32_t y = 0; y < from.size; ++y) {
      const auto row = [&](const MapTile& tile) {
        return static_cast<std::ptrdiff_t>(ordered.channels) * ((tile.y + y) * ordered.width() + tile.x);
      };
      std::copy_n(ordered.texels.begin() + row(from), ordered.channels * from.size, plain.texels.begin() + row(to));
    }
  }
  // Thirty patches, of which many show both: not all find a neighbour that is like them.
  EXPECT_LT(mixed_from_afar(ordered), 0.5 * mixed_from_afar(plain));
}

TEST(MaterialMaps, MapsThatAreBakedOneByOneHaveOneOrderOfTiles) {
  const Case c = textured_sphere();
  const Coordinates textures;
  const BakedMaps all = bake(c.mesh, c.map, c.image, small(), {}, &textures);
  ASSERT_TRUE(all.maps.front().layout.order.is_given());
  for (const MapKind kind : {MapKind::kTangentNormal, MapKind::kBaseColour}) {
    const BakedMaps one = bake(c.mesh, c.map, c.image, small({kind}), {}, &textures);
    EXPECT_EQ(one.maps.front().layout, all.maps.front().layout);
  }
  const std::vector<TextureRole> roles = texture_roles(small({MapKind::kTangentNormal}), c.mesh);
  for (const TextureRole role : {TextureRole::kBaseColour, TextureRole::kMetallicRoughness, TextureRole::kEmissive}) {
    EXPECT_NE(std::find(roles.begin(), roles.end(), role), roles.end());
  }
}

TEST(MaterialMaps, ColoursGoOnBeyondTheLastTiles) {
  const Case c = textured_sphere();
  const Coordinates textures;
  BakeOptions options = small({MapKind::kBaseColour, MapKind::kTangentNormal});
  options.size = 300;  // not a multiple of tiles
  const BakedMaps maps = bake(c.mesh, c.map, c.image, options, {}, &textures);
  const BakedMap& colours = maps.maps[0];
  const auto texel = [&](const BakedMap& map, std::int32_t x, std::int32_t y) {
    const auto at = map.texels.begin() + static_cast<std::ptrdiff_t>(map.channels) * (y * map.width() + x);
    return std::vector<float>(at, at + map.channels);
  };
  std::int32_t beyond = 0;
  for (std::int32_t y = 0; y < colours.height(); ++y) {
    for (std::int32_t x = 0; x < colours.width(); ++x) {
      if (colours.layout.patch_at(x, y) >= 0) continue;
      ++beyond;
      const bool as_left = x > 0 && texel(colours, x, y) == texel(colours, x - 1, y);
      const bool as_above = y > 0 && texel(colours, x, y) == texel(colours, x, y - 1);
      ASSERT_TRUE(as_left || as_above);
      ASSERT_EQ(texel(maps.maps[1], x, y), (std::vector<float>{0, 0, 1})) << "what is flat stays so";
    }
  }
  EXPECT_GT(beyond, 0);
}

TEST(MaterialMaps, HaveTheSameBitsOnOneThreadAndOnTwo) {
  const Case c = textured_sphere();
  const Coordinates textures;
  const auto baked = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return bake(c.mesh, c.map, c.image, small(), {}, &textures);
  };
  const BakedMaps one = baked(1);
  const BakedMaps two = baked(2);
  ASSERT_EQ(one.maps.size(), two.maps.size());
  for (std::size_t m = 0; m < one.maps.size(); ++m) EXPECT_EQ(one.maps[m].texels, two.maps[m].texels);
}

TEST(Projector, TellsHowWeightsChangeAroundAPlace) {
  const Case c = textured_sphere();
  const Projector projector(c.mesh, c.map, c.image);
  constexpr double kStep = 1e-4;
  int same = 0;
  for (std::int32_t patch = 0; patch < c.image.size(); ++patch) {
    for (const Vec2d& at : {Vec2d(0.3, 0.62), Vec2d(0.71, 0.26), Vec2d(0.48, 0.5), Vec2d(0.13, 0.87)}) {
      const LocatedPoint here = projector.locate(patch, at.x, at.y);
      const SourcePoint along_u = projector.correspondence(patch, at.x + kStep, at.y);
      const SourcePoint along_v = projector.correspondence(patch, at.x, at.y + kStep);
      if (along_u.triangle != here.point.triangle || along_v.triangle != here.point.triangle) continue;
      ++same;
      EXPECT_LT(((along_u.weights - here.point.weights) / kStep - here.along_u).length(), 1e-4);
      EXPECT_LT(((along_v.weights - here.point.weights) / kStep - here.along_v).length(), 1e-4);
    }
  }
  EXPECT_GT(same, c.image.size());
}

}  // namespace
}  // namespace lozenge
