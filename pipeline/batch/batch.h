// Many assets, each built by a process of its own, so that one that fails, hangs or is killed costs no other anything.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "formats/base/error.h"
#include "formats/base/progress.h"
#include "pipeline/batch/batch_list.h"
#include "pipeline/batch/batch_manifest.h"

namespace lozenge {

struct BatchOptions {
  std::filesystem::path folder;    ///< of the outputs
  std::filesystem::path manifest;  ///< grows as assets are done, and is read first: what is in it needn't be done again
  std::filesystem::path program;   ///< that has the command `build`
  std::string program_hash;        ///< what another program made is made again
  std::vector<std::string> build;  ///< options of the build
  std::vector<std::string> workplace;  ///< further ones, which don't matter to what it makes
  int jobs = 1;                        ///< at the same time
  double timeout = 0;                  ///< seconds that an asset may take; 0: any
  bool keep_going = false;             ///< whether the others are built where one fails
  /// Called as each asset ends, from the thread that runs the batch.
  std::function<void(const BatchRow&)> asset_done;
};

struct BatchResult {
  std::vector<BatchRow> rows;  ///< of all assets that there is a row for, by asset
  std::int64_t assets = 0;
  std::int64_t kept = 0;     ///< rows that were in the manifest
  std::int64_t not_run = 0;  ///< assets without a row, because one failed before
  double seconds = 0;

  std::int64_t count(const std::string& status) const;
  std::int64_t failures() const { return static_cast<std::int64_t>(rows.size()) - count("done"); }
  /// kDone where all are done; else what is wrong with the first that isn't: its own code, kLimit where it took too
  /// long, kSystem where it was killed or lost.
  ExitCode code() const;
};

/// Builds what isn't built yet, the most work first. The manifest is complete, with a row an asset, when this returns.
/// What was refused because of what it is (codes 3 and 4) is not tried again until it changes.
/// \throws Error(kUsage) or Error(kSystem) where the outputs can't be written
BatchResult run_batch(std::vector<BatchItem> items, const BatchOptions& options, const Progress& progress = {});

/// Builds nothing: what there is of the rows of `items` in several manifests; the others are "lost".
BatchResult gather_batch(const std::vector<BatchItem>& items, const std::vector<std::filesystem::path>& manifests);

/// Whether a row says what building this item would come to.
bool is_settled(const BatchRow& row, const BatchItem& item, const BatchOptions& options);

/// How many, how long, and what failed.
std::vector<std::string> batch_lines(const BatchResult& result);
std::string batch_json(const BatchResult& result);

}  // namespace lozenge
