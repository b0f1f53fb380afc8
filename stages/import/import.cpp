// The scene's instances are read one primitive after the other into a SurfaceBuilder, which welds them all at the end.
// How large the asset is, is added up from the accessors' counts before anything is read: a small file can name one
// mesh a million times.
#include "stages/import/import.h"

#include <tiny_gltf.h>

#include <limits>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/gltf_source_mesh.h"
#include "formats/files/readers/gltf/check.h"
#include "formats/files/readers/gltf/primitive.h"
#include "formats/files/readers/gltf/scene.h"
#include "formats/files/surface_builder.h"
#include "stages/import/repeated_meshes.h"
#include "stages/import/surface_materials.h"

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

std::uint64_t most_triangles(const ImportOptions& options) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(options.max_triangles, 0));
}

/// \throws Error(kLimit) where there are more triangles than allowed, or more vertices than those could use
PrimitiveSize total_size(const GltfFile& file, const std::vector<Placed>& placed, const ImportOptions& options) {
  const std::uint64_t most = most_triangles(options);
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
                                        " vertices; reduce it, or raise --max-triangles");
    }
  }
  return total;
}

/// What the importer takes for a vertex and a triangle: attributes as they are read, gathered, welded, and moved to the
/// triangles' corners. Measured; an asset without normals, UVs and colours takes half.
constexpr std::uint64_t kBytesOfVertex = 150;
constexpr std::uint64_t kBytesOfTriangle = 200;

/// \throws Error(kLimit) where reading and welding takes more memory than allowed
void require_memory_for(const GltfFile& file, const PrimitiveSize& size, const ImportOptions& options) {
  require_memory(file.memory + kBytesOfVertex * size.vertices + kBytesOfTriangle * size.triangles, options.max_memory,
                 file.name + ": importing " + count_of(static_cast<std::int64_t>(size.triangles), "triangle"));
}

/// Placements of meshes that are placed more than once.
std::int64_t repeated(const GltfFile& file, const std::vector<GltfInstance>& instances) {
  std::vector<std::int64_t> times(file.model->meshes.size(), 0);
  for (const GltfInstance& instance : instances) ++times[instance.mesh];
  std::int64_t sum = 0;
  for (const std::int64_t t : times) sum += t > 1 ? t : 0;
  return sum;
}

/// "5 placements of meshes that are placed more than once; 4 of them place ..."
std::string words_about_repeats(const ImportReport& report) {
  const std::int64_t own = report.repeated_instances - report.copies;
  std::string text = count_of(report.repeated_instances, "placement") + " of meshes that are placed more than once; ";
  if (report.copies == 0) return text + "each becomes surface of its own";
  text += std::to_string(report.copies) + " of them only place" + (report.copies == 1 ? "s" : "") +
          " the surface of another one again";
  return text + (own == 1 ? "" : ", the others become surface of their own");
}

/// "2 cameras, 1 animation", of what there is in the file beside surfaces; empty where there is nothing.
std::string other_contents(const tinygltf::Model& model) {
  std::string text;
  const auto add = [&](std::size_t number, const std::string& noun) {
    if (number > 0) text += (text.empty() ? "" : ", ") + count_of(static_cast<std::int64_t>(number), noun);
  };
  add(model.scenes.empty() ? 0 : model.scenes.size() - 1, "other scene");
  add(model.cameras.size(), "camera");
  add(model.lights.size(), "light");
  add(model.animations.size(), "animation");
  return text;
}

std::string unknown_extensions(const tinygltf::Model& model) {
  std::string text;
  for (const std::string& extension : model.extensionsUsed) {
    if (!knows_gltf_extension(extension)) text += (text.empty() ? "" : ", ") + extension;
  }
  return text;
}

void note_what_is_left_out(const GltfFile& file, const std::vector<GltfInstance>& instances, ImportReport& report) {
  std::int64_t skinned = 0;
  std::int64_t morphed = 0;
  for (const GltfInstance& instance : instances) {
    skinned += instance.skinned;
    for (const auto& primitive : file.model->meshes[instance.mesh].primitives) morphed += !primitive.targets.empty();
  }
  const auto note = [&](std::int64_t count, const std::string& noun, const std::string& fate) {
    if (count > 0) report.notes.push_back(count_of(count, noun) + " " + fate);
  };
  if (report.repeated_instances > 0) report.notes.push_back(words_about_repeats(report));
  note(skinned, "skinned mesh instance", "taken in the pose of modelling");
  note(morphed, "primitive", "with morph targets taken without them");
  note(report.ignored_primitives, "primitive", "of points or lines left out");
  note(report.repaired_attributes, "normal, UV or colour value", "replaced that were not finite or out of range");
  if (const std::string others = other_contents(*file.model); !others.empty()) {
    report.notes.push_back("left out: " + others);
  }
  if (const std::string names = unknown_extensions(*file.model); !names.empty()) {
    report.notes.push_back("extensions that Lozenge doesn't know left out: " + names);
  }
}

/// Takes out of the builder what only places the surface of another placement again. \return the meshes of which that
/// is so
std::vector<RepeatedMesh> share_surfaces(const GltfFile& file, const std::vector<GltfInstance>& instances,
                                         const std::vector<Placed>& placed, SurfaceBuilder& builder,
                                         SurfaceMaterials& materials, ImportReport& report) {
  std::vector<std::int32_t> instance_of;  // [primitive of the builder]
  for (const Placed& item : placed) {
    instance_of.push_back(static_cast<std::int32_t>(item.instance - instances.data()));
  }
  std::vector<bool> may_be_shared(instances.size(), false);
  const std::vector<bool> touches = builder.find_contacts(instance_of, static_cast<std::int32_t>(instances.size()));
  for (const std::int32_t i : instance_of) may_be_shared[i] = !touches[i] && !instances[i].skinned;
  RepeatedMeshes repeated = find_repeated_meshes(file, instances, may_be_shared);
  for (std::size_t p = 0; p < placed.size(); ++p) {
    const std::int32_t i = instance_of[p];
    if (repeated.is_copy[i]) builder.leave_out(p);
    if (repeated.surface_of[i] < 0) continue;
    const auto& primitive = file.model->meshes[instances[i].mesh].primitives[placed[p].primitive];
    builder.set_material(p, materials.of_repeated(repeated.surface_of[i], primitive.material));
  }
  for (const RepeatedMesh& mesh : repeated.meshes) report.copies += static_cast<std::int64_t>(mesh.copies.size());
  return std::move(repeated.meshes);
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
  const GltfFile file = open_gltf(path, {.max_memory = options.max_memory, .max_triangles = most_triangles(options)});
  const std::vector<GltfInstance> instances = scene_instances(file);
  ImportReport facts;
  facts.instances = static_cast<std::int64_t>(instances.size());
  const std::vector<Placed> placed = placed_triangles(file, instances, facts);
  facts.repeated_instances = repeated(file, instances);
  const PrimitiveSize total = total_size(file, placed, options);
  require_memory_for(file, total, options);

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
  SurfaceMaterials materials(file);
  std::vector<RepeatedMesh> repeated;
  if (options.instances == Instances::kShared && facts.repeated_instances > 0) {
    repeated = share_surfaces(file, instances, placed, builder, materials, facts);
  }
  WeldedSurface surface = builder.finish(materials.names());
  facts.dropped_triangles = surface.dropped_triangles;
  if (facts.dropped_triangles > 0) {
    facts.repairs.add(RepairKind::kDegenerateTriangles, facts.dropped_triangles, surface.dropped_at);
  }
  facts.repaired_attributes = surface.repaired_attributes;
  note_what_is_left_out(file, instances, facts);
  if (surface.mesh.triangles.empty()) {
    throw Error(ExitCode::kUnusableInput, file.name + ": all of its " + count_of(facts.dropped_triangles, "triangle") +
                                              " have coinciding corners");
  }
  set_names(file, surface.mesh);
  materials.describe(file, std::move(repeated), surface.mesh);
  report(progress, "welding", 1);
  if (result != nullptr) *result = std::move(facts);
  return std::move(surface.mesh);
}

}  // namespace lozenge
