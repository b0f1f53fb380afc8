// The map is linear on a source triangle, so triangles must be small beside the domain's: edges are split until they
// are.
#include "stages/parameterize/subject.h"

#include <cmath>
#include <utility>

#include "formats/surface/canonical_form.h"
#include "stages/parameterize/levels/split_long_edges.h"
#include "stages/parameterize/levels/unsplit.h"
#include "stages/parameterize/map/curve_order.h"
#include "stages/parameterize/map/plane_motion.h"

namespace lozenge {

namespace {

/// What splitting its edges may make of a mesh. Triangles about as wide as high take 2 / longest_edge^2 for each of the
/// domain's, halving makes up to 4 times as many of that, and odd ones some more; a needle, a thousand times as long
/// as a domain triangle or more, would take millions.
std::int64_t most_triangles(const SourceMesh& mesh, const FaceRange& faces, double longest_edge) {
  constexpr double kOfDomainTriangle = 16;
  constexpr double kOfTriangle = 30;
  return std::llround(kOfDomainTriangle / (longest_edge * longest_edge) * faces.most +
                      kOfTriangle * static_cast<double>(mesh.triangles.size()));
}

}  // namespace

void number_along_curve(Subject& subject) {
  constexpr std::size_t kLeast = 100'000;  // triangles: what is shorter fits into a cache
  if (subject.mesh.triangles.size() < kLeast) return;
  const std::vector<VertexId> number = make_canonical(subject.mesh, triangles_along_curve(subject.mesh));
  for (VertexId& cone : subject.cones) cone = number[cone];
}

void make_fine_enough(Subject& subject, const FaceRange& faces, double longest_edge) {
  std::vector<VertexId> number_of;
  const SourceMesh& mesh = subject.mesh;
  const double area = surface_area(mesh.positions, mesh.triangles);
  const double longest = longest_edge * std::sqrt(area / (faces.most * 0.5 * kHalfRoot3));
  const bool is_long = longest > 0 && has_longer_edge(mesh, longest);
  if (is_long || has_chord(subject.halfedges)) number_triangles(subject.mesh);
  if (is_long) {
    SourceMesh split = split_long_edges(mesh, longest, most_triangles(mesh, faces, longest_edge), &number_of);
    subject.become(std::move(split), number_of);
  }
  if (has_chord(subject.halfedges)) subject.become(split_chords(mesh, &number_of), number_of);
}

}  // namespace lozenge
