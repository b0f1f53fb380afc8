#include "tests/end_to_end/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

extern char** environ;

namespace lozenge::end_to_end {
namespace fs = std::filesystem;
namespace {

/// A temporary file that the child writes and we read.
class Capture {
 public:
  Capture() : file_((fs::path(::testing::TempDir()) / "lozenge_output_XXXXXX").string()) {
    descriptor_ = mkstemp(file_.data());
    EXPECT_GE(descriptor_, 0) << file_;
  }
  ~Capture() {
    close(descriptor_);
    fs::remove(file_);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const { return read_text(file_); }

 private:
  std::string file_;
  int descriptor_ = -1;
};

/// The program, started.
class Child {
 public:
  Child(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out_.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.descriptor(), STDERR_FILENO);
    const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("can't run " + program);
  }

  pid_t process() const { return process_; }

  /// Waits until it ends.
  Outcome outcome() const {
    int status = 0;
    waitpid(process_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, out_.text(), err_.text()};
  }

 private:
  Capture out_, err_;
  pid_t process_ = 0;
};

/// Whether it has ended; it stays there to be waited for.
bool has_ended(const Child& child) {
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(child.process()), &info, WEXITED | WNOHANG | WNOWAIT);
  return info.si_pid != 0;
}

}  // namespace

Outcome run(const std::vector<std::string>& arguments, const std::string& program) {
  return Child(program, arguments).outcome();
}

Outcome run_and_signal(const std::vector<std::string>& arguments, const fs::path& file, int signal) {
  const Child child(LOZENGE_PROGRAM, arguments);
  while (!fs::exists(file) && !has_ended(child)) usleep(1000);
  kill(child.process(), signal);
  return child.outcome();
}

std::map<std::string, std::string> content_of(const fs::path& folder) {
  std::map<std::string, std::string> content;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_directory()) {
      content[name + "/"];
    } else {
      content[name] = read_text(entry.path());
    }
  }
  return content;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string test_asset(std::string_view name) { return (fs::path(LOZENGE_TEST_ASSETS) / name).string(); }

}  // namespace lozenge::end_to_end
