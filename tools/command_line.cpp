#include "tools/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <map>

#include "formats/base/error.h"
#include "tools/command.h"

namespace lozenge {
namespace {

/// Names as CLI11 wants them ("-o,--output"), and what stands for the value in the help ("PATH").
struct Name {
  explicit Name(const std::string& written)
      : name(written.substr(0, written.find(' '))),
        value(name.size() < written.size() ? written.substr(name.size() + 1) : "") {}
  std::string name;
  std::string value;
};

template <typename Number>
CLI::Validator within(const Limits<Number>& limits) {
  const auto complaint = [limits](const std::string& text) -> std::string {
    Number value{};
    if (CLI::detail::lexical_cast(text, value) && value >= limits.least && value <= limits.most) return "";
    if (limits.most < std::numeric_limits<Number>::max())
      return fmt::format("'{}' is not in the range {} to {}", text, limits.least, limits.most);
    if (limits.least > 0 && limits.least < 1) return fmt::format("'{}' is not a positive number", text);
    return fmt::format("'{}' is not a whole number from {} on", text, limits.least);
  };
  return {complaint, ""};
}

/// An empty text where it is a valid N, as CLI11 wants it.
std::string complaint_about_samples(const std::string& text) {
  int n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  const bool valid =
      error == std::errc() && end == text.data() + text.size() && n >= 2 && n <= 1025 && ((n - 1) & (n - 2)) == 0;
  return valid ? "" : fmt::format("'{}' is not 2^k + 1: choose 2, 3, 5, 9, 17, 33, ... or 1025", text);
}

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

/// What every command takes; after the command's own options, so that help lists it last.
void add_common_options(CLI::App& command, std::deque<DeclaredOption>& declared, CommonOptions& common) {
  constexpr const char* kGroup = "As in every command";
  Options options(command, declared);
  options.group(kGroup);
  options.number("--threads N", common.threads, {1, 1024}, "At most this many threads; without it, one for each core")
      .doesnt_matter();
  options.flag("--json", common.json, "Results as JSON").doesnt_matter();
  options.flag("-q,--quiet", common.quiet, "Nothing on stderr but what is wrong").doesnt_matter();
  command.set_help_flag();  // it was the first of all options, and shall be the last
  command.set_help_flag("-h,--help", "Print this")->group(kGroup);
}

/// For commands whose outputs follow from their inputs and options.
void add_build_system_options(CLI::App& command, std::deque<DeclaredOption>& declared, CommonOptions& common) {
  Options options(command, declared);
  options.group("In a build system");
  options
      .text("--cache DIR", common.cache,
            "Take what was made before from this folder, and put there what is made; without it, the folder in "
            "LOZENGE_CACHE")
      .doesnt_matter();
  options
      .text("--depfile FILE", common.depfile, "Write the names of all files that were read to FILE, for make and ninja")
      .doesnt_matter();
}

void add_command(CLI::App& app, const Command& command, std::deque<DeclaredOption>& declared, Request& request) {
  CLI::App* added = app.add_subcommand(command.help.name, command.help.summary)->group(command.help.group);
  added->footer("Examples\n" + command.help.examples);
  added->callback([&request, &command] { request.command = &command; });
  Options options(*added, declared);
  command.declare(options);
  if (command.is_repeatable) add_build_system_options(*added, declared, request.common);
  add_common_options(*added, declared, request.common);
}

OptionDescription description_of(const CLI::Option& option, const std::vector<std::string>& words) {
  OptionDescription described;
  for (const std::string& name : option.get_snames()) described.spellings.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) described.spellings.push_back("--" + name);
  described.value = option.get_positional() ? option.get_single_name() : option.get_type_name();
  if (option.get_expected_max() == 0) described.value.clear();
  described.help = option.get_description();
  described.group = option.get_group();
  described.default_value = option.get_default_str();
  described.words = words;
  described.is_required = option.get_required();
  return described;
}

/// What was given of what was declared.
void take_given(const std::deque<DeclaredOption>& declared, Request& request) {
  for (const DeclaredOption& each : declared) {
    if (each.output != nullptr) request.output = each.output;
    if (each.report != nullptr) request.report = each.report;
    if (each.option->count() == 0) continue;
    request.given.push_back({each.option->get_single_name(), each.option->results(), each.role, each.stage,
                             each.option->get_expected_max() == 0});
    if (!each.option->get_positional()) request.given.back().name.insert(0, "--");
  }
  std::sort(request.given.begin(), request.given.end(),
            [](const GivenOption& a, const GivenOption& b) { return a.name < b.name; });
}

/// "lozenge", or "lozenge build" where that command was begun.
std::string called(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app.get_name() : app.get_name() + " " + commands.front()->get_name();
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

}  // namespace

Option& Option::shows_default() {
  declared_.option->capture_default_str();
  return *this;
}

Option& Option::is_required() {
  declared_.option->required();
  return *this;
}

Option& Option::needs(const std::string& other) {
  declared_.option->needs(command_.get_option(other));
  return *this;
}

Option& Option::excludes(const std::string& other) {
  declared_.option->excludes(command_.get_option(other));
  return *this;
}

Option& Option::names_inputs() {
  declared_.role = OptionRole::kInput;
  return *this;
}

Option& Option::doesnt_matter() {
  declared_.role = OptionRole::kDoesntMatter;
  return *this;
}

Option& Option::wants_work() {
  declared_.role = OptionRole::kWantsWork;
  return *this;
}

Option Options::grouped(CLI::Option* option) {
  if (!group_.empty()) option->group(group_);
  declared_.push_back({option, OptionRole::kMatters, stage_, nullptr, nullptr, {}});
  return {command_, declared_.back()};
}

Option Options::input(const std::string& name, std::string& file, const std::string& help) {
  return grouped(command_.add_option(name, file, help)->required()->type_name("")).names_inputs();
}

Option Options::inputs(const std::string& name, std::vector<std::string>& files, const std::string& help) {
  return grouped(command_.add_option(name, files, help)->required()->type_name("")).names_inputs();
}

Option Options::output(std::string& path, const std::string& help) {
  const Option option = grouped(command_.add_option("-o,--output", path, help)->required()->type_name("PATH"));
  declared_.back().role = OptionRole::kOutput;
  declared_.back().output = &path;
  return option;
}

Option Options::report(std::string& path, const std::string& help) {
  const Option option = text("--report FILE", path, help);
  declared_.back().role = OptionRole::kOutput;
  declared_.back().report = &path;
  return option;
}

Option Options::flag(const std::string& name, bool& value, const std::string& help) {
  return grouped(command_.add_flag(name, value, help));
}

Option Options::text(const std::string& name, std::string& value, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)->type_name(named.value));
}

Option Options::texts(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, values, help)->type_name(named.value));
}

Option Options::number(const std::string& name, int& value, const Limits<int>& limits, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)->check(within(limits))->type_name(named.value));
}

Option Options::number(const std::string& name, std::int64_t& value, const Limits<std::int64_t>& limits,
                       const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)->check(within(limits))->type_name(named.value));
}

Option Options::number(const std::string& name, double& value, const Limits<double>& limits, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)->check(within(limits))->type_name(named.value));
}

Option Options::number(const std::string& name, std::optional<double>& value, const Limits<double>& limits,
                       const std::string& help) {
  const Name named(name);
  const auto take = [&value](double given) { value = given; };
  return grouped(
      command_.add_option_function<double>(named.name, take, help)->check(within(limits))->type_name(named.value));
}

Option Options::number(const std::string& name, std::optional<int>& value, const Limits<int>& limits,
                       const std::string& help) {
  const Name named(name);
  const auto take = [&value](int given) { value = given; };
  return grouped(
      command_.add_option_function<int>(named.name, take, help)->check(within(limits))->type_name(named.value));
}

Option Options::one_of(const std::string& name, int& value, const std::vector<int>& numbers, const std::string& help) {
  const Name named(name);
  const auto complaint = [numbers](const std::string& text) {
    int given = 0;
    const bool found =
        CLI::detail::lexical_cast(text, given) && std::find(numbers.begin(), numbers.end(), given) != numbers.end();
    return found ? "" : fmt::format("'{}' is none of {}", text, fmt::join(numbers, ", "));
  };
  const Option option = grouped(
      command_.add_option(named.name, value, help)->check(CLI::Validator(complaint, ""))->type_name(named.value));
  for (const int number : numbers) declared_.back().words.push_back(std::to_string(number));
  return option;
}

Option Options::direction(const std::string& name, std::optional<std::array<float, 3>>& value,
                          const std::string& help) {
  const Name named(name);
  const auto take = [&value](const std::vector<float>& given) { value = {given[0], given[1], given[2]}; };
  return grouped(
      command_.add_option_function<std::vector<float>>(named.name, take, help)->expected(3)->type_name(named.value));
}

Option Options::bytes(const std::string& name, std::uint64_t& value, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)
                     ->transform(CLI::AsSizeValue(true).description(""))
                     ->type_name(named.value));
}

Option Options::bytes(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help) {
  const Name named(name);
  const auto take = [&value](std::uint64_t given) { value = given; };
  return grouped(command_.add_option_function<std::uint64_t>(named.name, take, help)
                     ->transform(CLI::AsSizeValue(true).description(""))
                     ->type_name(named.value));
}

Option Options::samples(const std::string& name, int& value, const std::string& help) {
  const Name named(name);
  return grouped(command_.add_option(named.name, value, help)
                     ->check(CLI::Validator(complaint_about_samples, ""))
                     ->type_name(named.value));
}

Option Options::parsed(const std::string& name, std::function<void(const std::string&)> parse,
                       const std::string& help) {
  const Name named(name);
  const auto take = [parse = std::move(parse), option = named.name](const std::string& text) {
    try {
      parse(text);
    } catch (const Error& error) {
      throw CLI::ValidationError(option, error.what());
    }
  };
  return grouped(command_.add_option_function<std::string>(named.name, take, help)->type_name(named.value));
}

Option Options::chosen(const std::string& name, const std::vector<std::string>& words, bool several,
                       std::function<void(const std::vector<std::size_t>&)> take, const std::string& help) {
  const Name named(name);
  const auto place = [words](const std::string& text) {
    return static_cast<std::size_t>(std::find(words.begin(), words.end(), text) - words.begin());
  };
  const auto complaint = [words, place](const std::string& text) {
    return place(text) < words.size() ? "" : fmt::format("'{}' is none of {}", text, fmt::join(words, ", "));
  };
  const auto take_all = [take = std::move(take), place](const std::vector<std::string>& given) {
    std::vector<std::size_t> places;
    for (const std::string& text : given) places.push_back(place(text));
    take(places);
  };
  CLI::Option* option = command_.add_option_function<std::vector<std::string>>(named.name, take_all, help)
                            ->check(CLI::Validator(complaint, ""))
                            ->type_name(named.value);
  if (!several) option->expected(1);
  const Option made = grouped(option);
  declared_.back().words = words;
  return made;
}

std::vector<OptionDescription> describe_options(const Command& command) {
  CLI::App app;
  Request request;
  std::deque<DeclaredOption> declared;
  add_command(app, command, declared, request);
  std::vector<OptionDescription> described;
  for (const DeclaredOption& each : declared) described.push_back(description_of(*each.option, each.words));
  described.push_back(description_of(*app.get_subcommand(command.help.name)->get_help_ptr(), {}));
  return described;
}

Request parse_command_line(const ProgramHelp& program, const std::vector<Command>& commands, int argc,
                           const char* const* argv) {
  CLI::App app(program.description, program.name);
  app.footer(program.footer);
  app.set_help_flag("-h,--help", "Print this; after a command, what it takes");
  app.set_version_flag("--version", program.version, "Print the version");
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormatter>());
  Request request;
  std::map<const Command*, std::deque<DeclaredOption>> declared;
  for (const Command& command : commands) add_command(app, command, declared[&command], request);
  try {
    app.parse(argc, argv);
    take_given(declared[request.command], request);
  } catch (const CLI::ParseError& error) {
    request.command = nullptr;
    request.exit_code = answer_parse_error(app, error);
  }
  return request;
}

}  // namespace lozenge
