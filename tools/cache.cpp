// lozenge cache: how large a cache is, and how to make it smaller.
#include "pipeline/cache/cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "formats/base/memory_budget.h"
#include "tools/commands.h"
#include "tools/progress_display.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  what is in it\n"
    "    lozenge cache info --cache ~/.cache/lozenge\n"
    "  remove what was used longest ago until 20 GB are left, also while others use it\n"
    "    lozenge cache prune --max-size 20G";

enum class Action { kInfo, kPrune };

struct Arguments {
  std::optional<Action> action;
  std::string folder;
  std::optional<std::uint64_t> max_size;
};

std::string json_of(const Cache& cache, const Cache::Facts& facts) {
  return nlohmann::ordered_json{{"folder", cache.folder().string()},
                                {"entries", facts.entries},
                                {"bytes", facts.bytes},
                                {"oldest_use_seconds", facts.oldest_use},
                                {"removed_entries", facts.removed},
                                {"removed_bytes", facts.removed_bytes}}
      .dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> lines_of(const Cache& cache, const Cache::Facts& facts) {
  std::vector<std::string> lines{"folder   " + cache.folder().string(),
                                 fmt::format("entries  {}, {}", facts.entries, readable_bytes(facts.bytes))};
  if (facts.entries > 0) lines.push_back(fmt::format("oldest   used {} ago", duration_text(facts.oldest_use)));
  if (facts.removed > 0) {
    lines.push_back(fmt::format("removed  {}, {}", facts.removed, readable_bytes(facts.removed_bytes)));
  }
  return lines;
}

ExitCode run(const Arguments& arguments, Console& console) {
  const char* usual = std::getenv("LOZENGE_CACHE");
  const std::string folder = arguments.folder.empty() && usual != nullptr ? usual : arguments.folder;
  if (folder.empty()) throw Error(ExitCode::kUsage, "which cache? Name its folder with --cache, or in LOZENGE_CACHE");
  if (arguments.action == Action::kPrune && !arguments.max_size) {
    throw Error(ExitCode::kUsage, "prune to what size? Give --max-size, as 20G");
  }
  const Cache cache(folder);
  const Cache::Facts facts = arguments.action == Action::kPrune ? cache.prune(*arguments.max_size) : cache.facts();
  console.print(lines_of(cache, facts), json_of(cache, facts));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options
      .choice("action", arguments.action, Words<Action>{{"info", Action::kInfo}, {"prune", Action::kPrune}},
              "info: how much is in it; prune: remove what was used longest ago, and what killed processes left")
      .is_required();
  options.text("--cache DIR", arguments.folder, "The cache's folder; without it, the one in LOZENGE_CACHE");
  options.bytes("--max-size SIZE", arguments.max_size, "Remove entries until all take no more than this, such as 20G");
}

}  // namespace

Command cache_command() {
  return make_command<Arguments>({"cache", "Look after a cache of what was made before", kPipelineGroup, kExamples},
                                 declare, run);
}

}  // namespace lozenge
