// A geometry image as arrays of numbers (docs/data.md): what solvers and learners read. No glTF, no engine.
//
// Patches of a first level k > 0 have fewer samples than others, so that no one array holds all. They come in the order
// of their first levels: each first level has arrays of its own, called NAME for 0 and NAME.k for all others.
#pragma once

#include <vector>

#include "formats/files/named_array.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_set.h"
#include "stages/export/export.h"

namespace lozenge {

/// Where samples lie on the source.
struct SampleSources {
  const SourceMesh* mesh = nullptr;  ///< whose triangles are meant
  const PatchSet* samples = nullptr;
};

/// Level 0 of the image, each patch with all samples that it has; coarser levels are every second sample. Of maps the
/// texels inside of patches, without gutters: floats, colours linear.
/// \param sources  null where nobody knows
/// \throws Error(kUnusableInput) where a map is of another atlas than the image, or the samples aren't the image's;
/// Error(kUnsupported) where texels of a coarser map lie across borders of tiles
std::vector<NamedArray> patch_arrays(const GeometryImage& image, const BakedMaps& maps,
                                     const SampleSources* sources = nullptr);

}  // namespace lozenge
