// The views' places in the buffer without bytes are those that they would have uncompressed.
#include "formats/files/meshopt_glb.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "formats/files/glb_container.h"

namespace lozenge {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "EXT_meshopt_compression";
constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;

using Bytes = std::vector<unsigned char>;

std::uint32_t number_at(const std::string& glb, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, glb.data() + at, sizeof number);
  return number;
}

std::size_t aligned(std::size_t size) { return (size + 3) / 4 * 4; }

std::size_t bytes_of_component(int type) {
  return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
}

std::size_t components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

/// What of a view is to be encoded how.
struct Coding {
  bool is_indices = false;
  std::size_t count = 0;
  std::size_t stride = 0;
};

/// [view]
std::map<std::size_t, Coding> codings_of(const json& document) {
  std::map<std::size_t, Coding> codings;
  const auto add = [&](const json& number, bool is_indices) {
    const json& accessor = document["accessors"][number.get<std::size_t>()];
    if (!accessor.contains("bufferView") || accessor.contains("sparse")) return;
    const std::size_t view = accessor["bufferView"].get<std::size_t>();
    const std::size_t tight =
        bytes_of_component(accessor["componentType"].get<int>()) * components_of(accessor["type"].get<std::string>());
    const std::size_t stride = document["bufferViews"][view].value("byteStride", tight);
    const auto count = accessor["count"].get<std::size_t>();
    const bool fits = is_indices ? count % 3 == 0 && stride >= 2 : stride % 4 == 0 && stride <= 256;
    const bool is_alone = document["bufferViews"][view]["byteLength"].get<std::size_t>() == count * stride;
    if (fits && is_alone) codings[view] = {is_indices, count, stride};
  };
  for (const json& mesh : document.value("meshes", json::array())) {
    for (const json& primitive : mesh["primitives"]) {
      if (primitive.contains("indices")) add(primitive["indices"], true);
      for (const json& accessor : primitive["attributes"]) add(accessor, false);
      for (const json& target : primitive.value("targets", json::array())) {
        for (const json& accessor : target) add(accessor, false);
      }
    }
  }
  return codings;
}

Bytes encoded_indices(const unsigned char* bytes, const Coding& coding) {
  std::vector<unsigned int> indices(coding.count);
  unsigned int greatest = 0;
  for (std::size_t i = 0; i < coding.count; ++i) {
    std::memcpy(&indices[i], bytes + i * coding.stride, coding.stride);
    greatest = std::max(greatest, indices[i]);
  }
  Bytes encoded(meshopt_encodeIndexBufferBound(coding.count, std::size_t{greatest} + 1));
  encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), coding.count));
  return encoded;
}

Bytes encoded_vertices(const unsigned char* bytes, const Coding& coding) {
  Bytes encoded(meshopt_encodeVertexBufferBound(coding.count, coding.stride));
  encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), bytes, coding.count, coding.stride));
  return encoded;
}

/// Compresses the views of a document one by one.
class Compressor {
 public:
  Compressor(json& document, const unsigned char* binary) : document_(document), binary_(binary) {}

  /// \return the binary chunk
  std::string compress() {
    const std::map<std::size_t, Coding> codings = codings_of(document_);
    json& views = document_["bufferViews"];
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto coding = codings.find(v);
      if (coding == codings.end() || !try_to_encode(views[v], coding->second)) keep(views[v]);
    }
    json& buffers = document_["buffers"];
    buffers[0]["byteLength"] = kept_.size();
    if (without_bytes_ > 0) {
      buffers.push_back({{"byteLength", without_bytes_}, {"extensions", {{kExtension, {{"fallback", true}}}}}});
      document_["extensionsUsed"].push_back(kExtension);
      document_["extensionsRequired"].push_back(kExtension);
    }
    return std::move(kept_);
  }

 private:
  const unsigned char* bytes_of(const json& view) const { return binary_ + view.value("byteOffset", std::size_t{0}); }

  std::size_t append(const unsigned char* bytes, std::size_t size) {
    kept_.resize(aligned(kept_.size()));
    const std::size_t offset = kept_.size();
    kept_.append(reinterpret_cast<const char*>(bytes), size);
    return offset;
  }

  void keep(json& view) { view["byteOffset"] = append(bytes_of(view), view["byteLength"].get<std::size_t>()); }

  bool try_to_encode(json& view, const Coding& coding) {
    const unsigned char* bytes = bytes_of(view);
    const Bytes encoded = coding.is_indices ? encoded_indices(bytes, coding) : encoded_vertices(bytes, coding);
    if (encoded.empty() || encoded.size() >= coding.count * coding.stride) return false;
    view["extensions"][kExtension] = {{"buffer", 0},
                                      {"byteOffset", append(encoded.data(), encoded.size())},
                                      {"byteLength", encoded.size()},
                                      {"byteStride", coding.stride},
                                      {"mode", coding.is_indices ? "TRIANGLES" : "ATTRIBUTES"},
                                      {"count", coding.count}};
    view["buffer"] = 1;
    view["byteOffset"] = aligned(without_bytes_);
    without_bytes_ = aligned(without_bytes_) + coding.count * coding.stride;
    return true;
  }

  json& document_;
  const unsigned char* binary_;
  std::string kept_;
  std::size_t without_bytes_ = 0;  ///< of the buffer without bytes
};

}  // namespace

std::string with_meshopt_compression(const std::string& glb) {
  const std::size_t text = number_at(glb, kHeader);
  json document = json::parse(glb.substr(kHeader + kChunkHeader, text));
  const std::size_t binary = kHeader + kChunkHeader + text + kChunkHeader;
  const std::string kept = Compressor(document, reinterpret_cast<const unsigned char*>(glb.data()) + binary).compress();
  std::ostringstream compressed;
  write_glb_container(compressed, document.dump(), {reinterpret_cast<const unsigned char*>(kept.data()), kept.size()});
  return std::move(compressed).str();
}

}  // namespace lozenge
