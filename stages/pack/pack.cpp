// Patches lie in the atlas row by row. A level takes every second sample of the finer one, so that all of them agree
// where they have samples; patches of first level k begin on level k with all of theirs.
#include "stages/pack/pack.h"

#include <algorithm>
#include <string>

#include "formats/base/error.h"

namespace lozenge {

namespace {

/// The smallest number whose square is at least `count`.
std::int32_t ceil_root(std::int32_t count) {
  std::int32_t root = 1;
  while (static_cast<std::int64_t>(root) * root < count) ++root;
  return root;
}

void require_complete(const PatchSet& patches) {
  const std::int32_t n = patches.layout.samples;
  const std::size_t count = patches.grids.size();
  if (patches.layout.places.empty() || n < 2 || ((n - 1) & (n - 2)) != 0 || patches.grids.patches() != patches.size() ||
      patches.positions.size() != count || patches.normals.size() != count ||
      patches.layout.adjacency.size() != patches.layout.places.size() ||
      (!patches.caps.empty() && patches.caps.size() != count) ||
      (!patches.influences.empty() && patches.influences.size() != kInfluences.components * count)) {
    throw Error(ExitCode::kInternal, "a patch set of " + std::to_string(patches.layout.places.size()) +
                                         " patches with " + std::to_string(n) + " samples a side is incomplete");
  }
}

/// The samples of all patches that exist on a level.
GeometryLevel make_level(const GeometryImage& image, const PatchSet& patches, std::int32_t number) {
  GeometryLevel level = image.empty_level(number, !patches.caps.empty(), !patches.influences.empty());
  for (std::int32_t patch = 0; patch < image.layout.count_on(number); ++patch) {
    const std::int32_t stride = std::int32_t{1} << (number - image.layout.first_level(patch));
    for (std::int32_t j = 0; j < level.samples; ++j) {
      for (std::int32_t i = 0; i < level.samples; ++i) {
        const std::size_t from = patches.index(patch, i * stride, j * stride);
        const std::size_t to = image.index(level, patch, i, j);
        level.positions[to] = patches.positions[from];
        level.normals[to] = patches.normals[from];
        if (!patches.caps.empty()) level.caps[to] = patches.caps[from];
        if (patches.influences.empty()) continue;
        std::copy_n(&patches.influences[kInfluences.components * from], kInfluences.components,
                    &level.influences[kInfluences.components * to]);
      }
    }
  }
  return level;
}

}  // namespace

std::int32_t atlas_columns(std::int32_t patches, const PackOptions& options) {
  return options.columns > 0 ? options.columns : ceil_root(patches);
}

GeometryImage pack(const PatchSet& patches, const PackOptions& options) {
  require_complete(patches);
  if (options.columns < 0 || options.columns > patches.size()) {
    throw Error(ExitCode::kUsage, "an atlas of " + std::to_string(options.columns) + " columns for " +
                                      std::to_string(patches.size()) + " patches; give 1 to " +
                                      std::to_string(patches.size()) + ", or 0 for the squarest picture");
  }
  GeometryImage image;
  image.layout = patches.layout;
  image.columns = atlas_columns(patches.size(), options);
  for (std::int32_t level = 0; (patches.layout.samples - 1) >> level > 0; ++level) {
    image.levels.push_back(make_level(image, patches, level));
  }
  return image;
}

}  // namespace lozenge
