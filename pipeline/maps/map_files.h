// How baked maps are called and stored.
#pragma once

#include <filesystem>
#include <string>

#include "formats/patches/baked_maps.h"

namespace lozenge {

enum class MapFormat { kPng, kExr };

struct MapFiles {
  MapFormat format = MapFormat::kPng;
  int bits = 8;  ///< a channel of normal maps in a PNG, 8 or 16; occlusion has 8, an EXR 32 (floating point)
  NormalY normal_y = NormalY::kUp;  ///< in files of PNG and EXR; in the asset it is up, as glTF says
  bool ktx2 = false;                ///< whether maps that fit integers are written with their mips, too
};

/// "statue.normal.png", "statue.object_normal.png", "statue.occlusion.exr", ... Positions are always EXR: they don't
/// fit into the 0 to 1 of a PNG.
std::string map_file_name(const std::string& name, MapKind kind, const MapFiles& files);

/// Writes each of the maps into `folder`.
/// \return the maps as their files hold them: what a later command would read, rounded to their bits
BakedMaps write_maps(const std::filesystem::path& folder, const std::string& name, BakedMaps maps,
                     const MapFiles& files);

/// Where `files` asks for it, writes those of the maps that fit integers with their mips, as "statue.normal.ktx2", ...
/// \param maps  as `write_maps` gave them \param patches  whose tiles they are
void write_mips(const std::filesystem::path& folder, const std::string& name, const BakedMaps& maps,
                const PatchLayout& patches, const MapFiles& files);

}  // namespace lozenge
