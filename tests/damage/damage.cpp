#include "tests/damage/damage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "test_assets/documents.h"

namespace lozenge::damage {

namespace {

using test_assets::Shape;

/// The standard's engines give the same numbers everywhere; its distributions don't.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// In [0, count). \pre 0 < count
  std::size_t below(std::size_t count) { return engine_() % count; }
  double between(double low, double high) { return low + (high - low) * (engine_() * 0x1p-32); }
  /// Few or many of `count`, at least one: how much is damaged differs by orders of magnitude.
  std::size_t some_of(std::size_t count) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::pow(between(0, 0.7), 3) * count));
  }

 private:
  std::mt19937 engine_;
};

void append(Shape& to, const Shape& from, const Vec3f& moved) {
  const auto first = static_cast<std::int32_t>(to.positions.size());
  for (const Vec3f& p : from.positions) to.positions.push_back(p + moved);
  for (const auto& t : from.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Six faces with vertices of their own.
Shape cube() {
  const test_assets::Primitive primitive = test_assets::cube_document(4).meshes[0][0];
  Shape shape{primitive.positions, {}};
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = static_cast<std::int32_t>(primitive.indices[i + c]);
    shape.triangles.push_back(corners);
  }
  return shape;
}

/// Two rings melted together: genus 2.
Shape two_rings() {
  const auto ring = [](const Vec3d& p, double x) {
    const double from_axis = std::hypot(p.x - x, p.y) - 0.7;
    return from_axis * from_axis + p.z * p.z - 0.09;
  };
  const auto field = [&](const Vec3d& p) { return ring(p, -0.8) * ring(p, 0.8) - 0.05; };
  return test_assets::implicit_surface(field, {-2.2, -1.4, -0.8}, {2.2, 1.4, 0.8}, 0.3, 3);
}

Shape ring_and_ball() {
  Shape shape = test_assets::torus(1, 0.3, 16, 6);
  append(shape, test_assets::octasphere(1), {3, 0, 0});
  append(shape, test_assets::single_triangle(), {0, 0, 2});
  return shape;
}

struct Source {
  const char* name;
  Shape (*make)();
};

constexpr std::array kSources{
    Source{"sphere", [] { return test_assets::icosphere(2); }},
    Source{"ball", [] { return test_assets::octasphere(2); }},
    Source{"torus", [] { return test_assets::torus(1, 0.4, 20, 8); }},
    Source{"two rings", two_rings},
    Source{"ring, ball and triangle", ring_and_ball},
    Source{"cube", cube},
    Source{"disk", [] { return test_assets::disk(6); }},
    Source{"annulus", [] { return test_assets::annulus(24, 4); }},
    Source{"hemisphere", [] { return test_assets::hemisphere(3); }},
    Source{"plane", [] { return test_assets::plane(12, 8); }},
};

// Each does its damage and tells it.

std::string delete_triangles(Shape& shape, Random& random) {
  const std::size_t count = random.some_of(shape.triangles.size());
  for (std::size_t k = 0; k < count && shape.triangles.size() > 1; ++k) {
    shape.triangles.erase(shape.triangles.begin() + static_cast<std::ptrdiff_t>(random.below(shape.triangles.size())));
  }
  return fmt::format("{} triangles deleted", count);
}

/// What a brush leaves out: all triangles around a few vertices.
std::string cut_holes(Shape& shape, Random& random) {
  const std::size_t count = 1 + random.below(6);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3f at = shape.positions[random.below(shape.positions.size())];
    const double radius = random.between(0.05, 0.5);
    const auto is_near = [&](const std::array<std::int32_t, 3>& t) {
      return Vec3d(shape.positions[t[0]] - at).length() < radius;
    };
    if (!std::all_of(shape.triangles.begin(), shape.triangles.end(), is_near)) std::erase_if(shape.triangles, is_near);
  }
  return fmt::format("{} holes cut", count);
}

std::string turn_triangles(Shape& shape, Random& random) {
  const std::size_t count = random.some_of(shape.triangles.size());
  for (std::size_t k = 0; k < count; ++k) {
    auto& corners = shape.triangles[random.below(shape.triangles.size())];
    std::swap(corners[0], corners[1]);
  }
  return fmt::format("{} triangles turned over", count);
}

std::string duplicate_triangles(Shape& shape, Random& random) {
  const std::size_t count = random.some_of(shape.triangles.size());
  for (std::size_t k = 0; k < count; ++k) {
    auto corners = shape.triangles[random.below(shape.triangles.size())];
    if (random.below(2) == 0) std::swap(corners[1], corners[2]);
    shape.triangles.push_back(corners);
  }
  return fmt::format("{} triangles duplicated", count);
}

/// Any two, or two of one triangle.
std::array<std::int32_t, 2> two_vertices(const Shape& shape, Random& random) {
  if (random.below(2) == 0) {
    const auto& corners = shape.triangles[random.below(shape.triangles.size())];
    const std::size_t corner = random.below(3);
    return {corners[corner], corners[(corner + 1) % 3]};
  }
  const auto any = [&] { return static_cast<std::int32_t>(random.below(shape.positions.size())); };
  return {any(), any()};
}

std::string merge_vertices(Shape& shape, Random& random) {
  const std::size_t count = random.some_of(shape.positions.size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto [kept, gone] = two_vertices(shape, random);
    for (auto& corners : shape.triangles) std::replace(corners.begin(), corners.end(), gone, kept);
  }
  return fmt::format("{} vertices merged", count);
}

/// Exactly, or almost.
std::string move_vertices_onto_others(Shape& shape, Random& random) {
  const std::size_t count = random.some_of(shape.positions.size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto [to, from] = two_vertices(shape, random);
    shape.positions[from] = shape.positions[to];
    if (random.below(2) == 0) shape.positions[from].x = std::nextafter(shape.positions[from].x, 10.0F);
  }
  return fmt::format("{} vertices moved onto others", count);
}

/// In place, a little aside, or with a corner that touches.
std::string copy_all(Shape& shape, Random& random) {
  const Shape before = shape;
  const std::size_t how = random.below(3);
  const auto any = [&] { return before.positions[random.below(before.positions.size())]; };
  append(shape, before, how == 0 ? Vec3f(0, 0, 0) : how == 1 ? Vec3f(0.01F, 0.02F, 0.005F) : any() - any());
  return how == 0 ? "copied in place" : how == 1 ? "copied a little aside" : "copied to touch";
}

std::string copy_triangles(Shape& shape, Random& random) {
  Shape copied{shape.positions, {}};
  const std::size_t first = random.below(shape.triangles.size());
  const std::size_t count = std::min(shape.triangles.size() - first, random.some_of(shape.triangles.size()));
  copied.triangles.assign(shape.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                          shape.triangles.begin() + static_cast<std::ptrdiff_t>(first + count));
  append(shape, copied, {0, 0, 0.25F});
  return fmt::format("{} triangles copied", count);
}

std::string scale(Shape& shape, Random& random) {
  const float factor = random.below(2) == 0 ? 1e-6F : 1e6F;
  for (Vec3f& p : shape.positions) p *= factor;
  return fmt::format("scaled by {:g}", factor);
}

std::string squash(Shape& shape, Random& random) {
  const float factor = std::array{0.0F, 1e-4F, 0.01F}[random.below(3)];
  const std::size_t axis = random.below(3);
  for (Vec3f& p : shape.positions) p[static_cast<int>(axis)] *= factor;
  return fmt::format("squashed to {:g} along {}", factor, "xyz"[axis]);
}

/// Floats are then 1/16 apart.
std::string move_far(Shape& shape, Random& random) {
  Vec3f by(0, 0, 0);
  by[static_cast<int>(random.below(3))] = 1e6F;
  for (Vec3f& p : shape.positions) p += by;
  return "moved by 1e6";
}

std::string move_vertices_at_random(Shape& shape, Random& random) {
  const double most = std::pow(10, random.between(-4, 0));
  const std::size_t count = random.some_of(shape.positions.size());
  for (std::size_t k = 0; k < count; ++k) {
    Vec3f& p = shape.positions[random.below(shape.positions.size())];
    for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<float>(random.between(-most, most));
  }
  return fmt::format("{} vertices moved by up to {:.2g}", count, most);
}

constexpr std::array kDamages{
    delete_triangles,
    cut_holes,
    turn_triangles,
    duplicate_triangles,
    merge_vertices,
    move_vertices_onto_others,
    copy_all,
    copy_triangles,
    scale,
    squash,
    move_far,
    move_vertices_at_random,
};

/// Each vertex follows one or two of three joints, which were bound where they stand, and then turned, moved and
/// scaled.
void add_skin(test_assets::Document& document, Random& random) {
  test_assets::Primitive& primitive = document.meshes[0][0];
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const auto joint = static_cast<std::uint8_t>(random.below(3));
    const auto other = static_cast<std::uint8_t>((joint + 1) % 3);
    const auto share = static_cast<float>(random.below(5)) / 4;
    primitive.joints.push_back({joint, other, 0, 0});
    primitive.weights.push_back({1 - share, share, 0, 0});
  }
  test_assets::Skin& skin = document.skins.emplace_back();
  for (int j = 0; j < 3; ++j) {
    const double turn = random.between(-0.5, 0.5);
    test_assets::Node& joint = document.nodes.emplace_back();
    joint.name = fmt::format("joint {}", j);
    joint.rotation = {0, std::sin(turn), 0, std::cos(turn)};
    joint.translation = {random.between(-0.2, 0.2), 0, random.between(-0.2, 0.2)};
    joint.scale = {1, random.between(0.5, 2), 1};
    skin.joints.push_back(static_cast<std::int32_t>(document.nodes.size()) - 1);
    skin.inverse_binds.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    document.roots.push_back(skin.joints.back());
  }
  document.nodes[0].skin = 0;
}

/// One that moves all, and one that moves some.
void add_targets(test_assets::Document& document, Random& random) {
  test_assets::Primitive& primitive = document.meshes[0][0];
  const auto offset = [&] { return static_cast<float>(random.between(-0.3, 0.3)); };
  for (const std::size_t one_of : {1U, 5U}) {
    test_assets::Target& target = primitive.targets.emplace_back();
    target.name = fmt::format("one of {}", one_of);
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      const bool moves = random.below(one_of) == 0;
      target.offsets.push_back(moves ? Vec3f(offset(), offset(), offset()) : Vec3f(0, 0, 0));
    }
  }
}

}  // namespace

test_assets::Document damaged_document(const DamagedSurface& damaged, std::uint32_t seed) {
  test_assets::Document document = test_assets::simple_document("Damaged", damaged.shape, seed % 4 == 0);
  Random random(seed + 1);
  const std::uint32_t kind = seed % 5;
  if (kind == 1 || kind == 3) add_skin(document, random);
  if (kind == 2 || kind == 3) add_targets(document, random);
  return document;
}

DamagedSurface damaged_surface(std::uint32_t seed) {
  Random random(seed);
  const Source& source = kSources[seed % kSources.size()];
  DamagedSurface damaged{source.make(), source.name};
  const std::size_t count = 1 + random.below(3);
  for (std::size_t k = 0; k < count; ++k) {
    damaged.story += k == 0 ? ": " : ", ";
    damaged.story += kDamages[random.below(kDamages.size())](damaged.shape, random);
  }
  return damaged;
}

}  // namespace lozenge::damage
