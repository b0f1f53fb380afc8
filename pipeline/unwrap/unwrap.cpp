// Every mesh becomes a surface of its own space whose corners know which triangle of the file they come from; all of
// them, or each for itself, are mapped, cut to patches and laid into an atlas. What a triangle became is then told to
// the document, which interpolates its own attributes.
#include "pipeline/unwrap/unwrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/files/gltf_new_vertices.h"
#include "formats/files/gltf_rewrite.h"
#include "pipeline/unwrap/unwrap_atlas.h"
#include "pipeline/unwrap/unwrap_meshes.h"

namespace lozenge {
namespace {

using Json = nlohmann::ordered_json;

/// The meshes that share an atlas.
std::vector<std::vector<PlacedMesh>> groups_of(std::vector<PlacedMesh> meshes, bool each) {
  if (!each) return {std::move(meshes)};
  std::vector<std::vector<PlacedMesh>> groups;
  for (PlacedMesh& mesh : meshes) groups.push_back({std::move(mesh)});
  return groups;
}

}  // namespace

UnwrapResult unwrap(const std::filesystem::path& input, const std::filesystem::path& output,
                    const UnwrapOptions& options, const Progress& progress) {
  UnwrapResult result;
  report(progress, "reading", 0);
  GltfDocument document = open_as_gltf(input, options.import, result.notes);
  OriginTable origins(document.file);
  std::vector<PlacedMesh> meshes = placed_meshes(document.file);
  require_sensible(document.file, meshes, options.import);
  CutPrimitives cut;
  const auto groups = groups_of(std::move(meshes), options.pack_each);
  for (const std::vector<PlacedMesh>& group : groups) {
    SourceMesh surface = surface_of_meshes(document.file, group, options.import, origins, result.notes);
    if (surface.triangles.empty()) continue;
    result.meshes += static_cast<std::int64_t>(group.size());
    const std::string name = options.pack_each ? group.front().name : document.file.name;
    UnwrappedSurface unwrapped = unwrap_surface(std::move(surface), name, options, progress, result.notes);
    result.atlases.push_back(unwrapped.atlas);
    add_cut_primitives(unwrapped, origins, cut);
  }
  if (result.atlases.empty()) {
    throw Error(ExitCode::kUnusableInput, document.file.name + ": no node places a mesh of triangles with any area");
  }
  result.left_out = add_left_out(origins, cut);
  result.triangles_before = origins.size();
  for (const CutPrimitive& primitive : cut.primitives) {
    result.triangles += static_cast<std::int64_t>(primitive.triangles.size());
  }
  report(progress, "writing", 0);
  GltfRewrite rewrite(document);
  rewrite_primitives(rewrite, document, cut.primitives, options.uv_set);
  rewrite.write(output, input.parent_path());
  return result;
}

std::string unwrap_json(const UnwrapResult& result) {
  Json atlases = Json::array();
  for (const UnwrapAtlas& atlas : result.atlases) {
    atlases.push_back({{"name", atlas.name},
                       {"map_size", atlas.map_size},
                       {"patches", atlas.patches},
                       {"charts", atlas.charts},
                       {"inner_share", atlas.inner_share},
                       {"l2_stretch", atlas.l2_stretch},
                       {"texels_per_unit", atlas.texels_per_unit}});
  }
  const Json json{{"meshes", result.meshes},
                  {"triangles_before", result.triangles_before},
                  {"triangles", result.triangles},
                  {"left_out", result.left_out},
                  {"atlases", std::move(atlases)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> unwrap_lines(const UnwrapResult& result) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("meshes      {} unwrapped, {} triangles of {}", result.meshes, result.triangles,
                              result.triangles_before));
  if (result.left_out > 0) {
    lines.push_back(fmt::format("left out    {} triangles that lie on others or have no area", result.left_out));
  }
  for (const UnwrapAtlas& atlas : result.atlases) {
    lines.push_back(fmt::format(
        "atlas       {}: {} x {} texels, {} patches in {} charts, {:.1f} % of it inside of them, {:.4g} texels "
        "to a unit, L2 stretch {:.3f}",
        atlas.name, atlas.map_size, atlas.map_size, atlas.patches, atlas.charts, 100 * atlas.inner_share,
        atlas.texels_per_unit, atlas.l2_stretch));
  }
  return lines;
}

}  // namespace lozenge
