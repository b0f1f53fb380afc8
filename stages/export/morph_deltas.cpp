// Differences are exact zeros where a target does nothing: the same sums are taken with and without it. So files can
// leave them out.
#include "stages/export/morph_deltas.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/patches/tangent_frame.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/distinct_positions.h"

namespace lozenge {

namespace {

using Corners = std::array<WeightedElement, 3>;

Corners corners_of(const SourcePoint& point) {
  Corners corners;
  for (std::size_t c = 0; c < 3; ++c) {
    corners[c] = {3 * static_cast<std::size_t>(point.triangle) + c, point.weights[static_cast<int>(c)]};
  }
  return corners;
}

Vec3f value_at(const AttributeStream* stream, const SourcePoint& point) {
  std::array<float, 3> value{};
  if (stream != nullptr && point.triangle >= 0) interpolate(*stream, corners_of(point), value.data());
  return {value[0], value[1], value[2]};
}

Vec3f unit_sum(const SourceMesh& mesh, const std::vector<Vec3f>& normals, const SourcePoint& point) {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3 && point.triangle >= 0; ++c) {
    sum += Vec3d(normals[mesh.triangles[point.triangle][c]]) * point.weights[c];
  }
  return sum.length() > 0 ? Vec3f(sum.normalized()) : Vec3f(0, 0, 0);
}

/// How one target of a body changes normals.
class NormalChange {
 public:
  NormalChange(const SourceMesh& mesh, int set)
      : mesh_(mesh),
        before_(find_stream(mesh.corner_attributes, kNormals)),
        after_(find_stream(mesh.corner_attributes, kMorphNormals, set)) {
    if (before_ == nullptr) find_smooth(set);
  }

  /// Whether it changes any.
  bool exists() const { return !smooth_after_.empty() || (before_ != nullptr && after_ != nullptr); }

  Vec3f at(const SourcePoint& point) const {
    const bool is_smooth = before_ == nullptr;
    const Vec3f after = is_smooth ? unit_sum(mesh_, smooth_after_, point) : value_at(after_, point);
    if (after == Vec3f(0, 0, 0)) return after;
    const Vec3f before = is_smooth ? unit_sum(mesh_, smooth_before_, point) : value_at(before_, point);
    return without_negative_zeros(after - before);
  }

 private:
  /// A source without normals is seen as if they were smooth, whatever its shape.
  void find_smooth(int set) {
    const AttributeStream* offsets = find_stream(mesh_.corner_attributes, kMorphOffsets, set);
    if (offsets == nullptr) return;
    SourceMesh shape;
    shape.positions = mesh_.positions;
    shape.triangles = mesh_.triangles;
    smooth_before_ = vertex_normals(shape);
    for (std::size_t c = 0; c < 3 * mesh_.triangles.size(); ++c) {
      const VertexId v = mesh_.triangles[c / 3][c % 3];
      shape.positions[v] = mesh_.positions[v] + vector_at<Vec3f>(*offsets, c);
    }
    smooth_after_ = vertex_normals(shape);
  }

  const SourceMesh& mesh_;
  const AttributeStream* before_;
  const AttributeStream* after_;
  std::vector<Vec3f> smooth_before_;  ///< [vertex], where the source has no normals
  std::vector<Vec3f> smooth_after_;
};

std::array<EngineMesh*, 2> meshes_of(PartLevel& level) { return {&level.sampled, &level.source}; }

/// Which body of the source a part is; -1 where it has none of its vertices.
std::int32_t body_of(LeveledPart& part, const SourceMesh& source) {
  for (PartLevel& level : part.levels) {
    for (const EngineMesh* mesh : meshes_of(level)) {
      for (const SourcePoint& origin : mesh->origins) {
        if (origin.triangle >= 0) return source.bodies.owner_of(source.materials[origin.triangle]);
      }
    }
  }
  return -1;
}

/// Vertices at one place have the origin of the first of them.
class SharedOrigins {
 public:
  void add(const EngineMesh& mesh) {
    for (std::size_t v = 0; v < mesh.origins.size(); ++v) {
      SourcePoint& origin = origin_at_.try_emplace(numbered(mesh.positions[v], 0).bits, mesh.origins[v]).first->second;
      if (origin.triangle < 0) origin = mesh.origins[v];
    }
  }
  /// [vertex]
  std::vector<SourcePoint> of(const EngineMesh& mesh) const {
    std::vector<SourcePoint> origins;
    origins.reserve(mesh.positions.size());
    for (const Vec3f& p : mesh.positions) origins.push_back(origin_at_.at(numbered(p, 0).bits));
    return origins;
  }

 private:
  std::map<std::array<std::uint32_t, 3>, SourcePoint> origin_at_;
};

void add_deltas(EngineMesh& mesh, const std::vector<SourcePoint>& shared, const SourceMesh& source, int set,
                const NormalChange& normals) {
  const AttributeStream* offsets = find_stream(source.corner_attributes, kMorphOffsets, set);
  MorphDeltas& deltas = mesh.targets.emplace_back();
  deltas.positions.resize(mesh.positions.size());
  if (normals.exists()) deltas.normals.resize(mesh.positions.size());
  for_each_part(mesh.positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      deltas.positions[v] = value_at(offsets, shared[v]);
      if (normals.exists()) deltas.normals[v] = normals.at(mesh.origins[v]);
    }
  });
}

/// All of a part's targets have normals, or none has: engines want them to be alike.
void make_alike(LeveledPart& part) {
  bool any = false;
  const auto for_each_target = [&](auto visit) {
    for (PartLevel& level : part.levels) {
      for (EngineMesh* mesh : meshes_of(level)) {
        for (MorphDeltas& deltas : mesh->targets) visit(deltas);
      }
    }
  };
  for_each_target([&](const MorphDeltas& deltas) { any = any || !deltas.normals.empty(); });
  for_each_target([&](MorphDeltas& deltas) {
    if (any) deltas.normals.resize(deltas.positions.size(), Vec3f(0, 0, 0));
  });
}

void add_targets(LeveledPart& part, const SourceMesh& source) {
  SharedOrigins origins;
  for (PartLevel& level : part.levels) {
    for (const EngineMesh* mesh : meshes_of(level)) origins.add(*mesh);
  }
  std::vector<std::pair<EngineMesh*, std::vector<SourcePoint>>> meshes;
  for (PartLevel& level : part.levels) {
    for (EngineMesh* mesh : meshes_of(level)) meshes.emplace_back(mesh, origins.of(*mesh));
  }
  for (std::size_t set = 0; set < part.body.targets.size(); ++set) {
    const NormalChange normals(source, static_cast<int>(set));
    for (const auto& [mesh, shared] : meshes) add_deltas(*mesh, shared, source, static_cast<int>(set), normals);
  }
  make_alike(part);
}

std::vector<Vec3f> tangents_of(const EngineMesh& mesh, const MorphDeltas& deltas) {
  std::vector<Vec3f> positions = mesh.positions;
  std::vector<Vec3f> normals = mesh.normals;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    positions[v] += deltas.positions[v];
    if (deltas.normals[v] == Vec3f(0, 0, 0)) continue;
    const Vec3f turned = normals[v] + deltas.normals[v];
    if (turned.length() > 0) normals[v] = turned.normalized();
  }
  return vertex_tangents(positions, normals, mesh.texcoords, mesh.indices);
}

void add_tangent_deltas(EngineMesh& mesh) {
  const bool has_normals = !mesh.targets.empty() && !mesh.targets.front().normals.empty();
  if (!has_normals) return;
  const std::vector<Vec3f> before = vertex_tangents(mesh.positions, mesh.normals, mesh.texcoords, mesh.indices);
  for_each_index(mesh.targets.size(), true, [&](std::size_t t) {
    MorphDeltas& deltas = mesh.targets[t];
    deltas.tangents = tangents_of(mesh, deltas);
    for (std::size_t v = 0; v < before.size(); ++v) {
      // In a mirrored space triangles are turned over, and what grows along u seems to shrink.
      const Vec4f& own = mesh.tangents[v];
      const float sign = before[v].dot(Vec3f(own.x, own.y, own.z)) < 0 ? -1.0F : 1.0F;
      deltas.tangents[v] = without_negative_zeros((deltas.tangents[v] - before[v]) * sign);
    }
  });
}

}  // namespace

void add_morph_deltas(std::vector<LeveledPart>& parts, const SourceMesh& source) {
  if (!source.bodies.has_targets()) return;
  for (LeveledPart& part : parts) {
    const std::int32_t body = body_of(part, source);
    part.body.targets.clear();
    if (body < 0) continue;
    part.body.targets = source.bodies.bodies[body].targets;
    if (!part.body.targets.empty()) add_targets(part, source);
  }
  for (LeveledPart& part : parts) {
    for (PartLevel& level : part.levels) {
      for (EngineMesh* mesh : meshes_of(level)) mesh->origins.clear();
    }
  }
}

void add_tangent_deltas(std::vector<LeveledPart>& parts) {
  for (LeveledPart& part : parts) {
    for (PartLevel& level : part.levels) {
      for (EngineMesh* mesh : meshes_of(level)) add_tangent_deltas(*mesh);
    }
  }
}

}  // namespace lozenge
