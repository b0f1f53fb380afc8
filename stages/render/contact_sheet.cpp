// Each picture is the studio's (render.h), scaled to one size; a caption says in numbers what is to be seen.
#include "stages/render/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/base/error.h"
#include "formats/domain/distortion.h"
#include "formats/files/asset_places.h"
#include "formats/surface/boundary.h"
#include "stages/render/canvas.h"
#include "stages/render/source_studio.h"

namespace lozenge {

namespace {

const Vec3f kPaper = srgb(0xFBFAF8);
const Vec3f kInk = srgb(0x22262B);
const Vec3f kPaleInk = srgb(0x6B7280);

/// "52,000".
std::string grouped(std::int64_t n) {
  std::string digits = std::to_string(n);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

/// Coarse enough to see the triangles in a small picture, and what the maps add to them.
constexpr std::int64_t kTrianglesToSee = 15'000;

/// What the colours of the distortion mean, as a strip in the top right corner.
void draw_distortion_key(Picture& picture) {
  const std::int32_t width = picture.width / 4;
  const std::int32_t height = std::max(picture.height / 70, 4);
  const std::int32_t x0 = picture.width - width - picture.width / 24;
  const std::int32_t y0 = picture.height / 24;
  for (std::int32_t x = 0; x < width; ++x) {
    const double ratio = std::exp2(2.0 * x / (width - 1) - 1);
    fill_rectangle(picture, x0 + x, y0, 1, height, distortion_colour(ratio));
  }
  const double text = picture.height / 58.0;
  const double y = y0 + height + 1.9 * text;
  draw_text(picture, "1/2", {static_cast<double>(x0), y}, text, kPaleInk);
  draw_text(picture, "kept", {x0 + width / 2.0, y}, text, kPaleInk, Align::kCentre);
  draw_text(picture, "x 2", {static_cast<double>(x0 + width), y}, text, kPaleInk, Align::kRight);
}

/// The finest level of few enough triangles, or the coarsest.
std::int32_t level_to_see(const Asset& asset) {
  std::int32_t level = 0;
  while (level + 1 < static_cast<std::int32_t>(asset.levels.size()) &&
         static_cast<std::int64_t>(asset.levels[level].triangles.size()) > kTrianglesToSee) {
    ++level;
  }
  return level;
}

std::string size_of(const AssetLevel& level) {
  return fmt::format("{} triangles", grouped(static_cast<std::int64_t>(level.triangles.size())));
}

bool has_maps(const Asset& asset) {
  return std::any_of(asset.materials.begin(), asset.materials.end(), [](const AssetMaterial& material) {
    return material.texture(MaterialSlot::kNormal) >= 0 || material.texture(MaterialSlot::kOcclusion) >= 0;
  });
}

/// The edges of a level's triangles, or it without maps: smooth where vertices are at one place.
Picture draw_shape(const AssetLevel& level, bool wires, const RenderOptions& options) {
  const auto welded = renumbered(level.triangles, welded_vertices(level.positions));
  return render_surface({level.positions, welded}, wires, options);
}

}  // namespace

Picture contact_sheet(const std::vector<std::pair<std::string, Picture>>& pictures, std::int32_t columns,
                      const std::string& title) {
  columns = std::clamp<std::int32_t>(columns, 1, std::max<std::int32_t>(1, static_cast<std::int32_t>(pictures.size())));
  std::int32_t cell_width = 0;
  std::int32_t cell_height = 0;
  for (const auto& [caption, picture] : pictures) {
    cell_width = std::max(cell_width, picture.width);
    cell_height = std::max(cell_height, picture.height);
  }
  const std::int32_t unit = std::max(cell_width / 32, 4);  // everything else is in multiples of it
  const std::int32_t rows = (static_cast<std::int32_t>(pictures.size()) + columns - 1) / columns;
  const std::int32_t caption_height = 2 * unit + unit / 4;
  const std::int32_t head = title.empty() ? unit : 4 * unit;
  Picture sheet(unit + columns * (cell_width + unit), head + rows * (cell_height + caption_height) + unit / 2, kPaper);
  draw_text(sheet, title, {1.5 * unit, 2.55 * unit}, 1.05 * unit, kInk, Align::kLeft, true);
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    const auto column = static_cast<std::int32_t>(n) % columns;
    const auto row = static_cast<std::int32_t>(n) / columns;
    const std::int32_t x = unit + column * (cell_width + unit);
    const std::int32_t y = head + row * (cell_height + caption_height);
    paste(sheet, pictures[n].second, x, y);
    draw_text(sheet, pictures[n].first, {x + 0.5 * unit, y + cell_height + 1.35 * unit}, 0.62 * unit, kInk);
  }
  return sheet;
}

Picture preview(const SourceMesh& mesh, const Parameterization& map, Asset asset, std::int64_t source_triangles,
                const RenderOptions& options, std::vector<std::pair<std::string, Picture>> more,
                const SourceColour& colour) {
  const Distortion distortion = measure_distortion(mesh, map);
  if (asset.levels.empty()) throw Error(ExitCode::kUsage, "the asset has no level to draw");
  const std::int32_t seen = level_to_see(asset);
  const SourceStudio source(mesh, options);
  std::vector<std::pair<std::string, Picture>> pictures;
  pictures.emplace_back(fmt::format("source: {} triangles", grouped(source_triangles)), source.shaded(colour));
  pictures.emplace_back(
      fmt::format("domain: {} triangles, {} irregular vertices", map.domain.size(), count_irregular(map.domain)),
      source.patches(map));
  pictures.emplace_back(fmt::format("area distortion {:.4f}, angle {:.4f}, aggregate {:.4f}", distortion.area,
                                    distortion.angle, distortion.aggregate),
                        source.distortion(map));
  draw_distortion_key(pictures.back().second);
  const auto coarser = std::min<std::int32_t>(seen + 1, static_cast<std::int32_t>(asset.levels.size()) - 1);
  std::vector<std::string> names;  // before copies are added, which all are drawn
  for (std::size_t l = 0; l < asset.levels.size(); ++l) {
    names.push_back(fmt::format("level {}, {}", l, size_of(asset.levels[l])));
  }
  for (const std::int32_t l : std::set{seen, coarser}) asset.levels[l] = with_copies(asset.levels[l]);
  pictures.emplace_back(fmt::format("{}, of {} levels", names[seen], names.size()),
                        draw_shape(asset.levels[seen], true, options));
  const bool is_mapped = has_maps(asset);
  if (!is_mapped || coarser == seen) {
    pictures.emplace_back(names[seen] + ", without maps", draw_shape(asset.levels[seen], false, options));
  }
  for (std::int32_t l = seen; is_mapped && l <= coarser; ++l) {
    pictures.emplace_back(names[l] + ", with its maps", render_baked(asset, l, options));
  }
  for (auto& picture : more) pictures.push_back(std::move(picture));
  return contact_sheet(pictures, 3, mesh.scene_name);
}

}  // namespace lozenge
