// Draco's stream says early how many triangles it holds, and its decoder takes memory for as many. So that number is
// read first, with Draco's own tools, and has to be the one of the accessors. (Draco bitstream specification, Sec. 3;
// KHR_draco_mesh_compression, "Conformance".)
#include "formats/files/readers/gltf/draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>
#include <new>
#include <stdexcept>

#include "formats/files/readers/gltf/json.h"

namespace lozenge {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_draco_mesh_compression";
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleStrip = 5;
constexpr std::uint64_t kUnsignedInt = 5125;

/// Bytes that Draco's decoder takes for a triangle (its tables of corners and vertices), and for each component of an
/// attribute of a point (the values, quantized and plain).
constexpr std::uint64_t kDecoderBytesOfTriangle = 120;
constexpr std::uint64_t kDecoderBytesOfComponent = 12;

/// Triangles that a stream of so many bytes may hold. The flattest of grids takes more than a byte for a hundred.
std::uint64_t most_in(std::uint64_t bytes) { return 1'000'000 + 4096 * bytes; }

/// The triangles that the stream promises; nothing where its header is damaged.
/// \throws Error(kUnsupported) where its version isn't 2.2, the only one that glTF allows
std::optional<std::uint64_t> promised_triangles(const ByteRange& bytes, const GltfObject& extension) {
  draco::DecoderBuffer stream;
  stream.Init(reinterpret_cast<const char*>(bytes.data), bytes.size);
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&stream, &header).ok()) return std::nullopt;
  if (header.encoder_type != draco::TRIANGULAR_MESH) extension.broken("holds no triangles, but points");
  if (header.version_major != 2 || header.version_minor != 2) {
    extension.unsupported("is of version " + std::to_string(header.version_major) + "." +
                          std::to_string(header.version_minor) + " of Draco; only 2.2 is read, export the file again");
  }
  stream.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
  if ((header.flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&stream, &metadata)) return std::nullopt;
  }
  std::uint32_t number = 0;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    std::uint8_t traversal = 0;
    if (!stream.Decode(&traversal) || !draco::DecodeVarint(&number, &stream)) return std::nullopt;  // the vertices
  }
  if (!draco::DecodeVarint(&number, &stream)) return std::nullopt;
  return number;
}

std::unique_ptr<draco::Mesh> decode(const ByteRange& bytes, const GltfObject& extension) {
  draco::DecoderBuffer stream;
  stream.Init(reinterpret_cast<const char*>(bytes.data), bytes.size);
  draco::Decoder decoder;
  try {
    auto result = decoder.DecodeMeshFromBuffer(&stream);
    if (!result.ok()) extension.broken("Draco can't decode it (" + result.status().error_msg_string() + ")");
    return std::move(result).value();
  } catch (const std::length_error&) {
    extension.broken("Draco can't decode it (absurd sizes)");
  }
}

/// Accessors as the document has them, before they are checked as a whole.
struct AccessorText {
  GltfObject object;
  std::uint64_t count;
};

class DracoPrimitives {
 public:
  DracoPrimitives(json& document, GltfBytes& buffers, const std::string& name, MemoryBudget& budget,
                  std::uint64_t most_triangles)
      : document_(document), buffers_(buffers), name_(name), budget_(budget), triangles_left_(most_triangles) {}

  void run(GltfDefects& defects) {
    const auto meshes = GltfObject(document_, name_).list("meshes", name_ + ": ", "mesh");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const auto primitives = meshes[m].list("primitives", meshes[m].place() + " ", "primitive");
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        try {
          if (const auto extension = primitives[p].extension(kExtension)) {
            run(primitives[p], *extension, document_["meshes"][m]["primitives"][p]);
          }
        } catch (const Error& error) {
          if (error.code() != ExitCode::kUnusableInput) throw;
          defects.primitives.emplace(std::pair(m, p), error.what());
        }
      }
    }
  }

 private:
  void run(const GltfObject& primitive, const GltfObject& extension, json& target) {
    const std::uint64_t mode = primitive.whole_or("mode", kTriangles);
    if (mode != kTriangles && mode != kTriangleStrip) extension.broken("is of a primitive that holds no triangles");
    const auto bytes = bytes_of_range(view_of(extension), buffers_);
    const auto faces = promised_triangles(bytes, extension);
    if (!faces || *faces > most_in(bytes.size)) extension.broken("its header is damaged; export the file again");
    const AccessorText indices = accessor_of(primitive, "indices");
    // What Draco holds are triangles, whatever the mode; a strip's accessor may count its corners.
    if (mode == kTriangles) require_count(extension, "triangle corners", 3 * *faces, indices.count);
    take_triangles(extension, *faces);
    budget_.take(*faces * kDecoderBytesOfTriangle, extension.place() + ": decompressing it");

    const auto mesh = decode(bytes, extension);
    if (mesh->num_faces() != *faces) extension.broken("holds other triangles than it promises");
    json replaced = target;
    replaced["mode"] = kTriangles;
    replaced["extensions"].erase(kExtension);
    replaced["indices"] = add_triangles(*mesh);
    const auto named = primitive.object("attributes");
    const auto ids = extension.object("attributes");
    if (!named || !ids) extension.broken("attributes are missing");
    for (const auto& [attribute, value] : ids->value().items()) {
      const std::uint64_t id = ids->required_whole(attribute.c_str(), UINT32_MAX);
      const auto* found = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
      if (found == nullptr) ids->broken(attribute + " is " + std::to_string(id) + ", an id that Draco doesn't hold");
      const AccessorText accessor = accessor_of(*named, attribute.c_str());
      require_count(*ids, attribute, mesh->num_points(), accessor.count);
      replaced["attributes"][attribute] = add_values(*mesh, *found, accessor, *ids, attribute);
    }
    pending_.emplace_back(&target, std::move(replaced));
  }

  GltfObject view_of(const GltfObject& extension) {
    const json& views = list_of("bufferViews");
    const std::uint64_t view = extension.required_index("bufferView", views.size());
    return {views[view], name_ + ": buffer view " + std::to_string(view)};
  }

  AccessorText accessor_of(const GltfObject& owner, const char* key) {
    const json& accessors = list_of("accessors");
    const std::uint64_t id = owner.required_index(key, accessors.size());
    const GltfObject object(accessors[id], name_ + ": accessor " + std::to_string(id));
    return {object, object.required_whole("count")};
  }

  /// A list of the document, empty where there is none.
  const json& list_of(const char* key) const {
    static const json none = json::array();
    const auto at = document_.find(key);
    return at != document_.end() && at->is_array() ? *at : none;
  }

  static void require_count(const GltfObject& place, const std::string& what, std::uint64_t held, std::uint64_t said) {
    if (held == said) return;
    place.broken("Draco holds " + std::to_string(held) + " " + what + ", their accessor counts " +
                 std::to_string(said));
  }

  void take_triangles(const GltfObject& extension, std::uint64_t count) {
    if (count > triangles_left_) {
      throw Error(ExitCode::kLimit, extension.place() +
                                        ": with its triangles there are more than allowed; use a smaller input, or "
                                        "raise --max-triangles");
    }
    triangles_left_ -= count;
  }

  /// \return the accessor of these bytes, a buffer and a view of their own
  std::uint64_t add_accessor(std::vector<unsigned char> bytes, json accessor) {
    json& views = document_["bufferViews"];
    new_views_.push_back({{"buffer", buffers_.size()}, {"byteOffset", 0U}, {"byteLength", bytes.size()}});
    buffers_.push_back(std::move(bytes));
    accessor["bufferView"] = views.size() + new_views_.size() - 1;
    accessor["byteOffset"] = 0U;
    accessor.erase("sparse");
    new_accessors_.push_back(std::move(accessor));
    return document_["accessors"].size() + new_accessors_.size() - 1;
  }

  std::uint64_t add_triangles(const draco::Mesh& mesh) {
    const std::uint64_t faces = mesh.num_faces();
    budget_.take(12 * faces, name_ + ": decompressing triangles");
    std::vector<unsigned char> bytes(12 * faces);
    for (std::uint64_t f = 0; f < faces; ++f) {
      const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(f)));
      const std::array<std::uint32_t, 3> corners{face[0].value(), face[1].value(), face[2].value()};
      std::memcpy(&bytes[12 * f], corners.data(), 12);
    }
    return add_accessor(std::move(bytes), {{"componentType", kUnsignedInt}, {"type", "SCALAR"}, {"count", 3 * faces}});
  }

  template <typename T>
  static void convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const GltfObject& place,
                      std::vector<unsigned char>& bytes) {
    const auto components = static_cast<std::size_t>(attribute.num_components());
    bytes.resize(mesh.num_points() * components * sizeof(T));
    std::vector<T> value(components);
    for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
      const auto at = attribute.mapped_index(draco::PointIndex(p));
      if (at.value() >= attribute.size() ||
          !attribute.ConvertValue<T>(at, static_cast<std::int8_t>(components), value.data())) {
        place.broken("Draco holds values that don't fit the type of their accessor");
      }
      std::memcpy(&bytes[p * components * sizeof(T)], value.data(), components * sizeof(T));
    }
  }

  std::uint64_t add_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                           const AccessorText& accessor, const GltfObject& place, const std::string& name) {
    static constexpr std::array<const char*, 4> types{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto components = static_cast<std::uint64_t>(attribute.num_components());
    if (components < 1 || components > 4 || accessor.object.text("type") != types[components - 1]) {
      place.broken("Draco holds " + std::to_string(components) + " components of " + name + ", their accessor is of " +
                   accessor.object.text("type"));
    }
    budget_.take(mesh.num_points() * components * kDecoderBytesOfComponent, place.place() + ": decompressing " + name);
    std::vector<unsigned char> bytes;
    switch (accessor.object.required_whole("componentType")) {
      case 5120:
        convert<std::int8_t>(mesh, attribute, place, bytes);
        break;
      case 5121:
        convert<std::uint8_t>(mesh, attribute, place, bytes);
        break;
      case 5122:
        convert<std::int16_t>(mesh, attribute, place, bytes);
        break;
      case 5123:
        convert<std::uint16_t>(mesh, attribute, place, bytes);
        break;
      case kUnsignedInt:
        convert<std::uint32_t>(mesh, attribute, place, bytes);
        break;
      case 5126:
        convert<float>(mesh, attribute, place, bytes);
        break;
      default:
        accessor.object.broken("componentType does not exist in glTF 2.0");
    }
    return add_accessor(std::move(bytes), accessor.object.value());
  }

 public:
  /// Puts what was decoded into the document. Until then nothing in it moves: all above points into it.
  void finish() {
    for (auto& [target, replaced] : pending_) *target = std::move(replaced);
    for (json& view : new_views_) document_["bufferViews"].push_back(std::move(view));
    for (json& accessor : new_accessors_) document_["accessors"].push_back(std::move(accessor));
  }

 private:
  json& document_;
  GltfBytes& buffers_;
  const std::string& name_;
  MemoryBudget& budget_;
  std::uint64_t triangles_left_;
  std::vector<json> new_views_;
  std::vector<json> new_accessors_;
  std::vector<std::pair<json*, json>> pending_;
};

}  // namespace

void decode_draco_primitives(json& document, GltfBytes& buffers, const std::string& name, MemoryBudget& budget,
                             std::uint64_t most_triangles, GltfDefects& defects) {
  DracoPrimitives primitives(document, buffers, name, budget, most_triangles);
  primitives.run(defects);
  primitives.finish();
}

}  // namespace lozenge
