#include "formats/files/parameterization_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/surface_builder.h"
#include "formats/surface/attribute_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

/// The mesh in canonical form, and the map along.
std::pair<SourceMesh, Parameterization> canonical(const std::pair<SourceMesh, Parameterization>& given) {
  SourceMesh mesh = given.first;
  Parameterization map{given.second.domain, {}};
  std::vector<VertexId> number(mesh.positions.size(), -1);
  mesh.positions.clear();
  for (auto& triangle : mesh.triangles) {
    for (VertexId& v : triangle) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(mesh.positions.size());
        const Vec3f& p = given.first.positions[v];
        mesh.positions.push_back({p.x + 0.0F, p.y + 0.0F, p.z + 0.0F});
        map.phi.push_back(given.second.phi[v]);
      }
      v = number[v];
    }
  }
  return {mesh, map};
}

/// A jittered sphere with UVs that split some of its vertices.
std::pair<SourceMesh, Parameterization> example(const Domain& base, int n, unsigned seed) {
  auto sphere = fixtures::subdivided_sphere(base, n);
  fixtures::jitter(sphere.second, 0.3 / n, seed);
  auto [mesh, map] = canonical(sphere);
  std::mt19937 random(seed);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    fixtures::add_corner(mesh, kTextureCoordinates,
                         Vec2f(static_cast<float>(random() % 2), static_cast<float>(random() % 3)));
  }
  return {mesh, map};
}

class ParameterizationFile : public testing::Test {
 protected:
  std::string written(const SourceMesh& mesh, const Parameterization& map) const {
    write_parameterization(folder_ / "map.glb", mesh, map);
    return fixtures::bytes_of(folder_ / "map.glb");
  }

  fixtures::TestFolder folder_;
};

TEST_F(ParameterizationFile, GivesBackTheSameMapBitByBit) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto [mesh, map] = example(base, 1 + static_cast<int>(seed), seed);
      const std::string bytes = written(mesh, map);
      const auto [mesh_again, map_again] = read_parameterization(folder_ / "map.glb");
      EXPECT_EQ(map_again.phi, map.phi);
      EXPECT_EQ(map_again.domain.vertex_count, map.domain.vertex_count);
      ASSERT_EQ(map_again.domain.size(), map.domain.size());
      for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
        EXPECT_EQ(map_again.domain.triangles[t].corners, map.domain.triangles[t].corners);
        EXPECT_EQ(map_again.domain.triangles[t].neighbours, map.domain.triangles[t].neighbours);
      }
      EXPECT_EQ(mesh_again.positions, mesh.positions);
      EXPECT_EQ(mesh_again.triangles, mesh.triangles);
      EXPECT_EQ(fixtures::corner_uvs(mesh_again), fixtures::corner_uvs(mesh));
      EXPECT_EQ(written(mesh_again, map_again), bytes);
    }
  }
}

TEST_F(ParameterizationFile, KeepsEveryLatticePointExactly) {
  auto [mesh, map] = example(fixtures::icosahedron(), 12, 1);
  std::mt19937_64 random(8);
  for (int i = 0; i < 20; ++i) {
    for (DomainPoint& p : map.phi) {
      // Coordinates of every magnitude, down to single steps of the lattice.
      const auto one = static_cast<std::uint64_t>(kLatticeOne);
      const std::uint64_t a = random() % (one >> (random() % 41)) + random() % 2;
      const std::uint64_t b = (random() % (one - a + 1)) >> (random() % 41);
      p = {static_cast<DomainTriangleId>(random() % 20), std::ldexp(static_cast<double>(a), -40),
           std::ldexp(static_cast<double>(b), -40)};
    }
    write_parameterization(folder_ / "map.glb", mesh, map);
    EXPECT_EQ(read_parameterization(folder_ / "map.glb").second.phi, map.phi);
  }
}

TEST_F(ParameterizationFile, HoldsDomainsWithABoundary) {
  const Domain open = make_domain({{0, 1, 2}, {0, 2, 3}}, 4);
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Parameterization map{open, {{0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}};
  write_parameterization(folder_ / "map.glb", mesh, map);
  const Parameterization again = read_parameterization(folder_ / "map.glb").second;
  EXPECT_EQ(again.phi, map.phi);
  EXPECT_FALSE(again.domain.neighbour({0, 0}).exists());
  EXPECT_TRUE(again.domain.neighbour({0, 2}).exists());
}

/// The parts of a GLB, to be changed and put together again.
struct Parts {
  nlohmann::json document;
  std::string bytes;
};
Parts parts_of(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return {nlohmann::json::parse(glb.substr(20, length)), glb.substr(20 + length + 8)};
}
std::string joined(const Parts& parts) {
  std::string text = parts.document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    std::string four(4, '\0');
    std::memcpy(four.data(), &narrow, 4);
    return four;
  };
  return "glTF" + word(2) + word(28 + text.size() + parts.bytes.size()) + word(text.size()) + "JSON" + text +
         word(parts.bytes.size()) + std::string("BIN\0", 4) + parts.bytes;
}

/// Two triangles that don't touch; the second one counts as a quarter as long.
std::pair<SourceMesh, Parameterization> two_scales() {
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  Parameterization map{make_domain({{0, 1, 2}, {3, 4, 5}}, 6), {}, {0, 2}};
  map.phi = {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}};
  return {mesh, map};
}

TEST_F(ParameterizationFile, RefusesFirstLevelsThatNoPartsHave) {
  const auto [mesh, map] = two_scales();
  const Parts good = parts_of(written(mesh, map));
  const std::vector<std::pair<nlohmann::json, std::string>> wrong{
      {{0}, "list of 2 numbers"}, {{0, 6}, "not 0 to 5"}, {{0, -1}, "no index"}, {{2, 0}, "fall from 2 to 0"}};
  for (const auto& [levels, message] : wrong) {
    Parts bad = good;
    bad.document["meshes"][0]["extras"]["lozenge_domain"]["first_levels"] = levels;
    std::ofstream(folder_ / "bad.glb", std::ios::binary) << joined(bad);
    try {
      read_parameterization(folder_ / "bad.glb");
      ADD_FAILURE() << levels << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
}

TEST_F(ParameterizationFile, HoldsTheFirstLevelsOfParts) {
  const auto [mesh, map] = two_scales();
  const std::string bytes = written(mesh, map);
  const auto [mesh_again, map_again] = read_parameterization(folder_ / "map.glb");
  EXPECT_EQ(map_again.first_levels, map.first_levels);
  EXPECT_EQ(written(mesh_again, map_again), bytes);
}

TEST_F(ParameterizationFile, RefusesWhatDoesNotHoldTogether) {
  using nlohmann::json;
  const auto [mesh, map] = example(fixtures::octahedron(), 4, 3);
  const Parts good = parts_of(written(mesh, map));
  const auto expect_refused = [&](const std::string& what, const std::function<void(Parts&)>& damage,
                                  ExitCode code = ExitCode::kUnusableInput) {
    Parts bad = good;
    damage(bad);
    std::ofstream(folder_ / "bad.glb", std::ios::binary) << joined(bad);
    try {
      read_parameterization(folder_ / "bad.glb");
      ADD_FAILURE() << "was not refused: " << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what() << "\nlacks " << what;
    }
  };
  const auto domain = [](Parts& p) -> json& { return p.document["meshes"][0]["extras"]["lozenge_domain"]; };
  // Overwrites a float of an attribute.
  const auto poke = [](Parts& p, const std::string& attribute, std::size_t number, float value) {
    const json& accessor =
        p.document["accessors"][p.document["meshes"][0]["primitives"][0]["attributes"][attribute].get<int>()];
    const json& view = p.document["bufferViews"][accessor["bufferView"].get<int>()];
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    std::memcpy(p.bytes.data() + offset + 4 * number, &value, 4);
  };
  expect_refused("lack the domain's lozenge_domain", [](Parts& p) { p.document["meshes"][0].erase("extras"); });
  expect_refused(
      "another version", [&](Parts& p) { domain(p)["version"] = 9; }, ExitCode::kUnsupported);
  expect_refused("lack the domain's corners", [&](Parts& p) { domain(p).erase("corners"); });
  expect_refused("same, sensible length", [&](Parts& p) { domain(p)["corners"].erase(0); });
  expect_refused("vertex count", [&](Parts& p) { domain(p)["vertices"] = 1000; });
  expect_refused("vertex count", [&](Parts& p) { domain(p)["vertices"] = -1; });
  expect_refused("belongs to no triangle", [&](Parts& p) { domain(p)["vertices"] = 7; });
  expect_refused("no such corner", [&](Parts& p) { domain(p)["corners"][3][1] = 77; });
  expect_refused("corners of domain triangle 3", [&](Parts& p) { domain(p)["corners"][3][1] = -1; });
  expect_refused("corners of domain triangle 3", [&](Parts& p) { domain(p)["corners"][3].push_back(1); });
  expect_refused("the domain is broken", [&](Parts& p) { domain(p)["neighbours"][2][0] = 800; });
  expect_refused("the domain is broken", [&](Parts& p) { domain(p)["neighbours"][2][1] = 3; });
  expect_refused("half a side", [&](Parts& p) { domain(p)["neighbours"][2][0] = -1; });
  expect_refused("neighbours of domain triangle 2", [&](Parts& p) { domain(p)["neighbours"][2][0] = "a"; });
  for (const float triangle : {-1.0F, 8.0F, 0.5F, std::nanf(""), INFINITY, 1e30F}) {
    expect_refused("no triangle of the domain", [&](Parts& p) { poke(p, "_DOMAIN_TRIANGLE", 2, triangle); });
  }
  for (const float alpha : {-0.25F, 1.5F, std::ldexp(1.0F, -45), std::nanf(""), INFINITY, -INFINITY}) {
    expect_refused("multiples of 2^-40", [&](Parts& p) { poke(p, "_DOMAIN_ALPHA_BETA", 4, alpha); });
  }
  expect_refused("mapped elsewhere", [&](Parts& p) {
    // Some vertex is split; giving each vertex of the file its own position parts it.
    const json& accessor =
        p.document["accessors"]
                  [p.document["meshes"][0]["primitives"][0]["attributes"]["_DOMAIN_ALPHA_BETA"].get<int>()];
    for (std::size_t v = 0; v < accessor["count"].get<std::size_t>(); ++v) {
      poke(p, "_DOMAIN_ALPHA_BETA", 4 * v, static_cast<float>(v) / 4096);
      for (std::size_t c = 1; c < 4; ++c) poke(p, "_DOMAIN_ALPHA_BETA", 4 * v + c, 0);
    }
  });
  expect_refused("has no _DOMAIN_TRIANGLE",
                 [](Parts& p) { p.document["meshes"][0]["primitives"][0]["attributes"].erase("_DOMAIN_TRIANGLE"); });
  expect_refused("is not a parameterization file", [](Parts& p) { p.document["asset"].erase("extras"); });
}

}  // namespace
}  // namespace lozenge
