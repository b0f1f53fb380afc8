// What vertices that a skin or morph targets move need before they are welded.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/surface/attribute.h"

namespace lozenge {

/// Takes joints that aren't there out of elements of `kInfluences`, and makes the weights of the others 1 together; an
/// element of which nothing is left belongs to joint 0. \return how many were changed
std::int64_t repair_influences(std::vector<float>& values, std::size_t joints);

/// Whether two vertices at one place move alike, so that they may be joined: their weights differ by what exporters
/// round or artists smooth over, not by whom they follow (elements of `kInfluences`), and no morph target parts them.
class MovesAlike {
 public:
  /// Keeps a reference to the attributes of vertices.
  explicit MovesAlike(const AttributeStreams& vertices);

  /// Whether nothing tells any apart.
  bool always() const { return influences_ == nullptr && offsets_.empty(); }
  bool operator()(std::size_t a, std::size_t b) const;

 private:
  struct Offsets {
    const AttributeStream* stream;
    double most_apart;  ///< squared
  };

  const AttributeStream* influences_;
  std::vector<Offsets> offsets_;
};

/// Gives all vertices that are one the offsets of morph targets that the first of them has, so that nothing opens
/// between them.
/// \param welded  [vertex] a number that those have in common
void share_offsets(const std::vector<unsigned int>& welded, AttributeStreams& vertices);

}  // namespace lozenge
