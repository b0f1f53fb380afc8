// A glTF document's JSON, read with every type and range checked, in messages that name the place.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/base/error.h"

namespace lozenge {

/// The document of this text.
/// \throws Error(kUnusableInput) where it isn't JSON, isn't an object, or is nested deeper than any asset is (libraries
///         that read it recurse)
nlohmann::json parse_gltf_json(const std::string& text, const std::string& name);

/// An object of the document, and how messages call it: "statue.gltf: accessor 3".
class GltfObject {
 public:
  /// \throws Error(kUnusableInput) where `value` isn't an object
  GltfObject(const nlohmann::json& value, std::string place);

  const std::string& place() const { return place_; }
  bool has(const char* key) const { return value_->contains(key); }

  /// A whole number from 0 to `most`; nothing where the key is absent.
  std::optional<std::uint64_t> whole(const char* key, std::uint64_t most = kMost) const;
  /// The same, or `otherwise`.
  std::uint64_t whole_or(const char* key, std::uint64_t otherwise) const { return whole(key).value_or(otherwise); }
  /// The same, and it must be there.
  std::uint64_t required_whole(const char* key, std::uint64_t most = kMost) const;
  /// The same; nothing where it is something else, too.
  std::optional<std::uint64_t> whole_or_none(const char* key) const;
  /// An index into a list of `count`; nothing where the key is absent.
  std::optional<std::uint64_t> index(const char* key, std::uint64_t count) const;
  std::uint64_t required_index(const char* key, std::uint64_t count) const;
  /// Empty where the key is absent.
  std::string text(const char* key) const;
  std::vector<std::string> texts(const char* key) const;
  /// The objects of a list, called "<noun> 0", "<noun> 1", ... after `prefix`; empty where the key is absent.
  std::vector<GltfObject> list(const char* key, const std::string& prefix, const std::string& noun) const;
  /// Nothing where the key is absent.
  std::optional<GltfObject> object(const char* key) const;
  /// The extension of this name; nothing where the object hasn't got it.
  std::optional<GltfObject> extension(const char* name) const;
  /// The value itself, for walking over keys.
  const nlohmann::json& value() const { return *value_; }

  [[noreturn]] void broken(const std::string& problem) const;
  [[noreturn]] void unsupported(const std::string& problem) const;

  /// Larger counts and offsets make no sense in files of at most 4 GB, and sums of them can't overflow.
  static constexpr std::uint64_t kMost = std::uint64_t{1} << 40;

 private:
  std::uint64_t as_whole(const nlohmann::json& value, const std::string& key, std::uint64_t most) const;

  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace lozenge
