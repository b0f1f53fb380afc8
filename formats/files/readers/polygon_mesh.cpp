// Files name positions, texture coordinates and normals for each corner separately; a primitive has vertices. Where all
// corners name the same number of each, or nothing, the lists are the vertices already. Elsewhere each combination that
// occurs becomes a vertex.
#include "formats/files/readers/polygon_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/readers/polygon_cuts.h"
#include "formats/files/readers/vertex_colors.h"

namespace lozenge {

namespace {

constexpr std::int64_t kMostElements = std::numeric_limits<std::int32_t>::max();

/// So many are added between two looks at the memory.
constexpr std::int64_t kWatch = 1 << 16;

/// Each takes ten times its line in the file.
constexpr std::size_t kMostMaterials = 100'000;

/// Appends an element of a list; zeros for -1.
void append(const std::vector<float>& list, std::int32_t index, std::size_t components, std::vector<float>& to) {
  if (index < 0) {
    to.resize(to.size() + components, 0.0F);
    return;
  }
  const auto at = list.begin() + static_cast<std::ptrdiff_t>(index * components);
  to.insert(to.end(), at, at + static_cast<std::ptrdiff_t>(components));
}

/// \param values  [vertex * components + component], or empty
void add_stream(const AttributeKind& kind, std::vector<float> values, Primitive& primitive) {
  if (!values.empty()) primitive.attributes.push_back({kind, 0, std::move(values)});
}

}  // namespace

PolygonMesh::PolygonMesh(std::string file, const InputLimits& limits, PolygonPlaces places)
    : file_(std::move(file)), limits_(limits), places_(places) {}

void PolygonMesh::watch_memory() const {
  const auto vertices = static_cast<std::uint64_t>(std::max({positions(), uvs(), normals()}));
  require_memory(memory_to_import(vertices, triangles_.size()), limits_.max_memory, file_ + ": reading it");
}

void PolygonMesh::reserve(std::uint64_t positions, std::uint64_t triangles) {
  require_memory(memory_to_import(positions, triangles), limits_.max_memory,
                 fmt::format("{}: reading its {} vertices", file_, positions));
  if (positions > 0) require_room_for(static_cast<std::int64_t>(positions - 1));
  positions_.reserve(3 * positions);
  triangles_.reserve(std::min(triangles, limits_.max_triangles));
}

void PolygonMesh::require_room_for(std::int64_t count) const {
  const auto most = static_cast<std::int64_t>(std::min<std::uint64_t>(3 * limits_.max_triangles, kMostElements));
  if (count < most) return;
  throw Error(ExitCode::kLimit, fmt::format("{}: has more than {} vertices, which are more than {} triangles can use; "
                                            "reduce it, or raise --max-triangles",
                                            file_, most, limits_.max_triangles));
}

void PolygonMesh::add_position(const Vec3f& p, std::int64_t place) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
    throw Error(ExitCode::kUnusableInput, fmt::format("{}: {} {}: the position of vertex {} is not finite; repair the "
                                                      "mesh",
                                                      file_, places_.unit, place, positions() + places_.first));
  }
  require_room_for(positions());
  if (positions() % kWatch == 0) watch_memory();
  positions_.insert(positions_.end(), {p.x, p.y, p.z});
  if (!colors_.empty()) colors_.resize(positions_.size() / 3 * 4, kNoColor);
}

void PolygonMesh::add_color(const Vec4f& color) {
  colors_.resize(positions_.size() / 3 * 4, kNoColor);
  for (int c = 0; c < 4; ++c) colors_[colors_.size() - 4 + static_cast<std::size_t>(c)] = color[c];
}

void PolygonMesh::add_normal(const Vec3f& n) {
  require_room_for(normals());
  if (normals() % kWatch == 0) watch_memory();
  normals_.insert(normals_.end(), {n.x, n.y, n.z});
}

void PolygonMesh::add_uv(const Vec2f& uv) {
  require_room_for(uvs());
  if (uvs() % kWatch == 0) watch_memory();
  uvs_.insert(uvs_.end(), {uv.x, 1 - uv.y});
}

void PolygonMesh::use_material(const std::string& name) {
  const auto [at, is_new] = material_of_name_.try_emplace(name, static_cast<std::int32_t>(material_names_.size()));
  if (is_new) material_names_.push_back(name);
  if (material_names_.size() > kMostMaterials) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: names more than {} materials; export it with fewer", file_, kMostMaterials));
  }
  if (runs_.empty()) runs_.push_back({});
  if (runs_.back().first_triangle < triangles_.size()) runs_.push_back({triangles_.size()});
  runs_.back().material = at->second;
}

void PolygonMesh::note_indices(const PolygonCorner& corner, std::int64_t place) {
  const auto note = [&](Furthest& furthest, std::int64_t index, std::int64_t count, const char* what) {
    if (index > furthest.index) furthest = {index, place};
    // What can't be there any more isn't put off: it wouldn't fit into the lists of corners.
    if (index >= kMostElements) require_index(furthest, count, what);
  };
  if (corner.position < 0) require_index({corner.position, place}, positions(), "vertex");
  note(furthest_position_, corner.position, positions(), "vertex");
  note(furthest_uv_, corner.uv, uvs(), "texture coordinate");
  note(furthest_normal_, corner.normal, normals(), "normal");
}

void PolygonMesh::require_index(const Furthest& furthest, std::int64_t count, const char* what) const {
  if (furthest.index >= 0 && furthest.index < count) return;
  throw Error(ExitCode::kUnusableInput,
              fmt::format("{}: {} {}: a face names {} {}, but there are {}, counted from {}; export it again", file_,
                          places_.unit, furthest.place, what, furthest.index + places_.first, count, places_.first));
}

void PolygonMesh::add_triangle(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  if (triangles_.size() >= std::min<std::uint64_t>(limits_.max_triangles, kMostElements / 3)) {
    throw Error(ExitCode::kLimit, fmt::format("{}: has more than {}; reduce it, or raise --max-triangles", file_,
                                              count_of(static_cast<std::int64_t>(limits_.max_triangles), "triangle")));
  }
  if (static_cast<std::int64_t>(triangles_.size()) % kWatch == 0) watch_memory();
  const auto narrow = [](std::int64_t index) { return static_cast<std::int32_t>(index); };
  triangles_.push_back({static_cast<std::uint32_t>(a.position), static_cast<std::uint32_t>(b.position),
                        static_cast<std::uint32_t>(c.position)});
  uv_of_.add({narrow(a.uv), narrow(b.uv), narrow(c.uv)}, triangles_);
  normal_of_.add({narrow(a.normal), narrow(b.normal), narrow(c.normal)}, triangles_);
}

void PolygonMesh::cut(std::span<const PolygonCorner> corners) {
  cut_corners_.clear();
  for (const PolygonCorner& corner : corners) {
    // What comes later in the file has no place yet; then all corners seem to be in one, and a fan is made.
    const bool known = corner.position < positions();
    const float* p = known ? &positions_[3 * corner.position] : nullptr;
    cut_corners_.push_back(known ? Vec3f(p[0], p[1], p[2]) : Vec3f(0, 0, 0));
  }
  cut_polygon(cut_corners_, cut_triangles_);
  for (const auto& [a, b, c] : cut_triangles_) add_triangle(corners[a], corners[b], corners[c]);
}

void PolygonMesh::require_sensible_polygon(std::uint64_t corners, std::int64_t place) const {
  constexpr std::uint64_t kMostCorners = 1'000'000;
  if (corners <= kMostCorners) return;
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {} {}: a face has more than {} corners; triangulate the mesh",
                                                    file_, places_.unit, place, kMostCorners));
}

void PolygonMesh::add_polygon(std::span<const PolygonCorner> corners, std::int64_t place) {
  for (const PolygonCorner& corner : corners) note_indices(corner, place);
  if (corners.size() < 3) {
    ++ignored_;
  } else if (corners.size() == 3) {
    add_triangle(corners[0], corners[1], corners[2]);
  } else {
    cut(corners);
  }
}

Primitive PolygonMesh::whole() {
  Primitive primitive;
  const std::size_t vertices = positions_.size() / 3;
  normals_.resize(normal_of_.are_none() ? 0 : 3 * vertices);
  uvs_.resize(uv_of_.are_none() ? 0 : 2 * vertices);
  primitive.positions = std::move(positions_);
  add_stream(kNormals, std::move(normals_), primitive);
  add_stream(kTextureCoordinates, std::move(uvs_), primitive);
  add_stream(kColors, std::move(colors_), primitive);
  primitive.triangles = std::move(triangles_);
  primitive.material = runs_.empty() ? -1 : runs_.front().material;
  return primitive;
}

void PolygonMesh::add_run(std::size_t run, CornerVertices& vertices, Primitive& primitive) const {
  for (std::size_t t = runs_[run].first_triangle; t < end_of(run); ++t) {
    std::array<std::uint32_t, 3>& corners = primitive.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = vertices.number_of({triangles_[t][k], uv_of_.of(t, k, triangles_), normal_of_.of(t, k, triangles_)});
    }
  }
}

void PolygonMesh::set_vertices(const std::vector<Combination>& vertices, Primitive& primitive) const {
  std::vector<float> normals;
  std::vector<float> uvs;
  std::vector<float> colors;
  for (const Combination& vertex : vertices) {
    const auto position = static_cast<std::int32_t>(vertex.position);
    append(positions_, position, 3, primitive.positions);
    if (!normal_of_.are_none()) append(normals_, vertex.normal, 3, normals);
    if (!uv_of_.are_none()) append(uvs_, vertex.uv, 2, uvs);
    if (!colors_.empty()) append(colors_, position, 4, colors);
  }
  add_stream(kNormals, std::move(normals), primitive);
  add_stream(kTextureCoordinates, std::move(uvs), primitive);
  add_stream(kColors, std::move(colors), primitive);
}

std::vector<Primitive> PolygonMesh::by_material() {
  if (runs_.empty()) runs_.push_back({});
  std::vector<std::size_t> order(runs_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return runs_[a].material < runs_[b].material; });
  CornerVertices vertices(positions_.size() / 3);
  std::vector<Primitive> primitives;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || runs_[order[i]].material != runs_[order[i - 1]].material) {
      primitives.emplace_back().material = runs_[order[i]].material;
    }
    add_run(order[i], vertices, primitives.back());
    if (i + 1 < order.size() && runs_[order[i]].material == runs_[order[i + 1]].material) continue;
    set_vertices(vertices.all(), primitives.back());
    vertices.clear();
  }
  std::erase_if(primitives, [](const Primitive& primitive) { return primitive.triangles.empty(); });
  return primitives;
}

InputAsset PolygonMesh::finish() {
  if (triangles_.empty()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: has {}, but no triangles; a surface is needed: export a mesh", file_,
                            positions() == 1 ? "1 vertex" : fmt::format("{} vertices", positions())));
  }
  require_index(furthest_position_, positions(), "vertex");
  if (furthest_uv_.index >= 0) require_index(furthest_uv_, uvs(), "texture coordinate");
  if (furthest_normal_.index >= 0) require_index(furthest_normal_, normals(), "normal");
  make_linear(colors_);
  const auto plain = [](const CornerIndices& indices) {
    return indices.are_none() || indices.are_those_of_positions();
  };
  std::vector<Primitive> primitives;
  if (runs_.size() <= 1 && plain(uv_of_) && plain(normal_of_)) {
    primitives.push_back(whole());
  } else {
    primitives = by_material();
  }
  InputAsset asset = asset_of_one_mesh(file_, std::move(primitives), std::move(material_names_));
  asset.ignored_primitives = ignored_;
  if (ignored_ > 0)
    asset.notes.push_back(count_of(ignored_, "polygon") + " of fewer than three corners (points and lines) left out");
  return asset;
}

}  // namespace lozenge
