#include "pipeline/map_files.h"

#include "formats/files/baked_maps_file.h"

namespace lozenge {
namespace {

bool is_exr(const MapTraits& traits, const MapFiles& files) {
  return !fits_integers(traits) || files.format == MapFormat::kExr;
}

int bits_of(const MapTraits& traits, const MapFiles& files) {
  return is_exr(traits, files) ? 32 : bits_in_png(traits, files.bits);
}

}  // namespace

std::string map_file_name(const std::string& name, MapKind kind, const MapFiles& files) {
  const MapTraits& traits = traits_of(kind);
  return name + "." + std::string(traits.file_part) + (is_exr(traits, files) ? ".exr" : ".png");
}

BakedMaps write_maps(const std::filesystem::path& folder, const std::string& name, const BakedMaps& maps,
                     const MapFiles& files) {
  BakedMaps stored;
  stored.level = maps.level;
  stored.statistics = maps.statistics;
  for (const BakedMap& map : maps.maps) {
    const std::filesystem::path file = folder / map_file_name(name, map.kind, files);
    write_map(file, map, bits_of(traits_of(map.kind), files));
    stored.maps.push_back(read_map(file));
  }
  return stored;
}

}  // namespace lozenge
