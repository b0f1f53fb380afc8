#include "stages/export/looks.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "formats/base/parallel.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/patch_place.h"

namespace lozenge {

struct Looks::Locator {
  DomainLocator locator;
  explicit Locator(const SourceSurface& source) : locator(*source.mesh, *source.map) {}
};

namespace {

/// The middles of the n * n equal parts of a triangle, as weights of its corners.
template <typename Visit>
void for_each_part_of_triangle(int n, const Visit& visit) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      visit(Vec3d(3 * i + 1, 3 * j + 1, 3 * (n - i - j) - 2) / (3.0 * n));
      if (i + j + 1 < n) visit(Vec3d(3 * i + 2, 3 * j + 2, 3 * (n - i - j) - 4) / (3.0 * n));
    }
  }
}

Vec2d texcoord_at(const EngineMesh& mesh, std::size_t triangle, const Vec3d& weights) {
  Vec2d sum(0, 0);
  for (int c = 0; c < 3; ++c) {
    sum += Vec2d(mesh.texcoords[mesh.indices[3 * triangle + static_cast<std::size_t>(c)]]) * weights[c];
  }
  return sum;
}

/// The classes that patches of an image alone can have.
LookClasses classes_of_patches(const PatchLayout& patches, std::vector<std::int32_t>& of_patch) {
  LookClasses looks;
  if (patches.material_classes.empty()) {
    looks.classes.push_back({AlphaMode::kOpaque, patches.double_sided, {}});
    return looks;
  }
  std::map<MaterialClass, std::int32_t> number;
  for (const MaterialClass code : patches.material_classes) number[code] = 0;
  for (auto& [code, look] : number) {
    look = static_cast<std::int32_t>(looks.classes.size());
    looks.classes.push_back(class_of_code(code));
  }
  for (const MaterialClass code : patches.material_classes) of_patch.push_back(number[code]);
  return looks;
}

}  // namespace

Looks::Looks(const GeometryImage& image, const MapLayout& layout, const SourceSurface* source)
    : image_(image), layout_(layout), source_(source) {
  looks_ = source != nullptr ? look_classes(*source->mesh) : classes_of_patches(image.layout, of_patch_);
  if (source != nullptr && looks_.classes.size() > 1) locator_ = std::make_unique<Locator>(*source);
}

Looks::~Looks() = default;

Looks::Verdict Looks::at(const Vec2d& texcoord) const {
  const double x = texcoord.x * layout_.width;
  const double y = texcoord.y * layout_.height;
  const std::int32_t patch = layout_.patch_at(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
  if (patch < 0 || patch >= image_.size()) return {};
  if (!locator_) return {of_patch_[patch], patch};
  const MapTile tile = layout_.tile_of(patch);
  const double steps = std::max(tile.inner() - 1, 1);
  double u = std::clamp((x - tile.x - tile.gutter - 0.5) / steps, 0.0, 1.0);
  double v = std::clamp((y - tile.y - tile.gutter - 0.5) / steps, 0.0, 1.0);
  const PatchPlace& place = image_.layout.places[patch];
  if (!place.right.exists() && u > v) u = v = (u + v) / 2;
  const std::optional<SourcePoint> point = locator_->locator.find(domain_point_at(place, u, v));
  if (!point) return {};
  return {looks_.of(*source_->mesh, point->triangle), point->triangle};
}

Looks::Verdict Looks::judge(const EngineMesh& mesh, std::size_t triangle) const {
  // Four parts where they agree, else many.
  Verdict verdict = at(texcoord_at(mesh, triangle, Vec3d(1, 1, 1) / 3.0));
  for (const int parts : {2, 6}) {
    std::vector<std::int32_t> count(looks_.classes.size(), 0);
    for_each_part_of_triangle(parts,
                              [&](const Vec3d& weights) { ++count[at(texcoord_at(mesh, triangle, weights)).look]; });
    const auto most = std::max_element(count.begin(), count.end());
    verdict.look = static_cast<std::int32_t>(most - count.begin());
    if (*most == parts * parts) break;
  }
  return verdict;
}

std::vector<LookedMesh> Looks::split(const EngineMesh& mesh) const {
  if (mesh.indices.empty()) return {};
  std::vector<LookedMesh> split;
  if (looks_.classes.size() == 1) {
    split.push_back({0, mesh});
    return split;
  }
  const auto count = static_cast<std::size_t>(mesh.triangle_count());
  std::vector<Verdict> verdicts(count);
  for_each_index(count, true, [&](std::size_t t) { verdicts[t] = judge(mesh, t); });
  for (std::size_t look = 0; look < looks_.classes.size(); ++look) {
    std::vector<std::size_t> triangles;
    for (std::size_t t = 0; t < count; ++t) {
      if (verdicts[t].look == static_cast<std::int32_t>(look)) triangles.push_back(t);
    }
    if (triangles.empty()) continue;
    if (looks_.classes[look].alpha_mode == AlphaMode::kBlend) {
      std::stable_sort(triangles.begin(), triangles.end(),
                       [&](std::size_t a, std::size_t b) { return verdicts[a].source < verdicts[b].source; });
    }
    split.push_back({static_cast<std::int32_t>(look), chosen_triangles(mesh, triangles)});
  }
  return split;
}

}  // namespace lozenge
