// How many triangles a domain shall have.
//
// The source's triangles are cut along the borders of patches, in the level that keeps them all, and each patch takes
// room. On average cutting makes 1 + 7.6 sqrt(F / T) triangles of each, for F domain triangles and T of the source: the
// borders of patches cross edges as needles cross lines. From 50,000 triangles on half as many more are wanted at most,
// from 2,000 on one and a half times as many more, below three times as many.
#pragma once

#include <cstdint>

namespace lozenge {

/// The number of triangles that a domain shall have.
struct FaceRange {
  std::int32_t least = 0;
  std::int32_t most = 0;
};

/// The interval where nobody asks for one: half of what the surface may have, up to all of it, and to 200, as of
/// large surfaces. \param triangles  of the source, before any is split
FaceRange faces_for_source(std::int64_t triangles);

/// How many triangles cutting one of `triangles` along the borders of `faces` domain triangles adds.
double added_by_cutting(double triangles, double faces);

/// How many triangles may be added to those of a source of so many.
double most_added(double triangles);

}  // namespace lozenge
