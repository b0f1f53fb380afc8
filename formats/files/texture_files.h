// The textures of a surface, ready to be looked up in: each decoded once, made linear, halved down to one texel, and
// kept in tiles in a file of a temporary folder, of which a bounded cache holds what is in use.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/textures.h"

namespace lozenge {

struct TextureLimits {
  std::uint64_t cache = 256'000'000;  ///< bytes of tiles in memory
  std::uint64_t max_memory = 0;       ///< bytes that decoding one picture may take; 0: no limit
};

class TextureFiles final : public Textures {
 public:
  /// Prepares the textures that the mesh's materials have for `roles`.
  /// \throws Error(kLimit) where a picture is larger than may be decoded, Error(kUsage) where the temporary folder (of
  /// the environment's TMPDIR) can't be written
  TextureFiles(const SourceMesh& mesh, std::span<const TextureRole> roles, const TextureLimits& limits = {},
               const Progress& progress = {});
  ~TextureFiles() override;
  TextureFiles(const TextureFiles&) = delete;
  TextureFiles& operator=(const TextureFiles&) = delete;

  Vec4f look_up(const TextureUse& texture, TextureRole role, const TextureFootprint& at) const override;
  bool can_look_up(const TextureUse& texture, TextureRole role) const override;

  /// A sentence about each picture that couldn't be decoded.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct System;
  std::unique_ptr<System> system_;
  std::vector<std::string> notes_;
};

}  // namespace lozenge
