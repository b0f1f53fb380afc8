// What was wrong with a surface and has been mended: counted, with places to look at.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// In the order in which they are made.
enum class RepairKind : std::uint8_t {
  kDegenerateTriangles,  ///< left out: two of their corners are one vertex
  kTJunctions,           ///< vertices on an edge of another triangle, which became a corner there
  kDuplicateTriangles,   ///< left out: another triangle has the same three vertices, the same way round
  kTwoSidedTriangles,    ///< left out: the other way round on another one, which is to be seen from both sides since
  kLayers,               ///< the other way round on another one that looks otherwise: got vertices of their own
  kFlatTriangles,        ///< left out: without area, and not needed to close anything
  kTurnedTriangles,      ///< turned over, to agree with their neighbours on the outside
  kCutEdges,             ///< of a one-sided surface, whose triangles can't all agree
  kCrowdedEdges,         ///< of three or more triangles, parted into sheets of one or two
  kBowTieVertices,       ///< where fans of triangles met in nothing but a point; parted
  kDividedEdges,         ///< got a vertex in their middle, because another edge has the same two ends
  kFilledHoles,          ///< boundary loops that got a cap
};
inline constexpr std::size_t kRepairKinds = 12;

struct Repair {
  std::int64_t count = 0;
  std::vector<Vec3f> where;  ///< a position of each of the first few
};

/// How many places of each kind are kept.
inline constexpr std::size_t kMostPlaces = 5;

class RepairReport {
 public:
  /// One more of a kind.
  void add(RepairKind kind, const Vec3f& where);
  /// Many of a kind, and places of the first of them.
  void add(RepairKind kind, std::int64_t count, const std::vector<Vec3f>& where);

  const Repair& operator[](RepairKind kind) const { return repairs_[static_cast<std::size_t>(kind)]; }
  bool none() const;

 private:
  std::array<Repair, kRepairKinds> repairs_;
};

/// Its key in JSON: "duplicate_triangles".
std::string_view key_of(RepairKind kind);

/// "3 duplicate triangles left out, the first at (0, 1, 2)", and so on: one for each kind that there is.
std::vector<std::string> repair_lines(const RepairReport& report);

}  // namespace lozenge
