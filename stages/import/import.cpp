// The scene's instances are read one primitive after the other into a SurfaceBuilder, which welds them all at the end.
// How large the asset is, is added up from the accessors' counts before anything is read: a small file can name one
// mesh a million times.
#include "stages/import/import.h"

#include <tiny_gltf.h>

#include <limits>

#include "formats/error.h"
#include "formats/gltf_primitive.h"
#include "formats/gltf_scene.h"
#include "formats/gltf_source_mesh.h"
#include "formats/surface_builder.h"

namespace lozenge {

namespace {

/// One primitive in one place of the scene.
struct Placed {
  const GltfInstance* instance;
  int primitive;
};

std::string count_of(std::int64_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::vector<Placed> placed_triangles(const GltfFile& file, const std::vector<GltfInstance>& instances,
                                     ImportReport& report) {
  std::vector<Placed> placed;
  for (const GltfInstance& instance : instances) {
    const auto count = static_cast<int>(file.model->meshes[instance.mesh].primitives.size());
    for (int p = 0; p < count; ++p) {
      if (holds_triangles(file, instance.mesh, p)) {
        placed.push_back({&instance, p});
      } else {
        ++report.ignored_primitives;
      }
    }
  }
  return placed;
}

/// \throws Error(kLimit) where there are more triangles than allowed, or more vertices than those could use
PrimitiveSize total_size(const GltfFile& file, const std::vector<Placed>& placed, const ImportOptions& options) {
  const auto most = static_cast<std::uint64_t>(std::max<std::int64_t>(options.max_triangles, 0));
  const std::uint64_t most_vertices = std::min<std::uint64_t>(3 * most, std::numeric_limits<std::int32_t>::max());
  PrimitiveSize total;
  for (const Placed& item : placed) {
    const PrimitiveSize size = primitive_size(file, item.instance->mesh, item.primitive);
    total.triangles += size.triangles;
    total.vertices += size.vertices;
    if (total.triangles > most || total.vertices > most_vertices) {
      throw Error(ExitCode::kLimit, file.name + ": has more than " +
                                        count_of(static_cast<std::int64_t>(most), "triangle") +
                                        ", counting every instance, or more than " + std::to_string(most_vertices) +
                                        " vertices; reduce it, or raise the limit");
    }
  }
  return total;
}

void note_what_is_left_out(const GltfFile& file, const std::vector<GltfInstance>& instances, ImportReport& report) {
  std::int64_t skinned = 0;
  std::int64_t morphed = 0;
  for (const GltfInstance& instance : instances) {
    skinned += instance.skinned;
    for (const auto& primitive : file.model->meshes[instance.mesh].primitives) morphed += !primitive.targets.empty();
  }
  if (skinned > 0)
    report.notes.push_back(count_of(skinned, "skinned mesh instance") + " taken in the pose of modelling");
  if (morphed > 0) report.notes.push_back(count_of(morphed, "primitive") + " with morph targets taken without them");
  if (report.ignored_primitives > 0) {
    report.notes.push_back(count_of(report.ignored_primitives, "primitive") + " of points or lines left out");
  }
  if (report.dropped_triangles > 0) {
    report.notes.push_back(count_of(report.dropped_triangles, "triangle") + " dropped whose corners coincide");
  }
  if (report.repaired_attributes > 0) {
    report.notes.push_back(count_of(report.repaired_attributes, "normal, UV or colour value") +
                           " replaced that were not finite or out of range");
  }
}

std::vector<std::string> material_names(const GltfFile& file) {
  std::vector<std::string> names;
  for (const tinygltf::Material& material : file.model->materials) names.push_back(material.name);
  return names;
}

/// Lozenge's own mesh files say where their mesh came from; of others it comes from the file itself.
void set_names(const GltfFile& file, SourceMesh& mesh) {
  StoredNames names{scene_name(file), file.name, file.model->asset.generator};
  find_stored_names(file, names);
  mesh.scene_name = std::move(names.scene);
  mesh.origin = std::move(names.origin);
  mesh.generator = std::move(names.generator);
}

}  // namespace

SourceMesh import_gltf(const std::filesystem::path& path, const ImportOptions& options, const Progress& progress,
                       ImportReport* result) {
  report(progress, "reading", 0);
  const GltfFile file = open_gltf(path);
  const std::vector<GltfInstance> instances = scene_instances(file);
  ImportReport facts;
  facts.instances = static_cast<std::int64_t>(instances.size());
  const std::vector<Placed> placed = placed_triangles(file, instances, facts);
  const PrimitiveSize total = total_size(file, placed, options);

  SurfaceBuilder builder;
  builder.reserve(total.vertices, total.triangles);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    report(progress, "reading", static_cast<double>(i) / static_cast<double>(placed.size()));
    const GltfInstance& instance = *placed[i].instance;
    const std::string place = file.name + ": node " + std::to_string(instance.node) + ", " +
                              primitive_place(instance.mesh, placed[i].primitive);
    builder.add(read_primitive(file, instance.mesh, placed[i].primitive), instance.transform, place);
  }
  if (builder.triangle_count() == 0) {
    throw Error(ExitCode::kUnusableInput, file.name + ": its scene has no triangles; export a mesh");
  }
  // The buffers aren't needed any more, and welding needs memory.
  file.model->buffers.clear();

  report(progress, "welding", 0);
  WeldedSurface surface = builder.finish(material_names(file));
  facts.dropped_triangles = surface.dropped_triangles;
  facts.repaired_attributes = surface.repaired_attributes;
  note_what_is_left_out(file, instances, facts);
  if (surface.mesh.triangles.empty()) {
    throw Error(ExitCode::kUnusableInput, file.name + ": all of its " + count_of(facts.dropped_triangles, "triangle") +
                                              " have coinciding corners");
  }
  set_names(file, surface.mesh);
  report(progress, "welding", 1);
  if (result != nullptr) *result = std::move(facts);
  return std::move(surface.mesh);
}

}  // namespace lozenge
