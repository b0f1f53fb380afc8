#include "tools/bench/bench_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <new>

#include "formats/base/error.h"

namespace lozenge::bench {
namespace {

int fail(const CLI::App& app, ExitCode code, const std::string& message) {
  fmt::print(stderr, "{}: {}\n", app.get_name(), message);
  return static_cast<int>(code);
}

}  // namespace

int run_bench_program(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work) {
  try {
    app.parse(argc, argv);
    work();
    return static_cast<int>(ExitCode::kDone);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    return fail(app, ExitCode::kUsage, error.what());
  } catch (const Error& error) {
    return fail(app, error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(app, ExitCode::kLimit, "out of memory; use a smaller mesh");
  } catch (const std::exception& error) {
    return fail(app, ExitCode::kInternal, fmt::format("internal error: {}", error.what()));
  }
}

}  // namespace lozenge::bench
