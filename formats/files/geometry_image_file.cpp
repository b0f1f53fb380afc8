// A part of the EXR for each level of detail, a tile for each patch. The JSON beside it says the same, for tools that
// read no EXR; it is written from the same values and never read back.
#include "formats/files/geometry_image_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfPartType.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>
#include <fmt/format.h>

#include <cmath>
#include <new>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/exr_layout.h"
#include "formats/files/picture_check.h"
#include "formats/patches/geometry_image_check.h"

namespace lozenge {

namespace {

const std::string kKind = "geometry image";
const std::vector<std::string> kChannels{"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

std::string part_name(std::size_t level) { return fmt::format("level{}", level); }

/// Parts lie in their level's arrays. (OpenEXR takes pointers to what it may change, even where it only reads.)
Imf::FrameBuffer frame_of(const GeometryImage& image, const GeometryLevel& level) {
  Imf::FrameBuffer frame;
  const auto insert = [&](const std::string& name, const std::vector<Vec3f>& values) {
    char* const base = reinterpret_cast<char*>(const_cast<Vec3f*>(values.data()));
    for (int axis = 0; axis < 3; ++axis) {
      frame.insert(name + "." + "XYZ"[axis], Imf::Slice(Imf::FLOAT, base + axis * sizeof(float), sizeof(Vec3f),
                                                        sizeof(Vec3f) * image.width(level)));
    }
  };
  insert("P", level.positions);
  insert("N", level.normals);
  if (!level.caps.empty()) {
    frame.insert(kCapChannel,
                 Imf::Slice(Imf::UINT, reinterpret_cast<char*>(const_cast<std::uint32_t*>(level.caps.data())),
                            sizeof(std::uint32_t), sizeof(std::uint32_t) * image.width(level)));
  }
  if (!level.influences.empty()) {
    insert_influences(frame, level.influences, static_cast<std::size_t>(image.width(level)));
  }
  return frame;
}

Imf::Header header_of(const GeometryImage& image, std::size_t l) {
  const GeometryLevel& level = image.levels[l];
  const GeometryLevel& finest = image.levels.front();
  const auto window = [&](const GeometryLevel& of) {
    return Imath::Box2i({0, 0}, {image.width(of) - 1, GeometryImage::height(of) - 1});
  };
  // All parts of a file share one display window.
  Imf::Header header(window(finest), window(level));
  header.setType(Imf::TILEDIMAGE);
  header.setName(part_name(l));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(Imf::TileDescription(level.samples, level.samples, Imf::ONE_LEVEL));
  for (const std::string& name : kChannels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  header.insert("lozenge.level", Imf::IntAttribute(static_cast<int>(l)));
  if (!level.caps.empty()) header.channels().insert(kCapChannel, Imf::Channel(Imf::UINT));
  if (!level.influences.empty()) add_influence_channels(header, sets_of_joints(finest.influences));
  if (l == 0) {
    header.insert("lozenge.levels", Imf::IntAttribute(static_cast<int>(image.levels.size())));
    header.insert("lozenge.columns", Imf::IntAttribute(image.columns));
    header.insert("lozenge.rows", Imf::IntAttribute(finest.rows));
    put_layout(header, kKind, image.layout);
  }
  return header;
}

void write_exr(const std::filesystem::path& file, const GeometryImage& image) {
  std::vector<Imf::Header> headers;
  for (std::size_t l = 0; l < image.levels.size(); ++l) headers.push_back(header_of(image, l));
  Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    Imf::TiledOutputPart part(out, static_cast<int>(l));
    part.setFrameBuffer(frame_of(image, image.levels[l]));
    part.writeTiles(0, image.columns - 1, 0, image.levels[l].rows - 1);
  }
}

/// One row of numbers a line: short enough to read, and the lines stay in order.
template <typename Rows, typename Row>
std::string json_rows(const Rows& rows, Row row) {
  std::string text = "[";
  for (std::size_t n = 0; n < rows.size(); ++n) text += fmt::format("{}\n    [{}]", n > 0 ? "," : "", row(rows[n]));
  return text + "\n  ]";
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The shortest decimals that give the same float back.
std::string json_vector(const Vec3f& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// A member of the object that has a number for each patch; nothing where there are none.
std::string json_column(const char* name, const std::vector<std::int32_t>& numbers) {
  return numbers.empty() ? "" : fmt::format(",\n  \"{}\": [{}]", name, fmt::join(numbers, ", "));
}

/// The last members of the object; nothing where all stands still.
std::string json_bodies(const Bodies& bodies) {
  if (bodies.empty()) return "";
  std::string list;
  for (const Body& body : bodies.bodies) {
    list += fmt::format("{}\n    {{\"name\": {}, \"skin\": {}, \"places\": [", list.empty() ? "" : ",",
                        json_string(body.name), body.skin);
    for (std::size_t p = 0; p < body.places.size(); ++p) {
      list += fmt::format("{}\n      {{\"node\": {}, \"placement\": [{}]}}", p > 0 ? "," : "", body.places[p].node,
                          fmt::join(body.places[p].placement, ", "));
    }
    list += "\n    ]}";
  }
  return fmt::format(",\n  \"bodies\": [{}\n  ],\n  \"bodyOf\": [{}]", list, fmt::join(bodies.owner, ", "));
}

std::string json_of(const GeometryImage& image) {
  std::string levels;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    levels +=
        fmt::format("{}\n    {{\"part\": \"{}\", \"samples\": {}, \"width\": {}, \"height\": {}, \"patches\": {}}}",
                    l > 0 ? "," : "", part_name(l), level.samples, image.width(level), GeometryImage::height(level),
                    image.layout.count_on(static_cast<std::int32_t>(l)));
  }
  const std::string places = json_rows(image.layout.places, [](const PatchPlace& p) {
    return fmt::format("{}, {}, {}, {}, {}, {}", p.a, p.b, p.left.triangle, p.left.side, p.right.triangle,
                       p.right.side);
  });
  const std::string adjacency = json_rows(image.layout.adjacency, [](const std::array<PatchSide, 4>& sides) {
    const auto code = [](PatchSide s) { return s.patch < 0 ? -1 : 4 * s.patch + s.side; };
    return fmt::format("{}, {}, {}, {}", code(sides[0]), code(sides[1]), code(sides[2]), code(sides[3]));
  });
  return fmt::format(
      "{{\n  \"kind\": \"{}\",\n  \"version\": {},\n  \"scene\": {},\n  \"origin\": {},\n  \"samples\": {},\n"
      "  \"patches\": {},\n  \"doubleSided\": {},\n  \"columns\": {},\n  \"rows\": {},\n  \"bounds\": {{\"low\": {}, "
      "\"high\": {}}},\n  \"translation\": [{}, {}, {}],\n  \"sourceTriangles\": {},\n"
      "  \"levels\": [{}\n  ],\n  \"places\": {},\n  \"adjacency\": {}{}{}{}{}\n}}\n",
      kKind, kGeometryImageVersion, json_string(image.layout.scene_name), json_string(image.layout.origin),
      image.layout.samples, image.size(), image.layout.double_sided, image.columns, image.levels.front().rows,
      json_vector(image.layout.bounds.low), json_vector(image.layout.bounds.high), image.layout.translation.x,
      image.layout.translation.y, image.layout.translation.z, image.layout.source_triangles, levels, places, adjacency,
      image.layout.deviation ? fmt::format(",\n  \"deviation\": {}", *image.layout.deviation) : "",
      json_column("firstLevels", image.layout.first_levels),
      json_column("materialClasses", image.layout.material_classes), json_bodies(image.layout.bodies));
}

/// Columns that the patches can fill, and as many rows as they take.
void require_atlas(const GeometryImage& image, std::int32_t rows, const std::string& file) {
  if (image.columns < 1 || image.columns > image.size()) {
    refuse_exr(file, fmt::format("an atlas of {} columns for {} patches", image.columns, image.size()));
  }
  if (rows != image.rows_on(0)) {
    refuse_exr(file, fmt::format("an atlas of {} x {} tiles does not fit {} patches", image.columns, rows,
                                 image.layout.count_on(0)));
  }
}

/// A file of the first version marks caps on the finest level alone.
bool should_have_caps(const Imf::MultiPartInputFile& in, int l) {
  return has_cap_channel(in.header(0)) && (l == 0 || get_int(in.header(0), "lozenge.version", "") > 1);
}

/// The marks of the finest level, as a coarser one repeats its samples.
void repeat_caps(GeometryImage& image, int l) {
  const GeometryLevel& finest = image.levels.front();
  GeometryLevel& level = image.levels[l];
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    for (std::int32_t j = 0; j < level.samples; ++j) {
      for (std::int32_t i = 0; i < level.samples; ++i) {
        level.caps[image.index(level, patch, i, j)] = finest.caps[image.index(finest, patch, i << l, j << l)];
      }
    }
  }
}

/// Appends level `l` to the image.
void read_level(Imf::MultiPartInputFile& in, GeometryImage& image, int l, const std::filesystem::path& path) {
  const std::string name = path.string();
  const Imf::Header& header = in.header(l);
  if (get_int(header, "lozenge.level", name) != l) refuse_exr(name, fmt::format("part {} is not level {}", l, l));
  const bool has_caps = should_have_caps(in, l);
  const int sets = sets_of_influence_channels(in.header(0));
  const bool has_influences = sets > 0;
  std::vector<std::string> floats = kChannels;
  const std::vector<std::string> of_joints = influence_channels(sets);
  floats.insert(floats.end(), of_joints.begin(), of_joints.end());
  require_channels(header, floats, has_caps ? std::vector<std::string>{kCapChannel} : std::vector<std::string>{}, name);
  require_tiles(header, ((image.layout.samples - 1) >> l) + 1, image.columns, image.rows_on(l), path);
  image.levels.push_back(image.empty_level(l, has_caps, has_influences));
  GeometryLevel& level = image.levels.back();
  Imf::TiledInputPart part(in, l);
  part.setFrameBuffer(frame_of(image, level));
  part.readTiles(0, image.columns - 1, 0, level.rows - 1);
  if (!has_caps && image.has_caps()) {
    level.caps.assign(level.positions.size(), 0);
    repeat_caps(image, l);
  }
}

GeometryImage read(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (const auto defect = find_picture_defect(path)) refuse_exr(name, *defect);
  Imf::MultiPartInputFile in(path.c_str());
  const Imf::Header& first = in.header(0);
  GeometryImage image;
  image.layout = get_layout(first, kKind, name);
  image.columns = get_int(first, "lozenge.columns", name);
  require_atlas(image, get_int(first, "lozenge.rows", name), name);
  int levels = 1;
  while (((image.layout.samples - 1) >> levels) > 0) ++levels;
  if (in.parts() != levels || get_int(first, "lozenge.levels", name) != levels) {
    refuse_exr(name, fmt::format("it has {} parts, where {} samples a side have {} levels", in.parts(),
                                 image.layout.samples, levels));
  }
  for (int l = 0; l < levels; ++l) read_level(in, image, l, path);
  if (const auto defect = find_defect(image)) refuse_exr(name, *defect);
  return image;
}

}  // namespace

std::filesystem::path json_beside(const std::filesystem::path& exr) {
  return std::filesystem::path(exr).replace_extension(".json");
}

std::string geometry_image_json(const GeometryImage& image) { return json_of(image); }

void write_geometry_image(const std::filesystem::path& exr, const GeometryImage& image) {
  AtomicFile out(exr);
  try {
    write_exr(out.temporary_path(), image);
  } catch (const std::exception& e) {
    throw Error(ExitCode::kSystem, fmt::format("{}: can't be written: {}", exr.string(), e.what()));
  }
  write_file_whole(json_beside(exr), json_of(image));
  out.commit();
}

GeometryImage read_geometry_image(const std::filesystem::path& exr) {
  try {
    return read(exr);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // no fault of the file
  } catch (const std::exception& e) {
    refuse_exr(exr.string(), fmt::format("it can't be read as EXR ({})", e.what()));
  }
}

}  // namespace lozenge
