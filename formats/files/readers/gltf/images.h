// The pictures of a glTF asset as their files hold them: from buffer views, data URIs, and files in the asset's folder.
#pragma once

#include <string>
#include <vector>

#include "formats/base/memory_budget.h"
#include "formats/files/readers/deviations.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/material.h"

namespace lozenge {

/// Gathers those that are asked for, each once.
class GltfImages {
 public:
  /// Keeps references to all. \param deviations  gets pictures that can't be read \param notes  and a sentence for each
  /// that is of a format that isn't
  GltfImages(const GltfFile& file, MemoryBudget& budget, Deviations& deviations, std::vector<std::string>& notes);

  /// The number among `take()` of an image of the file; -1 where it can't be read: it is missing, outside of the
  /// asset's folder, of a format that isn't read, or of a size that can't be true. \param image  any number \throws
  /// Error(kLimit) where the budget is too small
  std::int32_t find(int image);

  std::vector<EncodedImage> take() { return std::move(images_); }

 private:
  std::int32_t read(int image);

  const GltfFile& file_;
  MemoryBudget& budget_;
  Deviations& deviations_;
  std::vector<std::string>& notes_;
  std::vector<std::int32_t> found_;  ///< [image of the file] what `find` gives, or kUnread
  std::vector<EncodedImage> images_;
};

}  // namespace lozenge
