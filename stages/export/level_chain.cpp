#include "stages/export/level_chain.h"

#include <algorithm>

namespace lozenge {

namespace {

/// From level to level triangles become fewer by this factor, where nothing else suggests itself,
constexpr std::int64_t kStep = 4;
/// and by 2 to this one where an image's level has about as many.
constexpr double kLargestStep = 5.7;

/// A chain whose length nobody names ends before fewer triangles than these.
constexpr std::int64_t kFewest = 200;

/// Enough for any chain that ends there: 4^12 * 200 triangles are more than a file holds.
constexpr std::size_t kMostLevels = 12;

}  // namespace

LevelChain::LevelChain(const GeometryImage& image, int finest, const ExportOptions& options)
    : image_(image), finest_(finest), options_(options) {}

std::int64_t LevelChain::finest_count() const {
  const std::int64_t wish =
      options_.triangle_budget > 0 ? options_.triangle_budget : image_.layout.count_triangles(finest_);
  // No level is heavier than the source, but one of samples that somebody asks for.
  if (options_.finest == Finest::kSamples) return wish;
  const std::int64_t source = image_.layout.source_triangles;
  return source > 0 ? std::min(wish, source) : wish;
}

std::size_t LevelChain::most_levels() const {
  if (!options_.coarser_levels && !options_.separate_files) return 1;
  if (options_.max_coarser_levels == kAsManyAsUseful) return kMostLevels;
  return 1 + static_cast<std::size_t>(std::max(options_.max_coarser_levels, 0));
}

bool LevelChain::wants(std::int64_t count) const {
  return count >= (options_.max_coarser_levels == kAsManyAsUseful ? kFewest : 1);
}

std::int64_t LevelChain::after(std::int64_t last) const {
  const std::int64_t source = image_.layout.source_triangles;
  const auto is_next = [&](std::int64_t count) {
    const bool is_step = 2 * count <= last && kLargestStep * static_cast<double>(count) >= static_cast<double>(last);
    return is_step && (source == 0 || count < source);
  };
  for (int level = finest_; options_.triangle_budget == 0 && level < static_cast<int>(image_.levels.size()); ++level) {
    const std::int64_t count = image_.layout.count_triangles(level);
    if (is_next(count)) return count;
  }
  const std::int64_t count = last / kStep;
  return source > 0 ? std::min(count, source / 2) : count;
}

}  // namespace lozenge
