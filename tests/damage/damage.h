// Small surfaces with what goes wrong in exporters, scanners and unit conversions: as many as there are seeds.
#pragma once

#include <cstdint>
#include <string>

#include "test_assets/gltf_writer.h"
#include "test_assets/shape.h"

namespace lozenge::damage {

struct DamagedSurface {
  test_assets::Shape shape;
  std::string story;  ///< what it was and what was done to it: "torus: 12 triangles turned over, moved by 1e6"
};

/// A surface of some hundred triangles after one to three kinds of damage, the same one for a seed everywhere.
DamagedSurface damaged_surface(std::uint32_t seed);

/// The surface as an asset: two of five stand still, one has a skin of three joints in some pose, one morph targets,
/// and one has both.
test_assets::Document damaged_document(const DamagedSurface& damaged, std::uint32_t seed);

}  // namespace lozenge::damage
