#include "pipeline/batch/batch_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "formats/base/error.h"
#include "formats/files/named_files.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

bool is_called_an_asset(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const std::set<std::string> endings{".glb", ".gltf", ".ply", ".obj", ".stl", ".off"};
  return endings.contains(ending) && !path.filename().string().starts_with('.');
}

std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

std::uint64_t bytes_of(const fs::path& asset) {
  std::uint64_t bytes = size_of(asset);
  for (const fs::path& file : files_named_by(asset)) {
    if (file.extension() == ".bin") bytes += size_of(file);  // images are no work but reading them
  }
  return bytes;
}

std::string without_ending(const fs::path& path) { return fs::path(path).replace_extension().generic_string(); }

/// Gives each item without an output one: its place below the common folder.
/// \param places  [item] that place
void name_outputs(std::vector<BatchItem>& items, const std::vector<fs::path>& places) {
  std::map<std::string, int> uses;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (items[k].output.empty()) ++uses[without_ending(places[k])];
  }
  std::set<std::string> taken;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (items[k].output.empty()) {
      const std::string name = without_ending(places[k]);
      items[k].output = uses[name] > 1 ? places[k].generic_string() : name;
    }
    if (!taken.insert(items[k].output).second) {
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: the outputs of two assets would be called {}; give them names in a "
                              "list, after a tab",
                              items[k].asset, items[k].output));
    }
  }
}

/// The folder that all are in.
fs::path common_folder(const std::vector<BatchItem>& items) {
  fs::path common = fs::absolute(items.front().path).lexically_normal().parent_path();
  for (const BatchItem& item : items) {
    const fs::path folder = fs::absolute(item.path).lexically_normal().parent_path();
    fs::path both;
    auto [a, b] = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end());
    for (auto part = common.begin(); part != a; ++part) both /= *part;
    common = both;
  }
  return common;
}

/// Names that stay below the output folder.
void require_sound_output(const std::string& output, const fs::path& list) {
  const fs::path path(output);
  const bool climbs = std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (!output.empty() && (climbs || path.is_absolute() || !path.has_filename())) {
    throw Error(ExitCode::kUsage, fmt::format("{}: '{}' can't be the name of an output; write one as rocks/boulder",
                                              list.string(), output));
  }
}

BatchItem item_of_line(const std::string& line, const fs::path& list) {
  const std::size_t tab = line.find('\t');
  BatchItem item{line.substr(0, tab), line.substr(0, tab), tab == std::string::npos ? "" : line.substr(tab + 1), 0};
  require_sound_output(item.output, list);
  item.bytes = bytes_of(item.path);
  return item;
}

}  // namespace

std::vector<BatchItem> items_in_folder(const fs::path& folder, const fs::path& without) {
  std::error_code error;
  std::vector<fs::path> files;
  fs::recursive_directory_iterator entry(folder, error);
  if (error) throw Error(ExitCode::kUsage, folder.string() + ": can't be read: " + error.message());
  for (const fs::recursive_directory_iterator end; entry != end; entry.increment(error)) {
    if (error) throw Error(ExitCode::kUsage, folder.string() + ": can't be read: " + error.message());
    std::error_code ignored;
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    if (entry->is_directory(ignored) && (is_hidden || fs::equivalent(entry->path(), without, ignored))) {
      entry.disable_recursion_pending();
    }
    if (entry->is_regular_file(ignored) && is_called_an_asset(entry->path())) files.push_back(entry->path());
  }
  if (files.empty()) throw Error(ExitCode::kUsage, folder.string() + ": there are no assets in this folder");
  std::sort(files.begin(), files.end());
  std::vector<BatchItem> items;
  std::vector<fs::path> places;
  for (const fs::path& file : files) {
    places.push_back(file.lexically_relative(folder));
    items.push_back({file, places.back().generic_string(), "", bytes_of(file)});
  }
  name_outputs(items, places);
  return items;
}

std::vector<BatchItem> items_in_list(const fs::path& list) {
  std::ifstream file(list);
  if (!file) throw Error(ExitCode::kUsage, list.string() + ": there is no such folder or list of assets");
  std::vector<BatchItem> items;
  std::set<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#' || !lines.insert(line).second) continue;
    items.push_back(item_of_line(line, list));
  }
  if (items.empty()) throw Error(ExitCode::kUsage, list.string() + ": names no assets; write one a line");
  const fs::path common = common_folder(items);
  std::vector<fs::path> places;
  for (const BatchItem& item : items)
    places.push_back(fs::absolute(item.path).lexically_normal().lexically_relative(common));
  name_outputs(items, places);
  return items;
}

std::string list_text(const std::vector<BatchItem>& items) {
  std::string text;
  for (const BatchItem& item : items)
    text += fs::absolute(item.path).lexically_normal().string() + "\t" + item.output + "\n";
  return text;
}

void sort_by_work(std::vector<BatchItem>& items) {
  std::stable_sort(items.begin(), items.end(),
                   [](const BatchItem& a, const BatchItem& b) { return a.bytes > b.bytes; });
}

double work_of(const BatchItem& item) {
  // Starting, and maps of the usual size, cost as much as a mesh of so many bytes.
  constexpr double kOfAnyAsset = 500'000;
  return kOfAnyAsset + static_cast<double>(item.bytes);
}

std::vector<std::vector<BatchItem>> in_shards(std::vector<BatchItem> items, std::size_t shards) {
  sort_by_work(items);
  std::vector<std::vector<BatchItem>> made(std::min(shards, items.size()));
  std::set<std::pair<double, std::size_t>> loads;
  for (std::size_t k = 0; k < made.size(); ++k) loads.insert({0.0, k});
  for (BatchItem& item : items) {
    auto [load, k] = *loads.begin();
    loads.erase(loads.begin());
    loads.insert({load + work_of(item), k});
    made[k].push_back(std::move(item));
  }
  return made;
}

}  // namespace lozenge
