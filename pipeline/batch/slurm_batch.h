// A batch on a farm that Slurm runs: an array of jobs, each of which builds a shard of the assets, and one that
// gathers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/error.h"
#include "pipeline/batch/batch_list.h"

namespace lozenge {

struct SlurmOptions {
  std::filesystem::path folder;     ///< of the outputs, which every node sees under this name
  std::filesystem::path program;    ///< the same
  std::vector<std::string> batch;   ///< options of each task's `batch`
  std::vector<std::string> sbatch;  ///< options of sbatch, for all jobs
  int shards = 0;                   ///< 0: one for each asset, as far as Slurm's arrays go
  int processors = 1;               ///< that a task uses
  bool wait = false;                ///< until all is gathered
};

/// Of an output folder: the folder of the lists, scripts and logs of its tasks, and of their manifests.
std::filesystem::path slurm_folder(const std::filesystem::path& outputs);

/// The manifests of all tasks that there have been.
std::vector<std::filesystem::path> slurm_manifests(const std::filesystem::path& outputs);

struct SlurmJobs {
  std::string array;  ///< the number of the array
  std::string gather;
  std::size_t tasks = 0;
  ExitCode code = ExitCode::kDone;  ///< of what was gathered, where that was waited for
};

/// Submits the jobs. \param items  that are to be built \param all  of the batch, for the one who gathers
/// \throws Error(kSystem) where Slurm's programs aren't there, or refuse
SlurmJobs submit_batch(const std::vector<BatchItem>& items, const std::vector<BatchItem>& all,
                       const SlurmOptions& options);

}  // namespace lozenge
