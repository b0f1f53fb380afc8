// Pages for man, in the macros of man(7): .SH begins a section, .SS a group, .TP an item with its text indented.
#include "tools/manual.h"

#include <fmt/format.h>

#include <sstream>

namespace lozenge {
namespace {

/// Text that roff shows as it is: its own signs are escaped, and "-" stays the one that is typed.
std::string plain(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    begins_line = c == '\n';
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }

std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string title(const std::string& page, const ProgramHelp& program) {
  return fmt::format(".TH \"{}\" 1 \"\" \"{}\" \"Lozenge\"\n", plain(page), plain(program.version));
}

std::string upper(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

/// Lines that are not to be filled.
std::string section(const std::string& heading, const std::string& lines) {
  return fmt::format(".SH {}\n.nf\n{}\n.fi\n", upper(heading), plain(lines));
}

/// Sections of a help text: a heading, lines, an empty line between.
std::string sections(const std::string& text) {
  std::string pages;
  std::istringstream stream(text);
  std::string heading;
  std::string lines;
  std::string line;
  const auto close = [&] {
    if (!heading.empty()) pages += section(heading, lines);
    heading.clear();
    lines.clear();
  };
  while (std::getline(stream, line)) {
    if (line.empty()) {
      close();
    } else if (heading.empty()) {
      heading = line;
    } else {
      lines += lines.empty() ? line : "\n" + line;
    }
  }
  close();
  return pages;
}

std::string item(const OptionDescription& option) {
  std::string names;
  for (const std::string& spelling : option.spellings) names += (names.empty() ? "" : ", ") + bold(spelling);
  if (!option.value.empty()) names += (names.empty() ? "" : " ") + italic(option.value);
  if (!option.default_value.empty()) names += plain(" = " + option.default_value);
  const std::string required = option.is_required && !option.spellings.empty() ? " (required)" : "";
  return fmt::format(".TP\n{}\n{}\n", names, plain(option.help + required));
}

std::string synopsis(const std::string& name, const std::vector<OptionDescription>& options) {
  std::string line = bold(name);
  for (const OptionDescription& option : options) {
    if (option.spellings.empty())
      line += " " + (option.is_required ? italic(option.value) : "[" + italic(option.value) + "]");
  }
  for (const OptionDescription& option : options) {
    if (option.is_required && !option.spellings.empty()) {
      line += " " + bold(option.spellings.front()) + " " + italic(option.value);
    }
  }
  return ".SH SYNOPSIS\n" + line + " [" + italic("options") + "]\n";
}

std::string heading_of(const OptionDescription& option) {
  if (option.spellings.empty()) return "What it reads and where";
  return option.group == "Options" ? "In general" : option.group;
}

}  // namespace

std::string manual_of_program(const ProgramHelp& program, const std::vector<Command>& commands) {
  std::string page = title(upper(program.name), program);
  page += fmt::format(".SH NAME\n{} \\- geometry images and game\\-ready assets of meshes\n", plain(program.name));
  page += fmt::format(".SH SYNOPSIS\n{} {} [{}]\n", bold(program.name), italic("command"), italic("options"));
  page += ".SH DESCRIPTION\n" + plain(program.description) + "\n.SH COMMANDS\n";
  std::string group;
  for (const Command& command : commands) {
    if (command.help.group != group) page += ".SS " + plain(command.help.group) + "\n";
    group = command.help.group;
    page += fmt::format(".TP\n{}(1)\n{}\n", bold(program.name + "-" + command.help.name), plain(command.help.summary));
  }
  return page + sections(program.footer);
}

std::string manual_of_command(const ProgramHelp& program, const Command& command) {
  const std::vector<OptionDescription> options = describe_options(command);
  const std::string name = program.name + "-" + command.help.name;
  std::string page = title(upper(name), program);
  page += fmt::format(".SH NAME\n{} \\- {}\n", plain(name), plain(command.help.summary));
  page += synopsis(program.name + " " + command.help.name, options) + ".SH OPTIONS\n";
  std::string group;
  for (const OptionDescription& option : options) {
    if (heading_of(option) != group) page += ".SS " + plain(heading_of(option)) + "\n";
    group = heading_of(option);
    page += item(option);
  }
  page += section("Examples", command.help.examples);
  return page + fmt::format(".SH SEE ALSO\n{}(1), for exit codes and the other commands\n", bold(program.name));
}

}  // namespace lozenge
