// How different two surfaces look: what their materials say at points that correspond.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/textures.h"

namespace lozenge {

/// A surface, and its textures where it has any.
struct TexturedSurface {
  const SourceMesh* mesh = nullptr;
  const Textures* textures = nullptr;
};

/// Differences at all points.
struct ValueDifference {
  double mean = 0;
  double percentile_95 = 0;
  double max = 0;
  Vec3d worst{0, 0, 0};  ///< where on A the largest one is
};

struct MaterialComparison {
  ValueDifference base_colour;  ///< CIEDE2000
  ValueDifference alpha;        ///< all others from 0 to 1
  ValueDifference occlusion;
  ValueDifference roughness;
  ValueDifference metal;
  ValueDifference emissive;  ///< the largest of red, green, blue: linear light
  std::int64_t points = 0;
  double footprint = 0;  ///< what both are filtered over: a texel of B's finest texture, in the asset's units
};

/// At points spread by area over A, and the nearest points of B that face the same way (others where there are none
/// near): base colours with the vertices' colours, and all that the materials say of light.
/// \throws Error(kUnusableInput) where a surface has no triangle of positive area
MaterialComparison compare_materials(const TexturedSurface& a, const TexturedSurface& b, std::int64_t points,
                                     const Progress& progress = {});

/// As text lines, and as a JSON object {points, footprint, base_colour: {mean, percentile_95, max, worst}, ...}.
std::vector<std::string> material_lines(const MaterialComparison& comparison);
std::string material_json(const MaterialComparison& comparison);

}  // namespace lozenge
