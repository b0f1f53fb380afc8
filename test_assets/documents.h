// The glTF documents of the test assets.
#pragma once

#include <filesystem>
#include <string>

#include "test_assets/gltf_writer.h"
#include "test_assets/shape.h"

namespace lozenge::test_assets {

/// One node with one mesh of one primitive, with smooth normals where `normals` is set.
Document simple_document(const std::string& name, const Shape& shape, bool normals);

/// A ball that a node takes to coordinates as surveys have them.
Document far_document();

/// A ring and a ball in its hole, in two nodes that share no transform.
Document two_components_document();

/// A ball, and a ring that is placed six times around it: as it is, moved, turned, grown, mirrored, and sheared by the
/// scale of a turned node's parent.
Document rings_document();

/// A ring made of one half and its mirror image, each of two primitives cut along UV seams, under a turned, scaled and
/// moved parent; and a ball with a matrix of its own. Where nodes and primitives meet, every number is a short binary
/// fraction, so that the transformed positions are equal bit by bit.
Document seams_document();

/// The same surface with textures of all kinds: tiled, mirrored, moved by KHR_texture_transform, of a second set of
/// texture coordinates; and two more balls, one with holes by its alpha (MASK, seen from both sides), and one of glass
/// (BLEND).
Encoded textured();

/// Three balls with textures of extensions: clearcoat with its roughness and normals, sheen that is moved by
/// KHR_texture_transform, and anisotropy without a texture; and specular that is the same everywhere.
Encoded coated();

/// A unit ball with one seam from pole to pole, and a vertex of its own for every triangle at a pole.
Primitive globe(int columns, int rows, std::int32_t material);

/// A cube with hard edges: every face has quads x quads quads over vertices and normals of its own. Faces meet bit by
/// bit where `quads` is a power of two.
Document cube_document(int quads);

/// A worm that three bones bend, modelled in centimetres along z, whose armature makes it two metres high along y; a
/// ball on its last bone, and one that stands beside it. An animation bends the second bone.
Document worm_document();

/// A cart that rolls: its wheels, one the other's mirror image, turn by themselves, its seat goes along, and stands
/// where it is scaled unevenly. The ball beside it has an animation that never leaves its rest.
Document cart_document();

/// A ball with morph targets in sparse accessors: "grin" pulls its upper half up, "idle" does nothing, "wink" presses a
/// place in and says nothing of normals. It hangs below a node of its own scale; an animation moves all three weights.
Document face_document();

/// Three worms as packers leave them and as rigs come out of converters: one as `worm_document` has it, but in whole
/// numbers, which its inverse bind matrices take back; one of another skin over the same joints; none of whose joints
/// are in the scene; one bone is scaled unevenly, and vertices at the tail have no weights at all. The third one has no
/// joint in common with the others.
Document packed_worms_document();

/// One primitive of a shape. \param normals  whether it has smooth ones
Primitive primitive_of(const Shape& shape, bool normals);

/// Writes every file of `kBadAssets` below `folder`.
void write_bad_assets(const std::filesystem::path& folder);

}  // namespace lozenge::test_assets
