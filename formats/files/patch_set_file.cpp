// A tile for each patch, one below the other, and a channel for each number of a sample.
#include "formats/files/patch_set_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfPartType.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/exr_layout.h"
#include "formats/files/picture_check.h"

namespace lozenge {

namespace {

const std::string kKind = "patch set";
const std::vector<std::string> kFloats{"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "W.X", "W.Y", "W.Z"};

/// The picture: a tile of N x N samples for each patch, of which a grid of fewer fills the top left corner.
struct Tiles {
  Tiles(const PatchLayout& layout, bool has_caps, bool has_influences) : side(layout.samples) {
    const std::size_t texels = layout.places.size() * side * side;
    positions.resize(texels, Vec3f(0, 0, 0));
    normals.resize(texels, Vec3f(0, 0, 0));
    weights.resize(texels, Vec3f(0, 0, 0));
    triangles.resize(texels, -1);
    if (has_caps) caps.resize(texels, 0);
    if (has_influences) influences.resize(kInfluences.components * texels, 0);
  }

  std::size_t side;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec3f> weights;
  std::vector<TriangleId> triangles;
  std::vector<std::uint32_t> caps;
  std::vector<float> influences;

  std::size_t index(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return (static_cast<std::size_t>(patch) * side + j) * side + i;
  }

  Imf::FrameBuffer frame() {
    Imf::FrameBuffer frame;
    const auto insert = [&](const std::string& name, std::vector<Vec3f>& values) {
      char* const base = reinterpret_cast<char*>(values.data());
      for (int axis = 0; axis < 3; ++axis) {
        frame.insert(name + "." + "XYZ"[axis],
                     Imf::Slice(Imf::FLOAT, base + axis * sizeof(float), sizeof(Vec3f), sizeof(Vec3f) * side));
      }
    };
    const auto insert_whole = [&](const char* name, void* values) {
      frame.insert(
          name, Imf::Slice(Imf::UINT, static_cast<char*>(values), sizeof(std::uint32_t), sizeof(std::uint32_t) * side));
    };
    insert("P", positions);
    insert("N", normals);
    insert("W", weights);
    insert_whole("source", triangles.data());
    if (!caps.empty()) insert_whole(kCapChannel, caps.data());
    if (!influences.empty()) insert_influences(frame, influences, side);
    return frame;
  }
};

void copy_influence(const std::vector<float>& from, std::size_t element, std::vector<float>& to, std::size_t place) {
  std::copy_n(&from[kInfluences.components * element], kInfluences.components, &to[kInfluences.components * place]);
}

/// Calls visit(sample of the set, texel of the picture) for each of both that belong together.
template <typename Visit>
void for_each_texel(const PatchSet& set, const Tiles& tiles, Visit visit) {
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (std::int32_t j = 0; j < set.grids.samples(patch); ++j) {
      for (std::int32_t i = 0; i < set.grids.samples(patch); ++i) {
        visit(set.index(patch, i, j), tiles.index(patch, i, j));
      }
    }
  }
}

void write(const std::filesystem::path& file, const PatchSet& set) {
  Imf::Header header(set.layout.samples, set.layout.samples * set.size());
  header.setType(Imf::TILEDIMAGE);
  header.setName("patches");
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription(Imf::TileDescription(set.layout.samples, set.layout.samples, Imf::ONE_LEVEL));
  for (const std::string& name : kFloats) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  header.channels().insert("source", Imf::Channel(Imf::UINT));
  if (!set.caps.empty()) header.channels().insert(kCapChannel, Imf::Channel(Imf::UINT));
  if (!set.influences.empty()) add_influence_channels(header, sets_of_joints(set.influences));
  put_layout(header, kKind, set.layout);
  Tiles tiles(set.layout, !set.caps.empty(), !set.influences.empty());
  for_each_texel(set, tiles, [&](std::size_t sample, std::size_t texel) {
    tiles.positions[texel] = set.positions[sample];
    tiles.normals[texel] = set.normals[sample];
    tiles.weights[texel] = set.source_weights[sample];
    tiles.triangles[texel] = set.source_triangles[sample];
    if (!set.caps.empty()) tiles.caps[texel] = set.caps[sample];
    if (!set.influences.empty()) copy_influence(set.influences, sample, tiles.influences, texel);
  });
  Imf::MultiPartOutputFile out(file.c_str(), &header, 1);
  Imf::TiledOutputPart part(out, 0);
  part.setFrameBuffer(tiles.frame());
  part.writeTiles(0, 0, 0, set.size() - 1);
}

/// Everything finite; weights and triangles there, where the patch is.
void require_sound(const PatchSet& set, const std::string& file) {
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (std::int32_t j = 0; j < set.grids.samples(patch); ++j) {
      for (std::int32_t i = 0; i < set.grids.samples(patch); ++i) {
        const std::size_t s = set.index(patch, i, j);
        const bool outside = !set.layout.places[patch].right.exists() && i > j;
        const auto fail = [&](const char* what) {
          refuse_exr(file, fmt::format("sample ({}, {}) of patch {} {}", i, j, patch, what));
        };
        for (const auto* values : {&set.positions, &set.normals, &set.source_weights}) {
          for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite((*values)[s][axis])) fail("is not finite");
            if (outside && (*values)[s][axis] != 0) fail("lies outside the surface, but is not zero");
          }
        }
        if (!set.caps.empty() && set.caps[s] > (outside ? 0U : 1U)) fail("has a mark for caps that is neither 0 nor 1");
        if (!set.influences.empty() && !is_influence(&set.influences[kInfluences.components * s])) {
          fail("has joints or weights that are none");
        }
        const Vec3f& w = set.source_weights[s];
        if (outside ? set.source_triangles[s] != -1 : set.source_triangles[s] < 0) fail("has no sound source triangle");
        if (!outside && (std::min({w.x, w.y, w.z}) < 0 || std::abs(w.x + w.y + w.z - 1) > 1e-5F)) {
          fail("has weights that are no barycentric coordinates");
        }
      }
    }
  }
}

PatchSet read(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (const auto defect = find_picture_defect(path)) refuse_exr(name, *defect);
  Imf::MultiPartInputFile in(path.c_str());
  if (in.parts() != 1) refuse_exr(name, fmt::format("it has {} parts, so it is no patch set", in.parts()));
  const Imf::Header& header = in.header(0);
  PatchLayout layout = get_layout(header, kKind, name);
  const bool has_caps = has_cap_channel(header);
  const int sets = sets_of_influence_channels(header);
  const bool has_influences = sets > 0;
  std::vector<std::string> floats = kFloats;
  const std::vector<std::string> of_joints = influence_channels(sets);
  floats.insert(floats.end(), of_joints.begin(), of_joints.end());
  require_channels(header, floats,
                   has_caps ? std::vector<std::string>{"source", kCapChannel} : std::vector<std::string>{"source"},
                   name);
  require_tiles(header, layout.samples, 1, layout.size(), path);
  PatchSet set = empty_patch_set(std::move(layout));
  Tiles tiles(set.layout, has_caps, has_influences);
  if (has_caps) set.caps.resize(set.grids.size());
  if (has_influences) set.influences.resize(kInfluences.components * set.grids.size());
  Imf::TiledInputPart part(in, 0);
  part.setFrameBuffer(tiles.frame());
  part.readTiles(0, 0, 0, set.size() - 1);
  for_each_texel(set, tiles, [&](std::size_t sample, std::size_t texel) {
    set.positions[sample] = tiles.positions[texel];
    set.normals[sample] = tiles.normals[texel];
    set.source_weights[sample] = tiles.weights[texel];
    set.source_triangles[sample] = tiles.triangles[texel];
    if (has_caps) set.caps[sample] = tiles.caps[texel];
    if (has_influences) copy_influence(tiles.influences, texel, set.influences, sample);
  });
  require_sound(set, name);
  return set;
}

}  // namespace

void write_patch_set(const std::filesystem::path& file, const PatchSet& patches) {
  AtomicFile out(file);
  try {
    write(out.temporary_path(), patches);
  } catch (const std::exception& e) {
    throw Error(ExitCode::kSystem, fmt::format("{}: can't be written: {}", file.string(), e.what()));
  }
  out.commit();
}

PatchSet read_patch_set(const std::filesystem::path& file) {
  try {
    return read(file);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // no fault of the file
  } catch (const std::exception& e) {
    refuse_exr(file.string(), fmt::format("it can't be read as EXR ({})", e.what()));
  }
}

}  // namespace lozenge
