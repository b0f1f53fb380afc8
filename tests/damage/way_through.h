// A damaged surface on its way through all stages that depend on its shape.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lozenge::damage {

enum class Fate : char {
  kBuilt = 'b',    ///< every file and every guarantee is as it should be
  kRefused = 'r',  ///< with an exit code that blames the input, and a message
  kBroken = 'x',   ///< anything else
};

struct Outcome {
  Fate fate = Fate::kBroken;
  std::string message;  ///< why it was refused, or what is broken
};

/// Imports, parameterizes, samples, packs and exports the GLB and unwraps it, with options that the seed chooses, and
/// checks what each of them gives.
Outcome take_through(const std::filesystem::path& file, std::uint32_t seed);

}  // namespace lozenge::damage
