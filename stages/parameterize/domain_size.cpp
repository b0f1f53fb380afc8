#include "stages/parameterize/domain_size.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

constexpr double kMany = 50'000;
constexpr double kSome = 2'000;

/// How many domain triangles there may be for each of the source's, where the source has so many.
double most_for_each(double triangles) {
  constexpr double kCut = 7.6;     // sqrt(F / T) times that: what cutting adds to each triangle
  constexpr double kMargin = 0.7;  // some long edges stay split
  const double more = triangles >= kMany ? 0.5 : triangles >= kSome ? 1.5 : 3.0;
  return kMargin * std::pow(more / kCut, 2);
}

FaceRange up_to(double most) {
  constexpr std::int32_t kLeast = 4;
  const std::int32_t least = std::max(kLeast, static_cast<std::int32_t>(most / 2));
  return {least, std::max(least + 1, static_cast<std::int32_t>(most))};
}

}  // namespace

FaceRange faces_for_source(std::int64_t triangles) {
  constexpr double kMost = 200;
  const auto count = static_cast<double>(triangles);
  return up_to(count >= kMany ? kMost : std::min(kMost, most_for_each(count) * count));
}

FaceRange faces_for_parts(std::int64_t all, std::int64_t triangles) {
  constexpr double kMost = 1000;  // patches take room
  return up_to(std::min(kMost, most_for_each(static_cast<double>(all)) * static_cast<double>(triangles)));
}

}  // namespace lozenge
