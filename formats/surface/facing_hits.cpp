// The second ray of a point ends where the first one met something, so that it is mostly short.
#include "formats/surface/facing_hits.h"

#include <algorithm>
#include <array>

namespace lozenge {

namespace {

/// Of a packet's points, those that may still meet something nearer, by their numbers.
struct Pending {
  std::array<std::size_t, RayScene::kPacket> point{};
  std::array<Ray, RayScene::kPacket> rays;
  std::size_t count = 0;
};

/// Of at most a packet of points, one way. \param layers  surfaces behind one another that are looked at
template <typename Counts>
void look_one_way(const RayScene& scene, std::span<const OrientedPoint> points, double way, double tiny, int layers,
                  const Counts& counts, std::array<double, RayScene::kPacket>& nearest, std::span<RayHit> hits) {
  Pending pending;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [position, normal] = points[i];
    pending.point[pending.count] = i;
    pending.rays[pending.count++] = {position - normal * (way * tiny), normal * way, 0, nearest[i] + tiny};
  }
  std::array<RayHit, RayScene::kPacket> met;
  for (int layer = 0; layer < layers && pending.count > 0; ++layer) {
    scene.closest_hits({pending.rays.data(), pending.count}, met);
    std::size_t left = 0;
    for (std::size_t k = 0; k < pending.count; ++k) {
      if (!met[k].exists()) continue;
      const std::size_t i = pending.point[k];
      // The normal leaves the surface, so it meets triangles that face its way from behind.
      if (met[k].front != (way > 0) && counts(i, met[k].triangle)) {
        hits[i] = met[k];
        nearest[i] = std::max(0.0, met[k].distance - tiny);
        continue;
      }
      pending.point[left] = i;
      pending.rays[left] = pending.rays[k];
      pending.rays[left++].nearest = met[k].distance + tiny;
    }
    pending.count = left;
  }
}

/// \param counts  of the number of a point and a triangle
template <typename Counts>
void look_both_ways(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny, int layers,
                    const Counts& counts, std::span<RayHit> hits) {
  std::fill_n(hits.begin(), points.size(), RayHit());
  for (std::size_t first = 0; first < points.size(); first += RayScene::kPacket) {
    const std::size_t count = std::min(RayScene::kPacket, points.size() - first);
    std::array<double, RayScene::kPacket> nearest;
    nearest.fill(cage);
    const auto counts_of_packet = [&](std::size_t i, TriangleId t) { return counts(first + i, t); };
    for (const double way : {1.0, -1.0}) {
      look_one_way(scene, points.subspan(first, count), way, tiny, layers, counts_of_packet, nearest,
                   hits.subspan(first, count));
    }
  }
}

}  // namespace

void facing_hits_through(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                         const std::function<bool(std::size_t, TriangleId)>& counts, std::span<RayHit> hits) {
  constexpr int kMostLayers = 6;
  look_both_ways(scene, points, cage, tiny, kMostLayers, counts, hits);
}

std::int64_t facing_hits(const RayScene& scene, std::span<const OrientedPoint> points, double cage, double tiny,
                         std::span<RayHit> hits) {
  look_both_ways(
      scene, points, cage, tiny, 1, [](std::size_t, TriangleId) { return true; }, hits);
  return 2 * static_cast<std::int64_t>(points.size());
}

}  // namespace lozenge
