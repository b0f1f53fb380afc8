// What moves an asset, and which animations it has: those that `--animation` counts.
#pragma once

#include "formats/surface/bodies.h"
#include "formats/surface/rig.h"

namespace lozenge {

class Facts;

void add_rig(Facts& facts, const Rig& rig);

/// What moves by itself or is placed more than once; nothing where all is one.
void add_bodies(Facts& facts, const Bodies& bodies);

}  // namespace lozenge
