// Connected parts of the surface are chosen for one by one. Below the source level each has, on every level, its own
// triangles or the resampled ones, whichever are fewer; and a level that wouldn't be lighter than the one before is
// none.
#include "stages/export/asset_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "formats/base/error.h"
#include "formats/surface/distinct_positions.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/sample_origins.h"
#include "stages/export/source_parts.h"

namespace lozenge {
namespace {

/// The image's bodies, without levels yet: first the one that stands still.
std::vector<LeveledPart> find_parts(const GeometryImage& image) {
  std::vector<LeveledPart> parts{{{image.layout.scene_name, {{}}, -1}, {}}};
  for (const Body& body : image.layout.bodies.bodies) parts.push_back({body, {}});
  return parts;
}

/// The source's own triangles, where they are to be the finest level.
std::optional<SourceParts> source_for(const GeometryImage& image, const MapLayout& layout, int finest,
                                      const ExportOptions& options, const SourceSurface* source) {
  if (options.finest == Finest::kSamples) return std::nullopt;
  const bool wanted = options.finest == Finest::kSource;
  if (source == nullptr) {
    if (!wanted) return std::nullopt;
    throw Error(ExitCode::kUsage, image.layout.origin +
                                      ": its source level needs the map that the geometry image was "
                                      "sampled from; name that file with --source");
  }
  // Who names a number of samples wants samples.
  if (!wanted && options.samples != 0) return std::nullopt;
  SourceParts parts = source_parts(*source, image.layout, layout, options.caps);
  const std::int64_t count = parts.triangle_count();
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
  if (wanted || (!too_many && count <= most)) return parts;
  return std::nullopt;
}

/// Every place once, under numbers from `first` on, sorted.
std::vector<NumberedPosition> places_of(const std::vector<PartLevel>& levels, EngineMesh PartLevel::*kind,
                                        std::int32_t first) {
  std::vector<NumberedPosition> places;
  for (const PartLevel& level : levels) {
    const EngineMesh& mesh = level.*kind;
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t v : mesh.indices) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (used[v]) places.push_back(numbered(mesh.positions[v], 0));
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (NumberedPosition& place : places) place.number = first++;
  return places;
}

/// Where a part of the source's own triangles touches a resampled one, the two stay two: welding bits doesn't join
/// them.
void keep_apart(std::vector<PartLevel>& levels) {
  std::vector<NumberedPosition> all = places_of(levels, &PartLevel::sampled, 0);
  const auto sampled = static_cast<std::int32_t>(all.size());
  const std::vector<NumberedPosition> own = places_of(levels, &PartLevel::source, sampled);
  if (all.empty() || own.empty()) return;
  all.insert(all.end(), own.begin(), own.end());
  std::sort(all.begin(), all.end());
  std::map<std::array<std::uint32_t, 3>, Vec3f> moved;
  for (const MovedPosition& move : moved_apart(all)) moved[own[move.number - sampled].bits] = move.position;
  if (moved.empty()) return;
  for (PartLevel& level : levels) {
    for (Vec3f& p : level.source.positions) {
      if (const auto at = moved.find(numbered(p, 0).bits); at != moved.end()) p = at->second;
    }
  }
}

/// Makes the levels of one asset.
class LevelMaker {
 public:
  /// \param origins  `sample_origins`
  LevelMaker(const GeometryImage& image, const MapLayout& layout, int frame_level, Caps caps, const SourceParts* source,
             std::vector<SourcePoint> origins)
      : image_(image),
        layout_(layout),
        frame_level_(frame_level),
        caps_(caps),
        source_(source),
        origins_(std::move(origins)) {
    made_.parts = find_parts(image);
  }

  /// Nothing but the source's own triangles.
  void add_source_level(int level) { add(level, std::vector<bool>(source_->parts.size(), true)); }

  /// \return false, and adds nothing, where it isn't lighter than the level before
  bool add_level(int level) {
    const std::vector<bool> from_source = parts_from_source(level);
    const std::int64_t count = triangles_of(level, from_source);
    const bool is_finest = made_.facts.empty();
    const std::int64_t source = image_.layout.source_triangles;
    if (!is_finest && (count >= last_count_ || (source > 0 && count >= source))) return false;
    add(level, from_source);
    return true;
  }

  AssetLevels take() {
    std::erase_if(made_.parts, [](const LeveledPart& part) { return part.levels.empty(); });
    return std::move(made_);
  }

 private:
  /// [part of the source] whether its own triangles are fewer on this level.
  std::vector<bool> parts_from_source(int level) const {
    if (source_ == nullptr) return {};
    std::vector<std::int64_t> sampled(source_->parts.size(), 0);
    for (std::int32_t patch = 0; patch < image_.size(); ++patch) {
      sampled[source_->part_of_patch[patch]] += image_.layout.triangles_of(patch, level);
    }
    std::vector<bool> from_source(sampled.size());
    for (std::size_t p = 0; p < sampled.size(); ++p) {
      from_source[p] = source_->parts[p].triangle_count() <= sampled[p];
    }
    return from_source;
  }

  bool is_sampled(const std::vector<bool>& from_source, std::int32_t patch) const {
    return source_ == nullptr || !from_source[source_->part_of_patch[patch]];
  }

  std::int64_t triangles_of(int level, const std::vector<bool>& from_source) const {
    std::int64_t count = 0;
    for (std::int32_t patch = 0; patch < image_.size(); ++patch) {
      if (is_sampled(from_source, patch)) count += image_.layout.triangles_of(patch, level);
    }
    for (std::size_t p = 0; p < from_source.size(); ++p) {
      if (from_source[p]) count += source_->parts[p].triangle_count();
    }
    return count;
  }

  /// [part of the asset] what is resampled of it.
  std::vector<EngineMesh> sampled_meshes(int level, const std::vector<bool>& from_source, LevelFacts& facts) const {
    std::vector<bool> keep(static_cast<std::size_t>(image_.size()));
    for (std::int32_t patch = 0; patch < image_.size(); ++patch) keep[patch] = is_sampled(from_source, patch);
    if (std::find(keep.begin(), keep.end(), true) == keep.end()) return std::vector<EngineMesh>(made_.parts.size());
    EngineMesh mesh = engine_mesh(image_, level, layout_, frame_level_, origins_);
    keep_patches(mesh, image_, level, keep);
    if (caps_ == Caps::kOpen) facts.cap_triangles = leave_out_caps(mesh, image_, level);
    return split_bodies(std::move(mesh), image_, level);
  }

  void add_source(const std::vector<bool>& from_source, std::vector<PartLevel>& levels, LevelFacts& facts) const {
    std::vector<bool> done(from_source.size(), false);
    for (std::int32_t patch = 0; patch < image_.size(); ++patch) {
      if (is_sampled(from_source, patch)) continue;
      const std::int32_t part = source_->part_of_patch[patch];
      if (done[part]) continue;
      done[part] = true;
      append(levels[image_.layout.bodies.owner_of(patch) + 1].source, source_->parts[part]);
      facts.source_triangles += source_->parts[part].triangle_count();
      facts.cap_triangles += source_->cap_triangles[part];
    }
  }

  void add(int level, const std::vector<bool>& from_source) {
    LevelFacts facts{level};
    std::vector<PartLevel> levels(made_.parts.size());
    std::vector<EngineMesh> sampled = sampled_meshes(level, from_source, facts);
    for (std::size_t p = 0; p < levels.size(); ++p) levels[p].sampled = std::move(sampled[p]);
    if (source_ != nullptr) {
      add_source(from_source, levels, facts);
      keep_apart(levels);
    }
    const std::size_t before = made_.facts.size();
    last_count_ = 0;
    for (std::size_t p = 0; p < levels.size(); ++p) {
      last_count_ += levels[p].triangle_count();
      const bool ended = made_.parts[p].levels.size() < before;
      if (ended || levels[p].empty()) continue;
      for (EngineMesh* mesh : {&levels[p].sampled, &levels[p].source}) {
        if (mesh->indices.empty()) *mesh = {};
        else order_for_gpu(*mesh);
      }
      made_.parts[p].levels.push_back(std::move(levels[p]));
    }
    made_.facts.push_back(facts);
  }

  const GeometryImage& image_;
  const MapLayout& layout_;
  int frame_level_;
  Caps caps_;
  const SourceParts* source_;
  std::vector<SourcePoint> origins_;
  AssetLevels made_;
  std::int64_t last_count_ = 0;
};

}  // namespace

AssetLevels make_levels(const GeometryImage& image, const MapLayout& layout, int finest, int frame_level,
                        const ExportOptions& options, const SourceSurface* source) {
  const std::optional<SourceParts> own = source_for(image, layout, finest, options, source);
  LevelMaker maker(image, layout, frame_level, options.caps, own ? &*own : nullptr,
                   source == nullptr ? std::vector<SourcePoint>() : sample_origins(image, *source));
  const bool coarser = options.coarser_levels || options.separate_files;
  int left = 1 + (coarser ? std::max(options.max_coarser_levels, 0) : 0);
  if (own) {
    maker.add_source_level(finest);
    --left;
  }
  for (int level = finest; level < static_cast<int>(image.levels.size()) && left > 0; ++level) {
    if (maker.add_level(level)) --left;
  }
  AssetLevels made = maker.take();
  if (made.parts.empty()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: all of its triangles lie on caps of holes; keep the caps, or sample it more finely",
                            image.layout.origin));
  }
  return made;
}

}  // namespace lozenge
