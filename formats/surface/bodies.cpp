#include "formats/surface/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"

namespace lozenge {

namespace {

/// What is wrong with a body, in words, or nothing.
std::optional<std::string> find_defect(const Body& body) {
  if (body.places.empty()) return "has no place";
  if (body.skin < -1) return "has a skin that is no number of one";
  if (body.skin >= 0 && (body.places.size() > 1 || body.places.front().placement != kUnmoved)) {
    return "has a skin, and a place beside it";
  }
  if (body.targets.size() > static_cast<std::size_t>(kMostMorphTargets)) return "has too many morph targets";
  if (!body.targets.empty() && body.places.size() > 1) return "has morph targets, and several places";
  for (const MorphTarget& target : body.targets) {
    if (!std::isfinite(target.weight)) return "has a morph target whose weight is no number";
  }
  for (std::size_t p = 0; p < body.places.size(); ++p) {
    const BodyPlace& place = body.places[p];
    if (place.node < -1) return fmt::format("has a place, number {}, at what is no number of a node", p);
    // A node that moves may be sheared by those above it.
    if (place.node < 0 ? is_node_transform(place.placement) : is_invertible(place.placement)) continue;
    return fmt::format("has a place, number {}, that is no translation, rotation and scale", p);
  }
  return std::nullopt;
}

}  // namespace

bool Bodies::has_skin() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.skin >= 0; });
}

bool Bodies::has_targets() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !body.targets.empty(); });
}

bool fit(const Bodies& bodies, const Rig& rig) {
  const auto nodes = static_cast<std::int32_t>(rig.nodes.size());
  const auto skins = static_cast<std::int32_t>(rig.skins.size());
  std::vector<std::size_t> targets(rig.nodes.size(), 0);  // [node]
  for (const Body& body : bodies.bodies) {
    for (const BodyPlace& place : body.places) {
      if (place.node >= nodes) return false;
      if (place.node >= 0) targets[place.node] = std::max(targets[place.node], body.targets.size());
    }
    if (body.skin >= skins) return false;
  }
  for (const Animation& animation : rig.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      const auto components = static_cast<std::size_t>(animation.samplers[channel.sampler].components);
      if (channel.path == ChannelPath::kWeights && targets[channel.node] != components) return false;
    }
  }
  return true;
}

std::vector<Placement> copies_of(const Body& body) {
  std::vector<Placement> copies;
  if (body.places.size() < 2) return copies;
  const bool unmoved = body.places.front().placement == kUnmoved;
  const Imath::M44d back = matrix_of(body.places.front().placement).inverse();
  for (std::size_t p = 1; p < body.places.size(); ++p) {
    const Placement& there = body.places[p].placement;
    copies.push_back(unmoved ? there : placement_of(back * matrix_of(there)));
  }
  return copies;
}

void require_sensible_copies(std::size_t triangles_of_mesh, std::size_t copies) {
  constexpr std::size_t kMost = 200'000'000;
  if (triangles_of_mesh == 0 || copies <= kMost / triangles_of_mesh) return;
  throw Error(ExitCode::kLimit, fmt::format("{} copies of {} triangles are too many to look at as one surface", copies,
                                            triangles_of_mesh));
}

std::optional<std::string> find_defect(const Bodies& bodies, std::size_t count) {
  if (bodies.owner.size() != (bodies.empty() ? 0 : count)) {
    return fmt::format("{} of {} know to which body they belong", bodies.owner.size(), count);
  }
  const auto most = static_cast<std::int32_t>(bodies.bodies.size());
  for (std::size_t i = 0; i < bodies.owner.size(); ++i) {
    if (bodies.owner[i] < -1 || bodies.owner[i] >= most) {
      return fmt::format("number {} belongs to body {} of {}", i, bodies.owner[i], most);
    }
  }
  for (std::size_t b = 0; b < bodies.bodies.size(); ++b) {
    if (const auto defect = find_defect(bodies.bodies[b])) return fmt::format("body {} {}", b, *defect);
  }
  return std::nullopt;
}

}  // namespace lozenge
