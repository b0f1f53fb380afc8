// What OpenImageIO's TextureSystem alone takes for the look-ups of a bake: the same footprints in the same files, in
// the same order, and nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "formats/surface/textures.h"

namespace lozenge::bench {

/// Passes look-ups on, keeps them, and makes them again, now and then, between two looks at the clock. All come from
/// one thread.
class RawLookUps final : public Textures {
 public:
  /// Keeps a reference to `textures`. \param folder  where their files are (texture_files.h)
  RawLookUps(const Textures& textures, std::filesystem::path folder);
  ~RawLookUps() override;
  RawLookUps(const RawLookUps&) = delete;
  RawLookUps& operator=(const RawLookUps&) = delete;

  Vec4f look_up(const TextureUse& texture, TextureRole role, const TextureFootprint& at) const override;
  bool can_look_up(const TextureUse& texture, TextureRole role) const override;

  /// Makes those that are left.
  void finish();

  std::int64_t count() const;
  /// Processor time of making them again.
  double seconds() const;

 private:
  struct Log;
  const Textures& textures_;
  std::unique_ptr<Log> log_;
};

}  // namespace lozenge::bench
