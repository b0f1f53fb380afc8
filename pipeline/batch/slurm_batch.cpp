// A task's manifest is its memory: a task that is requeued, or runs again after it was killed, reads it and builds what
// isn't in it. All tasks keep going where an asset fails; who gathers says what failed.
#include "pipeline/batch/slurm_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <thread>

#include "formats/base/atomic_file.h"
#include "formats/base/child_process.h"
#include "formats/base/scratch_folder.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

/// Slurm's default.
constexpr std::size_t kUsualMaxArraySize = 1001;

struct Answer {
  int code = 0;
  std::string out;
  std::string err;
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Runs one of Slurm's programs, found as the shell finds it.
Answer run(const std::vector<std::string>& words, const fs::path& folder) {
  const ScratchFolder scratch(folder, ".lozenge-slurm-");
  std::vector<std::string> all{"/usr/bin/env"};
  all.insert(all.end(), words.begin(), words.end());
  ChildProcess process(all, scratch.path() / "out", scratch.path() / "err");
  std::optional<ChildOutcome> outcome;
  while (!(outcome = process.outcome())) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return {outcome->code, text_of(scratch.path() / "out"), text_of(scratch.path() / "err")};
}

[[noreturn]] void refuse(const std::string& program, const Answer& answer) {
  std::string reason = answer.err.substr(0, answer.err.find('\n'));
  throw Error(ExitCode::kSystem, fmt::format("{} ended with {}: {}", program, answer.code, reason));
}

/// The most tasks that an array may have.
std::size_t max_array_size(const fs::path& folder) {
  const Answer answer = run({"scontrol", "show", "config"}, folder);
  if (answer.code != 0) refuse("scontrol", answer);
  constexpr std::string_view kKey = "MaxArraySize";
  std::size_t at = answer.out.find(kKey);
  if (at == std::string::npos) return kUsualMaxArraySize;
  at = answer.out.find_first_of("0123456789", at + kKey.size());
  std::size_t size = 0;
  const char* end = answer.out.data() + answer.out.size();
  if (at == std::string::npos || std::from_chars(answer.out.data() + at, end, size).ec != std::errc()) {
    return kUsualMaxArraySize;
  }
  return std::max<std::size_t>(size, 1);
}

/// For a shell.
std::string quoted(const std::string& word) {
  std::string text;
  for (const char c : word) {
    if (c == '\'') text.append("'\\'");
    text.push_back(c);
  }
  return fmt::format("'{}'", text);
}

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += fmt::format("{}{}", line.empty() ? "" : " ", quoted(word));
  return line;
}

void write_script(const fs::path& file, const std::string& command) {
  write_file_whole(file, "#!/bin/sh\nexec " + command + "\n");
}

/// \return the number of the job
std::string submit(std::vector<std::string> words, const SlurmOptions& options, const fs::path& script,
                   const fs::path& folder, ExitCode* code = nullptr) {
  words.insert(words.begin(), {"sbatch", "--parsable"});
  words.insert(words.end(), options.sbatch.begin(), options.sbatch.end());
  words.push_back(script.string());
  const Answer answer = run(words, folder);
  const std::string job = answer.out.substr(0, answer.out.find_first_of(";\n"));
  if (job.empty() || (answer.code != 0 && code == nullptr)) refuse("sbatch", answer);
  if (code != nullptr) *code = static_cast<ExitCode>(answer.code);
  return job;
}

/// A name for the shards of one submission, so that those of an earlier one stay what they are while its tasks run.
std::string new_round(const fs::path& folder) {
  for (int round = 1;; ++round) {
    if (fs::create_directory(folder / fmt::format("round-{}", round))) return fmt::format("round-{}", round);
  }
}

}  // namespace

fs::path slurm_folder(const fs::path& outputs) { return outputs / "slurm"; }

std::vector<fs::path> slurm_manifests(const fs::path& outputs) {
  std::vector<fs::path> files;
  std::error_code ignored;
  fs::recursive_directory_iterator entry(slurm_folder(outputs), ignored);
  for (const fs::recursive_directory_iterator end; !ignored && entry != end; entry.increment(ignored)) {
    if (entry->path().filename().string().starts_with("manifest-")) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

SlurmJobs submit_batch(const std::vector<BatchItem>& items, const std::vector<BatchItem>& all,
                       const SlurmOptions& options) {
  const fs::path folder = slurm_folder(options.folder);
  fs::create_directories(folder);
  const std::size_t most = max_array_size(folder);
  const std::size_t wanted = options.shards > 0 ? static_cast<std::size_t>(options.shards) : items.size();
  const std::vector<std::vector<BatchItem>> shards = in_shards(items, std::min(wanted, most));
  const fs::path round = folder / new_round(folder);
  for (std::size_t k = 0; k < shards.size(); ++k) {
    write_file_whole(round / fmt::format("shard-{}.txt", k), list_text(shards[k]));
  }
  write_file_whole(folder / "all.txt", list_text(all));

  const std::string program = quoted(options.program.string());
  const std::string outputs = quoted(options.folder.string());
  write_script(round / "task.sh",
               fmt::format("{} batch {}\"$SLURM_ARRAY_TASK_ID\".txt -o {} --manifest {}\"$SLURM_ARRAY_TASK_ID\".jsonl "
                           "--no-page --keep-going {}",
                           program, quoted((round / "shard-").string()), outputs,
                           quoted((round / "manifest-").string()), command_line(options.batch)));
  write_script(round / "gather.sh",
               fmt::format("{} batch {} -o {} --gather", program, quoted((folder / "all.txt").string()), outputs));
  SlurmJobs jobs;
  jobs.tasks = shards.size();
  jobs.array = submit({fmt::format("--array=0-{}", shards.size() - 1), "--job-name=lozenge",
                       fmt::format("--cpus-per-task={}", options.processors), "--requeue", "--open-mode=append",
                       "--output=" + (round / "task-%a.log").string()},
                      options, round / "task.sh", folder);
  std::vector<std::string> gather{"--dependency=afterany:" + jobs.array, "--job-name=lozenge-gather",
                                  "--open-mode=append", "--output=" + (round / "gather.log").string()};
  if (options.wait) gather.emplace_back("--wait");
  jobs.gather = submit(gather, options, round / "gather.sh", folder, options.wait ? &jobs.code : nullptr);
  return jobs;
}

}  // namespace lozenge
