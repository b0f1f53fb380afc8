#include "stages/parameterize/domain_size.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

constexpr double kCut = 7.6;      // sqrt(F / T) times that: what cutting adds to each triangle
constexpr double kMargin = 0.84;  // some long edges stay split
constexpr double kMany = 50'000;
constexpr double kSome = 2'000;

/// How many triangles may be added to each.
double most_added_to_each(double triangles) {
  return kMargin * (triangles >= kMany ? 0.5 : triangles >= kSome ? 1.5 : 3.0);
}

}  // namespace

double added_by_cutting(double triangles, double faces) { return kCut * std::sqrt(triangles * faces); }

double most_added(double triangles) { return most_added_to_each(triangles) * triangles; }

FaceRange faces_for_source(std::int64_t triangles) {
  constexpr double kMost = 200;
  constexpr std::int32_t kLeast = 4;
  const auto count = static_cast<double>(triangles);
  const double light = std::pow(most_added_to_each(count) / kCut, 2) * count;
  const double most = count >= kMany ? kMost : std::min(kMost, light);
  const std::int32_t least = std::max(kLeast, static_cast<std::int32_t>(most / 2));
  return {least, std::max(least + 1, static_cast<std::int32_t>(most))};
}

}  // namespace lozenge
