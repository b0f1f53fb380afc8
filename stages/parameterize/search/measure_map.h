// How distorted a map is while it is being made, by the measures of the file's (`Distortion`), in floating point.
#pragma once

#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/search/trace.h"

namespace lozenge {

/// The distortion of the map as it stands.
TraceRow measure_map(const WorkingMap& map);

}  // namespace lozenge
