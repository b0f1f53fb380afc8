// Runs `lozenge` as a process of its own, in a folder that is gone afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lozenge::end_to_end {

struct Outcome {
  int code = -1;    ///< exit code, or 128 + signal
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};

/// Runs the program, or another one, with these arguments.
Outcome run(const std::vector<std::string>& arguments, const std::string& program = LOZENGE_PROGRAM);

/// Runs the program, and sends it `signal` as soon as `file` exists.
Outcome run_and_signal(const std::vector<std::string>& arguments, const std::filesystem::path& file, int signal);

/// [name in the folder] content of every file below `folder`, hidden ones too; folders have a / at the end and no
/// content.
std::map<std::string, std::string> content_of(const std::filesystem::path& folder);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// The file of this name in the generated test assets.
std::string test_asset(std::string_view name);

/// A test with an empty folder of its own.
template <typename Base = ::testing::Test>
class InOwnFolder : public Base {
 protected:
  InOwnFolder() {
    std::string name = (std::filesystem::path(::testing::TempDir()) / "lozenge_end_to_end_XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr) << name;
    folder_ = name;
  }
  ~InOwnFolder() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// What is in the folder now.
  std::map<std::string, std::string> content() const { return content_of(folder_); }

  std::filesystem::path folder_;
};

}  // namespace lozenge::end_to_end
