// What vertices that a skin places need before they are welded.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/surface/attribute.h"

namespace lozenge {

/// Takes joints that aren't there out of elements of `kInfluences`, and makes the weights of the others 1 together; an
/// element of which nothing is left belongs to joint 0. \return how many were changed
std::int64_t repair_influences(std::vector<float>& values, std::size_t joints);

/// Whether two vertices at one place move alike, so that they may be joined: their weights differ by what exporters
/// round or artists smooth over, not by whom they follow. \param a, b  elements of `kInfluences`
bool move_alike(const float* a, const float* b);

}  // namespace lozenge
