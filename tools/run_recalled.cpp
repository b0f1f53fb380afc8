// A command of one stage writes where -o says. With a cache it writes into a hidden folder beside that place, from
// which its files go into the cache and then to their places: so what is stored is what this process made, whoever else
// writes to the same place.
#include <fmt/format.h>

#include "formats/base/atomic_file.h"
#include "pipeline/output_set.h"
#include "tools/command.h"
#include "tools/recall.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

fs::path folder_of(const fs::path& place) { return place.has_parent_path() ? place.parent_path() : fs::path("."); }

/// The input that results are said to be of: the first.
std::string subject_of(const Request& request) {
  for (const GivenOption& option : request.given) {
    if (option.role == OptionRole::kInput && !option.name.starts_with("-")) return option.values.front();
  }
  return "";
}

void repeat(const Console::Talk& talk, const Request& request, Console& console) {
  for (const std::string& note : talk.notes) console.note(subject_of(request), note);
  console.print(talk.lines, talk.json);
}

/// \return whether it could be done
bool take_from_cache(const Request& request, Console& console, Recall& recall) {
  const std::optional<CacheEntry> entry = recall.find(recall.key());
  if (!entry) return false;
  const auto text = entry->text(kTalkPart);
  const auto talk = text ? talk_of(*text, subject_of(request)) : std::nullopt;
  bool is_sound = talk.has_value();
  OutputSet outputs(folder_of(*request.output));
  for (const std::string& name : entry->names()) {
    if (name != kTalkPart) is_sound = is_sound && entry->extract(name, outputs.staged(name));
  }
  if (!is_sound) {
    recall.cache().discard(recall.key());
    return false;
  }
  if (request.report != nullptr && !request.report->empty()) write_file_whole(*request.report, talk->json + "\n");
  outputs.commit(fs::path(*request.output).filename().string());
  console.say("taken from the cache");
  repeat(*talk, request, console);
  return true;
}

ExitCode make_and_store(const Request& request, Console& console, Recall& recall) {
  const fs::path place(*request.output);
  OutputSet outputs(folder_of(place));
  *request.output = outputs.staged(place.filename().string()).string();
  const ExitCode code = request.command->run(console, recall);
  *request.output = place.string();
  if (code != ExitCode::kDone) return code;
  Cache::Content content;
  for (const std::string& name : outputs.names()) content.files[name] = outputs.staged(name);
  content.texts[kTalkPart] = talk_text(console.talk());
  recall.store(recall.key(), content, console);
  outputs.commit(place.filename().string());
  return code;
}

}  // namespace

ExitCode run_recalled(const Request& request, Console& console, Recall& recall) {
  const fs::path place(*request.output);
  std::error_code ignored;
  // What is wrong with the place, the command says best.
  const bool can_be_staged =
      place.has_filename() && fs::is_directory(folder_of(place), ignored) && !fs::is_directory(place, ignored);
  if (!can_be_staged) return request.command->run(console, recall);
  if (take_from_cache(request, console, recall)) return ExitCode::kDone;
  return make_and_store(request, console, recall);
}

}  // namespace lozenge
