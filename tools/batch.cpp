// lozenge batch: many assets, on this machine or on a farm.
#include "pipeline/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "formats/base/atomic_file.h"
#include "formats/base/content_hash.h"
#include "pipeline/batch/batch_page.h"
#include "pipeline/batch/slurm_batch.h"
#include "pipeline/build.h"
#include "tools/build_arguments.h"
#include "tools/commands.h"
#include "tools/program.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExamples =
    "  all assets of a folder, two at a time; again, after it was stopped, only what isn't done yet\n"
    "    lozenge batch assets/ -o out/ --jobs 2 --keep-going\n"
    "  those of a list, with options of `build`, none longer than ten minutes\n"
    "    lozenge batch assets.txt -o out/ --timeout 600 --map-size 1024 --cache ~/.cache/lozenge\n"
    "  on a farm that Slurm runs\n"
    "    lozenge batch /shared/assets -o /shared/out --slurm --shards 100 --sbatch=--partition=day";

struct Arguments {
  std::string input;
  std::string folder;
  std::string manifest;
  std::string cache;
  int jobs = 1;
  double timeout = 0;
  bool keep_going = false;
  bool no_page = false;
  bool gather = false;
  bool slurm = false;
  int shards = 0;
  bool wait = false;
  std::vector<std::string> sbatch;
  // Of each build; they are handed on as they were given.
  BuildOptions build;
  bool no_preview = false;
};

std::vector<BatchItem> items_of(const Arguments& arguments) {
  std::error_code ignored;
  return fs::is_directory(arguments.input, ignored) ? items_in_folder(arguments.input, arguments.folder)
                                                    : items_in_list(arguments.input);
}

/// The options of `build` that were given, as they were given: those that matter to what it makes, or the others.
std::vector<std::string> build_words(const Request& request, bool that_matter) {
  std::vector<std::string> words;
  for (const GivenOption& option : request.given) {
    if (option.stage.empty() || (option.role != OptionRole::kDoesntMatter) != that_matter) continue;
    words.push_back(option.name);
    if (!option.is_flag) words.insert(words.end(), option.values.begin(), option.values.end());
  }
  return words;
}

/// What each build gets that doesn't matter to what it makes.
std::vector<std::string> words_of_workplace(const Arguments& arguments, const Request& request) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int threads = request.common.threads > 0 ? request.common.threads : std::max(1, cores / arguments.jobs);
  std::vector<std::string> words{"--threads", std::to_string(threads)};
  if (!arguments.cache.empty()) words.insert(words.end(), {"--cache", fs::absolute(arguments.cache).string()});
  const std::vector<std::string> limits = build_words(request, false);
  words.insert(words.end(), limits.begin(), limits.end());
  return words;
}

fs::path usual_manifest(const fs::path& folder) { return folder / "manifest.jsonl"; }

BatchOptions batch_options(const Arguments& arguments, const Request& request, Console& console) {
  BatchOptions options;
  options.folder = arguments.folder;
  options.manifest = arguments.manifest.empty() ? usual_manifest(arguments.folder) : fs::path(arguments.manifest);
  options.program = fs::read_symlink(this_program());
  options.program_hash = content_hash_of_file(builder_program()).substr(0, 16);
  options.build = build_words(request, true);
  options.workplace = words_of_workplace(arguments, request);
  options.jobs = arguments.jobs;
  options.timeout = arguments.timeout;
  options.keep_going = arguments.keep_going;
  options.asset_done = [&console](const BatchRow& row) {
    if (!row.is_done()) console.say(fmt::format("{}: {}: {}", row.asset, row.status, row.message));
  };
  return options;
}

ExitCode finish(const Arguments& arguments, const BatchResult& result, Console& console) {
  const fs::path page = fs::path(arguments.folder) / "summary.html";
  if (!arguments.no_page) write_file_whole(page, batch_page(result.rows));
  std::vector<std::string> lines = batch_lines(result);
  if (!arguments.no_page) lines.push_back("wrote       " + page.string());
  console.print(lines, batch_json(result));
  return result.code();
}

/// Every manifest that there is of this output folder.
std::vector<fs::path> all_manifests(const fs::path& folder) {
  std::vector<fs::path> manifests{usual_manifest(folder)};
  for (fs::path& file : slurm_manifests(folder)) manifests.push_back(std::move(file));
  return manifests;
}

ExitCode gather(const Arguments& arguments, const std::vector<BatchItem>& items, Console& console) {
  const BatchResult result = gather_batch(items, all_manifests(arguments.folder));
  write_manifest(usual_manifest(arguments.folder), result.rows);
  return finish(arguments, result, console);
}

/// Words for the `batch` of each task.
std::vector<std::string> words_of_task(const Arguments& arguments, const Request& request) {
  std::vector<std::string> words = build_words(request, true);
  const std::vector<std::string> limits = build_words(request, false);
  words.insert(words.end(), limits.begin(), limits.end());
  for (const GivenOption& option : request.given) {
    const bool goes_on = option.name == "--jobs" || option.name == "--timeout";
    if (goes_on) words.insert(words.end(), {option.name, option.values.front()});
  }
  words.insert(words.end(), {"--threads", std::to_string(std::max(1, request.common.threads))});
  if (!arguments.cache.empty()) words.insert(words.end(), {"--cache", fs::absolute(arguments.cache).string()});
  return words;
}

ExitCode submit(const Arguments& arguments, const std::vector<BatchItem>& items, const Request& request,
                Console& console) {
  const BatchOptions batch = batch_options(arguments, request, console);
  const BatchResult known = gather_batch(items, all_manifests(arguments.folder));
  std::map<std::string, BatchRow> rows;
  for (const BatchRow& row : known.rows) rows[row.output] = row;
  std::vector<BatchItem> left;
  for (const BatchItem& item : items) {
    if (!is_settled(rows[item.output], item, batch)) left.push_back(item);
  }
  if (left.empty()) return gather(arguments, items, console);
  SlurmOptions options;
  options.folder = fs::absolute(arguments.folder).lexically_normal();
  options.program = batch.program;
  options.batch = words_of_task(arguments, request);
  options.sbatch = arguments.sbatch;
  options.shards = arguments.shards;
  options.processors = arguments.jobs * std::max(1, request.common.threads);
  options.wait = arguments.wait;
  const SlurmJobs jobs = submit_batch(left, items, options);
  const nlohmann::ordered_json json{{"array", jobs.array},
                                    {"gather", jobs.gather},
                                    {"tasks", jobs.tasks},
                                    {"assets", left.size()},
                                    {"settled", items.size() - left.size()}};
  console.print({fmt::format("submitted   {} assets in {} tasks, job {}; job {} gathers them", left.size(), jobs.tasks,
                             jobs.array, jobs.gather),
                 fmt::format("settled     {} assets that needn't be built again", items.size() - left.size())},
                json.dump(2));
  return jobs.code;
}

ExitCode run(const Arguments& arguments, Console& console, Recall& recall) {
  const Request& request = recall.request();
  const std::vector<BatchItem> items = items_of(arguments);
  if (arguments.gather) return gather(arguments, items, console);
  if (arguments.slurm) return submit(arguments, items, request, console);
  return finish(arguments, run_batch(items, batch_options(arguments, request, console), console.progress()), console);
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "A folder of assets, or a list of them, one a line");
  options.output(arguments.folder, "The folder for all outputs, manifest.jsonl and summary.html");
  options.group("Batch");
  options.number("--jobs J", arguments.jobs, {1, 1024}, "Assets that are built at the same time").shows_default();
  options.number("--timeout SECONDS", arguments.timeout, {0, 1e9}, "Stop an asset that takes longer; 0: none")
      .shows_default();
  options.flag("--keep-going", arguments.keep_going, "Build all others where an asset fails");
  options.text("--manifest FILE", arguments.manifest,
               "What became of each asset (default: manifest.jsonl in the output "
               "folder); what is in it already isn't built again");
  options.flag("--no-page", arguments.no_page, "Don't write summary.html");
  options.text("--cache DIR", arguments.cache, "As for `build`");
  options.group("On a farm");
  options.flag("--slurm", arguments.slurm, "Submit the assets to Slurm, in an array of jobs, and a job that gathers");
  options.number("--shards K", arguments.shards, {1, 1'000'000},
                 "Tasks of the array [one for each asset, as far as Slurm's MaxArraySize goes]");
  options.texts("--sbatch OPTION", arguments.sbatch, "Options of sbatch, as --sbatch=--partition=day");
  options.flag("--wait", arguments.wait, "Wait until all is gathered; the exit code tells what became of it");
  options.flag("--gather", arguments.gather,
               "Build nothing: make one manifest and the summary of those that tasks left");
  add_build_options(options, arguments.build, arguments.no_preview);
}

}  // namespace

Command batch_command() {
  Command command = make_recalling_command<Arguments>(
      {"batch", "Build many assets, each in a process of its own", kPipelineGroup, kExamples}, declare, run);
  command.is_repeatable = false;  // each of its builds is
  return command;
}

}  // namespace lozenge
