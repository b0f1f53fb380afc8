// The meshes of a glTF document as surfaces to unwrap, and what their triangles become in the document.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/files/gltf_new_vertices.h"
#include "formats/files/readers/gltf/model.h"
#include "pipeline/unwrap/origins.h"
#include "stages/import/import.h"

namespace lozenge {

struct UnwrappedSurface;

/// The asset, of whatever format, as a glTF document.
/// \throws Error as `open_gltf` and `open_input` do
GltfDocument open_as_gltf(const std::filesystem::path& path, const ImportOptions& options,
                          std::vector<std::string>& notes);

/// A mesh that some node places.
struct PlacedMesh {
  int mesh = -1;
  std::string name;
  double scale = 1;  ///< of lengths, by the largest of its placements
};

/// Each once, in their order.
std::vector<PlacedMesh> placed_meshes(const GltfFile& file);

/// \throws Error(kLimit) where they have more triangles, or take more memory, than the options allow
void require_sensible(const GltfFile& file, const std::vector<PlacedMesh>& meshes, const ImportOptions& options);

/// The triangles of all primitives that are unwrapped, numbered through.
class OriginTable {
 public:
  struct Primitive {
    int mesh = -1;
    int primitive = -1;
    OriginNumber first = 0;
    std::vector<float> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };

  explicit OriginTable(const GltfFile& file) : file_(file) {}

  const GltfFile& file() const { return file_; }
  /// \return its number
  std::size_t add(int mesh, int primitive, const lozenge::Primitive& values);
  const std::vector<Primitive>& primitives() const { return primitives_; }
  /// The number of the primitive that has the triangle.
  std::size_t primitive_of(OriginNumber triangle) const;
  OriginNumber size() const { return size_; }

 private:
  const GltfFile& file_;
  std::vector<Primitive> primitives_;
  OriginNumber size_ = 0;
};

/// One surface of them all, each in its own space but for its scale, repaired as on import; no mesh is welded to
/// another. Empty where none has a triangle with any area.
SourceMesh surface_of_meshes(const GltfFile& file, const std::vector<PlacedMesh>& meshes, const ImportOptions& options,
                             OriginTable& origins, std::vector<std::string>& notes);

/// What the document's primitives become.
struct CutPrimitives {
  std::vector<CutPrimitive> primitives;  ///< [primitive of the origins]
  std::vector<bool> there;               ///< [origin] whether it is part of a surface
};

/// Adds what the primitives of a surface became.
void add_cut_primitives(const UnwrappedSurface& surface, const OriginTable& origins, CutPrimitives& cut);

/// Adds the triangles that aren't part of any surface. One that lies on another, either way round, is cut as that is,
/// and has its texels; of any other all corners are one point of the atlas, that of one of its vertices where another
/// triangle has that. \return how many
std::int64_t add_left_out(const OriginTable& origins, CutPrimitives& cut);

}  // namespace lozenge
