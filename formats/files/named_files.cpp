#include "formats/files/named_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/base/content_hash.h"
#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/gltf_asset.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/readers/gltf/container.h"
#include "formats/files/readers/gltf/json.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/mtl.h"
#include "formats/files/readers/obj.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;

/// What a buffer or an image names; nothing where it holds its bytes itself, or names what no reader would open.
std::optional<fs::path> file_of(const GltfObject& object, const fs::path& folder) {
  const std::string uri = object.text("uri");
  if (uri.empty() || uri.starts_with("data:")) return std::nullopt;
  try {
    return resolve_gltf_uri(uri, folder, object.place());
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<fs::path> files_named_by_gltf(const fs::path& path) {
  const std::string name = file_name_of(path);
  MemoryBudget budget(0);
  const GltfContainer container = read_gltf_container(path, name, budget);
  const nlohmann::json document = parse_gltf_json(container.json, name);
  std::vector<fs::path> files;
  for (const char* list : {"buffers", "images"}) {
    for (const GltfObject& object : GltfObject(document, name).list(list, name + ": ", list)) {
      if (auto file = file_of(object, path.parent_path())) files.push_back(std::move(*file));
    }
  }
  return files;
}

std::vector<fs::path> each_once(std::vector<fs::path> files) {
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

}  // namespace

std::vector<fs::path> files_named_by(const fs::path& path) {
  try {
    const InputStart start = start_of(path);
    if (likeness_to_gltf(start) != Likeness::kNone) return each_once(files_named_by_gltf(path));
    if (likeness_to_obj(start) != Likeness::kNone) return each_once(files_named_by_obj(path));
    return {};
  } catch (const Error&) {
    return {};
  }
}

std::string content_hash_of_asset(const fs::path& path) {
  ContentHasher hasher;
  hasher.add_field(path.filename().string()).add_field(content_hash_of_file(path));
  for (const fs::path& file : files_named_by(path)) {
    std::error_code error;
    hasher.add_field(file.lexically_relative(path.parent_path()).string());
    hasher.add_field(fs::is_regular_file(file, error) ? content_hash_of_file(file) : "absent");
  }
  return hasher.finish();
}

}  // namespace lozenge
