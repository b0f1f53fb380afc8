// T and d of a triangle are sums over its image's sides, weighed by its rest shape, and its area (`rest_shape.h`).
#include "stages/parameterize/map/map_energy.h"

#include <limits>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/images.h"

namespace lozenge {

double triangle_energy(const WorkingMap& map, TriangleId t, double scale) {
  const FlatImage p = flat_image(map, t);
  const RestShape& rest = map.rest[t];
  const double d = doubled_area(p) * rest.inverse_area * scale;
  if (!(d > 0)) return std::numeric_limits<double>::infinity();
  double length = 0;
  for (int i = 0; i < 3; ++i) length += rest.weight[i] * (p[(i + 1) % 3] - p[(i + 2) % 3]).length2();
  return rest.share * evaluate(map.energy, length * scale, d);
}

double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles, double scale) {
  double sum = 0;
  for (const TriangleId t : triangles) sum += triangle_energy(map, t, scale);
  return sum;
}

double total_energy(const WorkingMap& map) {
  const double scale = map.scale();
  return sum_of_parts(map.mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (auto t = static_cast<TriangleId>(begin); t < static_cast<TriangleId>(end); ++t) {
      if (!map.mesh.removed(t)) sum += triangle_energy(map, t, scale);
    }
    return sum;
  });
}

}  // namespace lozenge
