// The options of bake, the same in its own command and in `build`.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "formats/base/error.h"
#include "pipeline/maps/map_files.h"
#include "stages/bake/bake.h"
#include "tools/command_line.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

/// [option] all kinds of maps.
Words<MapKind> kinds_by_option() {
  Words<MapKind> kinds;
  for (const MapTraits& traits : kMapKinds) kinds.emplace_back(traits.option, traits.kind);
  return kinds;
}

/// "2048", "auto", "auto,normal=4096", "base-color=1024,orm=512".
void parse_map_sizes(const std::string& text, BakeOptions& bake) {
  constexpr int kLeast = 16;
  constexpr int kMost = 16384;
  const auto parse_size = [&](std::string_view word) {
    int size = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), size);
    if (error != std::errc() || end != word.data() + word.size() || size < kLeast || size > kMost) {
      throw Error(ExitCode::kUsage, fmt::format("'{}' is not in the range {} to {}", word, kLeast, kMost));
    }
    return size;
  };
  std::string_view rest = text;
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    more = comma != std::string_view::npos;
    rest = more ? rest.substr(comma + 1) : std::string_view();
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos) {
      bake.size = word == "auto" ? 0 : parse_size(word);
      continue;
    }
    const std::string_view name = word.substr(0, equals);
    const auto* const traits =
        std::find_if(kMapKinds.begin(), kMapKinds.end(), [&](const MapTraits& t) { return t.option == name; });
    if (traits == kMapKinds.end()) throw Error(ExitCode::kUsage, fmt::format("'{}' is no map", name));
    bake.sizes.push_back({traits->kind, parse_size(word.substr(equals + 1))});
  }
}

/// "Any of normal, object-normal, ...; without it, ..."
std::string help_on_maps() {
  std::string list;
  for (const MapTraits& traits : kMapKinds) list.append(list.empty() ? "" : ", ").append(traits.option);
  return fmt::format("Any of {}; without it, normals, occlusion, and what the source's materials have", list);
}

void add_file_options(Options& options, MapFiles& files) {
  options.group("Maps");
  options.choice("--map-format NAME", files.format,
                 Words<MapFormat>{{"png", MapFormat::kPng}, {"exr", MapFormat::kExr}},
                 "png, or exr (floating point) [png]");
  options.flag("--ktx2", files.ktx2, "Also each map with its mips, filtered on the surface, as NAME.normal.ktx2, ...");
  options.one_of("--map-bits N", files.bits, {8, 16}, "Bits a channel of normal maps in a PNG: 8 or 16")
      .shows_default();
  options.choice("--normal-y NAME", files.normal_y, Words<NormalY>{{"up", NormalY::kUp}, {"down", NormalY::kDown}},
                 "Where y points in the files of tangent-space normals: up (OpenGL, and always in the asset) or down "
                 "(DirectX) [up]");
}

void add_ray_options(Options& options, BakeOptions& bake) {
  options.group("How maps take over the source");
  options.choice("--projection NAME", bake.projection,
                 Words<Projection>{{"rays", Projection::kRays}, {"correspondence", Projection::kCorrespondence}},
                 "rays from the level of detail, or the map's own correspondence [rays]");
  options.number("--cage LENGTH", bake.cage_distance, kPositive,
                 "How far rays go, in the asset's units; without it, measured");
}

void add_occlusion_options(Options& options, BakeOptions& bake) {
  options.group("Ambient occlusion");
  options.choice("--occlusion NAME", bake.occlusion,
                 Words<OcclusionOf>{
                     {"auto", OcclusionOf::kAuto}, {"baked", OcclusionOf::kBaked}, {"source", OcclusionOf::kSource}},
                 "baked from the shape (times the source's own), source: its textures' alone, or auto: baked where the "
                 "source shows neither textures nor colours [auto]");
  options.choice("--occlusion-pose NAME", bake.occlusion_pose,
                 Words<OcclusionPose>{{"rest", OcclusionPose::kRest}, {"modelling", OcclusionPose::kModelling}},
                 "Of what moves: rest, all as it stands at rest, or modelling, each body by itself, where it was "
                 "modelled [rest]");
  options.number("--occlusion-size N", bake.occlusion_size, {16, 16384}, "Side of the map, in texels").shows_default();
  options.number("--occlusion-rays N", bake.occlusion_rays, {1, 65536}, "Rays a texel").shows_default();
  options.number("--occlusion-distance LENGTH", bake.occlusion_distance, kPositive,
                 "What is farther away doesn't darken, in the asset's units; without it, 15 percent of the diagonal");
}

}  // namespace

void add_bake_options(Options& options, BakeOptions& bake, MapFiles& files) {
  options.group("Maps");
  options.choices("--maps NAME", bake.maps, kinds_by_option(), help_on_maps());
  options.parsed(
      "--map-size N|auto|MAP=N,...", [&bake](const std::string& text) { parse_map_sizes(text, bake); },
      "Side of the square maps, in texels, and of single ones as base-color=1024; auto: as fine as the source's "
      "textures, up to 4096; 2048 without any, more where patches would be small [auto]");
  options.number(
      "--gutter N", bake.gutter, {0, 64},
      "Texels around each patch that repeat its neighbours; without it, 4 or, as long as patches keep most of the "
      "map, more");
  add_file_options(options, files);
  add_ray_options(options, bake);
  add_occlusion_options(options, bake);
}

}  // namespace lozenge
