#include "stages/export/patch_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/files/geometry_image_file.h"

namespace lozenge {
namespace {

using Shape = std::vector<std::int64_t>;
using Ranges = std::vector<std::array<double, 2>>;

/// The patches of one first level: all have as many samples.
struct Group {
  std::int32_t first_level = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  std::int32_t side = 0;  ///< samples

  std::int64_t count() const { return end - begin; }
  std::string named(const std::string& array) const {
    return first_level == 0 ? array : fmt::format("{}.{}", array, first_level);
  }
};

/// That of first level 0, though no patch may begin there, and of all that have patches.
std::vector<Group> groups_of(const PatchLayout& layout) {
  std::vector<Group> groups{{0, 0, 0, layout.samples}};
  for (std::int32_t patch = 0; patch < layout.size(); ++patch) {
    const std::int32_t k = layout.first_level(patch);
    if (k != groups.back().first_level) groups.push_back({k, patch, patch, layout.samples_of(patch)});
    ++groups.back().end;
  }
  return groups;
}

/// The numbers of all samples of a group, `channels` of each. \param fill  (patch, i, j, where they go)
template <typename Value, typename Fill>
std::vector<Value> gathered(const Group& group, int channels, const Fill& fill) {
  const auto side = static_cast<std::size_t>(group.side);
  std::vector<Value> values(static_cast<std::size_t>(group.count()) * side * side * channels);
  Value* to = values.data();
  for (std::int32_t patch = group.begin; patch < group.end; ++patch) {
    for (std::int32_t j = 0; j < group.side; ++j) {
      for (std::int32_t i = 0; i < group.side; ++i, to += channels) fill(patch, i, j, to);
    }
  }
  return values;
}

Shape shape_of(const Group& group) { return {group.count(), group.side, group.side}; }
Shape shape_of(const Group& group, std::int64_t channels) { return {group.count(), group.side, group.side, channels}; }

NamedArray vectors(const Group& group, const char* name, const Ranges& ranges, const auto& at) {
  auto values = gathered<float>(group, 3, [&](auto patch, auto i, auto j, float* to) {
    const Vec3f& v = at(patch, i, j);
    for (int c = 0; c < 3; ++c) to[c] = v[c];
  });
  return {group.named(name), shape_of(group, 3), std::move(values), ranges};
}

NamedArray truths(const Group& group, const char* name, const auto& is_so) {
  auto values = gathered<std::uint8_t>(
      group, 1, [&](auto patch, auto i, auto j, std::uint8_t* to) { *to = is_so(patch, i, j) ? 1 : 0; });
  return {group.named(name), shape_of(group), Truths{std::move(values)}, {{0, 1}}};
}

Ranges ranges_of(const Bounds& bounds) {
  Ranges ranges;
  for (int c = 0; c < 3; ++c) ranges.push_back({bounds.low[c], bounds.high[c]});
  return ranges;
}

/// Joints and weights, in sets of four as glTF has them.
void add_influences(const GeometryImage& image, const Group& group, std::vector<NamedArray>& arrays) {
  constexpr int kOfSet = static_cast<int>(kJointsOfSet);
  constexpr double kMostJoint = 65535;
  const int sets = sets_of_joints(image.levels.front().influences);
  for (int set = 0; set < sets; ++set) {
    const auto value = [&](int first) {
      return [&image, first](auto patch, auto i, auto j, auto* to) {
        const float* from = image.influence(0, patch, i, j) + first;
        for (int c = 0; c < kOfSet; ++c) to[c] = static_cast<std::remove_reference_t<decltype(*to)>>(from[c]);
      };
    };
    arrays.push_back({group.named(fmt::format("joints_{}", set)), shape_of(group, kOfSet),
                      gathered<std::int32_t>(group, kOfSet, value(kOfSet * set)), Ranges(kOfSet, {0, kMostJoint})});
    arrays.push_back({group.named(fmt::format("weights_{}", set)), shape_of(group, kOfSet),
                      gathered<float>(group, kOfSet, value(kMostJoints + kOfSet * set)), Ranges(kOfSet, {0, 1})});
  }
}

void add_samples(const GeometryImage& image, const Group& group, std::vector<NamedArray>& arrays) {
  const auto exists = [&](auto patch, auto i, auto j) { return image.layout.places[patch].right.exists() || j >= i; };
  arrays.push_back(vectors(group, "positions", ranges_of(image.layout.bounds),
                           [&](auto patch, auto i, auto j) { return image.position(0, patch, i, j); }));
  arrays.push_back(vectors(group, "normals", Ranges(3, {-1, 1}),
                           [&](auto patch, auto i, auto j) { return image.normal(0, patch, i, j); }));
  arrays.push_back(truths(group, "mask", exists));
  if (image.has_caps()) {
    arrays.push_back(truths(group, "caps", [&](auto patch, auto i, auto j) { return image.on_cap(0, patch, i, j); }));
  }
  if (image.has_influences()) add_influences(image, group, arrays);
}

void require_same_samples(const GeometryImage& image, const PatchSet& samples) {
  const PatchLayout& layout = image.layout;
  bool are_same = samples.size() == layout.size() && samples.layout.samples == layout.samples &&
                  samples.layout.first_levels == layout.first_levels;
  for (std::int32_t patch = 0; are_same && patch < layout.size(); ++patch) {
    const std::int32_t side = layout.samples_of(patch);
    for (std::int32_t j = 0; are_same && j < side; ++j) {
      for (std::int32_t i = 0; are_same && i < side; ++i) {
        are_same = samples.positions[samples.index(patch, i, j)] == image.position(0, patch, i, j);
      }
    }
  }
  if (!are_same) {
    throw Error(ExitCode::kUnusableInput,
                "the geometry image wasn't sampled from this map; give the one that `lozenge sample` was given");
  }
}

void add_sources(const PatchSet& samples, const Group& group, std::vector<NamedArray>& arrays) {
  arrays.push_back({group.named("source_triangles"),
                    shape_of(group),
                    gathered<std::int32_t>(group, 1,
                                           [&](auto patch, auto i, auto j, std::int32_t* to) {
                                             *to = samples.source_triangles[samples.index(patch, i, j)];
                                           }),
                    {{-1, 0}}});
  arrays.push_back(vectors(group, "source_weights", Ranges(3, {0, 1}), [&](auto patch, auto i, auto j) {
    return samples.source_weights[samples.index(patch, i, j)];
  }));
}

/// Which columns (and rows) of a tile lie inside of its patch.
struct InnerTexels {
  std::int32_t begin = 0;      ///< in texels of the map, from the tile's edge
  std::vector<double> places;  ///< [column] its u
};

InnerTexels inner_texels(const BakedMap& map, const MapTile& tile) {
  const std::int32_t shrink = map.shrink;
  if (tile.x % shrink != 0 || tile.y % shrink != 0 || tile.size % shrink != 0) {
    throw Error(ExitCode::kUnsupported,
                fmt::format("the {} map has texels that lie across borders of patches; bake it with another size",
                            traits_of(map.kind).option));
  }
  InnerTexels inner;
  for (std::int32_t k = 0; k < tile.size / shrink; ++k) {
    const double at = shrink * k + (shrink - 1) / 2.0 - tile.gutter;
    if (at < 0 || at > tile.inner() - 1) continue;
    if (inner.places.empty()) inner.begin = k;
    inner.places.push_back(at / (tile.inner() - 1));
  }
  return inner;
}

Ranges ranges_of(const BakedMap& map, const Bounds& bounds) {
  const MapTraits& traits = traits_of(map.kind);
  if (fits_integers(traits)) {
    const NumberRange range = range_of(traits.values);
    return Ranges(static_cast<std::size_t>(map.channels), {range.least, range.most});
  }
  return ranges_of(bounds);
}

void add_map(const BakedMap& map, const PatchLayout& layout, const Group& group, std::vector<NamedArray>& arrays) {
  if (group.count() == 0) return;
  std::string name = fmt::format("map_{}", traits_of(map.kind).option);
  std::replace(name.begin(), name.end(), '-', '_');
  InnerTexels inner = inner_texels(map, map.layout.tile_of(group.begin));
  const auto side = static_cast<std::int32_t>(inner.places.size());
  const Group texels{group.first_level, group.begin, group.end, side};
  auto values = gathered<float>(texels, map.channels, [&](auto patch, auto i, auto j, float* to) {
    const MapTile tile = map.layout.tile_of(patch);
    const auto x = static_cast<std::size_t>(tile.x / map.shrink + inner.begin + i);
    const auto y = static_cast<std::size_t>(tile.y / map.shrink + inner.begin + j);
    std::copy_n(&map.texels[(y * map.width() + x) * map.channels], map.channels, to);
  });
  arrays.push_back(
      {texels.named(name), shape_of(texels, map.channels), std::move(values), ranges_of(map, layout.bounds)});
  arrays.push_back({texels.named(name + "_at"), {side}, std::move(inner.places)});
}

NamedArray column(const char* name, const PatchLayout& layout, const auto& number) {
  std::vector<std::int32_t> values;
  for (std::int32_t patch = 0; patch < layout.size(); ++patch) values.push_back(number(patch));
  return {name, {layout.size()}, std::move(values)};
}

/// What is said of whole patches.
void add_tables(const PatchLayout& layout, std::vector<NamedArray>& arrays) {
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> places;
  for (const auto& sides : layout.adjacency) {
    for (const PatchSide& side : sides) neighbours.push_back(side.patch < 0 ? -1 : 4 * side.patch + side.side);
  }
  for (const PatchPlace& p : layout.places) {
    places.insert(places.end(), {p.a, p.b, p.left.triangle, p.left.side, p.right.triangle, p.right.side});
  }
  arrays.push_back({"adjacency", {layout.size(), 4}, std::move(neighbours)});
  arrays.push_back({"places", {layout.size(), 6}, std::move(places)});
  arrays.push_back(column("first_levels", layout, [&](auto patch) { return layout.first_level(patch); }));
  if (!layout.material_classes.empty()) {
    arrays.push_back(column("material_classes", layout, [&](auto patch) { return layout.material_classes[patch]; }));
  }
  if (!layout.bodies.empty()) {
    arrays.push_back(column("body_of", layout, [&](auto patch) { return layout.bodies.owner_of(patch); }));
  }
}

/// The triangles that samples are told to lie on.
void add_mesh(const SourceMesh& mesh, std::vector<NamedArray>& arrays) {
  std::vector<float> positions;
  for (const Vec3f& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  std::vector<std::int32_t> corners;
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  const auto count = [](const auto& rows) { return static_cast<std::int64_t>(rows.size()); };
  arrays.push_back({"mesh_positions", {count(mesh.positions), 3}, std::move(positions)});
  arrays.push_back({"mesh_triangles", {count(mesh.triangles), 3}, std::move(corners)});
}

}  // namespace

std::vector<NamedArray> patch_arrays(const GeometryImage& image, const BakedMaps& maps, const SampleSources* sources) {
  for (const BakedMap& map : maps.maps) {
    if (!map.layout.fits(image.layout)) {
      throw Error(
          ExitCode::kUnusableInput,
          fmt::format("the {} map was baked for another geometry image; bake it again", traits_of(map.kind).option));
    }
  }
  if (sources != nullptr) require_same_samples(image, *sources->samples);
  std::vector<NamedArray> arrays{{"about", {}, geometry_image_json(image)}};
  add_tables(image.layout, arrays);
  for (const Group& group : groups_of(image.layout)) {
    add_samples(image, group, arrays);
    if (sources != nullptr) add_sources(*sources->samples, group, arrays);
    for (const BakedMap& map : maps.maps) add_map(map, image.layout, group, arrays);
  }
  if (sources != nullptr) add_mesh(*sources->mesh, arrays);
  return arrays;
}

}  // namespace lozenge
