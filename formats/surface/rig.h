// What moves an asset's bodies: the tree of the nodes that anything needs, skins over some of them, and animations.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/surface/attribute.h"
#include "formats/surface/placement.h"

namespace lozenge {

/// A node, with its transform as its file has it: numbers that are not there are neutral.
struct RigNode {
  std::string name;
  std::int32_t parent = -1;         ///< a lower number, or -1
  std::vector<double> matrix;       ///< none, or 16; then nothing of the following
  std::vector<double> translation;  ///< none, or 3
  std::vector<double> rotation;     ///< none, or a quaternion of unit length: x, y, z, w
  std::vector<double> scale;        ///< none, or 3
  std::string extras = {};          ///< what the file's maker had to say about it, as JSON; or nothing
  std::int32_t camera = -1;
  std::int32_t light = -1;
};

/// As glTF has them: numbers that are 0 where it allows that are not there.
struct RigCamera {
  std::string name;
  bool is_orthographic = false;
  double width = 0;   ///< the aspect ratio, or half the width that is seen
  double height = 0;  ///< the vertical angle, or half the height that is seen
  double near = 0;
  double far = 0;
};

/// A light of KHR_lights_punctual.
struct RigLight {
  std::string name;
  std::string type;  ///< "directional", "point" or "spot"
  Vec3d colour{1, 1, 1};
  double intensity = 1;
  double range = 0;
  double inner_angle = 0;  ///< of a spot's cone
  double outer_angle = 0;
};

struct RigSkin {
  std::string name;
  std::vector<std::int32_t> joints;      ///< nodes
  std::vector<Placement> inverse_binds;  ///< [joint] from the space of the mesh to that of the joint
  std::int32_t skeleton = -1;            ///< a node, or -1
};

/// Which property of a node a channel moves.
enum class ChannelPath : std::uint8_t { kTranslation, kRotation, kScale, kWeights };
inline constexpr std::array<const char*, 4> kChannelPaths{"translation", "rotation", "scale", "weights"};

/// Numbers of a property; of weights, whose number is that of morph targets, 0.
constexpr int components_of(ChannelPath path) {
  return path == ChannelPath::kWeights ? 0 : path == ChannelPath::kRotation ? 4 : 3;
}

enum class KeyInterpolation : std::uint8_t { kLinear, kStep, kCubicSpline };
inline constexpr std::array<const char*, 3> kKeyInterpolations{"LINEAR", "STEP", "CUBICSPLINE"};

/// Keys over time.
struct AnimationSampler {
  KeyInterpolation interpolation = KeyInterpolation::kLinear;
  int components = 3;
  std::vector<float> times;   ///< seconds
  std::vector<float> values;  ///< [key * components + component]; of a cubic spline each key is three
};

struct AnimationChannel {
  std::int32_t sampler = 0;
  std::int32_t node = 0;
  ChannelPath path = ChannelPath::kTranslation;
};

struct Animation {
  std::string name;
  std::vector<AnimationSampler> samplers;
  std::vector<AnimationChannel> channels;
};

struct Rig {
  std::vector<RigNode> nodes;  ///< parents before their children
  std::vector<RigSkin> skins;
  std::vector<Animation> animations;
  std::vector<RigCamera> cameras = {};
  std::vector<RigLight> lights = {};

  bool empty() const { return nodes.empty(); }
};

/// [node] from the node to the scene, at rest.
std::vector<Imath::M44d> rest_transforms(const Rig& rig);

/// The same for surfaces that are to be seen: a node that has no extent at rest (a scale of zero hides things) stands
/// as if it had not been scaled in that direction.
std::vector<Imath::M44d> standing_transforms(const Rig& rig);

/// [joint of the skin] from the space of the mesh to the scene, where the surface stands. The matrix of a joint that
/// has no extent at rest is that of another joint that has: the nearest one above it, else the first one there is.
/// \param standing  `standing_transforms`
std::vector<Imath::M44d> standing_joints(const Rig& rig, std::size_t skin, const std::vector<Imath::M44d>& standing);

/// What the joints make of a vertex together: the mean of their matrices by its weights.
/// \param influence  an element of a stream `kInfluences`, its joints among those of `joints`
Imath::M44d blended(const std::vector<Imath::M44d>& joints, const float* influence);

/// What is wrong with a rig from a file, in words, or nothing.
std::optional<std::string> find_defect(const Rig& rig);

}  // namespace lozenge
