#include "tools/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <new>

#include "formats/base/version.h"
#include "tools/interrupt.h"
#include "tools/memory_limit.h"
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
    "  5 a limit was reached   1 our own fault";

/// CLI11's own, without the runs of empty lines between groups.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(30); }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string help = CLI::Formatter::make_help(app, name, mode);
    for (std::size_t at = 0; (at = help.find("\n\n\n", at)) != std::string::npos;) help.erase(at, 1);
    return help;
  }
};

void add_commands(CLI::App& app, const Program& program, Request& request) {
  for (const auto add : program.commands) add(app, request);
  for (CLI::App* command : app.get_subcommands({})) add_common_options(*command, request.common);
}

/// "lozenge", or "lozenge build" where that command was begun.
std::string called(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? "lozenge" : "lozenge " + commands.front()->get_name();
}

/// CLI11's message as one line without a full stop.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

/// CLI11 complains that there is no command before it looks at what is there instead.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> others = app.remaining();
  if (app.get_subcommands().empty() && !others.empty()) return fmt::format("no command is called '{}'", others.front());
  return error.what();
}

/// Help and version are no errors; everything else is wrong usage.
int answer_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  fmt::print(stderr, "{0}: {1}; see {0} --help\n", called(app), one_line(complaint(app, error)));
  return static_cast<int>(ExitCode::kUsage);
}

int fail(Console& console, ExitCode code, const std::string& message) {
  console.complain(message);
  return static_cast<int>(code);
}

int run_action(const Program& program, const Request& request) {
  Console console("lozenge " + request.command, request.common.json, request.common.quiet);
  try {
    const ThreadLimit limit(request.common.threads);
    if (program.limit_threads) program.limit_threads(limit.threads());
    const ExitCode code = request.action(console);
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

}  // namespace

bool offers(const Program& program, std::string_view command) {
  CLI::App app;
  Request request;
  add_commands(app, program, request);
  const auto named = [&](CLI::App* each) { return each->check_name(std::string(command)); };
  return !app.get_subcommands(named).empty();
}

int run_program(const Program& program, int argc, const char* const* argv) {
  CLI::App app(kDescription, "lozenge");
  app.footer(kFooter);
  app.set_help_flag("-h,--help", "Print this; after a command, what it takes");
  app.set_version_flag("--version", fmt::format("lozenge {}", version()), "Print the version");
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormatter>());
  Request request;
  add_commands(app, program, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer_parse_error(app, error);
  }
  watch_for_interrupts();
  limit_memory(0);
  return run_action(program, request);
}

}  // namespace lozenge
