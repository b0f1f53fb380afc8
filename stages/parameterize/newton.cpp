#include "stages/parameterize/newton.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "formats/parallel.h"
#include "stages/parameterize/boundary.h"
#include "stages/parameterize/sweeps.h"

namespace lozenge {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Gradient and Hessian of a triangle's energy, by the positions of its corners in its own frame.
struct TriangleExpansion {
  Vector6 gradient;
  Matrix6 hessian;
};

Vector6 concatenated(const std::array<Vec2d, 3>& v) {
  Vector6 all;
  all << v[0].x, v[0].y, v[1].x, v[1].y, v[2].x, v[2].y;
  return all;
}

/// The nearest matrix without negative eigenvalues.
Matrix6 made_positive(const Matrix6& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(m);
  if (solver.eigenvalues()[0] >= 0) return m;
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
}

TriangleExpansion expand(const WorkingMap& map, TriangleId t, double scale) {
  const FlatImage p = flat_image(map, t);
  const RestShape& rest = map.rest[t];
  const double area = rest.inverse_area * scale;
  const double d = doubled_area(p) * area;
  double length = 0;
  std::array<Vec2d, 3> t_gradient, d_gradient;
  Matrix6 t_hessian = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) {
    // The side opposite corner i.
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double w = rest.weight[i] * scale;
    length += w * (p[j] - p[k]).length2();
    for (int axis = 0; axis < 2; ++axis) {
      t_hessian(2 * j + axis, 2 * j + axis) += 2 * w;
      t_hessian(2 * k + axis, 2 * k + axis) += 2 * w;
      t_hessian(2 * j + axis, 2 * k + axis) -= 2 * w;
      t_hessian(2 * k + axis, 2 * j + axis) -= 2 * w;
    }
    d_gradient[i] = Vec2d(p[j].y - p[k].y, p[k].x - p[j].x) * area;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    t_gradient[i] = ((p[i] - p[j]) * rest.weight[k] + (p[i] - p[k]) * rest.weight[j]) * (2 * scale);
  }
  Matrix6 d_hessian = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) {
    // d(i.x) is area * (j.y - k.y), d(i.y) is area * (k.x - j.x).
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    d_hessian(2 * i, 2 * j + 1) += area;
    d_hessian(2 * i, 2 * k + 1) -= area;
    d_hessian(2 * i + 1, 2 * k) += area;
    d_hessian(2 * i + 1, 2 * j) -= area;
  }
  const EnergyDerivatives e = differentiate(map.energy, length, d);
  const Vector6 gt = concatenated(t_gradient);
  const Vector6 gd = concatenated(d_gradient);
  TriangleExpansion result;
  result.gradient = rest.share * (e.f_t * gt + e.f_d * gd);
  result.hessian = rest.share * made_positive(e.f_t * t_hessian + e.f_d * d_hessian + e.f_dd * gd * gd.transpose() +
                                              e.f_td * (gt * gd.transpose() + gd * gt.transpose()));
  return result;
}

/// The projection onto the side that a free vertex of the boundary lies on.
Eigen::Matrix2d along_boundary(const WorkingMap& map, VertexId v) {
  const Vec2d d = direction_of(boundary_place(map, v).side.side);
  return Eigen::Vector2d(d.x, d.y) * Eigen::RowVector2d(d.x, d.y);
}

/// Into the frames of the corners' homes; of a corner on the boundary, what lies along its side.
TriangleExpansion turned_home(const WorkingMap& map, TriangleId t, const TriangleExpansion& e) {
  Matrix6 turn = Matrix6::Zero();
  for (int c = 0; c < 3; ++c) {
    const int sixths = map.chart[3 * t + c].sixths;
    const double cos = kCosOfSixths[sixths];
    const double sin = kSinOfSixths[sixths];
    turn.block<2, 2>(2 * c, 2 * c) << cos, -sin, sin, cos;
    const VertexId v = map.mesh.triangles[t][c];
    if (map.pin[v] < 0 && map.mesh.on_boundary(v)) turn.block<2, 2>(2 * c, 2 * c) *= along_boundary(map, v);
  }
  return {turn.transpose() * e.gradient, turn.transpose() * e.hessian * turn};
}

/// The largest share of the step, at most 1, before a triangle has lost nine tenths of its area.
double longest_step(const WorkingMap& map, TriangleId t, const std::vector<Vec2d>& step) {
  const FlatImage p = flat_image(map, t);
  std::array<Vec2d, 3> s;
  for (int c = 0; c < 3; ++c) {
    const UnitMotion& chart = map.chart[3 * t + c];
    s[c] = UnitMotion{chart.sixths, {}}(step[map.mesh.triangles[t][c]]);
  }
  // The doubled area after a share x of the step: a x^2 + b x + c.
  const Vec2d u = p[1] - p[0], v = p[2] - p[0], du = s[1] - s[0], dv = s[2] - s[0];
  const double a = cross(du, dv);
  const double b = cross(u, dv) + cross(du, v);
  const double c = 0.9 * cross(u, v);
  const double under = b * b - 4 * a * c;
  if (under < 0) return 1;
  // The smallest positive root, without cancellation.
  const double q = -0.5 * (b + std::copysign(std::sqrt(under), b));
  double least = 1;
  for (const double root : {a != 0 ? q / a : -1, q != 0 ? c / q : -1}) {
    if (root > 0) least = std::min(least, root);
  }
  return least;
}

class Newton {
 public:
  explicit Newton(WorkingMap& map) : map_(map), unknown_(map.home.size(), -1) {
    for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
      if (map.home[v] >= 0 && map.pin[v] < 0) unknown_[v] = count_++;
    }
    for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
      if (!map.mesh.removed(t)) triangles_.push_back(t);
    }
  }

  /// \return by how much the energy fell
  double step(double before) {
    const std::vector<Vec2d> direction = solve();
    if (direction.empty()) return 0;
    double share = 1;
    for (const TriangleId t : triangles_) share = std::min(share, longest_step(map_, t, direction));
    const std::vector<Vec2d> start = map_.at;
    for (int halving = 0; halving < 12; ++halving, share /= 2) {
      for (std::size_t v = 0; v < start.size(); ++v) map_.at[v] = start[v] + direction[v] * share;
      const double after = total_energy(map_);
      if (!(after < before)) continue;
      go_home(map_, start);
      return before - after;
    }
    map_.at = start;
    return 0;
  }

 private:
  std::vector<Vec2d> solve() {
    const double scale = map_.scale();
    std::vector<TriangleExpansion> expansions(triangles_.size());
    for_each_part(triangles_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        expansions[i] = turned_home(map_, triangles_[i], expand(map_, triangles_[i], scale));
      }
    });
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2 * count_);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(triangles_.size() * 21);
    for (std::size_t i = 0; i < triangles_.size(); ++i) add(triangles_[i], expansions[i], gradient, entries);
    hold_across_boundary(entries);
    Eigen::SparseMatrix<double> hessian(2 * count_, 2 * count_);
    hessian.setFromTriplets(entries.begin(), entries.end());
    // Where every triangle around is at its least, nothing holds a vertex: a hair of its own diagonal does.
    for (int k = 0; k < hessian.outerSize(); ++k) hessian.coeffRef(k, k) *= 1 + 1e-9;
    if (!analyzed_) solver_.analyzePattern(hessian);
    analyzed_ = true;
    solver_.factorize(hessian);
    if (solver_.info() != Eigen::Success) return {};
    const Eigen::VectorXd x = solver_.solve(-gradient);
    if (!x.allFinite()) return {};
    std::vector<Vec2d> direction(map_.at.size(), Vec2d(0, 0));
    for (std::size_t v = 0; v < direction.size(); ++v) {
      if (unknown_[v] >= 0) direction[v] = {x[2 * unknown_[v]], x[2 * unknown_[v] + 1]};
    }
    return direction;
  }

  /// Nothing pulls a vertex of the boundary across its side, and so that nothing is all that moves it, a spring holds
  /// it.
  void hold_across_boundary(std::vector<Eigen::Triplet<double>>& entries) const {
    for (VertexId v = 0; v < map_.mesh.vertex_count(); ++v) {
      const int i = unknown_[v];
      if (i < 0 || !map_.mesh.on_boundary(v)) continue;
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along_boundary(map_, v);
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b <= a; ++b) entries.emplace_back(2 * i + a, 2 * i + b, across(a, b));
      }
    }
  }

  /// The lower triangle of the sum.
  void add(TriangleId t, const TriangleExpansion& e, Eigen::VectorXd& gradient,
           std::vector<Eigen::Triplet<double>>& entries) const {
    for (int c = 0; c < 3; ++c) {
      const int i = unknown_[map_.mesh.triangles[t][c]];
      if (i < 0) continue;
      for (int axis = 0; axis < 2; ++axis) gradient[2 * i + axis] += e.gradient[2 * c + axis];
      for (int other = 0; other < 3; ++other) {
        const int j = unknown_[map_.mesh.triangles[t][other]];
        if (j < 0 || j > i) continue;
        for (int a = 0; a < 2; ++a) {
          for (int b = 0; b < 2; ++b) {
            if (2 * j + b <= 2 * i + a) entries.emplace_back(2 * i + a, 2 * j + b, e.hessian(2 * c + a, 2 * other + b));
          }
        }
      }
    }
  }

  WorkingMap& map_;
  std::vector<std::int32_t> unknown_;  ///< [vertex] or -1
  std::int32_t count_ = 0;
  std::vector<TriangleId> triangles_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analyzed_ = false;
};

}  // namespace

double newton_all(WorkingMap& map, const NewtonOptions& options) {
  Newton newton(map);
  const double start = total_energy(map);
  if (!std::isfinite(start)) return 0;
  double energy = start;
  for (int i = 0; i < options.most_steps; ++i) {
    const double fallen = newton.step(energy);
    energy -= fallen;
    if (fallen <= options.tolerance * (energy - 1)) break;
  }
  return start - energy;
}

}  // namespace lozenge
