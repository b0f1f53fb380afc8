// Kinds of options that several commands have.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace lozenge {

/// "100..200", or one number for both.
struct IntRange {
  int first = 0;
  int last = 0;
};

/// \param option  whose value the text is
/// \throws CLI::ValidationError where the text is no range, or runs backwards
IntRange parse_range(const std::string& option, const std::string& text);

/// The name of a file without its folder, as messages call it.
std::string file_name(const std::string& path);

/// Finds out before the work whether its output can be written; an empty path is none.
/// \throws Error(kUsage) naming the path and the reason
void require_writable(const std::string& path);

/// The file that the command reads.
CLI::Option* add_input(CLI::App& command, const std::string& name, std::string& file, const std::string& what);
/// -o, which can't be left out.
CLI::Option* add_output(CLI::App& command, std::string& path, const std::string& what);
/// The option `name`, which takes 2^k + 1 samples.
CLI::Option* add_samples(CLI::App& command, const std::string& name, int& samples, const std::string& what);

}  // namespace lozenge
