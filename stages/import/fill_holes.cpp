// A loop is walked against the triangles beside it, which is the way around its cap. Attributes are taken from the
// corner of the triangle whose side starts there.
#include "stages/import/fill_holes.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/canonical_form.h"
#include "formats/surface/surface_facts.h"
#include "stages/import/cap_polygon.h"
#include "stages/import/pieces.h"

namespace lozenge {

namespace {

/// Of a hemisphere the cap has half the area, of a flat flake all of it.
constexpr double kMostOfPiece = 0.8;

HalfEdge previous_in_triangle(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }

class HoleFiller {
 public:
  HoleFiller(SourceMesh& mesh, std::vector<HalfEdge> twins, RepairReport& report)
      : mesh_(mesh), twins_(std::move(twins)), report_(report), place_(mesh.positions.size(), -1) {}

  void run(double longest) {
    const std::vector<std::vector<HalfEdge>> loops = find_loops(longest);
    if (loops.empty()) return;
    areas_ = piece_areas(mesh_);
    for (const auto& loop : loops) fill(loop);
    if (caps_.empty()) return;
    append_caps();
    make_canonical(mesh_);
  }

 private:
  /// A corner of a cap: the corner of the mesh that its attributes are those of, or none at a new vertex.
  struct CapCorner {
    VertexId vertex = -1;
    HalfEdge like = -1;
  };
  struct Cap {
    std::vector<std::array<CapCorner, 3>> triangles;
    std::vector<HalfEdge> loop;
    std::int32_t material = -1;
  };

  /// Boundary half-edges, each loop in the order in which they follow each other, of loops that are short enough.
  std::vector<std::vector<HalfEdge>> find_loops(double longest) const {
    std::vector<HalfEdge> leaving(mesh_.positions.size(), -1);  // [vertex] the boundary half-edge that starts there
    for (std::size_t h = 0; h < twins_.size(); ++h) {
      if (twins_[h] < 0) leaving[half_edge_start(mesh_, static_cast<HalfEdge>(h))] = static_cast<HalfEdge>(h);
    }
    std::vector<std::vector<HalfEdge>> loops;
    std::vector<bool> seen(twins_.size(), false);
    for (std::size_t i = 0; i < twins_.size(); ++i) {
      if (twins_[i] >= 0 || seen[i]) continue;
      std::vector<HalfEdge> loop;
      double length = 0;
      for (auto h = static_cast<HalfEdge>(i); !seen[h]; h = leaving[half_edge_end(mesh_, h)]) {
        seen[h] = true;
        loop.push_back(h);
        length += (position(half_edge_end(mesh_, h)) - position(half_edge_start(mesh_, h))).length();
      }
      if (loop.size() >= 3 && length <= longest) loops.push_back(std::move(loop));
    }
    return loops;
  }

  void fill(std::vector<HalfEdge> loop) {
    std::reverse(loop.begin(), loop.end());
    std::vector<Vec3d> corners;
    for (const HalfEdge h : loop) corners.push_back(position(half_edge_start(mesh_, h)));
    const double piece = areas_[half_edge_start(mesh_, loop.front())];
    std::optional<PolygonCap> polygon;
    if (loop.size() <= kMostSidesOfCap) polygon = cap_polygon(corners, missing_edges(loop));
    Cap cap;
    const auto corner = [&](std::size_t i) { return CapCorner{half_edge_start(mesh_, loop[i]), loop[i]}; };
    double area = 0;
    if (polygon) {
      area = polygon->area;
      for (const auto& [a, b, c] : polygon->triangles) cap.triangles.push_back({corner(a), corner(b), corner(c)});
    } else {
      const Vec3d middle = std::accumulate(corners.begin(), corners.end(), Vec3d(0, 0, 0)) / double(corners.size());
      const auto fresh = static_cast<VertexId>(mesh_.positions.size() + middles_.size());
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::size_t next = (i + 1) % loop.size();
        area += (corners[i] - middle).cross(corners[next] - middle).length() / 2;
        cap.triangles.push_back({corner(i), corner(next), CapCorner{fresh, -1}});
      }
      if (area <= kMostOfPiece * piece) middles_.push_back(without_negative_zeros(Vec3f(middle)));
    }
    if (area > kMostOfPiece * piece) return;
    cap.material = most_frequent_material(loop);
    report_.add(RepairKind::kFilledHoles, mesh_.positions[half_edge_start(mesh_, loop.back())]);
    cap.loop = std::move(loop);
    caps_.push_back(std::move(cap));
  }

  /// Whether two corners of the loop have no edge yet.
  std::function<bool(std::int32_t, std::int32_t)> missing_edges(const std::vector<HalfEdge>& loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) place_[half_edge_start(mesh_, loop[i])] = static_cast<std::int32_t>(i);
    std::vector<bool> joined(n * n, false);
    for (std::size_t i = 0; i < n; ++i) {
      // Once around the fan: the other ends of all edges but the first, which is the loop's own.
      for (HalfEdge h = loop[i]; h >= 0; h = twins_[previous_in_triangle(h)]) {
        const std::int32_t k = place_[half_edge_start(mesh_, previous_in_triangle(h))];
        if (k >= 0) joined[i * n + k] = joined[k * n + i] = true;
      }
    }
    for (const HalfEdge h : loop) place_[half_edge_start(mesh_, h)] = -1;
    return [joined = std::move(joined), n](std::int32_t i, std::int32_t k) {
      return !joined[static_cast<std::size_t>(i) * n + k];
    };
  }

  std::int32_t most_frequent_material(const std::vector<HalfEdge>& loop) const {
    if (mesh_.materials.empty()) return 0;
    std::map<std::int32_t, int> times;
    for (const HalfEdge h : loop) ++times[mesh_.materials[h / 3]];
    return std::max_element(times.begin(), times.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  /// The material of caps in a surface of this one.
  std::int32_t cap_material(std::int32_t material) {
    if (mesh_.cap_of.empty()) mesh_.cap_of.assign(mesh_.material_names.size(), -1);
    if (mesh_.cap_of[material] >= 0) return material;
    const auto known = std::find(mesh_.cap_of.begin(), mesh_.cap_of.end(), material);
    if (known != mesh_.cap_of.end()) return static_cast<std::int32_t>(known - mesh_.cap_of.begin());
    mesh_.cap_of.push_back(material);
    mesh_.material_names.push_back("cap of " + mesh_.material_names[material]);
    if (!mesh_.material_looks.empty()) mesh_.material_looks.push_back(Material(mesh_.material_looks[material]));
    if (!mesh_.double_sided.empty()) mesh_.double_sided.push_back(mesh_.double_sided[material]);
    if (!mesh_.bodies.empty()) mesh_.bodies.owner.push_back(mesh_.bodies.owner[material]);
    return static_cast<std::int32_t>(mesh_.cap_of.size()) - 1;
  }

  void append_caps() {
    if (mesh_.materials.empty()) {
      mesh_.material_names = {"default"};
      mesh_.materials.assign(mesh_.triangles.size(), 0);
    }
    mesh_.positions.insert(mesh_.positions.end(), middles_.begin(), middles_.end());
    for (const Cap& cap : caps_) {
      append_attributes(cap);
      const std::int32_t material = cap_material(cap.material);
      for (const auto& triangle : cap.triangles) {
        mesh_.triangles.push_back({triangle[0].vertex, triangle[1].vertex, triangle[2].vertex});
        mesh_.materials.push_back(material);
      }
    }
  }

  /// A new vertex has what lies between those around the loop.
  void append_attributes(const Cap& cap) {
    std::vector<WeightedElement> around;
    for (const HalfEdge h : cap.loop) around.push_back({static_cast<std::size_t>(h), 1});
    const AttributeStreams middle = interpolated(mesh_.corner_attributes, around);
    for (const auto& triangle : cap.triangles) {
      for (const CapCorner& corner : triangle) {
        const bool is_copy = corner.like >= 0;
        append_element(mesh_.corner_attributes, is_copy ? mesh_.corner_attributes : middle,
                       is_copy ? static_cast<std::size_t>(corner.like) : 0);
      }
    }
  }

  Vec3d position(VertexId v) const { return Vec3d(mesh_.positions[v]); }

  SourceMesh& mesh_;
  std::vector<HalfEdge> twins_;
  RepairReport& report_;
  std::vector<std::int32_t> place_;  ///< [vertex] its place in the loop that is looked at, or -1
  std::vector<double> areas_;        ///< [vertex] of its piece
  std::vector<Cap> caps_;
  std::vector<Vec3f> middles_;  ///< new vertices
};

}  // namespace

void fill_holes(SourceMesh& mesh, double percent, RepairReport& report) {
  if (!(percent > 0)) return;
  std::vector<HalfEdge> twins = link_half_edges(mesh).twins;
  if (std::all_of(twins.begin(), twins.end(), [](HalfEdge twin) { return twin >= 0; })) return;
  HoleFiller(mesh, std::move(twins), report).run(percent / 100 * diagonal(bounds_of(mesh.positions)));
}

}  // namespace lozenge
