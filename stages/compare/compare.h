// The distance between two surfaces, both ways, and between the normals that a viewer sees on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/files/asset_file.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/surface_view.h"

namespace lozenge {

struct CompareOptions {
  /// Points spread over each surface by area. The largest distance also counts all vertices.
  std::int64_t points = 200'000;
};

/// From the points of one surface to the nearest points of the other.
struct OneWayDistance {
  double mean = 0;          ///< over the points spread by area, asset's units
  double max = 0;           ///< over those points and all vertices
  double mean_percent = 0;  ///< of the diagonal of A's bounding box
  double max_percent = 0;
};

struct Comparison {
  OneWayDistance a_to_b;
  OneWayDistance b_to_a;
  double diagonal = 0;  ///< of A's bounding box

  /// Where the surfaces end: loops of sides that have one triangle, and how far the boundary of either is from that of
  /// the other at most, along all of it. The distances mean something where both have one.
  std::int64_t boundary_loops_a = 0;
  std::int64_t boundary_loops_b = 0;
  double boundary_a_to_b = 0;  ///< asset's units
  double boundary_b_to_a = 0;

  bool both_end() const { return boundary_loops_a > 0 && boundary_loops_b > 0; }
  double boundary_max_percent() const {
    return 100 * (boundary_a_to_b > boundary_b_to_a ? boundary_a_to_b : boundary_b_to_a) / diagonal;
  }
  double mean_percent() const {
    return a_to_b.mean_percent > b_to_a.mean_percent ? a_to_b.mean_percent : b_to_a.mean_percent;
  }
  double max_percent() const {
    return a_to_b.max_percent > b_to_a.max_percent ? a_to_b.max_percent : b_to_a.max_percent;
  }
};

/// Distances both ways, in percent of A's box diagonal; boundaries apart. The same bits on any number of threads.
/// \pre triangles that hang together share vertices: the two sides of a cut lie on each other, and each is a boundary,
/// so positions can't tell. The vertices of an asset, which are others for each patch, are to be welded before.
/// \throws Error(kUnusableInput) where a surface has no triangle of positive area
Comparison compare(const SurfaceView& a, const SurfaceView& b, const CompareOptions& options = {},
                   const Progress& progress = {});

/// Angles between normals, in radians.
struct NormalComparison {
  double mean = 0;
  double percentile_95 = 0;
  double max = 0;
  std::int64_t points = 0;
};

/// At points spread by area over one level of the asset: the normal that an engine computes there (interpolated tangent
/// frame, bilinear normal map) against the source's interpolated normal at the nearest source point.
NormalComparison compare_normals(const Asset& asset, std::int32_t level, const SourceMesh& source,
                                 const CompareOptions& options = {}, const Progress& progress = {});

/// As text lines and as a JSON object {diagonal, a_to_b: {mean, max, mean_percent, max_percent}, b_to_a: {...},
/// mean_percent, max_percent}. Where a surface has a boundary also boundary_loops {a, b} and
/// boundary_max_distance_percent: of both ways, or null where the other surface is closed.
std::vector<std::string> comparison_lines(const Comparison& comparison);
std::string comparison_json(const Comparison& comparison);

}  // namespace lozenge
