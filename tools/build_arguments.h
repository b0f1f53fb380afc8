// The command line of `build`. What was built before is taken from a cache without the libraries that building needs,
// so this knows nothing of how it is done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/build.h"
#include "tools/command.h"
#include "tools/recall.h"

namespace lozenge {

struct BuildArguments {
  std::string input;
  std::string folder;
  std::string report;
  bool no_preview = false;
  BuildOptions options;

  /// NAME.glb: what build systems call the result.
  std::filesystem::path asset() const;
};

CommandHelp build_help();
void declare_build(Options& options, BuildArguments& arguments);
/// All options but those that say what is built, and where to: as `batch` takes them, too.
void add_build_options(Options& options, BuildOptions& build, bool& no_preview);

/// Puts what an earlier build made in its place, and tells its results.
/// \return whether it was there
bool recall_build(const BuildArguments& arguments, Console& console, Recall& recall);

/// Runs the command line of a `build` as far as the cache alone can answer it, or it can't be understood.
/// \param builder  the program that builds
/// \return the exit code; nothing where there is something to build
std::optional<int> run_recalled_build(const std::filesystem::path& builder, int argc, const char* const* argv);

/// What is said of a build: the report's lines, and its files.
void print_build(const std::vector<std::string>& report_lines, const std::string& json,
                 const std::vector<std::filesystem::path>& files, Console& console);

}  // namespace lozenge
