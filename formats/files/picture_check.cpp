// PNG: a signature of 8 bytes, then chunks, each with its length, type, bytes and checksum. EXR: a magic number, a
// version, then a header for each part, which is a row of attributes (name, type, size, bytes) with an empty name at
// its end. ("Technical Introduction to OpenEXR", file layout.)
#include "formats/files/picture_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <vector>

namespace lozenge {

namespace {

/// No file holds more bytes of pixels for each of its own; what claims more wants our memory.
constexpr std::uint64_t kMostCompression = 1100;

/// Attributes that are looked into are small, but for lists of words.
constexpr std::uint64_t kLongestLookedInto = 1 << 26;

class Reader {
 public:
  Reader(std::istream& in, std::uint64_t size) : in_(in), left_(size) {}

  std::uint64_t left() const { return left_; }
  bool read(void* to, std::uint64_t count) {
    if (count > left_ || !in_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) return false;
    left_ -= count;
    return true;
  }
  bool skip(std::uint64_t count) {
    if (count > left_ || !in_.seekg(static_cast<std::streamoff>(count), std::ios::cur)) return false;
    left_ -= count;
    return true;
  }
  /// A text that ends with a zero byte; false where that doesn't come soon.
  bool read_word(std::string& word) {
    word.clear();
    for (char c = 0; word.size() < 256 && read(&c, 1); word += c) {
      if (c == '\0') return true;
    }
    return false;
  }

 private:
  std::istream& in_;
  std::uint64_t left_;
};

template <typename T>
T number_at(const std::vector<char>& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

std::optional<std::string> find_png_defect(Reader& reader) {
  while (reader.left() > 0) {
    std::array<unsigned char, 8> head{};
    if (!reader.read(head.data(), head.size())) return "it ends inside of a chunk";
    const std::uint64_t length = (std::uint64_t{head[0]} << 24) | (std::uint64_t{head[1]} << 16) |
                                 (std::uint64_t{head[2]} << 8) | std::uint64_t{head[3]};
    if (!reader.skip(length + 4)) {
      return fmt::format("a chunk of {} bytes starts where {} are left", length, reader.left());
    }
    if (std::memcmp(&head[4], "IEND", 4) == 0) return std::nullopt;
  }
  return std::nullopt;
}

/// What is known of one part of an EXR.
struct Part {
  std::uint64_t width = 0, height = 0;
  std::uint64_t tile_width = 0, tile_height = 0;  ///< 0 where it has lines
};

/// Whether every text of a list lies inside of it.
bool is_list_of_words(const std::vector<char>& bytes) {
  std::size_t at = 0;
  while (at + 4 <= bytes.size()) {
    const auto length = number_at<std::uint32_t>(bytes, at);
    if (length > bytes.size() - at - 4) return false;
    at += 4 + length;
  }
  return at == bytes.size();
}

/// Whether a list of channels (a name and 16 bytes each, an empty name at its end) ends where the attribute does.
bool is_list_of_channels(const std::vector<char>& bytes) {
  std::size_t at = 0;
  while (at < bytes.size() && bytes[at] != '\0') {
    const auto end = std::find(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), '\0');
    const auto name_ends = static_cast<std::size_t>(end - bytes.begin());
    if (bytes.size() - name_ends < 17 || name_ends - at > 255) return false;
    at = name_ends + 17;
  }
  return at + 1 == bytes.size();
}

/// Bytes that an attribute of this type has; nothing where that differs from one to another. OpenEXR reads so many,
/// whatever size the file tells, and would take what follows for something else.
std::optional<std::uint64_t> fixed_size(const std::string& type) {
  static const std::map<std::string, std::uint64_t> sizes{{"int", 4},
                                                          {"float", 4},
                                                          {"double", 8},
                                                          {"v2i", 8},
                                                          {"v2f", 8},
                                                          {"v2d", 16},
                                                          {"v3i", 12},
                                                          {"v3f", 12},
                                                          {"v3d", 24},
                                                          {"box2i", 16},
                                                          {"box2f", 16},
                                                          {"m33f", 36},
                                                          {"m33d", 72},
                                                          {"m44f", 64},
                                                          {"m44d", 128},
                                                          {"envmap", 1},
                                                          {"keycode", 28},
                                                          {"timecode", 8},
                                                          {"rational", 8},
                                                          {"compression", 1},
                                                          {"lineOrder", 1},
                                                          {"tiledesc", 9},
                                                          {"chromaticities", 32},
                                                          {"deepImageState", 1}};
  const auto at = sizes.find(type);
  return at == sizes.end() ? std::nullopt : std::optional(at->second);
}

std::uint64_t extent(std::int32_t low, std::int32_t high) {
  return high < low ? 0 : static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
}

/// Takes from an attribute what it tells of the part. \return false where it contradicts itself
bool take_attribute(const std::string& name, const std::string& type, const std::vector<char>& bytes, Part& part) {
  if (const auto size = fixed_size(type); size && *size != bytes.size()) return false;
  if (type == "stringvector") return is_list_of_words(bytes);
  if (type == "chlist") return is_list_of_channels(bytes);
  if (type == "floatvector") return bytes.size() % 4 == 0;
  if (type == "preview") {
    if (bytes.size() < 8) return false;
    return 4 * std::uint64_t{number_at<std::uint32_t>(bytes, 0)} * number_at<std::uint32_t>(bytes, 4) ==
           bytes.size() - 8;
  }
  if (name == "dataWindow") {
    if (bytes.size() != 16) return false;
    part.width = extent(number_at<std::int32_t>(bytes, 0), number_at<std::int32_t>(bytes, 8));
    part.height = extent(number_at<std::int32_t>(bytes, 4), number_at<std::int32_t>(bytes, 12));
  }
  if (type == "tiledesc") {
    part.tile_width = number_at<std::uint32_t>(bytes, 0);
    part.tile_height = number_at<std::uint32_t>(bytes, 4);
    return part.tile_width > 0 && part.tile_height > 0;
  }
  return true;
}

/// Whether a file of this size may hold the part: the table of its chunks, and the pixels of one of them.
bool is_plausible(const Part& part, std::uint64_t size) {
  const bool tiled = part.tile_width > 0;
  // At most 256 lines are compressed together. None of these products reaches 2^64: extents are below 2^32.
  const std::uint64_t chunks =
      tiled ? (part.width / part.tile_width + 1) * (part.height / part.tile_height + 1) / 4 : part.height / 256;
  const std::uint64_t pixels = tiled ? part.tile_width * part.tile_height : part.width;
  return chunks <= size / 8 && pixels / kMostCompression <= size;
}

bool is_looked_into(const std::string& name, const std::string& type) {
  return type == "stringvector" || type == "preview" || type == "chlist" || type == "floatvector" || fixed_size(type) ||
         name == "dataWindow";
}

/// One part's attributes. \param empty  whether it had none, which ends a file's row of headers
std::optional<std::string> find_header_defect(Reader& reader, std::uint64_t size, bool& empty) {
  std::string name;
  std::string type;
  Part part;
  empty = true;
  while (true) {
    if (!reader.read_word(name)) return "its header has no end";
    if (name.empty()) break;
    empty = false;
    std::int32_t length = 0;
    if (!reader.read_word(type) || !reader.read(&length, 4)) return "its header has no end";
    const auto bytes = static_cast<std::uint64_t>(length);
    if (length < 0 || bytes > reader.left()) {
      return fmt::format("an attribute of {} bytes starts where {} are left", length, reader.left());
    }
    if (!is_looked_into(name, type)) {
      reader.skip(bytes);
      continue;
    }
    if (bytes > kLongestLookedInto) return "an attribute is absurdly long";
    std::vector<char> content(bytes);
    if (!reader.read(content.data(), bytes) || !take_attribute(name, type, content, part)) {
      return "an attribute contradicts itself";
    }
  }
  if (!is_plausible(part, size)) return fmt::format("it is too short for {} x {} pixels", part.width, part.height);
  return std::nullopt;
}

std::optional<std::string> find_exr_defect(Reader& reader, std::uint64_t size) {
  constexpr std::uint32_t kManyParts = 0x1000;
  std::uint32_t version = 0;
  if (!reader.read(&version, 4)) return "it ends after its magic number";
  bool empty = false;
  do {
    if (auto defect = find_header_defect(reader, size, empty)) return defect;
  } while ((version & kManyParts) != 0 && !empty);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_picture_defect(std::istream& in, std::uint64_t size) {
  constexpr std::string_view kPng("\x89PNG\r\n\x1a\n", 8);
  constexpr std::string_view kExr("\x76\x2f\x31\x01", 4);
  Reader reader(in, size);
  std::array<char, 8> head{};
  if (!reader.read(head.data(), 4)) return std::nullopt;
  if (std::string_view(head.data(), 4) == kExr) return find_exr_defect(reader, size);
  if (!reader.read(&head[4], 4) || std::string_view(head.data(), 8) != kPng) return std::nullopt;
  return find_png_defect(reader);
}

std::optional<std::string> find_picture_defect(const std::filesystem::path& file) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  return find_picture_defect(in, size);
}

}  // namespace lozenge
