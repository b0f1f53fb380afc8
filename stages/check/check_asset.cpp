// What an engine relies on is checked on the arrays as they are; what the surface promises, on the triangles welded
// where positions have equal bits. Coarser levels must be of the finest one's topology.
#include "stages/check/check_asset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "formats/files/asset_places.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "formats/surface/turned_triangles.h"
#include "stages/check/check_adjacency.h"
#include "stages/check/check_level_textures.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

/// Rounding of three floats, and of what an exporter may round normals to.
constexpr double kUnitTolerance = 1e-5;
/// Tangents are made perpendicular in double and rounded to float.
constexpr double kPerpendicularTolerance = 1e-5;

std::string name_of(const Asset& asset, std::size_t level) {
  return fmt::format("level {} ({} triangles)", level, asset.levels[level].triangles.size());
}

bool check_indices(const Asset& asset, CheckReport& report) {
  Finding wrong;
  if (asset.levels.empty()) wrong.add([] { return std::string("there is no level of detail"); });
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const auto count = static_cast<VertexId>(level.positions.size());
    std::vector<bool> used(level.positions.size(), false);
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      for (const VertexId v : level.triangles[t]) {
        if (v < 0 || v >= count) {
          wrong.add([&] { return fmt::format("level {}, triangle {} names vertex {} of {}", l, t, v, count); });
        } else {
          used[v] = true;
        }
      }
    }
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) wrong.add([&] { return fmt::format("level {}, vertex {} belongs to no triangle", l, v); });
    }
  }
  wrong.report_to(report, "triangles name existing vertices, all of them",
                  fmt::format("{} levels", asset.levels.size()));
  return wrong.none();
}

bool check_attributes(const Asset& asset, CheckReport& report) {
  Finding missing;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const std::size_t n = level.positions.size();
    if (level.normals.size() != n || level.tangents.size() != n || level.uvs.size() != n) {
      missing.add([&] {
        return fmt::format("level {} has {} positions, {} normals, {} tangents, {} texture coordinates", l, n,
                           level.normals.size(), level.tangents.size(), level.uvs.size());
      });
    }
  }
  missing.report_to(report, "normals, tangents and texture coordinates at every vertex",
                    fmt::format("{} levels", asset.levels.size()));
  return missing.none();
}

void check_values(const Asset& asset, CheckReport& report) {
  Finding infinite, normals, tangents, leaning, uvs;
  // All three components may be off by as much.
  const double unit = kUnitTolerance + 1.01 * std::sqrt(3.0) * asset.rounding.direction;
  const double perpendicular = kPerpendicularTolerance + 2 * 1.01 * std::sqrt(3.0) * asset.rounding.direction;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    for (std::size_t v = 0; v < level.positions.size(); ++v) {
      const auto place = [&] { return fmt::format("level {}, vertex {}", l, v); };
      const Vec3d n(level.normals[v]);
      const Vec4f& t4 = level.tangents[v];
      const Vec3d t(t4.x, t4.y, t4.z);
      const Vec2f& uv = level.uvs[v];
      if (!is_finite(level.positions[v])) infinite.add(place);
      if (!(std::abs(n.length() - 1) <= unit)) normals.add(place);
      if (!(std::abs(t.length() - 1) <= unit) || (t4.w != 1 && t4.w != -1)) tangents.add(place);
      if (!(std::abs(n.dot(t)) <= perpendicular)) leaning.add(place);
      if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) uvs.add(place);
    }
  }
  const std::string levels = fmt::format("{} levels", asset.levels.size());
  infinite.report_to(report, "positions are finite", levels);
  normals.report_to(report, "normals are unit vectors", levels);
  tangents.report_to(report, "tangents are unit vectors with a sign", levels);
  leaning.report_to(report, "tangents are perpendicular to normals", levels);
  uvs.report_to(report, "texture coordinates lie in 0..1", levels);
}

/// [vertex] the part of the asset that it is of: each is in a space of its own.
std::vector<std::uint32_t> parts_of_vertices(const AssetLevel& level) {
  std::vector<std::uint32_t> parts(level.positions.size(), 0);
  for (std::size_t p = 0; p < level.parts.size(); ++p) {
    const auto first = parts.begin() + static_cast<std::ptrdiff_t>(level.parts[p].first_vertex);
    std::fill_n(first, level.parts[p].vertices, static_cast<std::uint32_t>(p));
  }
  return parts;
}

/// A position in a part, by its bits.
using PlaceInPart = std::array<std::uint32_t, 4>;

PlaceInPart place_in_part(std::uint32_t part, const Vec3f& position) {
  PlaceInPart place{part};
  std::memcpy(&place[1], &position, sizeof position);
  return place;
}

/// [vertex] the lowest one of its part at a position of the same bits.
std::vector<VertexId> joined_vertices(const AssetLevel& level) {
  const std::vector<std::uint32_t> part = parts_of_vertices(level);
  std::map<PlaceInPart, VertexId> known;
  std::vector<VertexId> joined(level.positions.size());
  for (std::size_t v = 0; v < joined.size(); ++v) {
    const auto place = place_in_part(part[v], level.positions[v]);
    joined[v] = known.emplace(place, static_cast<VertexId>(v)).first->second;
  }
  return joined;
}

/// The triangles over vertices that are joined wherever positions of one part have the same bits.
std::vector<std::array<VertexId, 3>> welded(const AssetLevel& level) {
  return renumbered(level.triangles, joined_vertices(level));
}

/// Coarser levels end in as many loops, at vertices where the finest one ends.
void check_loops(const Asset& asset, CheckReport& report) {
  Finding changed;
  std::size_t count = 0;
  std::set<PlaceInPart> places;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const std::vector<std::uint32_t> part = parts_of_vertices(level);
    const auto place = [&](VertexId v) { return place_in_part(part[v], level.positions[v]); };
    const std::vector<BoundarySide> sides = boundary_sides(welded(level));
    const std::size_t loops = boundary_loops(sides).size();
    if (l == 0) {
      count = loops;
      for (const BoundarySide& side : sides) places.insert(place(side[0]));
    }
    const bool kept = std::all_of(sides.begin(), sides.end(),
                                  [&](const BoundarySide& side) { return places.contains(place(side[0])); });
    if (loops != count || !kept) {
      changed.add([&] {
        return fmt::format("{} ends in {} loop(s){}, level 0 in {}", name_of(asset, l), loops, kept ? "" : " elsewhere",
                           count);
      });
    }
  }
  changed.report_to(report, "every level ends where the finest does", fmt::format("{} loop(s)", count));
}

/// Where caps are left out, levels end where samples lie on caps: at holes of their own, whose rims may touch.
void check_surfaces_without_caps(const Asset& asset, CheckReport& report) {
  Finding tangled;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const auto triangles = welded(asset.levels[l]);
    const MeshStatistics s = mesh_statistics({asset.levels[l].positions, triangles});
    if (s.tangled_edges == 0) continue;
    tangled.add([&] {
      return fmt::format("{} has {} edges of too many or turned triangles", name_of(asset, l), s.tangled_edges);
    });
  }
  tangled.report_to(report, "every level is oriented when welded by bits",
                    fmt::format("{} levels, {} triangles on caps left out", asset.levels.size(), asset.cap_triangles));
}

/// Levels that are fitted to the source, or its own triangles, have the edges that it has: as many loops of them on
/// each.
void check_surfaces_of_source(const Asset& asset, CheckReport& report) {
  Finding open, changed;
  std::int64_t euler = 0;
  std::size_t loops = 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const auto triangles = welded(level);
    const SurfaceView view{level.positions, triangles};
    const MeshStatistics s = mesh_statistics(view);
    const std::size_t here = boundary_loops(boundary_sides(triangles)).size();
    if (l == 0) {
      euler = s.euler;
      loops = here;
    }
    if (s.tangled_edges > 0 || s.pinched_vertices > 0 || here != loops || (asset.half_patches == 0 && here > 0)) {
      open.add([&] {
        return fmt::format(
            "{} ends in {} loop(s), level 0 in {}; {} edges of too many or turned triangles, {} pinched "
            "vertices",
            name_of(asset, l), here, loops, s.tangled_edges, s.pinched_vertices);
      });
    }
    if (s.euler != euler) {
      changed.add([&] { return fmt::format("{} has {}, level 0 has {}", name_of(asset, l), s.euler, euler); });
    }
  }
  open.report_to(
      report,
      asset.half_patches == 0 ? "every level is watertight when welded by bits"
                              : "every level is watertight but for its source's boundary when welded by bits",
      fmt::format("{} levels, {} triangles of level 0 the source's own", asset.levels.size(), asset.source_triangles));
  changed.report_to(report, "every level has the same Euler characteristic", std::to_string(euler));
}

/// In the atlas, triangles face the way they do on the surface; one may be a line, of coordinates rounded to floats.
void check_atlas(const Asset& asset, CheckReport& report) {
  // By which both ends of a side may have moved, across it.
  const double rounding = 1.0 / (1 << 23) + 2 * std::sqrt(2.0) * asset.rounding.texcoord;
  Finding folded;
  std::int64_t lines = 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const std::vector<std::uint32_t> part = parts_of_vertices(level);
    // In the space of a part that its place mirrors, triangles are turned.
    std::vector<bool> mirrored(level.parts.size() + 1, false);
    for (std::size_t p = 0; p < level.parts.size(); ++p) mirrored[p] = is_mirroring(level.parts[p].places.front());
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      const Vec2d a(level.uvs[level.triangles[t][0]]);
      const Vec2d b = Vec2d(level.uvs[level.triangles[t][1]]) - a;
      const Vec2d c = Vec2d(level.uvs[level.triangles[t][2]]) - a;
      const double area = mirrored[part[level.triangles[t][0]]] ? c.cross(b) : b.cross(c);
      const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
      if (!(area > 0)) ++lines;
      if (area < -rounding * longest) folded.add([&] { return fmt::format("{}, triangle {}", name_of(asset, l), t); });
    }
  }
  folded.report_to(report, "no triangle is folded in the atlas",
                   lines == 0 ? fmt::format("{} levels", asset.levels.size())
                              : fmt::format("{} levels, {} triangles are lines there", asset.levels.size(), lines));
}

/// In the rest pose, no triangle of a fitted level is turned against all of its neighbours: fitting may sharpen an
/// edge, but folds nothing over. What the source's own triangles do is the source's affair.
void check_turned_triangles(const Asset& asset, CheckReport& report) {
  constexpr double kWeightRounding = 8.0 / 65535;
  constexpr double kPositionRoundings = 4;
  Finding turned;
  std::size_t levels = 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    if (l == 0 && asset.source_triangles > 0) continue;
    ++levels;
    const AssetLevel shown = at_rest(asset.levels[l]);
    const auto triangles = renumbered(shown.triangles, joined_vertices(asset.levels[l]));
    // Weights of joints are of 16 bits.
    const double of_weights =
        asset.levels[l].influences.empty() ? 0 : kWeightRounding * diagonal(bounds_of(shown.positions));
    const double rounding = of_weights + kPositionRoundings * asset.rounding.position;
    for (const TriangleId t : turned_triangles({shown.positions, triangles}, rounding)) {
      turned.add([&] { return fmt::format("{}, triangle {}", name_of(asset, l), t); });
    }
  }
  turned.report_to(report, "no triangle is turned against its neighbours", fmt::format("{} levels", levels));
}

/// Of what a skin places: joints exist, weights add up to 1, and vertices at one place move alike.
void check_skins(const Asset& asset, CheckReport& report) {
  Finding wrong, torn;
  std::int64_t vertices = 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    if (level.influences.empty()) continue;
    const std::vector<VertexId> joined = joined_vertices(level);
    for (const AssetPart& part : level.parts) {
      if (part.joints.empty()) continue;
      for (std::size_t v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
        ++vertices;
        const auto place = [&] { return fmt::format("level {}, vertex {}", l, v); };
        const float* here = level.influence(v);
        const float last_joint = *std::max_element(here, here + kInfluences.components / 2);
        if (!is_influence(here) || is_unmoved(here) || last_joint >= static_cast<float>(part.joints.size())) {
          wrong.add(place);
        }
        if (!std::equal(here, here + kInfluences.components, level.influence(joined[v]))) torn.add(place);
      }
    }
  }
  if (vertices == 0) return;
  wrong.report_to(report, "joints exist, and their weights add up to 1", fmt::format("{} vertices", vertices));
  torn.report_to(report, "vertices at one place have the same joints and weights",
                 fmt::format("{} vertices", vertices));
}

/// Morph targets are finite, and take vertices at one place to one place.
void check_targets(const Asset& asset, CheckReport& report) {
  Finding wrong, torn;
  std::size_t most = 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    if (level.targets.empty()) continue;
    most = std::max(most, level.targets.size());
    const std::vector<VertexId> joined = joined_vertices(level);
    for (std::size_t t = 0; t < level.targets.size(); ++t) {
      const AssetTarget& target = level.targets[t];
      for (const auto* deltas : {&target.offsets, &target.normals, &target.tangents}) {
        for (std::size_t v = 0; v < deltas->size(); ++v) {
          const auto place = [&] { return fmt::format("level {}, target {}, vertex {}", l, t, v); };
          if (!is_finite((*deltas)[v])) wrong.add(place);
          const bool moves_along = deltas != &target.offsets || (*deltas)[v] == (*deltas)[joined[v]];
          if (!moves_along) torn.add(place);
        }
      }
    }
  }
  if (most == 0) return;
  wrong.report_to(report, "morph targets are finite", fmt::format("{} targets", most));
  torn.report_to(report, "morph targets move vertices at one place alike", fmt::format("{} targets", most));
}

void check_surfaces(const Asset& asset, CheckReport& report) {
  if (asset.cap_triangles > 0) return check_surfaces_without_caps(asset, report);
  if (asset.is_fitted || asset.source_triangles > 0) return check_surfaces_of_source(asset, report);
  Finding open, changed;
  std::int64_t euler = 0;
  const bool closed = asset.half_patches == 0;
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const auto triangles = welded(asset.levels[l]);
    const MeshStatistics s = mesh_statistics({asset.levels[l].positions, triangles});
    // The boundary is the diagonals of half patches. Files of before parts had scales say only how many of these there
    // are, with half as many steps from level to level.
    const std::int64_t steps = l < asset.boundary_sides.size()
                                   ? asset.boundary_sides[l]
                                   : std::int64_t{asset.half_patches} * (l < 31 ? (asset.samples - 1) >> l : 0);
    const bool boundary_fits = s.boundary_edges == steps && (closed || steps > 0);
    if (!boundary_fits || s.tangled_edges > 0 || s.pinched_vertices > 0) {
      open.add([&] {
        return fmt::format(
            "{} has {} boundary edges where {} are due, {} edges of too many or turned triangles, {} "
            "pinched vertices",
            name_of(asset, l), s.boundary_edges, steps, s.tangled_edges, s.pinched_vertices);
      });
    }
    if (l == 0) euler = s.euler;
    if (s.euler != euler) {
      changed.add([&] { return fmt::format("{} has {}, level 0 has {}", name_of(asset, l), s.euler, euler); });
    }
  }
  open.report_to(report,
                 closed ? "every level is watertight when welded by bits"
                        : "every level is watertight but for its source's boundary when welded by bits",
                 fmt::format("{} levels", asset.levels.size()));
  if (!closed && !asset.levels.empty()) check_loops(asset, report);
  changed.report_to(report, "every level has the same Euler characteristic", std::to_string(euler));
}

void check_materials(const Asset& asset, CheckReport& report) {
  Finding wrong;
  const auto materials = static_cast<std::int32_t>(asset.materials.size());
  const auto textures = static_cast<std::int32_t>(asset.textures.size());
  std::vector<bool> used(asset.materials.size(), false);
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    const AssetLevel& level = asset.levels[l];
    const bool named = level.material < materials && std::all_of(level.materials.begin(), level.materials.end(),
                                                                 [&](auto m) { return m < materials; });
    if (!named) wrong.add([&] { return fmt::format("level {} names a material that isn't there", l); });
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      const std::int32_t m = level.material_of(static_cast<TriangleId>(t));
      if (m >= 0 && m < materials) used[static_cast<std::size_t>(m)] = true;
    }
  }
  for (std::size_t n = 0; n < asset.materials.size(); ++n) {
    const AssetMaterial& m = asset.materials[n];
    if (!used[n]) wrong.add([&] { return fmt::format("material \"{}\" is on no level", m.name); });
    for (const std::int32_t t : m.textures) {
      if (t >= textures)
        wrong.add([&] { return fmt::format("material \"{}\" names a texture that isn't there", m.name); });
    }
  }
  std::string sizes = textures == 0 ? "no textures" : "decoded";
  for (const AssetTexture& t : asset.textures) {
    sizes += fmt::format(", {} x {} x {} of {} bits", t.width, t.height, t.channels, t.bits);
  }
  wrong.report_to(report, "materials are drawn, and their textures can be decoded", sizes);
}

void check_normal_maps(const Asset& asset, CheckReport& report) {
  Finding crooked;
  std::int64_t maps = 0;
  for (const AssetMaterial& m : asset.materials) {
    const std::int32_t normal = m.texture(MaterialSlot::kNormal);
    if (normal < 0 || normal >= static_cast<std::int32_t>(asset.textures.size())) continue;
    ++maps;
    const AssetTexture& map = asset.textures[normal];
    if (map.channels < 3) {
      crooked.add([&] { return fmt::format("normal map {} has {} channels", normal, map.channels); });
      continue;
    }
    // Each component is off by half a step of 2 / (2^bits - 1).
    const double tolerance = 1.01 * std::sqrt(3.0) / (std::pow(2.0, map.bits) - 1) + 1e-6;
    const std::size_t texels = static_cast<std::size_t>(map.width) * map.height;
    for (std::size_t i = 0; i < texels; ++i) {
      const float* texel = &map.pixels[i * map.channels];
      const Vec3d n(2.0 * texel[0] - 1, 2.0 * texel[1] - 1, 2.0 * texel[2] - 1);
      if (std::abs(n.length() - 1) <= tolerance) continue;
      crooked.add([&] {
        return fmt::format("texel ({}, {}) of normal map {} is {:.4f} long", i % map.width, i / map.width, normal,
                           n.length());
      });
    }
  }
  if (maps > 0) crooked.report_to(report, "normal maps hold unit vectors", "to a step of their bits");
}

}  // namespace

CheckReport check_asset(const Asset& asset) {
  CheckReport report;
  report.kind = "asset";
  if (!check_indices(asset, report)) return report;
  if (check_attributes(asset, report)) {
    check_values(asset, report);
    if (asset.is_fitted || asset.source_triangles > 0) check_atlas(asset, report);
    if (asset.is_fitted) check_turned_triangles(asset, report);
  }
  check_surfaces(asset, report);
  check_skins(asset, report);
  check_targets(asset, report);
  check_materials(asset, report);
  if (asset.is_fitted) check_level_textures(asset, report);
  check_normal_maps(asset, report);
  return report;
}

}  // namespace lozenge
