// A folder of what was made before, by the hash of all that it was made from.
//
// Many processes, on many machines, may use one folder at the same time: nobody waits for anybody. An entry is one
// file, which appears under its name when it is complete and is never changed; whoever reads it proves first that it is
// what was stored. So a process that is killed, or a disk that is full, costs no more than the entry.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lozenge {

/// One entry, open. It stays readable when it is removed from the cache meanwhile.
class CacheEntry {
 public:
  struct Part {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::string hash;
  };

  /// Of its parts, in alphabetical order.
  std::vector<std::string> names() const;
  bool has(const std::string& name) const { return parts_.contains(name); }

  /// The bytes of a part. \return nothing where they aren't what was stored, or the entry has no such part
  std::optional<std::string> text(const std::string& name) const;

  /// Writes a part to the file `to`, which is made or overwritten.
  /// \return whether it is what was stored \throws Error(kSystem) where `to` can't be written
  bool extract(const std::string& name, const std::filesystem::path& to) const;

 private:
  friend class Cache;
  CacheEntry() = default;

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::map<std::string, Part> parts_;
};

class Cache {
 public:
  /// \param folder  is made where something is stored
  explicit Cache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }

  /// The entry of this key, which counts as used now. What is damaged is removed.
  /// \param key  64 hexadecimal digits
  std::optional<CacheEntry> find(const std::string& key) const;

  /// Removes an entry that turned out not to be what was stored.
  void discard(const std::string& key) const;

  /// What an entry is made of: files, and small texts.
  struct Content {
    std::map<std::string, std::filesystem::path> files;  ///< [name of the part]
    std::map<std::string, std::string> texts;            ///< [name of the part]
  };

  /// \return why it can't be stored, for a note: a cache that is full or may not be written is no failure of the work
  std::optional<std::string> store(const std::string& key, const Content& content) const;

  struct Facts {
    std::int64_t entries = 0;
    std::uint64_t bytes = 0;
    double oldest_use = 0;            ///< seconds since an entry was used last, at most
    std::int64_t removed = 0;         ///< entries
    std::uint64_t removed_bytes = 0;  ///< of those
  };
  Facts facts() const;

  /// Removes what was used longest ago until all takes at most `max_bytes`, and what killed processes left. May run
  /// while others use the cache.
  /// \return what there is afterwards, and what was removed
  Facts prune(std::uint64_t max_bytes) const;

 private:
  std::filesystem::path place_of(const std::string& key) const;

  std::filesystem::path folder_;
};

}  // namespace lozenge
