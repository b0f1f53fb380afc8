// What is left is numbered anew, in the order that it had, and the numbers in the whole are kept for the way back.
#include "stages/parameterize/levels/proxy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/parameterize/map/homes.h"

namespace lozenge {

double enough_triangles(double faces) {
  constexpr double kMany = 200;
  return faces > kMany ? std::sqrt(kMany / faces) : 1;
}

double ProxySize::triangles_for(double faces) const {
  return std::max(least, triangles_per_face * faces * enough_triangles(faces));
}

Proxy extract_proxy(const HalfedgeMesh& simplified, const std::vector<Vec3f>& positions) {
  Proxy proxy;
  std::vector<VertexId> number(positions.size(), -1);
  for (VertexId v = 0; v < simplified.vertex_count(); ++v) {
    if (simplified.outgoing[v] < 0) continue;
    number[v] = static_cast<VertexId>(proxy.vertices.size());
    proxy.vertices.push_back(v);
    proxy.positions.push_back(positions[v]);
  }
  std::vector<TriangleId> triangle_number(simplified.triangles.size(), -1);
  for (TriangleId t = 0; t < simplified.triangle_count(); ++t) {
    if (simplified.removed(t)) continue;
    triangle_number[t] = static_cast<TriangleId>(proxy.triangles.size());
    proxy.triangles.push_back(t);
  }
  const auto renumbered = [&](Halfedge h) { return h < 0 ? -1 : 3 * triangle_number[h / 3] + h % 3; };
  for (const TriangleId t : proxy.triangles) {
    const auto& c = simplified.triangles[t];
    proxy.mesh.triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
    for (int s = 0; s < 3; ++s) proxy.mesh.twins.push_back(renumbered(simplified.twins[3 * t + s]));
  }
  for (const VertexId v : proxy.vertices) proxy.mesh.outgoing.push_back(renumbered(simplified.outgoing[v]));
  return proxy;
}

void write_back(const Proxy& proxy, HalfedgeMesh& simplified) {
  for (std::size_t t = 0; t < proxy.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const VertexId v = proxy.mesh.triangles[t][c];
      simplified.triangles[proxy.triangles[t]][c] = v < 0 ? -1 : proxy.vertices[v];
      simplified.twins[3 * proxy.triangles[t] + c] = proxy.in_whole(proxy.mesh.twins[3 * t + c]);
    }
  }
  for (std::size_t v = 0; v < proxy.vertices.size(); ++v) {
    simplified.outgoing[proxy.vertices[v]] = proxy.in_whole(proxy.mesh.outgoing[v]);
  }
}

WorkingMap map_of_simplified(const WorkingMap& map, const Proxy& proxy, HalfedgeMesh simplified,
                             const std::vector<Vec3f>& positions) {
  WorkingMap whole;
  whole.positions = &positions;
  whole.mesh = std::move(simplified);
  whole.settings() = map.settings();
  whole.abstract_domain() = map.abstract_domain();
  put_vertices_nowhere(whole);
  whole.chart.resize(whole.mesh.twins.size());
  for (std::size_t v = 0; v < proxy.vertices.size(); ++v) {
    whole.take_vertex(proxy.vertices[v], map, static_cast<VertexId>(v));
  }
  for (std::size_t t = 0; t < proxy.triangles.size(); ++t) {
    whole.take_triangle(proxy.triangles[t], map, static_cast<TriangleId>(t));
  }
  for (VertexId& v : whole.anchor) {
    if (v >= 0) v = proxy.vertices[v];
  }
  measure_rest_shapes(whole);
  list_homes(whole);
  return whole;
}

}  // namespace lozenge
