#include "pipeline/basisu_asset.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <thread>

#include "formats/base/child_process.h"
#include "formats/base/error.h"
#include "formats/base/scratch_folder.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kLook(10);

/// The program of one of these names that a shell would start; empty where there is none.
std::string find_program(const std::array<std::string_view, 2>& names) {
  const char* set = std::getenv("PATH");
  std::string_view rest = set == nullptr ? std::string_view() : set;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    for (const std::string_view name : names) {
      const fs::path program = fs::path(rest.substr(0, end)) / name;
      if (access(program.c_str(), X_OK) == 0) return program.string();
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "";
}

std::string last_line_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

struct Ending {
  int code = 0;
  std::string complaint;
};

Ending run(const std::vector<std::string>& words, const Progress& progress) {
  const ScratchFolder scratch(fs::temp_directory_path(), "lozenge-basisu-");
  const fs::path complaints = scratch.path() / "err";
  ChildProcess child(words, "/dev/null", complaints);
  std::optional<ChildOutcome> outcome;
  while (!(outcome = child.outcome())) {
    report(progress, "encoding textures", 0);
    std::this_thread::sleep_for(kLook);
  }
  return {outcome->code, last_line_of(complaints)};
}

}  // namespace

BasisuEncoder::BasisuEncoder(fs::path script) : node_(find_program({"node", "nodejs"})), script_(std::move(script)) {
  const auto refuse = [&](const std::string& what) {
    throw Error(
        ExitCode::kSystem,
        fmt::format("NAME.basisu.glb can't be made: {}; install node and, by `npm ci --prefix {}` or `npm install "
                    "--global ktx2-encoder ktx-parse`, what it needs, or ask for --texture-format ktx2",
                    what, script_.parent_path().string()));
  };
  if (node_.empty()) refuse("there is no program node");
  if (std::error_code error; !fs::exists(script_, error)) refuse(script_.string() + " is not there");
  const Ending ending = run({node_, script_.string(), "--check"}, {});
  if (ending.code != 0) refuse(ending.complaint);
}

void BasisuEncoder::encode(const fs::path& asset, const Progress& progress) const {
  const Ending ending = run({node_, script_.string(), asset.string()}, progress);
  if (ending.code == 0) return;
  throw Error(ExitCode::kSystem, fmt::format("{}.basisu.glb can't be made of it: {} ended with {}: {}",
                                             asset.stem().string(), script_.string(), ending.code, ending.complaint));
}

}  // namespace lozenge
