// How many triangles the levels of detail of an asset are to have.
#pragma once

#include <cstdint>

#include "formats/patches/geometry_image.h"
#include "stages/export/export.h"

namespace lozenge {

/// From the finest level down by a factor of about four. Where nobody names a budget, counts are those of the image's
/// levels as long as there are any.
class LevelChain {
 public:
  /// Keeps references. \param finest  level of the image
  LevelChain(const GeometryImage& image, int finest, const ExportOptions& options);

  /// Of the finest level, where that is none of the source's own triangles.
  std::int64_t finest_count() const;

  /// How many triangles are wanted after a level of so many, or after a wish for so many that came to nothing.
  std::int64_t after(std::int64_t last) const;

  /// Whether a coarser level of so many triangles is wanted. A number of levels that somebody names goes as far down as
  /// triangles can get; else the chain ends at some hundred.
  bool wants(std::int64_t count) const;

  /// How many levels there may be at most.
  std::size_t most_levels() const;

 private:
  const GeometryImage& image_;
  int finest_;
  const ExportOptions& options_;
};

}  // namespace lozenge
