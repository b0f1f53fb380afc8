#include "tests/fuzz/fuzz_target.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "formats/base/error.h"

namespace lozenge::fuzz {

namespace {

namespace fs = std::filesystem;

/// A folder of this process, in memory where there is such a place; removed at exit.
const fs::path& folder() {
  struct Folder {
    fs::path path;
    Folder() {
      const fs::path memory = "/dev/shm";
      std::string name =
          ((fs::is_directory(memory) ? memory : fs::temp_directory_path()) / "lozenge_fuzz_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) std::abort();
      path = name;
    }
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  };
  static const Folder made;
  return made.path;
}

}  // namespace

void read_as_file(const std::uint8_t* data, std::size_t size, const std::string& name,
                  const std::function<void(const fs::path&)>& read) {
  const fs::path file = folder() / name;
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    read(file);
  } catch (const Error& error) {
    const bool blames_input = error.code() == ExitCode::kUnusableInput || error.code() == ExitCode::kUnsupported ||
                              error.code() == ExitCode::kLimit;
    if (blames_input && std::string(error.what()).find(name) != std::string::npos) return;
    std::fprintf(stderr, "exit code %d: %s\n", static_cast<int>(error.code()), error.what());
    std::abort();
  }
}

}  // namespace lozenge::fuzz
