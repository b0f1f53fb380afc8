// The archive is libzip's, members beyond 4 GB included; the head of each member is NumPy's (NEP 1, version 1.0): magic
// bytes, and a Python dictionary as text.
#include "formats/files/npz_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <array>
#include <bit>
#include <memory>
#include <string>
#include <type_traits>

#include "formats/base/error.h"
#include "formats/base/scratch_folder.h"

namespace lozenge {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

constexpr zip_uint16_t kNoTime = 0;
constexpr zip_uint16_t kFirstDay = (1 << 5) | 1;  // January 1st 1980: the least that a zip archive can say

/// An array's type as NumPy writes it, and its bytes.
struct Content {
  std::string type;
  const void* bytes = nullptr;
  std::uint64_t size = 0;
};

template <typename Value>
Content content_of(const std::vector<Value>& values) {
  const char* type = std::is_same_v<Value, float> ? "<f4" : std::is_same_v<Value, double> ? "<f8" : "<i4";
  return {type, values.data(), values.size() * sizeof(Value)};
}
Content content_of(const Truths& truths) { return {"|b1", truths.bytes.data(), truths.bytes.size()}; }
Content content_of(const std::string& text) { return {fmt::format("|S{}", text.size()), text.data(), text.size()}; }

/// The head of NAME.npy; with it, the numbers begin at a multiple of 64 bytes.
std::string head_of(const NamedArray& array, const std::string& type) {
  constexpr std::size_t kBefore = 10;
  constexpr std::size_t kAlignment = 64;
  std::string shape;
  for (const std::int64_t length : array.shape) shape += fmt::format("{},", length);
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  text.append(kAlignment - 1 - (kBefore + text.size()) % kAlignment, ' ');
  text += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(text.size() & 0xFF);
  head += static_cast<char>(text.size() >> 8);
  return head + text;
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Archive = std::unique_ptr<zip_t, Discard>;
using Source = std::unique_ptr<zip_source_t, Discard>;

[[noreturn]] void refuse(const std::filesystem::path& path, const char* reason) {
  throw Error(ExitCode::kSystem, fmt::format("{}: can't be written: {}", path.string(), reason));
}

/// Adds a member that consists of two pieces of memory, which must stay where they are until the archive is closed.
void add(zip_t* archive, const std::string& name, const std::string& head, const Content& content,
         const std::filesystem::path& path) {
  auto* const head_bytes = reinterpret_cast<zip_uint8_t*>(const_cast<char*>(head.data()));
  auto* const bytes = static_cast<zip_uint8_t*>(const_cast<void*>(content.bytes));
  const std::array<zip_buffer_fragment_t, 2> pieces{{{head_bytes, head.size()}, {bytes, content.size}}};
  zip_error_t error;
  zip_error_init(&error);
  Source source(zip_source_buffer_fragment_create(pieces.data(), content.size > 0 ? 2 : 1, 0, &error));
  if (!source) refuse(path, zip_error_strerror(&error));
  const zip_int64_t index = zip_file_add(archive, (name + ".npy").c_str(), source.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) refuse(path, zip_strerror(archive));
  (void)source.release();  // the archive has it
  const auto member = static_cast<zip_uint64_t>(index);
  const bool is_set = zip_set_file_compression(archive, member, ZIP_CM_STORE, 0) == 0 &&
                      zip_file_set_dostime(archive, member, kNoTime, kFirstDay, 0) == 0;
  if (!is_set) refuse(path, zip_strerror(archive));
}

/// Writes the archive to a place where there is no file.
void write_archive(const std::filesystem::path& place, const std::vector<NamedArray>& arrays,
                   const std::filesystem::path& path) {
  int code = 0;
  Archive archive(zip_open(place.c_str(), ZIP_CREATE | ZIP_EXCL, &code));
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    refuse(path, zip_error_strerror(&error));
  }
  std::vector<std::string> heads(arrays.size());
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    const Content content = std::visit([](const auto& values) { return content_of(values); }, arrays[n].values);
    heads[n] = head_of(arrays[n], content.type);
    add(archive.get(), arrays[n].name, heads[n], content, path);
  }
  if (zip_close(archive.get()) != 0) refuse(path, zip_strerror(archive.get()));
  (void)archive.release();
}

}  // namespace

void write_npz(const std::filesystem::path& path, const std::vector<NamedArray>& arrays) {
  try {
    // libzip replaces files by others, so it gets a folder of its own to do that in.
    const ScratchFolder folder(path.has_parent_path() ? path.parent_path() : ".", ".lozenge-");
    write_archive(folder.path() / path.filename(), arrays, path);
    std::filesystem::rename(folder.path() / path.filename(), path);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(code_of_refusal(error.code().value()),
                fmt::format("{}: can't be written: {}", path.string(), error.code().message()));
  }
}

}  // namespace lozenge
