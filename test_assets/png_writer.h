// PNG files for the test assets, without a library: so that the product's decoder and its test data can't share a
// mistake.
#pragma once

#include <cstdint>
#include <vector>

namespace lozenge::test_assets {

/// Of 8 bits a channel, not compressed. \param pixels  row by row, `channels` (3 or 4) bytes each
std::vector<std::uint8_t> png_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                    const std::vector<std::uint8_t>& pixels);

}  // namespace lozenge::test_assets
