// What the EXR files of patches have in common: attributes that say how patches lie on the domain, and errors that name
// the file. For .cpp files alone: it includes OpenEXR.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/patches/patch_layout.h"
#include "formats/surface/attribute.h"

namespace lozenge {

/// Adds the attributes `lozenge.kind`, `.version`, `.samples`, `.patches`, `.boundsLow`, `.boundsHigh`, `.translation`,
/// `.scene`, `.origin`, `.doubleSided`, `.places`, `.adjacency` and, where something has them, `.firstLevels`,
/// `.materialClasses`, `.bodyNames`, `.bodySkins`, `.bodyPlaces` and `.bodyOf` (docs/format.md).
void put_layout(Imf::Header& header, const std::string& kind, const PatchLayout& layout);

/// Reads them back, and checks that N is a power of two plus one, that the places make up whole triangles and the
/// adjacency is the one that follows from them, that bounds are finite and in order, and that patches that touch
/// have the same first level and belong to the same body. Of version 1 it reads what that had
/// for repeated meshes.
/// \throws Error(kUnusableInput) naming `file` and the attribute
PatchLayout get_layout(const Imf::Header& header, const std::string& kind, const std::string& file);

/// An int attribute of the header.
/// \throws Error(kUnusableInput) where there is none of that type
std::int32_t get_int(const Imf::Header& header, const char* name, const std::string& file);

/// The file contradicts the format: throws Error(kUnusableInput).
[[noreturn]] void refuse_exr(const std::string& file, const std::string& what);

/// The header's picture is tiled with square tiles of `tile` pixels, `columns` x `rows` of them, its origin is (0, 0),
/// and the file is long enough to hold it (so that a claimed size is never allocated for a few bytes). \throws
/// Error(kUnusableInput)
void require_tiles(const Imf::Header& header, std::int32_t tile, std::int32_t columns, std::int32_t rows,
                   const std::filesystem::path& file);

/// 32-bit unsigned, in files of surfaces of which a sample lies on the cap of a filled hole: 1 there, else 0.
inline constexpr const char* kCapChannel = "cap";
bool has_cap_channel(const Imf::Header& header);

/// 32-bit floats, in files of surfaces of which a body has a skin: the joints that move a sample, by their numbers in
/// the skin, and their weights, 0 where there are fewer.
inline constexpr std::array<const char*, kInfluences.components> kInfluenceChannels{
    "joint.0",  "joint.1",  "joint.2",  "joint.3",  "joint.4",  "joint.5",  "joint.6",  "joint.7",
    "weight.0", "weight.1", "weight.2", "weight.3", "weight.4", "weight.5", "weight.6", "weight.7"};
/// Those of one set, or of two. \param sets  `sets_of_joints`
std::vector<std::string> influence_channels(int sets);
/// Sets that a file has channels of; 0 where it has none.
int sets_of_influence_channels(const Imf::Header& header);
void add_influence_channels(Imf::Header& header, int sets);
/// All of them: those that a file hasn't got are read as zeros, and not written.
/// \param influences  elements of `kInfluences`, row by row of so many
void insert_influences(Imf::FrameBuffer& frame, const std::vector<float>& influences, std::size_t row);

/// The header's channels are exactly these floats and these unsigned ones, not subsampled.
/// \throws Error(kUnusableInput)
void require_channels(const Imf::Header& header, const std::vector<std::string>& floats,
                      const std::vector<std::string>& whole, const std::string& file);

}  // namespace lozenge
