// Bodies: what moves as one. All that stands still is one body, the others are listed: each skin, each node that moves,
// and each mesh that is placed more than once, whose surface is parameterized, sampled and baked once.
//
// The surface of all bodies stands in the scene as the asset's rest pose has it, so that lengths, areas and distances
// are those that one sees. A body says how to get from there to its own space, in which an exported asset has its mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/surface/placement.h"
#include "formats/surface/rig.h"

namespace lozenge {

/// A place in which a body is seen, at rest.
struct BodyPlace {
  Placement placement = kUnmoved;  ///< from the body's own space to the scene
  std::int32_t node = -1;          ///< of the rig (rig.h), that moves it; -1: it stands still

  bool operator==(const BodyPlace&) const = default;
};

/// A shape that a body can take on, as far as a weight says: its surface is shown with all offsets, each times the
/// weight of its target. What they are is an attribute of the surface (`kMorphOffsets`).
struct MorphTarget {
  std::string name;   ///< or nothing
  double weight = 0;  ///< where nothing animates it

  bool operator==(const MorphTarget&) const = default;
};

struct Body {
  std::string name;  ///< of the asset's node, skin or mesh
  /// At least one; the surface stands in the first of them. A skin has one, which is kUnmoved, for its joints place it;
  /// if it has a node, then only as what weights of morph targets are animated at.
  std::vector<BodyPlace> places;
  std::int32_t skin = -1;  ///< of the rig, or -1
  /// The surface stands as if all weights were 0. A body that has any has one place.
  std::vector<MorphTarget> targets = {};
};

/// The bodies of a surface but the one that stands still, and what of the surface is theirs.
struct Bodies {
  std::vector<Body> bodies;
  /// [material of a mesh, or patch] which of `bodies` it belongs to, or -1; empty where `bodies` is.
  std::vector<std::int32_t> owner;

  bool empty() const { return bodies.empty(); }
  std::int32_t owner_of(std::size_t i) const { return owner.empty() ? -1 : owner[i]; }
  bool has_skin() const;
  bool has_targets() const;
};

/// From where the surface of a body stands to each of its further places.
std::vector<Placement> copies_of(const Body& body);

/// For what is to hold each copy with triangles of its own.
/// \throws Error(kLimit) where that is more than a file from a stranger should be able to ask memory for
void require_sensible_copies(std::size_t triangles_of_mesh, std::size_t copies);

/// Whether each node of a rig whose weights are animated shows a body of so many morph targets, and all nodes and skins
/// of bodies are there.
bool fit(const Bodies& bodies, const Rig& rig);

/// What is wrong with bodies from a file that has `count` materials or patches, in words, or nothing.
std::optional<std::string> find_defect(const Bodies& bodies, std::size_t count);

}  // namespace lozenge
