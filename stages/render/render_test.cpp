#include "stages/render/render.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "stages/render/canvas.h"
#include "stages/render/contact_sheet.h"
#include "stages/render/palette.h"
#include "stages/render/plot.h"
#include "stages/render/tracer.h"

namespace lozenge {
namespace {

constexpr RenderOptions kSmall{.width = 96, .height = 80, .subsamples = 2};

bool same(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Vec3f)) == 0;
}

/// Red minus blue of the pixel in the middle.
float warmth(const Picture& picture) {
  const Vec3f& p = picture.at(picture.width / 2, picture.height / 2);
  return p.x - p.z;
}

std::vector<Picture> every_picture() {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 6);
  const GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 3);
  return {render_shaded(mesh, kSmall),
          render_shaded(image, 1, kSmall),
          render_patches(mesh, map, kSmall),
          render_patches(image, 0, kSmall),
          render_distortion(mesh, map, kSmall),
          render_wires(image, 1, kSmall),
          render_baked(fixtures::sphere_asset(), 0, kSmall),
          render_surface({mesh.positions, mesh.triangles}, true, kSmall)};
}

TEST(Render, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Picture> pictures[2];
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    pictures[threads - 1] = every_picture();
  }
  for (std::size_t i = 0; i < pictures[0].size(); ++i) EXPECT_TRUE(same(pictures[0][i], pictures[1][i])) << i;
}

TEST(Render, DrawsNothingOfTheHalvesBeyondTheBoundary) {
  for (const fixtures::OpenSurface& open : {fixtures::hemisphere(4), fixtures::annulus(5, 17, 4, 0.375)}) {
    const GeometryImage image = fixtures::open_image(open, 3);
    GeometryImage littered = image;
    for (GeometryLevel& level : littered.levels) {
      for (std::int32_t p = 0; p < image.size(); ++p) {
        for (std::int32_t j = 0; j < level.samples; ++j) {
          for (std::int32_t i = j + 1; i < level.samples && !image.layout.places[p].right.exists(); ++i) {
            level.positions[image.index(level, p, i, j)] = Vec3f(7, -5, 3);
          }
        }
      }
    }
    BakedMaps maps;
    maps.maps.push_back(fixtures::flat_normal_map());
    maps.maps[0].layout = make_map_layout(image.layout, 64, 1);
    maps.maps[0].texels.assign(std::size_t{3} * 64 * 64, 0.0F);
    for (std::size_t t = 2; t < maps.maps[0].texels.size(); t += 3) maps.maps[0].texels[t] = 1;
    EXPECT_TRUE(same(render_shaded(image, 0, kSmall), render_shaded(littered, 0, kSmall))) << open.name;
    EXPECT_TRUE(same(render_wires(image, 1, kSmall), render_wires(littered, 1, kSmall))) << open.name;
    EXPECT_TRUE(same(render_patches(image, 0, kSmall), render_patches(littered, 0, kSmall))) << open.name;
    EXPECT_TRUE(same(render_baked(image, 0, maps, kSmall), render_baked(littered, 0, maps, kSmall))) << open.name;
  }
}

TEST(Render, LightsTheInsideOfAnOpenSurfaceLikeItsOutside) {
  // A flat sheet looks the same from both of its sides.
  SourceMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  SourceMesh turned = sheet;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  RenderOptions options = kSmall;
  options.direction = {0, 0, 1};
  const Picture front = render_shaded(sheet, options);
  const Picture back = render_shaded(turned, options);
  const auto middle = [&](const Picture& p) { return p.at(p.width / 2, p.height / 2); };
  EXPECT_LT((middle(front) - middle(back)).length(), 1e-3F);
}

TEST(Render, PicturesShowTheSphereBeforeTheBackdrop) {
  for (const Picture& picture : every_picture()) {
    ASSERT_EQ(picture.width, 96);
    ASSERT_EQ(picture.height, 80);
    std::set<std::array<float, 3>> colours;
    for (const Vec3f& p : picture.pixels) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(p[c], 0);
        ASSERT_LE(p[c], 1);
      }
      colours.insert({p.x, p.y, p.z});
    }
    EXPECT_GT(colours.size(), 500U);
    // The corner is backdrop, the middle is not.
    EXPECT_GT((picture.at(48, 40) - picture.at(0, 0)).length(), 0.02F);
  }
}

TEST(Render, StylesDiffer) {
  const std::vector<Picture> pictures = every_picture();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(same(pictures[i], pictures[j])) << i << ' ' << j;
  }
}

TEST(DistortionColour, IsThatOfThePapersFigure9) {
  EXPECT_EQ(distortion_colour(1), Vec3f(1, 1, 1));
  for (const double ratio : {2.0, 3.0, 1e9}) EXPECT_EQ(distortion_colour(ratio), Vec3f(1, 0, 0));
  for (const double ratio : {0.5, 0.1, 0.0}) EXPECT_EQ(distortion_colour(ratio), Vec3f(0, 0, 1));
  // A factor and its inverse are equally far from white.
  EXPECT_NEAR(distortion_colour(1.3).y, distortion_colour(1 / 1.3).y, 1e-6);
}

TEST(RenderDistortion, IsGreyWhereTheMapKeepsAreas) {
  // The flat octahedron itself: an isometry. Its middle is compared with that of maps that shrink or expand there.
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 1);
  const RenderOptions front{.width = 64, .height = 64, .subsamples = 1, .direction = {1, 1, 1}};
  const Picture isometric = render_distortion(mesh, map, front);
  const Vec3f& p = isometric.at(32, 32);
  // No hue but the lamps' own.
  EXPECT_NEAR(p.x / p.z, 1, 0.12);
  EXPECT_NEAR(p.y / p.z, 1, 0.12);

  // The triangle in front, pulled out to a spike, is larger on the surface: its image is a smaller share (blue), and
  // the others' are larger.
  SourceMesh larger = mesh;
  for (Vec3f& v : larger.positions) {
    if (v.x + v.y + v.z > 0.5F) v *= 2.5F;
  }
  EXPECT_LT(warmth(render_distortion(larger, map, front)), -0.1F);
  SourceMesh smaller = mesh;
  for (Vec3f& v : smaller.positions) {
    if (v.x + v.y + v.z > 0.5F) v *= 0.4F;
  }
  EXPECT_GT(warmth(render_distortion(smaller, map, front)), 0.1F);
}

TEST(RenderWires, DrawsDarkLinesOverTheSameSurface) {
  const GeometryImage image = fixtures::sphere_image(fixtures::icosahedron(), 3);
  const Picture bare = render_shaded(image, 2, kSmall);
  const Picture wires = render_wires(image, 2, kSmall);
  int darker = 0;
  for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
    EXPECT_LE(wires.pixels[i].y, bare.pixels[i].y + 1e-5F);
    darker += wires.pixels[i].y < 0.8F * bare.pixels[i].y;
  }
  EXPECT_GT(darker, 200);
  EXPECT_LT(darker, 96 * 80 / 2);
}

TEST(RenderBaked, AFlatMapChangesNothing) {
  Asset asset = fixtures::sphere_asset();
  // Exactly flat, without the half step of 8 bits.
  for (std::size_t i = 0; i < asset.textures[0].pixels.size(); ++i)
    asset.textures[0].pixels[i] = i % 3 == 2 ? 1.0F : 0.5F;
  const Picture mapped = render_baked(asset, 0, kSmall);
  asset.materials[0].texture(MaterialSlot::kNormal) = -1;
  const Picture bare = render_baked(asset, 0, kSmall);
  for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
    EXPECT_LT((mapped.pixels[i] - bare.pixels[i]).length(), 1e-4F);
  }
}

TEST(RenderBaked, ALeaningMapChangesTheShading) {
  Asset asset = fixtures::sphere_asset();
  const Picture flat = render_baked(asset, 0, kSmall);
  for (std::size_t i = 0; i < asset.textures[0].pixels.size(); ++i) {
    asset.textures[0].pixels[i] = i % 3 == 0 ? 0.85F : i % 3 == 1 ? 0.5F : 0.857F;
  }
  EXPECT_FALSE(same(flat, render_baked(asset, 0, kSmall)));
}

TEST(Render, RefusesLevelsThatAreNotThereAndPicturesOfNoSize) {
  const GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 1);
  EXPECT_THROW(render_wires(image, 2, kSmall), Error);
  EXPECT_THROW(render_wires(image, -1, kSmall), Error);
  EXPECT_THROW(render_baked(fixtures::sphere_asset(), 2, kSmall), Error);
  RenderOptions options;
  options.width = 0;
  EXPECT_THROW(render_wires(image, 0, options), Error);
}

TEST(Camera, SeesEveryVertexFromEveryDirection) {
  auto mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 4).first;
  // Long, thin, and far from the origin.
  for (Vec3f& p : mesh.positions) p = Vec3f(p.x * 8, p.y, p.z * 0.3F) + Vec3f(100, -50, 7);
  const SurfaceView surface{mesh.positions, mesh.triangles};
  for (const Vec3f& direction :
       {Vec3f(0, 0, 1), Vec3f(1, 0.2F, 0), Vec3f(0, 1, 0), Vec3f(0, -1, 0), Vec3f(-1, -1, -1)}) {
    const RenderOptions options{.width = 200, .height = 100, .subsamples = 1, .direction = direction};
    const Camera camera(surface, options);
    for (const Vec3f& p : mesh.positions) {
      const Vec2d pixel = camera.pixel(Vec3d(p));
      EXPECT_GT(pixel.x, 0);
      EXPECT_LT(pixel.x, 200);
      EXPECT_GT(pixel.y, 0);
      EXPECT_LT(pixel.y, 100);
      // The ray through a vertex's pixel leads to the vertex.
      EXPECT_NEAR(camera.direction(pixel.x, pixel.y).dot((Vec3d(p) - camera.eye()).normalized()), 1, 1e-9);
    }
  }
}

TEST(ColourItems, GivesItemsOfAGroupDifferentColours) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    std::vector<std::vector<std::int32_t>> groups(static_cast<std::size_t>(base.vertex_count));
    for (DomainTriangleId t = 0; t < base.size(); ++t) {
      for (const DomainVertex v : base.triangles[t].corners) groups[v].push_back(t);
    }
    const auto colours = colour_items(base.size(), groups);
    for (const auto& group : groups) {
      std::set<std::int32_t> different;
      for (const std::int32_t item : group) different.insert(colours[item]);
      EXPECT_EQ(different.size(), group.size());
    }
  }
}

TEST(ContactSheet, HoldsItsPicturesUnchanged) {
  const Picture red(100, 100, Vec3f(1, 0, 0));
  const Picture blue(100, 100, Vec3f(0, 0, 1));
  const Picture sheet = contact_sheet({{"one", red}, {"two", blue}, {"three", red}}, 2, "title");
  const auto count = [&](const Vec3f& colour) { return std::count(sheet.pixels.begin(), sheet.pixels.end(), colour); };
  EXPECT_EQ(count(Vec3f(1, 0, 0)), 20'000);
  EXPECT_EQ(count(Vec3f(0, 0, 1)), 10'000);
}

/// A sphere's levels as an asset, each drawn with a texture of its own as its normal map.
Asset asset_of_levels(const std::vector<std::int32_t>& counts, bool with_maps) {
  Asset asset;
  for (const std::int32_t n : counts) {
    const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), n);
    AssetLevel level;
    level.positions = level.normals = mesh.positions;
    level.triangles = mesh.triangles;
    level.tangents.assign(mesh.positions.size(), {1, 0, 0, 1});
    level.uvs.assign(mesh.positions.size(), {0, 0});
    level.material = static_cast<std::int32_t>(asset.materials.size());
    AssetPart& part = level.parts.emplace_back();
    part.vertices = mesh.positions.size();
    part.triangles = mesh.triangles.size();
    part.places = {kUnmoved};
    asset.levels.push_back(level);
    AssetMaterial material;
    if (with_maps) material.texture(MaterialSlot::kNormal) = level.material;
    asset.materials.push_back(material);
    AssetTexture texture{"normal", "image/png", 1, 1, 3, 8, {0.5F, 0.5F, 1.0F}};
    asset.textures.push_back(texture);
  }
  return asset;
}

TEST(Preview, ShowsEveryStageAndTheLevelsOfTheAssetWithTheirOwnMaps) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 4);
  const auto sheet = [&](const Asset& asset, std::int64_t triangles = 100) {
    return preview(mesh, map, asset, triangles, kSmall);
  };
  const Asset asset = asset_of_levels({8, 4, 2}, true);
  const Picture mapped = sheet(asset);
  EXPECT_GT(mapped.width, 3 * kSmall.width);
  EXPECT_GT(mapped.height, 2 * kSmall.height);
  const Picture bare = sheet(asset_of_levels({8, 4, 2}, false));
  EXPECT_EQ(bare.width, mapped.width);
  EXPECT_FALSE(same(bare, mapped));
  for (const std::size_t level : {0, 1}) {
    Asset changed = asset;
    changed.textures[level].pixels[0] = 0.9F;
    EXPECT_FALSE(same(sheet(changed), mapped)) << level;
  }
  // It tells the number of triangles that it is given: the mesh's own may have been split.
  EXPECT_FALSE(same(mapped, sheet(asset, 200)));
}

TEST(Preview, IsTheSameForTheFinestLevelWhoseTrianglesCanBeToldApartWhateverIsFiner) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 4);
  Asset asset = asset_of_levels({60, 8, 2}, true);  // 28,800 triangles
  const Picture sheet = preview(mesh, map, asset, 100, kSmall);
  asset.textures[0].pixels[0] = 0.9F;
  EXPECT_TRUE(same(preview(mesh, map, asset, 100, kSmall), sheet));
}

TEST(Text, EveryCharacterButTheSpaceLeavesInk) {
  for (char c = '!'; c <= '~'; ++c) {
    Picture picture(40, 40, Vec3f(1, 1, 1));
    draw_text(picture, std::string(1, c), {10, 30}, 20, Vec3f(0, 0, 0));
    const auto inked =
        std::count_if(picture.pixels.begin(), picture.pixels.end(), [](const Vec3f& p) { return p.x < 0.5F; });
    EXPECT_GT(inked, 2) << c;
  }
}

TEST(Text, IsAlignedByItsWidth) {
  const double width = text_width("Lozenge", 14);
  const auto columns = [&](Align align) {
    Picture picture(400, 40, Vec3f(1, 1, 1));
    draw_text(picture, "Lozenge", {200, 30}, 14, Vec3f(0, 0, 0), align);
    int first = 400;
    int last = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 400; ++x) {
        if (picture.at(x, y).x > 0.5F) continue;
        first = std::min(first, x);
        last = std::max(last, x);
      }
    }
    return std::pair(first, last);
  };
  EXPECT_NEAR(columns(Align::kLeft).first, 200, 2);
  EXPECT_NEAR(columns(Align::kRight).second, 200, 2);
  EXPECT_NEAR(columns(Align::kCentre).first, 200 - width / 2, 2);
}

class RenderFiles : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  std::filesystem::path write(const std::string& text) const {
    const auto path = folder_ / "trace.json";
    std::ofstream(path) << text;
    return path;
  }
};

TEST_F(RenderFiles, PngsOfOnePictureHaveTheSameBytes) {
  Picture picture(31, 17, srgb(0x336699));
  picture.at(3, 4) = Vec3f(2, -1, 0.5F);  // out of range: clamped
  write_picture(folder_ / "a.png", picture);
  write_picture(folder_ / "b.png", picture);
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.png"), fixtures::bytes_of(folder_ / "b.png"));
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.png").substr(1, 3), "PNG");
}

TEST_F(RenderFiles, APictureThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  const Picture picture(4, 4, Vec3f(0, 0, 0));
  EXPECT_THROW(write_picture(folder_ / "no such folder" / "a.png", picture), Error);
  EXPECT_THROW(write_picture(folder_ / "a.bmp", picture), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(RenderFiles, ATraceBecomesTwoPlots) {
  const auto path = write(R"([{"domain_faces": 200, "area": 0.01, "angle": 0.1, "aggregate": 0.03},
                              {"domain_faces": 100, "area": 0.02, "angle": 0.2, "aggregate": 0.05}])");
  const Picture picture = render_trace(path);
  const auto coloured = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                      [](const Vec3f& p) { return std::abs(p.x - p.z) > 0.2F; });
  EXPECT_GT(coloured, 2000);
}

TEST_F(RenderFiles, WhatIsNoTraceIsRefused) {
  for (const char* text : {"", "{", "[]", "{}", "[1]", R"([{"domain_faces": 3}])", R"([{"domain_faces": "many"}])"}) {
    try {
      render_trace(write(text));
      FAIL() << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUnusableInput);
      EXPECT_NE(std::string(e.what()).find("trace.json"), std::string::npos);
    }
  }
}

TEST(Plot, DrawsLinesOfAnyRangeEvenNone) {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    Plot plot{"title", "x", "y", false, {{"line", Vec3f(1, 0, 0), {{0, 0}, {scale, scale}, {2 * scale, 0}}}}};
    const Picture picture = draw_plot(plot, 300, 200);
    EXPECT_GT(std::count(picture.pixels.begin(), picture.pixels.end(), Vec3f(1, 0, 0)), 100);
  }
  EXPECT_EQ(draw_plot({}, 300, 200).width, 300);
  Plot one{"", "", "", true, {{"", Vec3f(1, 0, 0), {{5, 5}}}}};
  EXPECT_EQ(draw_plot(one, 300, 200).height, 200);
}

}  // namespace
}  // namespace lozenge
