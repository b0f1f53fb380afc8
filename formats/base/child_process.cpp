#include "formats/base/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "formats/base/error.h"

namespace lozenge {
namespace {

using Clock = std::chrono::steady_clock;

/// A program that is asked to end removes what it has begun.
constexpr std::chrono::seconds kGrace(5);
constexpr std::chrono::milliseconds kLook(10);

void redirect(int to, const char* path, int flags) {
  const int descriptor = open(path, flags, 0666);
  if (descriptor < 0) _exit(127);
  dup2(descriptor, to);
  close(descriptor);
}

/// In the new process. Between fork and exec only what POSIX allows there is called.
[[noreturn]] void become(char* const* argv, const char* out, const char* err, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before we asked to be told
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, out, O_WRONLY | O_CREAT | O_TRUNC);
  redirect(STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  execv(argv[0], argv);
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& out,
                           const std::filesystem::path& err)
    : start_(Clock::now()) {
  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0) {
    throw Error(ExitCode::kSystem, words.front() + ": no process can be started: " + std::strerror(errno));
  }
  if (process_ == 0) become(argv.data(), out.c_str(), err.c_str(), parent);
  setpgid(process_, process_);  // whichever of the two comes first
}

ChildProcess::~ChildProcess() {
  if (process_ == 0) return;
  send(SIGTERM);
  const Clock::time_point end = Clock::now() + kGrace;
  while (Clock::now() < end) {
    if (outcome()) return;
    std::this_thread::sleep_for(kLook);
  }
  send(SIGKILL);
  waitpid(process_, nullptr, 0);
}

std::optional<ChildOutcome> ChildProcess::outcome() {
  int status = 0;
  rusage usage{};
  if (wait4(process_, &status, WNOHANG, &usage) != process_) return std::nullopt;
  process_ = 0;
  ChildOutcome outcome;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.code = outcome.signal != 0 ? 128 + outcome.signal : WEXITSTATUS(status);
  outcome.seconds = seconds();
  outcome.peak_memory_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return outcome;
}

double ChildProcess::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void ChildProcess::send(int signal) const {
  if (process_ != 0) kill(-process_, signal);
}

}  // namespace lozenge
