#include "formats/files/surface_builder.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "formats/base/error.h"
#include "formats/files/skinned_vertices.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/normal_transform.h"
#include "formats/surface/placement.h"
#include "formats/surface/repair_report.h"
#include "formats/surface/rig.h"

namespace lozenge {

namespace {

using Imath::M44d;

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// [vertex] the first of equal elements' number, numbered in the order of their first.
/// \param width  floats of an element
std::vector<unsigned int> number_equal(const void* elements, std::size_t count, std::size_t width) {
  std::vector<unsigned int> remap(count);
  meshopt_generateVertexRemap(remap.data(), nullptr, count, elements, count, width * sizeof(float));
  return remap;
}

/// Triangles in the order of their materials, stable; empty where they already are.
std::vector<std::uint32_t> order_by_material(const std::vector<std::int32_t>& materials) {
  if (std::is_sorted(materials.begin(), materials.end())) return {};
  std::vector<std::uint32_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return materials[a] < materials[b]; });
  return order;
}

template <typename T>
void reorder(std::vector<T>& items, const std::vector<std::uint32_t>& order) {
  if (order.empty()) return;
  std::vector<T> moved(items.size());
  for (std::size_t i = 0; i < order.size(); ++i) moved[i] = items[order[i]];
  items = std::move(moved);
}

/// Puts the attributes of each corner's vertex to the corner, and frees the vertices'.
AttributeStreams to_corners(AttributeStreams of_vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (triangles.empty()) return {};
  std::erase_if(of_vertices, [](const AttributeStream& stream) { return stream.kind.tells_vertices_apart; });
  const std::span<const std::uint32_t> vertices(triangles.front().data(), 3 * triangles.size());
  for (AttributeStream& stream : of_vertices) {
    stream.values = gathered(stream.values, static_cast<std::size_t>(stream.kind.components), vertices);
  }
  return of_vertices;
}

}  // namespace

void SurfaceBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  positions_.reserve(vertices);
  triangles_.reserve(triangles);
  materials_.reserve(triangles);
}

void SurfaceBuilder::add_positions(const Primitive& primitive, const Target& target, const std::string& place) {
  const AttributeStream* influences = find_stream(primitive.attributes, kInfluences);
  const std::size_t before = positions_.size();
  for (std::size_t v = 0; v < primitive.vertices(); ++v) {
    const Vec3f given(primitive.positions[3 * v], primitive.positions[3 * v + 1], primitive.positions[3 * v + 2]);
    const M44d& m = target.joints != nullptr ? blended(*target.joints, influences->at(v)) : target.transform;
    const Vec3f moved(placed(m, Vec3d(given)));
    if (!is_finite(moved)) {
      throw Error(ExitCode::kUnusableInput, place + ": its node moves vertex " + std::to_string(v) +
                                                " out of the range of floats; repair the node's transform");
    }
    positions_.push_back(without_negative_zeros(moved));
    if (target.joints == nullptr) continue;
    if (unposed_.empty()) unposed_.assign(positions_.begin(), positions_.begin() + static_cast<std::ptrdiff_t>(before));
    unposed_.push_back(without_negative_zeros(given));
  }
  if (!unposed_.empty() && target.joints == nullptr) {
    unposed_.insert(unposed_.end(), positions_.begin() + static_cast<std::ptrdiff_t>(before), positions_.end());
  }
}

void SurfaceBuilder::add_attributes(AttributeStreams& given, std::size_t vertices, const Target& target) {
  const NormalTransform transform(target.transform);
  std::vector<NormalTransform> posed;  // [vertex]
  if (target.joints != nullptr) {
    const AttributeStream* influences = find_stream(given, kInfluences);
    for (std::size_t v = 0; v < vertices; ++v) posed.emplace_back(blended(*target.joints, influences->at(v)));
  }
  for (AttributeStream& added : given) {
    AttributeStream& stream = stream_for(attributes_, added.kind, added.set);
    stream.values.reserve(positions_.capacity() * static_cast<std::size_t>(stream.kind.components));
    fill_up(stream, positions_.size() - vertices);
    if (posed.empty()) repaired_ += append_fitted(stream, added.values, transform);
    for (std::size_t v = 0; v < posed.size(); ++v) {
      repaired_ += append_fitted(stream, {added.at(v), static_cast<std::size_t>(added.kind.components)}, posed[v]);
    }
    added.values = {};
  }
  for (AttributeStream& stream : attributes_) fill_up(stream, positions_.size());
}

void SurfaceBuilder::add_triangles(const Primitive& primitive, std::uint32_t first, bool mirrored) {
  for (const auto& [a, b, c] : primitive.triangles) {
    triangles_.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }
  materials_.resize(triangles_.size(), primitive.material);
}

std::vector<unsigned int> SurfaceBuilder::weld(bool by_attributes) const {
  const std::vector<Vec3f>& positions = unposed_.empty() ? positions_ : unposed_;
  std::vector<const AttributeStream*> keys;
  std::size_t width = 3;
  for (const AttributeStream& stream : attributes_) {
    if (!by_attributes || !stream.kind.tells_vertices_apart) continue;
    keys.push_back(&stream);
    width += static_cast<std::size_t>(stream.kind.components);
  }
  const bool has_bodies = std::any_of(primitives_.begin(), primitives_.end(),
                                      [](const AddedPrimitive& primitive) { return primitive.body >= 0; });
  if (keys.empty() && !has_bodies) return number_equal(positions.data(), positions.size(), 3);
  std::vector<float> elements;
  elements.reserve((width + 1) * positions.size());
  std::size_t primitive = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    while (primitive + 1 < primitives_.size() && primitives_[primitive + 1].first_vertex <= v) ++primitive;
    elements.insert(elements.end(), {positions[v].x, positions[v].y, positions[v].z});
    for (const AttributeStream* key : keys)
      elements.insert(elements.end(), key->at(v), key->at(v) + key->kind.components);
    // Bits of a number, not its value: they are only compared.
    elements.push_back(std::bit_cast<float>(primitives_[primitive].body));
  }
  std::vector<unsigned int> welded = number_equal(elements.data(), positions.size(), width + 1);
  // Of files of our own, whose vertices are in one body here, it is known what is one.
  if (has_bodies) part_what_moves_apart(welded);
  return welded;
}

void SurfaceBuilder::part_what_moves_apart(std::vector<unsigned int>& welded) const {
  const MovesAlike move_alike(attributes_);
  if (move_alike.always()) return;
  constexpr unsigned int kNone = ~0U;
  unsigned int count = welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + 1;
  std::vector<std::size_t> first(welded.size(), welded.size());  // [number] the vertex that others are compared with
  std::vector<unsigned int> next(welded.size(), kNone);          // [number] another one at the same place
  for (std::size_t v = 0; v < welded.size(); ++v) {
    unsigned int number = welded[v];
    while (first[number] != welded.size() && !move_alike(first[number], v)) {
      if (next[number] == kNone) next[number] = count++;
      number = next[number];
    }
    if (first[number] == welded.size()) first[number] = v;
    welded[v] = number;
  }
}

std::vector<bool> SurfaceBuilder::find_contacts(const std::vector<std::int32_t>& group, std::int32_t count) const {
  const std::vector<unsigned int> welded = weld(false);
  std::vector<std::int32_t> group_at(positions_.size(), -1);  // [welded position] the first group there
  std::vector<bool> touches(static_cast<std::size_t>(count), false);
  for (std::size_t p = 0; p < primitives_.size(); ++p) {
    for (std::size_t t = primitives_[p].first_triangle; t < end_of(p); ++t) {
      for (const std::uint32_t v : triangles_[t]) {
        std::int32_t& there = group_at[welded[v]];
        if (there < 0) there = group[p];
        if (there != group[p]) touches[there] = touches[group[p]] = true;
      }
    }
  }
  return touches;
}

void SurfaceBuilder::set_material(std::size_t primitive, std::int32_t material) {
  for (std::size_t t = primitives_[primitive].first_triangle; t < end_of(primitive); ++t) materials_[t] = material;
}

void SurfaceBuilder::remove_left_out() {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < primitives_.size(); ++p) {
    for (std::size_t t = primitives_[p].first_triangle; t < end_of(p) && !primitives_[p].left_out; ++t) {
      triangles_[kept] = triangles_[t];
      materials_[kept++] = materials_[t];
    }
  }
  triangles_.resize(kept);
  materials_.resize(kept);
}

void SurfaceBuilder::add(Primitive primitive, const Target& target, const std::string& place) {
  const std::size_t vertices = primitive.vertices();
  const auto first = static_cast<std::uint32_t>(positions_.size());
  if (target.joints != nullptr) {
    const auto influences = std::find_if(primitive.attributes.begin(), primitive.attributes.end(),
                                         [](const AttributeStream& stream) { return stream.kind == kInfluences; });
    if (influences == primitive.attributes.end()) {
      throw Error(ExitCode::kUnusableInput,
                  place + ": its joints and weights are not four of each for every vertex, of types that glTF allows");
    }
    repaired_ += repair_influences(influences->values, target.joints->size());
  }
  primitives_.push_back({triangles_.size(), positions_.size(), target.body});
  add_positions(primitive, target, place);
  add_attributes(primitive.attributes, vertices, target);
  add_triangles(primitive, first, target.joints == nullptr && NormalTransform(target.transform).mirrored);
}

WeldedSurface SurfaceBuilder::finish(std::vector<std::string> material_names) {
  WeldedSurface surface;
  SourceMesh& mesh = surface.mesh;
  remove_left_out();
  const std::vector<unsigned int> welded = weld(true);
  const bool has_bodies = std::any_of(primitives_.begin(), primitives_.end(),
                                      [](const AddedPrimitive& primitive) { return primitive.body >= 0; });
  primitives_.clear();
  unposed_ = {};

  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto [a, b, c] = triangles_[t];
    if (welded[a] == welded[b] || welded[b] == welded[c] || welded[c] == welded[a]) {
      if (surface.dropped_at.size() < kMostPlaces) surface.dropped_at.push_back(positions_[a]);
      continue;
    }
    triangles_[kept] = triangles_[t];
    materials_[kept++] = materials_[t];
  }
  surface.dropped_triangles = static_cast<std::int64_t>(triangles_.size() - kept);
  triangles_.resize(kept);
  materials_.resize(kept);

  if (!material_names.empty()) {
    const auto fallback = static_cast<std::int32_t>(material_names.size());
    if (std::find(materials_.begin(), materials_.end(), -1) != materials_.end()) material_names.emplace_back("default");
    std::replace(materials_.begin(), materials_.end(), -1, fallback);
    const std::vector<std::uint32_t> order = order_by_material(materials_);
    reorder(triangles_, order);
    reorder(materials_, order);
    mesh.materials = std::move(materials_);
    mesh.material_names = std::move(material_names);
  }
  materials_ = {};

  std::vector<VertexId> number(positions_.size(), -1);  // [welded position]
  mesh.triangles.resize(kept);
  for (std::size_t t = 0; t < kept; ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = triangles_[t][c];
      VertexId& id = number[welded[v]];
      if (id < 0) {
        id = static_cast<VertexId>(mesh.positions.size());
        mesh.positions.push_back(positions_[v]);
      }
      mesh.triangles[t][c] = id;
    }
  }
  surface.vertex_of.resize(welded.size());
  std::transform(welded.begin(), welded.end(), surface.vertex_of.begin(), [&](unsigned int w) { return number[w]; });
  positions_ = {};
  number = {};

  if (has_bodies) share_offsets(welded, attributes_);
  mesh.corner_attributes = to_corners(std::exchange(attributes_, {}), triangles_);
  triangles_ = {};
  surface.repaired_attributes = repaired_;
  repaired_ = 0;
  return surface;
}

}  // namespace lozenge
