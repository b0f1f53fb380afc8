// GLB 2: a header of 12 bytes (magic, version, length), then chunks, each with its length and type before its bytes.
// The first is JSON, the second, where there is one, BIN; others are passed over. (glTF 2.0 specification, Sec. 4.)
#include "formats/files/readers/gltf/container.h"

#include <algorithm>
#include <array>
#include <optional>

#include "formats/base/error.h"
#include "formats/files/glb_container.h"
#include "formats/files/readers/input_file.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void broken(const std::string& what, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, what + ": " + problem);
}

/// Little-endian, as glTF is.
std::uint32_t read_word(InputFile& file) {
  std::array<unsigned char, 4> b{};
  file.read(b.data(), b.size());
  return b[0] | (std::uint32_t{b[1]} << 8) | (std::uint32_t{b[2]} << 16) | (std::uint32_t{b[3]} << 24);
}

struct Chunk {
  std::uint32_t length = 0;
  std::uint32_t type = 0;
};

/// The next chunk's header, nothing at the end of the file. `left` counts the bytes that the GLB has by its header.
std::optional<Chunk> next_chunk(InputFile& file, std::uint64_t& left, const std::string& name) {
  if (left < 8) return std::nullopt;
  Chunk chunk;
  chunk.length = read_word(file);
  chunk.type = read_word(file);
  left -= 8;
  if (chunk.length > left) {
    broken(name, "a chunk of " + std::to_string(chunk.length) + " bytes starts where only " + std::to_string(left) +
                     " are left; the file is damaged, export it again");
  }
  left -= chunk.length;
  return chunk;
}

/// A document in memory takes several times its text: the text itself, nlohmann's tree of it, tinygltf's tree and
/// model.
constexpr std::uint64_t kMemoryOfText = 12;

GltfContainer read_glb(InputFile& file, const std::string& name, MemoryBudget& budget) {
  if (file.size() < 20) broken(name, "truncated: a GLB has at least 20 bytes, this one " + std::to_string(file.size()));
  file.skip(4);
  const std::uint32_t version = read_word(file);
  const std::uint32_t length = read_word(file);
  if (version != 2) {
    throw Error(ExitCode::kUnsupported,
                name + ": GLB version " + std::to_string(version) + "; only version 2 is read, convert it to glTF 2.0");
  }
  if (length > file.size()) {
    broken(name, "truncated: its header promises " + std::to_string(length) + " bytes, the file has " +
                     std::to_string(file.size()) + "; copy or export it again");
  }
  if (length < 20) broken(name, "its header gives it a length of " + std::to_string(length) + " bytes");
  std::uint64_t left = length - 12;
  const std::optional<Chunk> json = next_chunk(file, left, name);
  if (!json || json->type != kGlbJson) broken(name, "its first chunk is not JSON");

  GltfContainer container;
  budget.take(kMemoryOfText * json->length, name + ": reading its JSON");
  container.json.resize(json->length);
  file.read(container.json.data(), json->length);
  while (const std::optional<Chunk> chunk = next_chunk(file, left, name)) {
    if (chunk->type == kGlbBinary && !container.has_binary) {
      require_memory(budget.taken() + chunk->length, budget.limit(), name + ": reading its binary chunk");
      container.has_binary = true;
      container.binary.resize(chunk->length);
      file.read(container.binary.data(), chunk->length);
    } else {
      file.skip(chunk->length);
    }
  }
  return container;
}

}  // namespace

GltfContainer read_gltf_container(const fs::path& path, const std::string& name, MemoryBudget& budget) {
  InputFile file(path, name);
  if (file.size() < 4) broken(name, file.size() == 0 ? "is empty" : "is too short for a glTF file");
  if (read_word(file) == kGlbMagic) {
    file.rewind();
    return read_glb(file, name, budget);
  }
  file.rewind();
  GltfContainer container;
  // Most of a long .gltf is data URIs, which aren't taken apart.
  budget.take(2 * file.size(), name + ": reading it");
  container.json.resize(file.size());
  file.read(container.json.data(), container.json.size());
  const std::size_t start = container.json.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string::npos || container.json[start] != '{') {
    broken(name, "is neither GLB (which starts with \"glTF\") nor glTF's JSON (which starts with \"{\")");
  }
  container.json.erase(0, start);
  return container;
}

std::vector<unsigned char> read_file_start(const fs::path& path, std::uint64_t most, const std::string& what) {
  InputFile file(path, what);
  std::vector<unsigned char> bytes(std::min(most, file.size()));
  file.read(bytes.data(), bytes.size());
  return bytes;
}

}  // namespace lozenge
