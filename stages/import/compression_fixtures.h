// Compressed glTF files, made with the encoders of meshoptimizer and Draco: for tests of their reading. Who includes
// this includes stages/import/test_gltf.h before it.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <numeric>

namespace lozenge::testing_gltf {

/// How a buffer view is to be compressed; the view's bytes have been through the filter's encoder already.
struct ViewCoding {
  std::string mode;
  int stride;
  std::string filter;
};

inline std::string meshopt_encoded(const ViewCoding& coding, const std::string& plain) {
  const std::size_t count = plain.size() / static_cast<std::size_t>(coding.stride);
  std::vector<unsigned char> encoded;
  if (coding.mode == "ATTRIBUTES") {
    encoded.resize(meshopt_encodeVertexBufferBound(count, static_cast<std::size_t>(coding.stride)));
    encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), plain.data(), count,
                                              static_cast<std::size_t>(coding.stride)));
  } else {
    std::vector<unsigned int> indices(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&indices[i], &plain[i * static_cast<std::size_t>(coding.stride)],
                  static_cast<std::size_t>(coding.stride));
    }
    const bool triangles = coding.mode == "TRIANGLES";
    encoded.resize(triangles ? meshopt_encodeIndexBufferBound(count, count)
                             : meshopt_encodeIndexSequenceBound(count, count));
    encoded.resize(triangles ? meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), count)
                             : meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), count));
  }
  return {encoded.begin(), encoded.end()};
}

/// The same document with its first buffer views compressed. Their plain bytes would be in buffer 1, which has none.
inline TestGltf meshopt_compressed(const TestGltf& plain, const std::vector<ViewCoding>& codings) {
  TestGltf packed;
  packed.document = plain.document;
  json& views = packed.document["bufferViews"];
  for (std::size_t i = 0; i < views.size(); ++i) {
    packed.bytes.resize((packed.bytes.size() + 3) / 4 * 4, '\0');
    const std::string bytes = plain.bytes.substr(views[i]["byteOffset"], views[i]["byteLength"]);
    const std::string stored = i < codings.size() ? meshopt_encoded(codings[i], bytes) : bytes;
    if (i < codings.size()) {
      views[i]["buffer"] = 1;
      json extension = {{"buffer", 0},
                        {"byteOffset", packed.bytes.size()},
                        {"byteLength", stored.size()},
                        {"byteStride", codings[i].stride},
                        {"count", bytes.size() / static_cast<std::size_t>(codings[i].stride)},
                        {"mode", codings[i].mode}};
      if (!codings[i].filter.empty()) extension["filter"] = codings[i].filter;
      views[i]["extensions"]["EXT_meshopt_compression"] = extension;
    } else {
      views[i]["byteOffset"] = packed.bytes.size();
    }
    packed.bytes += stored;
  }
  packed.document["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  packed.document["extensionsRequired"] = packed.document["extensionsUsed"];
  const json stands_in = {{"EXT_meshopt_compression", {{"fallback", true}}}};
  packed.document["buffers"] = {{{"byteLength", packed.bytes.size()}},
                                {{"byteLength", plain.bytes.size()}, {"extensions", stands_in}}};
  return packed;
}

/// A mesh with positions and UVs, as Draco holds it.
inline std::unique_ptr<draco::Mesh> draco_mesh(const std::vector<Vec3f>& positions, const std::vector<Vec2f>& uvs,
                                               const std::vector<std::uint32_t>& indices) {
  auto mesh = std::make_unique<draco::Mesh>();
  mesh->set_num_points(static_cast<std::uint32_t>(positions.size()));
  const auto add = [&](draco::GeometryAttribute::Type type, int components, const float* values) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::int8_t>(components), draco::DT_FLOAT32, false,
                   static_cast<std::int64_t>(components) * 4, 0);
    const int id = mesh->AddAttribute(attribute, true, static_cast<std::uint32_t>(positions.size()));
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      mesh->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), values + std::size_t(components) * v);
    }
  };
  add(draco::GeometryAttribute::POSITION, 3, &positions[0].x);
  if (!uvs.empty()) add(draco::GeometryAttribute::TEX_COORD, 2, &uvs[0].x);
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    mesh->AddFace(
        {draco::PointIndex(indices[t]), draco::PointIndex(indices[t + 1]), draco::PointIndex(indices[t + 2])});
  }
  return mesh;
}

inline std::string draco_encoded(const draco::Mesh& mesh, int method) {
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// One node with one primitive, compressed. \param method  draco::MESH_SEQUENTIAL_ENCODING keeps all in its order
inline TestGltf draco_compressed(const std::vector<Vec3f>& positions, const std::vector<Vec2f>& uvs,
                                 const std::vector<std::uint32_t>& indices, int method) {
  TestGltf gltf;
  const std::string encoded = draco_encoded(*draco_mesh(positions, uvs, indices), method);
  const int view = gltf.add_view(std::vector<char>(encoded.begin(), encoded.end()));
  const auto count = positions.size();
  const int corner =
      gltf.add_accessor({{"componentType", kUnsignedShort}, {"type", "SCALAR"}, {"count", indices.size()}});
  const int position = gltf.add_accessor({{"componentType", kFloat}, {"type", "VEC3"}, {"count", count}});
  json attributes = {{"POSITION", position}};
  json ids = {{"POSITION", 0}};
  if (!uvs.empty()) {
    attributes["TEXCOORD_0"] = gltf.add_accessor({{"componentType", kFloat}, {"type", "VEC2"}, {"count", count}});
    ids["TEXCOORD_0"] = 1;
  }
  const json extension = {{"bufferView", view}, {"attributes", ids}};
  gltf.add_node({{"mesh", gltf.add_mesh({{{"attributes", attributes},
                                          {"indices", corner},
                                          {"extensions", {{"KHR_draco_mesh_compression", extension}}}}})}});
  gltf.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return gltf;
}

}  // namespace lozenge::testing_gltf
