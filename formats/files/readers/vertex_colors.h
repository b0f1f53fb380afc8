// Colours as scanners and sculpting programs write them, and as glTF wants them.
#pragma once

#include <vector>

namespace lozenge {

/// Stands for each component of a vertex without a colour.
inline constexpr float kNoColor = -1;

/// Stands for an alpha that the file doesn't give.
inline constexpr float kOpaque = -2;

/// Makes COLOR_0, which is linear, of the colours in a PLY, OBJ or OFF. None of these formats says what its numbers
/// mean, but what they hold was photographed or painted, and is shown as it is by the programs that write them: so red,
/// green and blue are taken as encoded by sRGB (IEC 61966-2-1), bytes and floats alike. Alpha is linear anyway.
///
/// Numbers in text may go from 0 to 1 or from 0 to 255; any above 1 tells that it is the latter. Vertices without a
/// colour become white.
/// \param colors  4 for each vertex
void make_linear(std::vector<float>& colors);

}  // namespace lozenge
