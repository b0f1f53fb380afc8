// A level that has more than half the triangles of the one before is none.
#include "stages/export/asset_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "formats/base/error.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/source_level.h"
#include "formats/surface/boundary.h"
#include "formats/surface/turned_triangles.h"
#include "stages/export/body_meshes.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/fitted_levels.h"
#include "stages/export/level_chain.h"
#include "stages/export/level_deviation.h"
#include "stages/export/level_maps.h"
#include "stages/export/vertex_origins.h"

namespace lozenge {
namespace {

/// The image's bodies, without levels yet: first the one that stands still.
std::vector<LeveledPart> find_parts(const GeometryImage& image) {
  std::vector<LeveledPart> parts{{{image.layout.scene_name, {{}}, -1}, {}}};
  for (const Body& body : image.layout.bodies.bodies) parts.push_back({body, {}});
  return parts;
}

/// Whether the source's own triangles, so many, are to be the finest level.
bool is_source_finest(const GeometryImage& image, int finest, const ExportOptions& options, std::int64_t count) {
  if (options.finest == Finest::kSamples) return false;
  const bool wanted = options.finest == Finest::kSource;
  // Who names a number of samples wants samples.
  if (!wanted && options.samples != 0) return false;
  const bool too_many = options.triangle_budget != 0 && count > options.triangle_budget;
  if (wanted && too_many) {
    throw Error(ExitCode::kUsage, fmt::format("{}: its source level has {} triangles, more than the budget of {}; "
                                              "leave that level to --finest auto",
                                              image.layout.origin, count, options.triangle_budget));
  }
  // Samples that are too far off are no match, unless the source's own triangles are heavier by far. Large maps have
  // fine texels, which take some more cuts.
  const std::int64_t sampled = image.layout.count_triangles(finest);
  const bool is_closer = image.layout.deviation.value_or(0) > options.error;
  const std::int64_t worthwhile = worthwhile_triangles(image.layout.source_triangles);
  const std::int64_t most = is_closer ? std::max(worthwhile + worthwhile / 10, 2 * sampled) : sampled;
  return wanted || (!too_many && count <= most);
}

/// Gathers the levels of one asset.
class LevelList {
 public:
  explicit LevelList(const GeometryImage& image) { made_.parts = find_parts(image); }

  /// Triangles of the last level.
  std::int64_t last_count() const { return last_count_; }
  int last_level() const { return made_.facts.back().level; }
  bool empty() const { return made_.facts.empty(); }
  std::size_t size() const { return made_.facts.size(); }

  /// \param meshes  [part] \param kind  what they are of each
  void add(std::vector<EngineMesh> meshes, EngineMesh PartLevel::*kind, LevelFacts facts) {
    const std::size_t before = made_.facts.size();
    last_count_ = 0;
    for (std::size_t p = 0; p < meshes.size(); ++p) {
      last_count_ += meshes[p].triangle_count();
      const bool ended = made_.parts[p].levels.size() < before;
      if (ended || meshes[p].indices.empty()) continue;
      order_for_gpu(meshes[p]);
      PartLevel& level = made_.parts[p].levels.emplace_back();
      level.*kind = std::move(meshes[p]);
      if (facts.deviations) level.deviation = facts.deviations->bodies[p];
    }
    made_.facts.push_back(std::move(facts));
  }

  /// Takes out levels, but the finest, that the next coarser one is no farther from the source than.
  void leave_out_useless() {
    for (std::size_t l = made_.facts.size(); l-- > 2;) {
      const auto& coarser = made_.facts[l].deviations;
      const auto& finer = made_.facts[l - 1].deviations;
      if (coarser && finer && finer->whole.mean >= coarser->whole.mean) leave_out(l - 1);
    }
  }

  AssetLevels take() {
    std::erase_if(made_.parts, [](const LeveledPart& part) { return part.levels.empty(); });
    return std::move(made_);
  }

 private:
  void leave_out(std::size_t level) {
    const auto number = static_cast<std::ptrdiff_t>(level);
    made_.facts.erase(made_.facts.begin() + number);
    for (LeveledPart& part : made_.parts) {
      if (part.levels.size() > level) part.levels.erase(part.levels.begin() + number);
    }
  }

  AssetLevels made_;
  std::int64_t last_count_ = 0;
};

/// Samples of the image's levels.
void add_samples(LevelList& list, const GeometryImage& image, const MapLayout& layout, int finest, int frame_level,
                 const ExportOptions& options) {
  const LevelChain chain(image, finest, options);
  for (int level = finest; level < static_cast<int>(image.levels.size()); ++level) {
    const std::int64_t count = image.layout.count_triangles(level);
    if (list.size() == chain.most_levels()) return;
    if (!list.empty() && (count > chain.after(image.layout.count_triangles(list.last_level())) || !chain.wants(count)))
      continue;
    LevelFacts facts{level};
    EngineMesh mesh = engine_mesh(image, level, layout, frame_level);
    if (options.caps == Caps::kOpen) facts.cap_triangles = leave_out_caps(mesh, image, level);
    list.add(split_bodies(std::move(mesh), image, level), &PartLevel::sampled, std::move(facts));
  }
}

/// In any of the bodies' meshes, whose vertices are others for each patch.
bool has_turned_triangles(const std::vector<EngineMesh>& meshes) {
  return std::any_of(meshes.begin(), meshes.end(), [](const EngineMesh& mesh) {
    const std::vector<VertexId> welded = welded_vertices(mesh.positions);
    std::vector<std::array<VertexId, 3>> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      triangles.push_back({welded[mesh.indices[i]], welded[mesh.indices[i + 1]], welded[mesh.indices[i + 2]]});
    }
    return !turned_triangles({mesh.positions, triangles}).empty();
  });
}

/// Levels that are fitted to the source.
class FittedLevelMaker {
 public:
  FittedLevelMaker(const GeometryImage& image, const MapLayout& layout, const ExportOptions& options,
                   const SourceSurface& source, const std::vector<const BakedMap*>& maps, const BakedMap* normals)
      : image_(image), layout_(layout), options_(options), mesh_(*source.mesh), levels_(source, image.layout, layout) {
    const bool are_own = options.level_maps == LevelMapsOf::kLevels;
    maps_.emplace(image, layout, are_own ? maps : std::vector<const BakedMap*>{}, normals, levels_.source(),
                  levels_.scene());
    meter_.emplace(levels_.source(), levels_.scene(), image.layout, maps_->normals());
  }

  void add_to(LevelList& list, int finest) {
    const LevelChain chain(image_, finest, options_);
    const auto own = static_cast<std::int64_t>(levels_.source().triangles.size());
    if (is_source_finest(image_, finest, options_, own)) add_source(list, finest);
    std::int64_t wish = list.empty() ? chain.finest_count() : chain.after(list.last_count());
    while (list.size() < chain.most_levels() && wish > 0 && (list.empty() || chain.wants(wish))) {
      const bool is_made = add_fitted(list, level_of(list, finest), wish);
      if (!is_made && list.empty() && options_.triangle_budget == 0) add_source(list, finest);
      if (levels_.has_ended()) break;
      wish = chain.after(is_made ? list.last_count() : wish);
    }
    // Of so few triangles as were asked for none is upright.
    if (list.empty()) add_source(list, finest);
    list.leave_out_useless();
  }

 private:
  void add_source(LevelList& list, int finest) {
    const ChartedSurface& source = levels_.source();
    BodyMeshes made = body_meshes(source, framed_surface(source, layout_), image_.layout.bodies, options_.caps,
                                  [&](std::size_t t, std::size_t c) {
                                    const Vec3d corner(c == 0 ? 1 : 0, c == 1 ? 1 : 0, c == 2 ? 1 : 0);
                                    return origin_at(mesh_, source, static_cast<TriangleId>(t), corner);
                                  });
    LevelFacts facts{finest, made.cap_triangles};
    facts.deviations = meter_->of_source();
    for (const EngineMesh& mesh : made.meshes) facts.source_triangles += mesh.triangle_count();
    list.add(std::move(made.meshes), &PartLevel::source, std::move(facts));
  }

  /// The level of the image that stands for the next one of the list.
  int level_of(const LevelList& list, int finest) const {
    return std::min(finest + static_cast<int>(list.size()), static_cast<int>(image_.levels.size()) - 1);
  }

  /// \return false where none is made
  bool add_fitted(LevelList& list, int level, std::int64_t count) {
    const ChartedSurface surface = levels_.next(count);
    // What can't get to half of the level before is bent by all that should have gone, and hardly lighter.
    if (!list.empty() && 2 * static_cast<std::int64_t>(surface.triangles.size()) > list.last_count()) return false;
    const FramedSurface framed = framed_surface(surface, layout_);
    BodyMeshes made = body_meshes(
        surface, framed, image_.layout.bodies, options_.caps,
        [&](std::size_t t, std::size_t c) { return surface.origins[surface.triangles[t].corners[c].vertex]; });
    // Of a source that is torn and bent, so few triangles can't always be upright.
    if (has_turned_triangles(made.meshes)) return false;
    LevelFacts facts{level, made.cap_triangles};
    const auto wish = std::int32_t{1} << std::min<std::size_t>(list.size(), 15);
    facts.maps = maps_->seen_from(surface, framed, wish);
    facts.deviations = meter_->of(surface, framed, find_map(facts.maps, MapKind::kTangentNormal));
    list.add(std::move(made.meshes), &PartLevel::sampled, std::move(facts));
    return true;
  }

  const GeometryImage& image_;
  const MapLayout& layout_;
  const ExportOptions& options_;
  const SourceMesh& mesh_;
  FittedLevels levels_;
  std::optional<LevelMaps> maps_;
  std::optional<DeviationMeter> meter_;
};

}  // namespace

AssetLevels make_levels(const GeometryImage& image, const MapLayout& layout, int finest,
                        const std::vector<const BakedMap*>& maps, const BakedMap* normals, const ExportOptions& options,
                        const SourceSurface* source) {
  LevelList list(image);
  if (source != nullptr) {
    FittedLevelMaker(image, layout, options, *source, maps, normals).add_to(list, finest);
  } else if (options.finest == Finest::kSource) {
    throw Error(ExitCode::kUsage, image.layout.origin +
                                      ": its source level needs the map that the geometry image was "
                                      "sampled from; name that file with --source");
  } else {
    add_samples(list, image, layout, finest, normals != nullptr ? normals->level : finest, options);
  }
  AssetLevels made = list.take();
  if (made.parts.empty()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: all of its triangles lie on caps of holes; keep the caps, or sample it more finely",
                            image.layout.origin));
  }
  return made;
}

}  // namespace lozenge
