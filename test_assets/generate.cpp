// generate FOLDER: writes every test asset, and assets.json, which says what each must give.

#include <exception>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "test_assets/assets.h"
#include "test_assets/documents.h"

namespace lozenge::test_assets {
namespace {

using nlohmann::ordered_json;

ordered_json described(const Asset& asset) {
  ordered_json repairs = ordered_json::object();
  for (const ExpectedRepair& repair : asset.repairs) {
    if (repair.count > 0) repairs[std::string(repair.key)] = repair.count;
  }
  return {{"file", asset.file},
          {"triangles", asset.triangles},
          {"components", asset.components},
          {"euler", asset.euler},
          {"boundary_loops", asset.boundary_loops},
          {"genus", asset.components - (asset.euler + asset.boundary_loops) / 2},
          {"repairs", repairs},
          {"about", asset.about}};
}

std::string description() {
  ordered_json root;
  for (const Asset& asset : kAssets) root["assets"].push_back(described(asset));
  root["showpiece"] = described(kShowpiece);
  for (const Asset& asset : kRepairedAssets) root["repaired"].push_back(described(asset));
  for (const Asset& asset : kOpenAssets) root["open"].push_back(described(asset));
  for (const BadAsset& asset : kBadAssets) {
    root["bad"].push_back(
        {{"file", asset.file}, {"exit_code", asset.exit_code}, {"word", asset.word}, {"about", asset.about}});
  }
  return root.dump(2) + "\n";
}

void generate(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_glb(folder / "sphere.glb", simple_document("Sphere", icosphere(4), false));
  write_glb(folder / "bumpy_sphere.glb", simple_document("Bumpy sphere", bumpy_sphere(), true));
  write_glb(folder / "torus.glb", simple_document("Torus", torus(1, 0.4, 96, 40), true));
  write_glb(folder / "genus3.glb", simple_document("Three rings", genus3(), false));
  write_glb(folder / "knot.glb", simple_document("Knot", knot(), true));
  write_glb(folder / "far.glb", far_document());
  write_glb(folder / "two_components.glb", two_components_document());
  write_glb(folder / "rings.glb", rings_document());
  write_glb(folder / "worm.glb", worm_document());
  write_glb(folder / "cart.glb", cart_document());
  write_glb(folder / "face.glb", face_document());
  write_glb(folder / "packed_worms.glb", packed_worms_document());
  write_glb(folder / "uneven.glb", simple_document("Turned part", uneven(), false));
  write_glb(folder / "seams.glb", seams_document());
  write_gltf(folder / "seams.gltf", seams_document());
  write_bytes(folder / "coated.glb", glb_bytes(coated()));
  write_bytes(folder / "textured.glb", glb_bytes(textured()));
  write_glb(folder / "cube.glb", cube_document(16));
  write_glb(folder / "disk.glb", simple_document("Disk", disk(16), false));
  write_glb(folder / "annulus.glb", simple_document("Annulus", annulus(96, 12), false));
  write_glb(folder / "hemisphere.glb", simple_document("Half sphere", hemisphere(5), false));
  write_glb(folder / "plane.glb", simple_document("Plane", plane(100, 50), false));
  write_glb(folder / "triangle.glb", simple_document("Triangle", single_triangle(), false));
  write_glb(folder / "statue.glb", simple_document("Statue", statue(), true));
  write_bad_assets(folder);
  write_text(folder / "assets.json", description());
}

}  // namespace
}  // namespace lozenge::test_assets

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::cerr << "usage: generate_test_assets FOLDER\n";
    return 2;
  }
  try {
    lozenge::test_assets::generate(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "generate_test_assets: " << error.what() << '\n';
    return 1;
  }
}
