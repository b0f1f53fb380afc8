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

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/exr_layout.h"
#include "formats/files/picture_check.h"

namespace lozenge {

namespace {

const std::string kKind = "patch set";
const std::vector<std::string> kFloats{"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "W.X", "W.Y", "W.Z"};

/// The picture's rows are the set's own: patch by patch, row by row. (OpenEXR takes pointers to what it may change,
/// even where it only reads.)
Imf::FrameBuffer frame_of(const PatchSet& set) {
  Imf::FrameBuffer frame;
  const auto insert = [&](const std::string& name, const std::vector<Vec3f>& values) {
    char* const base = reinterpret_cast<char*>(const_cast<Vec3f*>(values.data()));
    for (int axis = 0; axis < 3; ++axis) {
      frame.insert(name + "." + "XYZ"[axis], Imf::Slice(Imf::FLOAT, base + axis * sizeof(float), sizeof(Vec3f),
                                                        sizeof(Vec3f) * set.layout.samples));
    }
  };
  insert("P", set.positions);
  insert("N", set.normals);
  insert("W", set.source_weights);
  frame.insert("source",
               Imf::Slice(Imf::UINT, reinterpret_cast<char*>(const_cast<TriangleId*>(set.source_triangles.data())),
                          sizeof(TriangleId), sizeof(TriangleId) * set.layout.samples));
  if (!set.caps.empty()) {
    frame.insert(kCapChannel,
                 Imf::Slice(Imf::UINT, reinterpret_cast<char*>(const_cast<std::uint32_t*>(set.caps.data())),
                            sizeof(std::uint32_t), sizeof(std::uint32_t) * set.layout.samples));
  }
  return frame;
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
  put_layout(header, kKind, set.layout);
  Imf::MultiPartOutputFile out(file.c_str(), &header, 1);
  Imf::TiledOutputPart part(out, 0);
  part.setFrameBuffer(frame_of(set));
  part.writeTiles(0, 0, 0, set.size() - 1);
}

/// Everything finite; weights and triangles there, where the patch is.
void require_sound(const PatchSet& set, const std::string& file) {
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (std::int32_t j = 0; j < set.layout.samples; ++j) {
      for (std::int32_t i = 0; i < set.layout.samples; ++i) {
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
  PatchSet set;
  set.layout = get_layout(header, kKind, name);
  const bool has_caps = has_cap_channel(header);
  require_channels(header, kFloats,
                   has_caps ? std::vector<std::string>{"source", kCapChannel} : std::vector<std::string>{"source"},
                   name);
  require_tiles(header, set.layout.samples, 1, set.size(), path);
  const std::size_t count = set.layout.places.size() * set.layout.samples * set.layout.samples;
  set.positions.resize(count);
  set.normals.resize(count);
  set.source_triangles.resize(count);
  set.source_weights.resize(count);
  if (has_caps) set.caps.resize(count);
  Imf::TiledInputPart part(in, 0);
  part.setFrameBuffer(frame_of(set));
  part.readTiles(0, 0, 0, set.size() - 1);
  require_sound(set, name);
  return set;
}

}  // namespace

void write_patch_set(const std::filesystem::path& file, const PatchSet& patches) {
  AtomicFile out(file);
  try {
    write(out.temporary_path(), patches);
  } catch (const std::exception& e) {
    throw Error(ExitCode::kUsage, fmt::format("{}: can't be written: {}", file.string(), e.what()));
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
