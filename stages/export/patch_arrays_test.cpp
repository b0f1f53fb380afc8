#include "stages/export/patch_arrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "formats/base/error.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/map_layout.h"

namespace lozenge {
namespace {

const NamedArray* find(const std::vector<NamedArray>& arrays, const std::string& name) {
  const auto at = std::find_if(arrays.begin(), arrays.end(), [&](const NamedArray& a) { return a.name == name; });
  return at == arrays.end() ? nullptr : &*at;
}

/// The array that a patch's samples are in, and its place there.
struct InGroup {
  const NamedArray* array = nullptr;
  std::size_t first = 0;
};
InGroup of_patch(const std::vector<NamedArray>& arrays, const PatchLayout& layout, const std::string& name,
                 std::int32_t patch, std::size_t channels) {
  const std::int32_t k = layout.first_level(patch);
  const auto before = k > 0 ? layout.count_on(k - 1) : 0;
  const auto side = static_cast<std::size_t>(layout.samples_of(patch));
  return {find(arrays, k == 0 ? name : name + "." + std::to_string(k)),
          static_cast<std::size_t>(patch - before) * side * side * channels};
}

TEST(PatchArrays, HoldEachSampleOfEachPatchAndWhereItLies) {
  for (const fixtures::OpenSurface& surface : fixtures::open_surfaces()) {
    const PatchSet patches = fixtures::open_patches(surface, 3);
    const GeometryImage image = fixtures::open_image(surface, 3);
    const SampleSources sources{&surface.mesh, &patches};
    const std::vector<NamedArray> arrays = patch_arrays(image, {}, &sources);
    for (std::int32_t patch = 0; patch < image.size(); ++patch) {
      const std::int32_t side = image.layout.samples_of(patch);
      const InGroup positions = of_patch(arrays, image.layout, "positions", patch, 3);
      const InGroup mask = of_patch(arrays, image.layout, "mask", patch, 1);
      const InGroup triangles = of_patch(arrays, image.layout, "source_triangles", patch, 1);
      ASSERT_NE(positions.array, nullptr) << surface.name;
      EXPECT_EQ(positions.array->shape[1], side);
      EXPECT_EQ(positions.array->shape[3], 3);
      for (std::int32_t n = 0; n < side * side; ++n) {
        const std::int32_t i = n % side;
        const std::int32_t j = n / side;
        const auto& floats = std::get<std::vector<float>>(positions.array->values);
        EXPECT_EQ(floats[positions.first + 3 * n + 1], image.position(0, patch, i, j).y);
        const bool exists = image.layout.places[patch].right.exists() || j >= i;
        EXPECT_EQ(std::get<Truths>(mask.array->values).bytes[mask.first + n], exists ? 1 : 0);
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(triangles.array->values)[triangles.first + n],
                  patches.source_triangles[patches.index(patch, i, j)]);
      }
    }
    const auto& neighbours = std::get<std::vector<std::int32_t>>(find(arrays, "adjacency")->values);
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      if (neighbours[n] < 0) continue;
      EXPECT_EQ(neighbours[static_cast<std::size_t>(neighbours[n])], static_cast<std::int32_t>(n));
    }
  }
}

TEST(PatchArrays, HaveNoShapeThatTheirNumbersDontFill) {
  for (const fixtures::OpenSurface& surface : fixtures::open_surfaces()) {
    for (const NamedArray& array : patch_arrays(fixtures::open_image(surface, 3), {})) {
      if (std::holds_alternative<std::string>(array.values)) continue;
      std::size_t count = 1;
      for (const std::int64_t length : array.shape) count *= static_cast<std::size_t>(length);
      const std::size_t held = std::visit(
          [](const auto& values) -> std::size_t {
            if constexpr (requires { values.bytes; }) {
              return values.bytes.size();
            } else {
              return values.size();
            }
          },
          array.values);
      EXPECT_EQ(held, count) << surface.name << " " << array.name;
    }
  }
}

/// A map whose texels are where they lie in their patches: (u, v, 0) of their centres.
BakedMap map_of_places(const PatchLayout& patches, std::int32_t shrink) {
  BakedMap map = neutral_map(MapKind::kPosition, make_map_layout(patches, 256, 2), 0, shrink);
  for (std::int32_t y = 0; y < map.height(); ++y) {
    for (std::int32_t x = 0; x < map.width(); ++x) {
      const std::int32_t patch = map.layout.patch_at(x * shrink, y * shrink);
      if (patch < 0) continue;
      const MapTile tile = map.layout.tile_of(patch);
      const auto place = [&](std::int32_t at, std::int32_t begin) {
        return static_cast<float>((at * shrink + (shrink - 1) / 2.0 - begin - tile.gutter) / (tile.inner() - 1));
      };
      float* texel = &map.texels[3 * (static_cast<std::size_t>(y) * map.width() + x)];
      texel[0] = place(x, tile.x);
      texel[1] = place(y, tile.y);
    }
  }
  return map;
}

TEST(PatchArrays, HoldTheTexelsInsideOfPatchesAndTheirPlaces) {
  for (const std::int32_t shrink : {1, 2, 4}) {
    const GeometryImage image = fixtures::open_image(fixtures::two_scales(4), 3);
    BakedMaps maps;
    maps.maps.push_back(map_of_places(image.layout, shrink));
    const std::vector<NamedArray> arrays = patch_arrays(image, maps);
    for (const std::string ending : {"", ".2"}) {
      const NamedArray* map = find(arrays, "map_position" + ending);
      ASSERT_NE(map, nullptr);
      const auto& places = std::get<std::vector<double>>(find(arrays, "map_position_at" + ending)->values);
      const auto side = static_cast<std::size_t>(map->shape[1]);
      ASSERT_EQ(side, places.size());
      EXPECT_GE(places.front(), 0);
      EXPECT_LE(places.back(), 1);
      if (shrink == 1) {
        EXPECT_EQ(places.back(), 1);
      }
      const auto& texels = std::get<std::vector<float>>(map->values);
      for (std::size_t n = 0; n < texels.size() / 3; ++n) {
        EXPECT_FLOAT_EQ(texels[3 * n], static_cast<float>(places[n % side]));
        EXPECT_FLOAT_EQ(texels[3 * n + 1], static_cast<float>(places[n / side % side]));
      }
    }
  }
}

TEST(PatchArrays, AreRefusedWithSamplesOrMapsOfAnotherImage) {
  const fixtures::OpenSurface surface = fixtures::hemisphere(3);
  const GeometryImage image = fixtures::open_image(surface, 3);
  const PatchSet other = fixtures::open_patches(surface, 2);
  const SampleSources sources{&surface.mesh, &other};
  EXPECT_THROW(patch_arrays(image, {}, &sources), Error);
  BakedMaps maps;
  maps.maps.push_back(fixtures::flat_normal_map());
  EXPECT_THROW(patch_arrays(image, maps), Error);
}

}  // namespace
}  // namespace lozenge
