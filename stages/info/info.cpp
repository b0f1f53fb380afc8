#include "stages/info/info.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/domain/distortion.h"
#include "formats/files/asset_file.h"
#include "formats/files/asset_places.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/file_kind.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/map_mips_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/picture_file.h"
#include "formats/files/source_mesh_file.h"
#include "formats/patches/level_mesh.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/info/describe_gltf.h"
#include "stages/info/describe_input.h"
#include "stages/info/describe_rig.h"
#include "stages/info/facts.h"

namespace lozenge {

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

Json json_of(const Vec3f& v) { return Json::array({v.x, v.y, v.z}); }

void add_names(Facts& facts, const std::string& scene, const std::string& origin) {
  facts.add("scene", scene, fmt::format("scene        {}", scene));
  facts.add("origin", origin, fmt::format("made from    {}", origin));
}

void add_bounds(Facts& facts, const Bounds& box) {
  const Vec3f size = box.high - box.low;
  facts.add(
      "bounds", {{"low", json_of(box.low)}, {"high", json_of(box.high)}, {"diagonal", diagonal(box)}},
      fmt::format("size         {:.6g} x {:.6g} x {:.6g}, diagonal {:.6g}", size.x, size.y, size.z, diagonal(box)));
}

Json json_of(const Spread& s) {
  return {{"mean", s.mean}, {"sigma_percent", s.sigma}, {"min_percent", s.min}, {"max_percent", s.max}};
}

std::string line_of(const char* what, const Spread& s) {
  return fmt::format("  {:9}  sigma {:.2f} %, min {:.2f} %, max {:.2f} % of the mean {:.6g}", what, s.sigma, s.min,
                     s.max, s.mean);
}

Json json_of(const MeshStatistics& s) {
  return {{"vertices", s.vertices},
          {"triangles", s.triangles},
          {"components", s.components},
          {"euler", s.euler},
          {"closed_manifold", is_closed_manifold(s)},
          {"manifold", is_manifold(s)},
          {"boundary_loops", s.boundary_loops},
          {"boundary_edges", s.boundary_edges},
          {"irregular_vertices", s.irregular_vertices},
          {"irregular_percent", s.irregular_percent},
          {"area", json_of(s.area)},
          {"edge", json_of(s.edge)},
          {"min_angle_degrees", s.min_angle * kDegrees},
          {"mean_min_angle_degrees", s.mean_min_angle * kDegrees}};
}

void add_statistics(Facts& facts, const std::string& key, const std::string& title, const SurfaceView& surface) {
  const MeshStatistics s = mesh_statistics(surface);
  const std::string topology = is_closed_manifold(s) ? fmt::format("closed, Euler characteristic {}", s.euler)
                               : is_manifold(s)
                                   ? fmt::format("open, {} boundary loop(s) of {} edges, Euler characteristic {}",
                                                 s.boundary_loops, s.boundary_edges, s.euler)
                                   : fmt::format("{} boundary edges, {} tangled edges, {} pinched vertices",
                                                 s.boundary_edges, s.tangled_edges, s.pinched_vertices);
  facts.add(key, json_of(s),
            fmt::format("{:12} {} triangles, {} vertices, {} component(s), {}", title, s.triangles, s.vertices,
                        s.components, topology));
  facts.line(line_of("areas", s.area));
  facts.line(line_of("edges", s.edge));
  facts.line(fmt::format("  {:9}  min {:.2f}, mean of the smallest {:.2f} degrees", "angles", s.min_angle * kDegrees,
                         s.mean_min_angle * kDegrees));
  facts.line(fmt::format("  {:9}  {} vertices, {:.2f} %", "irregular", s.irregular_vertices, s.irregular_percent));
}

void add_mesh(Facts& facts, const SourceMesh& mesh) {
  add_names(facts, mesh.scene_name, mesh.origin);
  add_bounds(facts, bounds_of(mesh.positions));
  std::vector<std::string> attributes;
  for (const AttributeStream& stream : mesh.corner_attributes) attributes.push_back(label_of(stream));
  facts.add(
      "attributes", attributes,
      fmt::format("attributes   {}", attributes.empty() ? "none" : fmt::format("{}", fmt::join(attributes, ", "))));
  facts.add("materials", mesh.material_names, fmt::format("materials    {}", mesh.material_names.size()));
  std::int64_t caps = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) caps += is_cap(mesh, static_cast<TriangleId>(t));
  facts.add("cap_triangles", caps, caps == 0 ? "" : fmt::format("caps         {} triangles close holes", caps));
  add_statistics(facts, "mesh", "mesh", {mesh.positions, mesh.triangles});
}

FileInfo describe_source_mesh(const std::filesystem::path& path) {
  if (!is_source_mesh_file(path)) return describe_gltf(path);
  Facts facts(name_of(FileKind::kSourceMesh));
  const SourceMesh mesh = read_source_mesh(path);
  add_mesh(facts, mesh);
  add_bodies(facts, mesh.bodies);
  add_rig(facts, mesh.rig);
  return facts.take();
}

FileInfo describe_parameterization(const std::filesystem::path& path) {
  Facts facts(name_of(FileKind::kParameterization));
  const auto [mesh, map] = read_parameterization(path);
  add_mesh(facts, mesh);
  add_bodies(facts, mesh.bodies);
  add_rig(facts, mesh.rig);
  const std::int32_t irregular = count_irregular(map.domain);
  facts.add("domain",
            {{"triangles", map.domain.size()},
             {"vertices", map.domain.vertex_count},
             {"irregular_vertices", irregular},
             {"euler", euler_characteristic(map.domain)},
             {"parts_by_first_level", parts_by_first_level(map)}},
            fmt::format("domain       {} triangles, {} vertices, {} of them irregular", map.domain.size(),
                        map.domain.vertex_count, irregular));
  const Distortion d = measure_distortion(mesh, map);
  facts.add("distortion",
            {{"area", d.area},
             {"angle", d.angle},
             {"aggregate", d.aggregate},
             {"l2_stretch", d.l2_stretch},
             {"folded_triangles", d.folded_triangles},
             {"area_sum_error", d.area_sum_error}},
            fmt::format("distortion   area {:.5f}, angle {:.5f}, aggregate {:.5f}, L2 stretch {:.5f}", d.area, d.angle,
                        d.aggregate, d.l2_stretch));
  facts.line(fmt::format("folded       {} triangles, image areas off by {:.3g}", d.folded_triangles, d.area_sum_error));
  return facts.take();
}

/// What to say about a surface's boundary; nothing where it is closed.
std::string half_patches(const std::vector<PatchPlace>& places) {
  const auto count = std::count_if(places.begin(), places.end(), [](const PatchPlace& p) { return !p.right.exists(); });
  return count > 0 ? fmt::format(", {} of them halves on the boundary", count) : "";
}

/// How many samples lie on caps of holes.
void add_caps(Facts& facts, const std::vector<std::uint32_t>& caps) {
  const auto count = std::count(caps.begin(), caps.end(), 1U);
  facts.add("cap_samples", count, count == 0 ? "" : fmt::format("caps         {} samples close holes", count));
}

/// How many patches begin on which level of detail.
void add_scales(Facts& facts, const PatchLayout& layout) {
  Json counts = Json::array();
  std::string line;
  for (std::int32_t k = 0, before = 0; before < layout.size(); ++k) {
    const std::int32_t count = layout.count_on(k) - before;
    before += count;
    counts.push_back(count);
    if (count > 0) line += fmt::format("{}{} from level {} on", line.empty() ? "" : ", ", count, k);
  }
  facts.add("patches_by_first_level", counts, counts.size() == 1 ? "" : "scales       " + line);
}

FileInfo describe_patch_set(const std::filesystem::path& path) {
  Facts facts(name_of(FileKind::kPatchSet));
  const PatchSet patches = read_patch_set(path);
  add_names(facts, patches.layout.scene_name, patches.layout.origin);
  add_bounds(facts, patches.layout.bounds);
  facts.add("patches", {{"count", patches.size()}, {"samples", patches.layout.samples}},
            fmt::format("patches      {} of {} x {} samples{}", patches.size(), patches.layout.samples,
                        patches.layout.samples, half_patches(patches.layout.places)));
  add_scales(facts, patches.layout);
  add_bodies(facts, patches.layout.bodies);
  add_caps(facts, patches.caps);
  const LevelMesh mesh = patch_mesh(patches);
  add_statistics(facts, "mesh", "mesh", mesh.view());
  return facts.take();
}

FileInfo describe_geometry_image(const std::filesystem::path& path, FileKind kind) {
  Facts facts(name_of(kind));
  const GeometryImage image = read_geometry_image(path);
  add_names(facts, image.layout.scene_name, image.layout.origin);
  add_bounds(facts, image.layout.bounds);
  facts.add("patches",
            {{"count", image.size()},
             {"samples", image.layout.samples},
             {"levels", image.levels.size()},
             {"columns", image.columns},
             {"rows", image.rows_on(0)}},
            fmt::format("patches      {} of {} x {} samples, in {} x {} tiles{}", image.size(), image.layout.samples,
                        image.layout.samples, image.columns, image.rows_on(0), half_patches(image.layout.places)));
  add_scales(facts, image.layout);
  add_bodies(facts, image.layout.bodies);
  add_caps(facts, image.levels.front().caps);
  Json levels = Json::array();
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const LevelMesh mesh = level_mesh(image, static_cast<int>(l));
    levels.push_back({{"samples", image.levels[l].samples},
                      {"triangles", mesh.triangles.size()},
                      {"vertices", mesh.positions.size()}});
    facts.line(fmt::format("level {}      {} samples a side, {} triangles, {} vertices", l, image.levels[l].samples,
                           mesh.triangles.size(), mesh.positions.size()));
  }
  facts.add("levels", levels, "");
  const LevelMesh finest = level_mesh(image, 0);
  add_statistics(facts, "mesh", "level 0", finest.view());
  return facts.take();
}

std::string kinds_of_textures(const Asset& asset) {
  std::vector<std::string> sizes;
  for (const AssetTexture& t : asset.textures) {
    sizes.push_back(fmt::format("{} {} x {}, {} x {} bits", t.name, t.width, t.height, t.channels, t.bits));
  }
  return sizes.empty() ? "none" : fmt::format("{}", fmt::join(sizes, "; "));
}

/// The parts of its finest level that something moves.
Bodies bodies_of(const Asset& asset) {
  Bodies bodies;
  if (asset.levels.empty()) return bodies;
  for (const AssetPart& part : asset.levels.front().parts) {
    Body body{part.name, {}, part.skin, part.targets};
    for (std::size_t p = 0; p < part.places.size(); ++p) body.places.push_back({part.places[p], part.nodes[p]});
    const bool is_still = part.skin < 0 && part.nodes == std::vector<std::int32_t>{-1};
    if (!is_still) bodies.bodies.push_back(std::move(body));
  }
  return bodies;
}

FileInfo describe_asset(const std::filesystem::path& path) {
  Facts facts(name_of(FileKind::kAsset));
  const Asset asset = read_asset(path);
  facts.add("scene", asset.scene_name, fmt::format("scene        {}", asset.scene_name));
  facts.add("generator", asset.generator, fmt::format("generator    {}", asset.generator));
  if (!asset.levels.empty()) add_bounds(facts, bounds_of(at_rest(asset.levels.front()).positions));
  Json levels = Json::array();
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    levels.push_back(
        {{"name", level.name}, {"triangles", level.triangles.size()}, {"vertices", level.positions.size()}});
    facts.line(
        fmt::format("level {}      {} triangles, {} vertices", l, level.triangles.size(), level.positions.size()));
  }
  facts.add("levels", levels, "");
  std::size_t copies = 0;
  if (!asset.levels.empty()) {
    for (const AssetPart& part : asset.levels.front().parts) copies += part.places.size() - 1;
  }
  facts.add("copies", copies,
            copies == 0 ? "" : fmt::format("copies       {} more places that show parts of it again", copies));
  add_bodies(facts, bodies_of(asset));
  add_rig(facts, asset.rig);
  facts.add("cap_triangles_left_out", asset.cap_triangles,
            asset.cap_triangles == 0 ? "" : fmt::format("caps         {} triangles left out", asset.cap_triangles));
  Json textures = Json::array();
  for (const AssetTexture& t : asset.textures) {
    textures.push_back(
        {{"name", t.name}, {"width", t.width}, {"height", t.height}, {"channels", t.channels}, {"bits", t.bits}});
  }
  facts.add("textures", textures, fmt::format("textures     {}", kinds_of_textures(asset)));
  return facts.take();
}

FileInfo describe_map(const BakedMap& map, FileKind kind) {
  Facts facts(name_of(kind));
  const MapLayout& l = map.layout;
  facts.add("map", traits_of(map.kind).name, fmt::format("map          {}", traits_of(map.kind).name));
  facts.add("width", map.width(),
            fmt::format("size         {} x {} texels of {} channels", map.width(), map.height(), map.channels));
  facts.add("height", map.height(), "");
  facts.add("channels", map.channels, "");
  facts.add("layout",
            {{"columns", l.columns},
             {"rows", l.rows()},
             {"tile", l.tile},
             {"tiles_by_first_level", l.counts},
             {"gutter", l.gutter},
             {"shrink", map.shrink}},
            fmt::format("layout       {} tiles of {} to {} texels, gutter {}{}", l.patches(), l.smallest_tile(), l.tile,
                        l.gutter, l.order.is_given() ? ", ordered by what they show" : ""));
  if (l.order.is_given()) facts.add("tile_of_patch", l.order.tiles(), "");
  facts.add("level", map.level, fmt::format("baked for    level {}", map.level));
  if (kind == FileKind::kMapKtx2) facts.add("mips", mip_count(map), fmt::format("mips         {}", mip_count(map)));
  return facts.take();
}

FileInfo describe_picture(const std::filesystem::path& path) {
  const PictureFacts picture = read_picture_facts(path);
  Facts facts(name_of(FileKind::kPicture));
  facts.add("width", picture.width, fmt::format("size         {} x {} pixels", picture.width, picture.height));
  facts.add("height", picture.height, "");
  return facts.take();
}

FileInfo describe_kind(const std::filesystem::path& path, FileKind kind) {
  switch (kind) {
    case FileKind::kSourceMesh:
      return describe_source_mesh(path);
    case FileKind::kParameterization:
      return describe_parameterization(path);
    case FileKind::kAsset:
      return describe_asset(path);
    case FileKind::kPatchSet:
      return describe_patch_set(path);
    case FileKind::kGeometryImage:
      return describe_geometry_image(path, kind);
    case FileKind::kGeometryImageJson:
      return describe_geometry_image(std::filesystem::path(path).replace_extension(".exr"), kind);
    case FileKind::kMapPng:
    case FileKind::kMapExr:
      return describe_map(read_map(path), kind);
    case FileKind::kMapKtx2:
      return describe_map(read_map_mips(path).map, kind);
    case FileKind::kForeignMesh:
      return describe_input(path);
    case FileKind::kPicture:
      return describe_picture(path);
  }
  throw Error(ExitCode::kInternal, path.string() + ": is of a kind that nobody describes");
}

bool is_gltf(FileKind kind) {
  return kind == FileKind::kSourceMesh || kind == FileKind::kParameterization || kind == FileKind::kAsset;
}

}  // namespace

FileInfo describe_file(const std::filesystem::path& path) {
  const FileKind kind = recognise_file(path);
  try {
    return describe_kind(path, kind);
  } catch (const Error& error) {
    const bool of_the_file = error.code() == ExitCode::kUnusableInput || error.code() == ExitCode::kUnsupported;
    if (!of_the_file || !is_gltf(kind)) throw;
    // Another tool packed it anew, or changed it: no longer what we wrote, but a glTF all the same.
    return describe_gltf(path, error.what());
  }
}

}  // namespace lozenge
