#include "stages/export/quadric_metric.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/surface/attribute.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {
namespace {

/// Weight of the distance to the points of the source that a vertex stands for, against that to their planes: where
/// the surface is flat it keeps vertices in the middle of what is theirs, and where it isn't it hardly counts.
constexpr double kPointWeight = 1e-3;

/// Weight of lines that must stay (the surface's end, borders of groups), by their squared lengths.
constexpr double kLineWeight = 4;

/// Weight of the way that what the atlas shows slips on the surface, where a patch loses a part of its square, by the
/// area around.
constexpr double kSlipWeight = 0.003;

/// How much more such slips cost that bring out what is hidden, by the square of how much less of it is seen: maps are
/// black there, or hold anything.
constexpr double kBaredWeight = 200;

/// Weight of the way between a vertex and the point of the source that the atlas shows there, by the area around: what
/// has a direction of its own on a flat surface, as letters have, wavers by as much as vertices slide from theirs.
constexpr double kSlideWeight = 0.008;

/// How far joints are taken to move what they hold away from what other ones hold, by the diagonal of the surface: a
/// vertex that takes over another's joints is off by that much in some pose.
constexpr double kJointReach = 0.1;

}  // namespace

QuadricMetric::QuadricMetric(const CollapsibleMesh& mesh, const std::vector<float>& importance,
                             const std::vector<OutlineEdge>& outline)
    : mesh_(mesh),
      quadrics_(mesh.vertex_count()),
      anchors_(mesh.positions()),
      areas_(mesh.vertex_count(), 0.0),
      plain_areas_(mesh.vertex_count(), 0.0),
      joint_reach_(kJointReach * diagonal(bounds_of(std::vector<Vec3f>(anchors_.begin(), anchors_.end())))) {
  add_planes(importance);
  add_outline(outline);
  add_walls();
}

void QuadricMetric::add_planes(const std::vector<float>& importance) {
  for (std::size_t i = 0; i < mesh_.triangles().size(); ++i) {
    const ChartedTriangle& t = mesh_.triangles()[i];
    const std::array<Vec3d, 3> p = mesh_.corners_of(t);
    const Vec3d normal = cross_of(p);
    double area = normal.length() / 2;
    if (!(area > 0)) continue;
    const Vec3d unit = normal / (2 * area);
    for (const ChartedCorner& c : t.corners) plain_areas_[c.vertex] += area / 3;
    if (!importance.empty()) area *= importance[i];
    Quadric plane;
    plane.add_plane(unit, p[0], area / 3);
    for (int k = 0; k < 3; ++k) {
      Quadric& q = quadrics_[t.corners[k].vertex];
      q += plane;
      areas_[t.corners[k].vertex] += area / 3;
      q.add_point(p[k], kPointWeight * area / 3);
    }
  }
}

void QuadricMetric::add_outline(const std::vector<OutlineEdge>& outline) {
  for (const OutlineEdge& edge : outline) {
    const auto& corners = mesh_.triangle(edge.triangle).corners;
    const VertexId a = corners[edge.side].vertex;
    const VertexId b = corners[(edge.side + 1) % 3].vertex;
    Quadric wall;
    for (const Vec3d& normal : edge.normals) wall.add_plane(normal, mesh_.position(a), edge.weight / 6);
    quadrics_[a] += wall;
    quadrics_[b] += wall;
  }
}

void QuadricMetric::add_walls() {
  mesh_.for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles& at) {
    if (!mesh_.is_feature(at)) return;
    const Vec3d along = mesh_.position(b) - mesh_.position(a);
    for (int k = 0; k < std::min(at.count, 2); ++k) {
      const Vec3d normal = cross_of(mesh_.corners_of(mesh_.triangle(at.triangle[k])));
      const Vec3d beside = along.cross(normal);
      if (!(beside.length() > 0)) continue;
      Quadric wall;
      wall.add_plane(beside.normalized(), mesh_.position(a), kLineWeight * along.length2());
      quadrics_[a] += wall;
      quadrics_[b] += wall;
    }
  });
}

MergedVertex QuadricMetric::merged(VertexId from, VertexId to, bool may_slide, bool stays_put) const {
  MergedVertex made;
  Quadric sum = quadrics_[from];
  sum += quadrics_[to];
  const double slide_weight = kSlideWeight * (areas_[from] + areas_[to]);
  const Vec3d anchor = anchors_[from];
  const Vec3d slide = anchors_[to] - anchor;
  const double slide2 = slide.length2();
  Quadric held = sum;
  held.add_point(anchors_[to], slide_weight);
  if (may_slide && slide2 > 0) held.add_plane(slide / std::sqrt(slide2), anchors_[to], -slide_weight);
  made.position = held.least();
  const Vec3d start = mesh_.position(from);
  const Vec3d way = mesh_.position(to) - start;
  const bool is_far = !((made.position - (start + way * 0.5)).length2() <= 4 * way.length2());
  if (is_far) made.position = sum.at(start) < sum.at(mesh_.position(to)) ? start : mesh_.position(to);
  if (stays_put) made.position = mesh_.position(to);
  made.share = slide2 > 0 ? std::clamp((made.position - anchor).dot(slide) / slide2, 0.0, 1.0) : 1;
  if (!may_slide) made.share = 1;
  else if (!mesh_.influences().empty()) made.share = made.share < 0.5 ? 0 : 1;
  made.anchor = anchor + slide * made.share;
  made.posed = mesh_.influences().empty() ? 0 : error_in_poses(from, to, made.share);
  made.cost = sum.at(made.position) + made.posed + slide_weight * (made.position - made.anchor).length2();
  return made;
}

double QuadricMetric::slip(VertexId from, VertexId to) const {
  const double bared = std::max(0.0, seen(to) - seen(from));
  const double weight = kSlipWeight * (1 + kBaredWeight * bared * bared);
  return weight * (areas_[from] + areas_[to]) * (mesh_.position(to) - mesh_.position(from)).length2();
}

/// The mean importance of what it stands for.
double QuadricMetric::seen(VertexId v) const { return plain_areas_[v] > 0 ? areas_[v] / plain_areas_[v] : 0; }

/// What taking over joints and weights may cost, as a squared distance by area, as all costs are.
double QuadricMetric::error_in_poses(VertexId from, VertexId to, double share) const {
  const VertexId gone = share == 0 ? to : from;
  const VertexId kept = share == 0 ? from : to;
  constexpr std::size_t kWidth = kInfluences.components;
  const float* a = &mesh_.influences()[kWidth * static_cast<std::size_t>(gone)];
  const float* b = &mesh_.influences()[kWidth * static_cast<std::size_t>(kept)];
  constexpr std::size_t kMost = kWidth / 2;  // joints, then their weights
  double square = 0;
  for (std::size_t i = 0; i < kMost; ++i) {
    double there = 0;
    double only = b[kMost + i];
    for (std::size_t j = 0; j < kMost; ++j) {
      if (b[j] == a[i]) there += b[kMost + j];
      if (a[j] == b[i] && a[kMost + j] > 0) only = 0;
    }
    if (a[kMost + i] > 0) square += (a[kMost + i] - there) * (a[kMost + i] - there);
    square += only * only;
  }
  return areas_[gone] * square * joint_reach_ * joint_reach_;
}

void QuadricMetric::join(VertexId from, VertexId to, const MergedVertex& merged) {
  quadrics_[to] += quadrics_[from];
  quadrics_[to].c += merged.posed;
  anchors_[to] = merged.anchor;
  areas_[to] += areas_[from];
  plain_areas_[to] += plain_areas_[from];
}

}  // namespace lozenge
