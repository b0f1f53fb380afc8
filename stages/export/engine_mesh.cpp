// A vertex for each sample of each patch, triangles as the patch has them; then what is not wanted is taken out, and
// the rest is put in the order that GPUs like.
#include "stages/export/engine_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <utility>

#include "formats/patches/patch_grids.h"
#include "formats/patches/tangent_frame.h"

namespace lozenge {
namespace {

/// How much the cache may lose for less overdraw: the factor that meshoptimizer's documentation starts from.
constexpr float kOverdrawThreshold = 1.05F;

bool is_half(const PatchPlace& place) { return !place.right.exists(); }

void append_vertices(EngineMesh& mesh, const GeometryImage& image, int level, const MapLayout& layout,
                     int frame_level) {
  const int finer = std::min(level, frame_level);
  const FrameVertices frames = frame_vertices(image, finer, layout);
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    const std::int32_t samples = image.layout.samples_of(patch, level);
    const std::int32_t step = (frames.grids.samples(patch) - 1) / (samples - 1);
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < samples; ++i) {
        const FrameVertex& frame = frames.at(patch, i * step, j * step);
        mesh.positions.push_back(image.position(level, patch, i, j));
        mesh.normals.push_back(frame.normal);
        mesh.tangents.push_back(frame.tangent_with_sign());
        mesh.texcoords.push_back(frame.texcoord);
        if (!image.has_influences()) continue;
        const float* influence = image.influence(level, patch, i, j);
        mesh.influences.insert(mesh.influences.end(), influence, influence + kInfluences.components);
      }
    }
  }
}

void append_triangles(EngineMesh& mesh, const GeometryImage& image, const PatchGrids& grids) {
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    const auto vertex = [&](const std::array<std::int32_t, 2>& sample) {
      return static_cast<std::uint32_t>(grids.index(patch, sample[0], sample[1]));
    };
    for_each_patch_triangle(grids.samples(patch), is_half(image.layout.places[patch]),
                            [&](const auto& a, const auto& b, const auto& c) {
                              mesh.indices.insert(mesh.indices.end(), {vertex(a), vertex(b), vertex(c)});
                            });
  }
}

/// Moves element v to remap[v]; elements mapped to ~0 go. \param width  values of an element
template <typename T>
void remap_vertices(std::vector<T>& values, const std::vector<std::uint32_t>& remap, std::size_t kept,
                    std::size_t width = 1) {
  if (values.empty()) return;
  std::vector<T> moved(width * kept);
  for (std::size_t v = 0; v < remap.size(); ++v) {
    if (remap[v] != ~std::uint32_t{0}) std::copy_n(&values[width * v], width, &moved[width * remap[v]]);
  }
  values = std::move(moved);
}

/// Moves all that vertices have. \param kept  how many there are then
void remap_all(EngineMesh& mesh, const std::vector<std::uint32_t>& remap, std::size_t kept) {
  remap_vertices(mesh.positions, remap, kept);
  remap_vertices(mesh.normals, remap, kept);
  remap_vertices(mesh.tangents, remap, kept);
  remap_vertices(mesh.texcoords, remap, kept);
  remap_vertices(mesh.influences, remap, kept, kInfluences.components);
  remap_vertices(mesh.origins, remap, kept);
  for (MorphDeltas& target : mesh.targets) {
    remap_vertices(target.positions, remap, kept);
    remap_vertices(target.normals, remap, kept);
    remap_vertices(target.tangents, remap, kept);
  }
}

}  // namespace

std::int64_t count_boundary_sides(const GeometryImage& image, int level) {
  std::int64_t count = 0;
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    if (is_half(image.layout.places[patch])) count += image.layout.samples_of(patch, level) - 1;
  }
  return count;
}

EngineMesh engine_mesh(const GeometryImage& image, int level, const MapLayout& layout, int frame_level) {
  EngineMesh mesh;
  append_vertices(mesh, image, level, layout, frame_level);
  append_triangles(mesh, image, PatchGrids(image.layout, level));
  return mesh;
}

void keep_patches(EngineMesh& mesh, const GeometryImage& image, int level, const std::vector<bool>& keep) {
  const PatchGrids grids(image.layout, level);
  std::size_t kept = 0;
  for (std::size_t c = 0; c < mesh.indices.size(); c += 3) {
    if (!keep[static_cast<std::size_t>(grids.sample_at(mesh.indices[c]).patch)]) continue;
    for (std::size_t k = 0; k < 3; ++k) mesh.indices[kept++] = mesh.indices[c + k];
  }
  mesh.indices.resize(kept);
}

void append(EngineMesh& mesh, const EngineMesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(mesh.positions, more.positions);
  add(mesh.normals, more.normals);
  add(mesh.tangents, more.tangents);
  add(mesh.texcoords, more.texcoords);
  add(mesh.influences, more.influences);
  add(mesh.origins, more.origins);
  for (const std::uint32_t index : more.indices) mesh.indices.push_back(first + index);
}

std::int64_t leave_out_caps(EngineMesh& mesh, const GeometryImage& image, int level) {
  if (!image.has_caps()) return 0;
  const PatchGrids grids(image.layout, level);
  const auto on_cap = [&](std::uint32_t vertex) {
    const PatchSample s = grids.sample_at(vertex);
    return image.on_cap(level, s.patch, s.i, s.j);
  };
  const std::size_t before = mesh.indices.size();
  std::size_t kept = 0;
  for (std::size_t c = 0; c < before; c += 3) {
    const std::array<std::uint32_t, 3> corners{mesh.indices[c], mesh.indices[c + 1], mesh.indices[c + 2]};
    if (std::count_if(corners.begin(), corners.end(), on_cap) >= 2) continue;
    for (const std::uint32_t corner : corners) mesh.indices[kept++] = corner;
  }
  mesh.indices.resize(kept);
  return static_cast<std::int64_t>((before - kept) / 3);
}

std::vector<EngineMesh> split_bodies(EngineMesh mesh, const GeometryImage& image, int level) {
  const Bodies& bodies = image.layout.bodies;
  std::vector<EngineMesh> parts(bodies.bodies.size() + 1);
  if (parts.size() == 1) {
    parts.front() = std::move(mesh);
    return parts;
  }
  const PatchGrids grids(image.layout, level);
  std::vector<std::uint32_t> first;  // [patch] its first vertex in its part
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    const std::int32_t body = bodies.owner_of(static_cast<std::size_t>(patch));
    EngineMesh& part = parts[body + 1];
    first.push_back(static_cast<std::uint32_t>(part.positions.size()));
    const auto append = [&](auto& to, const auto& from, std::size_t width = 1) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(width * grids.first(patch)),
                from.begin() + static_cast<std::ptrdiff_t>(width * grids.first(patch + 1)));
    };
    append(part.positions, mesh.positions);
    append(part.normals, mesh.normals);
    append(part.tangents, mesh.tangents);
    append(part.texcoords, mesh.texcoords);
    if (body >= 0 && bodies.bodies[body].skin >= 0) append(part.influences, mesh.influences, kInfluences.components);
    if (!mesh.origins.empty()) append(part.origins, mesh.origins);
  }
  for (const std::uint32_t vertex : mesh.indices) {
    const std::int32_t patch = grids.sample_at(vertex).patch;
    EngineMesh& part = parts[bodies.owner_of(static_cast<std::size_t>(patch)) + 1];
    part.indices.push_back(first[patch] + static_cast<std::uint32_t>(vertex - grids.first(patch)));
  }
  return parts;
}

EngineMesh chosen_triangles(const EngineMesh& mesh, const std::vector<std::size_t>& triangles) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  EngineMesh chosen = mesh;
  chosen.indices.clear();
  std::vector<std::uint32_t> remap(mesh.positions.size(), kUnused);
  std::uint32_t kept = 0;
  for (const std::size_t t : triangles) {
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
      std::uint32_t& number = remap[mesh.indices[c]];
      if (number == kUnused) number = kept++;
      chosen.indices.push_back(number);
    }
  }
  remap_all(chosen, remap, kept);
  return chosen;
}

void order_for_gpu(EngineMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const std::size_t corners = mesh.indices.size();
  std::vector<std::uint32_t>& indices = mesh.indices;
  meshopt_optimizeVertexCache(indices.data(), indices.data(), corners, vertices);
  meshopt_optimizeOverdraw(indices.data(), indices.data(), corners, &mesh.positions[0].x, vertices, sizeof(Vec3f),
                           kOverdrawThreshold);
  std::vector<std::uint32_t> remap(vertices);
  const std::size_t kept = meshopt_optimizeVertexFetchRemap(remap.data(), indices.data(), corners, vertices);
  meshopt_remapIndexBuffer(indices.data(), indices.data(), corners, remap.data());
  remap_all(mesh, remap, kept);
}

}  // namespace lozenge
