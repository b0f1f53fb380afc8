// A glTF document with other accessors: all that nobody replaces stays what it was, and keeps its number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/files/readers/gltf/model.h"

namespace lozenge {

/// Elements of an accessor, as bytes.
struct AccessorBytes {
  int component_type = 0;  ///< glTF's number
  const char* type = "SCALAR";
  std::size_t count = 0;
  bool normalized = false;
  std::vector<double> min;  ///< [component], or empty
  std::vector<double> max;
  std::vector<unsigned char> bytes;
  int stride = 0;  ///< of elements with padding between them; 0: none
  int target = 0;  ///< of the buffer view, where it has one
};

class GltfRewrite {
 public:
  /// Keeps a reference to `document`, whose JSON is changed. Let go of accessors before new ones are added: those that
  /// nothing uses any more give their numbers away. (Of documents with extensions that we don't know, none does.)
  explicit GltfRewrite(GltfDocument& document);

  /// One user of an accessor is none any more.
  void release(int accessor);
  /// \return its number
  int add(AccessorBytes values);

  /// Writes the document as GLB, all binary data in one chunk: that of the buffer views that something uses. Image
  /// files beside the asset come with it. \param folder  of the asset \throws Error(kUsage) where the file can't be
  /// written, Error(kLimit) where it would pass the 4 GB of a GLB, Error(kUnusableInput) where an image file isn't
  /// there
  void write(const std::filesystem::path& path, const std::filesystem::path& folder);

 private:
  nlohmann::json& json() { return *document_.json; }
  void count_uses();
  void take_in_images(const std::filesystem::path& folder);
  std::vector<bool> used_views() const;
  std::vector<unsigned char> gather();

  GltfDocument& document_;
  bool may_reuse_ = true;
  std::vector<int> uses_;                           ///< [accessor] by what is known to name accessors
  std::set<int> free_;                              ///< accessors
  std::vector<std::pair<int, AccessorBytes>> new_;  ///< accessor; what it holds
  std::vector<std::pair<std::size_t, std::vector<unsigned char>>> new_images_;  ///< image; its bytes
};

}  // namespace lozenge
