// Numbers of samples are tried from 2 up. Each try samples a finer grid, which is cheap for few samples, and dearer
// only for surfaces that need many.
#include "stages/sample/sample_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/nearest_point.h"

namespace lozenge {

namespace {

/// Steps of the grid that is measured at, for each of the one that is measured.
constexpr std::int32_t kFiner = 4;
/// More samples are not taken for a try: a grid of twice as many steps does, or none.
constexpr std::size_t kMostSamplesOfATry = 8'000'000;
/// The layout of a grid of `finer` times as many steps, whose parts begin on the same levels.
PatchLayout refined(PatchLayout layout, std::int32_t finer) {
  layout.samples = (layout.samples - 1) * finer + 1;
  return layout;
}

/// Sums of weighed squares of distances and of weights.
struct Tally {
  double squares = 0;
  double weight = 0;
};

/// A patch's fine samples against its grid of every `stride`-th of them.
class PatchDeviation {
 public:
  PatchDeviation(const PatchSet& fine, std::int32_t patch, std::int32_t stride)
      : fine_(fine), patch_(patch), stride_(stride), half_(!fine.layout.places[patch].right.exists()) {}

  Tally measured() const {
    Tally tally;
    const std::int32_t last = fine_.grids.samples(patch_) - 1;
    for (std::int32_t j = 0; j < last; j += stride_) {
      for (std::int32_t i = 0; i < (half_ ? j + 1 : last); i += stride_) add_quad(i, j, tally);
    }
    return tally;
  }

 private:
  Vec3d at(std::int32_t i, std::int32_t j) const { return Vec3d(fine_.positions[fine_.index(patch_, i, j)]); }

  /// The coarse quad from (i, j), split as `for_each_patch_triangle` does.
  void add_quad(std::int32_t i, std::int32_t j, Tally& tally) const {
    const std::int32_t s = stride_;
    if (half_ && i == j) {
      add_triangle(
          {at(i, j), at(i + s, j + s), at(i, j + s)}, i, j, [](auto x, auto y, auto) { return y >= x; }, tally);
      return;
    }
    add_triangle(
        {at(i, j), at(i + s, j), at(i, j + s)}, i, j, [](auto x, auto y, auto n) { return x + y <= n; }, tally);
    add_triangle(
        {at(i + s, j + s), at(i, j + s), at(i + s, j)}, i, j, [](auto x, auto y, auto n) { return x + y >= n; }, tally);
  }

  /// Adds the fine samples of a coarse triangle, corners left out: those are on it.
  template <typename Holds>
  void add_triangle(const std::array<Vec3d, 3>& corners, std::int32_t i, std::int32_t j, Holds holds,
                    Tally& tally) const {
    const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
    double sum = 0;
    std::int32_t count = 0;
    for (std::int32_t y = 0; y <= stride_; ++y) {
      for (std::int32_t x = 0; x <= stride_; ++x) {
        const bool corner = x % stride_ == 0 && y % stride_ == 0;
        if (corner || !holds(x, y, stride_)) continue;
        const Vec3d point = at(i + x, j + y);
        const Vec3d w = nearest_weights(point, corners);
        sum += (point_at(corners, w) - point).length2();
        ++count;
      }
    }
    tally.squares += area * sum / std::max(count, 1);
    tally.weight += area;
  }

  const PatchSet& fine_;
  std::int32_t patch_;
  std::int32_t stride_;
  bool half_;
};

/// In the asset's units. The root of the mean square: a few places that are far off are seen sooner than all that are a
/// little.
double deviation_of(const PatchSet& fine, std::int32_t stride) {
  std::vector<Tally> of_patch(static_cast<std::size_t>(fine.size()));
  for_each_index(of_patch.size(), true, [&](std::size_t p) {
    of_patch[p] = PatchDeviation(fine, static_cast<std::int32_t>(p), stride).measured();
  });
  Tally all;
  for (const Tally& tally : of_patch) {
    all.squares += tally.squares;
    all.weight += tally.weight;
  }
  return all.weight > 0 ? std::sqrt(all.squares / all.weight) : 0;
}

}  // namespace

SampleChoice choose_samples(const PatchSampler& sampler, double error, const Progress& progress) {
  if (!(error >= 0) || !std::isfinite(error)) {
    throw Error(ExitCode::kUsage, fmt::format("an error of {} percent is no distance; give 0 or more", error));
  }
  const double percent = 100 / std::max(diagonal(bounds_of(sampler.mesh().positions)), 1e-300);
  SampleChoice choice;
  for (std::int32_t n = 2; n <= kMostChosenSamples; n = 2 * n - 1) {
    PatchLayout layout = sampler.layout(n);
    if (n > 2 && layout.count_triangles(0) > worthwhile_triangles(layout.source_triangles)) break;
    std::int32_t finer = kFiner;
    while (finer > 1 && PatchGrids(refined(layout, finer), 0).size() > kMostSamplesOfATry) finer /= 2;
    if (finer == 1) break;
    const PatchSet fine = sampler.locate(refined(std::move(layout), finer), progress);
    choice = {n, percent * deviation_of(fine, finer)};
    if (choice.deviation <= error) break;
  }
  return choice;
}

}  // namespace lozenge
