// Where the triangles of a surface come from: kept through repair, splitting and mapping as attributes of its corners,
// which all of that carries on anyway.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/primitive.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// One of the triangles that a surface is made of. Number -1: none, it caps a hole.
using OriginNumber = std::int32_t;

/// The same triangles, each with three vertices of its own, which carry the triangle's number and their place in it;
/// of the attributes only those stay that tell vertices apart.
Primitive with_origins(const Primitive& primitive, OriginNumber first);

/// The corners of a mesh get its own triangles for origins: what stages make of it knows them then.
void be_own_origin(SourceMesh& mesh);

/// Caps come from nowhere, whatever corners around them carry. Nor do they need a material any more: those go.
void forget_caps(SourceMesh& mesh);

/// What the corners of a mesh carry.
class Origins {
 public:
  /// \pre the mesh was made of primitives with origins
  explicit Origins(const SourceMesh& mesh);

  OriginNumber of_triangle(TriangleId t) const;
  /// Weights of the origin's three corners, at a place between corners of the mesh (of one triangle).
  Vec3f weights(std::span<const WeightedElement> corners) const;

 private:
  const AttributeStream* triangles_;
  const AttributeStream* weights_;
};

}  // namespace lozenge
