// meshoptimizer's decoders take any bytes without harm, but trust the sizes that they are told, and assert what the
// extension demands of strides: both are checked here. (EXT_meshopt_compression, "JSON schema updates", "Filters".)
#include "formats/files/readers/gltf/meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "formats/files/readers/gltf/json.h"
#include "formats/files/readers/gltf/range.h"

namespace lozenge {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "EXT_meshopt_compression";

enum class Mode { kAttributes, kTriangles, kIndices };
enum class Filter { kNone, kOctahedral, kQuaternion, kExponential };

/// A compressed view, with what it says of itself.
struct Compressed {
  GltfObject extension;
  ByteRange bytes;
  std::uint64_t count, stride;
  Mode mode;
  Filter filter;

  std::uint64_t size() const { return count * stride; }
};

Mode mode_of(const GltfObject& extension) {
  const std::string mode = extension.text("mode");
  if (mode == "ATTRIBUTES") return Mode::kAttributes;
  if (mode == "TRIANGLES") return Mode::kTriangles;
  if (mode == "INDICES") return Mode::kIndices;
  extension.broken("mode \"" + mode + "\" does not exist");
}

Filter filter_of(const GltfObject& extension) {
  const std::string filter = extension.text("filter");
  if (filter.empty() || filter == "NONE") return Filter::kNone;
  if (filter == "OCTAHEDRAL") return Filter::kOctahedral;
  if (filter == "QUATERNION") return Filter::kQuaternion;
  if (filter == "EXPONENTIAL") return Filter::kExponential;
  extension.broken("filter \"" + filter + "\" does not exist");
}

bool stride_fits(const Compressed& view) {
  if (view.mode != Mode::kAttributes) return view.stride == 2 || view.stride == 4;
  switch (view.filter) {
    case Filter::kOctahedral:
      return view.stride == 4 || view.stride == 8;
    case Filter::kQuaternion:
      return view.stride == 8;
    default:
      return view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0;
  }
}

/// Bytes that the shortest encoding of so many elements has. (A vertex codec's block is at most 256 vertices, and has
/// at least one byte for each byte of a vertex; a triangle has at least a byte, as an index of a sequence has.)
std::uint64_t least_encoded(const Compressed& view) {
  switch (view.mode) {
    case Mode::kTriangles:
      return 1 + view.count / 3 + 16;
    case Mode::kIndices:
      return 1 + view.count + 4;
    default:
      return 1 + (view.count + 255) / 256 * view.stride + view.stride;
  }
}

Compressed compressed_view(const GltfObject& view, const GltfObject& extension, const GltfBytes& buffers) {
  Compressed found{extension,
                   bytes_of_range(extension, buffers),
                   extension.required_whole("count"),
                   extension.required_whole("byteStride", 256),
                   mode_of(extension),
                   filter_of(extension)};
  if (!stride_fits(found)) {
    extension.broken("its mode and filter don't allow a byteStride of " + std::to_string(found.stride));
  }
  if (found.filter != Filter::kNone && found.mode != Mode::kAttributes)
    extension.broken("only ATTRIBUTES have a filter");
  if (found.mode == Mode::kTriangles && found.count % 3 != 0) {
    extension.broken("count is " + std::to_string(found.count) + ", which is not a multiple of 3");
  }
  const std::uint64_t length = view.required_whole("byteLength");
  if (found.count == 0 || length != found.size()) {
    view.broken("byteLength is " + std::to_string(length) + ", but its compressed form holds " +
                std::to_string(found.count) + " elements of " + std::to_string(found.stride) + " bytes");
  }
  if (const auto stride = view.whole("byteStride"); stride && *stride != found.stride) {
    view.broken("byteStride is " + std::to_string(*stride) + ", that of its compressed form " +
                std::to_string(found.stride));
  }
  if (least_encoded(found) > found.bytes.size) {
    extension.broken("its " + std::to_string(found.bytes.size) + " bytes can't hold a count of " +
                     std::to_string(found.count));
  }
  return found;
}

/// \return meshoptimizer's verdict, 0 where all went well
int decode(const Compressed& view, unsigned char* to) {
  switch (view.mode) {
    case Mode::kTriangles:
      return meshopt_decodeIndexBuffer(to, view.count, view.stride, view.bytes.data, view.bytes.size);
    case Mode::kIndices:
      return meshopt_decodeIndexSequence(to, view.count, view.stride, view.bytes.data, view.bytes.size);
    default:
      return meshopt_decodeVertexBuffer(to, view.count, view.stride, view.bytes.data, view.bytes.size);
  }
}

void undo_filter(const Compressed& view, unsigned char* bytes) {
  switch (view.filter) {
    case Filter::kOctahedral:
      return meshopt_decodeFilterOct(bytes, view.count, view.stride);
    case Filter::kQuaternion:
      return meshopt_decodeFilterQuat(bytes, view.count, view.stride);
    case Filter::kExponential:
      return meshopt_decodeFilterExp(bytes, view.count, view.stride);
    case Filter::kNone:
      return;
  }
}

}  // namespace

bool is_meshopt_fallback(const GltfObject& buffer) {
  const auto extension = buffer.extension(kExtension);
  if (!extension) return false;
  const auto fallback = extension->value().find("fallback");
  return fallback != extension->value().end() && fallback->is_boolean() && fallback->get<bool>();
}

void decode_meshopt_views(json& document, GltfBytes& buffers, const std::string& name, MemoryBudget& budget,
                          GltfDefects& defects, Deviations& deviations) {
  const auto views = GltfObject(document, name).list("bufferViews", name + ": ", "buffer view");
  GltfBytes decoded;
  for (std::size_t i = 0; i < views.size(); ++i) {
    try {
      const auto extension = views[i].extension(kExtension);
      if (!extension) continue;
      const Compressed view = compressed_view(views[i], *extension, buffers);
      budget.take(view.size(), views[i].place() + ": decompressing it");
      std::vector<unsigned char> bytes(view.size());
      if (decode(view, bytes.data()) != 0) extension->broken("its bytes are damaged; export the file again");
      undo_filter(view, bytes.data());
      json& target = document["bufferViews"][i];
      target["buffer"] = buffers.size() + decoded.size();
      target["byteOffset"] = 0U;
      target["extensions"].erase(kExtension);
      decoded.push_back(std::move(bytes));
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnusableInput) throw;
      deviations.add(Deviation::kBrokenData, error.what());
      defects.views.emplace(i, error.what());
    }
  }
  for (auto& bytes : decoded) buffers.push_back(std::move(bytes));
}

}  // namespace lozenge
