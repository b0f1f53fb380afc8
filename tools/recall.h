// What a command may take from a cache instead of making it again.
//
// What a command makes follows from its program, its options, and the files that it reads, by content and by name
// (names of files are part of what is made). All that is hashed into a key, before the work; where a file is changed
// while the command works, nothing is stored.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/base/error.h"
#include "pipeline/cache/cache.h"
#include "tools/command_line.h"
#include "tools/console.h"

namespace lozenge {

class Recall {
 public:
  /// \param request  of a command; LOZENGE_CACHE counts where it names no cache
  /// \param program  the program that does the work: another one is trusted to make something else
  Recall(const Request& request, std::filesystem::path program);

  /// Whether there is a cache, and the command's outputs can be taken from one.
  bool is_on() const { return cache_.has_value(); }
  /// \pre is_on()
  const Cache& cache() const { return *cache_; }

  const Request& request() const { return request_; }

  /// All files that the command reads, those first that its options name. Some may not be there.
  std::vector<std::filesystem::path> inputs() const;

  /// Of all that the command makes. \pre is_on() \throws Error where an input can't be read
  const std::string& key();
  /// Of what these stages make, which know nothing of the options of others. \pre is_on()
  std::string key_of_stages(const std::set<std::string>& stages);

  /// What was made with this key, where it is there.
  std::optional<CacheEntry> find(const std::string& key) const { return cache_->find(key); }
  /// Stores what was made, if no input was changed meanwhile; says so where it can't be done.
  void store(const std::string& key, const Cache::Content& content, Console& console) const;

  /// Writes the file of --depfile, if that was given: that `target` follows from all inputs. \throws Error as
  /// AtomicFile
  void write_depfile(const std::filesystem::path& target) const;

 private:
  struct Input {
    std::filesystem::path path;
    std::string name;  ///< of which its reader may make something
    std::string hash;  ///< or "absent"
    std::string stamp;
  };
  void hash_inputs();
  void hash_input(const std::filesystem::path& path, const std::string& name);
  template <typename Wanted>
  std::string key_of(const Wanted& is_wanted);

  const Request& request_;
  std::filesystem::path program_;
  std::optional<Cache> cache_;
  std::vector<Input> inputs_;  ///< once they are hashed
  std::string program_hash_;
  std::string key_;
};

/// What a command says of its results, as a part of an entry, and back.
inline constexpr const char* kTalkPart = ":talk";
std::string talk_text(const Console::Talk& talk);
/// The results are those of `input` now, and say that they were taken from a cache.
std::optional<Console::Talk> talk_of(const std::string& text, const std::string& input);

/// Runs a command whose outputs are at, or begin with, the place that -o names; or takes them from the cache.
ExitCode run_recalled(const Request& request, Console& console, Recall& recall);

/// The program that runs now.
std::filesystem::path this_program();

}  // namespace lozenge
