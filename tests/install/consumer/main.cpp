// A program of somebody else that links the installed library.
#include <lozenge/formats/base/error.h>
#include <lozenge/formats/base/version.h>
#include <lozenge/formats/domain/domain.h>

#include <cstdlib>
#include <iostream>

int main() {
  try {
    const lozenge::Domain octahedron = lozenge::make_domain(
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}, 6);
    std::cout << "lozenge " << lozenge::version() << ": an octahedron has Euler characteristic "
              << lozenge::euler_characteristic(octahedron) << '\n';
    return EXIT_SUCCESS;
  } catch (const lozenge::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
