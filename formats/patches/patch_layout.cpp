// Every triangle is cut by the segments from its corners to its barycentre into the halves of three patches. Each
// segment lies between two of them, which is all that adjacency is.
#include "formats/patches/patch_layout.h"

#include <bit>
#include <utility>

#include "formats/domain/first_levels.h"

namespace lozenge {

namespace {

std::string name(std::size_t patch) { return "patch " + std::to_string(patch); }

/// How often the steps between samples can be halved.
std::int32_t last_level(std::int32_t samples) {
  return std::countr_zero(static_cast<std::uint32_t>(std::max(samples, 2) - 1));
}

}  // namespace

std::vector<PatchPlace> patch_places(const Domain& domain) {
  std::vector<PatchPlace> places;
  for (const DomainSide left : edges(domain)) {
    places.push_back({domain.start(left), domain.end(left), left, domain.neighbour(left)});
  }
  return places;
}

PatchLayout patch_layout(const SourceMesh& mesh, const Parameterization& map, std::int32_t samples) {
  PatchLayout layout;
  layout.samples = samples;
  layout.places = patch_places(map.domain);
  layout.adjacency = patch_adjacency(layout.places);
  for (std::size_t p = 0; !map.first_levels.empty() && p < layout.places.size(); ++p) {
    layout.first_levels.push_back(std::min(map.first_level(layout.places[p].left.triangle), last_level(samples)));
  }
  if (layout.first_levels.empty() || layout.first_levels.back() == 0) layout.first_levels.clear();
  layout.bounds = bounds_of(mesh.positions);
  layout.source_triangles =
      map.source_triangles > 0 ? map.source_triangles : static_cast<std::int64_t>(mesh.triangles.size());
  layout.scene_name = mesh.scene_name;
  layout.origin = mesh.origin;
  layout.double_sided = is_double_sided(mesh);
  layout.translation = mesh.translation;
  return layout;
}

std::optional<std::string> find_first_level_defect(const PatchLayout& layout) {
  if (layout.first_levels.empty()) return std::nullopt;
  std::vector<std::array<std::int32_t, 2>> touching;
  for (std::int32_t p = 0; p < layout.size(); ++p) {
    for (const PatchSide& side : layout.adjacency[p]) {
      if (side.patch >= 0) touching.push_back({p, side.patch});
    }
  }
  return find_first_level_defect(layout.first_levels, layout.places.size(), last_level(layout.samples), "patch",
                                 touching);
}

std::vector<PatchHalf> patch_halves(const std::vector<PatchPlace>& places) {
  std::size_t count = 0;
  for (const PatchPlace& place : places) count += place.right.exists() ? 2 : 1;
  std::vector<PatchHalf> halves(count);
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto patch = static_cast<std::int32_t>(p);
    const auto& [left, right] = std::pair{places[p].left, places[p].right};
    halves[3 * static_cast<std::size_t>(left.triangle) + left.side] = {patch, true};
    if (right.exists()) halves[3 * static_cast<std::size_t>(right.triangle) + right.side] = {patch, false};
  }
  return halves;
}

std::vector<std::array<PatchSide, 4>> patch_adjacency(const std::vector<PatchPlace>& places) {
  std::vector<std::array<PatchSide, 4>> adjacency(places.size());
  const std::vector<PatchHalf> halves = patch_halves(places);
  for (std::size_t h = 0; h < halves.size(); ++h) {
    // Both halves meet along the segment from corner h % 3 of triangle h / 3.
    const PatchSide starting = halves[h].at_start();
    const PatchSide ending = halves[h - h % 3 + (h + 2) % 3].at_end();
    adjacency[starting.patch][starting.side] = ending;
    adjacency[ending.patch][ending.side] = starting;
  }
  return adjacency;
}

std::optional<std::string> find_place_defect(const std::vector<PatchPlace>& places) {
  std::size_t count = 0;
  for (const PatchPlace& place : places) count += place.right.exists() ? 2 : 1;
  if (count % 3 != 0) return "the patches' sides don't make up whole triangles";
  std::vector<std::array<DomainVertex, 2>> ends(count, {-1, -1});
  for (std::size_t p = 0; p < places.size(); ++p) {
    const PatchPlace& place = places[p];
    if (place.a < 0 || place.b < 0 || place.a == place.b) return name(p) + " does not join two vertices";
    for (const bool left : {true, false}) {
      const DomainSide side = left ? place.left : place.right;
      if (!left && side == DomainSide{}) continue;
      if (side.triangle < 0 || side.side < 0 || side.side > 2 || static_cast<std::size_t>(side.triangle) >= count / 3) {
        return name(p) + " lies on a side of a triangle that does not exist";
      }
      auto& [start, end] = ends[3 * static_cast<std::size_t>(side.triangle) + side.side];
      if (start >= 0) return name(p) + " lies on a side that another patch has, too";
      start = left ? place.a : place.b;
      end = left ? place.b : place.a;
    }
  }
  for (std::size_t h = 0; h < count; ++h) {
    if (ends[h][1] != ends[h - h % 3 + (h + 1) % 3][0]) {
      return "the patches on the sides of triangle " + std::to_string(h / 3) + " disagree about its corners";
    }
  }
  return std::nullopt;
}

}  // namespace lozenge
