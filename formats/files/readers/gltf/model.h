// glTF files read through tinygltf, with everything checked that tinygltf takes on trust.
//
// tinygltf's Model is only declared here; who looks inside includes <tiny_gltf.h> in a .cpp (and never defines
// TINYGLTF_IMPLEMENTATION: readers/gltf/tinygltf.cpp does, for all).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "formats/files/readers/deviations.h"
#include "formats/files/readers/input_limits.h"

namespace tinygltf {
class Model;
}

namespace lozenge {

/// An open glTF asset. Buffers are in memory. Images aren't decoded: their bytes are those of their buffer view, or in
/// tinygltf::Image::image where they came in a data URI; image files are left alone (images.h).
struct GltfFile {
  std::string name;              ///< the file's name without its folder: how messages start
  std::filesystem::path folder;  ///< that files which it names are in
  std::unique_ptr<tinygltf::Model> model;
  std::uint64_t memory = 0;  ///< estimated bytes that it takes

  GltfFile();
  GltfFile(GltfFile&&) noexcept;
  GltfFile& operator=(GltfFile&&) noexcept;
  ~GltfFile();
};

/// The same, and the JSON that it was read from: what is decompressed is so there, too.
struct GltfDocument {
  GltfFile file;
  std::unique_ptr<nlohmann::json> json;

  GltfDocument();
  GltfDocument(GltfDocument&&) noexcept;
  GltfDocument& operator=(GltfDocument&&) noexcept;
  ~GltfDocument();
};

/// Reads a .glb (known by its magic, not its name) or .gltf with its buffers: embedded, data URIs, or files in the
/// asset's folder or below it. Afterwards every index from one object to another exists, buffer views lie inside their
/// buffers, accessors inside their views, and nodes form trees. What is compressed is
/// decompressed.
/// \param deviations  gets what isn't as the specification says, and is mended or left out; where null, a file that
///                    deviates is refused
/// \throws Error(kUnusableInput) where a file is missing, truncated or inconsistent; Error(kUnsupported) where it
///         requires an extension that we don't know; Error(kLimit) where it is larger than `limits`
GltfFile open_gltf(const std::filesystem::path& path, const InputLimits& limits = {}, Deviations* deviations = nullptr);
GltfDocument open_gltf_document(const std::filesystem::path& path, const InputLimits& limits = {},
                                Deviations* deviations = nullptr);

/// A document that isn't in a file. \param buffers  [buffer of the document] its bytes
/// \pre it holds together
GltfDocument make_gltf_document(nlohmann::json json, std::vector<std::vector<unsigned char>> buffers,
                                const std::string& name);

}  // namespace lozenge
