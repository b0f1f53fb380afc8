#include "pipeline/map_files.h"

#include "formats/files/baked_maps_file.h"

namespace lozenge {
namespace {

std::string_view part_of_name(MapKind kind) {
  switch (kind) {
    case MapKind::kTangentNormal:
      return "normal";
    case MapKind::kObjectNormal:
      return "object_normal";
    case MapKind::kOcclusion:
      return "occlusion";
    case MapKind::kPosition:
      return "position";
  }
  return "map";
}

bool is_exr(MapKind kind, const MapFiles& files) {
  return kind == MapKind::kPosition || files.format == MapFormat::kExr;
}

int bits_of(MapKind kind, const MapFiles& files) {
  if (is_exr(kind, files)) return 32;
  return kind == MapKind::kOcclusion ? 8 : files.bits;
}

}  // namespace

std::string map_file_name(const std::string& name, MapKind kind, const MapFiles& files) {
  return name + "." + std::string(part_of_name(kind)) + (is_exr(kind, files) ? ".exr" : ".png");
}

BakedMaps write_maps(const std::filesystem::path& folder, const std::string& name, const BakedMaps& maps,
                     const MapFiles& files) {
  BakedMaps stored;
  stored.level = maps.level;
  stored.statistics = maps.statistics;
  for (const BakedMap& map : maps.maps) {
    const std::filesystem::path file = folder / map_file_name(name, map.kind, files);
    write_map(file, map, bits_of(map.kind, files));
    stored.maps.push_back(read_map(file));
  }
  return stored;
}

}  // namespace lozenge
