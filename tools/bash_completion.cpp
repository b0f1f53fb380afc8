#include <fmt/format.h>

#include "tools/manual.h"

namespace lozenge {
namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// What completes the value of an option, as arguments of compgen; empty for a number or a name.
std::string completion_of_value(const OptionDescription& option) {
  if (!option.words.empty()) return fmt::format("-W '{}'", joined(option.words));
  const auto says = [&](const char* word) { return option.value.find(word) != std::string::npos; };
  if (says("DIR") || says("FOLDER")) return "-d";
  if (says("FILE") || says("PATH")) return "-f";
  return "";
}

/// The cases of one command: after which option comes which value, and what else may come.
std::string cases(const std::string& command, const std::vector<OptionDescription>& options) {
  std::string after;
  std::vector<std::string> all;
  std::vector<std::string> words;
  for (const OptionDescription& option : options) {
    all.insert(all.end(), option.spellings.begin(), option.spellings.end());
    if (option.spellings.empty()) words.insert(words.end(), option.words.begin(), option.words.end());
    if (option.spellings.empty() || option.value.empty()) continue;
    const std::string values = completion_of_value(option);
    after += fmt::format("        {}) _lozenge_offer{} ;;\n", fmt::join(option.spellings, "|"),
                         values.empty() ? "" : " " + values);
  }
  const std::string values = words.empty() ? "-f" : fmt::format("-W '{}'", joined(words));
  return fmt::format(
      "    {}) case $before in\n{}        *) if [[ $word == -* ]]; then _lozenge_offer -W '{}'; else _lozenge_offer "
      "{}; fi "
      ";;\n      esac ;;\n",
      command, after, joined(all), values);
}

}  // namespace

std::string bash_completion(const ProgramHelp& program, const std::vector<Command>& commands) {
  std::vector<std::string> names{"--help", "--version"};
  std::string all_cases;
  for (const Command& command : commands) {
    names.push_back(command.help.name);
    all_cases += cases(command.help.name, describe_options(command));
  }
  return fmt::format(
      "# bash completion of {0}; written by the build from the program's own declarations\n"
      "_lozenge_offer() {{\n"
      "  case $1 in\n"
      "    -f | -d) compopt -o filenames ;;\n"
      "    '') return ;;\n"
      "  esac\n"
      "  mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$word\")\n"
      "}}\n"
      "_lozenge() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    _lozenge_offer -W '{1}'\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n"
      "{2}"
      "  esac\n"
      "}}\n"
      "complete -F _lozenge {0}\n",
      program.name, joined(names), all_cases);
}

}  // namespace lozenge
