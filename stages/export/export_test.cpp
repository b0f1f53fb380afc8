// Reads exported assets back and proves what an engine takes for granted.
#include "stages/export/export.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/files/asset_file.h"
#include "formats/files/asset_places.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/tangent_frame.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

class ExportedAsset : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name = "ball.glb") const { return folder_ / name; }

  Asset exported(const GeometryImage& image, const BakedMaps& maps, const ExportOptions& options = {}) const {
    export_asset(file(), image, maps, options);
    return read_asset(file());
  }

  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

 private:
  fixtures::TestFolder folder_;
};

/// Statistics of a level after joining vertices whose positions have equal bits.
MeshStatistics welded_statistics(const AssetLevel& level) {
  std::map<std::array<std::uint32_t, 3>, VertexId> known;
  std::vector<VertexId> joined;
  for (std::size_t v = 0; v < level.positions.size(); ++v) {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy(bits.data(), &level.positions[v], sizeof(bits));
    joined.push_back(known.try_emplace(bits, static_cast<VertexId>(v)).first->second);
  }
  auto triangles = level.triangles;
  for (auto& triangle : triangles) {
    for (VertexId& v : triangle) v = joined[v];
  }
  return mesh_statistics({level.positions, triangles});
}

ExportOptions with_samples(std::int32_t samples) {
  ExportOptions options;
  options.samples = samples;
  return options;
}

ExportOptions with_budget(std::int64_t budget) {
  ExportOptions options;
  options.triangle_budget = budget;
  return options;
}

std::string message_of(const GeometryImage& image, const ExportOptions& options) {
  try {
    level_to_export(image, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  return "";
}

TEST_F(ExportedAsset, IsClosedAtEveryLevelOnceEqualPositionsAreWelded) {
  struct Case {
    GeometryImage image;
    int components;
  };
  for (const std::int32_t samples : {2, 3, 5, 9, 17}) {
    for (const Case& c :
         {Case{export_fixtures::octahedron(samples), 1}, Case{export_fixtures::two_spheres(samples), 2}}) {
      ExportOptions options;
      options.max_coarser_levels = 10;
      const Asset asset = exported(c.image, {}, options);
      ASSERT_EQ(asset.levels.size(), c.image.levels.size());
      for (const AssetLevel& level : asset.levels) {
        const MeshStatistics statistics = welded_statistics(level);
        EXPECT_TRUE(is_closed_manifold(statistics)) << samples;
        EXPECT_EQ(statistics.euler, 2 * c.components) << samples;
        EXPECT_EQ(statistics.components, c.components) << samples;
      }
    }
  }
}

TEST_F(ExportedAsset, FacesOutwards) {
  const Asset asset = exported(export_fixtures::octahedron(9), {});
  for (const AssetLevel& level : asset.levels) {
    for (const auto& [a, b, c] : level.triangles) {
      const Vec3f side = level.positions[b] - level.positions[a];
      const Vec3f normal = side.cross(level.positions[c] - level.positions[a]);
      EXPECT_GT(normal.dot(level.positions[a] + level.positions[b] + level.positions[c]), 0);
    }
  }
}

TEST_F(ExportedAsset, HasUnitTangentsAtRightAnglesToUnitNormals) {
  const GeometryImage image = export_fixtures::two_spheres(17);
  for (const std::int32_t baked_level : {0, 1, 4}) {
    const Asset asset = exported(image, export_fixtures::maps(image, 256, baked_level));
    for (const AssetLevel& level : asset.levels) {
      for (std::size_t v = 0; v < level.positions.size(); ++v) {
        const Vec3d tangent(level.tangents[v].x, level.tangents[v].y, level.tangents[v].z);
        ASSERT_NEAR(level.normals[v].length(), 1, 1e-6);
        ASSERT_NEAR(tangent.length(), 1, 1e-6);
        ASSERT_NEAR(tangent.dot(Vec3d(level.normals[v])), 0, 1e-6);
        ASSERT_EQ(std::abs(level.tangents[v].w), 1);
      }
    }
  }
}

TEST_F(ExportedAsset, KeepsTheTexcoordsOfATriangleInsideTheTileOfOnePatch) {
  const GeometryImage image = export_fixtures::octahedron(9);
  const BakedMaps maps = export_fixtures::maps(image, 256, 0);
  const MapLayout& layout = maps.maps[0].layout;
  // Half a texel may be lost in rounding to float; the texel centres of the border are half a texel inside.
  const double inset = layout.gutter + 0.499;
  for (const AssetLevel& level : exported(image, maps).levels) {
    std::set<int> tiles;
    for (const auto& triangle : level.triangles) {
      std::set<int> tile;
      for (const VertexId v : triangle) {
        const double x = level.uvs[v].x * layout.width;
        const double y = level.uvs[v].y * layout.height;
        const int column = static_cast<int>(x) / layout.tile;
        const int row = static_cast<int>(y) / layout.tile;
        tile.insert(row * layout.columns + column);
        EXPECT_GE(x - column * layout.tile, inset);
        EXPECT_LE(x - column * layout.tile, layout.tile - inset);
        EXPECT_GE(y - row * layout.tile, inset);
        EXPECT_LE(y - row * layout.tile, layout.tile - inset);
      }
      ASSERT_EQ(tile.size(), 1U);
      tiles.insert(*tile.begin());
    }
    EXPECT_EQ(static_cast<std::int32_t>(tiles.size()), image.size());
    EXPECT_LT(*tiles.rbegin(), image.size());
  }
}

TEST_F(ExportedAsset, HasTangentsThatFollowItsTexcoords) {
  const GeometryImage image = export_fixtures::octahedron(17);
  const AssetLevel level = exported(image, export_fixtures::maps(image, 512, 0)).levels[0];
  for (const auto& [a, b, c] : level.triangles) {
    // The direction in which u grows, by the chain rule on this triangle.
    const Vec3d p1(level.positions[b] - level.positions[a]);
    const Vec3d p2(level.positions[c] - level.positions[a]);
    const Vec2d t1(level.uvs[b] - level.uvs[a]);
    const Vec2d t2(level.uvs[c] - level.uvs[a]);
    const double turn = t1.x * t2.y - t1.y * t2.x;
    const Vec3d along_u = ((p1 * t2.y - p2 * t1.y) / turn).normalized();
    const Vec3d along_v = ((p2 * t1.x - p1 * t2.x) / turn).normalized();
    const Vec3d tangent(level.tangents[a].x, level.tangents[a].y, level.tangents[a].z);
    EXPECT_GT(tangent.dot(along_u), 0.9);
    // glTF: bitangent = cross(normal, tangent) * w points up in the picture, against v.
    const Vec3d bitangent = Vec3d(level.normals[a]).cross(tangent) * double(level.tangents[a].w);
    EXPECT_LT(bitangent.dot(along_v), 0);
  }
}

TEST_F(ExportedAsset, SharesOneMaterialAmongItsLevels) {
  const GeometryImage image = export_fixtures::octahedron(17);
  const Asset asset = exported(image, export_fixtures::maps(image, 128, 0));
  ASSERT_EQ(asset.levels.size(), 3U) << "6144, 1536 and 384 triangles; the next one would have 96";
  ASSERT_EQ(asset.materials.size(), 1U);
  for (const AssetLevel& level : asset.levels) EXPECT_EQ(level.material, 0);
  ASSERT_GE(asset.materials[0].texture(MaterialSlot::kNormal), 0);
  ASSERT_GE(asset.materials[0].texture(MaterialSlot::kOcclusion), 0);
  EXPECT_EQ(asset.textures[asset.materials[0].texture(MaterialSlot::kNormal)].width, 128);
  EXPECT_EQ(asset.textures[asset.materials[0].texture(MaterialSlot::kNormal)].channels, 3);
  EXPECT_EQ(asset.textures[asset.materials[0].texture(MaterialSlot::kOcclusion)].width, 64);
}

TEST_F(ExportedAsset, HoldsTheMapsAsTheyWouldBeWrittenAlone) {
  const GeometryImage image = export_fixtures::octahedron(5);
  const BakedMaps maps = export_fixtures::maps(image, 128, 0);
  for (const int bits : {8, 16}) {
    ExportOptions options;
    options.textures.normal_bits = bits;
    export_asset(file(), image, maps, options);
    const std::string glb = fixtures::bytes_of(file());
    const std::vector<std::uint8_t> normal = png_of(maps.maps[0], bits);
    const std::vector<std::uint8_t> occlusion = png_of(maps.maps[1], 8);
    EXPECT_NE(glb.find(std::string(normal.begin(), normal.end())), std::string::npos);
    EXPECT_NE(glb.find(std::string(occlusion.begin(), occlusion.end())), std::string::npos);
  }
}

TEST_F(ExportedAsset, HasFactorsInThePlaceOfMapsThatWouldBeTheSameEverywhere) {
  const GeometryImage image = export_fixtures::octahedron(5);
  BakedMaps maps = export_fixtures::maps(image, 128, 0);
  maps.maps[0].constants = {{MapKind::kBaseColour, {0.5F, 0.25F, 0.125F, 1}},
                            {MapKind::kOcclusionRoughnessMetal, {1, 0.75F, 0.375F, 1}}};
  export_asset(file(), image, maps);
  const std::string glb = fixtures::bytes_of(file());
  for (const char* text :
       {"\"baseColorFactor\":[0.5,0.25,0.125,1.0]", "\"roughnessFactor\":0.75", "\"metallicFactor\":0.375"}) {
    EXPECT_NE(glb.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(read_asset(file()).textures.size(), 2) << "normals, occlusion";
}

TEST_F(ExportedAsset, HoldsItsTexturesInTheFormatThatIsAskedForWhereThatKeepsThem) {
  const GeometryImage image = export_fixtures::octahedron(5);
  BakedMaps maps = export_fixtures::maps(image, 128, 0);
  const MapLayout layout = maps.maps[0].layout;
  maps.maps.push_back(neutral_map(MapKind::kBaseColour, layout, 0));
  maps.maps.push_back(neutral_map(MapKind::kEmissive, layout, 0));
  for (const auto& [format, type] :
       {std::pair(TextureFormat::kJpeg, "image/jpeg"), {TextureFormat::kWebp, "image/webp"}}) {
    export_asset(file(), image, maps, {.textures = {.format = format}});
    const Asset asset = read_asset(file());
    const auto texture = [&](MaterialSlot slot) { return asset.textures.at(asset.materials.at(0).texture(slot)); };
    EXPECT_EQ(texture(MaterialSlot::kNormal).mime_type, "image/png");
    EXPECT_EQ(texture(MaterialSlot::kBaseColour).mime_type, "image/png") << "it has alpha";
    EXPECT_EQ(texture(MaterialSlot::kEmissive).mime_type, type);
    const AssetTexture occlusion = texture(MaterialSlot::kOcclusion);
    EXPECT_EQ(occlusion.mime_type, type);
    ASSERT_EQ(occlusion.width, 64);
    double sum = 0;
    const std::vector<float>& wanted = maps.maps[1].texels;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      sum += std::abs(occlusion.pixels[i * static_cast<std::size_t>(occlusion.channels)] - wanted[i]);
    }
    EXPECT_LT(sum / static_cast<double>(wanted.size()), 0.05) << type;
  }
}

TEST_F(ExportedAsset, HasNoTextureWithoutAMap) {
  const Asset asset = exported(export_fixtures::octahedron(5), {});
  EXPECT_TRUE(asset.textures.empty());
  ASSERT_EQ(asset.materials.size(), 1U);
  EXPECT_EQ(asset.materials[0].texture(MaterialSlot::kNormal), -1);
  EXPECT_EQ(asset.materials[0].texture(MaterialSlot::kOcclusion), -1);
}

TEST_F(ExportedAsset, NamesItsCoarserLevelsWithFallingScreenCoverages) {
  const GeometryImage image = export_fixtures::octahedron(33);
  export_asset(file(), image, {});
  const GltfFile gltf = open_gltf(file());
  const tinygltf::Model& model = *gltf.model;
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"MSFT_lod"});
  EXPECT_EQ(model.scenes[0].nodes, std::vector<int>{0});
  const tinygltf::Value& ids = model.nodes[0].extensions.at("MSFT_lod").Get("ids");
  ASSERT_EQ(ids.ArrayLen(), 3U);
  for (int l = 0; l < 3; ++l) EXPECT_EQ(ids.Get(l).GetNumberAsInt(), l + 1);
  const tinygltf::Value& coverages = model.nodes[0].extras.Get("MSFT_screencoverage");
  ASSERT_EQ(coverages.ArrayLen(), 4U);
  double last = 1;
  for (int l = 0; l < 4; ++l) {
    EXPECT_LT(coverages.Get(l).GetNumberAsDouble(), last);
    last = coverages.Get(l).GetNumberAsDouble();
  }
  EXPECT_EQ(last, 0);
}

TEST_F(ExportedAsset, HasCoarserLevelsOfEverySecondSampleInTheFramesOfTheBakedLevel) {
  const GeometryImage image = export_fixtures::octahedron(9);
  const BakedMaps maps = export_fixtures::maps(image, 128, 0);
  const FrameVertices frames = frame_vertices(image, 0, maps.maps[0].layout);
  const Asset asset = exported(image, maps);
  std::map<std::pair<float, float>, FrameVertex> by_texcoord;
  for (const FrameVertex& vertex : frames.vertices) by_texcoord[{vertex.texcoord.x, vertex.texcoord.y}] = vertex;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    EXPECT_EQ(level.triangles.size(), asset.levels[0].triangles.size() >> (2 * l));
    for (std::size_t v = 0; v < level.uvs.size(); ++v) {
      const auto found = by_texcoord.find({level.uvs[v].x, level.uvs[v].y});
      ASSERT_NE(found, by_texcoord.end());
      EXPECT_EQ(level.normals[v], found->second.normal);
      EXPECT_EQ(level.tangents[v], found->second.tangent_with_sign());
    }
  }
}

TEST_F(ExportedAsset, SaysWhereItCameFrom) {
  GeometryImage image = export_fixtures::octahedron(9);
  image.layout.scene_name = "A \"statue\" \xC3\xA4";
  export_asset(file(), image, {});
  const GltfFile gltf = open_gltf(file());
  EXPECT_EQ(gltf.model->scenes[0].name, image.layout.scene_name);
  const tinygltf::Value& extras = gltf.model->asset.extras;
  EXPECT_EQ(extras.Get("source").Get<std::string>(), "ball.glb");
  EXPECT_EQ(extras.Get("patches").GetNumberAsInt(), 12);
  EXPECT_EQ(extras.Get("samples").GetNumberAsInt(), 9);
  EXPECT_FALSE(extras.Get("lozenge").Get<std::string>().empty());
}

TEST_F(ExportedAsset, HasReadableNamesWhateverTheBytesOfTheOrigins) {
  GeometryImage image = export_fixtures::octahedron(5);
  image.layout.scene_name = "caf\xE9";
  image.layout.origin = "\xFF.glb";
  EXPECT_EQ(exported(image, {}).scene_name, "caf\xEF\xBF\xBD");
}

TEST_F(ExportedAsset, StoresIndicesAsNarrowAsTheyFitAndTheBoundsOfItsPositions) {
  struct Case {
    std::int32_t samples;  // 12 patches of 65^2 samples are 50,700 vertices, of 129^2 are 199,692
    int component;
  };
  for (const Case& c :
       {Case{65, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}, Case{129, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}}) {
    const Asset asset = exported(export_fixtures::octahedron(c.samples), {});
    const GltfFile gltf = open_gltf(file());
    const tinygltf::Primitive& primitive = gltf.model->meshes[0].primitives[0];
    EXPECT_EQ(gltf.model->accessors[primitive.indices].componentType, c.component);
    const tinygltf::Accessor& positions = gltf.model->accessors[primitive.attributes.at("POSITION")];
    const Bounds bounds = bounds_of(asset.levels[0].positions);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(positions.minValues[axis], bounds.low[axis]);
      EXPECT_EQ(positions.maxValues[axis], bounds.high[axis]);
    }
  }
}

TEST_F(ExportedAsset, IsTheSameBytesEveryTime) {
  const GeometryImage image = export_fixtures::two_spheres(17);
  const BakedMaps maps = export_fixtures::maps(image, 256, 0);
  export_asset(file("first.glb"), image, maps);
  export_asset(file("second.glb"), image, maps);
  EXPECT_EQ(fixtures::bytes_of(file("first.glb")), fixtures::bytes_of(file("second.glb")));
}

TEST_F(ExportedAsset, EndsAtTheBoundaryOfAnOpenSurface) {
  const GeometryImage image = export_fixtures::open_octahedron(9);
  ExportOptions options;
  options.max_coarser_levels = 10;
  for (const AssetLevel& level : exported(image, {}, options).levels) {
    const MeshStatistics statistics = welded_statistics(level);
    EXPECT_EQ(statistics.tangled_edges, 0);
    EXPECT_EQ(statistics.pinched_vertices, 0);
    EXPECT_EQ(statistics.euler, 1);
    std::set<std::array<float, 3>> places;
    for (const Vec3f& p : level.positions) places.insert({p.x, p.y, p.z});
    EXPECT_EQ(statistics.vertices, static_cast<std::int64_t>(places.size()));  // none of them unused
  }
}

TEST_F(ExportedAsset, EndsInTheSourcesLoopsAtEveryLevel) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    GeometryImage image = fixtures::open_image(open, 3);
    image.layout.source_triangles = 0;  // else no coarser level may have more
    ExportOptions options;
    options.max_coarser_levels = 3;
    const Asset asset = exported(image, {}, options);
    ASSERT_EQ(asset.levels.size(), 4U);
    for (const AssetLevel& level : asset.levels) {
      const std::vector<BoundarySide> sides = boundary_sides(level.view());
      EXPECT_EQ(static_cast<int>(boundary_loops(sides).size()), open.loops) << open.name;
      EXPECT_LT(fixtures::boundary_distance(level.view(), {open.mesh.positions, open.mesh.triangles}), 2e-7)
          << open.name;
      const MeshStatistics statistics = welded_statistics(level);
      EXPECT_EQ(statistics.euler, open.euler) << open.name;
      EXPECT_EQ(statistics.tangled_edges + statistics.pinched_vertices, 0) << open.name;
    }
  }
}

TEST_F(ExportedAsset, SaysHowManyHalfPatchesItHasWhereTheSurfaceIsOpen) {
  const Asset open = exported(export_fixtures::open_octahedron(9), {}, with_samples(5));
  EXPECT_EQ(open.half_patches, 3);
  EXPECT_EQ(open.samples, 5);
  const Asset closed = exported(export_fixtures::octahedron(9), {});
  EXPECT_EQ(closed.half_patches, 0);
  EXPECT_EQ(closed.samples, 9);
  EXPECT_FALSE(open_gltf(file()).model->asset.extras.Has("half_patches"));
}

TEST_F(ExportedAsset, IsSeenFromBothSidesWhereItsSourceIs) {
  for (GeometryImage image : {export_fixtures::octahedron(5), export_fixtures::open_octahedron(5)}) {
    for (const bool double_sided : {false, true}) {
      image.layout.double_sided = double_sided;
      EXPECT_EQ(exported(image, {}).materials.at(0).double_sided, double_sided);
    }
  }
}

/// A ball whose samples above this height close a hole.
GeometryImage capped_ball(float height) {
  GeometryImage image = export_fixtures::octahedron(17);
  for (GeometryLevel& level : image.levels) {
    for (const Vec3f& p : level.positions) level.caps.push_back(p.z > height ? 1 : 0);
  }
  return image;
}

TEST_F(ExportedAsset, LeavesOutAtEveryLevelWhatLiesOnCapsIfAsked) {
  const float height = 0.8F;
  const GeometryImage image = capped_ball(height);
  ExportOptions options;
  const Asset whole = exported(image, {}, options);
  EXPECT_EQ(whole.cap_triangles, 0);
  options.caps = Caps::kOpen;
  const AssetFacts facts = export_asset(file(), image, {}, options);
  const Asset open = read_asset(file());
  ASSERT_EQ(open.levels.size(), whole.levels.size());
  std::int64_t left_out = 0;
  for (std::size_t l = 0; l < open.levels.size(); ++l) {
    const auto on_cap = [&](const AssetLevel& level, const auto& triangle) {
      return std::count_if(triangle.begin(), triangle.end(),
                           [&](VertexId v) { return level.positions[v].z > height; }) >= 2;
    };
    std::int64_t due = 0;
    for (const auto& triangle : whole.levels[l].triangles) due += on_cap(whole.levels[l], triangle);
    for (const auto& triangle : open.levels[l].triangles) EXPECT_FALSE(on_cap(open.levels[l], triangle));
    EXPECT_GT(due, 0);
    EXPECT_EQ(open.levels[l].triangles.size() + due, whole.levels[l].triangles.size());
    left_out += due;
    const MeshStatistics statistics = welded_statistics(open.levels[l]);
    EXPECT_EQ(statistics.boundary_loops, 1);
    EXPECT_EQ(statistics.tangled_edges, 0);
    EXPECT_TRUE(l > 0 || facts.cap_triangles == due);
  }
  EXPECT_EQ(open.cap_triangles, left_out);
  EXPECT_EQ(facts.triangles, static_cast<std::int64_t>(open.levels[0].triangles.size()));
}

TEST_F(ExportedAsset, IsTheSameWithAndWithoutMarksOfCapsThatItKeeps) {
  export_asset(file("marked.glb"), capped_ball(0.8F), {});
  export_asset(file("plain.glb"), export_fixtures::octahedron(17), {});
  EXPECT_EQ(fixtures::bytes_of(file("marked.glb")), fixtures::bytes_of(file("plain.glb")));
}

TEST_F(ExportedAsset, IsRefusedWhereNothingIsLeftWithoutItsCaps) {
  ExportOptions options;
  options.caps = Caps::kOpen;
  EXPECT_THROW(export_asset(file(), capped_ball(-2), {}, options), Error);
  EXPECT_EQ(files_in_folder(), 0U);
}

TEST_F(ExportedAsset, ComesWithItsCoarserLevelsAsFilesOnRequest) {
  const GeometryImage image = export_fixtures::octahedron(9);
  ExportOptions options;
  options.separate_files = true;
  options.coarser_levels = false;
  options.max_coarser_levels = 2;
  const AssetFacts facts = export_asset(file(), image, export_fixtures::maps(image, 64, 0), options);
  EXPECT_EQ(facts.files, (std::vector<std::filesystem::path>{file(), file("ball.lod1.glb"), file("ball.lod2.glb")}));
  EXPECT_EQ(facts.levels, 1);
  std::int64_t triangles = facts.triangles;
  for (const auto& path : facts.files) {
    const Asset asset = read_asset(path);
    ASSERT_EQ(asset.levels.size(), 1U);
    EXPECT_EQ(asset.textures.size(), 2U);
    EXPECT_EQ(static_cast<std::int64_t>(asset.levels[0].triangles.size()), triangles);
    triangles /= 4;
  }
}

TEST_F(ExportedAsset, HasTheTrianglesAndVerticesThatItsFactsSay) {
  const AssetFacts facts = export_asset(file(), export_fixtures::octahedron(17), {}, with_samples(9));
  const Asset asset = read_asset(file());
  EXPECT_EQ(facts.level, 1);
  EXPECT_EQ(facts.samples, 9);
  EXPECT_EQ(facts.triangles, 12 * 8 * 8 * 2);
  EXPECT_EQ(facts.triangles, static_cast<std::int64_t>(asset.levels[0].triangles.size()));
  EXPECT_EQ(facts.vertices, static_cast<std::int64_t>(asset.levels[0].positions.size()));
  EXPECT_EQ(facts.levels, static_cast<std::int32_t>(asset.levels.size()));
}

TEST_F(ExportedAsset, IsRefusedWhereTheMapsBelongToAnotherAtlas) {
  const GeometryImage image = export_fixtures::octahedron(9);
  const BakedMaps others = export_fixtures::maps(export_fixtures::two_spheres(9), 256, 0);
  BakedMaps mixed = export_fixtures::maps(image, 256, 0);
  mixed.maps[1].layout = make_map_layout(image.layout, 128, 2);
  BakedMaps too_coarse = export_fixtures::maps(image, 256, 4);
  for (const BakedMaps& maps : {others, mixed, too_coarse}) {
    try {
      export_asset(file(), image, maps);
      ADD_FAILURE() << "was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUnusableInput);
      EXPECT_NE(std::string(error.what()).find("ball.glb"), std::string::npos);
    }
    EXPECT_EQ(files_in_folder(), 0U);
  }
}

TEST_F(ExportedAsset, IsRefusedWhereItWouldPassTheFourGigabytesOfAGlb) {
  // The counts alone decide; there are no samples behind them that could be read.
  GeometryImage image = export_fixtures::octahedron(3);
  image.layout.places.resize(300, image.layout.places[0]);
  image.layout.samples = 1025;
  image.levels.assign(1, GeometryLevel{});
  image.levels.front().samples = 1025;
  try {
    export_asset(file(), image, {});
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kLimit);
    EXPECT_NE(std::string(error.what()).find("ball.glb"), std::string::npos);
  }
  EXPECT_EQ(files_in_folder(), 0U);
}

TEST(LevelToExport, IsTheLargestWithinTheBudget) {
  const GeometryImage image = export_fixtures::octahedron(17);  // 6144, 1536, 384, 96, 24 triangles
  EXPECT_EQ(level_to_export(image, {}), 0);
  EXPECT_EQ(level_to_export(image, with_budget(1'000'000)), 0);
  EXPECT_EQ(level_to_export(image, with_budget(6144)), 0);
  EXPECT_EQ(level_to_export(image, with_budget(6143)), 1);
  EXPECT_EQ(level_to_export(image, with_budget(1536)), 1);
  EXPECT_EQ(level_to_export(image, with_budget(100)), 3);
  EXPECT_EQ(level_to_export(image, with_budget(24)), 4);
}

TEST(LevelToExport, HasTheSamplesAskedForAndStaysWithinTheBudgetToo) {
  const GeometryImage image = export_fixtures::octahedron(17);
  for (int level = 0; level < 5; ++level) {
    EXPECT_EQ(level_to_export(image, with_samples(image.levels[level].samples)), level);
  }
  ExportOptions both = with_samples(5);
  both.triangle_budget = 6144;
  EXPECT_EQ(level_to_export(image, both), 2);
  both.triangle_budget = 96;
  EXPECT_EQ(level_to_export(image, both), 3);
}

TEST(LevelToExport, SaysWhatThereIsWhereNothingFits) {
  const GeometryImage image = export_fixtures::octahedron(17);
  for (const ExportOptions& options : {with_budget(-1), with_samples(16), with_samples(33), with_samples(-2)}) {
    EXPECT_FALSE(message_of(image, options).empty());
  }
  const std::string message = message_of(image, with_samples(16));
  EXPECT_NE(message.find("ball.glb"), std::string::npos);
  EXPECT_NE(message.find("24 triangles"), std::string::npos);
  EXPECT_NE(message.find("17 samples a side"), std::string::npos);
}

TEST(LevelToExport, IsTheCoarsestWhereNoneKeepsToTheBudget) {
  EXPECT_EQ(level_to_export(export_fixtures::octahedron(17), with_budget(23)), 4);
}

TEST_F(ExportedAsset, SaysWhatItHasWhereItCanNotKeepToTheBudget) {
  const GeometryImage image = export_fixtures::octahedron(9);
  EXPECT_TRUE(export_asset(file(), image, {}, with_budget(24)).note.empty());
  const AssetFacts facts = export_asset(file(), image, {}, with_budget(23));
  EXPECT_EQ(facts.triangles, 24);
  EXPECT_NE(facts.note.find("24 triangles instead of at most 23"), std::string::npos) << facts.note;
}

/// Two balls of which the second is placed twice more: turned and grown, and mirrored.
GeometryImage repeated_ball() {
  GeometryImage image = export_fixtures::two_spheres(9);
  image.layout.bodies.bodies = {{"bead",
                                 {{},
                                  {{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 3, 0, 5, 0, 0, 1}, -1},
                                  {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 7, 0, 1}, -1}},
                                 -1}};
  for (const PatchPlace& place : image.layout.places)
    image.layout.bodies.owner.push_back(place.left.triangle < 8 ? -1 : 0);
  return image;
}

TEST_F(ExportedAsset, PlacesARepeatedMeshInEachOfItsPlaces) {
  const GeometryImage image = repeated_ball();
  GeometryImage plain = image;
  plain.layout.bodies = {};
  const Asset once = exported(plain, {});
  const AssetFacts facts = export_asset(file(), image, {});
  const Asset asset = read_asset(file());
  EXPECT_EQ(facts.copies, 2);
  EXPECT_EQ(facts.triangles, once.levels[0].view().triangles.size());
  ASSERT_EQ(asset.levels.size(), once.levels.size());
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    EXPECT_EQ(level.triangles.size(), once.levels[l].triangles.size());
    EXPECT_EQ(level.positions.size(), once.levels[l].positions.size());
    ASSERT_EQ(level.parts.size(), 2U);
    EXPECT_EQ(level.parts[1].triangles, level.triangles.size() / 3) << "four of twelve domain triangles";
    ASSERT_EQ(level.parts[1].places.size(), 3U);
    for (std::size_t p = 0; p < 3; ++p) {
      EXPECT_EQ(level.parts[1].places[p], image.layout.bodies.bodies[0].places[p].placement);
    }
    const AssetLevel all = with_copies(level);
    ASSERT_EQ(all.triangles.size(), level.triangles.size() + 2 * level.parts[1].triangles);
    const MeshStatistics statistics = welded_statistics(all);
    EXPECT_EQ(statistics.euler, 8);
    EXPECT_EQ(statistics.boundary_edges, 0);
    for (std::size_t v = level.positions.size(); v < all.positions.size(); ++v) {
      EXPECT_NEAR(all.normals[v].length(), 1, 1e-5);
      EXPECT_NEAR(all.normals[v].dot({all.tangents[v].x, all.tangents[v].y, all.tangents[v].z}), 0, 1e-5);
    }
    // Faces and shading agree on what is outside, in mirrored copies, too.
    for (const auto& [a, b, c] : all.triangles) {
      const Vec3f face = (all.positions[b] - all.positions[a]).cross(all.positions[c] - all.positions[a]);
      EXPECT_GT(face.dot(all.normals[a] + all.normals[b] + all.normals[c]), 0);
    }
  }
}

TEST_F(ExportedAsset, LetsEngineChooseALevelForEachCopyByItself) {
  export_asset(file(), repeated_ball(), {}, {.max_coarser_levels = 3});
  const GltfFile written = open_gltf(file());
  const tinygltf::Model& model = *written.model;
  EXPECT_EQ(model.meshes.size(), 8U);
  EXPECT_EQ(model.nodes.size(), 16U);
  EXPECT_EQ(model.scenes.at(0).nodes, (std::vector<int>{0, 4, 8, 12}));
  EXPECT_EQ(model.meshes[4].name, "bead");
  for (const int node : model.scenes[0].nodes) {
    const auto& ids = model.nodes[node].extensions.at("MSFT_lod").Get("ids");
    ASSERT_EQ(ids.ArrayLen(), 3U);
    for (int l = 0; l < 3; ++l) {
      EXPECT_EQ(ids.Get(l).GetNumberAsInt(), node + l + 1);
      EXPECT_EQ(model.nodes[node + l + 1].matrix, model.nodes[node].matrix);
    }
  }
}

TEST_F(ExportedAsset, HasItsLevelsAsSiblingsByNameOnRequestAndIsReadBackTheSame) {
  export_asset(file("lod.glb"), repeated_ball(), {}, {.max_coarser_levels = 2});
  export_asset(file(), repeated_ball(), {}, {.lods_as = LodsAs::kNodes, .max_coarser_levels = 2});
  const GltfFile written = open_gltf(file());
  const tinygltf::Model& model = *written.model;
  EXPECT_TRUE(model.extensionsUsed.empty());
  ASSERT_EQ(model.nodes.size(), 12U);
  EXPECT_EQ(model.scenes.at(0).nodes.size(), 12U) << "all of them are in the scene";
  EXPECT_EQ(model.nodes[0].name, "Ball_LOD0");
  EXPECT_EQ(model.nodes[2].name, "Ball_LOD2");
  EXPECT_EQ(model.nodes[11].name, "bead_LOD2");
  const Asset with_lod = read_asset(file("lod.glb"));
  const Asset siblings = read_asset(file());
  ASSERT_EQ(siblings.levels.size(), 3U);
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_EQ(siblings.levels[l].positions, with_lod.levels[l].positions);
    EXPECT_EQ(siblings.levels[l].triangles, with_lod.levels[l].triangles);
    ASSERT_EQ(siblings.levels[l].parts.size(), 2U);
    EXPECT_EQ(siblings.levels[l].parts[1].places, with_lod.levels[l].parts[1].places);
  }
}

TEST_F(ExportedAsset, HasItsLevelsInFilesOfTheirOwnOnRequest) {
  const AssetFacts facts =
      export_asset(file(), export_fixtures::octahedron(9), {}, {.lods_as = LodsAs::kFiles, .max_coarser_levels = 2});
  EXPECT_EQ(facts.files, (std::vector<std::filesystem::path>{file(), file("ball.lod1.glb"), file("ball.lod2.glb")}));
  for (const auto& path : facts.files) EXPECT_EQ(read_asset(path).levels.size(), 1U);
}

TEST_F(ExportedAsset, IsRefusedWhereItsCopiesAreNotWhatTheyShouldBe) {
  export_asset(file(), repeated_ball(), {}, {.max_coarser_levels = 3});
  const auto code_after = [&](const auto& change) {
    const GltfFile written = open_gltf(file());
    change(*written.model);
    write_glb(file("changed.glb"), *written.model);
    try {
      read_asset(file("changed.glb"));
    } catch (const Error& e) {
      return e.code();
    }
    return ExitCode::kDone;
  };
  using tinygltf::Model;
  EXPECT_EQ(code_after([](Model&) {}), ExitCode::kDone);
  EXPECT_EQ(code_after([](Model& m) { m.scenes[0].nodes.pop_back(); }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](Model& m) { m.nodes[9].matrix[12] += 1; }), ExitCode::kUnusableInput) << "a level elsewhere";
  EXPECT_EQ(code_after([](Model& m) { m.nodes[9].mesh = 6; }), ExitCode::kUnusableInput);
  EXPECT_EQ(code_after([](Model& m) { m.scenes[0].nodes.erase(m.scenes[0].nodes.begin()); }), ExitCode::kUnsupported);
}

TEST_F(ExportedAsset, KeepsRepeatedMeshesInEachFileOfSeparateLevels) {
  ExportOptions options;
  options.max_coarser_levels = 3;
  options.separate_files = true;
  const AssetFacts facts = export_asset(file(), repeated_ball(), {}, options);
  ASSERT_EQ(facts.files.size(), 4U);
  for (std::size_t l = 1; l < facts.files.size(); ++l) {
    const Asset level = read_asset(facts.files[l]);
    ASSERT_EQ(level.levels.size(), 1U);
    EXPECT_EQ(level.levels[0].parts.at(1).places.size(), 3U);
  }
}

}  // namespace
}  // namespace lozenge
