// The file is a header, an index of levels, the data format descriptor, keys with values, and the levels, the coarsest
// first. All numbers have their low byte first.
#include "formats/files/ktx2_file.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "formats/base/error.h"

namespace lozenge {

namespace {

constexpr std::size_t kHeaderBytes = 80;  // the identifier, the header, and the index of what isn't a level
constexpr std::size_t kLevelBytes = 24;   // of the index, a level
constexpr std::uint32_t kZstandard = 2;
/// Files that are read more often than written: but for the slowest levels, which take most of a build's time.
constexpr int kCompression = 9;
constexpr std::string_view kDescriptionKey = "lozenge.map";

struct FormatTraits {
  std::uint32_t vulkan;  ///< VkFormat
  std::int32_t channels;
  std::int32_t channel_bytes;
  bool srgb;
};

/// In the order of TexelFormat.
constexpr std::array kFormats{
    FormatTraits{9, 1, 1, false},   // VK_FORMAT_R8_UNORM
    FormatTraits{37, 4, 1, false},  // VK_FORMAT_R8G8B8A8_UNORM
    FormatTraits{43, 4, 1, true},   // VK_FORMAT_R8G8B8A8_SRGB
    FormatTraits{91, 4, 2, false},  // VK_FORMAT_R16G16B16A16_UNORM
};

const FormatTraits& traits_of(TexelFormat format) { return kFormats[static_cast<std::size_t>(format)]; }

std::int32_t side_of_level(std::int32_t side, std::size_t level) { return level < 31 ? std::max(side >> level, 1) : 1; }

std::uint64_t level_bytes(const Ktx2Texture& texture, std::size_t level) {
  return std::uint64_t{1} * static_cast<std::uint64_t>(side_of_level(texture.width, level)) *
         static_cast<std::uint64_t>(side_of_level(texture.height, level)) *
         static_cast<std::uint64_t>(texel_bytes(texture.format));
}

class Bytes {
 public:
  template <typename Number>
  void put(Number number) {
    for (std::size_t k = 0; k < sizeof number; ++k) {
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8 * k)));
    }
  }
  void put_text(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }
  void put_bytes(const std::vector<std::uint8_t>& bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void pad(std::size_t unit) {
    while (bytes_.size() % unit != 0) bytes_.push_back(0);
  }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::uint8_t>& bytes() { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// One basic descriptor block, of a sample for each channel.
std::vector<std::uint8_t> data_format_descriptor(const FormatTraits& format) {
  constexpr std::uint32_t kVersion = 2;
  constexpr std::uint32_t kColourModelRgb = 1;
  constexpr std::uint32_t kPrimariesBt709 = 1;
  constexpr std::uint32_t kTransferLinear = 1;
  constexpr std::uint32_t kTransferSrgb = 2;
  constexpr std::uint32_t kAlpha = 15;
  constexpr std::uint32_t kIsLinear = 0x10;
  const std::uint32_t block = 24 + 16 * static_cast<std::uint32_t>(format.channels);
  const auto bits = static_cast<std::uint32_t>(8 * format.channel_bytes);
  Bytes out;
  out.put(block + 4);
  out.put(std::uint32_t{0});  // Khronos, a basic block
  out.put(kVersion | block << 16U);
  // What is no colour has no primaries: glTF asks for that.
  out.put(kColourModelRgb | (format.srgb ? kPrimariesBt709 << 8U | kTransferSrgb << 16U : kTransferLinear << 16U));
  out.put(std::uint32_t{0});                                                    // a block of 1 x 1 x 1 x 1 texels
  out.put(static_cast<std::uint32_t>(format.channels * format.channel_bytes));  // all in the first plane
  out.put(std::uint32_t{0});
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(format.channels); ++c) {
    // Alpha is linear whatever the colours are.
    const std::uint32_t type = c == 3 ? kAlpha | (format.srgb ? kIsLinear : 0) : c;
    out.put(c * bits | (bits - 1) << 16U | type << 24U);
    out.put(std::uint32_t{0});                // at the texel's place
    out.put(std::uint32_t{0});                // stands for 0
    out.put((std::uint32_t{1} << bits) - 1);  // stands for 1
  }
  return std::move(out.bytes());
}

/// In the order of their keys, as the format wants it.
std::vector<std::uint8_t> keys_and_values(const std::string& description) {
  Bytes out;
  const std::map<std::string_view, std::string_view> pairs{
      {"KTXorientation", "rd"}, {"KTXwriter", "lozenge"}, {kDescriptionKey, description}};
  for (const auto& [key, value] : pairs) {
    out.put(static_cast<std::uint32_t>(key.size() + value.size() + 2));
    out.put_text(key);
    out.put(std::uint8_t{0});
    out.put_text(value);
    out.put(std::uint8_t{0});
    out.pad(4);
  }
  return std::move(out.bytes());
}

std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kCompression);
  if (ZSTD_isError(size) != 0) {
    throw Error(ExitCode::kInternal, fmt::format("zstd can't compress a texture: {}", ZSTD_getErrorName(size)));
  }
  packed.resize(size);
  return packed;
}

/// A file in memory, of which nothing is read that isn't there.
class Reader {
 public:
  Reader(const std::filesystem::path& path, std::string bytes) : path_(path), bytes_(std::move(bytes)) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ExitCode::kUnusableInput, fmt::format("{}: {}; make it again", path_.string(), reason));
  }
  template <typename Number>
  Number number(std::size_t at) const {
    Number value = 0;
    for (std::size_t k = 0; k < sizeof value; ++k) {
      const auto byte = static_cast<std::uint8_t>(part(at, sizeof value)[k]);
      value |= static_cast<Number>(static_cast<Number>(byte) << (8 * k));
    }
    return value;
  }
  std::string_view part(std::uint64_t at, std::uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) refuse("it ends before what it tells of");
    return std::string_view(bytes_).substr(at, size);
  }

 private:
  const std::filesystem::path& path_;
  std::string bytes_;
};

TexelFormat format_in(const Reader& file) {
  const auto vulkan = file.number<std::uint32_t>(12);
  const auto* const found =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const FormatTraits& t) { return t.vulkan == vulkan; });
  if (found == kFormats.end()) file.refuse(fmt::format("its texels are of format {}, which no map has", vulkan));
  return static_cast<TexelFormat>(found - kFormats.begin());
}

/// What else the header must say of a picture of one layer with all its mips.
void require_header(const Reader& file, const Ktx2Texture& texture, std::uint32_t levels) {
  const std::array<std::uint32_t, 7> expected{
      static_cast<std::uint32_t>(traits_of(texture.format).channel_bytes),
      static_cast<std::uint32_t>(texture.width),
      static_cast<std::uint32_t>(texture.height),
      0,
      0,
      1,
      static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(std::max(texture.width, texture.height))))};
  for (std::size_t k = 0; k + 1 < expected.size(); ++k) {
    if (file.number<std::uint32_t>(16 + 4 * k) != expected[k]) file.refuse("it is no plain picture");
  }
  if (levels != expected.back()) {
    file.refuse(fmt::format("it has {} levels, and {} go down to one texel", levels, expected.back()));
  }
  if (file.number<std::uint32_t>(44) != kZstandard) file.refuse("its levels aren't packed by Zstandard");
}

void require_descriptor(const Reader& file, const Ktx2Texture& texture) {
  const std::vector<std::uint8_t> expected = data_format_descriptor(traits_of(texture.format));
  const std::string_view found = file.part(file.number<std::uint32_t>(48), file.number<std::uint32_t>(52));
  if (found.size() != expected.size() || std::memcmp(found.data(), expected.data(), expected.size()) != 0) {
    file.refuse("its data format descriptor isn't that of its texels");
  }
}

std::string description_in(const Reader& file) {
  const std::uint64_t begin = file.number<std::uint32_t>(56);
  const std::uint64_t size = file.number<std::uint32_t>(60);
  file.part(begin, size);
  for (std::uint64_t at = begin; at + 4 <= begin + size;) {
    const std::uint64_t length = file.number<std::uint32_t>(at);
    const std::string_view pair = file.part(at + 4, length);
    const std::size_t end = pair.find('\0');
    if (end != std::string_view::npos && pair.substr(0, end) == kDescriptionKey) {
      const std::string_view value = pair.substr(end + 1);
      return std::string(value.substr(0, value.find('\0')));
    }
    at += 4 + (length + 3) / 4 * 4;
  }
  return {};
}

std::vector<std::uint8_t> level_in(const Reader& file, const Ktx2Texture& texture, std::size_t level) {
  const std::size_t entry = kHeaderBytes + kLevelBytes * level;
  const std::string_view packed = file.part(file.number<std::uint64_t>(entry), file.number<std::uint64_t>(entry + 8));
  const std::uint64_t size = level_bytes(texture, level);
  // A frame of Zstandard says itself how much is in it. A block of it is of 128 KiB at most, and of some bytes at
  // least; more is claimed by files that want our memory.
  constexpr std::uint64_t kMostCompression = 65536;
  if (size / kMostCompression > packed.size()) file.refuse(fmt::format("level {} is too short", level));
  if (file.number<std::uint64_t>(entry + 16) != size ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) {
    file.refuse(fmt::format("level {} isn't of {} bytes", level, size));
  }
  std::vector<std::uint8_t> bytes(size);
  const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) file.refuse(fmt::format("level {} can't be unpacked", level));
  return bytes;
}

}  // namespace

std::int32_t texel_channels(TexelFormat format) { return traits_of(format).channels; }

std::int32_t texel_bytes(TexelFormat format) { return traits_of(format).channels * traits_of(format).channel_bytes; }

std::vector<std::uint8_t> ktx2_of(const Ktx2Texture& texture) {
  const FormatTraits& format = traits_of(texture.format);
  const std::vector<std::uint8_t> descriptor = data_format_descriptor(format);
  const std::vector<std::uint8_t> keys = keys_and_values(texture.description);
  const std::size_t levels = texture.levels.size();
  Bytes out;
  out.put_text(kKtx2Identifier);
  out.put(format.vulkan);
  out.put(static_cast<std::uint32_t>(format.channel_bytes));
  out.put(static_cast<std::uint32_t>(texture.width));
  out.put(static_cast<std::uint32_t>(texture.height));
  for (const std::uint32_t word : {0U, 0U, 1U, static_cast<std::uint32_t>(levels), kZstandard}) out.put(word);
  const std::size_t at_descriptor = kHeaderBytes + kLevelBytes * levels;
  out.put(static_cast<std::uint32_t>(at_descriptor));
  out.put(static_cast<std::uint32_t>(descriptor.size()));
  out.put(static_cast<std::uint32_t>(at_descriptor + descriptor.size()));
  out.put(static_cast<std::uint32_t>(keys.size()));
  out.put(std::uint64_t{0});  // no global data
  out.put(std::uint64_t{0});
  std::vector<std::vector<std::uint8_t>> packed(levels);
  for (std::size_t l = 0; l < levels; ++l) packed[l] = compressed(texture.levels[l]);
  std::vector<std::uint64_t> offsets(levels);
  std::uint64_t end = at_descriptor + descriptor.size() + keys.size();
  for (std::size_t l = levels; l-- > 0; end += packed[l].size()) offsets[l] = end;
  for (std::size_t l = 0; l < levels; ++l) {
    out.put(offsets[l]);
    out.put(std::uint64_t{packed[l].size()});
    out.put(level_bytes(texture, l));
  }
  out.put_bytes(descriptor);
  out.put_bytes(keys);
  for (std::size_t l = levels; l-- > 0;) out.put_bytes(packed[l]);
  return std::move(out.bytes());
}

Ktx2Texture read_ktx2(const std::filesystem::path& path, std::int32_t most_side) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(ExitCode::kUnusableInput, path.string() + ": it can't be opened; check its name");
  const Reader file(path, std::string(std::istreambuf_iterator<char>(stream), {}));
  if (!is_ktx2(file.part(0, kKtx2Identifier.size()))) file.refuse("it is no KTX 2.0 file");
  const auto width = file.number<std::uint32_t>(20);
  const auto height = file.number<std::uint32_t>(24);
  const auto most = static_cast<std::uint32_t>(most_side);
  if (width < 1 || height < 1) file.refuse("its size makes no sense");
  if (width > most || height > most) {
    throw Error(ExitCode::kLimit, fmt::format("{}: {} x {} texels are more than {} a side; bake a smaller map",
                                              path.string(), width, height, most_side));
  }
  Ktx2Texture texture{format_in(file), static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), {}, {}};
  const auto levels = file.number<std::uint32_t>(40);
  require_header(file, texture, levels);
  require_descriptor(file, texture);
  texture.description = description_in(file);
  for (std::size_t l = 0; l < levels; ++l) texture.levels.push_back(level_in(file, texture, l));
  return texture;
}

}  // namespace lozenge
