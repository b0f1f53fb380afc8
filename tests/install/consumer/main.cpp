// A program of somebody else that links the installed library.
#include <lozenge/formats/base/error.h>
#include <lozenge/formats/base/version.h>
#include <lozenge/formats/domain/domain.h>
#include <lozenge/formats/files/geometry_image_file.h>
#include <lozenge/formats/patches/level_mesh.h>

#include <cstdlib>
#include <iostream>

// As the README shows it.
std::size_t triangles_of_level_1() {
  const lozenge::GeometryImage image = lozenge::read_geometry_image("statue.gim.exr");
  const lozenge::LevelMesh mesh = lozenge::level_mesh(image, 1);
  return mesh.triangles.size();
}

int main(int argc, char**) {
  try {
    const lozenge::Domain octahedron = lozenge::make_domain(
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}, 6);
    std::cout << "lozenge " << lozenge::version() << ": an octahedron has Euler characteristic "
              << lozenge::euler_characteristic(octahedron) << '\n';
    if (argc > 1) std::cout << triangles_of_level_1() << " triangles\n";
    return EXIT_SUCCESS;
  } catch (const lozenge::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
