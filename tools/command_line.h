// What a command line may hold. Commands declare their options here; CLI11, which parses them, stays in the .cpp file:
// it takes seconds to compile wherever it is included.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lozenge {

struct Command;

/// Numbers that an option takes, both ends among them.
template <typename Number>
struct Limits {
  Number least = std::numeric_limits<Number>::lowest();
  Number most = std::numeric_limits<Number>::max();
};
inline constexpr Limits<double> kPositive{std::numeric_limits<double>::min()};

/// What an option's words mean: {{"png", MapFormat::kPng}, {"exr", MapFormat::kExr}}.
template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// What an option is to what the command makes.
enum class OptionRole {
  kMatters,       ///< the outputs follow from it
  kInput,         ///< it names files that they follow from
  kOutput,        ///< it names a place for them
  kDoesntMatter,  ///< they are the same without it
  kWantsWork,     ///< it asks for a record of the work itself, which is to be done again
};

/// An option as it was declared.
struct DeclaredOption {
  CLI::Option* option = nullptr;
  OptionRole role = OptionRole::kMatters;
  std::string stage;               ///< that it belongs to; empty: the command as a whole
  std::string* output = nullptr;   ///< the variable of -o
  std::string* report = nullptr;   ///< the variable of --report
  std::vector<std::string> words;  ///< all that it takes; empty: not only some words
};

/// An option that was declared. Others are named as on the command line, and are declared before it.
class Option {
 public:
  Option(CLI::App& command, DeclaredOption& declared) : command_(command), declared_(declared) {}
  /// Help tells the value that the variable has now.
  Option& shows_default();
  Option& is_required();
  Option& needs(const std::string& other);
  Option& excludes(const std::string& other);
  /// It names files that the outputs follow from.
  Option& names_inputs();
  /// The outputs are the same without it.
  Option& doesnt_matter();
  /// It asks for a record of the work itself.
  Option& wants_work();

 private:
  CLI::App& command_;
  DeclaredOption& declared_;
};

/// The options of one command. Each names a variable that it is parsed into, which keeps its value, the default, where
/// the option isn't given. Names are written as help shows them: "-o,--output PATH", or "input" for what has no dashes
/// and is known by its place.
class Options {
 public:
  Options(CLI::App& command, std::deque<DeclaredOption>& declared) : command_(command), declared_(declared) {}

  /// Help lists what is declared from now on under this heading.
  void group(const std::string& heading) { group_ = heading; }

  /// What is declared from now on matters to this stage and those after it; empty: to the command as a whole.
  void stage(const std::string& name) { stage_ = name; }

  /// What the command reads; it can't be left out.
  Option input(const std::string& name, std::string& file, const std::string& help);
  Option inputs(const std::string& name, std::vector<std::string>& files, const std::string& help);
  /// -o, which can't be left out.
  Option output(std::string& path, const std::string& help);

  /// --report FILE
  Option report(std::string& path, const std::string& help);

  Option flag(const std::string& name, bool& value, const std::string& help);
  Option text(const std::string& name, std::string& value, const std::string& help);
  Option texts(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option number(const std::string& name, int& value, const Limits<int>& limits, const std::string& help);
  Option number(const std::string& name, std::int64_t& value, const Limits<std::int64_t>& limits,
                const std::string& help);
  Option number(const std::string& name, double& value, const Limits<double>& limits, const std::string& help);
  Option number(const std::string& name, std::optional<double>& value, const Limits<double>& limits,
                const std::string& help);
  Option number(const std::string& name, std::optional<int>& value, const Limits<int>& limits, const std::string& help);
  Option one_of(const std::string& name, int& value, const std::vector<int>& numbers, const std::string& help);
  /// Three numbers in a row.
  Option direction(const std::string& name, std::optional<std::array<float, 3>>& value, const std::string& help);
  /// Bytes, as 500M or 8G.
  Option bytes(const std::string& name, std::uint64_t& value, const std::string& help);
  Option bytes(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help);
  /// 2^k + 1 samples.
  Option samples(const std::string& name, int& value, const std::string& help);
  /// \param parse  takes the text, or throws Error(kUsage) with what is wrong with it, to be said after the option's
  /// name
  Option parsed(const std::string& name, std::function<void(const std::string&)> parse, const std::string& help);

  /// One of some words.
  template <typename Variable, typename Value>
  Option choice(const std::string& name, Variable& value, const Words<Value>& words, const std::string& help) {
    const auto take = [&value, words](const std::vector<std::size_t>& chosen) { value = words[chosen.back()].second; };
    return chosen(name, spellings(words), false, take, help);
  }
  /// Any of some words; the first that is given replaces the default.
  template <typename Value>
  Option choices(const std::string& name, std::vector<Value>& values, const Words<Value>& words,
                 const std::string& help) {
    const auto take = [&values, words](const std::vector<std::size_t>& chosen) {
      values.clear();
      for (const std::size_t k : chosen) values.push_back(words[k].second);
    };
    return chosen(name, spellings(words), true, take, help);
  }

 private:
  template <typename Value>
  static std::vector<std::string> spellings(const Words<Value>& words) {
    std::vector<std::string> all;
    for (const auto& [word, value] : words) all.push_back(word);
    return all;
  }
  /// \param take  gets the places of what was given in `words`
  Option chosen(const std::string& name, const std::vector<std::string>& words, bool several,
                std::function<void(const std::vector<std::size_t>&)> take, const std::string& help);
  Option grouped(CLI::Option* option);

  CLI::App& command_;
  std::deque<DeclaredOption>& declared_;
  std::string group_;  ///< empty: CLI11's own
  std::string stage_;
};

/// What a program tells of itself.
struct ProgramHelp {
  std::string name;
  std::string description;
  std::string footer;
  std::string version;
};

/// Options that every command takes; the last two, every command that makes files.
struct CommonOptions {
  int threads = 0;  ///< 0: one for each core
  bool json = false;
  bool quiet = false;
  std::string cache;    ///< the folder; empty: none
  std::string depfile;  ///< empty: none
};

/// An option as it was given.
struct GivenOption {
  std::string name;  ///< "--samples", or "input" for what is known by its place
  std::vector<std::string> values;
  OptionRole role = OptionRole::kMatters;
  std::string stage;
  bool is_flag = false;
};

/// What a command line asks for.
struct Request {
  const Command* command = nullptr;  ///< none where there is nothing left to do
  CommonOptions common;
  std::vector<GivenOption> given;  ///< by name
  std::string* output = nullptr;   ///< the variable that -o is parsed into; null where the command has none
  std::string* report = nullptr;   ///< the same for --report
  int exit_code = 0;               ///< where there is no command: help was printed, or what is wrong with the usage
};

/// An option as manuals and shells show it.
struct OptionDescription {
  std::vector<std::string> spellings;  ///< "-o", "--output"; empty for what is known by its place
  std::string value;                   ///< "PATH"; the name of what is known by its place; empty for a flag
  std::string help;
  std::string group;               ///< the heading that help lists it under
  std::string default_value;       ///< empty: help tells none
  std::vector<std::string> words;  ///< all that it takes; empty: not only some words
  bool is_required = false;
};

/// The options of a command in the order of their declaration, which is that of its help.
std::vector<OptionDescription> describe_options(const Command& command);

/// Parses the command line into the variables that the options of `commands` name.
Request parse_command_line(const ProgramHelp& program, const std::vector<Command>& commands, int argc,
                           const char* const* argv);

}  // namespace lozenge
