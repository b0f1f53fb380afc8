// What a patch set promises: samples that know their source, and equal bits on both sides of a border.
#pragma once

#include "formats/patches/patch_set.h"
#include "stages/check/check_report.h"

namespace lozenge {

CheckReport check_patch_set(const PatchSet& patches);

}  // namespace lozenge
