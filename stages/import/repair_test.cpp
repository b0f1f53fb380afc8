#include "stages/import/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "formats/domain/sphere_fixtures.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/canonical_form.h"
#include "stages/import/fill_holes.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "stages/import/surface_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_gltf;
using namespace testing_surfaces;

/// What keeps a mesh from being an oriented 2-manifold with boundary, found in another way than repair's: by sets of
/// directed edges, and by walking the link of each vertex. Empty where nothing does.
std::string defect_of(const SourceMesh& mesh) {
  std::set<std::pair<VertexId, VertexId>> directed;
  std::set<std::array<VertexId, 3>> known;
  std::vector<std::map<VertexId, VertexId>> links(mesh.positions.size());
  for (auto t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "a triangle with equal corners";
    for (int c = 0; c < 3; ++c) {
      if (!directed.emplace(t[c], t[(c + 1) % 3]).second) return "two triangles run the same way along an edge";
      links[t[c]][t[(c + 1) % 3]] = t[(c + 2) % 3];
    }
    std::sort(t.begin(), t.end());
    if (!known.insert(t).second) return "two triangles with the same vertices";
  }
  for (const auto& link : links) {
    if (link.empty()) return "a vertex without triangles";
    std::set<VertexId> ends;
    for (const auto& [from, to] : link) ends.insert(to);
    VertexId start = link.begin()->first;
    for (const auto& [from, to] : link) {
      if (!ends.contains(from)) start = from;
    }
    std::size_t length = 0;
    for (auto at = link.find(start); at != link.end(); at = link.find(at->second)) {
      ++length;
      if (at->second == start) break;
    }
    if (length != link.size()) return "a vertex with more than one fan";
  }
  return "";
}

/// Attributes whose values say which corner they were made for.
void add_attributes(SourceMesh& mesh, std::mt19937& random) {
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Vec3f& p = mesh.positions[mesh.triangles[c / 3][c % 3]];
    fixtures::add_corner(mesh, kTextureCoordinates, Vec2f(p.x, p.y + p.z));
    fixtures::add_corner(mesh, kColors, Vec4f(0.5F, 0.5F, 0.5F, 1));
    fixtures::add_corner(mesh, kNormals, p.normalized());
  }
  if (random() % 2 == 0) return;
  mesh.material_names = {"stone", "moss"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.materials.push_back(t < mesh.triangles.size() / 2 ? 0 : 1);
}

SourceMesh good_mesh(std::mt19937& random) {
  switch (random() % 5) {
    case 0:
      return sphere(1 + static_cast<int>(random() % 5));
    case 1:
      return torus(3 + static_cast<int>(random() % 5), 3 + static_cast<int>(random() % 5));
    case 2:
      return joined(sphere(2), torus(4, 5));
    case 3:
      return band(3 + static_cast<int>(random() % 9), static_cast<int>(random() % 4));
    default:
      return fixtures::subdivided_sphere(fixtures::tetrahedron(), 1 + static_cast<int>(random() % 3)).first;
  }
}

void copy_triangle(SourceMesh& mesh, std::size_t t, const std::array<VertexId, 3>& vertices) {
  mesh.triangles.push_back(vertices);
  append_triangle(mesh.corner_attributes, mesh.corner_attributes, static_cast<TriangleId>(t));
  if (!mesh.materials.empty()) mesh.materials.push_back(mesh.materials[t]);
}

void erase_triangle(SourceMesh& mesh, std::size_t t) {
  std::vector<bool> keep(mesh.triangles.size(), true);
  keep[t] = false;
  keep_triangles(mesh.corner_attributes, keep);
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<long>(t));
  if (!mesh.materials.empty()) mesh.materials.erase(mesh.materials.begin() + static_cast<long>(t));
}

void drop_degenerate(SourceMesh& mesh) {
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (a == b || b == c || c == a) erase_triangle(mesh, t);
  }
}

void damage(SourceMesh& mesh, std::mt19937& random) {
  if (mesh.triangles.size() < 2) return;
  const std::size_t t = random() % mesh.triangles.size();
  auto& triangle = mesh.triangles[t];
  const auto any_vertex = [&] { return static_cast<VertexId>(random() % mesh.positions.size()); };
  switch (random() % 9) {
    case 0:
      erase_triangle(mesh, t);
      break;
    case 1:
      std::swap(triangle[0], triangle[1]);
      break;
    case 2:
      copy_triangle(mesh, t, {triangle[1], triangle[2], triangle[0]});
      break;
    case 3:
      copy_triangle(mesh, t, {triangle[1], triangle[0], triangle[2]});
      break;
    case 4: {  // two vertices become one
      const VertexId a = any_vertex(), b = any_vertex();
      for (auto& each : mesh.triangles) std::replace(each.begin(), each.end(), a, b);
      break;
    }
    case 5:
      mesh.positions[any_vertex()] = Vec3f(mesh.positions[any_vertex()]);
      break;  // lie on each other
    case 6:
      copy_triangle(mesh, t, {triangle[0], triangle[1], any_vertex()});
      break;   // a wall
    case 7: {  // one corner elsewhere
      triangle[random() % 3] = any_vertex();
      break;
    }
    default: {  // a part is copied, and shares some vertices with what it is a copy of
      const std::size_t count = std::min<std::size_t>(mesh.triangles.size() - t, 1 + random() % 20);
      std::map<VertexId, VertexId> copies;
      for (std::size_t i = t; i < t + count; ++i) {
        auto moved = mesh.triangles[i];
        for (VertexId& v : moved) {
          if (!copies.contains(v)) {
            copies[v] = random() % 2 == 0 ? v : static_cast<VertexId>(mesh.positions.size());
            if (copies[v] != v) mesh.positions.push_back(mesh.positions[v] + Vec3f(0, 0, 0.5F));
          }
          v = copies[v];
        }
        copy_triangle(mesh, i, moved);
      }
    }
  }
  drop_degenerate(mesh);
}

void expect_attributes_fit(const SourceMesh& mesh) {
  ASSERT_EQ(fixtures::corner_uvs(mesh).size(), 3 * mesh.triangles.size());
  ASSERT_EQ(fixtures::corner_normals(mesh).size(), 3 * mesh.triangles.size());
  ASSERT_EQ(fixtures::corner_colors(mesh).size(), 3 * mesh.triangles.size());
  ASSERT_EQ(mesh.materials.size(), mesh.material_names.empty() ? 0 : mesh.triangles.size());
  ASSERT_EQ(mesh.cap_of.size(), mesh.cap_of.empty() ? 0 : mesh.material_names.size());
}

TEST(RepairSurface, MakesAnOrientedManifoldWithBoundaryOfWhateverIsDamaged) {
  std::mt19937 random(1);
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    SourceMesh mesh = good_mesh(random);
    add_attributes(mesh, random);
    const std::size_t damages = 1 + random() % (i % 2 == 0 ? 3 : 30);
    for (std::size_t k = 0; k < damages; ++k) damage(mesh, random);
    fixtures::plant_attributes(mesh);
    if (mesh.triangles.empty()) continue;
    make_canonical(mesh);
    RepairReport report;
    repair_surface(mesh, report);
    if (mesh.triangles.empty()) continue;
    ASSERT_EQ(defect_of(mesh), "");
    expect_attributes_fit(mesh);
    fixtures::expect_planted_attributes(mesh);
    EXPECT_NO_THROW(require_manifold(mesh, "mesh"));

    SourceMesh again = mesh;
    RepairReport nothing;
    repair_surface(again, nothing);
    EXPECT_TRUE(nothing.none());
    expect_same_mesh(mesh, again);

    SourceMesh filled = mesh;
    fill_holes(filled, 20.0 * static_cast<double>(random() % 10), report);
    ASSERT_EQ(defect_of(filled), "");
    expect_attributes_fit(filled);
    fixtures::expect_planted_attributes(filled);
    again = filled;
    repair_surface(again, nothing);
    EXPECT_TRUE(nothing.none());
    expect_same_mesh(filled, again);
  }
}

TEST(RepairSurface, LeavesNothingToDoForWhoImportsTheFileOfTheResult) {
  const TestFolder folder;
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    SourceMesh mesh = good_mesh(random);
    add_attributes(mesh, random);
    for (std::size_t k = 1 + random() % 20; k > 0; --k) damage(mesh, random);
    make_canonical(mesh);
    if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
          const Vec3f& p = mesh.positions[t[0]];
          return (mesh.positions[t[1]] - p).cross(mesh.positions[t[2]] - p).length() > 0;
        })) {
      continue;
    }
    write_source_mesh(folder / "damaged.glb", mesh);
    write_source_mesh(folder / "once.glb", import_surface(folder / "damaged.glb", {.fill_holes = 50}));
    write_source_mesh(folder / "twice.glb", import_surface(folder / "once.glb", {.fill_holes = 50, .strict = true}));
    EXPECT_EQ(fixtures::bytes_of(folder / "once.glb"), fixtures::bytes_of(folder / "twice.glb"));
  }
}

TEST(RepairSurface, LeavesManifoldsAsTheyAre) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    SourceMesh mesh = i % 4 == 0 ? band(3 + i, 2 * (i % 3)) : i % 2 == 0 ? sphere(1 + i % 7) : torus(3 + i % 5, 4);
    add_attributes(mesh, random);
    const SourceMesh before = mesh;
    RepairReport report;
    repair_surface(mesh, report);
    EXPECT_TRUE(report.none());
    expect_same_mesh(before, mesh);
  }
}

/// What a repair made of a mesh, and how often.
struct Repaired {
  SourceMesh mesh;
  RepairReport report;
  SurfaceFacts facts;
};
Repaired repaired(SourceMesh mesh) {
  Repaired result{std::move(mesh), {}, {}};
  repair_surface(result.mesh, result.report);
  EXPECT_EQ(defect_of(result.mesh), "");
  result.facts = surface_facts(result.mesh);
  return result;
}

void expect_counts(const RepairReport& report, const std::map<RepairKind, std::int64_t>& expected) {
  for (std::size_t k = 0; k < kRepairKinds; ++k) {
    const auto kind = static_cast<RepairKind>(k);
    EXPECT_EQ(report[kind].count, expected.contains(kind) ? expected.at(kind) : 0) << key_of(kind);
    EXPECT_EQ(report[kind].where.size(),
              std::min<std::size_t>(static_cast<std::size_t>(report[kind].count), kMostPlaces));
  }
}

TEST(RepairSurface, LeavesOutDuplicates) {
  SourceMesh mesh = sphere(3);
  const auto [a, b, c] = mesh.triangles[7];
  mesh.triangles.push_back({b, c, a});
  mesh.triangles.push_back({a, b, c});
  const Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kDuplicateTriangles, 2}});
  expect_same_mesh(result.mesh, sphere(3));
}

/// A square of n x n quads; the other way round, too, where `layers` is 2.
SourceMesh cloth(int n, int layers) {
  SourceMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) mesh.positions.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0F);
  }
  for (int layer = 0; layer < layers; ++layer) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const int v = i * (n + 1) + j;
        const std::array<std::array<VertexId, 3>, 2> quad{{{v, v + n + 1, v + 1}, {v + n + 1, v + n + 2, v + 1}}};
        for (const auto& [a, b, c] : quad) mesh.triangles.push_back({a, layer == 0 ? b : c, layer == 0 ? c : b});
      }
    }
  }
  return mesh;
}

TEST(RepairSurface, ShowsClothOfTwoLayersThatLookAlikeFromBothSides) {
  for (const bool has_material : {false, true}) {
    SourceMesh mesh = cloth(4, 2);
    if (has_material) {
      mesh.material_names = {"linen"};
      mesh.materials.assign(64, 0);
    }
    const Repaired result = repaired(mesh);
    expect_counts(result.report, {{RepairKind::kTwoSidedTriangles, 32}});
    EXPECT_EQ(result.mesh.triangles.size(), 32U);
    EXPECT_TRUE(is_double_sided(result.mesh));
    EXPECT_EQ(result.mesh.material_names, std::vector<std::string>{has_material ? "linen" : "default"});
  }
}

TEST(RepairSurface, ShowsNoMoreFromBothSidesThanWasThereTwice) {
  SourceMesh mesh = sphere(3);
  mesh.material_names = {"clay"};
  mesh.materials.assign(mesh.triangles.size() + 1, 0);
  const auto [a, b, c] = mesh.triangles[7];
  mesh.triangles.push_back({c, b, a});
  const Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kTwoSidedTriangles, 1}});
  EXPECT_EQ(result.mesh.material_names, (std::vector<std::string>{"clay", "clay"}));
  EXPECT_EQ(result.mesh.double_sided, (std::vector<bool>{false, true}));
  EXPECT_EQ(std::count(result.mesh.materials.begin(), result.mesh.materials.end(), 1), 1);
}

TEST(RepairSurface, KeepsLayersThatLookDifferent) {
  SourceMesh mesh = cloth(4, 2);
  mesh.material_names = {"velvet", "silk"};
  mesh.materials.assign(64, 0);
  std::fill(mesh.materials.begin() + 32, mesh.materials.end(), 1);
  const Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kLayers, 32}});
  EXPECT_EQ(result.mesh.triangles.size(), 64U);
  EXPECT_FALSE(is_double_sided(result.mesh));
  EXPECT_EQ(result.facts.boundary_loops, 2);
}

TEST(RepairSurface, TurnsTheSmallerPartBack) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const SourceMesh good = i % 2 == 0 ? sphere(6) : torus(7, 8);
    SourceMesh mesh = good;
    std::int64_t turned = 0;
    for (auto& triangle : mesh.triangles) {
      if (random() % 4 != 0) continue;
      std::swap(triangle[1], triangle[2]);
      ++turned;
    }
    const Repaired result = repaired(mesh);
    expect_counts(result.report, {{RepairKind::kTurnedTriangles, turned}});
    EXPECT_EQ(result.facts.boundary_edges, 0);
    EXPECT_GT(enclosed_volume(result.mesh), 0);
  }
}

TEST(RepairSurface, FacesOutwardWhereHalfOfAClosedSurfaceIsTurnedAtRandom) {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    SourceMesh mesh = i % 2 == 0 ? sphere(6) : torus(7, 8);
    for (auto& triangle : mesh.triangles) {
      if (random() % 2 == 0) std::swap(triangle[1], triangle[2]);
    }
    EXPECT_GT(enclosed_volume(repaired(mesh).mesh), 0);
  }
}

TEST(RepairSurface, NegatesTheNormalsThatATurnedTriangleTookFromItsWrongSide) {
  std::mt19937 random(4);
  SourceMesh mesh = sphere(4);
  add_attributes(mesh, random);
  const SourceMesh good = mesh;
  std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);  // its normals still point outward
  std::swap(mesh.triangles[9][1], mesh.triangles[9][2]);
  for (std::size_t c = 27; c < 30; ++c) {
    fixtures::set_corner(mesh, kNormals, c, -fixtures::corner_normals(mesh)[c]);
  }
  for (AttributeStream& stream : mesh.corner_attributes) {
    for (const std::size_t t : {3UL, 9UL}) {
      std::swap_ranges(stream.at(3 * t + 1), stream.at(3 * t + 2), stream.at(3 * t + 2));
    }
  }
  const Repaired result = repaired(mesh);
  EXPECT_TRUE(fixtures::same_bits(result.mesh.corner_attributes, good.corner_attributes));
}

TEST(RepairSurface, CutsAMoebiusStripOnceAcross) {
  for (const int n : {3, 4, 5, 12, 101}) {
    for (const int twists : {1, 3}) {
      const Repaired result = repaired(band(n, twists));
      EXPECT_EQ(result.report[RepairKind::kCutEdges].count, 1) << n;
      EXPECT_EQ(result.facts.euler, 1) << n;  // a disc
      EXPECT_EQ(result.facts.boundary_loops, 1) << n;
      EXPECT_EQ(result.mesh.triangles.size(), 2 * static_cast<std::size_t>(n));
    }
  }
}

TEST(RepairSurface, PartsBodiesThatTouchInAPointOrAlongAnEdge) {
  // Two tetrahedra that share a corner.
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
  Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kBowTieVertices, 1}});
  EXPECT_EQ(result.facts.components, 2);
  EXPECT_EQ(result.facts.boundary_edges, 0);
  EXPECT_EQ(result.mesh.positions.size(), 8U);

  // Two prisms whose right angles meet in an edge: sheets go on equally straight either way.
  SourceMesh prism;
  prism.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  prism.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  mesh = prism;
  for (const Vec3f& p : prism.positions) mesh.positions.push_back({-p.x, -p.y, p.z});
  for (auto t : prism.triangles) {
    for (VertexId& v : t) v = v == 0 || v == 3 ? v : v + 6;
    mesh.triangles.push_back(t);
  }
  make_canonical(mesh);
  result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kCrowdedEdges, 1}});
  EXPECT_EQ(result.facts.components, 2);
  EXPECT_EQ(result.facts.euler, 4);
  EXPECT_EQ(result.facts.boundary_edges, 0);
}

TEST(RepairSurface, LetsPlanesGoStraightOnWhereTheyCross) {
  // Two squares of two triangles each, which cross along their common diagonal.
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 2}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 4, 1}, {0, 1, 5}};
  const Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kCrowdedEdges, 1}});
  EXPECT_EQ(result.facts.components, 2);
  EXPECT_EQ(result.mesh.triangles.size(), 4U);
  for (const auto& t : result.mesh.triangles) {
    for (const auto& u : result.mesh.triangles) {
      if (t == u || std::find(u.begin(), u.end(), t[0]) == u.end()) continue;
      const auto apex = [&](const auto& s) { return result.mesh.positions[s[1]].z == 1 ? s[1] : s[2]; };
      EXPECT_EQ(result.mesh.positions[apex(t)], -result.mesh.positions[apex(u)] + Vec3f(0, 0, 2));
    }
  }
}

TEST(RepairSurface, LeavesAnInnerWallAsAPieceOfItsOwn) {
  SourceMesh mesh;
  mesh.positions = {{1, 0, 0}, {-0.5F, 0.8F, 0}, {-0.5F, -0.8F, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}, {0, 1, 2}};
  make_canonical(mesh);
  const Repaired result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kCrowdedEdges, 3}});
  EXPECT_EQ(result.facts.components, 2);
  EXPECT_EQ(result.facts.boundary_edges, 3);
  EXPECT_EQ(result.facts.boundary_loops, 1);
}

TEST(RepairSurface, DividesEdgesWhoseSheetsMeetAgainAtBothEnds) {
  // A ball whose surface is pinched along one edge: the sheets beside the edge are one fan at both of its ends.
  SourceMesh mesh = sphere(6);
  const HalfEdgeLinks links = link_half_edges(mesh);
  // Two far vertices a, b of an edge, and c, d of another one, become the same.
  const VertexId a = half_edge_start(mesh, 0), b = half_edge_end(mesh, 0);
  const HalfEdge far = static_cast<HalfEdge>(links.twins.size()) - 1;
  const VertexId c = half_edge_end(mesh, far), d = half_edge_start(mesh, far);
  for (auto& triangle : mesh.triangles) {
    std::replace(triangle.begin(), triangle.end(), c, a);
    std::replace(triangle.begin(), triangle.end(), d, b);
  }
  make_canonical(mesh);
  const Repaired result = repaired(mesh);
  EXPECT_EQ(result.report[RepairKind::kCrowdedEdges].count, 1);
  EXPECT_EQ(result.facts.boundary_edges, 0);
}

TEST(RepairSurface, KeepsAFlatTriangleThatJoinsTwoOthers) {
  // A tetrahedron, one edge of which has a vertex in its middle that only one side knows; a flat triangle joins them.
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 1, 4}};
  make_canonical(mesh);
  const SourceMesh before = mesh;
  Repaired result = repaired(mesh);
  EXPECT_TRUE(result.report.none());
  expect_same_mesh(before, result.mesh);

  // One that hangs on an edge besides, and one alone, are of no use.
  mesh.positions.insert(mesh.positions.end(), {{5, 5, 0}, {5, 6, 0}, {5, 7, 0}, {0, 0, 7}});
  mesh.triangles.push_back({5, 6, 7});
  const auto at = [&](const Vec3f& p) {
    return static_cast<VertexId>(std::find(mesh.positions.begin(), mesh.positions.end(), p) - mesh.positions.begin());
  };
  mesh.triangles.push_back({at({0, 0, 0}), at({0, 0, 2}), at({0, 0, 7})});
  result = repaired(mesh);
  expect_counts(result.report, {{RepairKind::kFlatTriangles, 2}});
  expect_same_mesh(before, result.mesh);
}

TEST(RepairSurface, StaysFastWhereVeryManyTrianglesShareAnEdgeOrAVertex) {
  // Quadratic work would take minutes.
  const int n = 200000;
  SourceMesh book;
  book.positions = {{0, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * i / n;
    book.positions.push_back(Vec3f(Vec3d(std::cos(u), std::sin(u), 0.5)));
    if (i % 2 == 0) book.triangles.push_back({0, 1, i + 2});
    if (i % 2 != 0) book.triangles.push_back({1, 0, i + 2});
  }
  Repaired result = repaired(book);
  EXPECT_EQ(result.facts.components, n / 2);

  SourceMesh brush;
  brush.positions = {{0, 0, 0}};
  for (int i = 0; i < n; ++i) {
    const auto x = static_cast<float>(i);
    brush.positions.insert(brush.positions.end(), {{x, 1, 0}, {x, 1, 1}});
    brush.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  result = repaired(brush);
  expect_counts(result.report, {{RepairKind::kBowTieVertices, 1}});
  EXPECT_EQ(result.facts.components, n);
}

}  // namespace
}  // namespace lozenge
