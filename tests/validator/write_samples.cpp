// write_samples FOLDER: exports small assets of every kind, for Khronos' validator.

#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "formats/domain/sphere_fixtures.h"
#include "pipeline/unwrap/unwrap.h"
#include "stages/bake/bake.h"
#include "stages/export/export.h"
#include "stages/export/export_fixtures.h"
#include "stages/pack/pack.h"
#include "stages/sample/sample.h"

namespace lozenge {
namespace {

/// A bumpy sphere of known map, through every stage after the parameterization.
void write_whole_chain(const std::filesystem::path& file) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 16);
  for (Vec3f& p : mesh.positions) p *= 1 + 0.05F * std::sin(9 * p.x) * std::sin(9 * p.y + 1) * std::sin(9 * p.z + 2);
  const GeometryImage image = pack(sample(mesh, map, {.samples = 9}));
  BakeOptions options;
  options.size = 512;
  options.occlusion_rays = 8;
  const BakedMaps maps = bake(mesh, map, image, options);
  export_asset(file, image, maps);
  const SourceSurface source{&mesh, &map};
  export_asset(file.parent_path() / "source_level.glb", image, maps, {.finest = Finest::kSource}, &source);
}

/// Assets with texture coordinates of their own already, and with none.
void write_unwrapped(const std::filesystem::path& folder) {
  UnwrapOptions options;
  options.uv_set = 1;
  unwrap(folder / "whole_chain.glb", folder / "second_set.glb", options);
  options.uv_set = 0;
  options.pack_each = true;
  unwrap(folder / "without_maps.glb", folder / "replaced_set.glb", options);
}

void write_samples(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const GeometryImage ball = export_fixtures::octahedron(17);
  const BakedMaps maps = export_fixtures::maps(ball, 256, 0);
  export_asset(folder / "levels_and_maps.glb", ball, maps);
  export_asset(folder / "without_maps.glb", ball, {});
  export_asset(folder / "deep_normals.glb", ball, maps, {.textures = {.normal_bits = 16}});
  export_asset(folder / "jpeg.glb", ball, maps, {.textures = {.format = TextureFormat::kJpeg}});
  export_asset(folder / "webp.glb", ball, maps, {.textures = {.format = TextureFormat::kWebp, .quality = 75}});
  export_asset(folder / "one_level.glb", ball, maps, {.coarser_levels = false});
  export_asset(folder / "coarsest.glb", ball, maps, {.samples = 2});
  export_asset(folder / "separate.glb", ball, maps, {.separate_files = true});
  export_asset(folder / "siblings.glb", ball, maps, {.lods_as = LodsAs::kNodes});
  export_asset(folder / "quantized.glb", ball, maps, {.vertex_format = VertexFormat::kQuantized});
  export_asset(folder / "compressed.glb", ball, maps,
               {.vertex_format = VertexFormat::kQuantized, .compression = Compression::kMeshopt});
  export_asset(folder / "wide_indices.glb", export_fixtures::octahedron(129), {});
  const GeometryImage two = export_fixtures::two_spheres(9);
  export_asset(folder / "two_components.glb", two, export_fixtures::maps(two, 256, 0));
  export_asset(folder / "open.glb", export_fixtures::open_octahedron(9), {});
  write_whole_chain(folder / "whole_chain.glb");
  write_unwrapped(folder);
  GeometryImage nameless = ball;
  nameless.layout.scene_name.clear();
  nameless.layout.origin.clear();
  export_asset(folder / "nameless.glb", nameless, maps);
}

}  // namespace
}  // namespace lozenge

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_samples FOLDER\n";
    return 2;
  }
  try {
    lozenge::write_samples(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "write_samples: " << error.what() << '\n';
    return 1;
  }
}
