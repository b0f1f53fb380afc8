// lozenge render: a picture of any file, without a display.
#include "stages/render/render.h"

#include <fmt/format.h>

#include "formats/files/asset_places.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/file_kind.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "stages/import/import.h"
#include "stages/render/plot.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/pose_options.h"
#include "tools/surface_file.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  the surface in clay\n"
    "    lozenge render statue.gltf -o statue.png\n"
    "  the domain's triangles on the surface, and where the map shrinks (blue) or expands (red) areas\n"
    "    lozenge render statue.map.glb -o domain.png --style patches\n"
    "    lozenge render statue.map.glb -o distortion.png --style distortion\n"
    "  the mesh of a level of detail, and what an engine shows of it\n"
    "    lozenge render out/statue.gim.exr -o wires.png --style wires --level 1\n"
    "    lozenge render out/statue.glb -o statue.png --style baked\n"
    "    lozenge render out/statue.gim.exr -o statue.png --style baked --map out/statue.normal.png\n"
    "  a character as it stands half a second into its third animation\n"
    "    lozenge render out/hero.glb -o hero.png --style baked --time 0.5 --animation 2\n"
    "  how distortion went while the domain shrank\n"
    "    lozenge render trace.json -o trace.png --style trace";

enum class Style { kShaded, kWires, kPatches, kDistortion, kBaked, kTrace };

struct Arguments {
  std::string input;
  std::string output;
  Style style = Style::kShaded;
  int level = 0;
  std::vector<std::string> maps;
  std::optional<std::array<float, 3>> direction;
  PoseArguments pose;
  RenderOptions options;
};

[[noreturn]] void refuse(const Arguments& arguments, std::string_view what) {
  throw Error(ExitCode::kUsage, fmt::format("{}: is a {}; this style needs another file, see the examples in --help",
                                            file_name(arguments.input), what));
}

Picture picture_of_map(const Arguments& arguments) {
  const auto [mesh, map] = read_parameterization(arguments.input);
  switch (arguments.style) {
    case Style::kPatches:
      return render_patches(mesh, map, arguments.options);
    case Style::kDistortion:
      return render_distortion(mesh, map, arguments.options);
    default:
      refuse(arguments, name_of(FileKind::kParameterization));
  }
}

BakedMaps read_maps(const std::vector<std::string>& files, int level) {
  BakedMaps maps;
  maps.level = level;
  for (const std::string& file : files) maps.maps.push_back(read_map(file));
  return maps;
}

/// Any file's surface, bodies in all of their places; the shape alone looks the same whatever else it holds.
Picture picture_of_surface(const Arguments& arguments) {
  const Surface surface = read_surface(arguments.input, arguments.level, arguments.pose.pose());
  return render_surface(surface.view(), arguments.style == Style::kWires, arguments.options);
}

Picture picture_of_image(const Arguments& arguments) {
  const GeometryImage image = read_geometry_image(arguments.input);
  require_level(arguments.input, arguments.level, image.levels.size());
  const bool shape_alone = arguments.style == Style::kShaded || arguments.style == Style::kWires;
  if (shape_alone && !image.layout.bodies.empty()) return picture_of_surface(arguments);
  switch (arguments.style) {
    case Style::kShaded:
      return render_shaded(image, arguments.level, arguments.options);
    case Style::kWires:
      return render_wires(image, arguments.level, arguments.options);
    case Style::kPatches:
      return render_patches(image, arguments.level, arguments.options);
    case Style::kBaked:
      return render_baked(image, arguments.level, read_maps(arguments.maps, arguments.level), arguments.options);
    default:
      refuse(arguments, name_of(FileKind::kGeometryImage));
  }
}

Picture picture_of_asset(const Arguments& arguments) {
  if (arguments.style != Style::kBaked) refuse(arguments, name_of(FileKind::kAsset));
  Asset asset = posed_or_not(read_asset(arguments.input), arguments.pose.pose(), arguments.input);
  require_level(arguments.input, arguments.level, asset.levels.size());
  asset.levels[arguments.level] = with_copies(asset.levels[arguments.level]);
  return render_baked(asset, arguments.level, arguments.options);
}

/// Shaded by the asset's own normals, but where a file of ours places meshes again and again.
Picture picture_of_import(const Arguments& arguments) {
  const SourceMesh mesh =
      posed_or_not(import_asset(arguments.input, {.instances = Instances::kSeparate}), arguments.pose.pose());
  if (!mesh.bodies.empty()) return picture_of_surface(arguments);
  return render_shaded(mesh, arguments.options);
}

Picture make_picture(const Arguments& arguments) {
  const bool shows_poses =
      arguments.style == Style::kShaded || arguments.style == Style::kWires || arguments.style == Style::kBaked;
  if (arguments.pose.time && !shows_poses) {
    throw Error(ExitCode::kUsage, "--time: this style shows what stands at rest; take shaded, wires or baked");
  }
  if (arguments.style == Style::kTrace) return render_trace(arguments.input);
  if (std::filesystem::path(arguments.input).extension() == ".gltf" && arguments.style == Style::kShaded) {
    return picture_of_import(arguments);
  }
  const FileKind kind = recognise_file(arguments.input);
  if (kind == FileKind::kGeometryImage) return picture_of_image(arguments);
  if (arguments.style == Style::kWires || (arguments.style == Style::kShaded && kind == FileKind::kAsset)) {
    return picture_of_surface(arguments);
  }
  if (arguments.style == Style::kShaded &&
      (kind == FileKind::kSourceMesh || kind == FileKind::kForeignMesh || kind == FileKind::kParameterization)) {
    return picture_of_import(arguments);
  }
  if (kind == FileKind::kParameterization) return picture_of_map(arguments);
  if (kind == FileKind::kAsset) return picture_of_asset(arguments);
  refuse(arguments, name_of(kind));
}

ExitCode run(const Arguments& given, Console& console) {
  Arguments arguments = given;
  if (arguments.direction) {
    const auto [x, y, z] = *arguments.direction;
    const Vec3f direction{x, y, z};
    if (!(direction.length() > 0)) throw Error(ExitCode::kUsage, "--from: has no length; give a direction like 0 0 1");
    arguments.options.direction = direction;
  }
  require_writable(arguments.output);
  const Picture picture = make_picture(arguments);
  write_picture(arguments.output, picture);
  console.print({fmt::format("picture     {} x {} pixels", picture.width, picture.height)},
                fmt::format("{{\n  \"width\": {},\n  \"height\": {}\n}}", picture.width, picture.height));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  const Words<Style> styles = {{"shaded", Style::kShaded},   {"wires", Style::kWires},
                               {"patches", Style::kPatches}, {"distortion", Style::kDistortion},
                               {"baked", Style::kBaked},     {"trace", Style::kTrace}};
  options.input("file", arguments.input, "Any asset (glTF, PLY, OBJ, STL, OFF), and any file that Lozenge wrote");
  options.output(arguments.output, "The picture, a .png");
  options.group("What to show");
  options.choice("--style NAME", arguments.style, styles,
                 "shaded, wires, patches, distortion, baked or trace [shaded]");
  options.number("--level L", arguments.level, {0}, "Level of detail; 0 is the finest").shows_default();
  options.texts("--map FILE", arguments.maps, "Baked maps to show on a geometry image");
  declare_pose(options, arguments.pose);
  options.group("The picture");
  options.direction("--from X Y Z", arguments.direction, "Direction towards the camera; y is up");
  options.number("--width N", arguments.options.width, {16, 16384}, "In pixels").shows_default();
  options.number("--height N", arguments.options.height, {16, 16384}, "In pixels").shows_default();
}

}  // namespace

Command render_command() {
  return make_command<Arguments>({"render", "Draw a picture of a file", kLookGroup, kExamples}, declare, run);
}

}  // namespace lozenge
