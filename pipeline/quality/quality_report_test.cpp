#include "pipeline/quality/quality_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

using Json = nlohmann::json;

QualityReport full_report() {
  QualityReport report;
  report.source = SurfaceFacts{5, 6, 1, 2, 3, 4};
  report.instances = InstanceFacts{7, 3, 2};
  report.repairs.emplace().add(RepairKind::kFilledHoles, {1, 2, 3});
  report.repairs->add(RepairKind::kFilledHoles, 6, {{4, 5, 6}});
  report.domain = domain_facts(fixtures::icosahedron());
  report.distortion = Distortion{0.1, 0.2, 0.12, 1.1, 0, 1e-17};
  report.patches = PatchFacts{30, 17, 5};
  report.asset = AssetQuality{
      15'360, 7'682, 0,    3, {{15'360, 7'682, 0.01, 0.1, {}}, {3'840, 1'922, 0.04, 0.4, 0.02}, {960, 482, {}, {}, {}}},
      0.01,   0.2,   0.003};
  report.bake = BakeStatistics{100, 200, 3e6, 4, 0.5, 7};
  report.stages = {{"import", 1.5, 20}, {"bake", 2.5, 30}};
  report.seconds = 4;
  report.peak_memory_mb = 30;
  report.input = "folder/statue.glb";
  return report;
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;  // sorted: nlohmann::json keeps objects so
}

TEST(QualityReport, HasEveryKeyThatScriptsRelyOn) {
  using Keys = std::vector<std::string>;
  const Json json = Json::parse(report_json(full_report()));
  EXPECT_EQ(keys(json), (Keys{"asset", "bake", "distortion", "domain", "input", "instances", "lozenge", "patches",
                              "peak_memory_mb", "repairs", "seconds", "source", "stages"}));
  EXPECT_EQ(keys(json["source"]),
            (Keys{"boundary_edges", "boundary_loops", "components", "euler", "triangles", "vertices"}));
  EXPECT_EQ(json["repairs"], Json::parse(R"({"filled_holes": {"count": 7, "where": [[1, 2, 3], [4, 5, 6]]}})"));
  EXPECT_EQ(json["instances"], Json::parse(R"({"placed": 7, "repeated": 3, "copies": 2})"));
  EXPECT_EQ(keys(json["domain"]), (Keys{"irregular_vertices", "triangles", "vertices"}));
  EXPECT_EQ(keys(json["distortion"]),
            (Keys{"aggregate", "angle", "area", "area_sum_error", "folded_triangles", "l2_stretch"}));
  EXPECT_EQ(keys(json["patches"]), (Keys{"count", "levels", "samples"}));
  EXPECT_EQ(keys(json["asset"]),
            (Keys{"boundary_max_distance_percent", "level_triangles", "levels", "lods", "max_distance_percent",
                  "mean_distance_percent", "source_triangles", "triangles", "vertices"}));
  EXPECT_EQ(keys(json["asset"]["lods"][1]),
            (Keys{"max_distance_percent", "mean_distance_percent", "normals_degrees", "triangles", "vertices"}));
  EXPECT_EQ(keys(json["bake"]),
            (Keys{"cage_distance", "fallback_texels", "rays", "rays_per_second", "texels", "unused_texels"}));
  EXPECT_EQ(keys(json["stages"][0]), (Keys{"name", "peak_memory_mb", "seconds"}));
}

TEST(QualityReport, GivesNumbersExactlyAsTheyWereMeasured) {
  const QualityReport report = full_report();
  const Json json = Json::parse(report_json(report));
  EXPECT_EQ(json["distortion"]["area_sum_error"].get<double>(), report.distortion->area_sum_error);
  EXPECT_EQ(json["asset"]["mean_distance_percent"].get<double>(), *report.asset->mean_distance_percent);
  EXPECT_EQ(json["domain"]["triangles"], 20);
  EXPECT_EQ(json["domain"]["irregular_vertices"], 12);
  EXPECT_EQ(json["stages"][1]["name"], "bake");
}

TEST(QualityReport, LeavesOutWhatIsNotKnown) {
  QualityReport report;
  report.input = "a.glb";
  EXPECT_EQ(keys(Json::parse(report_json(report))),
            (std::vector<std::string>{"input", "lozenge", "peak_memory_mb", "seconds", "stages"}));
}

TEST(QualityReport, TellsPeopleOfInstancesWhereAMeshIsPlacedMoreThanOnce) {
  QualityReport report;
  const auto told = [&] { return report_lines(report).front().starts_with("instances"); };
  report.instances = InstanceFacts{3, 0};
  EXPECT_FALSE(told());
  report.instances = InstanceFacts{3, 2};
  EXPECT_TRUE(told()) << report_lines(report).front();
}

TEST(QualityReport, StaysJsonWhateverTheFileIsCalled) {
  QualityReport report;
  report.input = "statue \"\xff\x01\".glb";
  EXPECT_NO_THROW(Json::parse(report_json(report)));
}

}  // namespace
}  // namespace lozenge
