// How long work tells that it goes on.
#pragma once

#include <functional>
#include <string_view>

namespace lozenge {

/// Called from time to time, always from the thread that started the work: what is being done, and how much of it
/// is done, from 0 to 1. An empty function is allowed and means that nobody listens; call it through `report`.
using Progress = std::function<void(std::string_view what, double done)>;

inline void report(const Progress& progress, std::string_view what, double done) {
  if (progress) progress(what, done);
}

}  // namespace lozenge
