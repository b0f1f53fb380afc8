#include "formats/files/readers/gltf/json.h"

#include <algorithm>

namespace lozenge {

using nlohmann::json;

namespace {

/// Deeper than what any exporter nests (extras and extensions included), shallower than what a stack stands.
constexpr int kDeepest = 100;

/// How deep the brackets of a text are nested, found without a parser. (A callback of nlohmann's parser could count,
/// but with one the parser walks over all elements of a list whenever another is complete: minutes for a hundred
/// thousand.)
int depth_of(const std::string& text) {
  int depth = 0;
  int deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size() && deepest <= kDeepest; ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (c == '\\' && quoted) ++i;
    if (quoted) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

}  // namespace

json parse_gltf_json(const std::string& text, const std::string& name) {
  if (depth_of(text) > kDeepest) {
    throw Error(ExitCode::kUnusableInput,
                name + ": its JSON is nested deeper than " + std::to_string(kDeepest) + " levels");
  }
  try {
    json document = json::parse(text);
    if (!document.is_object()) throw Error(ExitCode::kUnusableInput, name + ": its JSON is not an object");
    return document;
  } catch (const json::exception& e) {
    throw Error(ExitCode::kUnusableInput, name + ": its JSON is broken (" + e.what() + "); export the file again");
  }
}

GltfObject::GltfObject(const json& value, std::string place) : value_(&value), place_(std::move(place)) {
  if (!value.is_object()) broken("is not a JSON object");
}

void GltfObject::broken(const std::string& problem) const {
  throw Error(ExitCode::kUnusableInput, place_ + ": " + problem);
}

void GltfObject::unsupported(const std::string& problem) const {
  throw Error(ExitCode::kUnsupported, place_ + ": " + problem);
}

std::uint64_t GltfObject::as_whole(const json& value, const std::string& key, std::uint64_t most) const {
  if (!value.is_number_unsigned()) broken(key + " is not a whole number from 0 up");
  const auto number = value.get<std::uint64_t>();
  if (number > most) broken(key + " is " + std::to_string(number) + ", more than " + std::to_string(most));
  return number;
}

std::optional<std::uint64_t> GltfObject::whole(const char* key, std::uint64_t most) const {
  const auto at = value_->find(key);
  if (at == value_->end()) return std::nullopt;
  return as_whole(*at, key, most);
}

std::optional<std::uint64_t> GltfObject::whole_or_none(const char* key) const {
  const auto at = value_->find(key);
  if (at == value_->end() || !at->is_number_unsigned()) return std::nullopt;
  return at->get<std::uint64_t>();
}

std::uint64_t GltfObject::required_whole(const char* key, std::uint64_t most) const {
  const auto number = whole(key, most);
  if (!number) broken(std::string(key) + " is missing");
  return *number;
}

std::optional<std::uint64_t> GltfObject::index(const char* key, std::uint64_t count) const {
  const auto number = whole(key);
  if (number && *number >= count) {
    broken(std::string(key) + " is " + std::to_string(*number) + ", but there are " + std::to_string(count));
  }
  return number;
}

std::uint64_t GltfObject::required_index(const char* key, std::uint64_t count) const {
  const auto number = index(key, count);
  if (!number) broken(std::string(key) + " is missing");
  return *number;
}

std::string GltfObject::text(const char* key) const {
  const auto at = value_->find(key);
  if (at == value_->end()) return {};
  if (!at->is_string()) broken(std::string(key) + " is not a text");
  return at->get<std::string>();
}

std::vector<std::string> GltfObject::texts(const char* key) const {
  std::vector<std::string> found;
  const auto at = value_->find(key);
  if (at == value_->end()) return found;
  if (!at->is_array()) broken(std::string(key) + " is not a list");
  for (const json& item : *at) {
    if (!item.is_string()) broken(std::string(key) + " holds something that is not a text");
    found.push_back(item.get<std::string>());
  }
  return found;
}

std::vector<GltfObject> GltfObject::list(const char* key, const std::string& prefix, const std::string& noun) const {
  std::vector<GltfObject> found;
  const auto at = value_->find(key);
  if (at == value_->end()) return found;
  if (!at->is_array()) broken(std::string(key) + " is not a list");
  found.reserve(at->size());
  for (const json& item : *at) found.emplace_back(item, prefix + noun + " " + std::to_string(found.size()));
  return found;
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const auto at = value_->find(key);
  if (at == value_->end()) return std::nullopt;
  return GltfObject(*at, place_ + ", " + key);
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
  const auto extensions = value_->find("extensions");
  if (extensions == value_->end()) return std::nullopt;
  if (!extensions->is_object()) broken("extensions is not a JSON object");
  const auto at = extensions->find(name);
  if (at == extensions->end()) return std::nullopt;
  return GltfObject(*at, place_ + ", " + name);
}

}  // namespace lozenge
