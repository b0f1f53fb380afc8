#include "tests/damage/way_through.h"

#include <fmt/format.h>

#include <array>

#include "formats/base/error.h"
#include "formats/files/uv_surface_file.h"
#include "pipeline/unwrap/unwrap.h"
#include "stages/check/check_asset.h"
#include "stages/check/check_geometry_image.h"
#include "stages/check/check_parameterization.h"
#include "stages/check/check_patch_set.h"
#include "stages/check/check_source_mesh.h"
#include "stages/export/export.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "stages/pack/pack.h"
#include "stages/parameterize/parameterize.h"
#include "stages/sample/sample.h"

namespace lozenge::damage {

namespace {

/// A guarantee that a stage broke.
struct Broken {
  std::string what;
};

void require_passed(const CheckReport& report) {
  for (const CheckLine& line : report.lines) {
    if (!line.passed) throw Broken{fmt::format("{}: {}: {}", report.kind, line.name, line.detail)};
  }
}

struct Options {
  ImportOptions import;
  ParameterizeOptions parameterize;
  SampleOptions sample;
  ExportOptions asset;
};

/// From a handful of domain triangles to more than the surface has; holes filled or not.
Options options_for(std::uint32_t seed) {
  constexpr std::array<std::array<std::int32_t, 2>, 3> kFaces{{{12, 24}, {4, 8}, {60, 120}}};
  constexpr std::array kFilled{2.0, 0.0, 30.0};
  Options options;
  options.import.fill_holes = kFilled[seed / 3 % 3];
  options.parameterize.min_domain_faces = kFaces[seed % 3][0];
  options.parameterize.max_domain_faces = kFaces[seed % 3][1];
  options.sample.samples = seed % 2 == 0 ? 5 : 9;
  options.asset.caps = seed / 9 % 2 == 0 ? Caps::kKeep : Caps::kOpen;
  return options;
}

SourceMesh imported(const std::filesystem::path& file, const ImportOptions& options) {
  SourceMesh mesh = import_surface(file, options);
  require_manifold(mesh, file.filename().string());
  require_passed(check_source_mesh(mesh));
  return mesh;
}

/// What comes after the import may not blame a surface that it let pass, but for limits, and for holes that are all
/// there is.
void run_stages(SourceMesh mesh, const Options& options, const std::filesystem::path& asset) {
  const ParameterizeResult made = parameterize(std::move(mesh), options.parameterize, {});
  require_passed(check_parameterization(made.surface, made.map));
  if (made.distortion.folded_triangles > 0) throw Broken{"the map is folded"};
  const PatchSet patches = sample(made.surface, made.map, options.sample);
  require_passed(check_patch_set(patches));
  const GeometryImage image = pack(patches);
  require_passed(check_geometry_image(image));
  export_asset(asset, image, {}, options.asset);
  require_passed(check_asset(read_asset(asset)));
  const SourceSurface source{&made.surface, &made.map};
  ExportOptions of_source = options.asset;
  of_source.finest = Finest::kSource;
  export_asset(asset, image, {}, of_source, &source);
  require_passed(check_asset(read_asset(asset)));
}

/// Texture coordinates lie in the atlas, on no others, and leave the gutters between their charts.
void run_unwrap(const std::filesystem::path& file, const Options& options, const std::filesystem::path& output) {
  UnwrapOptions unwrapping;
  unwrapping.import = options.import;
  unwrapping.parameterize = options.parameterize;
  unwrapping.map_size = 512;
  const UnwrapResult result = unwrap(file, output, unwrapping);
  const UvStatistics uvs = uv_statistics(read_uv_surface(output), unwrapping.map_size);
  if (uvs.outside > 0) throw Broken{fmt::format("{} texture coordinates lie outside of the atlas", uvs.outside)};
  // Triangles that lie on others share their texels.
  if (result.left_out > 0) return;
  if (uvs.overlapping_texels > 0) throw Broken{fmt::format("{} texels of the atlas overlap", uvs.overlapping_texels)};
  // A chart may have caps of holes in it, which the asset doesn't have: pieces of it aren't charts.
  if (options.import.fill_holes == 0 && uvs.least_gap < 2 * unwrapping.gutter) {
    throw Broken{fmt::format("two charts are only {} texels apart", uvs.least_gap)};
  }
}

}  // namespace

Outcome take_through(const std::filesystem::path& file, std::uint32_t seed) {
  const Options options = options_for(seed);
  bool is_imported = false;
  try {
    SourceMesh mesh = imported(file, options.import);
    is_imported = true;
    run_stages(std::move(mesh), options, file.parent_path() / "asset.glb");
    run_unwrap(file, options, file.parent_path() / "unwrapped.glb");
    return {Fate::kBuilt, ""};
  } catch (const Broken& broken) {
    return {Fate::kBroken, broken.what};
  } catch (const Error& error) {
    const bool blames_input =
        !is_imported && (error.code() == ExitCode::kUnusableInput || error.code() == ExitCode::kUnsupported);
    return {blames_input || error.code() == ExitCode::kLimit ? Fate::kRefused : Fate::kBroken,
            fmt::format("exit code {}: {}", static_cast<int>(error.code()), error.what())};
  } catch (const std::exception& error) {
    return {Fate::kBroken, error.what()};
  }
}

}  // namespace lozenge::damage
