// Equal positions with equal joints stay equal: what is done to a vertex depends on nothing else.
#include "stages/export/own_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/base/error.h"
#include "formats/surface/distinct_positions.h"
#include "formats/surface/normal_transform.h"
#include "formats/surface/rig.h"

namespace lozenge {

namespace {

using Imath::M44d;

Vec3d direction(const M44d& m, const Vec3d& d) { return placed(m, d) - placed(m, Vec3d(0, 0, 0)); }

/// At a right angle to the normal again, where shear took it from there, and unit.
Vec4f moved_tangent(const M44d& matrix, const Vec4f& tangent, const Vec3f& normal, bool mirrored) {
  const Vec3d n(normal);
  Vec3d t = direction(matrix, Vec3d(tangent.x, tangent.y, tangent.z));
  t -= n * n.dot(t);
  const double length = t.length();
  if (!(length > 0) || !std::isfinite(length)) {
    const Vec3d other = std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    t = (other - n * n.dot(other)).normalized();
  } else {
    t /= length;
  }
  const Vec3f unit = without_negative_zeros(Vec3f(t));
  return {unit.x, unit.y, unit.z, mirrored ? -tangent.w : tangent.w};
}

/// As the vertex's own normal is, whose length the transform changes.
Vec3f moved_normal_delta(const NormalTransform& transform, const Vec3f& normal, const Vec3f& delta) {
  const auto turned = [&](const Vec3d& n) {
    return transform.rows[0] * n.x + transform.rows[1] * n.y + transform.rows[2] * n.z;
  };
  const double length = turned(Vec3d(normal)).length();
  return length > 0 ? without_negative_zeros(Vec3f(turned(Vec3d(delta)) / length)) : Vec3f(0, 0, 0);
}

void move_vertex(EngineMesh& mesh, std::size_t v, const M44d& matrix) {
  const NormalTransform normal(matrix);
  for (MorphDeltas& target : mesh.targets) {
    target.positions[v] = normal.offset(target.positions[v]);
    if (!target.normals.empty()) target.normals[v] = moved_normal_delta(normal, mesh.normals[v], target.normals[v]);
  }
  mesh.positions[v] = without_negative_zeros(Vec3f(placed(matrix, Vec3d(mesh.positions[v]))));
  const Vec3f turned = normal(mesh.normals[v]);
  if (turned != Vec3f(0, 0, 0)) mesh.normals[v] = turned;
  mesh.tangents[v] = moved_tangent(matrix, mesh.tangents[v], mesh.normals[v], normal.mirrored);
}

/// Weights as multiples of 1 / kWholeWeight with the sum 1: rounded down, the rest to those that lost most.
void round_weights(float* element) {
  constexpr int kMost = kInfluences.components / 2;
  float* weights = element + kMost;
  double total = 0;
  for (int i = 0; i < kMost; ++i) total += weights[i];
  if (!(total > 0)) return;
  std::array<int, kMost> steps{};
  std::array<double, kMost> lost{};
  int left = kWholeWeight;
  for (int i = 0; i < kMost; ++i) {
    const double exact = weights[i] / total * kWholeWeight;
    steps[i] = std::min(static_cast<int>(exact), left);
    lost[i] = exact - steps[i];
    left -= steps[i];
  }
  for (; left > 0; --left) {
    const auto most = std::max_element(lost.begin(), lost.end()) - lost.begin();
    ++steps[most];
    lost[most] -= 1;
  }
  for (int i = 0; i < kMost; ++i) {
    weights[i] = static_cast<float>(static_cast<double>(steps[i]) / kWholeWeight);
    if (steps[i] == 0) element[i] = 0;
  }
}

/// The places of a part's vertices, on all of its levels. Those that differ must differ in its own space, too, for
/// readers weld by bits; where that lies far from its origin, floats may be too coarse for that.
class PlacesInPart {
 public:
  /// \param stood  where the vertices were in the scene \param own  where they are now; kept, to be changed
  void add(const std::vector<Vec3f>& stood, std::vector<Vec3f>& own) {
    if (stood.empty()) return;
    Numbered& mesh = meshes_.emplace_back(Numbered{&own, {}});
    mesh.numbers.reserve(stood.size());
    for (std::size_t v = 0; v < stood.size(); ++v) {
      const auto key = numbered(stood[v], 0).bits;
      const auto [place, is_new] = number_at_.try_emplace(key, own_.size());
      if (is_new) own_.push_back(own[v]);
      mesh.numbers.push_back(place->second);
    }
  }

  void keep_apart() {
    make_distinct(own_);
    for (const Numbered& mesh : meshes_) {
      for (std::size_t v = 0; v < mesh.numbers.size(); ++v) (*mesh.positions)[v] = own_[mesh.numbers[v]];
    }
  }

 private:
  struct Numbered {
    std::vector<Vec3f>* positions;
    std::vector<std::size_t> numbers;  ///< [vertex] of its place
  };

  std::map<std::array<std::uint32_t, 3>, std::size_t> number_at_;
  std::vector<Vec3f> own_;
  std::vector<Numbered> meshes_;
};

bool has_movers(const Rig& rig, const Body& body) {
  const bool has_nodes = std::all_of(body.places.begin(), body.places.end(), [&](const BodyPlace& place) {
    return place.node < static_cast<std::int32_t>(rig.nodes.size());
  });
  return has_nodes && body.skin < static_cast<std::int32_t>(rig.skins.size());
}

}  // namespace

void move_to_own_spaces(std::vector<LeveledPart>& parts, const Rig& rig, const Vec3d& translation) {
  const std::vector<M44d> standing = standing_transforms(rig);
  for (LeveledPart& part : parts) {
    const Body& body = part.body;
    if (!rig.empty() && !has_movers(rig, body)) {
      throw Error(ExitCode::kUnusableInput, "\"" + body.name +
                                                "\" is moved by a node or skin that isn't there; give the map that the "
                                                "geometry image was sampled from");
    }
    const bool is_skinned = body.skin >= 0 && !rig.empty();
    const bool is_moved = body.places.front().node >= 0 && !rig.empty();
    std::vector<M44d> joints =
        is_skinned ? standing_joints(rig, static_cast<std::size_t>(body.skin), standing) : std::vector<M44d>();
    for (M44d& joint : joints) joint = counted_from(translation, joint);
    PlacesInPart places;
    for (PartLevel& level : part.levels) {
      for (EngineMesh* mesh : {&level.sampled, &level.source}) {
        const std::vector<Vec3f> stood = is_skinned || is_moved ? mesh->positions : std::vector<Vec3f>();
        if (is_skinned) move_to_space_of_skin(*mesh, joints);
        else mesh->influences.clear();
        if (is_moved) move_to_own_space(*mesh, body.places.front().placement);
        places.add(stood, mesh->positions);
      }
    }
    places.keep_apart();
  }
}

void move_to_own_space(EngineMesh& mesh, const Placement& placement) {
  if (placement == kUnmoved) return;
  const M44d back = matrix_of(placement).inverse();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) move_vertex(mesh, v, back);
  if (!is_mirroring(placement)) return;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

void move_to_space_of_skin(EngineMesh& mesh, const std::vector<M44d>& joints) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    float* influence = &mesh.influences[kInfluences.components * v];
    round_weights(influence);
    M44d there = blended(joints, influence);
    // Joints that turn against each other may leave no extent between them: there the heaviest one alone decides.
    if (!is_invertible(placement_of(there))) {
      there = joints[std::min(static_cast<std::size_t>(influence[0]), joints.size() - 1)];
    }
    move_vertex(mesh, v, there.inverse());
  }
}

}  // namespace lozenge
