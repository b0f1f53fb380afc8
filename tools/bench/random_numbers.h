// Random numbers that are the same everywhere: the standard's distributions are not.
#pragma once

#include <cstdint>
#include <random>

namespace lozenge::bench {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// In [0, count). \pre 0 < count < 2^31
  std::int32_t below(std::int32_t count) { return static_cast<std::int32_t>(unit() * count); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lozenge::bench
