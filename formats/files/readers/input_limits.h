// What reading an input file may cost, and how much of it is taken.
#pragma once

#include <cstdint>

namespace lozenge {

/// A reader finds out before it takes the memory, and throws Error(kLimit) where a file is larger.
struct InputLimits {
  std::uint64_t max_memory = 0;               ///< bytes, of what importing the file takes; 0: no limit
  std::uint64_t max_triangles = 100'000'000;  ///< those that polygons are cut into
  int joints = 4;                             ///< that move a vertex of a skin, at most 8: the heaviest are kept
};

/// Bytes that the importer takes for so many vertices and triangles: attributes as they are read, gathered, welded, and
/// moved to the triangles' corners. Measured; an asset without normals, UVs and colours takes half.
constexpr std::uint64_t memory_to_import(std::uint64_t vertices, std::uint64_t triangles) {
  return 150 * vertices + 200 * triangles;
}

}  // namespace lozenge
