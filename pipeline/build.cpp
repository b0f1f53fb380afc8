// One function for each stage, in their order; each takes what the stages before it made and enters what it knows into
// the report. Files are written as soon as they can be, into the hidden folder of an OutputSet, so that the memory
// behind them can go.
#include "pipeline/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/texture_files.h"
#include "pipeline/arrays.h"
#include "pipeline/atlas_room.h"
#include "pipeline/basisu_asset.h"
#include "pipeline/cache/map_store.h"
#include "pipeline/maps/map_size.h"
#include "pipeline/output_name.h"
#include "pipeline/output_set.h"
#include "pipeline/quality/posed_quality.h"
#include "pipeline/quality/stage_clock.h"
#include "stages/bake/source_look.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "stages/render/contact_sheet.h"
#include "stages/sample/sample_count.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

/// One build while it runs.
struct Build {
  const fs::path& input;
  const BuildOptions& options;
  const Progress& progress;
  std::string name;
  OutputSet& outputs;
  const BasisuEncoder* basisu;  ///< null where nobody wants such an asset
  StageClock clock;
  BuildResult result;
};

/// Runs a stage between two looks at the clock. `work` gets a progress that names the stage.
template <typename Work>
auto stage(Build& build, const std::string& name, const Work& work) {
  build.clock.begin(name);
  const Progress progress = [&build, &name](std::string_view what, double done) {
    report(build.progress, what == name ? name : fmt::format("{} ({})", name, what), done);
  };
  progress(name, 0);
  auto made = work(progress);
  const StageCost cost = build.clock.end();
  if (build.options.stage_done) build.options.stage_done(cost);
  return made;
}

/// What all stages take at most at any time: measured with assets of 120,000 to 830,000 triangles, and rounded up. The
/// export, which fits levels, and the bake are the greediest.
std::uint64_t estimated_memory(std::uint64_t triangles, const BuildOptions& options) {
  constexpr std::uint64_t kLibraries = 150'000'000;
  constexpr std::uint64_t kOfTriangle = 600;
  constexpr std::uint64_t kOfTexel = 30;
  constexpr std::uint64_t kOfSample = 150;
  constexpr std::uint64_t kUsualSize = 2048;
  const std::uint64_t size = options.bake.size > 0 ? static_cast<std::uint64_t>(options.bake.size) : kUsualSize;
  const std::uint64_t texels = size * size;
  // A patch for each edge of the domain, of which a triangle has one and a half.
  const auto patches =
      static_cast<std::uint64_t>(domain_faces(options.parameterize, static_cast<std::int64_t>(triangles)).most) * 3 / 2;
  const auto side = static_cast<std::uint64_t>(samples_at_most(options.sample));
  const std::uint64_t samples = side * side;
  return kLibraries + kOfTriangle * triangles + kOfTexel * texels + kOfSample * patches * samples;
}

/// Of the memory that there may be, what tiles of textures take at most: one part of so many.
constexpr std::uint64_t kShareOfCache = 16;

/// What the maps take at most at any time: all of them as floats, while levels of detail get normals of their own or
/// one map is made of others; tiles of textures; and the program.
std::uint64_t memory_of_maps(const SourceMesh& mesh, const BakeOptions& options, const PatchLayout& patches,
                             std::uint64_t max_memory) {
  constexpr std::uint64_t kLibraries = 150'000'000;
  constexpr std::uint64_t kOfWork = 3 * 3 * sizeof(float);
  constexpr std::uint64_t kOfLevels = 16;
  const auto side = static_cast<std::uint64_t>(atlas_size(options, patches));
  std::uint64_t of_texel = kOfWork + kOfLevels;
  for (const MapKind kind : options.maps.empty() ? usual_maps(options, mesh) : options.maps) {
    // Occlusion has a size of its own, which is small.
    if (kind != MapKind::kOcclusion) of_texel += static_cast<std::uint64_t>(traits_of(kind).channels) * sizeof(float);
  }
  const std::uint64_t tiles = mesh.images.empty() ? 0 : std::min(TextureLimits().cache, max_memory / kShareOfCache);
  return kLibraries + side * side * of_texel + tiles;
}

/// Of maps that may be as large as one likes, as large as there is memory for.
BakeOptions bake_options(const Build& build, const SourceMesh& mesh, const PatchLayout& patches) {
  BakeOptions options = with_map_size(build.options.bake, mesh, patches);
  options.source_level = build.options.asset.finest != Finest::kSamples;
  const std::uint64_t most = build.options.import.max_memory;
  if (most == 0 || build.options.bake.size != 0) return options;
  while (memory_of_maps(mesh, options, patches, most) > most && options.size / 2 >= least_map_size(patches)) {
    options.size /= 2;
  }
  return options;
}

/// Now that it is known how large maps will be.
void require_memory_of_maps(Build& build, const SourceMesh& mesh, const PatchLayout& patches) {
  const std::uint64_t most = build.options.import.max_memory;
  if (most == 0) return;
  const BakeOptions options = bake_options(build, mesh, patches);
  require_memory(memory_of_maps(mesh, options, patches, most), most,
                 fmt::format("{}: maps of {} texels a side (a smaller --map-size takes less)",
                             build.input.filename().string(), atlas_size(options, patches)));
  if (options.size == with_map_size(build.options.bake, mesh, patches).size) return;
  build.result.notes.push_back(
      fmt::format("maps are {0} x {0} texels, for --max-memory leaves no room for more", options.size));
}

void require_memory_for(const Build& build, std::int64_t triangles) {
  require_memory(
      estimated_memory(static_cast<std::uint64_t>(triangles), build.options), build.options.import.max_memory,
      fmt::format("{}: building from {} triangles with these options", build.input.filename().string(), triangles));
}

/// As far as that is known before there is a map.
void require_room(const Build& build) {
  require_room_in_maps(least_patches(*build.result.report.source, build.options.parameterize), build.options,
                       build.input.filename().string());
}

SourceMesh import_stage(Build& build) {
  return stage(build, "import", [&](const Progress& progress) {
    ImportReport notes;
    SourceMesh mesh = import_surface(build.input, build.options.import, progress, &notes);
    build.result.notes = std::move(notes.notes);
    build.result.report.repairs = std::move(notes.repairs);
    build.result.report.instances = InstanceFacts{notes.instances, notes.repeated_instances, notes.copies};
    require_memory_for(build, static_cast<std::int64_t>(mesh.triangles.size()));
    build.result.report.source = require_manifold(mesh, build.input.filename().string());
    require_room(build);
    return mesh;
  });
}

/// `mesh` becomes the surface that the map is of: the same one, perhaps with long edges split.
Parameterization parameterize_stage(Build& build, SourceMesh& mesh) {
  return stage(build, "parameterize", [&](const Progress& progress) {
    ParameterizeResult made = parameterize(std::move(mesh), build.options.parameterize, progress);
    mesh = std::move(made.surface);
    build.result.report.domain = domain_facts(made.map.domain);
    build.result.report.domain->least_triangles = made.least_domain_faces;
    build.result.report.domain->asked = {made.asked.least, made.asked.most};
    build.result.report.domain->parts_by_first_level = parts_by_first_level(made.map);
    std::string note = note_on_domain_size(made, build.options.parameterize);
    if (!note.empty()) build.result.notes.push_back(std::move(note));
    build.result.report.distortion = made.distortion;
    return std::move(made.map);
  });
}

GeometryImage sample_and_pack_stages(Build& build, const SourceMesh& mesh, const Parameterization& map) {
  const PatchSet patches = stage(
      build, "sample", [&](const Progress& progress) { return sample(mesh, map, build.options.sample, progress); });
  return stage(build, "pack", [&](const Progress&) {
    GeometryImage image = pack(patches, build.options.pack);
    write_geometry_image(build.outputs.staged(build.name + ".gim.exr"), image);
    build.result.report.patches = patch_facts(image);
    return image;
  });
}

/// The source's pictures, ready for look-ups; null where no map needs any.
std::unique_ptr<TextureFiles> textures_stage(Build& build, const SourceMesh& mesh) {
  if (mesh.images.empty()) return nullptr;
  return stage(build, "textures", [&](const Progress& progress) {
    TextureLimits limits;
    limits.max_memory = build.options.import.max_memory;
    if (limits.max_memory > 0) limits.cache = std::min(limits.cache, limits.max_memory / kShareOfCache);
    auto textures = std::make_unique<TextureFiles>(mesh, texture_roles(build.options.bake, mesh), limits, progress);
    for (const std::string& note : textures->notes()) build.result.notes.push_back(note);
    return textures;
  });
}

/// What the source knows is seen best from a fine level, and fitted levels take it from there: a budget of triangles
/// makes no other maps.
int level_to_bake_for(const GeometryImage& image, ExportOptions asset) {
  asset.triangle_budget = 0;
  return level_to_export(image, asset);
}

BakedMaps bake_stage(Build& build, const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                     const Textures* textures) {
  return stage(build, "bake", [&](const Progress& progress) {
    BakeOptions options = bake_options(build, mesh, image.layout);
    options.level = level_to_bake_for(image, build.options.asset);
    BakedMaps maps = bake(mesh, map, image, options, progress, textures);
    build.result.report.bake = maps.statistics;
    if (std::string note = note_on_occlusion_pose(options, maps, mesh); !note.empty()) {
      build.result.notes.push_back(std::move(note));
    }
    if (std::string note = note_on_occlusion(maps.statistics); !note.empty()) {
      build.result.notes.push_back(std::move(note));
    }
    // The asset is made of what the files hold, as the command `export` makes it.
    MapFiles files = build.options.maps;
    const TextureFormat format = build.options.asset.textures.format;
    files.ktx2 = files.ktx2 || format == TextureFormat::kKtx2 || format == TextureFormat::kBasisu;
    BakedMaps stored = write_maps(build.outputs.staging_folder(), build.name, std::move(maps), files);
    write_mips(build.outputs.staging_folder(), build.name, stored, image.layout, files);
    return stored;
  });
}

AssetFacts export_stage(Build& build, const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                        const BakedMaps& maps) {
  return stage(build, "export", [&](const Progress&) {
    const SourceSurface source{&mesh, &map};
    const AssetFacts facts =
        export_asset(build.outputs.staged(build.name + ".glb"), image, maps, build.options.asset, &source);
    build.result.report.asset = asset_quality(facts);
    if (!facts.note.empty()) build.result.notes.push_back(facts.note);
    return facts;
  });
}

void basisu_stage(Build& build) {
  stage(build, "basisu", [&](const Progress& progress) {
    build.basisu->encode(build.outputs.staged(build.name + ".glb"), progress);
    return 0;
  });
}

void arrays_stage(Build& build, const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                  const BakedMaps& maps) {
  stage(build, "arrays", [&](const Progress& progress) {
    const SourceSurface source{&mesh, &map};
    write_arrays(build.outputs.staged(build.name + ".npz"), ArrayFormat::kNpz, image, maps, &source, progress);
    return 0;
  });
}

void compare_stage(Build& build, const SourceMesh& mesh, const AssetFacts& asset) {
  const Comparison comparison = stage(build, "compare", [&](const Progress& progress) {
    return compare({mesh.positions, mesh.triangles}, {asset.positions, asset.surface}, build.options.compare, progress);
  });
  build.result.report.asset->mean_distance_percent = comparison.mean_percent();
  build.result.report.asset->max_distance_percent = comparison.max_percent();
  if (comparison.both_end()) {
    build.result.report.asset->boundary_max_distance_percent = comparison.boundary_max_percent();
  }
}

/// How levels hold up in poses: for the report alone.
void measure_in_poses(Build& build, const SourceMesh& mesh) {
  if (build.options.report.empty() || mesh.rig.animations.empty()) return;
  build.result.report.poses = stage(build, "poses", [&](const Progress& progress) {
    const std::string name = build.name + ".glb";
    return measure_in_poses(mesh, read_asset_shapes(build.outputs.staged(name)), name, progress);
  });
}

/// Keeps references to both.
SourceColour colours_of(const SourceMesh& mesh, const Textures* textures) {
  struct Source {
    ShadingNormals normals;
    SourceLook look;
    Source(const SourceMesh& mesh, const Textures* textures) : normals(mesh), look(mesh, normals, textures) {}
  };
  return [source = std::make_shared<const Source>(mesh, textures)](TriangleId t, const Vec3d& weights) {
    const Vec4d colour = source->look.base_colour({{t, weights}, Vec3d(0, 0, 0), Vec3d(0, 0, 0)});
    return Vec3f(Vec3d(colour.x, colour.y, colour.z));
  };
}

void preview_stage(Build& build, const SourceMesh& mesh, const Parameterization& map, const Textures* textures) {
  stage(build, "preview", [&](const Progress&) {
    const RenderOptions& options = build.options.preview_pictures;
    const std::string name = build.name + ".glb";
    Asset asset = read_asset(build.outputs.staged(name));
    std::vector<std::pair<std::string, Picture>> in_poses;
    if (!mesh.rig.animations.empty()) in_poses = pictures_in_poses(asset, name, options);
    write_picture(build.outputs.staged(build.name + ".preview.png"),
                  preview(mesh, map, std::move(asset), build.result.report.source->triangles, options,
                          std::move(in_poses), has_made_look(mesh) ? colours_of(mesh, textures) : SourceColour()));
    return 0;
  });
}

/// The surface and its map as another build left them, if one did.
std::optional<StoredMap> recall_stage(Build& build) {
  const MapStore* store = build.options.map_store;
  if (store == nullptr) return std::nullopt;
  std::optional<StoredMap> stored = stage(build, "recall", [&](const Progress&) { return store->find(); });
  if (!stored) return std::nullopt;
  build.result.notes = std::move(stored->notes);
  take_facts_of_map(stored->facts, build.result.report);
  require_memory_for(build, build.result.report.source->triangles);
  require_room(build);
  return stored;
}

/// The surface, as the domain wants it, and its map.
std::pair<SourceMesh, Parameterization> map_stages(Build& build) {
  if (auto stored = recall_stage(build)) return {std::move(stored->surface), std::move(stored->map)};
  SourceMesh mesh = import_stage(build);
  Parameterization map = parameterize_stage(build, mesh);
  if (build.options.map_store != nullptr) {
    build.options.map_store->store(mesh, map, build.result.report, build.result.notes);
  }
  return {std::move(mesh), std::move(map)};
}

void run_stages(Build& build) {
  const auto [mesh, map] = map_stages(build);
  const PatchLayout patches = patch_layout(mesh, map, samples_at_most(build.options.sample));
  require_room_in_maps(patches, build.options, build.input.filename().string());
  require_memory_of_maps(build, mesh, patches);
  const GeometryImage image = sample_and_pack_stages(build, mesh, map);
  const std::unique_ptr<TextureFiles> textures = textures_stage(build, mesh);
  const BakedMaps maps = bake_stage(build, mesh, map, image, textures.get());
  if (build.options.arrays) arrays_stage(build, mesh, map, image, maps);
  const AssetFacts asset = export_stage(build, mesh, map, image, maps);
  if (build.basisu != nullptr) basisu_stage(build);
  compare_stage(build, mesh, asset);
  measure_in_poses(build, mesh);
  if (build.options.preview) preview_stage(build, mesh, map, textures.get());
}

}  // namespace

BuildResult build_asset(const fs::path& input, const BuildOptions& options, const Progress& progress) {
  const std::string name = output_name(input, options.name);
  refuse_to_replace_input(input, options.folder / (name + ".glb"));
  // Who asks for what can't be made hears of it before the work.
  std::optional<BasisuEncoder> basisu;
  if (options.asset.textures.format == TextureFormat::kBasisu) basisu.emplace(options.basisu_script);
  OutputSet outputs(options.folder);
  // Begun before the work, so that a place that can't be written is found now.
  std::optional<AtomicFile> report_file;
  if (!options.report.empty()) report_file.emplace(options.report);
  Build build{input, options, progress, name, outputs, basisu ? &*basisu : nullptr, {}, {}};
  run_stages(build);
  build.result.report.input = input.string();
  build.clock.finish(build.result.report);
  if (report_file) write_report(report_file->temporary_path(), build.result.report);
  if (options.complete) options.complete(build.result, outputs);
  build.result.files = outputs.commit(name + ".glb");
  if (report_file) report_file->commit();
  return std::move(build.result);
}

}  // namespace lozenge
