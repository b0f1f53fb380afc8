#include "formats/files/readers/gltf/buffers.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <limits>

#include "formats/files/readers/gltf/json.h"
#include "formats/files/readers/gltf/meshopt.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

constexpr std::string_view kBase64 = ";base64,";

[[noreturn]] void broken(const std::string& what, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, what + ": " + problem);
}

/// Long URIs (data) make no readable message.
std::string shown(const std::string& uri) { return uri.size() <= 100 ? uri : uri.substr(0, 100) + "..."; }

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
    text.push_back(escape ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i]);
    if (escape) i += 2;
  }
  return text;
}

Bytes bytes_of_data_uri(const std::string& uri, const std::string& what) {
  if (uri.find(kBase64) == std::string::npos) broken(what, "its data URI is not in base64");
  if (uri.size() > std::numeric_limits<int>::max())
    broken(what, "its data URI is longer than 2 GB; store it as a file");
  return decode_data_uri(uri);
}

/// Whether the file that `path` leads to, all symbolic links followed, lies in `folder` or below it. What doesn't exist
/// is somebody else's complaint.
bool stays_inside(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error);
  const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error) return true;
  return std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
}

Bytes take_binary(GltfContainer& container, const std::string& what) {
  if (!container.has_binary) broken(what, "has no uri, and the file has no binary chunk");
  container.has_binary = false;
  return std::move(container.binary);
}

/// \return at most `length` bytes
Bytes bytes_of_buffer(const GltfObject& buffer, bool is_first, std::uint64_t length, GltfContainer& container,
                      const fs::path& folder) {
  if (!buffer.has("uri")) {
    if (!is_first) buffer.broken("has no uri; only buffer 0 can be in the binary chunk");
    return take_binary(container, buffer.place());
  }
  const std::string uri = buffer.text("uri");
  if (uri.starts_with("data:")) return bytes_of_data_uri(uri, buffer.place());
  const fs::path path = resolve_gltf_uri(uri, folder, buffer.place());
  return read_file_start(path, length, buffer.place() + " (" + shown(uri) + ")");
}

/// How messages call where its bytes are.
std::string holder_of(const GltfObject& buffer) {
  if (!buffer.has("uri")) return "the binary chunk";
  const std::string uri = buffer.text("uri");
  return uri.starts_with("data:") ? "its data URI" : "the file " + shown(uri);
}

}  // namespace

Bytes decode_data_uri(const std::string& uri) {
  const std::size_t at = uri.find(kBase64);
  if (at == std::string::npos || uri.size() > std::numeric_limits<int>::max()) return {};
  // tinygltf knows a few media types only; what the bytes are called doesn't matter.
  std::string media_type;
  Bytes bytes;
  tinygltf::DecodeDataURI(&bytes, media_type, "data:application/octet-stream;base64," + uri.substr(at + kBase64.size()),
                          0, false);
  return bytes;
}

fs::path resolve_gltf_uri(const std::string& uri, const fs::path& folder, const std::string& what) {
  const std::string text = percent_decoded(uri);
  const std::size_t colon = text.find(':');
  const bool scheme = colon != std::string::npos && colon < text.find('/');
  if (text.empty() || scheme || text.find('\\') != std::string::npos || text.find('\0') != std::string::npos) {
    broken(what, "its uri \"" + shown(uri) + "\" is not a relative path; put the file into the asset's folder");
  }
  const fs::path relative(text);
  const bool climbs = std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
  if (relative.is_absolute() || climbs) {
    broken(what, "its uri \"" + shown(uri) + "\" leaves the asset's folder; put the file there");
  }
  if (!stays_inside(folder / relative, folder)) {
    broken(what, "its uri \"" + shown(uri) + "\" is a link that leaves the asset's folder; put the file there");
  }
  return folder / relative;
}

GltfBytes load_gltf_buffers(const nlohmann::json& document, GltfContainer& container, const fs::path& folder,
                            const std::string& name, MemoryBudget& budget, GltfDefects& defects,
                            Deviations& deviations) {
  GltfBytes buffers;
  for (const GltfObject& buffer : GltfObject(document, name).list("buffers", name + ": ", "buffer")) {
    Bytes& bytes = buffers.emplace_back();
    try {
      const std::uint64_t length = buffer.required_whole("byteLength");
      if (length == 0) buffer.broken("byteLength is 0");
      if (is_meshopt_fallback(buffer)) continue;
      budget.take(length, buffer.place() + ": reading it");
      bytes = bytes_of_buffer(buffer, buffers.size() == 1, length, container, folder);
      if (bytes.size() < length) {
        buffer.broken("byteLength is " + std::to_string(length) + ", but " + holder_of(buffer) + " has " +
                      std::to_string(bytes.size()) + " bytes");
      }
      bytes.resize(length);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnusableInput) throw;
      deviations.add(Deviation::kShortBuffer, error.what());
      defects.buffers.emplace(buffers.size() - 1, error.what());
    }
  }
  return buffers;
}

}  // namespace lozenge
