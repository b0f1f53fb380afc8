// Accessors and buffer views keep their numbers, so that nothing else has to change that names one. What is new takes
// the numbers of what is gone, then further ones.
#include "formats/files/gltf_rewrite.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/glb_container.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/readers/gltf/check.h"
#include "formats/files/readers/gltf/container.h"

namespace lozenge {

namespace {

using nlohmann::json;

template <typename Visit>
void visit_numbers(const json& object, const char* key, const Visit& visit) {
  if (object.contains(key) && object[key].is_number_integer()) visit(object[key].get<int>());
}

template <typename Visit>
void visit_attributes(const json& attributes, const Visit& visit) {
  for (const auto& [name, accessor] : attributes.items()) {
    if (accessor.is_number_integer()) visit(accessor.template get<int>());
  }
}

/// Every use of an accessor that glTF and the extensions that we know have.
template <typename Visit>
void visit_accessors(const json& document, const Visit& visit) {
  for (const json& mesh : document.value("meshes", json::array())) {
    for (const json& primitive : mesh.value("primitives", json::array())) {
      visit_attributes(primitive.value("attributes", json::object()), visit);
      visit_numbers(primitive, "indices", visit);
      for (const json& target : primitive.value("targets", json::array())) visit_attributes(target, visit);
    }
  }
  for (const json& animation : document.value("animations", json::array())) {
    for (const json& sampler : animation.value("samplers", json::array())) {
      visit_numbers(sampler, "input", visit);
      visit_numbers(sampler, "output", visit);
    }
  }
  for (const json& skin : document.value("skins", json::array())) visit_numbers(skin, "inverseBindMatrices", visit);
  for (const json& node : document.value("nodes", json::array())) {
    const json extensions = node.value("extensions", json::object());
    if (!extensions.contains("EXT_mesh_gpu_instancing")) continue;
    visit_attributes(extensions["EXT_mesh_gpu_instancing"].value("attributes", json::object()), visit);
  }
}

void drop_empty(json& object, const char* key) {
  if (object.contains(key) && object[key].empty()) object.erase(key);
}

void drop_from_list(json& document, const char* key, const std::string& name) {
  if (!document.contains(key) || !document[key].is_array()) return;
  json kept = json::array();
  for (const json& entry : document[key]) {
    if (entry != name) kept.push_back(entry);
  }
  document[key] = std::move(kept);
  drop_empty(document, key);
}

bool has_known_extensions(const json& document) {
  for (const json& extension : document.value("extensionsUsed", json::array())) {
    if (!extension.is_string() || !knows_gltf_extension(extension.get<std::string>())) return false;
  }
  return true;
}

json described(const AccessorBytes& values) {
  constexpr int kFloat = 5126;
  json accessor{{"componentType", values.component_type}, {"count", values.count}, {"type", values.type}};
  if (values.normalized) accessor["normalized"] = true;
  const auto bounds = [&](const std::vector<double>& numbers) {
    json list = json::array();
    for (const double x : numbers) list.push_back(values.component_type == kFloat ? json(x) : json(std::llround(x)));
    return list;
  };
  if (!values.min.empty()) accessor["min"] = bounds(values.min);
  if (!values.max.empty()) accessor["max"] = bounds(values.max);
  return accessor;
}

std::string mime_of(const std::vector<unsigned char>& bytes) {
  const auto starts_with = [&](const char* magic, std::size_t size, std::size_t at = 0) {
    return bytes.size() >= at + size && std::memcmp(bytes.data() + at, magic, size) == 0;
  };
  if (starts_with("\x89PNG", 4)) return "image/png";
  if (starts_with("\xFF\xD8", 2)) return "image/jpeg";
  if (starts_with("RIFF", 4) && starts_with("WEBP", 4, 8)) return "image/webp";
  if (starts_with("\xABKTX", 4)) return "image/ktx2";
  if (starts_with("DDS ", 4)) return "image/vnd-ms.dds";
  if (starts_with("ftypavif", 8, 4)) return "image/avif";
  return "application/octet-stream";
}

}  // namespace

GltfRewrite::GltfRewrite(GltfDocument& document) : document_(document) {
  // What was compressed isn't any more.
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    drop_from_list(json(), key, "EXT_meshopt_compression");
    drop_from_list(json(), key, "KHR_draco_mesh_compression");
  }
  may_reuse_ = has_known_extensions(json());
  count_uses();
}

void GltfRewrite::count_uses() {
  uses_.assign(json().value("accessors", nlohmann::json::array()).size(), 0);
  visit_accessors(json(), [&](int accessor) {
    if (accessor >= 0 && accessor < static_cast<int>(uses_.size())) ++uses_[accessor];
  });
}

void GltfRewrite::release(int accessor) {
  if (--uses_[accessor] > 0 || !may_reuse_) return;
  free_.insert(accessor);
}

int GltfRewrite::add(AccessorBytes values) {
  int number = static_cast<int>(json()["accessors"].size());
  if (free_.empty()) {
    json()["accessors"].push_back(nlohmann::json::object());
  } else {
    number = *free_.begin();
    free_.erase(free_.begin());
  }
  json()["accessors"][number] = described(values);
  new_.emplace_back(number, std::move(values));
  return number;
}

void GltfRewrite::take_in_images(const std::filesystem::path& folder) {
  if (!json().contains("images")) return;
  for (std::size_t i = 0; i < json()["images"].size(); ++i) {
    nlohmann::json& image = json()["images"][i];
    const std::string uri = image.value("uri", std::string());
    if (uri.empty() || uri.starts_with("data:")) continue;
    const std::string what = document_.file.name + ": image " + std::to_string(i);
    std::vector<unsigned char> bytes;
    {
      const std::filesystem::path path = resolve_gltf_uri(uri, folder, what);
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      if (error) throw Error(ExitCode::kUnusableInput, what + " (" + uri + ") can't be read: " + error.message());
      bytes = read_file_start(path, size, what + " (" + uri + ")");
    }
    image.erase("uri");
    image["mimeType"] = mime_of(bytes);
    new_images_.emplace_back(i, std::move(bytes));
  }
}

std::vector<bool> GltfRewrite::used_views() const {
  const nlohmann::json& document = *document_.json;
  std::vector<bool> used(document.value("bufferViews", nlohmann::json::array()).size(), !may_reuse_);
  const auto use = [&](int view) {
    if (view >= 0 && view < static_cast<int>(used.size())) used[view] = true;
  };
  for (const nlohmann::json& accessor : document.value("accessors", nlohmann::json::array())) {
    visit_numbers(accessor, "bufferView", use);
    if (!accessor.contains("sparse")) continue;
    visit_numbers(accessor["sparse"]["indices"], "bufferView", use);
    visit_numbers(accessor["sparse"]["values"], "bufferView", use);
  }
  for (const nlohmann::json& image : document.value("images", nlohmann::json::array())) {
    visit_numbers(image, "bufferView", use);
  }
  return used;
}

/// Puts what is used, and what is new, into one buffer.
std::vector<unsigned char> GltfRewrite::gather() {
  // Numbers that nobody wants: one zero each.
  for (const int accessor : free_)
    json()["accessors"][accessor] = {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
  std::vector<bool> used = used_views();
  std::vector<unsigned char> binary;
  const auto append = [&](const unsigned char* data, std::size_t size) {
    const std::size_t offset = (binary.size() + 3) / 4 * 4;
    binary.resize(offset + size);
    if (size > 0) std::memcpy(binary.data() + offset, data, size);
    return offset;
  };
  nlohmann::json& views = json()["bufferViews"];
  if (!views.is_array()) views = nlohmann::json::array();
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const std::vector<unsigned char>& from = document_.file.model->buffers[views[v]["buffer"].get<std::size_t>()].data;
    const auto offset = views[v].value("byteOffset", std::size_t{0});
    views[v]["byteOffset"] = append(from.data() + offset, views[v]["byteLength"].get<std::size_t>());
    views[v]["buffer"] = 0;
    drop_empty(views[v], "extensions");
  }
  std::size_t next = 0;
  const auto new_view = [&](const std::vector<unsigned char>& bytes) {
    while (next < used.size() && used[next]) ++next;
    if (next == views.size()) {
      views.push_back(nlohmann::json::object());
      used.push_back(true);
    }
    used[next] = true;
    views[next] = {{"buffer", 0}, {"byteOffset", append(bytes.data(), bytes.size())}, {"byteLength", bytes.size()}};
    return next;
  };
  for (auto& [accessor, values] : new_) {
    if (values.bytes.empty()) continue;
    const std::size_t view = new_view(values.bytes);
    if (values.stride > 0) views[view]["byteStride"] = values.stride;
    if (values.target > 0) views[view]["target"] = values.target;
    json()["accessors"][accessor]["bufferView"] = view;
    values.bytes = {};
  }
  for (auto& [image, bytes] : new_images_) json()["images"][image]["bufferView"] = new_view(bytes);
  // Numbers that are left over hold the first bytes again.
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    static constexpr std::array<unsigned char, 4> kZeros{};
    if (binary.empty()) append(kZeros.data(), kZeros.size());
    views[v] = {{"buffer", 0}, {"byteLength", std::min<std::size_t>(binary.size(), 4)}};
  }
  // From the end on, they needn't be there.
  while (!views.empty() && !used[views.size() - 1]) views.erase(views.size() - 1);
  drop_empty(json(), "bufferViews");
  return binary;
}

void GltfRewrite::write(const std::filesystem::path& path, const std::filesystem::path& folder) {
  take_in_images(folder);
  const std::vector<unsigned char> binary = gather();
  if (binary.empty()) json().erase("buffers");
  else json()["buffers"] = nlohmann::json::array({{{"byteLength", binary.size()}}});
  AtomicFile file(path);
  std::ofstream stream(file.temporary_path(), std::ios::binary);
  write_glb_container(stream, json().dump(), binary);
  stream.close();
  if (!stream) throw Error(ExitCode::kSystem, path.string() + ": can't be written: " + std::strerror(errno));
  file.commit();
}

}  // namespace lozenge
