// The layout is attributes of the first part: numbers and rows of numbers as text. Of the adjacency only what follows
// from the places is believed, so that a file can't contradict itself.
#include "formats/files/exr_layout.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTileDescription.h>
#include <ImfVecAttribute.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>

#include "formats/base/error.h"
#include "formats/files/geometry_image_file.h"

namespace lozenge {

namespace {

/// Files of the first version are read: in them all parts have one scale, classes and translation are 0.
constexpr int kFirstVersion = 1;

/// zlib makes nothing smaller than this (its "Maximum Compression Factor" is 1032).
constexpr double kMostCompression = 1100;

/// The largest N that is believed; far beyond what `sample` makes.
constexpr std::int32_t kMostSamplesRead = 32769;

std::string words(const PatchPlace& p) {
  return fmt::format("{} {} {} {} {} {}", p.a, p.b, p.left.triangle, p.left.side, p.right.triangle, p.right.side);
}
std::int32_t code(PatchSide s) { return s.patch < 0 ? -1 : 4 * s.patch + s.side; }
std::string words(const std::array<PatchSide, 4>& a) {
  return fmt::format("{} {} {} {}", code(a[0]), code(a[1]), code(a[2]), code(a[3]));
}

template <typename Attribute>
const auto& get(const Imf::Header& header, const char* name, const std::string& file) {
  const auto* found = header.findTypedAttribute<Attribute>(name);
  if (!found) {
    refuse_exr(file, fmt::format("it has no attribute {} of type {}, so it is no file of patches that Lozenge wrote",
                                 name, Attribute::staticTypeName()));
  }
  return found->value();
}

/// Exactly `Count` whole numbers with one space between.
template <std::size_t Count>
std::array<std::int32_t, Count> numbers(const std::string& text, const std::string& place, const std::string& file) {
  std::array<std::int32_t, Count> values{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t n = 0; n < Count; ++n) {
    if (n > 0 && at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, values[n]);
    if (error != std::errc{}) refuse_exr(file, fmt::format("{} is not {} whole numbers", place, Count));
    at = next;
  }
  if (at != end) refuse_exr(file, fmt::format("{} is more than {} whole numbers", place, Count));
  return values;
}

std::vector<PatchPlace> get_places(const Imf::Header& header, std::size_t patches, const std::string& file) {
  const auto& rows = get<Imf::StringVectorAttribute>(header, "lozenge.places", file);
  if (rows.size() != patches) refuse_exr(file, fmt::format("lozenge.places has {} rows, not {}", rows.size(), patches));
  std::vector<PatchPlace> places;
  for (const std::string& row : rows) {
    const auto v = numbers<6>(row, fmt::format("row {} of lozenge.places", places.size()), file);
    places.push_back({v[0], v[1], {v[2], v[3]}, {v[4], v[5]}});
  }
  if (const auto defect = find_place_defect(places)) refuse_exr(file, "lozenge.places: " + *defect);
  return places;
}

std::vector<std::array<PatchSide, 4>> get_adjacency(const Imf::Header& header, const std::vector<PatchPlace>& places,
                                                    const std::string& file) {
  const auto& rows = get<Imf::StringVectorAttribute>(header, "lozenge.adjacency", file);
  if (rows.size() != places.size()) {
    refuse_exr(file, fmt::format("lozenge.adjacency has {} rows, not {}", rows.size(), places.size()));
  }
  // Reciprocal by construction: it joins two sides at a time.
  auto adjacency = patch_adjacency(places);
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto v = numbers<4>(rows[p], fmt::format("row {} of lozenge.adjacency", p), file);
    for (std::size_t side = 0; side < 4; ++side) {
      if (v[side] == code(adjacency[p][side])) continue;
      refuse_exr(file,
                 fmt::format("lozenge.adjacency: side {} of patch {} has the neighbour {}, but its place on the domain "
                             "says {}",
                             side, p, v[side], code(adjacency[p][side])));
    }
  }
  return adjacency;
}

/// One row for each place of a body: which body, which node, then its placement.
std::string words(std::size_t body, const BodyPlace& place) {
  return fmt::format("{} {} {}", body, place.node, fmt::join(place.placement, " "));
}

void put_bodies(Imf::Header& header, const Bodies& bodies) {
  std::vector<std::string> names;
  std::vector<std::string> skins;
  std::vector<std::string> places;
  for (const Body& body : bodies.bodies) {
    for (const BodyPlace& place : body.places) places.push_back(words(names.size(), place));
    names.push_back(body.name);
    skins.push_back(std::to_string(body.skin));
  }
  std::vector<std::string> owners;
  for (const std::int32_t owner : bodies.owner) owners.push_back(std::to_string(owner));
  header.insert("lozenge.bodyNames", Imf::StringVectorAttribute(names));
  header.insert("lozenge.bodySkins", Imf::StringVectorAttribute(skins));
  header.insert("lozenge.bodyPlaces", Imf::StringVectorAttribute(places));
  header.insert("lozenge.bodyOf", Imf::StringVectorAttribute(owners));
}

/// \param has_node  whether the row names a node
void read_place(const std::string& row, bool has_node, Bodies& bodies, const char* attribute, const std::string& file) {
  std::istringstream words(row);
  words.imbue(std::locale::classic());
  std::size_t body = 0;
  BodyPlace place;
  words >> body;
  if (has_node) words >> place.node;
  for (double& x : place.placement) words >> x;
  if (!words || body >= bodies.bodies.size()) {
    refuse_exr(file, fmt::format("\"{}\" in {} is no body{} and 16 numbers", row, attribute, has_node ? ", node" : ""));
  }
  bodies.bodies[body].places.push_back(place);
}

const std::vector<std::string>* find_rows(const Imf::Header& header, const char* name) {
  const auto* found = header.findTypedAttribute<Imf::StringVectorAttribute>(name);
  return found == nullptr ? nullptr : &found->value();
}

void read_owners(const Imf::Header& header, const char* name, Bodies& bodies, const std::string& file) {
  for (const std::string& row : get<Imf::StringVectorAttribute>(header, name, file)) {
    bodies.owner.push_back(numbers<1>(row, fmt::format("a row of {}", name), file)[0]);
  }
}

/// Of version 1: meshes whose surface stands in their first place, and copies of them.
Bodies read_repeats(const Imf::Header& header, const std::vector<std::string>& names, const std::string& file) {
  Bodies bodies;
  for (const std::string& name : names) bodies.bodies.push_back({name, {{}}, -1});
  for (const std::string& row : get<Imf::StringVectorAttribute>(header, "lozenge.repeatedCopies", file)) {
    read_place(row, false, bodies, "lozenge.repeatedCopies", file);
  }
  read_owners(header, "lozenge.repeatedOf", bodies, file);
  return bodies;
}

Bodies read_bodies(const Imf::Header& header, const std::vector<std::string>& names, const std::string& file) {
  Bodies bodies;
  const auto& skins = get<Imf::StringVectorAttribute>(header, "lozenge.bodySkins", file);
  if (skins.size() != names.size()) {
    refuse_exr(file, fmt::format("lozenge.bodySkins has {} rows, not {}", skins.size(), names.size()));
  }
  for (std::size_t b = 0; b < names.size(); ++b) {
    bodies.bodies.push_back({names[b], {}, numbers<1>(skins[b], "a row of lozenge.bodySkins", file)[0]});
  }
  for (const std::string& row : get<Imf::StringVectorAttribute>(header, "lozenge.bodyPlaces", file)) {
    read_place(row, true, bodies, "lozenge.bodyPlaces", file);
  }
  read_owners(header, "lozenge.bodyOf", bodies, file);
  return bodies;
}

Bodies get_bodies(const Imf::Header& header, const std::vector<std::array<PatchSide, 4>>& adjacency,
                  const std::string& file) {
  Bodies bodies;
  if (const auto* names = find_rows(header, "lozenge.bodyNames")) bodies = read_bodies(header, *names, file);
  else if (const auto* meshes = find_rows(header, "lozenge.repeatedNames"))
    bodies = read_repeats(header, *meshes, file);
  else return bodies;
  if (const auto defect = find_defect(bodies, adjacency.size())) refuse_exr(file, "of its patches, " + *defect);
  for (std::size_t p = 0; p < bodies.owner.size(); ++p) {
    for (const PatchSide& side : adjacency[p]) {
      if (side.patch < 0 || bodies.owner[side.patch] == bodies.owner[p]) continue;
      refuse_exr(file, fmt::format("patches {} and {} touch, but belong to different bodies", p, side.patch));
    }
  }
  return bodies;
}

std::vector<std::string> rows_of(const std::vector<std::int32_t>& numbers) {
  std::vector<std::string> rows;
  for (const std::int32_t number : numbers) rows.push_back(std::to_string(number));
  return rows;
}

/// A number for each patch; nothing where there is no such attribute, or the file is of the first version.
std::vector<std::int32_t> get_column(const Imf::Header& header, const char* name, std::size_t patches,
                                     const std::string& file) {
  std::vector<std::int32_t> column;
  if (!header.findTypedAttribute<Imf::StringVectorAttribute>(name)) return column;
  for (const std::string& row : get<Imf::StringVectorAttribute>(header, name, file)) {
    column.push_back(numbers<1>(row, fmt::format("a row of {}", name), file)[0]);
  }
  if (column.size() != patches) refuse_exr(file, fmt::format("{} has {} rows, not {}", name, column.size(), patches));
  return column;
}

std::vector<MaterialClass> get_classes(const Imf::Header& header, std::size_t patches, const std::string& file) {
  std::vector<MaterialClass> classes = get_column(header, "lozenge.materialClasses", patches, file);
  for (const MaterialClass c : classes) {
    if (c >= 0 && c <= kMostMaterialClass) continue;
    refuse_exr(file, fmt::format("{} in lozenge.materialClasses is not 0 to {}", c, kMostMaterialClass));
  }
  return classes;
}

Vec3d get_translation(const Imf::Header& header, const std::string& file) {
  if (!header.findTypedAttribute<Imf::V3dAttribute>("lozenge.translation")) return {0, 0, 0};
  const Imath::V3d translation = get<Imf::V3dAttribute>(header, "lozenge.translation", file);
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(translation[axis])) refuse_exr(file, "its attribute lozenge.translation is not finite");
  }
  return translation;
}

std::optional<double> get_deviation(const Imf::Header& header, const std::string& file) {
  if (!header.findTypedAttribute<Imf::DoubleAttribute>("lozenge.deviation")) return std::nullopt;
  const double deviation = get<Imf::DoubleAttribute>(header, "lozenge.deviation", file);
  if (!(deviation >= 0)) refuse_exr(file, "its attribute lozenge.deviation is no distance");
  return deviation;
}

Bounds get_bounds(const Imf::Header& header, const std::string& file) {
  Bounds bounds{get<Imf::V3fAttribute>(header, "lozenge.boundsLow", file),
                get<Imf::V3fAttribute>(header, "lozenge.boundsHigh", file)};
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(bounds.low[axis]) || !std::isfinite(bounds.high[axis]) || bounds.low[axis] > bounds.high[axis]) {
      refuse_exr(file, fmt::format("its bounds are not finite or not in order along axis {}", axis));
    }
  }
  return bounds;
}

}  // namespace

void refuse_exr(const std::string& file, const std::string& what) {
  throw Error(ExitCode::kUnusableInput, file + ": " + what + "; make the file again");
}

std::int32_t get_int(const Imf::Header& header, const char* name, const std::string& file) {
  return get<Imf::IntAttribute>(header, name, file);
}

void put_layout(Imf::Header& header, const std::string& kind, const PatchLayout& layout) {
  std::vector<std::string> places;
  for (const PatchPlace& place : layout.places) places.push_back(words(place));
  std::vector<std::string> adjacency;
  for (const auto& sides : layout.adjacency) adjacency.push_back(words(sides));
  header.insert("lozenge.kind", Imf::StringAttribute(kind));
  header.insert("lozenge.version", Imf::IntAttribute(kGeometryImageVersion));
  header.insert("lozenge.samples", Imf::IntAttribute(layout.samples));
  header.insert("lozenge.patches", Imf::IntAttribute(static_cast<int>(layout.places.size())));
  header.insert("lozenge.boundsLow", Imf::V3fAttribute(layout.bounds.low));
  header.insert("lozenge.boundsHigh", Imf::V3fAttribute(layout.bounds.high));
  header.insert("lozenge.scene", Imf::StringAttribute(layout.scene_name));
  header.insert("lozenge.origin", Imf::StringAttribute(layout.origin));
  header.insert("lozenge.doubleSided", Imf::IntAttribute(layout.double_sided ? 1 : 0));
  header.insert("lozenge.places", Imf::StringVectorAttribute(places));
  header.insert("lozenge.adjacency", Imf::StringVectorAttribute(adjacency));
  header.insert("lozenge.translation", Imf::V3dAttribute(layout.translation));
  header.insert("lozenge.sourceTriangles", Imf::IntAttribute(static_cast<int>(layout.source_triangles)));
  if (layout.deviation) header.insert("lozenge.deviation", Imf::DoubleAttribute(*layout.deviation));
  if (!layout.first_levels.empty()) {
    header.insert("lozenge.firstLevels", Imf::StringVectorAttribute(rows_of(layout.first_levels)));
  }
  if (!layout.material_classes.empty()) {
    header.insert("lozenge.materialClasses", Imf::StringVectorAttribute(rows_of(layout.material_classes)));
  }
  if (!layout.bodies.empty()) put_bodies(header, layout.bodies);
}

PatchLayout get_layout(const Imf::Header& header, const std::string& kind, const std::string& file) {
  const std::string& found = get<Imf::StringAttribute>(header, "lozenge.kind", file);
  if (found != kind) refuse_exr(file, fmt::format("it holds a {}, not a {}", found, kind));
  const std::int32_t version = get_int(header, "lozenge.version", file);
  if (version < kFirstVersion || version > kGeometryImageVersion) {
    refuse_exr(file, fmt::format("it has version {} of the format, and this program reads versions {} to {}", version,
                                 kFirstVersion, kGeometryImageVersion));
  }
  PatchLayout layout;
  layout.samples = get_int(header, "lozenge.samples", file);
  if (layout.samples < 2 || layout.samples > kMostSamplesRead || ((layout.samples - 1) & (layout.samples - 2)) != 0) {
    refuse_exr(file, fmt::format("{} samples a side are not a power of two plus one", layout.samples));
  }
  const std::int32_t patches = get_int(header, "lozenge.patches", file);
  if (patches < 1) refuse_exr(file, fmt::format("it has {} patches", patches));
  layout.places = get_places(header, static_cast<std::size_t>(patches), file);
  layout.adjacency = get_adjacency(header, layout.places, file);
  layout.first_levels = get_column(header, "lozenge.firstLevels", layout.places.size(), file);
  if (const auto defect = find_first_level_defect(layout)) refuse_exr(file, "lozenge.firstLevels: " + *defect);
  layout.material_classes = get_classes(header, layout.places.size(), file);
  layout.translation = get_translation(header, file);
  layout.deviation = get_deviation(header, file);
  if (version > kFirstVersion) layout.source_triangles = get_int(header, "lozenge.sourceTriangles", file);
  if (layout.source_triangles < 0) refuse_exr(file, "its attribute lozenge.sourceTriangles is negative");
  layout.bounds = get_bounds(header, file);
  layout.scene_name = get<Imf::StringAttribute>(header, "lozenge.scene", file);
  layout.origin = get<Imf::StringAttribute>(header, "lozenge.origin", file);
  const std::int32_t double_sided = get_int(header, "lozenge.doubleSided", file);
  if (double_sided != 0 && double_sided != 1) {
    refuse_exr(file, fmt::format("its attribute lozenge.doubleSided is {}, not 0 or 1", double_sided));
  }
  layout.double_sided = double_sided != 0;
  layout.bodies = get_bodies(header, layout.adjacency, file);
  return layout;
}

void require_tiles(const Imf::Header& header, std::int32_t tile, std::int32_t columns, std::int32_t rows,
                   const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!header.hasTileDescription()) refuse_exr(name, "it is not tiled");
  const Imf::TileDescription& tiles = header.tileDescription();
  if (static_cast<std::int64_t>(tiles.xSize) != tile || static_cast<std::int64_t>(tiles.ySize) != tile ||
      tiles.mode != Imf::ONE_LEVEL) {
    refuse_exr(name, fmt::format("its tiles are {} x {} pixels, where a patch has {} samples a side", tiles.xSize,
                                 tiles.ySize, tile));
  }
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{tile} * columns;
  const std::int64_t height = std::int64_t{tile} * rows;
  if (window.min != Imath::V2i(0, 0) || window.max.x != width - 1 || window.max.y != height - 1) {
    refuse_exr(name, fmt::format("its picture is not {} x {} pixels from (0, 0), as {} x {} tiles of {} are", width,
                                 height, columns, rows, tile));
  }
  int channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
  const double bytes = 4.0 * channels * static_cast<double>(width) * static_cast<double>(height);
  if (bytes > kMostCompression * static_cast<double>(std::filesystem::file_size(file))) {
    refuse_exr(name, fmt::format("it is too short for {} x {} pixels", width, height));
  }
}

bool has_cap_channel(const Imf::Header& header) { return header.channels().findChannel(kCapChannel) != nullptr; }

std::vector<std::string> influence_channels(int sets) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < kInfluenceChannels.size(); ++c) {
    if (static_cast<int>(c) % kMostJoints < sets * kJointsOfSet) names.emplace_back(kInfluenceChannels[c]);
  }
  return names;
}

int sets_of_influence_channels(const Imf::Header& header) {
  if (header.channels().findChannel(kInfluenceChannels.front()) == nullptr) return 0;
  return header.channels().findChannel(kInfluenceChannels[kJointsOfSet]) == nullptr ? 1 : 2;
}

void add_influence_channels(Imf::Header& header, int sets) {
  for (const std::string& name : influence_channels(sets)) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
}

void insert_influences(Imf::FrameBuffer& frame, const std::vector<float>& influences, std::size_t row) {
  // OpenEXR takes pointers to what it may change, even where it only reads.
  char* const base = reinterpret_cast<char*>(const_cast<float*>(influences.data()));
  constexpr std::size_t kSize = kInfluences.components * sizeof(float);
  for (std::size_t c = 0; c < kInfluenceChannels.size(); ++c) {
    frame.insert(kInfluenceChannels[c], Imf::Slice(Imf::FLOAT, base + c * sizeof(float), kSize, kSize * row));
  }
}

void require_channels(const Imf::Header& header, const std::vector<std::string>& floats,
                      const std::vector<std::string>& whole, const std::string& file) {
  std::size_t count = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++count;
  if (count != floats.size() + whole.size()) refuse_exr(file, fmt::format("it has {} channels", count));
  const auto require = [&](const std::string& name, Imf::PixelType type) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (!channel || channel->type != type || channel->xSampling != 1 || channel->ySampling != 1) {
      refuse_exr(file, fmt::format("it has no full channel {} of 32 bits", name));
    }
  };
  for (const std::string& name : floats) require(name, Imf::FLOAT);
  for (const std::string& name : whole) require(name, Imf::UINT);
}

}  // namespace lozenge
