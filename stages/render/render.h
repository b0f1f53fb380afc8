// Pictures of every stage, traced with Embree on the CPU: no display, no GPU, the same bytes every time.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/files/asset_file.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/surface_view.h"
#include "stages/render/picture.h"

namespace lozenge {

struct RenderOptions {
  std::int32_t width = 960;  ///< pixels
  std::int32_t height = 960;
  std::int32_t subsamples = 3;  ///< a side of a pixel: 3 means 9 rays
  /// From the middle of the object towards the camera; y is up. The object is framed by its bounding sphere's
  /// silhouette.
  Vec3f direction{0.55f, 0.35f, 1.0f};
};

/// Plain clay, smooth normals.
Picture render_shaded(const SourceMesh& mesh, const RenderOptions& options);
Picture render_shaded(const GeometryImage& image, std::int32_t level, const RenderOptions& options);
/// Each triangle of the domain in its own colour; neighbours differ.
Picture render_patches(const SourceMesh& mesh, const Parameterization& map, const RenderOptions& options);
/// Each patch in its own colour; neighbours differ.
Picture render_patches(const GeometryImage& image, std::int32_t level, const RenderOptions& options);
/// White where the map keeps areas, towards pure blue where it shrinks them, pure red where it expands them, full at a
/// factor 2 (paper, Fig. 9).
Picture render_distortion(const SourceMesh& mesh, const Parameterization& map, const RenderOptions& options);
/// The edges of a level's triangles as thin lines over the shaded surface (paper, Fig. 8).
Picture render_wires(const GeometryImage& image, std::int32_t level, const RenderOptions& options);
/// What an engine shows: a level of detail shaded by its normal map (and occlusion, where there is one).
Picture render_baked(const GeometryImage& image, std::int32_t level, const BakedMaps& maps,
                     const RenderOptions& options);
Picture render_baked(const Asset& asset, std::int32_t level, const RenderOptions& options);
/// Any surface, shaded with its own smooth normals, with its edges on request.
Picture render_surface(const SurfaceView& surface, bool wires, const RenderOptions& options);

/// The colour of an area ratio image/surface (both as shares of their totals): 1 white, 1/2 and less blue, 2 and more
/// red.
Vec3f distortion_colour(double ratio);

/// Pictures of one size with a caption under each, `columns` side by side, under a title.
Picture contact_sheet(const std::vector<std::pair<std::string, Picture>>& pictures, std::int32_t columns,
                      const std::string& title);

/// The contact sheet that `build` leaves as NAME.preview.png: the source, its domain triangles, the distortion; and a
/// level of detail (`level`, or a coarser one where that has more triangles than can be told apart): its wires, bare,
/// and with its baked maps. \param source_triangles  before edges of `mesh` were split for the map
/// \throws Error(kUsage) where there is no such level
Picture preview(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image, const BakedMaps& maps,
                std::int32_t level, std::int64_t source_triangles, const RenderOptions& options);

}  // namespace lozenge
