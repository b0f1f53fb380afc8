#include "formats/files/readers/deviations.h"

#include <algorithm>

#include "formats/base/error.h"

namespace lozenge {

void Deviations::add(Deviation kind, const std::string& place_and_problem) {
  if (none_allowed_) throw Error(ExitCode::kUnusableInput, place_and_problem);
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Found& found) { return found.kind == kind; });
  // Whoever has to look for pictures wants to know of all.
  if (known == found_.end() || kind == Deviation::kPicture) found_.push_back({kind, place_and_problem, 1});
  else ++known->count;
}

void Deviations::lose(Deviation kind, const std::string& place_and_problem) {
  add(kind, place_and_problem);
  if (first_loss_.empty()) first_loss_ = place_and_problem;
}

std::vector<std::string> Deviations::notes(const std::string& file) const {
  std::vector<std::string> sentences;
  for (const Found& found : found_) {
    const std::string prefix = file + ": ";
    std::string& sentence = sentences.emplace_back(found.first);
    if (sentence.starts_with(prefix)) sentence.erase(0, prefix.size());
    if (found.count > 1) sentence += " (and " + std::to_string(found.count - 1) + " more like it)";
    sentence += "; " + std::string(kDeviationKinds[static_cast<std::size_t>(found.kind)].fate);
  }
  return sentences;
}

}  // namespace lozenge
