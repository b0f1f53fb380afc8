// The distortion that the map minimizes (paper, Sec. 5.2 and eq. 4), as one function of two numbers a triangle.
//
// Let J map a source triangle, scaled so that the whole surface has the domain's area, to its image. With
// T = |J|^2 (the sum of its squared singular values) and d = det J,
//   conformal distortion (MIPS)  d_c = T / (2 d)
//   area distortion              d_a = (d + 1/d) / 2
// both 1 for an isometry. T is quadratic and d linear in the position of each corner, so every energy f(T, d) has cheap
// exact derivatives.
#pragma once

#include <concepts>

#include "stages/parameterize/map/lanes.h"

namespace lozenge {

/// Energies of one triangle, each 1 for an isometry and without bound where the triangle degenerates.
enum class EnergyKind {
  kIsometric,           ///< d_a^gamma d_c: areas and angles (paper, eq. 4)
  kMips,                ///< d_c alone
  kSymmetricDirichlet,  ///< (T + T / d^2) / 4
};

struct Energy {
  EnergyKind kind = EnergyKind::kIsometric;
  double gamma = 3;  ///< weight of the areas in the isometric energy; the paper's choice
};

/// Of one triangle, or of two side by side.
template <typename Number>
concept TriangleNumber = std::same_as<Number, double> || std::same_as<Number, Lanes>;

/// Value of f(T, d) and its derivatives; f_TT is 0 for all of them.
template <TriangleNumber Number>
struct EnergyDerivatives {
  Number f{};
  Number f_t{};
  Number f_d{};
  Number f_td{};
  Number f_dd{};
};

/// \pre d > 0
template <TriangleNumber Number>
inline Number evaluate(const Energy& energy, const Number& t, const Number& d) {
  const Number inverse = 1.0 / d;
  switch (energy.kind) {
    case EnergyKind::kMips:
      return 0.5 * t * inverse;
    case EnergyKind::kSymmetricDirichlet:
      return 0.25 * t * (1.0 + inverse * inverse);
    case EnergyKind::kIsometric:
      break;
  }
  const Number a = 0.5 * (d + inverse);
  const Number grown = energy.gamma == 3 ? a * a * a : power(a, energy.gamma);
  return 0.5 * t * inverse * grown;
}

/// \pre d > 0
template <TriangleNumber Number>
inline EnergyDerivatives<Number> differentiate(const Energy& energy, const Number& t, const Number& d) {
  // Every energy here is t * h(d).
  const Number inverse = 1.0 / d;
  Number h{}, h1{}, h2{};
  switch (energy.kind) {
    case EnergyKind::kMips:
      h = 0.5 * inverse;
      h1 = -h * inverse;
      h2 = -2.0 * h1 * inverse;
      break;
    case EnergyKind::kSymmetricDirichlet:
      h = 0.25 * (1.0 + inverse * inverse);
      h1 = -0.5 * inverse * inverse * inverse;
      h2 = -3.0 * h1 * inverse;
      break;
    case EnergyKind::kIsometric: {
      const double g = energy.gamma;
      const Number a = 0.5 * (d + inverse);
      const Number a1 = 0.5 * (1.0 - inverse * inverse);
      const Number a2 = inverse * inverse * inverse;
      const Number p2 = g == 3 ? a : power(a, g - 2);  // a^(g-2)
      const Number p1 = p2 * a;
      const Number p = p1 * a;
      const Number q1 = g * p1 * a1;
      const Number q2 = g * ((g - 1) * p2 * a1 * a1 + p1 * a2);
      const Number c = 0.5 * inverse;
      const Number c1 = -c * inverse;
      const Number c2 = -2.0 * c1 * inverse;
      h = c * p;
      h1 = c1 * p + c * q1;
      h2 = c2 * p + 2.0 * c1 * q1 + c * q2;
      break;
    }
  }
  return {t * h, h, t * h1, h1, t * h2};
}

}  // namespace lozenge
