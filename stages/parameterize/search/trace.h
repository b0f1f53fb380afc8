// How good the map is at each size of the domain (the paper's Fig. 5).
#pragma once

#include <cstdint>

namespace lozenge {

/// The map's quality at one size of the domain: a row of the paper's Fig. 5.
struct TraceRow {
  std::int32_t domain_faces = 0;
  double area = 0;  ///< distortions, as in `Distortion`
  double angle = 0;
  double aggregate = 0;
  double weighed = 0;  ///< `weighed_by_size`, the paper's (6)
};

}  // namespace lozenge
