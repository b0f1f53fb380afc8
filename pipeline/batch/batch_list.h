// The assets of a batch: where they are, and what is made of each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lozenge {

struct BatchItem {
  std::filesystem::path path;
  std::string asset;   ///< as the manifest calls it: below the folder, or as the list has it
  std::string output;  ///< below the output folder, without an ending: "rocks/boulder" for rocks/boulder.glb and others
  std::uint64_t bytes = 0;  ///< of the asset and its buffers: how much work it is, about
};

/// All files below `folder` that are called as assets are (.glb, .gltf, .ply, .obj, .stl, .off), but hidden ones, and
/// those in `without`. Outputs lie as the assets do; of assets that differ in nothing but the ending, outputs have it,
/// too. \throws Error(kUsage) where there is no such folder, or nothing in it
std::vector<BatchItem> items_in_folder(const std::filesystem::path& folder, const std::filesystem::path& without);

/// The assets that a list names, one a line; perhaps after a tab what its output is called. Empty lines and those that
/// begin with # are none. Without names outputs lie below the assets' common folder as the assets do.
/// \throws Error(kUsage) where the list can't be read, names none, or two outputs would be the same
std::vector<BatchItem> items_in_list(const std::filesystem::path& list);

/// A list that items_in_list reads back.
std::string list_text(const std::vector<BatchItem>& items);

/// The most work first, so that no long work begins last.
void sort_by_work(std::vector<BatchItem>& items);

/// How much of a batch's work an item is: what starting costs, too.
double work_of(const BatchItem& item);

/// In so many shards of about the same work, fewer where there are fewer items (Graham's rule: the largest first, each
/// to the shard that has least).
std::vector<std::vector<BatchItem>> in_shards(std::vector<BatchItem> items, std::size_t shards);

}  // namespace lozenge
