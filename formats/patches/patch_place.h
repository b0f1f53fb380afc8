// Where a place of a patch lies on the domain (paper, Sec. 4.2).
#pragma once

#include "formats/domain/domain_point.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

/// The position of the place (u, v) of a patch (see `PatchPlace`), to the nearest lattice point: in the left
/// triangle where v >= u, else in the right one.
/// \pre  0 <= u, v <= 1, and v >= u where the patch has no right triangle
DomainPoint domain_point_at(const PatchPlace& place, double u, double v);

/// How (alpha, beta) of that position change with u and with v.
struct PlaceSteps {
  Vec2d along_u{0, 0};
  Vec2d along_v{0, 0};
};
PlaceSteps steps_at(const PatchPlace& place, double u, double v);

}  // namespace lozenge
