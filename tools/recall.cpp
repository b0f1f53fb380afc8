#include "tools/recall.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/content_hash.h"
#include "formats/files/named_files.h"
#include "tools/command.h"
#include "tools/make_rule.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

/// Changes whenever keys or entries get another meaning.
constexpr std::string_view kVersion = "lozenge cache 1";
constexpr const char* kAbsent = "absent";

/// What tells that a file was changed.
std::string stamp_of(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return kAbsent;
  return fmt::format("{} {} {}.{} {}.{}", status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                     status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
}

std::optional<Cache> cache_of(const Request& request) {
  if (request.command == nullptr || !request.command->is_repeatable) return std::nullopt;
  const bool wants_work = std::any_of(request.given.begin(), request.given.end(),
                                      [](const GivenOption& option) { return option.role == OptionRole::kWantsWork; });
  const char* usual = std::getenv("LOZENGE_CACHE");
  std::string folder = request.common.cache.empty() && usual != nullptr ? usual : request.common.cache;
  if (folder.empty() || wants_work) return std::nullopt;
  return Cache(std::move(folder));
}

/// Options may have their value in a file: @FILE.
std::optional<fs::path> file_in(const std::string& value) {
  if (value.size() < 2 || value.front() != '@') return std::nullopt;
  return value.substr(1);
}

}  // namespace

Recall::Recall(const Request& request, fs::path program)
    : request_(request), program_(std::move(program)), cache_(cache_of(request)) {}

std::vector<fs::path> Recall::inputs() const {
  std::vector<fs::path> named;
  std::vector<fs::path> others;
  for (const GivenOption& option : request_.given) {
    for (const std::string& value : option.values) {
      if (option.role == OptionRole::kInput) {
        named.emplace_back(value);
        const std::vector<fs::path> files = files_named_by(value);
        others.insert(others.end(), files.begin(), files.end());
      } else if (const auto file = file_in(value)) {
        others.push_back(*file);
      }
    }
  }
  named.insert(named.end(), others.begin(), others.end());
  return named;
}

void Recall::hash_input(const fs::path& path, const std::string& name) {
  Input input{path, name, kAbsent, stamp_of(path)};
  if (input.stamp != kAbsent) input.hash = content_hash_of_file(path);
  inputs_.push_back(std::move(input));
}

void Recall::hash_inputs() {
  if (!program_hash_.empty()) return;
  for (const GivenOption& option : request_.given) {
    for (const std::string& value : option.values) {
      if (option.role == OptionRole::kInput) {
        const fs::path path(value);
        hash_input(path, path.filename().string());
        for (const fs::path& file : files_named_by(path)) {
          hash_input(file, file.lexically_relative(path.parent_path()).string());
        }
      } else if (const auto file = file_in(value)) {
        hash_input(*file, "@");
      }
    }
  }
  program_hash_ = content_hash_of_file(program_);
}

template <typename Wanted>
std::string Recall::key_of(const Wanted& is_wanted) {
  hash_inputs();
  ContentHasher hasher;
  hasher.add_field(kVersion).add_field(program_hash_);
  for (const Input& input : inputs_) hasher.add_field(input.name).add_field(input.hash);
  for (const GivenOption& option : request_.given) {
    if (option.role != OptionRole::kMatters || !is_wanted(option)) continue;
    hasher.add_field(option.name);
    // Many values of one option aren't the values of several.
    hasher.add_field(std::to_string(option.values.size()));
    for (const std::string& value : option.values) hasher.add_field(value);
  }
  return hasher.finish();
}

const std::string& Recall::key() {
  if (key_.empty()) {
    ContentHasher hasher;
    hasher.add_field(request_.command->help.name);
    // Others make their names from those of their inputs.
    if (!request_.command->recalls_by_itself) hasher.add_field(fs::path(*request_.output).filename().string());
    hasher.add_field(key_of([](const GivenOption&) { return true; }));
    key_ = hasher.finish();
  }
  return key_;
}

std::string Recall::key_of_stages(const std::set<std::string>& stages) {
  ContentHasher hasher;
  for (const std::string& stage : stages) hasher.add_field(stage);
  return hasher.add_field(key_of([&](const GivenOption& option) { return stages.contains(option.stage); })).finish();
}

void Recall::store(const std::string& key, const Cache::Content& content, Console& console) const {
  for (const Input& input : inputs_) {
    if (stamp_of(input.path) == input.stamp) continue;
    console.say(input.path.string() + ": was changed meanwhile; the result isn't put into the cache");
    return;
  }
  if (const auto problem = cache_->store(key, content)) console.say("the result isn't put into the cache: " + *problem);
}

void Recall::write_depfile(const fs::path& target) const {
  if (request_.common.depfile.empty()) return;
  std::vector<fs::path> files = inputs();
  std::erase_if(files, [](const fs::path& file) { return stamp_of(file) == kAbsent; });
  write_file_whole(request_.common.depfile, make_rule(target.string(), files));
}

std::string talk_text(const Console::Talk& talk) {
  return Json{{"notes", talk.notes}, {"lines", talk.lines}, {"json", talk.json}}.dump(-1, ' ', false,
                                                                                      Json::error_handler_t::replace);
}

std::optional<Console::Talk> talk_of(const std::string& text, const std::string& input) {
  try {
    const Json json = Json::parse(text);
    Console::Talk talk{json.at("notes"), json.at("lines"), json.at("json")};
    Json results = Json::parse(talk.json);
    if (results.contains("input")) results["input"] = input;
    results["cached"] = true;
    talk.json = results.dump(2, ' ', false, Json::error_handler_t::replace);
    return talk;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

fs::path this_program() { return "/proc/self/exe"; }

}  // namespace lozenge
