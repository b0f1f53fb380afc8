// FOLDER/ab/abcd….entry is: the magic, the length of a JSON text, the text, its hash, then the parts, end to end. The
// text names the key and the parts with their sizes and hashes. Files are told apart by the first two digits of their
// key, so that no folder gets too many.
#include "pipeline/cache/cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/content_hash.h"
#include "formats/base/error.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr std::string_view kMagic = "lozenge1";
constexpr std::string_view kEnding = ".entry";
constexpr std::size_t kHashDigits = 64;
/// An entry has a few parts, whose names are short.
constexpr std::uint64_t kLongestHeader = std::uint64_t{1} << 20;
constexpr std::size_t kBlock = std::size_t{1} << 18;

File open(const fs::path& path, const char* mode) { return {std::fopen(path.c_str(), mode), std::fclose}; }

[[noreturn]] void refuse(const fs::path& path, int error) {
  throw Error(ExitCode::kSystem, path.string() + ": can't be written: " + std::strerror(error));
}

void write(std::FILE* file, std::string_view bytes, const fs::path& path) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) refuse(path, errno);
}

void close(File file, const fs::path& path) {
  if (std::fclose(file.release()) != 0) refuse(path, errno);
}

/// Hands the next `size` bytes of the file to `take`, block by block.
/// \return their hash; nothing where there are fewer
template <typename Take>
std::optional<std::string> read_blocks(std::FILE* file, std::uint64_t size, const Take& take) {
  ContentHasher hasher;
  std::vector<char> buffer(static_cast<std::size_t>(std::min<std::uint64_t>(size, kBlock)));
  while (size > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size, buffer.size()));
    if (std::fread(buffer.data(), 1, wanted, file) != wanted) return std::nullopt;
    hasher.add({buffer.data(), wanted});
    take(std::string_view(buffer.data(), wanted));
    size -= wanted;
  }
  return hasher.finish();
}

std::optional<std::string> read_text(std::FILE* file, std::uint64_t size) {
  std::string text(size, '\0');
  if (std::fread(text.data(), 1, text.size(), file) != text.size()) return std::nullopt;
  return text;
}

/// Whether a part may be written as a file of this name.
bool is_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

/// The parts that a header tells of; nothing where it makes no sense. \param offset  of the first \param size  of the
/// file
std::optional<std::map<std::string, CacheEntry::Part>> parts_in(const std::string& header, const std::string& key,
                                                                std::uint64_t offset, std::uint64_t size) {
  const Json json = Json::parse(header, nullptr, false);
  if (!json.is_object() || json.value("key", "") != key || !json.contains("parts")) return std::nullopt;
  std::map<std::string, CacheEntry::Part> parts;
  for (const Json& part : json["parts"]) {
    const std::string name = part.value("name", "");
    const CacheEntry::Part read{offset, part.value("size", std::uint64_t{0}), part.value("hash", "")};
    if (!is_name(name) || read.size > size - offset) return std::nullopt;
    offset += read.size;
    parts[name] = read;
  }
  if (offset != size) return std::nullopt;
  return parts;
}

std::optional<std::map<std::string, CacheEntry::Part>> read_header(std::FILE* file, const std::string& key) {
  struct stat status {};
  if (fstat(fileno(file), &status) != 0) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const auto magic = read_text(file, kMagic.size());
  std::uint64_t length = 0;
  if (magic != kMagic || std::fread(&length, sizeof length, 1, file) != 1) return std::nullopt;
  const std::uint64_t offset = kMagic.size() + sizeof length + length + kHashDigits;
  if (length > kLongestHeader || offset > size) return std::nullopt;
  const auto header = read_text(file, length);
  if (!header || read_text(file, kHashDigits) != content_hash(*header)) return std::nullopt;
  try {
    return parts_in(*header, key, offset, size);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::string header_of(const std::string& key, const Cache::Content& content) {
  Json parts = Json::array();
  for (const auto& [name, file] : content.files) {
    parts.push_back({{"name", name}, {"size", fs::file_size(file)}, {"hash", content_hash_of_file(file)}});
  }
  for (const auto& [name, text] : content.texts) {
    parts.push_back({{"name", name}, {"size", text.size()}, {"hash", content_hash(text)}});
  }
  return Json{{"key", key}, {"parts", std::move(parts)}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_entry(const fs::path& path, const std::string& key, const Cache::Content& content) {
  const File out = open(path, "wb");
  if (!out) refuse(path, errno);
  const std::string header = header_of(key, content);
  const std::uint64_t length = header.size();
  write(out.get(), kMagic, path);
  write(out.get(), {reinterpret_cast<const char*>(&length), sizeof length}, path);
  write(out.get(), header + content_hash(header), path);
  for (const auto& [name, file] : content.files) {
    const File in = open(file, "rb");
    if (!in) refuse(file, errno);
    read_blocks(in.get(), fs::file_size(file), [&](std::string_view block) { write(out.get(), block, path); });
  }
  for (const auto& [name, text] : content.texts) write(out.get(), text, path);
  if (std::fflush(out.get()) != 0) refuse(path, errno);
}

struct Stored {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

/// All entries, those that were used longest ago first. Others may add and remove some meanwhile.
std::vector<Stored> entries_in(const fs::path& folder) {
  std::vector<Stored> entries;
  std::error_code ignored;
  fs::recursive_directory_iterator entry(folder, ignored);
  for (const fs::recursive_directory_iterator end; !ignored && entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.') || !name.ends_with(kEnding)) continue;
    std::error_code gone;
    const Stored stored{entry->path(), entry->file_size(gone), entry->last_write_time(gone)};
    if (!gone) entries.push_back(stored);
  }
  std::sort(entries.begin(), entries.end(),
            [](const Stored& a, const Stored& b) { return std::tie(a.used, a.path) < std::tie(b.used, b.path); });
  return entries;
}

Cache::Facts facts_of(const std::vector<Stored>& entries) {
  Cache::Facts facts;
  facts.entries = static_cast<std::int64_t>(entries.size());
  for (const Stored& entry : entries) facts.bytes += entry.bytes;
  if (!entries.empty()) {
    const auto age = fs::file_time_type::clock::now() - entries.front().used;
    facts.oldest_use = std::max(0.0, std::chrono::duration<double>(age).count());
  }
  return facts;
}

void remove_traces_of_the_killed(const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    std::error_code error;
    if (entry->is_directory(error)) remove_abandoned_files(entry->path());
  }
}

}  // namespace

std::vector<std::string> CacheEntry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, part] : parts_) names.push_back(name);
  return names;
}

std::optional<std::string> CacheEntry::text(const std::string& name) const {
  const auto part = parts_.find(name);
  if (part == parts_.end()) return std::nullopt;
  if (std::fseek(file_.get(), static_cast<long>(part->second.offset), SEEK_SET) != 0) return std::nullopt;
  std::string text;
  const auto hash = read_blocks(file_.get(), part->second.size, [&](std::string_view block) { text += block; });
  if (hash != part->second.hash) return std::nullopt;
  return text;
}

bool CacheEntry::extract(const std::string& name, const fs::path& to) const {
  const auto part = parts_.find(name);
  if (part == parts_.end()) return false;
  if (std::fseek(file_.get(), static_cast<long>(part->second.offset), SEEK_SET) != 0) return false;
  File out = open(to, "wb");
  if (!out) refuse(to, errno);
  const auto hash =
      read_blocks(file_.get(), part->second.size, [&](std::string_view block) { write(out.get(), block, to); });
  close(std::move(out), to);
  return hash == part->second.hash;
}

fs::path Cache::place_of(const std::string& key) const {
  return folder_ / key.substr(0, 2) / (key + std::string(kEnding));
}

std::optional<CacheEntry> Cache::find(const std::string& key) const {
  const fs::path place = place_of(key);
  CacheEntry entry;
  entry.file_.reset(std::fopen(place.c_str(), "rb"));
  if (!entry.file_) return std::nullopt;
  std::optional<std::map<std::string, CacheEntry::Part>> parts = read_header(entry.file_.get(), key);
  if (!parts) {
    discard(key);
    return std::nullopt;
  }
  entry.parts_ = std::move(*parts);
  futimens(fileno(entry.file_.get()), nullptr);  // used now; where that isn't allowed, it is merely pruned earlier
  return entry;
}

void Cache::discard(const std::string& key) const {
  std::error_code ignored;
  fs::remove(place_of(key), ignored);
}

std::optional<std::string> Cache::store(const std::string& key, const Content& content) const {
  try {
    fs::create_directories(place_of(key).parent_path());
    AtomicFile file(place_of(key));
    write_entry(file.temporary_path(), key, content);
    file.commit();
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  } catch (const fs::filesystem_error& error) {
    return error.what();
  }
}

Cache::Facts Cache::facts() const { return facts_of(entries_in(folder_)); }

Cache::Facts Cache::prune(std::uint64_t max_bytes) const {
  remove_traces_of_the_killed(folder_);
  std::vector<Stored> entries = entries_in(folder_);
  std::uint64_t bytes = facts_of(entries).bytes;
  auto kept = entries.begin();
  Facts removed;
  for (; kept != entries.end() && bytes > max_bytes; ++kept) {
    std::error_code ignored;
    fs::remove(kept->path, ignored);
    bytes -= kept->bytes;
    removed.removed_bytes += kept->bytes;
    ++removed.removed;
  }
  Facts facts = facts_of({kept, entries.end()});
  facts.removed = removed.removed;
  facts.removed_bytes = removed.removed_bytes;
  return facts;
}

}  // namespace lozenge
