// Assets of which something moves.

#include <algorithm>
#include <cmath>

#include "test_assets/documents.h"

namespace lozenge::test_assets {
namespace {

const double kHalf = std::sqrt(0.5);

/// An ellipsoid from z = 0 to z = 200.
Shape worm() {
  Shape shape = octasphere(4);
  for (Vec3f& p : shape.positions) p = Vec3f(30 * p.x, 30 * p.y, 100 + 100 * p.z);
  return shape;
}

/// The bone at or below a height, and how far it is from there to the next one.
void bend(Primitive& primitive, float bone_length) {
  for (const Vec3f& p : primitive.positions) {
    const float place = std::clamp(p.z / bone_length - 0.5F, 0.0F, 2.0F);
    const float lower = std::min(std::floor(place), 1.0F);
    const float share = place - lower;
    primitive.joints.push_back(
        {static_cast<std::uint8_t>(share < 1 ? lower : 0), static_cast<std::uint8_t>(share > 0 ? lower + 1 : 0), 0, 0});
    primitive.weights.push_back({1 - share, share, 0, 0});
  }
}

}  // namespace

Document worm_document() {
  constexpr float kBone = 70;
  Document document;
  document.scene_name = "Worm";
  Primitive skin = primitive_of(worm(), true);
  bend(skin, kBone);
  document.meshes = {{skin}, {primitive_of(octasphere(2), true)}, {primitive_of(octasphere(3), true)}};
  document.nodes = {
      {.name = "Worm", .mesh = 0, .skin = 0},
      {.name = "Armature", .children = {2}, .rotation = {-kHalf, 0, 0, kHalf}, .scale = {0.01, 0.01, 0.01}},
      {.name = "Tail", .children = {3}},
      {.name = "Middle", .children = {4}, .translation = {0, 0, kBone}},
      {.name = "Head", .children = {5}, .translation = {0, 0, kBone}},
      {.name = "Hat", .mesh = 1, .translation = {0, 0, 80}, .scale = {20, 20, 20}},
      {.name = "Stone", .mesh = 2, .translation = {1.5, 0.25, 0}, .scale = {0.5, 0.25, 0.5}}};
  document.roots = {0, 1, 6};
  Skin& bones = document.skins.emplace_back();
  for (int b = 0; b < 3; ++b) {
    bones.joints.push_back(2 + b);
    bones.inverse_binds.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -kBone * static_cast<float>(b), 1});
  }
  document.animations = {{"bend", 3, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0.5F, 0, 0, 0.8660254F, 0, 0, 0, 1}}};
  return document;
}

Document cart_document() {
  Document document;
  document.scene_name = "Cart";
  document.meshes = {{primitive_of(octasphere(3), true)},
                     {primitive_of(torus(1, 0.4, 48, 20), true)},
                     {primitive_of(octasphere(2), true)}};
  document.nodes = {{.name = "Ball", .mesh = 0, .translation = {5, 1, 0}},
                    {.name = "Cart", .children = {2, 3, 4}, .translation = {0, 1.5, 0}},
                    {.name = "Left wheel", .mesh = 1, .translation = {0, 0, 1.5}},
                    {.name = "Right wheel", .mesh = 1, .translation = {0, 0, -1.5}, .scale = {1, 1, -1}},
                    {.name = "Seat", .mesh = 2, .translation = {0, 1.5, 0}, .scale = {1, 0.25, 0.75}}};
  document.roots = {0, 1};
  const std::vector<float> turn{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, -1};
  document.animations = {{"roll", 1, "translation", {0, 2}, {0, 1.5F, 0, 6, 1.5F, 0}},
                         {"turn left", 2, "rotation", {0, 1, 2}, turn},
                         {"turn right", 3, "rotation", {0, 1, 2}, turn},
                         {"stay", 0, "translation", {0, 2}, {5, 1, 0, 5, 1, 0}}};
  return document;
}

}  // namespace lozenge::test_assets
