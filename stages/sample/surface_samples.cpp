// Each patch is sampled alone (Sec. 6.0.1), then borders are copied from the one patch that owns them, so that both
// sides hold the same bits; at last, samples of different places that came out equal are told apart.
#include "stages/sample/surface_samples.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/patch_place.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/look_classes.h"
#include "stages/sample/boundary_corners.h"
#include "stages/sample/distinct.h"

namespace lozenge {

namespace {

void store(PatchSet& set, std::size_t index, const SurfaceSampler::Sample& s) {
  set.positions[index] = s.position;
  set.normals[index] = s.normal;
  set.source_triangles[index] = s.source.triangle;
  set.source_weights[index] = Vec3f(s.source.weights);
}

void copy(PatchSet& set, std::size_t from, std::size_t to) {
  set.positions[to] = set.positions[from];
  set.normals[to] = set.normals[from];
  set.source_triangles[to] = set.source_triangles[from];
  set.source_weights[to] = set.source_weights[from];
}

/// All samples of one patch but those of its sides 0 and 2, which belong to its neighbours' sides 1 and 3. Corners are
/// computed by every patch here; `copy_borders` keeps their owner's.
void sample_patch(const SurfaceSampler& sampler, PatchSet& set, std::int32_t patch) {
  const PatchPlace& place = set.layout.places[patch];
  const std::int32_t last = set.grids.samples(patch) - 1;
  for (std::int32_t j = 0; j <= last; ++j) {
    for (std::int32_t i = 0; i <= last; ++i) {
      if (!place.right.exists() && i > j) break;
      const bool inside_a_side = i > 0 && i < last;
      if (inside_a_side && (j == 0 || j == last)) continue;
      const DomainPoint at = domain_point_at(place, static_cast<double>(i) / last, static_cast<double>(j) / last);
      store(set, set.index(patch, i, j), sampler.at(at));
    }
  }
}

/// Moves the samples inside a half patch's diagonal into the boundary's corners beside them.
void snap_to_corners(const SurfaceSampler& sampler, const BoundaryCorners& corners, const Domain& domain, PatchSet& set,
                     std::int32_t patch) {
  const PatchPlace& place = set.layout.places[patch];
  const std::int32_t last = set.grids.samples(patch) - 1;
  if (place.right.exists() || last < 2) return;
  const auto middle = place_on_boundary(domain, domain_point_at(place, 0.5, 0.5));
  const auto first = place_on_boundary(domain, domain_point_at(place, 0.25, 0.25));
  if (!middle || !first) return;
  const bool ahead = first->along < middle->along;  // the diagonal runs as the side does
  std::vector<double> along;
  std::vector<Vec3f> regular;
  const auto sample_of = [&](std::int32_t n) { return set.index(patch, ahead ? n : last - n, ahead ? n : last - n); };
  for (std::int32_t n = 0; n <= last; ++n) {
    along.push_back(static_cast<double>(n) / last);
    regular.push_back(set.positions[sample_of(n)]);
  }
  const auto places = corners.places(middle->side, along, regular);
  for (std::int32_t n = 1; n < last; ++n) {
    if (places[n]) store(set, sample_of(n), sampler.at(*places[n]));
  }
}

std::size_t index_of(const PatchSet& set, const PatchSample& s) { return set.index(s.patch, s.i, s.j); }

/// Gives every patch the samples that others own. Sides 0 and 2 follow their neighbours; of a corner's names the lowest
/// patch's owns.
void copy_borders(PatchSet& set) {
  const PatchNeighbours neighbours(set.layout);
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (const int side : {0, 2}) {
      if (set.layout.adjacency[patch][side].patch < 0) continue;
      for (std::int32_t k = 1; k < neighbours.last(patch); ++k) {
        copy(set, index_of(set, neighbours.across({patch, side}, k)),
             index_of(set, neighbours.on_side({patch, side}, k)));
      }
    }
  }
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    for (int corner = 0; corner < 4; ++corner) {
      const PatchSample here = neighbours.corner_sample({patch, corner});
      if (!neighbours.exists(here)) continue;
      copy(set, index_of(set, owner_of(neighbours, here)), index_of(set, here));
    }
  }
}

/// [sample] 1 on a cap, else 0; nothing where no sample lies on one.
std::vector<std::uint32_t> marks_of_caps(const SourceMesh& mesh, const std::vector<TriangleId>& source_triangles) {
  std::vector<std::uint32_t> marks;
  if (mesh.cap_of.empty()) return marks;
  marks.reserve(source_triangles.size());
  for (const TriangleId t : source_triangles) marks.push_back(t >= 0 && is_cap(mesh, t) ? 1 : 0);
  if (std::find(marks.begin(), marks.end(), 1) == marks.end()) marks.clear();
  return marks;
}

/// Bodies share no vertex, so any sample of a patch says of which one it is.
Bodies bodies_of_patches(const SourceMesh& mesh, const PatchSet& set) {
  Bodies bodies;
  if (mesh.bodies.empty()) return bodies;
  bodies.bodies = mesh.bodies.bodies;
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    bodies.owner.push_back(mesh.bodies.owner_of(mesh.materials[set.source_triangles[set.index(patch, 0, 0)]]));
  }
  return bodies;
}

/// Samples that several patches share have the same source triangle and weights in all of them, and so the same joints.
std::vector<float> influences_of(const SourceMesh& mesh, const PatchSet& set) {
  std::vector<float> influences;
  const AttributeStream* corners = find_stream(mesh.corner_attributes, kInfluences);
  if (corners == nullptr || !mesh.bodies.has_skin()) return influences;
  constexpr std::size_t kWidth = kInfluences.components;
  influences.assign(kWidth * set.source_triangles.size(), 0.0F);
  for_each_index(set.source_triangles.size(), true, [&](std::size_t s) {
    const TriangleId t = set.source_triangles[s];
    if (t < 0) return;
    std::array<WeightedElement, 3> elements;
    for (std::size_t c = 0; c < 3; ++c) {
      elements[c] = {3 * static_cast<std::size_t>(t) + c, set.source_weights[s][static_cast<int>(c)]};
    }
    interpolate(*corners, elements, &influences[kWidth * s]);
  });
  return influences;
}

/// [patch] that of most of its samples; nothing where all are 0.
std::vector<MaterialClass> classes_of_patches(const SourceMesh& mesh, const PatchSet& set) {
  std::vector<MaterialClass> classes;
  const LookClasses looks = look_classes(mesh);
  if (looks.classes.size() == 1 && code_of(looks.classes.front()) == 0) return classes;
  for (std::int32_t patch = 0; patch < set.size(); ++patch) {
    std::array<std::int64_t, kMostMaterialClass + 1> count{};
    for (std::size_t s = set.grids.first(patch); s < set.grids.first(patch + 1); ++s) {
      const TriangleId t = set.source_triangles[s];
      if (t < 0) continue;
      ++count[code_of(looks.classes[looks.of(mesh, t)])];
    }
    classes.push_back(static_cast<MaterialClass>(std::max_element(count.begin(), count.end()) - count.begin()));
  }
  if (std::all_of(classes.begin(), classes.end(), [](MaterialClass c) { return c == 0; })) classes.clear();
  return classes;
}

}  // namespace

SurfaceSampler::SurfaceSampler(const SourceMesh& mesh, const Parameterization& map)
    : mesh_(mesh), locator_(mesh, map), normals_(mesh) {}

SurfaceSampler::Sample SurfaceSampler::at(const DomainPoint& place) const {
  const std::optional<SourcePoint> source = locator_.find(place);
  if (!source) {
    throw Error(ExitCode::kUnusableInput, mesh_.origin + ": the map leaves the place (" + std::to_string(place.alpha) +
                                              ", " + std::to_string(place.beta) + ") of domain triangle " +
                                              std::to_string(place.triangle) +
                                              " uncovered; parameterize the mesh again");
  }
  return at(*source);
}

SurfaceSampler::Sample SurfaceSampler::at(const SourcePoint& source) const {
  return {position_at(mesh_, source), without_negative_zeros(normals_.at(source.triangle, source.weights)), source};
}

PatchSampler::PatchSampler(const SourceMesh& mesh, const Parameterization& map)
    : mesh_(mesh), map_(map), sampler_(mesh, map), corners_(mesh, map) {}

PatchSet PatchSampler::locate(PatchLayout layout, const Progress& progress) const {
  const std::size_t count = PatchGrids(layout, 0).size();
  if (count > static_cast<std::size_t>(INT32_MAX)) {
    throw Error(ExitCode::kLimit, mesh_.origin + ": " + std::to_string(layout.size()) + " patches of " +
                                      std::to_string(layout.samples) +
                                      " samples a side are too many; take fewer samples");
  }
  PatchSet set = empty_patch_set(std::move(layout));
  for_each_index(set.size(), progress, "sampling", [&](std::size_t n) {
    const auto patch = static_cast<std::int32_t>(n);
    sample_patch(sampler_, set, patch);
    snap_to_corners(sampler_, corners_, map_.domain, set, patch);
  });
  copy_borders(set);
  return set;
}

PatchSet PatchSampler::sample(PatchLayout layout, const Progress& progress) const {
  PatchSet set = locate(std::move(layout), progress);
  make_distinct(set);
  set.caps = marks_of_caps(mesh_, set.source_triangles);
  set.layout.bodies = bodies_of_patches(mesh_, set);
  set.layout.material_classes = classes_of_patches(mesh_, set);
  set.influences = influences_of(mesh_, set);
  return set;
}

}  // namespace lozenge
