#include "pipeline/maps/map_files.h"

#include "formats/base/parallel.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/map_mips_file.h"

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

BakedMaps write_maps(const std::filesystem::path& folder, const std::string& name, BakedMaps maps,
                     const MapFiles& files) {
  // Encoding takes much longer than writing.
  for_each_index(maps.maps.size(), true, [&](std::size_t i) {
    BakedMap& map = maps.maps[i];
    const MapTraits& traits = traits_of(map.kind);
    map = as_stored(std::move(map), !is_exr(traits, files), bits_of(traits, files), files.normal_y);
  });
  for (const BakedMap& map : maps.maps) {
    write_map(folder / map_file_name(name, map.kind, files), map, bits_of(traits_of(map.kind), files), files.normal_y);
  }
  return maps;
}

void write_mips(const std::filesystem::path& folder, const std::string& name, const BakedMaps& maps,
                const PatchLayout& patches, const MapFiles& files) {
  if (!files.ktx2) return;
  for (const BakedMap& map : maps.maps) {
    const MapTraits& traits = traits_of(map.kind);
    if (!fits_integers(traits)) continue;
    const std::filesystem::path file = folder / (name + "." + std::string(traits.file_part) + ".ktx2");
    write_map_mips(file, map, surface_mips(map, patches), bits_in_png(traits, files.bits));
  }
}

}  // namespace lozenge
