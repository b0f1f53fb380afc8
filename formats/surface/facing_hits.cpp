// The second ray of a point ends where the first one met something, so that it is mostly short.
#include "formats/surface/facing_hits.h"

#include <algorithm>
#include <array>

namespace lozenge {

namespace {

/// Of at most a packet of points.
void look_both_ways(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                    std::span<RayHit> hits) {
  std::array<Ray, RayScene::kPacket> rays;
  std::array<RayHit, RayScene::kPacket> met;
  std::array<double, RayScene::kPacket> nearest;
  nearest.fill(cage);
  for (const double way : {1.0, -1.0}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [position, normal] = points[i];
      rays[i] = {position - normal * (way * tiny), normal * way, 0, nearest[i] + tiny};
    }
    scene.closest_hits({rays.data(), points.size()}, met);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // The normal leaves the surface, so it meets triangles that face its way from behind.
      if (!met[i].exists() || met[i].front == (way > 0)) continue;
      hits[i] = met[i];
      nearest[i] = std::max(0.0, met[i].distance - tiny);
    }
  }
}

}  // namespace

std::int64_t facing_hits(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                         std::span<RayHit> hits) {
  std::fill_n(hits.begin(), points.size(), RayHit());
  for (std::size_t first = 0; first < points.size(); first += RayScene::kPacket) {
    const std::size_t count = std::min(RayScene::kPacket, points.size() - first);
    look_both_ways(scene, points.subspan(first, count), cage, tiny, hits.subspan(first, count));
  }
  return 2 * static_cast<std::int64_t>(points.size());
}

}  // namespace lozenge
