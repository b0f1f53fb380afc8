// An asset whose textures are UASTC, which GPUs decode: made by a script on node, with an encoder of npm's that nobody
// has to have who doesn't want such assets.
#pragma once

#include <filesystem>
#include <string>

#include "formats/base/progress.h"

namespace lozenge {

class BasisuEncoder {
 public:
  /// \param script  basisu.mjs; its folder is where users are told to install what it needs
  /// \throws Error(kSystem) where node, the script, or what it needs isn't there
  explicit BasisuEncoder(std::filesystem::path script);

  /// Makes NAME.basisu.glb of NAME.glb and the KTX 2.0 files beside it, in their folder.
  /// \throws Error(kSystem) where that can't be done
  void encode(const std::filesystem::path& asset, const Progress& progress) const;

 private:
  std::string node_;
  std::filesystem::path script_;
};

}  // namespace lozenge
