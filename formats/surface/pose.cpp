// Keys are read as glTF says (specification of glTF 2.0, Appendix C). The surface is taken back from where it stands at
// rest to where it was modelled, and from there into the pose.
#include "formats/surface/pose.h"

#include <Imath/ImathQuat.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/base/error.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/normal_transform.h"

namespace lozenge {

namespace {

using Imath::M44d;

/// The keys around a time.
struct Between {
  std::size_t before = 0;
  std::size_t after = 0;
  double share = 0;   ///< of the way
  double length = 0;  ///< seconds
};

Between keys_around(const std::vector<float>& times, double time) {
  const auto next = std::upper_bound(times.begin(), times.end(), time,
                                     [](double t, float key) { return t < static_cast<double>(key); });
  if (next == times.begin()) return {};
  const auto after = static_cast<std::size_t>(next - times.begin());
  if (next == times.end()) return {after - 1, after - 1, 0, 0};
  const double length = static_cast<double>(times[after]) - times[after - 1];
  return {after - 1, after, length > 0 ? (time - times[after - 1]) / length : 0, length};
}

std::vector<double> unit(std::vector<double> q) {
  double squares = 0;
  for (const double x : q) squares += x * x;
  for (double& x : q) x = squares > 0 ? x / std::sqrt(squares) : 0;
  if (!(squares > 0)) q.back() = 1;
  return q;
}

std::vector<double> turned_between(const std::vector<double>& from, const std::vector<double>& to, double share) {
  const Imath::Quatd a(from[3], from[0], from[1], from[2]);
  const Imath::Quatd b(to[3], to[0], to[1], to[2]);
  const Imath::Quatd q = Imath::slerpShortestArc(a, b, share);
  return {q.v.x, q.v.y, q.v.z, q.r};
}

/// What a channel's property is at a time.
std::vector<double> value_at(const AnimationSampler& sampler, double time, bool is_rotation) {
  const auto width = static_cast<std::size_t>(sampler.components);
  const bool is_spline = sampler.interpolation == KeyInterpolation::kCubicSpline;
  // A spline's key is its tangent from before, its value, its tangent from there on.
  const auto part = [&](std::size_t key, std::size_t which) {
    const std::size_t first = width * (is_spline ? 3 * key + which : key);
    return std::vector<double>(sampler.values.begin() + static_cast<std::ptrdiff_t>(first),
                               sampler.values.begin() + static_cast<std::ptrdiff_t>(first + width));
  };
  const auto [before, after, share, length] = keys_around(sampler.times, time);
  std::vector<double> value = part(before, 1);
  if (is_rotation) value = unit(value);
  if (before == after || sampler.interpolation == KeyInterpolation::kStep) return value;
  if (!is_spline && is_rotation) return turned_between(value, unit(part(after, 1)), share);
  const std::vector<double> next = part(after, 1);
  const std::vector<double> leaving = is_spline ? part(before, 2) : std::vector<double>(width, 0);
  const std::vector<double> arriving = is_spline ? part(after, 0) : std::vector<double>(width, 0);
  const double s = share;
  for (std::size_t c = 0; c < width; ++c) {
    if (!is_spline) {
      value[c] += (next[c] - value[c]) * s;
      continue;
    }
    value[c] = (2 * s * s * s - 3 * s * s + 1) * value[c] + length * (s * s * s - 2 * s * s + s) * leaving[c] +
               (3 * s * s - 2 * s * s * s) * next[c] + length * (s * s * s - s * s) * arriving[c];
  }
  return is_rotation ? unit(value) : value;
}

/// What takes a vertex from where it stands into a pose.
class Mover {
 public:
  /// \param origin  that the surface is counted from
  Mover(const Rig& rest, const PosedRig& pose, const Body& body, const Vec3d& origin)
      : standing_(standing_transforms(rest)), moved_(standing_transforms(pose.rig)), skin_(body.skin) {
    const auto count_from_origin = [&](std::vector<M44d>& transforms) {
      for (M44d& transform : transforms) transform = counted_from(origin, transform);
    };
    if (skin_ >= 0) {
      joints_ = standing_joints(rest, static_cast<std::size_t>(skin_), standing_);
      moved_joints_ = standing_joints(pose.rig, static_cast<std::size_t>(skin_), moved_);
      count_from_origin(joints_);
      count_from_origin(moved_joints_);
    }
    count_from_origin(standing_);
    count_from_origin(moved_);
    if (skin_ >= 0) return;
    if (const std::int32_t node = body.places.front().node; node >= 0) {
      back_ = standing_[node].inverse();
      from_to_ = back_ * moved_[node];
    }
  }

  /// To where it was modelled. \param influence  an element of `kInfluences`, of a skin
  M44d back(const float* influence) const {
    if (skin_ < 0) return back_;
    M44d there = blended(joints_, influence);
    if (!is_invertible(placement_of(there))) {
      there = joints_[std::min(static_cast<std::size_t>(influence[0]), joints_.size() - 1)];
    }
    return there.inverse();
  }

  /// Into the pose.
  M44d at(const float* influence) const {
    return skin_ < 0 ? from_to_ : back(influence) * blended(moved_joints_, influence);
  }

  Placement place_of(const BodyPlace& place) const {
    return skin_ >= 0 || place.node < 0 ? place.placement : placement_of(moved_[place.node]);
  }

 private:
  std::vector<M44d> standing_;  ///< [node]
  std::vector<M44d> moved_;
  std::int32_t skin_;
  std::vector<M44d> joints_;
  std::vector<M44d> moved_joints_;
  M44d back_;
  M44d from_to_;
};

/// What a body's morph targets do to corners.
class Morpher {
 public:
  Morpher(const SourceMesh& mesh, const std::vector<double>& weights) {
    for (std::size_t t = 0; t < weights.size(); ++t) {
      if (weights[t] == 0) continue;
      const auto set = static_cast<int>(t);
      targets_.push_back({weights[t], find_stream(mesh.corner_attributes, kMorphOffsets, set),
                          find_stream(mesh.corner_attributes, kMorphNormals, set)});
    }
  }

  Vec3d position(std::size_t corner, Vec3d p) const {
    for (const Target& target : targets_) {
      if (target.offsets != nullptr) p += Vec3d(vector_at<Vec3f>(*target.offsets, corner)) * target.weight;
    }
    return p;
  }

  Vec3f normal(std::size_t corner, const Vec3f& n) const {
    Vec3d sum(n);
    for (const Target& target : targets_) {
      if (target.normals == nullptr) continue;
      const auto after = vector_at<Vec3f>(*target.normals, corner);
      if (after != Vec3f(0, 0, 0)) sum += (Vec3d(after) - Vec3d(n)) * target.weight;
    }
    return sum.length() > 0 ? Vec3f(sum) : n;
  }

 private:
  struct Target {
    double weight;
    const AttributeStream* offsets;
    const AttributeStream* normals;
  };
  std::vector<Target> targets_;
};

}  // namespace

PosedRig posed(const Rig& rig, const Pose& pose, const std::string& name) {
  if (pose.animation < 0 || static_cast<std::size_t>(pose.animation) >= rig.animations.size()) {
    throw Error(ExitCode::kUsage, rig.animations.empty()
                                      ? name + ": has no animation that moves any of it"
                                      : fmt::format("{}: has no animation {}; those that move something are 0 to {}",
                                                    name, pose.animation, rig.animations.size() - 1));
  }
  PosedRig made{rig, std::vector<std::vector<double>>(rig.nodes.size())};
  const Animation& animation = rig.animations[pose.animation];
  for (const AnimationChannel& channel : animation.channels) {
    RigNode& node = made.rig.nodes[channel.node];
    std::vector<double> value =
        value_at(animation.samplers[channel.sampler], pose.time, channel.path == ChannelPath::kRotation);
    // Nodes that are animated have no matrix, says glTF; one that has all the same loses it.
    if (channel.path != ChannelPath::kWeights) node.matrix.clear();
    switch (channel.path) {
      case ChannelPath::kTranslation:
        node.translation = std::move(value);
        break;
      case ChannelPath::kRotation:
        node.rotation = std::move(value);
        break;
      case ChannelPath::kScale:
        node.scale = std::move(value);
        break;
      case ChannelPath::kWeights:
        made.weights[channel.node] = std::move(value);
        break;
    }
  }
  return made;
}

TimeRange time_range(const Animation& animation) {
  TimeRange range{INFINITY, 0};
  for (const AnimationSampler& sampler : animation.samplers) {
    range.first = std::min(range.first, static_cast<double>(sampler.times.front()));
    range.last = std::max(range.last, static_cast<double>(sampler.times.back()));
  }
  return animation.samplers.empty() ? TimeRange() : range;
}

std::vector<Pose> sample_poses(const Rig& rig, std::size_t animations, std::size_t times) {
  std::vector<Pose> poses;
  const std::size_t count = std::min(animations, rig.animations.size());
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t number = a * rig.animations.size() / count;
    const TimeRange range = time_range(rig.animations[number]);
    for (std::size_t k = 1; k <= times; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(times + 1);
      poses.push_back({static_cast<std::int32_t>(number), range.first + share * (range.last - range.first)});
    }
  }
  return poses;
}

std::vector<double> weights_in(const PosedRig& posed, const Body& body) {
  std::vector<double> weights;
  for (const MorphTarget& target : body.targets) weights.push_back(target.weight);
  const std::int32_t node = body.places.front().node;
  if (node >= 0 && posed.weights[node].size() == weights.size()) return posed.weights[node];
  return weights;
}

namespace {

/// Moves all corners of bodies, and their normals. \param matrix  of a corner of a body, by its influence (or null)
template <typename Matrix>
void move_bodies(const SourceMesh& mesh, const std::vector<Morpher>& morphers, const Matrix& matrix, SourceMesh& made) {
  const AttributeStream* influences = find_stream(mesh.corner_attributes, kInfluences);
  const auto normals = std::find_if(made.corner_attributes.begin(), made.corner_attributes.end(),
                                    [](const AttributeStream& stream) { return stream.kind == kNormals; });
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const std::int32_t body = mesh.bodies.empty() ? -1 : mesh.bodies.owner_of(mesh.materials[c / 3]);
    if (body < 0) continue;
    const VertexId v = mesh.triangles[c / 3][c % 3];
    const M44d m = matrix(static_cast<std::size_t>(body), influences == nullptr ? nullptr : influences->at(c));
    made.positions[v] = Vec3f(placed(m, morphers[body].position(c, Vec3d(mesh.positions[v]))));
    if (normals == made.corner_attributes.end()) continue;
    const Vec3f turned = NormalTransform(m)(morphers[body].normal(c, vector_at<Vec3f>(*normals, c)));
    std::copy_n(&turned.x, 3, normals->at(c));
  }
}

}  // namespace

bool lacks_influences(const SourceMesh& mesh) {
  if (!mesh.bodies.has_skin() || find_stream(mesh.corner_attributes, kInfluences) != nullptr) return false;
  return std::any_of(mesh.materials.begin(), mesh.materials.end(), [&](std::int32_t material) {
    const std::int32_t body = mesh.bodies.owner_of(static_cast<std::size_t>(material));
    return body >= 0 && mesh.bodies.bodies[body].skin >= 0;
  });
}

SourceMesh in_pose(const SourceMesh& mesh, const Pose& pose) {
  const PosedRig rig = posed(mesh.rig, pose, mesh.origin);
  SourceMesh made = mesh;
  std::vector<Mover> movers;
  std::vector<Morpher> morphers;
  for (const Body& body : mesh.bodies.bodies) {
    movers.emplace_back(mesh.rig, rig, body, mesh.translation);
    morphers.emplace_back(mesh, weights_in(rig, body));
  }
  move_bodies(
      mesh, morphers, [&](std::size_t body, const float* influence) { return movers[body].at(influence); }, made);
  for (std::size_t b = 0; b < made.bodies.bodies.size(); ++b) {
    for (BodyPlace& place : made.bodies.bodies[b].places) place.placement = movers[b].place_of(place);
  }
  made.rig = rig.rig;
  return made;
}

SourceMesh as_modelled(const SourceMesh& mesh) {
  SourceMesh made = mesh;
  std::vector<Mover> movers;
  std::vector<Morpher> morphers;
  for (const Body& body : mesh.bodies.bodies) {
    movers.emplace_back(mesh.rig, PosedRig{mesh.rig, {}}, body, mesh.translation);
    morphers.emplace_back(mesh, std::vector<double>());
  }
  move_bodies(
      mesh, morphers, [&](std::size_t body, const float* influence) { return movers[body].back(influence); }, made);
  return made;
}

}  // namespace lozenge
