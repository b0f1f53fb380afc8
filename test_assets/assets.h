// The small assets that the tests run on, and what each of them must give.
//
// `generate.cpp` makes the files at build time, in the folder that the compile definition LOZENGE_TEST_ASSETS names
// (link the CMake target `lozenge_test_assets`), and writes these tables beside them as assets.json, for tests in other
// languages.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lozenge::test_assets {

/// What the importer reports to have mended.
struct ExpectedRepair {
  std::string_view key;  ///< of its kind, in the report
  std::int64_t count = 0;
};

/// An oriented 2-manifold once it is imported, with no hole filled and what is repeated there once.
struct Asset {
  std::string_view file;
  std::int32_t triangles = 0;
  std::int32_t components = 1;
  std::int32_t euler = 2;  ///< vertices - edges + triangles; 2 components - 2 genus - boundary loops
  std::string_view about;
  std::int32_t boundary_loops = 0;
  std::array<ExpectedRepair, 2> repairs{};  ///< all there are; those with a count of 0 are none
  /// What is baked where nobody asks for other maps: their part of files' names, a blank after each.
  std::string_view maps = "normal occlusion ";
};

/// Closed surfaces that need no repair.
inline constexpr std::array kAssets{
    Asset{"sphere.glb", 5120, 1, 2, "an icosahedron, subdivided four times"},
    Asset{"bumpy_sphere.glb", 8192, 1, 2, "a subdivided octahedron with waves"},
    Asset{"torus.glb", 7680, 1, 0, "a plain ring"},
    Asset{"genus3.glb", 17284, 1, -4, "three rings in a row, melted together, from an implicit function"},
    Asset{"knot.glb", 9600, 1, 0, "a tube along a trefoil"},
    Asset{"two_components.glb", 6400, 2, 2, "a ring and a ball in its hole, in two nodes"},
    Asset{"rings.glb",
          5120,
          3,
          2,
          "a ball and six placements of one ring, four of them copies, one sheared and so surface of its own",
          0,
          {},
          "normal orm basecolor "},
    Asset{"worm.glb",
          2688,
          3,
          6,
          "a skin in centimetres that an armature makes metres, a prop on a bone, and a ball",
          0,
          {},
          "normal "},
    Asset{"cart.glb",
          2560,
          3,
          4,
          "two wheels that turn, of one mesh and mirrored, a seat that goes along, and a ball that only seems to move",
          0,
          {},
          "normal "},
    Asset{"face.glb",
          2560,
          2,
          4,
          "a ball with sparse morph targets and animated weights, and one that stands still",
          0,
          {},
          "normal "},
    Asset{"packed_worms.glb",
          1536,
          3,
          6,
          "skins in whole numbers that share joints outside of the scene, an uneven bone, vertices without weights",
          0,
          {},
          "normal "},
    Asset{"uneven.glb", 6576, 1, 2, "a turned part: fans, slivers, triangles of very different sizes"},
    Asset{"seams.glb",
          4032,
          2,
          2,
          "UV seams, three materials of which one is double-sided, a mirrored instance, nested transforms",
          0,
          {},
          "normal basecolor "},
    Asset{"seams.gltf", 4032, 2, 2, "the same with its buffer in a file of its own", 0, {}, "normal basecolor "},
    Asset{
        "textured.glb",
        5088,
        4,
        6,
        "the same with tiled and mirrored textures, moved ones, a second set of coordinates, colours at vertices, and "
        "two more balls: one with holes by alpha, one of glass",
        0,
        {},
        "normal orm basecolor emissive source_normal "},
    Asset{"cube.glb", 3072, 1, 2, "hard edges: every face has vertices and normals of its own"},
};

/// What `tools/dev run` shows: larger than the others and with fine relief, so that the baked normals have something to
/// do.
inline constexpr Asset kShowpiece{"statue.glb", 123472, 1, -4, "an idol with its arms akimbo and a ring on its head"};

/// Closed surfaces once they are repaired.
inline constexpr std::array kRepairedAssets{
    Asset{"bad/pinched_vertex.glb", 8, 2, 4, "two tetrahedra that share one corner", 0, {{{"bow_tie_vertices", 1}}}},
    Asset{"bad/touching_spheres.glb", 1024, 2, 4, "two balls that share one vertex", 0, {{{"bow_tie_vertices", 1}}}},
};

/// Surfaces that end somewhere, some of them only since they were repaired.
inline constexpr std::array kOpenAssets{
    Asset{"disk.glb", 1536, 1, 1, "flat, in rings", 1},
    Asset{"annulus.glb", 2304, 1, 0, "flat, between two circles", 2},
    Asset{"hemisphere.glb", 4096, 1, 1, "half a subdivided octahedron", 1},
    Asset{"plane.glb", 10000, 1, 1, "a flat rectangle, twice as wide as high", 1},
    Asset{"triangle.glb", 1, 1, 1, "a single triangle", 1},
    Asset{"bad/open_surface.glb", 1279, 1, 1, "a sphere without one triangle", 1},
    // As it was made, triangles disagree across one line from rim to rim; the cut may lie elsewhere.
    Asset{"bad/moebius_strip.glb",
          1024,
          1,
          1,
          "one side, one boundary; cut once from rim to rim",
          1,
          {{{"turned_triangles", 511}, {"cut_edges", 8}}}},
    Asset{"bad/klein_bottle.glb",
          3072,
          1,
          0,
          "closed, but one-sided; cut once around, which leaves a tube",
          2,
          {{{"turned_triangles", 1536}, {"cut_edges", 24}}}},
    Asset{"bad/three_triangles_on_an_edge.glb",
          7,
          2,
          3,
          "two tetrahedra with a wall between them, which becomes a piece of its own",
          1,
          {{{"crowded_edges", 3}}}},
};

/// A file that must be refused.
struct BadAsset {
  std::string_view file;
  std::int32_t exit_code = 3;
  std::string_view word;  ///< in lower case; the message contains it, whatever its case
  std::string_view about;
};

inline constexpr std::array kBadAssets{
    BadAsset{"bad/no_triangles.glb", 3, "no triangles", "a primitive of points"},
    BadAsset{"bad/no_meshes.glb", 3, "no triangles", "a scene of one empty node"},
    BadAsset{"bad/flat_triangles.glb", 3, "coinciding corners", "every triangle has two equal corners"},
    BadAsset{"bad/truncated.glb", 3, "promises", "the first half of a good file"},
    BadAsset{"bad/empty.glb", 3, "is empty", "no bytes at all"},
    BadAsset{"bad/wrong_magic.glb", 3, "neither glb", "begins with other letters than glTF"},
    BadAsset{"bad/broken_json.gltf", 3, "json is broken", "ends in the middle of an object"},
    BadAsset{"bad/accessor_past_its_buffer.glb", 3, "accessor 0", "counts more elements than its view holds"},
    BadAsset{"bad/index_past_its_vertices.glb", 3, "there are 642 vertices", "one index is the number of vertices"},
    BadAsset{"bad/nan_position.glb", 3, "position of vertex 100", "one coordinate is not a number"},
    BadAsset{"bad/infinite_position.glb", 3, "position of vertex 100", "one coordinate is infinite"},
    BadAsset{"bad/missing_buffer.gltf", 3, "this_file_is_missing.bin", "names a file that is not there"},
};

}  // namespace lozenge::test_assets
