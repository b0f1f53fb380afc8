#include "tools/program.h"

#include <fmt/format.h>
#include <sys/auxv.h>

#include <algorithm>
#include <new>

#include "formats/base/version.h"
#include "tools/interrupt.h"
#include "tools/memory_limit.h"
#include "tools/recall.h"
#include "tools/threads.h"

namespace lozenge {
namespace {

constexpr const char* kDescription =
    "Maps the surface of an asset (glTF, PLY, OBJ, STL, OFF) onto equilateral triangles and makes a game-ready asset "
    "of it:\n"
    "geometry images, baked maps, levels of detail.";

constexpr const char* kFooter =
    "Examples\n"
    "  the whole way, from a scan to what an engine loads\n"
    "    lozenge build statue.glb -o out/\n"
    "  what a command does and takes\n"
    "    lozenge build --help\n"
    "\n"
    "Exit codes\n"
    "  0 done   2 wrong usage   3 the input can't be used   4 the input needs what isn't supported\n"
    "  5 a limit was reached   6 the system refuses (a full disk, a folder that may not be written)   1 our own fault";

int fail(Console& console, ExitCode code, const std::string& message) {
  console.complain(message);
  return static_cast<int>(code);
}

ExitCode run_command(const Workplace& place, const Request& request, Console& console) {
  Recall recall(request, place.worker);
  if (request.command->recalls_by_itself) return request.command->run(console, recall);
  const ExitCode code = recall.is_on() ? run_recalled(request, console, recall) : request.command->run(console, recall);
  if (code == ExitCode::kDone && request.command->is_repeatable) recall.write_depfile(*request.output);
  return code;
}

int run_action(const Workplace& place, const Request& request) {
  Console console("lozenge " + request.command->help.name, request.common.json, request.common.quiet);
  try {
    const ThreadLimit limit(request.common.threads);
    if (place.limit_threads) place.limit_threads(limit.threads());
    const ExitCode code = run_command(place, request, console);
    console.finish();
    return static_cast<int>(code);
  } catch (const Error& error) {
    return fail(console, error.code(), error.what());
  } catch (const Interrupted& interrupt) {
    console.complain("stopped; nothing was written");
    return 128 + interrupt.signal();
  } catch (const std::bad_alloc&) {
    const std::string limit = memory_limit_in_words();
    lift_memory_limit();
    return fail(
        console, ExitCode::kLimit,
        fmt::format("out of memory (there may be {}); use a smaller input, fewer samples or smaller maps", limit));
  } catch (const std::exception& error) {
    return fail(console, ExitCode::kInternal, fmt::format("internal error: {}; please report this", error.what()));
  }
}

/// The path that the kernel was told to run: what there is where /proc isn't mounted, as in a bare chroot.
const char* name_at_start() {
  const unsigned long address = getauxval(AT_EXECFN);
  return address == 0 ? "" : reinterpret_cast<const char*>(address);
}

}  // namespace

std::filesystem::path builder_program() {
  std::error_code error;
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) self = std::filesystem::canonical(name_at_start(), error);
  const std::filesystem::path folder = self.parent_path();
  const std::filesystem::path beside = folder / "lozenge-whole";
  return std::filesystem::exists(beside, error) ? beside : folder.parent_path() / "libexec/lozenge/lozenge-whole";
}

ProgramHelp program_help() { return {"lozenge", kDescription, kFooter, fmt::format("lozenge {}", version())}; }

bool offers(const Program& program, std::string_view command) {
  return std::any_of(program.commands.begin(), program.commands.end(),
                     [&](Command (*each)()) { return each().help.name == command; });
}

int run_program(const Program& program, int argc, const char* const* argv) {
  std::vector<Command> commands;
  for (const auto make : program.commands) commands.push_back(make());
  return run_commands(commands, {.limit_threads = program.limit_threads}, argc, argv);
}

int run_commands(const std::vector<Command>& commands, const Workplace& place, int argc, const char* const* argv) {
  const Request request = parse_command_line(program_help(), commands, argc, argv);
  if (!request.command) return request.exit_code;
  watch_for_interrupts();
  limit_memory(0);
  return run_action(place, request);
}

}  // namespace lozenge
