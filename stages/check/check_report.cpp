#include "stages/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lozenge {

bool CheckReport::passed() const {
  return !lines.empty() && std::all_of(lines.begin(), lines.end(), [](const CheckLine& line) { return line.passed; });
}

const CheckLine* CheckReport::find(std::string_view name) const {
  const auto at = std::find_if(lines.begin(), lines.end(), [&](const CheckLine& line) { return line.name == name; });
  return at == lines.end() ? nullptr : &*at;
}

void CheckReport::add(std::string name, bool ok, std::string detail) {
  lines.push_back({std::move(name), ok, std::move(detail)});
  if (!ok && code == ExitCode::kDone) code = ExitCode::kUnusableInput;
}

std::vector<std::string> report_lines(const CheckReport& report) {
  std::vector<std::string> text;
  for (const CheckLine& line : report.lines) {
    text.push_back(fmt::format("{:6}  {}{}{}", line.passed ? "ok" : "BROKEN", line.name,
                               line.detail.empty() ? "" : ": ", line.detail));
  }
  return text;
}

std::string report_json(const CheckReport& report) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const CheckLine& line : report.lines) {
    checks.push_back({{"name", line.name}, {"passed", line.passed}, {"detail", line.detail}});
  }
  const nlohmann::ordered_json json{{"kind", report.kind}, {"passed", report.passed()}, {"checks", checks}};
  // A detail may quote a file's own text, which need not be UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lozenge
