// The scene's instances are read one primitive after the other into a SurfaceBuilder, which welds them all at the end.
// How large the asset is, is added up from the primitives' counts before any is read: a small file can name one mesh a
// million times.
#include "stages/import/import.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/input_format.h"
#include "formats/files/surface_builder.h"
#include "formats/surface/pose.h"
#include "stages/import/find_bodies.h"
#include "stages/import/local_origin.h"
#include "stages/import/surface_materials.h"

namespace lozenge {

namespace {

using Imath::M44d;

/// One primitive in one place of the scene.
struct Placed {
  const InputInstance* instance;
  int primitive;
};

std::vector<Placed> placed_primitives(const InputAsset& asset) {
  std::vector<Placed> placed;
  for (const InputInstance& instance : asset.instances) {
    const auto count = static_cast<int>(asset.meshes[instance.mesh].primitives.size());
    for (int p = 0; p < count; ++p) placed.push_back({&instance, p});
  }
  return placed;
}

const InputPrimitive& primitive_of(const InputAsset& asset, const Placed& item) {
  return asset.meshes[item.instance->mesh].primitives[item.primitive];
}

std::uint64_t most_triangles(const ImportOptions& options) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(options.max_triangles, 0));
}

struct Size {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
};

/// \throws Error(kLimit) where there are more triangles than allowed, or more vertices than those could use
Size total_size(const InputAsset& asset, const std::vector<Placed>& placed, const ImportOptions& options) {
  const std::uint64_t most = most_triangles(options);
  const std::uint64_t most_vertices = std::min<std::uint64_t>(3 * most, std::numeric_limits<std::int32_t>::max());
  Size total;
  for (const Placed& item : placed) {
    total.triangles += primitive_of(asset, item).triangles;
    total.vertices += primitive_of(asset, item).vertices;
    if (total.triangles > most || total.vertices > most_vertices) {
      throw Error(ExitCode::kLimit, asset.file + ": has more than " +
                                        count_of(static_cast<std::int64_t>(most), "triangle") +
                                        ", counting every instance, or more than " + std::to_string(most_vertices) +
                                        " vertices; reduce it, or raise --max-triangles");
    }
  }
  return total;
}

/// The most morph targets that any body has.
std::size_t most_targets(const InputAsset& asset) {
  std::size_t most = 0;
  for (const InputInstance& instance : asset.instances) most = std::max(most, instance.targets.size());
  for (const Body& body : asset.bodies.bodies) most = std::max(most, body.targets.size());
  return most;
}

/// \throws Error(kLimit) where reading and welding takes more memory than allowed
void require_memory_for(const InputAsset& asset, const Size& size, const ImportOptions& options) {
  // Offsets and normals, of vertices and then of corners.
  const std::uint64_t of_targets = most_targets(asset) * 6 * sizeof(float) * (size.vertices + 3 * size.triangles);
  require_memory(asset.memory + of_targets + memory_to_import(size.vertices, size.triangles), options.max_memory,
                 asset.file + ": importing " + count_of(static_cast<std::int64_t>(size.triangles), "triangle"));
}

/// Placements of meshes that are placed more than once.
std::int64_t repeated(const InputAsset& asset) {
  std::vector<std::int64_t> times(asset.meshes.size(), 0);
  for (const InputInstance& instance : asset.instances) ++times[instance.mesh];
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

void note_what_is_left_out(InputAsset& asset, ImportReport& report) {
  std::vector<std::string> deviations = asset.deviations.notes(asset.file);
  report.deviations = static_cast<std::int64_t>(deviations.size());
  report.notes.insert(report.notes.begin(), std::move_iterator(deviations.begin()),
                      std::move_iterator(deviations.end()));
  if (report.repeated_instances > 0) report.notes.push_back(words_about_repeats(report));
  for (std::string& note : asset.notes) report.notes.push_back(std::move(note));
  if (report.repaired_attributes > 0) {
    report.notes.push_back(count_of(report.repaired_attributes, "normal, UV, colour or weight") +
                           " replaced that were not finite or out of range");
  }
}

/// Where instances stand, before it is known which of them share their surface.
class Stand {
 public:
  explicit Stand(const InputAsset& asset) : asset_(asset), apart_(apart(asset)) {
    transforms_ = standing_transforms(asset.rig);
    for (std::size_t s = 0; s < asset.rig.skins.size(); ++s) {
      joints_.push_back(standing_joints(asset.rig, s, transforms_));
    }
    const std::vector<M44d> rest = rest_transforms(asset.rig);
    for (std::size_t n = 0; n < rest.size(); ++n) hidden_ += transforms_[n] != rest[n];
  }

  /// Counts all places from here.
  void move_origin(const Vec3d& origin, std::vector<InputInstance>& instances) {
    const auto move = [&](M44d& transform) {
      for (int axis = 0; axis < 3; ++axis) transform[3][axis] -= origin[axis];
    };
    if (origin == Vec3d(0, 0, 0)) return;
    for (M44d& transform : transforms_) move(transform);
    for (auto& joints : joints_) std::for_each(joints.begin(), joints.end(), move);
    for (InputInstance& instance : instances) move(instance.transform);
  }

  SurfaceBuilder::Target of(const InputInstance& instance) const {
    const auto i = static_cast<std::size_t>(&instance - asset_.instances.data());
    if (instance.skin >= 0) return {M44d(), &joints_[instance.skin], apart_[i]};
    const bool is_at_node = instance.mover >= 0 && !instance.is_one_of_many;
    return {is_at_node ? transforms_[instance.mover] : instance.transform, nullptr, apart_[i]};
  }

  const std::vector<M44d>& transforms() const { return transforms_; }
  const std::vector<std::vector<M44d>>& joints() const { return joints_; }

  /// Nodes that stand otherwise than at rest, for there they have no extent.
  std::int64_t hidden() const { return hidden_; }

 private:
  const InputAsset& asset_;
  std::vector<std::int32_t> apart_;        ///< [instance]
  std::vector<M44d> transforms_;           ///< [node of the rig]
  std::vector<std::vector<M44d>> joints_;  ///< [skin of the rig][joint]
  std::int64_t hidden_ = 0;
};

/// Nothing where it is broken, which is noted.
std::optional<Primitive> read_primitive(InputAsset& asset, const Placed& item) {
  try {
    return asset.read(item.instance->mesh, item.primitive);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kUnusableInput) throw;
    asset.deviations.lose(Deviation::kBrokenPrimitive, error.what());
    return std::nullopt;
  }
}

/// The scene's where a primitive can't be read: that is to be told when it is.
Vec3d find_origin(const InputAsset& asset, const Stand& stand) {
  try {
    return local_origin(asset, stand.transforms(), stand.joints());
  } catch (const Error&) {
    return {0, 0, 0};
  }
}

/// \throws Error(kUnusableInput) where nothing could be read, with the reason
void require_triangles(const InputAsset& asset, const SurfaceBuilder& builder) {
  if (builder.triangle_count() > 0) return;
  const std::string& reason = asset.deviations.first_loss();
  throw Error(ExitCode::kUnusableInput,
              reason.empty() ? asset.file + ": its scene has no triangles; export a mesh" : reason);
}

/// Which instances may share their surface with others: those that touch nothing.
std::vector<bool> find_shareable(const InputAsset& asset, const std::vector<std::int32_t>& instance_of,
                                 const SurfaceBuilder& builder, const ImportOptions& options,
                                 const ImportReport& report) {
  std::vector<bool> may_be_shared(asset.instances.size(), false);
  if (options.instances == Instances::kSeparate || report.repeated_instances == 0) return may_be_shared;
  const auto count = static_cast<std::int32_t>(asset.instances.size());
  const std::vector<bool> touches = builder.find_contacts(instance_of, count);
  for (const std::int32_t i : instance_of) may_be_shared[i] = !touches[i];
  return may_be_shared;
}

/// Gives the triangles of each body materials of their own, and takes out of the builder what only places the surface
/// of another instance again. \return the bodies
std::vector<Body> part_bodies(const InputAsset& asset, const std::vector<Placed>& placed, const Stand& stand,
                              const ImportOptions& options, SurfaceBuilder& builder, SurfaceMaterials& materials,
                              ImportReport& report) {
  std::vector<std::int32_t> instance_of;  // [primitive of the builder]
  for (const Placed& item : placed) {
    instance_of.push_back(static_cast<std::int32_t>(item.instance - asset.instances.data()));
  }
  FoundBodies found =
      find_bodies(asset, find_shareable(asset, instance_of, builder, options, report), stand.transforms());
  for (std::size_t p = 0; p < placed.size(); ++p) {
    const std::int32_t i = instance_of[p];
    if (found.is_copy[i]) builder.leave_out(p);
    if (found.body_of[i] < 0) continue;
    builder.set_material(p, materials.of_body(found.body_of[i], primitive_of(asset, placed[p]).material));
  }
  for (const Body& body : found.bodies) report.copies += static_cast<std::int64_t>(body.places.size()) - 1;
  return std::move(found.bodies);
}

/// Joints and weights without a skin; morph targets that no body has.
void leave_out_what_moves_nothing(const InputAsset& asset, const InputInstance& instance, Primitive& primitive) {
  const bool is_skinned = instance.skin >= 0 || asset.bodies.has_skin();
  const auto targets = static_cast<int>(most_targets(asset));
  std::erase_if(primitive.attributes, [&](const AttributeStream& stream) {
    const bool is_target = stream.kind == kMorphOffsets || stream.kind == kMorphNormals;
    return (stream.kind == kInfluences && !is_skinned) || (is_target && stream.set >= targets);
  });
}

}  // namespace

SourceMesh import_asset(const std::filesystem::path& path, const ImportOptions& options, const Progress& progress,
                        ImportReport* result) {
  report(progress, "reading", 0);
  InputAsset asset = open_input(
      path, {.max_memory = options.max_memory, .max_triangles = most_triangles(options), .joints = options.joints});
  ImportReport facts;
  facts.instances = static_cast<std::int64_t>(asset.instances.size());
  facts.repeated_instances = repeated(asset);
  facts.ignored_primitives = asset.ignored_primitives;
  std::vector<Placed> placed = placed_primitives(asset);
  const Size total = total_size(asset, placed, options);
  require_memory_for(asset, total, options);

  Stand stand(asset);
  const Vec3d origin = find_origin(asset, stand);
  stand.move_origin(origin, asset.instances);
  SurfaceBuilder builder;
  builder.reserve(total.vertices, total.triangles);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    report(progress, "reading", static_cast<double>(i) / static_cast<double>(placed.size()));
    const Placed item = placed[i];
    std::optional<Primitive> read = read_primitive(asset, item);
    if (!read) continue;
    leave_out_what_moves_nothing(asset, *item.instance, *read);
    builder.add(std::move(*read), stand.of(*item.instance), place_of(asset, *item.instance, item.primitive));
    placed[kept++] = item;
  }
  placed.resize(kept);
  require_triangles(asset, builder);
  // What is behind it isn't needed any more, and welding needs memory.
  asset.read = nullptr;
  asset.extent = nullptr;

  report(progress, "welding", 0);
  SurfaceMaterials materials(asset);
  std::vector<Body> bodies = part_bodies(asset, placed, stand, options, builder, materials, facts);
  WeldedSurface surface = builder.finish(materials.names());
  facts.dropped_triangles = surface.dropped_triangles;
  if (facts.dropped_triangles > 0) {
    facts.repairs.add(RepairKind::kDegenerateTriangles, facts.dropped_triangles, surface.dropped_at);
  }
  facts.repaired_attributes = surface.repaired_attributes;
  if (const std::int64_t hidden = stand.hidden(); hidden > 0) {
    facts.notes.push_back(count_of(hidden, "node") + (hidden == 1 ? " has" : " have") +
                          " no extent at rest; what hangs there is taken as if nothing were scaled away");
  }
  note_what_is_left_out(asset, facts);
  if (surface.mesh.triangles.empty()) {
    throw Error(ExitCode::kUnusableInput, asset.file + ": all of its " + count_of(facts.dropped_triangles, "triangle") +
                                              " have coinciding corners");
  }
  facts.was_repaired = asset.is_repaired;
  surface.mesh.translation = origin;
  surface.mesh.scene_name = asset.scene_name;
  surface.mesh.origin = asset.origin;
  surface.mesh.generator = asset.generator;
  materials.describe(asset, std::move(bodies), surface.mesh);
  // Files of other people say of each primitive whether it is skinned; ours of the whole.
  if (lacks_influences(surface.mesh)) {
    throw Error(ExitCode::kUnusableInput, asset.file + ": a skin's vertices have no joints; make it again");
  }
  report(progress, "welding", 1);
  if (result != nullptr) *result = std::move(facts);
  return std::move(surface.mesh);
}

}  // namespace lozenge
