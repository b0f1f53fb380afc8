// Triangles of many primitives joined into one surface by welding corners of exactly equal positions (and sheets, where
// the file is one of ours and has them).
#pragma once

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <string>
#include <vector>

#include "formats/surface/attribute.h"
#include "formats/surface/primitive.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

struct WeldedSurface {
  SourceMesh mesh;  ///< canonical; without names
  /// [vertex of the primitives, in the order in which they were added] the welded vertex, or -1 where no triangle uses
  /// it.
  std::vector<VertexId> vertex_of;
  std::int64_t dropped_triangles = 0;    ///< whose three corners aren't three vertices
  std::vector<Vec3f> dropped_at;         ///< places of the first of them
  std::int64_t repaired_attributes = 0;  ///< values of attributes that weren't finite or in range
};

/// Collects primitives, then welds them all. Attributes are kept for each vertex of the primitives until the end, when
/// they go to the corners.
class SurfaceBuilder {
 public:
  /// Takes the memory for all that will be added at once.
  void reserve(std::size_t vertices, std::size_t triangles);

  /// Where a primitive goes.
  struct Target {
    /// For row vectors; one that mirrors turns the triangles, so that they still face outward.
    Imath::M44d transform;
    /// [joint] instead of `transform`, where a skin places it: what the joints do to its vertices (`blended`).
    const std::vector<Imath::M44d>* joints = nullptr;
    std::int32_t body = -1;  ///< vertices of different bodies are never joined
  };

  /// \param place  how messages call the primitive
  /// \throws Error(kUnusableInput) where a transformed position isn't finite, or there are joints but no stream of them
  void add(Primitive primitive, const Target& target, const std::string& place);

  std::int64_t triangle_count() const { return static_cast<std::int64_t>(triangles_.size()); }

  // Primitives go by their number in the order in which they were added.

  /// [group] whether a triangle of it has a corner where one of another group, but of the same body, has one, too.
  /// \param group  [primitive] any number of 0..count - 1
  std::vector<bool> find_contacts(const std::vector<std::int32_t>& group, std::int32_t count) const;

  /// Takes a primitive's triangles out again.
  void leave_out(std::size_t primitive) { primitives_[primitive].left_out = true; }

  /// Gives all of them a material.
  void set_material(std::size_t primitive, std::int32_t material);

  /// The surface of all primitives; the builder is empty afterwards. Where there are materials, triangles without one
  /// get a further one called "default".
  WeldedSurface finish(std::vector<std::string> material_names);

 private:
  /// Where the triangles of a primitive begin; they end where the next one's do.
  struct AddedPrimitive {
    std::size_t first_triangle = 0;
    std::size_t first_vertex = 0;
    std::int32_t body = -1;
    bool left_out = false;
  };
  std::size_t end_of(std::size_t primitive) const {
    return primitive + 1 < primitives_.size() ? primitives_[primitive + 1].first_triangle : triangles_.size();
  }
  void remove_left_out();
  void add_positions(const Primitive& primitive, const Target& target, const std::string& place);
  void add_attributes(AttributeStreams& given, std::size_t vertices, const Target& target);
  /// [vertex] a number that vertices share which are at one place of one body.
  /// \param by_attributes  whether attributes that tell vertices apart do so
  std::vector<unsigned int> weld(bool by_attributes) const;
  /// Vertices at one place that follow different joints, or that a morph target parts, stay apart.
  void part_what_moves_apart(std::vector<unsigned int>& welded) const;
  void add_triangles(const Primitive& primitive, std::uint32_t first_vertex, bool mirrored);

  std::vector<Vec3f> positions_;  ///< [vertex of the primitives]
  AttributeStreams attributes_;   ///< the same, of those that any primitive had
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::int32_t> materials_;  ///< [triangle], -1 for none
  std::vector<AddedPrimitive> primitives_;
  /// [vertex] where it was before a skin placed it: what is welded, for afterwards rounding may tell equal positions
  /// apart; empty where there is no skin.
  std::vector<Vec3f> unposed_;
  std::int64_t repaired_ = 0;
};

}  // namespace lozenge
