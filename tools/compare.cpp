// lozenge compare: how far two surfaces are apart.
#include "stages/compare/compare.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "formats/files/asset_places.h"
#include "formats/files/texture_files.h"
#include "pipeline/quality/compare_materials.h"
#include "stages/import/import.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/pose_options.h"
#include "tools/surface_file.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  how far an asset is from its source, in percent of the source's box diagonal\n"
    "    lozenge compare statue.glb out/statue.glb\n"
    "  a coarser level of detail\n"
    "    lozenge compare statue.glb out/statue.gim.exr --level 2\n"
    "  the normals too, as an engine computes them from the asset's normal map\n"
    "    lozenge compare statue.glb out/statue.glb --normals\n"
    "  how far materials and textures are from the source's\n"
    "    lozenge compare helmet.glb out/helmet.glb --materials\n"
    "  both as they stand half a second into an animation\n"
    "    lozenge compare hero.glb out/hero.glb --time 0.5 --animation 2";

struct Arguments {
  std::string a;
  std::string b;
  int level = 0;
  bool normals = false;
  bool materials = false;
  PoseArguments pose;
  CompareOptions options;
};

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Appends the angles to a comparison's lines and JSON.
void add_normals(const Arguments& arguments, Console& console, std::vector<std::string>& lines, std::string& json) {
  Asset asset = posed_or_not(read_asset(arguments.b), arguments.pose.pose(), arguments.b);
  require_level(arguments.b, arguments.level, asset.levels.size());
  asset.levels[arguments.level] = at_rest(asset.levels[arguments.level]);
  const SourceMesh source = posed_or_not(import_asset(arguments.a, {}, console.progress()), arguments.pose.pose());
  count_from(source.translation, asset.translation, asset.levels[arguments.level].positions);
  const NormalComparison n = compare_normals(asset, arguments.level, source, arguments.options, console.progress());
  lines.push_back(fmt::format("normals     {:.2f} degrees mean, {:.2f} for 95 %, {:.2f} largest", degrees(n.mean),
                              degrees(n.percentile_95), degrees(n.max)));
  auto object = nlohmann::ordered_json::parse(json);
  object["normals"] = {{"mean_degrees", degrees(n.mean)},
                       {"percentile_95_degrees", degrees(n.percentile_95)},
                       {"max_degrees", degrees(n.max)},
                       {"points", n.points}};
  json = object.dump(2);
}

/// An asset with its pictures.
struct Textured {
  SourceMesh mesh;
  std::unique_ptr<TextureFiles> textures;
};

Textured read_textured(const std::string& file, Console& console) {
  Textured asset{import_asset(file, {}, console.progress()), nullptr};
  asset.textures = std::make_unique<TextureFiles>(asset.mesh, kTextureRoles, TextureLimits{}, console.progress());
  for (const std::string& note : asset.textures->notes()) console.note(file, note);
  return asset;
}

/// Appends the differences of looks.
void add_materials(const Arguments& arguments, Console& console, std::vector<std::string>& lines, std::string& json) {
  const Textured a = read_textured(arguments.a, console);
  const Textured b = read_textured(arguments.b, console);
  const MaterialComparison comparison = compare_materials({&a.mesh, a.textures.get()}, {&b.mesh, b.textures.get()},
                                                          arguments.options.points, console.progress());
  for (std::string& line : material_lines(comparison)) lines.push_back(std::move(line));
  auto object = nlohmann::ordered_json::parse(json);
  object["materials"] = nlohmann::ordered_json::parse(material_json(comparison));
  json = object.dump(2);
}

ExitCode run(const Arguments& arguments, Console& console) {
  const Surface a = read_surface(arguments.a, 0, arguments.pose.pose());
  Surface b = read_surface(arguments.b, arguments.level, arguments.pose.pose());
  count_from(a.translation, b.translation, b.positions);
  const Comparison comparison = compare(a.view(), b.view(), arguments.options, console.progress());
  std::vector<std::string> lines = comparison_lines(comparison);
  std::string json = comparison_json(comparison);
  if (arguments.normals) add_normals(arguments, console, lines, json);
  if (arguments.materials) add_materials(arguments, console, lines, json);
  console.print(lines, json);
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("a", arguments.a, "The reference: any asset (glTF, PLY, OBJ, STL, OFF), or a geometry image");
  options.input("b", arguments.b, "What is compared with it");
  options.group("What to measure");
  options.number("--level L", arguments.level, {0}, "Level of detail of the second file; 0 is the finest")
      .shows_default();
  options.number("--points N", arguments.options.points, {1, 1'000'000'000}, "Points spread over each surface")
      .shows_default();
  options.flag(
      "--materials", arguments.materials,
      "Base colours (CIEDE2000), alpha, occlusion, roughness, metal and emission too; both files are assets, and "
      "of the second its finest level counts");
  options.flag("--normals", arguments.normals, "Angles between normals too; the second file is an asset");
  declare_pose(options, arguments.pose);
}

}  // namespace

Command compare_command() {
  return make_command<Arguments>(
      {"compare", "Measure how far two surfaces are apart, both ways", kLookGroup, kExamples}, declare, run);
}

}  // namespace lozenge
