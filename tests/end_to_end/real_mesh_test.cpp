// Scans and sculptures as people have them, from the folder that the environment variable LOZENGE_MESHES names.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

struct RealMesh {
  std::string name;
  int euler;
  double most_aggregate;  ///< 1.5 times what the only public implementation reaches, and 0.12 where it fails
};

class RealMeshes : public InOwnFolder<::testing::TestWithParam<RealMesh>> {};

TEST_P(RealMeshes, BecomeAssetsCloseToTheirSource) {
  const char* folder = std::getenv("LOZENGE_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "set LOZENGE_MESHES to a folder that holds " << GetParam().name << ".glb";
  const std::string source = (std::filesystem::path(folder) / (GetParam().name + ".glb")).string();
  const Outcome built =
      run({"build", source, "-o", path("out"), "--domain-faces", "100..200", "--samples", "17", "--json"});
  ASSERT_EQ(built.code, 0) << built.err;

  const json report = json::parse(built.out);
  EXPECT_EQ(report["source"]["euler"], GetParam().euler);
  EXPECT_GE(report["domain"]["triangles"], 100);
  EXPECT_LE(report["domain"]["triangles"], 200);
  EXPECT_EQ(report["distortion"]["folded_triangles"], 0);
  EXPECT_LE(report["distortion"]["area_sum_error"], 1e-9);
  EXPECT_LE(report["distortion"]["aggregate"], GetParam().most_aggregate);
  EXPECT_LE(report["asset"]["mean_distance_percent"], 0.1);
  for (const auto& [name, bytes] : content_of(path("out"))) {
    const Outcome checked = run({"check", path("out/" + name)});
    EXPECT_EQ(checked.code, 0) << name << ": " << checked.out << checked.err;
  }
  // Nobody sees a difference where normals are this close.
  const Outcome compared = run({"compare", source, path("out/" + GetParam().name + ".glb"), "--normals", "--json"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  const json normals = json::parse(compared.out)["normals"];
  EXPECT_LE(normals["mean_degrees"], 3);
  EXPECT_LE(normals["percentile_95_degrees"], 10);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealMeshes,
                         ::testing::Values(RealMesh{"armadillo", 2, 0.0872}, RealMesh{"bunny00", 2, 0.0729},
                                           RealMesh{"refined_elephant", -4, 0.12}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lozenge::end_to_end
