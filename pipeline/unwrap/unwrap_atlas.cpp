#include "pipeline/unwrap/unwrap_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"
#include "formats/patches/leave_out_flat_vertices.h"
#include "formats/patches/map_layout.h"
#include "formats/patches/patch_layout.h"
#include "formats/patches/patch_strips.h"
#include "formats/patches/source_cut.h"
#include "formats/patches/source_level.h"
#include "pipeline/unwrap/origins.h"
#include "stages/import/surface.h"

namespace lozenge {
namespace {

/// As if there were so many samples, of which tiny parts could have fewer.
constexpr std::int32_t kSamples = (std::int32_t{1} << kMostFirstLevel) + 1;

/// Texels inside of patches, and the squares of a patch's side in steps of texels: at boundaries there are halves.
struct InnerTexels {
  double texels = 0;
  double steps = 0;
};

/// Whether a patch is whole, or the half of one.
double share_of(const PatchLayout& patches, std::int32_t patch) {
  return patches.places[patch].right.exists() ? 1 : 0.5;
}

/// A surface's strips, and what to know for their size.
struct Strips {
  const PatchLayout& patches;
  const std::vector<PatchStrip>& strips;
  double area = 0;  ///< of the surface
};

InnerTexels inner_texels(const Strips& of, const StripLayout& layout) {
  InnerTexels sum;
  for (std::size_t s = 0; s < of.strips.size(); ++s) {
    const double steps = layout.tiles[s].steps;
    double cells = 0;
    for (const StripCell& cell : of.strips[s].cells) cells += share_of(of.patches, cell.patch);
    sum.texels += (cells * steps + 1) * (steps + 1);
    sum.steps += cells * steps * steps;
  }
  return sum;
}

double density_of(const Strips& of, const StripLayout& layout) {
  return of.area > 0 ? std::sqrt(inner_texels(of, layout).steps / of.area) : 0;
}

/// The least side of an atlas in which a unit of length gets as many texels as are asked for.
std::int32_t size_for_density(const Strips& of, const std::string& name, const UnwrapOptions& options) {
  const auto is_enough = [&](std::int64_t size) {
    return density_of(of, pack_strips(of.strips, static_cast<std::int32_t>(size), options.gutter)) >=
           options.texels_per_unit;
  };
  std::int64_t low = least_strip_size(of.strips, options.gutter);
  std::int64_t high = kMostMapSize;
  if (low <= high && is_enough(low)) return static_cast<std::int32_t>(low);
  if (low > high || !is_enough(high)) {
    throw Error(ExitCode::kLimit, fmt::format("{}: {:g} texels to a unit need an atlas of more than {} texels a side; "
                                              "choose fewer",
                                              name, options.texels_per_unit, kMostMapSize));
  }
  while (high - low > 1) (is_enough((low + high) / 2) ? high : low) = (low + high) / 2;
  return static_cast<std::int32_t>(high);
}

/// 2048, or as much more as charts of tiny patches need.
std::int32_t usual_size(const std::vector<PatchStrip>& strips, std::int32_t gutter) {
  std::int32_t size = 2048;
  const std::int64_t least = least_strip_size(strips, gutter);
  while (size < least && size < kMostMapSize) size *= 2;
  return size;
}

StripLayout layout_of(const Strips& of, const std::string& name, const UnwrapOptions& options) {
  try {
    const std::int32_t size = options.texels_per_unit > 0 ? size_for_density(of, name, options)
                              : options.map_size > 0      ? options.map_size
                                                          : usual_size(of.strips, options.gutter);
    return pack_strips(of.strips, size, options.gutter);
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what());
  }
}

/// As long as a row of the atlas, were all patches of one size: longer ones would have to be cut.
std::int32_t longest_strip(const PatchLayout& patches) {
  return static_cast<std::int32_t>(std::ceil(std::sqrt(static_cast<double>(patches.size()))));
}

std::vector<ChartScale> scales_of(const StripLayout& layout) {
  std::vector<ChartScale> scales;
  for (const StripTile& tile : layout.tiles) {
    scales.push_back({static_cast<double>(tile.steps), static_cast<double>(tile.gutter)});
  }
  return scales;
}

/// The surface's map. A smaller domain has fewer seams, by the root of its triangles. Where nobody said how many those
/// shall be, and the map is hardly distorted, there is one with about half of them, unless that costs more than it is
/// worth: aggregates of 0.04 are what maps of limbs and folds have on any domain.
ParameterizeResult parameterized(SourceMesh surface, const ParameterizeOptions& options, const Progress& progress) {
  constexpr double kHardly = 0.02;
  constexpr double kMost = 0.04;
  constexpr std::int32_t kFew = 60;  // domain triangles, that needn't be fewer
  if (options.max_domain_faces != 0) return parameterize(std::move(surface), options, progress);
  ParameterizeResult made = parameterize(surface, options, progress);
  const std::int32_t faces = made.map.domain.size();
  if (faces <= kFew || made.distortion.aggregate > kHardly || made.least_domain_faces > faces / 2) return made;
  ParameterizeOptions fewer = options;
  fewer.min_domain_faces = faces * 7 / 20;
  fewer.max_domain_faces = faces * 11 / 20;
  ParameterizeResult smaller = parameterize(std::move(surface), fewer, progress);
  const bool is_better = smaller.distortion.aggregate <= kMost && smaller.map.domain.size() < faces;
  return is_better ? std::move(smaller) : std::move(made);
}

UnwrapAtlas facts_of(const Strips& of, const StripLayout& layout, const std::string& name) {
  UnwrapAtlas atlas;
  atlas.name = name;
  atlas.map_size = layout.size;
  atlas.patches = of.patches.size();
  atlas.charts = static_cast<std::int64_t>(of.strips.size());
  atlas.inner_share = inner_texels(of, layout).texels / (static_cast<double>(layout.size) * layout.size);
  atlas.texels_per_unit = density_of(of, layout);
  return atlas;
}

}  // namespace

UnwrappedSurface unwrap_surface(SourceMesh surface, const std::string& name, const UnwrapOptions& options,
                                const Progress& progress, std::vector<std::string>& notes) {
  require_manifold(surface, name);
  const ParameterizeResult made = parameterized(std::move(surface), options.parameterize, progress);
  if (std::string note = note_on_domain_size(made, options.parameterize); !note.empty()) {
    notes.push_back(name + ": " + note);
  }
  report(progress, "cutting", 0);
  const SourceMesh& mesh = made.surface;
  const PatchLayout patches = patch_layout(mesh, made.map, kSamples);
  const std::vector<PatchStrip> strips = patch_strips(patches, longest_strip(patches));
  const Strips of{patches, strips, surface_area(mesh.positions, mesh.triangles)};
  UnwrappedSurface unwrapped;
  unwrapped.layout = layout_of(of, name, options);
  const Origins origins(mesh);
  unwrapped.surface = charted_surface(
      mesh, cut_along_patches(mesh, made.map, patches.places), [&](auto corners) { return origins.weights(corners); },
      [&](TriangleId t) { return origins.of_triangle(t); });
  join_into_strips(unwrapped.surface, strips);
  FlatVertexOptions flat;
  flat.most_carried = 1e-4;  // weights, that are linear: this is for their rounding
  leave_out_flat_vertices(unwrapped.surface, scales_of(unwrapped.layout), {}, flat);
  unwrapped.atlas = facts_of(of, unwrapped.layout, name);
  // A patch is a rhombus of 60 and 120 degrees on the domain, and a square in the atlas.
  unwrapped.atlas.l2_stretch = made.distortion.l2_stretch * std::sqrt(2 / std::sqrt(3.0));
  return unwrapped;
}

}  // namespace lozenge
