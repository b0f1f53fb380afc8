// damaged_surfaces FIRST COUNT [FOLDER]: takes the damaged surfaces of these seeds through the stages, each in a
// process of its own, so that one that crashes or hangs is a line of the result like any other. Says how many were
// built, how many were refused and why, and which took longest; the exit code is 0 where nothing is broken. Files of
// broken ones are kept in FOLDER.
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "formats/base/file_fixtures.h"
#include "tests/damage/damage.h"
#include "tests/damage/way_through.h"

namespace lozenge::damage {
namespace {

namespace fs = std::filesystem;

/// No surface of some hundred triangles takes a thousandth of that: one that does hangs.
constexpr int kHangsAfterSeconds = 300;

/// What the process writes before it ends: the fate's letter and the message.
void send(int pipe, const Outcome& outcome) {
  const std::string text = static_cast<char>(outcome.fate) + outcome.message;
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(pipe, text.data() + done, text.size() - done);
    if (written <= 0) return;
    done += static_cast<std::size_t>(written);
  }
}

/// All that the process writes; nothing where it hangs.
std::string receive(int pipe) {
  std::string text;
  std::array<char, 4096> bytes{};
  pollfd waiting{pipe, POLLIN, 0};
  while (poll(&waiting, 1, kHangsAfterSeconds * 1000) > 0) {
    const ssize_t count = read(pipe, bytes.data(), bytes.size());
    if (count <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return {};
}

Outcome outcome_of(const std::string& sent, int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) return {Fate::kBroken, "hangs"};
  if (WIFSIGNALED(status)) return {Fate::kBroken, fmt::format("crashed with signal {}", WTERMSIG(status))};
  if (sent.empty() || WEXITSTATUS(status) != 0) return {Fate::kBroken, "ended early"};
  return {static_cast<Fate>(sent[0]), sent.substr(1)};
}

Outcome take_through_in_own_process(const fs::path& file, std::uint32_t seed) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {Fate::kBroken, "no pipe could be made"};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    // Several of these programs run side by side: that is quicker than many threads for one small surface.
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    send(ends[1], take_through(file, seed));
    std::_Exit(0);
  }
  close(ends[1]);
  const std::string sent = receive(ends[0]);
  close(ends[0]);
  if (sent.empty()) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return outcome_of(sent, status);
}

/// With numbers as #, so that equal reasons count together.
std::string reason_of(const std::string& message) {
  std::string reason;
  for (const char c : message) {
    const bool in_number =
        (c >= '0' && c <= '9') || (!reason.empty() && reason.back() == '#' && (c == '.' || c == '-'));
    if (!in_number) reason += c;
    else if (reason.empty() || reason.back() != '#') reason += '#';
  }
  return reason;
}

struct Totals {
  int built = 0;
  int broken = 0;
  std::map<std::string, int> refused;  ///< [reason] how many
  double slowest_seconds = 0;
  std::uint32_t slowest = 0;
};

void enter(Totals& totals, std::uint32_t seed, const DamagedSurface& damaged, const Outcome& outcome, double seconds) {
  if (outcome.fate == Fate::kBuilt) ++totals.built;
  if (outcome.fate == Fate::kRefused) ++totals.refused[reason_of(outcome.message)];
  if (outcome.fate == Fate::kBroken) {
    ++totals.broken;
    fmt::print("BROKEN seed {} ({}): {}\n", seed, damaged.story, outcome.message);
    std::fflush(stdout);
  }
  if (seconds > totals.slowest_seconds) {
    totals.slowest_seconds = seconds;
    totals.slowest = seed;
  }
}

void print(const Totals& totals) {
  int refused = 0;
  for (const auto& [reason, count] : totals.refused) refused += count;
  fmt::print("{} built, {} refused, {} broken\n", totals.built, refused, totals.broken);
  for (const auto& [reason, count] : totals.refused) fmt::print("{:6} refused: {}\n", count, reason);
  fmt::print("the slowest took {:.1f} s: seed {} ({})\n", totals.slowest_seconds, totals.slowest,
             damaged_surface(totals.slowest).story);
}

bool run(std::uint32_t first, std::uint32_t count, const fs::path& kept) {
  const fixtures::TestFolder folder;
  Totals totals;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const DamagedSurface damaged = damaged_surface(seed);
    const fs::path file = folder / fmt::format("damaged_{}.glb", seed);
    write_glb(file, damaged_document(damaged, seed));
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = take_through_in_own_process(file, seed);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    enter(totals, seed, damaged, outcome, time.count());
    if (outcome.fate == Fate::kBroken && !kept.empty()) fs::copy_file(file, kept / file.filename());
    fs::remove(file);
    if (const std::uint32_t done = seed - first + 1; done % 50 == 0 && done < count) {
      fmt::print(stderr, "{} of {} surfaces\n", done, count);
    }
  }
  print(totals);
  return totals.broken == 0;
}

}  // namespace
}  // namespace lozenge::damage

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "Usage: %s FIRST COUNT [FOLDER]\n", argv[0]);
    return 2;
  }
  const auto number = [&](int i) { return static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)); };
  return lozenge::damage::run(number(1), number(2), argc > 3 ? argv[3] : "") ? 0 : 1;
}
