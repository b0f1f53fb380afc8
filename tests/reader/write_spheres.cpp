// Writes geometry images for the reader in the other language: spheres over three domains, one with the cap of a hole,
// surfaces with a boundary, and parts of two scales, on several grids.
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/geometry_image_file.h"
#include "stages/pack/pack.h"
#include "stages/sample/sample.h"

namespace {

using namespace lozenge;

/// As if the asset placed the ball beside the half one twice more.
void repeat_closed_part(fixtures::OpenSurface& two) {
  two.mesh.material_names = {"stone", "ball"};
  for (const auto& triangle : two.mesh.triangles) {
    two.mesh.materials.push_back(two.map.phi[triangle[0]].triangle >= 4 ? 1 : 0);
  }
  two.mesh.bodies = {{{"ball", {{}, {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0.1, 7, 0, 1}, -1}}, -1}}, {-1, 0}};
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_spheres FOLDER\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  const std::vector<std::pair<std::string, Domain>> domains{{"tetrahedron", fixtures::tetrahedron()},
                                                            {"octahedron", fixtures::octahedron()},
                                                            {"icosahedron", fixtures::icosahedron()}};
  for (const auto& [name, domain] : domains) {
    for (const int samples : {2, 17}) {
      auto [mesh, map] = fixtures::subdivided_sphere(domain, 10);
      fixtures::jitter(map, 0.02, 1);
      const auto file = folder / (name + "_" + std::to_string(samples) + ".gim.exr");
      write_geometry_image(file, pack(sample(mesh, map, {samples})));
    }
  }
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 10);
  mesh.material_names = {"stone", "cap of stone"};
  mesh.cap_of = {-1, 0};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.materials.back() = 1;
  write_geometry_image(folder / "capped_17.gim.exr", pack(sample(mesh, map, {17})));
  fixtures::OpenSurface two = fixtures::open_and_closed(5);
  repeat_closed_part(two);
  for (const auto& open : {fixtures::triangle(5), fixtures::hemisphere(5), fixtures::fan(4, 5),
                           fixtures::annulus(5, 17, 4, 0.375), two, fixtures::two_scales(5)}) {
    for (const int samples : {2, 17}) {
      const std::string name = open.name.substr(0, open.name.find("_5_17")) + "_" + std::to_string(samples);
      write_geometry_image(folder / (name + ".gim.exr"), pack(sample(open.mesh, open.map, {samples})));
    }
  }
}
