// How the small programs of this folder run: options in, an exit code and one line for what went wrong out.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lozenge::bench {

/// Parses the command line and does the work. Exit codes are those of `lozenge`.
int run_bench_program(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work);

}  // namespace lozenge::bench
