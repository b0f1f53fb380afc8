// Surfaces with a boundary: their guarantees hold, and each one broken on purpose is found.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "formats/open_fixtures.h"
#include "stages/check/check.h"

namespace lozenge {
namespace {

using Names = std::set<std::string>;

Names broken_lines(const CheckReport& report) {
  Names names;
  for (const CheckLine& line : report.lines) {
    if (!line.passed) names.insert(line.name);
  }
  return names;
}

std::string text(const CheckReport& report) {
  std::string all;
  for (const std::string& line : report_lines(report)) all += line + "\n";
  return all;
}

constexpr const char* kRunsAlong = "the source's boundary runs along the domain's";

TEST(CheckOpenParameterization, PassesWhateverTheBoundaryIs) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const CheckReport report = check_parameterization(open.mesh, open.map);
    EXPECT_TRUE(report.passed()) << open.name << "\n" << text(report);
    ASSERT_NE(report.find(kRunsAlong), nullptr);
    const std::string loops = std::to_string(open.loops) + " loop";
    EXPECT_NE(report.find(kRunsAlong)->detail.find(loops), std::string::npos) << text(report);
  }
}

TEST(CheckOpenParameterization, FindsABoundaryVertexThatLeftTheBoundary) {
  fixtures::OpenSurface open = fixtures::triangle(4);
  for (DomainPoint& p : open.map.phi) {
    if (p.gamma() != 0 || corner_at(p) >= 0) continue;
    p = make_point(p.triangle, p.alpha - 0.03, p.beta);
    break;
  }
  EXPECT_EQ(broken_lines(check_parameterization(open.mesh, open.map)),
            (Names{kRunsAlong, "image areas add up to the domain's"}));
}

TEST(CheckOpenParameterization, FindsABoundaryThatIsSlidAlongASideOfTheDomainInside) {
  // The source is one triangle smaller, its domain isn't: it ends on a side with a neighbour.
  fixtures::OpenSurface open = fixtures::fan(2, 1);
  open.mesh.triangles.pop_back();
  const Names broken = broken_lines(check_parameterization(open.mesh, open.map));
  EXPECT_TRUE(broken.contains(kRunsAlong));
}

TEST(CheckOpenParameterization, FindsASourceEdgeThatCutsAcrossABentBoundary) {
  // A triangle's corner without a source vertex: the source has an edge from side to side there.
  fixtures::OpenSurface open = fixtures::triangle(2);
  std::erase_if(open.mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](VertexId v) { return corner_at(open.map.phi[v]) == 0; });
  });
  EXPECT_TRUE(broken_lines(check_parameterization(open.mesh, open.map)).contains(kRunsAlong));
}

TEST(CheckOpenParameterization, FindsABoundaryVertexOfTwoTrianglesWithoutASourceVertex) {
  fixtures::OpenSurface open = fixtures::hemisphere(4);
  for (DomainPoint& p : open.map.phi) {
    const DomainVertex v = vertex_at(open.map.domain, p);
    if (v < 0 || valences(open.map.domain)[v] != 2) continue;
    // Along the boundary side that leaves it.
    const DomainCorner corner = corner_of_each_vertex(open.map.domain)[v];
    std::array<double, 3> weights{};
    weights[corner.corner] = 0.9375;
    weights[(corner.corner + 1) % 3] = 0.0625;
    p = make_point(corner.triangle, weights[0], weights[1]);
    break;
  }
  const Names broken = broken_lines(check_parameterization(open.mesh, open.map));
  EXPECT_TRUE(broken.contains("a source vertex on every irregular domain vertex"));
  EXPECT_TRUE(broken.contains(kRunsAlong));
}

}  // namespace
}  // namespace lozenge
