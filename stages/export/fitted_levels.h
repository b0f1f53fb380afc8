// The levels of detail of a source whose map is known: its own triangles, and fewer and fewer that are fitted to it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/map_layout.h"
#include "formats/patches/patch_layout.h"
#include "formats/surface/ray_scene.h"
#include "stages/export/export.h"
#include "stages/export/simplify.h"

namespace lozenge {

class FittedLevels {
 public:
  /// Keeps references to the source and the patches.
  /// \param layout  of the atlas that texture coordinates are for
  /// \throws Error(kUnusableInput) where the map isn't the one that the patches were sampled from
  FittedLevels(const SourceSurface& source, const PatchLayout& patches, const MapLayout& layout);

  /// The source's own triangles, cut to the patches, with its normals (formats/patches/source_level.h).
  const ChartedSurface& source() const { return source_; }
  /// Its triangles, ready to be asked.
  const RayScene& scene() const { return *scene_; }

  /// At most so many triangles, or as few as there can be; their vertices fitted to the source. What corners carry are
  /// unit normals, one for each vertex: the source's mean around it. \pre no more triangles than of the level before
  ChartedSurface next(std::int64_t triangles);
  /// Whether the last one has more triangles than were asked for: fewer there can't be.
  bool has_ended() const { return has_ended_; }

 private:
  const SourceMesh* mesh_ = nullptr;
  const Bodies* bodies_ = nullptr;
  ChartedSurface source_;
  ChartedSurface fitted_to_;  ///< what levels are made of: the source, or less where it is much finer than they are
  std::vector<ChartScale> charts_;
  std::vector<float> importance_;    ///< [triangle of `fitted_to_`] weighs its distances
  std::vector<std::int32_t> parts_;  ///< [patch] the connected part that it belongs to
  bool has_ended_ = false;
  double least_height_ = 0;  ///< of a triangle in the atlas, in texels
  std::unique_ptr<RayScene> scene_;
  std::unique_ptr<Simplifier> simplifier_;
};

}  // namespace lozenge
