// Guarantees, one named line each: whether it holds, and where it breaks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/base/error.h"

namespace lozenge {

/// One guarantee.
struct CheckLine {
  std::string name;  ///< "no folded triangle"; the same for every file of the kind
  bool passed = false;
  std::string detail;  ///< where it breaks, or what was counted to prove it
};

struct CheckReport {
  std::string kind;  ///< "parameterization", "geometry image", ...
  std::vector<CheckLine> lines;
  /// What a command should exit with: kDone, or kUnusableInput where a guarantee is broken, or the code of the reader's
  /// error where the file could not even be read (that is the failed line "readable").
  ExitCode code = ExitCode::kDone;

  bool passed() const;
  /// The line of this name, or nullptr.
  const CheckLine* find(std::string_view name) const;
  void add(std::string name, bool passed, std::string detail);
};

/// The report as text, a line for each guarantee ("ok    no folded triangle: 52000 triangles"), and as a JSON object
/// {kind, passed, checks: [{name, passed, detail}]}.
std::vector<std::string> report_lines(const CheckReport& report);
std::string report_json(const CheckReport& report);

}  // namespace lozenge
