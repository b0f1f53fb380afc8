// The first place where a guarantee breaks, and in how many places it does.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "stages/check/check_report.h"

namespace lozenge {

class Finding {
 public:
  /// \param describe  gives the words for the place; called for the first only
  template <typename Describe>
  void add(const Describe& describe) {
    if (count_++ == 0) first_ = describe();
  }

  bool none() const { return count_ == 0; }

  /// Adds the guarantee's line: passed where nothing was found, with `proof` as its detail.
  void report_to(CheckReport& report, std::string name, std::string proof) const {
    if (none()) {
      report.add(std::move(name), true, std::move(proof));
    } else {
      report.add(std::move(name), false,
                 count_ == 1 ? first_ : first_ + " (the first of " + std::to_string(count_) + " places)");
    }
  }

 private:
  std::int64_t count_ = 0;
  std::string first_;
};

}  // namespace lozenge
