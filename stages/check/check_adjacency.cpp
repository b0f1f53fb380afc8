// The neighbours of a patch's sides follow from where patches lie on the domain; what is stored must be that.
#include "stages/check/check_adjacency.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "stages/check/finding.h"

namespace lozenge {

namespace {

bool check_reciprocal(const std::vector<std::array<PatchSide, 4>>& adjacency, CheckReport& report) {
  Finding wrong;
  const auto count = static_cast<std::int32_t>(adjacency.size());
  for (std::int32_t p = 0; p < count; ++p) {
    for (std::int32_t s = 0; s < 4; ++s) {
      const PatchSide n = adjacency[p][s];
      if (n.patch == -1) continue;
      if (n.patch < 0 || n.patch >= count || n.side < 0 || n.side > 3) {
        wrong.add([&] {
          return fmt::format("patch {} side {} leads to side {} of patch {}, which does not exist", p, s, n.side,
                             n.patch);
        });
      } else if (!(adjacency[n.patch][n.side] == PatchSide{p, s})) {
        wrong.add([&] {
          const PatchSide back = adjacency[n.patch][n.side];
          return fmt::format("patch {} side {} leads to patch {} side {}, which leads to patch {} side {}", p, s,
                             n.patch, n.side, back.patch, back.side);
        });
      }
    }
  }
  wrong.report_to(report, "adjacency is reciprocal", fmt::format("{} patches, 4 sides each", count));
  return wrong.none();
}

bool check_against_domain(const std::vector<PatchPlace>& places, const std::vector<std::array<PatchSide, 4>>& adjacency,
                          CheckReport& report) {
  Finding wrong;
  if (const auto defect = find_place_defect(places)) {
    wrong.add([&] { return *defect; });
  } else {
    const std::vector<std::array<PatchSide, 4>> expected = patch_adjacency(places);
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (std::size_t s = 0; s < 4; ++s) {
        if (adjacency[p][s] == expected[p][s]) continue;
        wrong.add([&] {
          return fmt::format("patch {} side {} leads to patch {} side {}, on the domain to patch {} side {}", p, s,
                             adjacency[p][s].patch, adjacency[p][s].side, expected[p][s].patch, expected[p][s].side);
        });
      }
    }
  }
  wrong.report_to(report, "adjacency follows the domain", "every side of every domain triangle has one patch");
  return wrong.none();
}

}  // namespace

bool check_adjacency(const std::vector<PatchPlace>& places, const std::vector<std::array<PatchSide, 4>>& adjacency,
                     CheckReport& report) {
  if (adjacency.size() != places.size()) {
    report.add("adjacency is reciprocal", false,
               fmt::format("{} entries for {} patches", adjacency.size(), places.size()));
    return false;
  }
  return check_reciprocal(adjacency, report) && check_against_domain(places, adjacency, report);
}

std::array<std::int32_t, 2> sample_on_side(std::int32_t side, std::int32_t k, std::int32_t samples) {
  const std::int32_t last = samples - 1;
  switch (side) {
    case 0:
      return {k, 0};
    case 1:
      return {last, k};
    case 2:
      return {last - k, last};
    default:
      return {0, last - k};
  }
}

PatchedDomain domain_of_patches(const std::vector<PatchPlace>& places) {
  PatchedDomain facts;
  facts.edges = static_cast<std::int64_t>(places.size());
  std::set<DomainTriangleId> triangles;
  std::map<DomainVertex, std::int32_t> valence;
  std::set<DomainVertex> ends;
  for (const PatchPlace& place : places) {
    ++valence[place.a];
    ++valence[place.b];
    triangles.insert(place.left.triangle);
    if (place.right.exists()) triangles.insert(place.right.triangle);
    else {
      ++facts.half_patches;
      ends.insert({place.a, place.b});
    }
  }
  facts.vertices = static_cast<std::int64_t>(valence.size());
  facts.triangles = static_cast<std::int64_t>(triangles.size());
  facts.valence.assign(valence.empty() ? 0 : static_cast<std::size_t>(valence.rbegin()->first) + 1, 0);
  for (const auto& [vertex, count] : valence) {
    facts.valence[vertex] = count;
  }
  facts.on_boundary.assign(facts.valence.size(), false);
  for (const DomainVertex vertex : ends) facts.on_boundary[vertex] = true;
  for (const auto& [vertex, count] : valence) facts.irregular += facts.is_irregular(vertex);
  return facts;
}

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_unit(const Vec3f& v) {
  // Three components rounded to float, each off by at most 2^-25.
  constexpr double kTolerance = 1e-6;
  return std::abs(Vec3d(v).length() - 1) <= kTolerance;
}

bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof(Vec3f)) == 0; }

}  // namespace lozenge
