// Look-ups in the textures of a surface, filtered; who bakes knows them by this, and no file.
#pragma once

#include "formats/base/vector.h"
#include "formats/surface/material.h"

namespace lozenge {

/// A place in a texture, in its own coordinates (glTF's: (0, 0) is the top left corner, (1, 1) the bottom right one),
/// and the parallelogram around it that the value is wanted of.
struct TextureFootprint {
  Vec2d place{0, 0};
  Vec2d across{0, 0};  ///< one side of the parallelogram
  Vec2d down{0, 0};    ///< the other one
};

class Textures {
 public:
  virtual ~Textures() = default;

  /// RGBA: colours are linear and not multiplied by alpha, quantities as they are stored; 1 where a picture has no such
  /// channel (a grey one has the same in R, G and B). May be called by all threads at once.
  /// \pre texture.exists()
  virtual Vec4f look_up(const TextureUse& texture, TextureRole role, const TextureFootprint& at) const = 0;

  /// Whether the picture could be decoded. What has none is looked up no more.
  virtual bool can_look_up(const TextureUse& texture, TextureRole role) const = 0;
};

}  // namespace lozenge
