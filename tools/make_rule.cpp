#include "tools/make_rule.h"

namespace lozenge {
namespace {

std::string escaped(const std::string& path) {
  std::string text;
  for (std::size_t k = 0; k < path.size(); ++k) {
    // Backslashes are doubled before a letter that is escaped, and nowhere else (GNU make, "Wildcards"; ninja,
    // depfiles).
    if (path[k] == ' ' || path[k] == '#') {
      for (std::size_t back = k; back > 0 && path[back - 1] == '\\'; --back) text += '\\';
      text += '\\';
    }
    if (path[k] == '$') text += '$';
    text += path[k];
  }
  return text;
}

}  // namespace

std::string make_rule(const std::string& target, const std::vector<std::filesystem::path>& files) {
  std::string rule = escaped(target) + ":";
  std::string others;
  for (const std::filesystem::path& file : files) {
    const std::string name = escaped(file.string());
    if (name.find('\n') != std::string::npos) continue;
    rule += " \\\n  " + name;
    others += "\n" + name + ":\n";
  }
  return rule + "\n" + others;
}

}  // namespace lozenge
