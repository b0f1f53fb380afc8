#include "stages/parameterize/map/checkpoint.h"

#include "stages/parameterize/map/homes.h"

namespace lozenge {

void Checkpoint::restore() {
  // In reverse, so that what was kept twice ends as it was first.
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

}  // namespace lozenge
