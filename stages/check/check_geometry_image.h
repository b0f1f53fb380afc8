// What a geometry image promises, at every level of detail: a watertight mesh of the surface that it was sampled from.
#pragma once

#include "formats/patches/geometry_image.h"
#include "stages/check/check_report.h"

namespace lozenge {

CheckReport check_geometry_image(const GeometryImage& image);

}  // namespace lozenge
