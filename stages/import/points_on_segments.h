// Which of many points lie on which of many segments.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

struct Segment {
  Vec3d start;
  Vec3d end;
  double tolerance = 0;  ///< how far a point on it may be away
};

/// Where a point lies that is near enough to a segment, as a share of the way from its start to its end; ends and what
/// is nearer to them than the tolerance are no part of it. Negative where it lies elsewhere.
double share_on_segment(const Segment& segment, const Vec3d& point);

/// Calls `found(segment, point)` for every point that may lie on a segment, and for some that don't: the caller looks
/// again. In the order of a search that halves the points' box until few are left; segments come along into the halves
/// that they run through. \param found  ends the search by false \return whether the search came to its end
bool for_each_point_near_segments(const std::vector<Segment>& segments, const std::vector<Vec3d>& points,
                                  const std::function<bool(std::int32_t segment, std::int32_t point)>& found);

}  // namespace lozenge
