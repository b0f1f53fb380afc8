// Places along Morton's curve through the bounding box: the bits of a point's cell, interleaved.
#include "stages/parameterize/map/curve_order.h"

#include "formats/base/parallel.h"

namespace lozenge {

SpaceCurve::SpaceCurve(const Bounds& bounds) : low_(bounds.low) {
  const Vec3f size = bounds.high - bounds.low;
  longest_ = std::max({size.x, size.y, size.z, 1e-30F});
}

std::uint32_t SpaceCurve::place_of(const Vec3f& p) const {
  const Vec3f q = (p - low_) / longest_;
  const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp(x * 1023.0F, 0.0F, 1023.0F)); };
  return interleaved<3>({cell(q.x), cell(q.y), cell(q.z)});
}

std::vector<TriangleId> triangles_along_curve(const SourceMesh& mesh) {
  const SpaceCurve curve(bounds_of(mesh.positions));
  std::vector<std::pair<std::uint32_t, TriangleId>> places(mesh.triangles.size());
  for_each_part(places.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      places[t] = {curve.place_of(mesh.positions[mesh.triangles[t][0]]), static_cast<TriangleId>(t)};
    }
  });
  return numbers_by_key(std::move(places));
}

}  // namespace lozenge
