// Spheres and open surfaces as patches, geometry image, asset and map, made without the stages: for tests of whatever
// needs one.
#pragma once

#include <random>

#include "formats/domain/domain.h"
#include "formats/domain/open_fixtures.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_set.h"

namespace lozenge::fixtures {

/// The unit sphere over a platonic domain, 2^k + 1 samples a side; shared samples are the same bits.
/// \pre `base` is one of those in sphere_fixtures.h
PatchSet sphere_patches(const Domain& base, int k);
GeometryImage sphere_image(const Domain& base, int k);

/// Any surface with its map, without the stages: places are found on it one by one.
PatchSet open_patches(const OpenSurface& open, int k);
GeometryImage open_image(const OpenSurface& open, int k);

/// A layout that knows nothing but how many patches there are.
PatchLayout patches_of_one_scale(std::int32_t count);

/// Any order in which patches have tiles of their size.
TileOrder random_order(const MapLayout& layout, std::mt19937& random);

/// 3 x 2 tiles of 8 texels with a gutter of 1, all (0, 0, 1).
BakedMap flat_normal_map();

}  // namespace lozenge::fixtures
