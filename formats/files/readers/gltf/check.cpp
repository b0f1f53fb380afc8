#include "formats/files/readers/gltf/check.h"

#include <algorithm>
#include <array>

#include "formats/files/readers/gltf/json.h"

namespace lozenge {

using nlohmann::json;

bool knows_gltf_extension(const std::string& extension) {
  static constexpr std::array<const char*, 14> known{"KHR_mesh_quantization",   "KHR_texture_transform",
                                                     "KHR_texture_basisu",      "KHR_lights_punctual",
                                                     "KHR_materials_unlit",     "EXT_texture_webp",
                                                     "EXT_texture_avif",        "MSFT_texture_dds",
                                                     "KHR_xmp_json_ld",         "MSFT_lod",
                                                     "KHR_animation_pointer",   "EXT_meshopt_compression",
                                                     "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression"};
  return extension.starts_with("KHR_materials_") || std::find(known.begin(), known.end(), extension) != known.end();
}

void check_gltf_needs(const json& document, const std::string& name) {
  const GltfObject root(document, name);
  const auto asset = root.object("asset");
  if (!asset) root.broken("is not glTF: its JSON has no \"asset\"");
  for (const char* key : {"version", "minVersion"}) {
    if (key == std::string("minVersion") && !asset->has(key)) continue;
    const std::string version = asset->text(key);
    if (!version.starts_with("2."))
      root.unsupported("is glTF version \"" + version + "\"; only 2.0 is read, convert it");
    if (key == std::string("minVersion") && version != "2.0")
      root.unsupported("needs glTF " + version + "; only 2.0 is read");
  }
  for (const std::string& extension : root.texts("extensionsRequired")) {
    if (!knows_gltf_extension(extension)) {
      root.unsupported("requires the extension " + extension + "; export it without that extension");
    }
  }
}

}  // namespace lozenge
