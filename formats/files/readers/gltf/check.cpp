#include "formats/files/readers/gltf/check.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "formats/files/readers/gltf/json.h"

namespace lozenge {

namespace {

using nlohmann::json;

/// Elements that an accessor without a buffer view may have: it is all zeros, but for its sparse part, and its size is
/// not vouched for by bytes in the file.
constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 24;

}  // namespace

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

namespace {

/// Sizes of the document's lists, so that indices can be checked before their targets are.
struct Counts {
  std::uint64_t buffer_views = 0, accessors = 0, meshes = 0, nodes = 0, materials = 0, skins = 0;
};

std::uint64_t length_of(const json& document, const char* key) {
  const auto at = document.find(key);
  return at != document.end() && at->is_array() ? at->size() : 0;
}

std::uint64_t component_size(const GltfObject& owner, std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      owner.broken("componentType " + std::to_string(type) + " does not exist in glTF 2.0");
  }
}

/// Bytes of one element, the padding of small matrices' columns included.
std::uint64_t element_size(const GltfObject& owner, const std::string& type, std::uint64_t component) {
  static const std::map<std::string, std::uint64_t> vectors{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  static const std::map<std::string, std::uint64_t> matrices{{"MAT2", 2}, {"MAT3", 3}, {"MAT4", 4}};
  if (const auto at = vectors.find(type); at != vectors.end()) return at->second * component;
  if (const auto at = matrices.find(type); at != matrices.end()) {
    const std::uint64_t column = (at->second * component + 3) / 4 * 4;
    return column * at->second;
  }
  owner.broken("type \"" + type + "\" does not exist in glTF");
}

class StructureCheck {
 public:
  StructureCheck(const json& document, const std::vector<std::uint64_t>& buffer_sizes, const std::string& name)
      : document_(document, name), buffer_sizes_(buffer_sizes), prefix_(name + ": ") {
    counts_ = {length_of(document, "bufferViews"), length_of(document, "accessors"), length_of(document, "meshes"),
               length_of(document, "nodes"),       length_of(document, "materials"), length_of(document, "skins")};
  }

  void run() {
    for (const GltfObject& view : document_.list("bufferViews", prefix_, "buffer view")) check_view(view);
    for (const GltfObject& accessor : document_.list("accessors", prefix_, "accessor")) check_accessor(accessor);
    for (const GltfObject& mesh : document_.list("meshes", prefix_, "mesh")) check_mesh(mesh);
    check_nodes(document_.list("nodes", prefix_, "node"));
    const auto scenes = document_.list("scenes", prefix_, "scene");
    for (const GltfObject& scene : scenes) {
      scene.indices("nodes", counts_.nodes);
      scene.text("name");
    }
    document_.index("scene", scenes.size());
    for (const char* key : {"materials", "textures", "images", "samplers", "animations", "skins", "cameras"}) {
      for (const GltfObject& object : document_.list(key, prefix_, std::string(key) + " entry")) object.text("name");
    }
    for (const GltfObject& image : document_.list("images", prefix_, "image")) {
      image.index("bufferView", counts_.buffer_views);
      image.text("uri");
      image.text("mimeType");
    }
  }

 private:
  void check_view(const GltfObject& view) {
    const std::uint64_t buffer = view.required_index("buffer", buffer_sizes_.size());
    const std::uint64_t offset = view.whole_or("byteOffset", 0);
    const std::uint64_t length = view.required_whole("byteLength");
    const std::uint64_t stride = view.whole_or("byteStride", 0);
    if (length == 0) view.broken("byteLength is 0");
    if (offset + length > buffer_sizes_[buffer]) {
      view.broken("ends " + std::to_string(offset + length - buffer_sizes_[buffer]) + " bytes past buffer " +
                  std::to_string(buffer) + ", which has " + std::to_string(buffer_sizes_[buffer]));
    }
    if (view.has("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0)) {
      view.broken("byteStride is " + std::to_string(stride) + "; it must be a multiple of 4 from 4 to 252");
    }
    views_.push_back({length, stride});
  }

  /// `count` elements of `size` bytes, `stride` apart (0: tightly), from `offset`, lie inside the view.
  void check_range(const GltfObject& owner, std::uint64_t view, std::uint64_t offset, std::uint64_t count,
                   std::uint64_t size, std::uint64_t stride) const {
    const std::uint64_t step = stride == 0 ? size : stride;
    if (step < size)
      owner.broken("its elements of " + std::to_string(size) + " bytes overlap, byteStride is " + std::to_string(step));
    const std::uint64_t end = offset + (count - 1) * step + size;
    if (end > views_[view].length) {
      owner.broken("ends " + std::to_string(end - views_[view].length) + " bytes past buffer view " +
                   std::to_string(view) + ", which has " + std::to_string(views_[view].length));
    }
  }

  void check_accessor(const GltfObject& accessor) {
    const std::uint64_t component = component_size(accessor, accessor.required_whole("componentType"));
    const std::uint64_t size = element_size(accessor, accessor.text("type"), component);
    // At most 2^40 elements 252 bytes apart: no sum overflows.
    const std::uint64_t count = accessor.required_whole("count");
    const std::uint64_t offset = accessor.whole_or("byteOffset", 0);
    if (count == 0) accessor.broken("count is 0");
    if (accessor.has("normalized") && !accessor.value()["normalized"].is_boolean())
      accessor.broken("normalized is neither true nor false");
    if (const auto view = accessor.index("bufferView", counts_.buffer_views)) {
      check_range(accessor, *view, offset, count, size, views_[*view].stride);
      zeros_.push_back(0);
    } else {
      zeros_.push_back(count);
    }
    if (const auto sparse = accessor.object("sparse")) check_sparse(*sparse, count, size);
  }

  void check_sparse(const GltfObject& sparse, std::uint64_t count, std::uint64_t size) {
    const std::uint64_t replaced = sparse.required_whole("count", INT32_MAX);
    if (replaced == 0 || replaced > count) {
      sparse.broken("count is " + std::to_string(replaced) + " of " + std::to_string(count) + " elements");
    }
    const auto indices = sparse.object("indices");
    const auto values = sparse.object("values");
    if (!indices || !values) sparse.broken("indices or values are missing");
    const std::uint64_t type = indices->required_whole("componentType");
    if (type != 5121 && type != 5123 && type != 5125)
      indices->broken("componentType " + std::to_string(type) + " is not unsigned");
    // tinygltf keeps the count and these offsets as int.
    check_range(*indices, indices->required_index("bufferView", counts_.buffer_views),
                indices->whole("byteOffset", INT32_MAX).value_or(0), replaced, component_size(*indices, type), 0);
    check_range(*values, values->required_index("bufferView", counts_.buffer_views),
                values->whole("byteOffset", INT32_MAX).value_or(0), replaced, size, 0);
  }

  void check_mesh(const GltfObject& mesh) {
    mesh.text("name");
    const auto primitives = mesh.list("primitives", mesh.place() + " ", "primitive");
    if (primitives.empty()) mesh.broken("has no primitives");
    for (const GltfObject& primitive : primitives) {
      const auto attributes = primitive.object("attributes");
      if (!attributes) primitive.broken("attributes are missing");
      for (const auto& [key, value] : attributes->value().items())
        require_data(attributes->required_index(key.c_str(), counts_.accessors));
      if (const auto indices = primitive.index("indices", counts_.accessors)) require_data(*indices);
      for (const GltfObject& target : primitive.list("targets", primitive.place() + " ", "target")) {
        for (const auto& [key, value] : target.value().items()) {
          require_data(target.required_index(key.c_str(), counts_.accessors));
        }
      }
      primitive.index("material", counts_.materials);
      primitive.whole("mode", 6);
    }
  }

  /// Asked only of what is read: the accessors of compressed primitives have counts, but no data.
  void require_data(std::uint64_t accessor) const {
    if (zeros_[accessor] <= kMostZeros) return;
    throw Error(ExitCode::kLimit, prefix_ + "accessor " + std::to_string(accessor) +
                                      ": has no buffer view and a count of " + std::to_string(zeros_[accessor]) +
                                      "; at most " + std::to_string(kMostZeros) + " are read");
  }

  /// No node has two parents, and none is below itself.
  void check_nodes(const std::vector<GltfObject>& nodes) {
    std::vector<std::optional<std::size_t>> parents(nodes.size());
    std::vector<std::vector<std::uint64_t>> children(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      check_node(nodes[n]);
      children[n] = nodes[n].indices("children", counts_.nodes);
      for (const std::uint64_t child : children[n]) {
        if (parents[child]) {
          nodes[child].broken("is a child of node " + std::to_string(*parents[child]) + " and of node " +
                              std::to_string(n) + "; nodes must form trees");
        }
        parents[child] = n;
      }
    }
    // With one parent each, a node that no root leads to is below itself.
    std::vector<std::uint64_t> open;
    std::vector<bool> reached(nodes.size(), false);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (!parents[n]) open.push_back(n);
    }
    while (!open.empty()) {
      const std::uint64_t n = open.back();
      open.pop_back();
      reached[n] = true;
      open.insert(open.end(), children[n].begin(), children[n].end());
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost != reached.end())
      nodes[static_cast<std::size_t>(lost - reached.begin())].broken("is below itself; nodes must form trees");
  }

  void check_node(const GltfObject& node) const {
    node.text("name");
    node.index("mesh", counts_.meshes);
    node.index("skin", counts_.skins);
    node.check_numbers("matrix", 16);
    node.check_numbers("translation", 3);
    node.check_numbers("rotation", 4);
    node.check_numbers("scale", 3);
    if (const auto instancing = node.extension("EXT_mesh_gpu_instancing")) {
      const auto attributes = instancing->object("attributes");
      if (!attributes) instancing->broken("attributes are missing");
      for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (const auto accessor = attributes->index(key, counts_.accessors)) require_data(*accessor);
      }
    }
  }

  struct View {
    std::uint64_t length, stride;
  };

  GltfObject document_;
  const std::vector<std::uint64_t>& buffer_sizes_;
  std::string prefix_;
  Counts counts_;
  std::vector<View> views_;
  std::vector<std::uint64_t> zeros_;  ///< [accessor] its count where it has no buffer view, else 0
};

}  // namespace

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

void check_gltf_structure(const json& document, const std::vector<std::uint64_t>& buffer_sizes,
                          const std::string& name) {
  StructureCheck(document, buffer_sizes, name).run();
}

}  // namespace lozenge
