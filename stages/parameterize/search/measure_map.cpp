// In the numbers that the energy is made of: d, and the T that belongs to the angles alone.
#include "stages/parameterize/search/measure_map.h"

#include "formats/domain/distortion.h"
#include "stages/parameterize/map/images.h"

namespace lozenge {

TraceRow measure_map(const WorkingMap& map) {
  TraceRow row;
  row.domain_faces = map.domain_faces;
  const double scale = map.scale();
  for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
    if (map.mesh.removed(t)) continue;
    const FlatImage p = flat_image(map, t);
    const RestShape& rest = map.rest[t];
    const double d = doubled_area(p) * rest.inverse_area * scale;
    double length = 0;
    for (int i = 0; i < 3; ++i) length += rest.weight[i] * (p[(i + 1) % 3] - p[(i + 2) % 3]).length2();
    if (!(d > 0)) continue;
    row.area += rest.share * ((d + 1 / d) / 2 - 1);
    row.angle += rest.share * (length * scale / (2 * d) - 1);
  }
  row.aggregate = aggregate_of(1 + row.area, 1 + row.angle);
  row.weighed = weighed_by_size(row.aggregate, row.domain_faces);
  return row;
}

}  // namespace lozenge
