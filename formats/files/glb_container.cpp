#include "formats/files/glb_container.h"

#include <limits>

#include "formats/base/error.h"

namespace lozenge {

namespace {

void write_word(std::ostream& stream, std::uint64_t word) {
  for (int shift = 0; shift < 32; shift += 8) stream.put(static_cast<char>(word >> shift & 0xFF));
}

void write_chunk(std::ostream& stream, std::uint64_t name, const char* data, std::size_t size, char padding) {
  const std::size_t padded = (size + 3) / 4 * 4;
  write_word(stream, padded);
  write_word(stream, name);
  stream.write(data, static_cast<std::streamsize>(size));
  for (std::size_t i = size; i < padded; ++i) stream.put(padding);
}

}  // namespace

void write_glb_container(std::ostream& stream, std::string_view text, std::span<const unsigned char> binary) {
  const std::uint64_t size =
      12 + 8 + (text.size() + 3) / 4 * 4 + (binary.empty() ? 0 : 8 + (binary.size() + 3) / 4 * 4);
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::kLimit, "a GLB holds at most 4 GB, and this asset needs more; split it");
  }
  write_word(stream, kGlbMagic);
  write_word(stream, 2);
  write_word(stream, size);
  write_chunk(stream, kGlbJson, text.data(), text.size(), ' ');
  if (binary.empty()) return;
  write_chunk(stream, kGlbBinary, reinterpret_cast<const char*>(binary.data()), binary.size(), '\0');
}

}  // namespace lozenge
