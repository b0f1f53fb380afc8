#include "pipeline/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "formats/base/child_process.h"
#include "formats/base/content_hash.h"
#include "formats/base/scratch_folder.h"
#include "formats/files/named_files.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(10);
/// After it was asked to end, a process has this long to remove what it has begun.
constexpr double kGrace = 5;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The last line of what a process complained about, which says why it ended; without the names of program and asset.
std::string complaint_in(const fs::path& file, const std::string& asset) {
  std::string text = text_of(file);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::string line = text.substr(text.find_last_of('\n') + 1);
  constexpr std::string_view kTitle = "lozenge build: ";
  if (line.starts_with(kTitle)) line.erase(0, kTitle.size());
  if (line.starts_with(asset + ": ")) line.erase(0, asset.size() + 2);
  return line;
}

std::string options_text(const BatchOptions& options) { return fmt::format("{}", fmt::join(options.build, " ")); }

/// What a build reported, as far as the manifest has it.
void take_report(const std::string& text, BatchRow& row) {
  const Json report = Json::parse(text);
  row.cached = report.value("cached", false);
  row.samples = report.at("patches").at("samples");
  row.distortion = report.at("distortion").at("aggregate");
  const Json& asset = report.at("asset");
  row.triangles = asset.at("level_triangles").get<std::vector<std::int64_t>>();
  if (asset.contains("mean_distance_percent")) row.deviation = asset["mean_distance_percent"];
  if (asset.contains("max_distance_percent")) row.largest_deviation = asset["max_distance_percent"];
}

bool by_asset(const BatchRow& a, const BatchRow& b) {
  return std::tie(a.asset, a.output) < std::tie(b.asset, b.output);
}

/// One asset while it is built.
struct Job {
  BatchItem item;
  std::string hash;
  fs::path out;
  fs::path err;
  std::unique_ptr<ChildProcess> process;
  bool timed_out = false;
  bool was_killed = false;
};

class Batch {
 public:
  Batch(const BatchOptions& options, const Progress& progress)
      : options_(options), progress_(progress), scratch_(options.folder, ".lozenge-batch-") {}

  BatchResult run(std::vector<BatchItem> items) {
    const Clock::time_point start = Clock::now();
    result_.assets = static_cast<std::int64_t>(items.size());
    for (const BatchItem& item : items) work_ += work_of(item);
    tell();
    keep_settled(items);
    sort_by_work(items);
    for (BatchItem& item : items) {
      while (static_cast<int>(jobs_.size()) >= options_.jobs) look();
      if (failed_ && !options_.keep_going) break;
      begin(std::move(item));
    }
    while (!jobs_.empty()) look();
    result_.not_run = result_.assets - static_cast<std::int64_t>(result_.rows.size());
    std::sort(result_.rows.begin(), result_.rows.end(), by_asset);
    write_manifest(options_.manifest, result_.rows);
    result_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return std::move(result_);
  }

 private:
  void tell() const { report(progress_, "assets", work_ > 0 ? work_done_ / work_ : 1); }

  /// Takes those from `items` that the manifest settles.
  void keep_settled(std::vector<BatchItem>& items) {
    const std::map<std::string, BatchRow> known = read_manifest(options_.manifest);
    std::erase_if(items, [&](const BatchItem& item) {
      const auto row = known.find(item.output);
      if (row == known.end() || !is_settled(row->second, item, options_)) return false;
      ++result_.kept;
      settle(row->second, item);
      return true;
    });
  }

  void settle(const BatchRow& row, const BatchItem& item) {
    work_done_ += work_of(item);
    failed_ = failed_ || !row.is_done();
    result_.rows.push_back(row);
    tell();
  }

  void begin(BatchItem item) {
    Job job;
    const fs::path output = options_.folder / item.output;
    fs::create_directories(output.parent_path());
    job.out = scratch_.path() / fmt::format("{}.json", started_);
    job.err = scratch_.path() / fmt::format("{}.err", started_);
    ++started_;
    std::vector<std::string> words{options_.program.string(),
                                   "build",
                                   fs::absolute(item.path).string(),
                                   "-o",
                                   output.parent_path().string(),
                                   "--name",
                                   output.filename().string(),
                                   "--json",
                                   "--quiet"};
    words.insert(words.end(), options_.build.begin(), options_.build.end());
    words.insert(words.end(), options_.workplace.begin(), options_.workplace.end());
    job.item = std::move(item);
    job.hash = hash_of(job.item);
    job.process = std::make_unique<ChildProcess>(words, job.out, job.err);
    jobs_.push_back(std::move(job));
  }

  static std::string hash_of(const BatchItem& item) {
    try {
      return content_hash_of_asset(item.path);
    } catch (const Error&) {
      return "";  // the build will say what is wrong
    }
  }

  /// At all that run; waits a little.
  void look() {
    std::this_thread::sleep_for(kLook);
    tell();
    for (auto job = jobs_.begin(); job != jobs_.end();) {
      limit_time(*job);
      const std::optional<ChildOutcome> outcome = job->process->outcome();
      if (outcome) end(*job, *outcome);
      job = outcome ? jobs_.erase(job) : std::next(job);
    }
  }

  void limit_time(Job& job) const {
    if (options_.timeout <= 0 || job.process->seconds() < options_.timeout) return;
    if (!job.timed_out) job.process->send(SIGTERM);
    job.timed_out = true;
    if (job.was_killed || job.process->seconds() < options_.timeout + kGrace) return;
    job.process->send(SIGKILL);
    job.was_killed = true;
  }

  void end(const Job& job, const ChildOutcome& outcome) {
    BatchRow row;
    row.asset = job.item.asset;
    row.hash = job.hash;
    row.options = options_text(options_);
    row.program = options_.program_hash;
    row.status = "done";
    row.code = outcome.code;
    row.seconds = outcome.seconds;
    row.memory_mb = outcome.peak_memory_mb;
    row.output = job.item.output;
    if (outcome.code == 0) {
      try {
        take_report(text_of(job.out), row);
      } catch (const nlohmann::json::exception& error) {
        row.status = "failed";
        row.code = static_cast<int>(ExitCode::kInternal);
        row.message = fmt::format("its report can't be read: {}", error.what());
      }
    } else if (job.timed_out) {
      row.status = "timeout";
      row.message = fmt::format("took more than {} s", options_.timeout);
    } else if (outcome.signal != 0) {
      row.status = "killed";
      row.message = fmt::format("was ended by signal {}{}", outcome.signal,
                                outcome.signal == SIGKILL ? ": perhaps the system ran out of memory" : "");
    } else {
      row.status = "failed";
      row.message = complaint_in(job.err, job.item.path.filename().string());
    }
    std::error_code ignored;
    fs::remove(job.out, ignored);
    fs::remove(job.err, ignored);
    append_row(options_.manifest, row);
    if (options_.asset_done) options_.asset_done(row);
    settle(row, job.item);
  }

  const BatchOptions& options_;
  const Progress& progress_;
  ScratchFolder scratch_;
  std::list<Job> jobs_;
  BatchResult result_;
  std::int64_t started_ = 0;
  double work_ = 0;
  double work_done_ = 0;
  bool failed_ = false;
};

BatchRow lost(const BatchItem& item) {
  BatchRow row;
  row.asset = item.asset;
  row.output = item.output;
  row.status = "lost";
  row.message = "nobody came to it";
  return row;
}

/// What a row that isn't done means for the whole.
ExitCode code_of(const BatchRow& row) {
  if (row.status == "timeout") return ExitCode::kLimit;
  if (row.status == "killed" || row.status == "lost") return ExitCode::kSystem;
  const bool is_ours = row.code >= 1 && row.code <= static_cast<int>(ExitCode::kSystem);
  return is_ours ? static_cast<ExitCode>(row.code) : ExitCode::kSystem;
}

}  // namespace

std::int64_t BatchResult::count(const std::string& status) const {
  return std::count_if(rows.begin(), rows.end(), [&](const BatchRow& row) { return row.status == status; });
}

ExitCode BatchResult::code() const {
  for (const BatchRow& row : rows) {
    if (!row.is_done()) return code_of(row);
  }
  return ExitCode::kDone;
}

bool is_settled(const BatchRow& row, const BatchItem& item, const BatchOptions& options) {
  const bool is_refused = row.status == "failed" && (row.code == static_cast<int>(ExitCode::kUnusableInput) ||
                                                     row.code == static_cast<int>(ExitCode::kUnsupported));
  if (!row.is_done() && !is_refused) return false;
  if (row.program != options.program_hash || row.options != options_text(options) || row.output != item.output) {
    return false;
  }
  std::error_code ignored;
  if (row.is_done() && !fs::exists(options.folder / (row.output + ".glb"), ignored)) return false;
  try {
    return row.hash == content_hash_of_asset(item.path);
  } catch (const Error&) {
    return false;
  }
}

BatchResult run_batch(std::vector<BatchItem> items, const BatchOptions& options, const Progress& progress) {
  try {
    fs::create_directories(options.folder);
    if (options.manifest.has_parent_path()) fs::create_directories(options.manifest.parent_path());
    return Batch(options, progress).run(std::move(items));
  } catch (const fs::filesystem_error& error) {
    throw Error(code_of_refusal(error.code().value()),
                fmt::format("{}: can't be the output folder: {}", options.folder.string(), error.code().message()));
  }
}

BatchResult gather_batch(const std::vector<BatchItem>& items, const std::vector<fs::path>& manifests) {
  std::map<std::string, BatchRow> rows;  // [output]
  for (const fs::path& manifest : manifests) {
    for (auto& [output, row] : read_manifest(manifest)) {
      BatchRow& known = rows[output];
      if (!known.is_done() || row.is_done()) known = std::move(row);
    }
  }
  BatchResult result;
  result.assets = static_cast<std::int64_t>(items.size());
  for (const BatchItem& item : items) {
    const auto row = rows.find(item.output);
    result.rows.push_back(row != rows.end() ? row->second : lost(item));
    result.rows.back().asset = item.asset;
  }
  std::sort(result.rows.begin(), result.rows.end(), by_asset);
  return result;
}

std::vector<std::string> batch_lines(const BatchResult& result) {
  std::int64_t cached = 0;
  double memory = 0;
  double seconds = 0;
  std::vector<std::string> lines;
  for (const BatchRow& row : result.rows) {
    cached += row.cached ? 1 : 0;
    memory = std::max(memory, row.memory_mb);
    seconds += row.seconds;
    if (!row.is_done()) lines.push_back(fmt::format("{:<11} {}: {}", row.status, row.asset, row.message));
  }
  lines.push_back(fmt::format("assets      {}: {} done, {} failed, {} timed out, {} killed, {} lost, {} not begun",
                              result.assets, result.count("done"), result.count("failed"), result.count("timeout"),
                              result.count("killed"), result.count("lost"), result.not_run));
  lines.push_back(fmt::format("of them     {} were there before, {} from the cache", result.kept, cached));
  lines.push_back(fmt::format("total       {:.1f} s, {:.1f} s of all processes, {:.0f} MB the largest", result.seconds,
                              seconds, memory));
  return lines;
}

std::string batch_json(const BatchResult& result) {
  Json json{{"assets", result.assets},
            {"kept", result.kept},
            {"not_begun", result.not_run},
            {"seconds", result.seconds},
            {"code", static_cast<int>(result.code())}};
  for (const char* status : {"done", "failed", "timeout", "killed", "lost"}) json[status] = result.count(status);
  json["rows"] = Json::array();
  for (const BatchRow& row : result.rows) json["rows"].push_back(Json::parse(row_text(row)));
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lozenge
