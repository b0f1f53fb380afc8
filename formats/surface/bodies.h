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

namespace lozenge {

/// A place in which a body is seen, at rest.
struct BodyPlace {
  Placement placement = kUnmoved;  ///< from the body's own space to the scene
  std::int32_t node = -1;          ///< of the rig (rig.h), that moves it; -1: it stands still

  bool operator==(const BodyPlace&) const = default;
};

struct Body {
  std::string name;  ///< of the asset's node, skin or mesh
  /// At least one; the surface stands in the first of them. A skin has one, which is kUnmoved: its joints place it.
  std::vector<BodyPlace> places;
  std::int32_t skin = -1;  ///< of the rig, or -1
};

/// The bodies of a surface but the one that stands still, and what of the surface is theirs.
struct Bodies {
  std::vector<Body> bodies;
  /// [material of a mesh, or patch] which of `bodies` it belongs to, or -1; empty where `bodies` is.
  std::vector<std::int32_t> owner;

  bool empty() const { return bodies.empty(); }
  std::int32_t owner_of(std::size_t i) const { return owner.empty() ? -1 : owner[i]; }
  bool has_skin() const;
};

/// From where the surface of a body stands to each of its further places.
std::vector<Placement> copies_of(const Body& body);

/// For what is to hold each copy with triangles of its own.
/// \throws Error(kLimit) where that is more than a file from a stranger should be able to ask memory for
void require_sensible_copies(std::size_t triangles_of_mesh, std::size_t copies);

/// What is wrong with bodies from a file that has `count` materials or patches, in words, or nothing.
std::optional<std::string> find_defect(const Bodies& bodies, std::size_t count);

}  // namespace lozenge
