// Two numbers side by side: every processor that Lozenge runs on works on both at once.
#pragma once

#include <cmath>

namespace lozenge {

/// Calculated with like a number.
using Lanes = double __attribute__((vector_size(16)));

/// What comparing lanes gives: -1 where it is true, else 0.
using LaneTruths = decltype(Lanes{} > Lanes{});

inline double sum(const Lanes& x) { return x[0] + x[1]; }
inline bool all(const LaneTruths& x) { return (x[0] & x[1]) != 0; }

inline double power(double base, double exponent) { return std::pow(base, exponent); }
inline Lanes power(const Lanes& base, double exponent) {
  return Lanes{std::pow(base[0], exponent), std::pow(base[1], exponent)};
}

}  // namespace lozenge
