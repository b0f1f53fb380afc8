// The outermost layer of a glTF asset: the JSON text and the binary chunk, from .glb or .gltf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/memory_budget.h"

namespace lozenge {

struct GltfContainer {
  std::string json;
  std::vector<unsigned char> binary;  ///< the BIN chunk
  bool has_binary = false;
};

/// Reads a file, as GLB where it starts with the magic "glTF", else as text.
/// \param name  how messages call the file
/// \throws Error(kUnusableInput) where it's missing, empty or truncated, or neither GLB nor JSON;
///         Error(kUnsupported) where the GLB is of another version than 2; Error(kLimit) where its JSON is too long
///         (the binary chunk is the business of who reads the buffers)
GltfContainer read_gltf_container(const std::filesystem::path& path, const std::string& name, MemoryBudget& budget);

/// The first bytes of a file, at most so many.
/// \param what  how messages call it: "statue.gltf: buffer 0 (statue.bin)"
/// \throws Error(kUnusableInput) where there is no such file, or it can't be read
std::vector<unsigned char> read_file_start(const std::filesystem::path& path, std::uint64_t most,
                                           const std::string& what);

}  // namespace lozenge
