#include "tools/bench/bake/raw_look_ups.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "formats/base/error.h"
#include "formats/files/openimageio.h"
#include "tools/bench/bake/raw_rays.h"

// After openimageio.h, which sees to fmt.
#include <OpenImageIO/texture.h>

namespace lozenge::bench {

namespace {

constexpr std::size_t kKept = 1 << 16;
constexpr int kChannels = 4;

OIIO::TextureOpt::Wrap wrap_of(Wrap wrap) {
  return wrap == Wrap::kClamp    ? OIIO::TextureOpt::WrapClamp
         : wrap == Wrap::kMirror ? OIIO::TextureOpt::WrapMirror
                                 : OIIO::TextureOpt::WrapPeriodic;
}

OIIO::TextureOpt options_of(const TextureUse& texture) {
  OIIO::TextureOpt options;
  options.swrap = wrap_of(texture.wrap_u);
  options.twrap = wrap_of(texture.wrap_v);
  options.interpmode = texture.is_blocky ? OIIO::TextureOpt::InterpClosest : OIIO::TextureOpt::InterpBilinear;
  options.conservative_filter = false;
  return options;
}

struct LookUp {
  OIIO::TextureSystem::TextureHandle* handle;
  OIIO::TextureOpt options;
  std::array<float, 6> footprint;
};

}  // namespace

struct RawLookUps::Log {
  explicit Log(std::filesystem::path files) : folder(std::move(files)) {}

  void keep(const TextureUse& texture, TextureRole role, const TextureFootprint& at) {
    const auto as_float = [](double x) { return static_cast<float>(x); };
    look_ups.push_back({handle_of(texture, role),
                        options_of(texture),
                        {as_float(at.place.x), as_float(at.place.y), as_float(at.across.x), as_float(at.across.y),
                         as_float(at.down.x), as_float(at.down.y)}});
    if (look_ups.size() >= kKept) look_up();
  }

  void look_up() {
    OIIO::TextureSystem::Perthread* thread = system->get_perthread_info();
    std::array<float, kChannels> value{};
    bool found = true;
    const double start = thread_seconds();
    for (auto& [handle, options, f] : look_ups) {
      found &= system->texture(handle, thread, options, f[0], f[1], f[2], f[3], f[4], f[5], kChannels, value.data());
    }
    seconds += thread_seconds() - start;
    if (!found) throw Error(ExitCode::kInternal, "a texture can't be looked up in: " + system->geterror());
    count += static_cast<std::int64_t>(look_ups.size());
    look_ups.clear();
  }

  std::vector<LookUp> look_ups;
  std::int64_t count = 0;
  double seconds = 0;

 private:
  OIIO::TextureSystem::TextureHandle* handle_of(const TextureUse& texture, TextureRole role) {
    auto& handle = handles[{texture.image, holds_colours(role)}];
    if (handle == nullptr) {
      const auto file = folder / fmt::format("{}{}.exr", texture.image, holds_colours(role) ? "c" : "q");
      handle = system->get_texture_handle(OIIO::ustring(file.string()));
    }
    return handle;
  }

  std::filesystem::path folder;
  std::unique_ptr<OIIO::TextureSystem, void (*)(OIIO::TextureSystem*)> system{
      OIIO::TextureSystem::create(false), [](OIIO::TextureSystem* made) { OIIO::TextureSystem::destroy(made, true); }};
  std::map<std::pair<std::int32_t, bool>, OIIO::TextureSystem::TextureHandle*> handles;
};

RawLookUps::RawLookUps(const Textures& textures, std::filesystem::path folder)
    : textures_(textures), log_(std::make_unique<Log>(std::move(folder))) {}
RawLookUps::~RawLookUps() = default;

Vec4f RawLookUps::look_up(const TextureUse& texture, TextureRole role, const TextureFootprint& at) const {
  log_->keep(texture, role, at);
  return textures_.look_up(texture, role, at);
}

bool RawLookUps::can_look_up(const TextureUse& texture, TextureRole role) const {
  return textures_.can_look_up(texture, role);
}

void RawLookUps::finish() { log_->look_up(); }
std::int64_t RawLookUps::count() const { return log_->count; }
double RawLookUps::seconds() const { return log_->seconds; }

}  // namespace lozenge::bench
