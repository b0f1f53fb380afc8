// Bodies of no particular surface: for tests of whatever carries them along.
#pragma once

#include <gtest/gtest.h>

#include <Imath/ImathMatrix.h>

#include <cmath>
#include <random>
#include <string>

#include "formats/surface/bodies.h"
#include "formats/surface/rig.h"

namespace lozenge::fixtures {

/// Turned, scaled and moved at random; every other one mirrors.
inline Placement random_placement(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Imath::M44d m;
  m.rotate(Imath::V3d(number(random), number(random), number(random)));
  Placement placement = kUnmoved;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = 0.1 + std::abs(number(random));
    const double scale = axis == 0 && random() % 2 == 0 ? -size : size;
    for (int c = 0; c < 3; ++c) placement[4 * axis + c] = scale * m[axis][c];
    placement[12 + axis] = 10 * number(random);
  }
  return placement;
}

/// One to three bodies in one to four places that stand still, and owners from among them, or none. \param count  of
/// owners
inline Bodies random_bodies(std::size_t count, std::mt19937& random) {
  Bodies bodies;
  const unsigned most = 1 + random() % 3;
  for (unsigned b = 0; b < most; ++b) {
    bodies.bodies.push_back({b == 1 ? ""
                                    : "b\xC3\xB6"
                                      "dy \"" +
                                          std::to_string(b) + "\"",
                             {{}},
                             -1});
    for (unsigned c = 0; c < random() % 4; ++c) bodies.bodies.back().places.push_back({random_placement(random), -1});
  }
  for (std::size_t i = 0; i < count; ++i) {
    bodies.owner.push_back(static_cast<std::int32_t>(random() % (most + 1)) - 1);
  }
  return bodies;
}

/// Some of them moved by nodes of a rig, or one by its skin.
inline Bodies random_moving_bodies(std::size_t count, const Rig& rig, std::mt19937& random) {
  Bodies bodies = random_bodies(count, random);
  for (Body& body : bodies.bodies) {
    for (BodyPlace& place : body.places) {
      if (random() % 2 == 0) place = {random_placement(random), static_cast<std::int32_t>(random() % rig.nodes.size())};
    }
  }
  if (random() % 2 == 0) bodies.bodies.front() = {"skin", {{}}, 0};
  return bodies;
}

/// A few nodes with a skin over them and an animation of one.
inline Rig random_rig(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Rig rig;
  for (std::int32_t n = 0; n < 4; ++n) {
    RigNode node{"node " + std::to_string(n), static_cast<std::int32_t>(random() % (n + 1)) - 1, {}, {}, {}, {}};
    if (random() % 3 == 0) {
      const Placement placement = random_placement(random);
      node.matrix.assign(placement.begin(), placement.end());
    } else {
      node.translation = {number(random), number(random), number(random)};
      node.rotation = {0.6, 0, 0, 0.8};
      if (random() % 2 == 0) node.scale = {0.5, 2, 1};
    }
    rig.nodes.push_back(node);
  }
  rig.nodes[1].extras = R"({"socket":true,"tags":["a",1,0.5]})";
  rig.nodes[1].camera = 0;
  rig.nodes[3].light = 0;
  rig.cameras.push_back({"eye", random() % 2 == 0, 1.5, 0.75, 0.125, 100});
  rig.lights.push_back({"torch", random() % 2 == 0 ? "spot" : "point", {1, 0.5, 0.25}, 3, 8, 0, 0.5});
  Placement bind = random_placement(random);
  for (double& x : bind) x = static_cast<float>(x);
  rig.skins.push_back({"skin", {2, 0}, {bind, kUnmoved}, 0});
  rig.animations.push_back({"turn", {{KeyInterpolation::kStep, 4, {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0}}}, {}});
  rig.animations.back().channels.push_back({0, 1, ChannelPath::kRotation});
  return rig;
}

inline void expect_same(const Bodies& a, const Bodies& b) {
  EXPECT_EQ(a.owner, b.owner);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].name, b.bodies[i].name);
    EXPECT_EQ(a.bodies[i].places, b.bodies[i].places);
    EXPECT_EQ(a.bodies[i].skin, b.bodies[i].skin);
    EXPECT_EQ(a.bodies[i].targets, b.bodies[i].targets);
  }
}

inline void expect_same(const Animation& a, const Animation& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.samplers.size(), b.samplers.size());
  for (std::size_t s = 0; s < a.samplers.size(); ++s) {
    EXPECT_EQ(a.samplers[s].interpolation, b.samplers[s].interpolation);
    EXPECT_EQ(a.samplers[s].components, b.samplers[s].components);
    EXPECT_EQ(a.samplers[s].times, b.samplers[s].times);
    EXPECT_EQ(a.samplers[s].values, b.samplers[s].values);
  }
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    EXPECT_EQ(a.channels[c].sampler, b.channels[c].sampler);
    EXPECT_EQ(a.channels[c].node, b.channels[c].node);
    EXPECT_EQ(a.channels[c].path, b.channels[c].path);
  }
}

inline void expect_same(const Rig& a, const Rig& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    EXPECT_EQ(a.nodes[n].name, b.nodes[n].name);
    EXPECT_EQ(a.nodes[n].parent, b.nodes[n].parent);
    EXPECT_EQ(a.nodes[n].matrix, b.nodes[n].matrix);
    EXPECT_EQ(a.nodes[n].translation, b.nodes[n].translation);
    EXPECT_EQ(a.nodes[n].rotation, b.nodes[n].rotation);
    EXPECT_EQ(a.nodes[n].scale, b.nodes[n].scale);
    EXPECT_EQ(a.nodes[n].extras, b.nodes[n].extras);
    EXPECT_EQ(a.nodes[n].camera, b.nodes[n].camera);
    EXPECT_EQ(a.nodes[n].light, b.nodes[n].light);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t c = 0; c < a.cameras.size(); ++c) {
    EXPECT_EQ(a.cameras[c].name, b.cameras[c].name);
    EXPECT_EQ(a.cameras[c].is_orthographic, b.cameras[c].is_orthographic);
    EXPECT_EQ(a.cameras[c].width, b.cameras[c].width);
    EXPECT_EQ(a.cameras[c].height, b.cameras[c].height);
    EXPECT_EQ(a.cameras[c].near, b.cameras[c].near);
    EXPECT_EQ(a.cameras[c].far, b.cameras[c].far);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t l = 0; l < a.lights.size(); ++l) {
    EXPECT_EQ(a.lights[l].name, b.lights[l].name);
    EXPECT_EQ(a.lights[l].type, b.lights[l].type);
    EXPECT_EQ(a.lights[l].colour, b.lights[l].colour);
    EXPECT_EQ(a.lights[l].intensity, b.lights[l].intensity);
    EXPECT_EQ(a.lights[l].range, b.lights[l].range);
  }
  ASSERT_EQ(a.skins.size(), b.skins.size());
  for (std::size_t s = 0; s < a.skins.size(); ++s) {
    EXPECT_EQ(a.skins[s].name, b.skins[s].name);
    EXPECT_EQ(a.skins[s].joints, b.skins[s].joints);
    EXPECT_EQ(a.skins[s].inverse_binds, b.skins[s].inverse_binds);
    EXPECT_EQ(a.skins[s].skeleton, b.skins[s].skeleton);
  }
  ASSERT_EQ(a.animations.size(), b.animations.size());
  for (std::size_t i = 0; i < a.animations.size(); ++i) expect_same(a.animations[i], b.animations[i]);
}

}  // namespace lozenge::fixtures
