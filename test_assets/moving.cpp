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

/// Paint for all that a document has.
void paint(Document& document, const char* name, const std::vector<double>& colour) {
  document.materials = {{name, colour}};
  for (auto& mesh : document.meshes) {
    for (Primitive& primitive : mesh) primitive.material = 0;
  }
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
  paint(document, "Worm", {0.8, 0.3, 0.25, 1});
  return document;
}

namespace {

/// Along z, with a bump where x > 0.
Target grin(const Primitive& ball) {
  Target target{"grin", 0, {}, {}};
  for (std::size_t v = 0; v < ball.positions.size(); ++v) {
    const Vec3f& p = ball.positions[v];
    target.offsets.push_back(p.z > 0 ? Vec3f(0, 0, p.z * p.z) : Vec3f(0, 0, 0));
    // Of z + z^2 the derivative is 1 + 2 z; normals shrink by it.
    const Vec3f turned = p.z > 0 ? Vec3f(p.x, p.y, p.z / (1 + 2 * p.z)).normalized() : ball.normals[v];
    target.normals.push_back(p.z > 0 ? turned - ball.normals[v] : Vec3f(0, 0, 0));
  }
  return target;
}

Target wink(const Primitive& ball) {
  Target target{"wink", 0.25, {}, {}};
  for (const Vec3f& p : ball.positions) {
    const float depth = std::max(0.0F, (p.x - 0.5F) * 0.5F);
    target.offsets.push_back(depth > 0 ? Vec3f(-depth, 0, 0) : Vec3f(0, 0, 0));
  }
  return target;
}

}  // namespace

Document face_document() {
  Document document;
  document.scene_name = "Face";
  Primitive ball = primitive_of(octasphere(4), true);
  const Target idle{"idle", 0.5, std::vector<Vec3f>(ball.positions.size(), Vec3f(0, 0, 0)), {}};
  ball.targets = {grin(ball), idle, wink(ball)};
  document.meshes = {{ball}, {primitive_of(octasphere(3), true)}};
  document.nodes = {{.name = "Head", .children = {1}, .translation = {0, 1, 0}, .scale = {1, 1, 0.5}},
                    {.name = "Face", .mesh = 0, .rotation = {0, 0, kHalf, kHalf}},
                    {.name = "Stone", .mesh = 1, .translation = {3, 0, 0}}};
  document.roots = {0, 2};
  document.animations = {{"laugh", 1, "weights", {0, 1, 2}, {0, 0.5F, 0.25F, 1, 0.5F, 0, 0.5F, 0, 1}}};
  paint(document, "Skin", {0.75, 0.5, 0.3, 1});
  return document;
}

namespace {

constexpr float kPackedSteps = 64;  // of a unit, of whole numbers
const Vec3f kPackedShift(40, 40, 8);

/// A small worm from z = 0 on over two bones.
Primitive small_worm() {
  Primitive worm = primitive_of(octasphere(3), true);
  for (std::size_t v = 0; v < worm.positions.size(); ++v) {
    Vec3f& p = worm.positions[v];
    p = Vec3f(15 * p.x, 15 * p.y, 50 + 50 * p.z);
    const Vec3f& n = worm.normals[v];
    worm.normals[v] = Vec3f(n.x / 15, n.y / 15, n.z / 50).normalized();
  }
  bend(worm, 40);
  return worm;
}

/// Its positions as packers write them.
Primitive packed(Primitive worm) {
  for (Vec3f& p : worm.positions) {
    const Vec3f steps = (p + kPackedShift) * kPackedSteps;
    p = {std::round(steps.x), std::round(steps.y), std::round(steps.z)};
  }
  worm.quantized = true;
  return worm;
}

/// Of bone `b`, which is `length` long, for positions in whole numbers.
std::array<float, 16> packed_bind(int b, float length) {
  const float s = 1 / kPackedSteps;
  return {s,
          0,
          0,
          0,
          0,
          s,
          0,
          0,
          0,
          0,
          s,
          0,
          -kPackedShift.x,
          -kPackedShift.y,
          -kPackedShift.z - length * static_cast<float>(b),
          1};
}

std::array<float, 16> bind(int b, float length) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -length * static_cast<float>(b), 1};
}

}  // namespace

Document packed_worms_document() {
  constexpr float kBone = 40;
  Document document;
  document.scene_name = "Worms";
  Primitive first = packed(small_worm());
  for (std::size_t v = 0; v < first.positions.size(); ++v) {
    // Without any weight, a vertex belongs to its first joint.
    if (first.weights[v][0] == 1) first.weights[v] = {0, 0, 0, 0};
  }
  Primitive second = small_worm();
  for (Vec3f& p : second.positions) p.x += 60;
  Primitive third = small_worm();
  for (Vec3f& p : third.positions) p.x -= 60;
  document.meshes = {{first}, {second}, {third}};
  document.nodes = {
      {.name = "First", .mesh = 0, .skin = 0},
      {.name = "Second", .mesh = 1, .skin = 1},
      {.name = "Third", .mesh = 2, .skin = 2},
      {.name = "Bones", .children = {4}, .rotation = {-kHalf, 0, 0, kHalf}, .scale = {0.01, 0.01, 0.01}},
      {.name = "Tail", .children = {5}},
      {.name = "Middle", .children = {6}, .translation = {0, 0, kBone}, .scale = {1.5, 1, 0.75}},
      {.name = "Head", .translation = {0, 0, kBone}},
      {.name = "Other tail", .children = {8}, .rotation = {-kHalf, 0, 0, kHalf}, .scale = {0.01, 0.01, 0.01}},
      {.name = "Other middle", .children = {9}, .translation = {0, 0, kBone}},
      {.name = "Other head", .translation = {0, 0, kBone}}};
  document.roots = {0, 1, 2, 7};
  document.skins.resize(3);
  for (int b = 0; b < 3; ++b) {
    for (const int s : {0, 1}) document.skins[static_cast<std::size_t>(s)].joints.push_back(4 + b);
    document.skins[2].joints.push_back(7 + b);
    document.skins[0].inverse_binds.push_back(packed_bind(b, kBone));
    document.skins[1].inverse_binds.push_back(bind(b, kBone));
    document.skins[2].inverse_binds.push_back(bind(b, kBone));
  }
  const std::vector<float> turn{0, 0, 0, 1, 0.25F, 0, 0, 0.9682458F, 0, 0, 0, 1};
  document.animations = {{"bend", 5, "rotation", {0, 1, 2}, turn}, {"other", 8, "rotation", {0, 1, 2}, turn}};
  paint(document, "Worm", {0.8, 0.3, 0.25, 1});
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
  paint(document, "Wood", {0.4, 0.25, 0.1, 1});
  return document;
}

}  // namespace lozenge::test_assets
