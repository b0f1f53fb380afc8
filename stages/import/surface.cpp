// The half-edges are linked first (surface_facts.h); what breaks the surface then shows as half-edges without a twin,
// and at vertices as corners that turning around them doesn't reach.
#include "stages/import/surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "stages/import/fans.h"

namespace lozenge {

namespace {

std::string position_of(const SourceMesh& mesh, VertexId v) {
  const Vec3f& p = mesh.positions[v];
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.7g, %.7g, %.7g)", static_cast<double>(p.x), static_cast<double>(p.y),
                static_cast<double>(p.z));
  return text.data();
}

std::string edge_of(const SourceMesh& mesh, HalfEdge h) {
  return "from " + position_of(mesh, half_edge_start(mesh, h)) + " to " + position_of(mesh, half_edge_end(mesh, h));
}

/// Half-edges whose twin is missing in a certain way.
struct Marked {
  std::int64_t count = 0;
  HalfEdge first = -1;
};

template <typename Predicate>
Marked find_marked(const std::vector<HalfEdge>& twins, Predicate is_marked) {
  Marked marked;
  for (std::size_t h = 0; h < twins.size(); ++h) {
    if (!is_marked(twins[h])) continue;
    if (marked.count++ == 0) marked.first = static_cast<HalfEdge>(h);
  }
  return marked;
}

enum class Turn : std::uint8_t { kUnseen, kKept, kTurned };

/// Spreads the decision on triangle `seed` over its component. \return false where two ways to a triangle contradict
/// each other
bool spread_turns(const std::vector<HalfEdge>& twins, TriangleId seed, std::vector<Turn>& turns) {
  turns[seed] = Turn::kKept;
  std::vector<TriangleId> open{seed};
  while (!open.empty()) {
    const TriangleId t = open.back();
    open.pop_back();
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const bool agrees = !is_same_direction_twin(twins[h]);
      const HalfEdge other = agrees ? twins[h] : same_direction_twin(twins[h]);
      if (other < 0) continue;
      const Turn wanted = agrees == (turns[t] == Turn::kKept) ? Turn::kKept : Turn::kTurned;
      Turn& found = turns[other / 3];
      if (found == Turn::kUnseen) open.push_back(other / 3);
      if (found == Turn::kUnseen) found = wanted;
      if (found != wanted) return false;
    }
  }
  return true;
}

/// Whether turning some triangles over would make all neighbours agree, seen across edges of two triangles. False for a
/// Moebius strip.
bool is_orientable(const std::vector<HalfEdge>& twins) {
  std::vector<Turn> turns(twins.size() / 3, Turn::kUnseen);
  for (std::size_t t = 0; t < turns.size(); ++t) {
    if (turns[t] == Turn::kUnseen && !spread_turns(twins, static_cast<TriangleId>(t), turns)) return false;
  }
  return true;
}

/// A vertex whose triangles form more than one fan, and how many there are.
struct BowTies {
  std::int64_t count = 0;
  VertexId first = -1;
};

/// Whether the fan of any one of a vertex's corners holds all of its corners, for every vertex.
bool have_one_fan_each(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  std::vector<HalfEdge> leaving(mesh.positions.size(), -1);
  for (std::size_t h = 0; h < twins.size(); ++h) {
    leaving[half_edge_start(mesh, static_cast<HalfEdge>(h))] = static_cast<HalfEdge>(h);
  }
  const std::size_t corners = sum_of_parts(leaving.size(), [&](std::size_t begin, std::size_t end) {
    std::size_t sum = 0;
    for (std::size_t v = begin; v < end; ++v) sum += leaving[v] >= 0 ? count_fan(twins, leaving[v]) : 0;
    return sum;
  });
  return corners == twins.size();
}

/// \pre half-edges have twins that run the other way, or none
BowTies find_bow_ties(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  if (have_one_fan_each(mesh, twins)) return {};
  std::vector<unsigned char> fans(mesh.positions.size(), 0);
  BowTies found;
  for (const VertexId v : find_fans(mesh, twins).vertices) {
    if (fans[v] < 2 && ++fans[v] == 2 && found.count++ == 0) found.first = v;
  }
  return found;
}

std::string number(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// Each of these tells in words what is wrong, where, how often, and what to do; nothing where all is well.

std::optional<std::string> crowded_edges(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  const Marked marked = find_marked(twins, [](HalfEdge twin) { return twin == kCrowdedTwin; });
  if (marked.count == 0) return std::nullopt;
  return "three or more triangles share an edge, " + edge_of(mesh, marked.first) + " (" +
         number(marked.count, "triangle side", "triangle sides") +
         " lie on such edges); remove inner walls and duplicate faces";
}

std::optional<std::string> disagreement(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  const Marked marked = find_marked(twins, is_same_direction_twin);
  if (marked.count == 0) return std::nullopt;
  const std::string where = edge_of(mesh, marked.first);
  if (!is_orientable(twins)) {
    return "it is one-sided, like a Moebius strip: its triangles can't be turned so that all agree on the outside, as "
           "at the "
           "edge " +
           where + "; give it thickness, or cut it";
  }
  return "two triangles disagree on which side is outside at the edge " + where + " (" +
         number(marked.count / 2, "such edge", "such edges") +
         "); make the face orientation consistent (\"recalculate normals\")";
}

std::optional<std::string> bow_tie(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  const BowTies ties = find_bow_ties(mesh, twins);
  if (ties.count == 0) return std::nullopt;
  return "parts of it touch in a single vertex at " + position_of(mesh, ties.first) + " (" +
         number(ties.count, "such vertex", "such vertices") +
         "); move the parts apart there, or join them along an edge";
}

}  // namespace

bool is_manifold(const SourceMesh& mesh, const HalfEdgeLinks& links) {
  const bool linked =
      std::all_of(links.twins.begin(), links.twins.end(), [](HalfEdge twin) { return twin >= kNoTwin; });
  return linked && find_bow_ties(mesh, links.twins).count == 0;
}

SurfaceFacts require_manifold(const SourceMesh& mesh, const std::string& file) {
  if (mesh.triangles.empty()) throw Error(ExitCode::kUnusableInput, file + ": has no triangles");
  const HalfEdgeLinks links = link_half_edges(mesh);
  // In this order: the last asks what the earlier ones rule out.
  for (const auto& find : {crowded_edges, disagreement, bow_tie}) {
    if (const auto defect = find(mesh, links.twins)) {
      throw Error(ExitCode::kUnsupported, file + ": is not an oriented surface: " + *defect);
    }
  }
  return surface_facts(mesh, links);
}

}  // namespace lozenge
