// OpenImageIO decodes pictures and filters look-ups. A picture whose numbers are colours in one material and quantities
// in another becomes two files.
#include "formats/files/texture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/base/scratch_folder.h"
#include "formats/base/srgb.h"
#include "formats/files/openimageio.h"
#include "formats/files/picture_header.h"

// After openimageio.h, which sees to fmt.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

namespace lozenge {

namespace {

namespace fs = std::filesystem;

constexpr int kChannels = 4;
/// Bytes that one pixel takes while its picture is decoded, made linear, halved and written.
constexpr std::uint64_t kBytesOfPixel = 48;
constexpr int kTile = 64;

/// Removed again, even where this process is killed, by the next one that makes one.
std::unique_ptr<ScratchFolder> make_folder_for_textures() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  try {
    return std::make_unique<ScratchFolder>(parent, "lozenge-textures-");
  } catch (const fs::filesystem_error& refusal) {
    throw Error(code_of_refusal(refusal.code().value()),
                fmt::format("{}: no folder for textures can be made there ({}); set TMPDIR to one that can be written",
                            parent.string(), refusal.code().message()));
  }
}

/// RGBA, 0 to 1, row by row.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<float> values;
};

/// Grey becomes RGB, what has no alpha is opaque; colours become linear.
Pixels rgba_of(const std::vector<float>& decoded, const OIIO::ImageSpec& spec, bool colours) {
  Pixels pixels{spec.width, spec.height, {}};
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  const std::size_t count = decoded.size() / channels;
  pixels.values.resize(count * kChannels);
  const bool is_grey = channels < 3;
  const bool has_alpha = channels == 2 || channels == 4;
  for (std::size_t i = 0; i < count; ++i) {
    const float* from = &decoded[i * channels];
    float* to = &pixels.values[i * kChannels];
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = from[is_grey ? 0 : c];
      to[c] = colours ? static_cast<float>(linear_of_srgb(value)) : value;
    }
    to[3] = has_alpha ? from[channels - 1] : 1.0F;
  }
  return pixels;
}

/// Nothing where it can't be decoded; `problem` gets why.
std::optional<Pixels> decoded(const EncodedImage& image, bool colours, std::string& problem) {
  auto* bytes = const_cast<unsigned char*>(image.bytes->data());
  OIIO::Filesystem::IOMemReader memory(bytes, image.bytes->size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const std::string format = image.mime_type.substr(image.mime_type.find('/') + 1);
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec;
  if (!in || !in->set_ioproxy(&memory) || !in->open("picture." + format, spec, config)) {
    problem = in ? in->geterror() : OIIO::geterror();
    return std::nullopt;
  }
  const auto header = read_picture_header(*image.bytes);
  const bool is_as_told = header && static_cast<int>(header->width) == spec.width &&
                          static_cast<int>(header->height) == spec.height && spec.depth == 1 && spec.nchannels >= 1 &&
                          spec.nchannels <= kChannels;
  if (!is_as_told) {
    problem = "its size isn't that of its header";
    return std::nullopt;
  }
  std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    problem = in->geterror();
    return std::nullopt;
  }
  return rgba_of(values, spec, colours);
}

void write_texture(const fs::path& path, const Pixels& pixels) {
  OIIO::ImageBuf buffer(OIIO::ImageSpec(pixels.width, pixels.height, kChannels, OIIO::TypeDesc::HALF));
  buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, pixels.values.data());
  OIIO::ImageSpec config;
  config.format = OIIO::TypeDesc::HALF;
  config.tile_width = kTile;
  config.tile_height = kTile;
  config.attribute("maketx:fileformatname", "openexr");
  config.attribute("compression", "none");
  if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, buffer, path.string(), config)) {
    throw Error(ExitCode::kSystem, fmt::format("{}: can't be written: {}", path.string(), OIIO::geterror()));
  }
}

OIIO::TextureOpt::Wrap wrap_of(Wrap wrap) {
  return wrap == Wrap::kClamp    ? OIIO::TextureOpt::WrapClamp
         : wrap == Wrap::kMirror ? OIIO::TextureOpt::WrapMirror
                                 : OIIO::TextureOpt::WrapPeriodic;
}

void destroy(OIIO::TextureSystem* system) { OIIO::TextureSystem::destroy(system, true); }

}  // namespace

struct TextureFiles::System {
  using Key = std::pair<std::int32_t, bool>;  ///< image, whether its numbers are colours
  std::unique_ptr<ScratchFolder> folder = make_folder_for_textures();
  std::unique_ptr<OIIO::TextureSystem, void (*)(OIIO::TextureSystem*)> system{OIIO::TextureSystem::create(false),
                                                                              destroy};
  std::map<Key, OIIO::TextureSystem::TextureHandle*> handles;

  static Key key_of(const TextureUse& texture, TextureRole role) { return {texture.image, holds_colours(role)}; }
};

TextureFiles::TextureFiles(const SourceMesh& mesh, std::span<const TextureRole> roles, const TextureLimits& limits,
                           const Progress& progress)
    : system_(std::make_unique<System>()) {
  system_->system->attribute("max_memory_MB", static_cast<float>(limits.cache) / 1e6F);
  for (const Material& material : mesh.material_looks) {
    for (const TextureRole role : roles) {
      const TextureUse& use = material.texture(role);
      if (use.exists()) system_->handles.try_emplace(System::key_of(use, role), nullptr);
    }
  }
  std::size_t done = 0;
  for (auto& [key, handle] : system_->handles) {
    report(progress, "reading textures", static_cast<double>(done++) / static_cast<double>(system_->handles.size()));
    const EncodedImage& image = mesh.images[key.first];
    const std::string name = image.name.empty() ? fmt::format("image {}", key.first) : image.name;
    if (const auto header = read_picture_header(*image.bytes)) {
      require_memory(std::uint64_t{header->width} * header->height * kBytesOfPixel, limits.max_memory,
                     fmt::format("{}: decoding {}", mesh.origin, name));
    }
    std::string problem;
    const std::optional<Pixels> pixels = decoded(image, key.second, problem);
    if (!pixels) {
      notes_.push_back(fmt::format("{} can't be decoded ({}); surfaces go without it", name, problem));
      continue;
    }
    const fs::path path = system_->folder->path() / fmt::format("{}{}.exr", key.first, key.second ? "c" : "q");
    write_texture(path, *pixels);
    handle = system_->system->get_texture_handle(OIIO::ustring(path.string()));
  }
}

TextureFiles::~TextureFiles() = default;

bool TextureFiles::can_look_up(const TextureUse& texture, TextureRole role) const {
  const auto at = system_->handles.find(System::key_of(texture, role));
  return at != system_->handles.end() && at->second != nullptr;
}

Vec4f TextureFiles::look_up(const TextureUse& texture, TextureRole role, const TextureFootprint& at) const {
  OIIO::TextureOpt options;
  options.swrap = wrap_of(texture.wrap_u);
  options.twrap = wrap_of(texture.wrap_v);
  options.interpmode = texture.is_blocky ? OIIO::TextureOpt::InterpClosest : OIIO::TextureOpt::InterpBilinear;
  options.conservative_filter = false;
  std::array<float, kChannels> value{};
  const auto as_float = [](double x) { return static_cast<float>(x); };
  const bool found = system_->system->texture(
      system_->handles.at(System::key_of(texture, role)), nullptr, options, as_float(at.place.x), as_float(at.place.y),
      as_float(at.across.x), as_float(at.across.y), as_float(at.down.x), as_float(at.down.y), kChannels, value.data());
  if (!found) throw Error(ExitCode::kInternal, "a texture can't be looked up in: " + system_->system->geterror());
  return {value[0], value[1], value[2], value[3]};
}

}  // namespace lozenge
