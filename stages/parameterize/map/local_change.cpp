// What is kept is put back in reverse, so that what was kept twice ends as it was first, and so that the lists of the
// vertices at home, which a vertex joins at the front, come out the same each time.
#include "stages/parameterize/map/local_change.h"

#include <algorithm>

#include "stages/parameterize/map/consistency.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/map_energy.h"

namespace lozenge {

bool LocalChange::open(const Region& region) {
  triangles_around(map_, region.moving, scratch_.triangles, compared_);
  auto found = find_surroundings(map_, region, compared_, scratch_);
  if (!found) return false;
  surroundings_ = std::move(*found);
  for (const VertexId v : region.moving) keep_place(v);
  for (const TriangleId t : compared_) keep_charts(t);
  return true;
}

void LocalChange::keep_around(const std::vector<VertexId>& vertices) {
  triangles_around(map_, vertices, scratch_.triangles, compared_);
  for (const VertexId v : vertices) keep_place(v);
  for (const TriangleId t : compared_) keep_charts(t);
}

void LocalChange::keep_vertex(VertexId v) {
  keep_place(v);
  for_each_outgoing(map_.mesh, v, [&](Halfedge h) { keep_charts(h / 3); });
}

void LocalChange::keep_anchored(DomainVertex n) {
  keep_domain_vertex(n);
  if (map_.anchor[n] >= 0) keep_vertex(map_.anchor[n]);
}

void LocalChange::keep_triangle_and_neighbours(DomainTriangleId t) {
  keep_triangle(t);
  for (int s = 0; s < 3; ++s) {
    if (const DomainSide n = map_.domain.neighbour({t, s}); n.exists()) keep_triangle(n.triangle);
  }
}

void LocalChange::measure_before(std::int32_t faces) { before_ = energy_of(map_, compared_, map_.scale_with(faces)); }

double LocalChange::energy() const { return energy_of(map_, compared_); }

bool LocalChange::is_sound() const {
  return std::all_of(compared_.begin(), compared_.end(),
                     [&](TriangleId t) { return is_consistent(map_, t) && agrees_with_domain(map_, t); });
}

void LocalChange::restore() {
  // Written only where it changed: what doesn't change it may run side by side.
  if (map_.domain_faces != faces_) map_.domain_faces = faces_;
  for (auto t = triangles_.rbegin(); t != triangles_.rend(); ++t) map_.domain.triangles[t->first] = t->second;
  for (auto c = corners_.rbegin(); c != corners_.rend(); ++c) {
    map_.corner_of[c->vertex] = c->corner;
    map_.anchor[c->vertex] = c->anchor;
  }
  for (auto v = vertices_.rbegin(); v != vertices_.rend(); ++v) {
    set_home(map_, v->vertex, v->home, v->at);
    map_.pin[v->vertex] = v->pin;
  }
  for (auto t = charts_.rbegin(); t != charts_.rend(); ++t) {
    for (int c = 0; c < 3; ++c) map_.chart[3 * t->triangle + c] = t->charts[c];
  }
}

void LocalChange::take_back() {
  restore();
  forget();
}

void LocalChange::forget() {
  faces_ = map_.domain_faces;
  triangles_.clear();
  corners_.clear();
  vertices_.clear();
  charts_.clear();
}

}  // namespace lozenge
