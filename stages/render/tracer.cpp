// Every pixel belongs to one thread and uses fixed patterns of samples, so the picture is the same on any number of
// them.
#include "stages/render/tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/boundary.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalfFieldOfView = 14 * kPi / 180;
/// Of the picture's half side that the object fills.
constexpr double kFill = 0.9;
/// Rays for the ambient occlusion of all vertices together, about a second's worth; per vertex within the two bounds.
constexpr std::int64_t kOcclusionRays = 4'000'000;
constexpr std::int64_t kFewestRays = 16;
constexpr std::int64_t kMostRays = 64;
/// The floor's shadow is computed on a grid of so many points a side.
constexpr std::int32_t kFloorGrid = 96;
constexpr int kFloorRays = 96;

struct Light {
  Vec3d direction;  ///< towards the light, in the camera's frame
  Vec3f colour;
};
const Light kKey{Vec3d(-0.55, 0.75, 0.65).normalized(), {1.10F, 1.06F, 0.99F}};
const Light kSide{Vec3d(0.9, 0.15, 0.55).normalized(), {0.20F, 0.23F, 0.28F}};
const Light kRim{Vec3d(0.45, 0.65, -0.75).normalized(), {0.42F, 0.45F, 0.50F}};
const Vec3f kSky{0.46F, 0.50F, 0.56F};
const Vec3f kGround{0.24F, 0.22F, 0.20F};
/// How far the key light's samples spread: the tangent of its half angle.
constexpr double kKeyRadius = 0.11;
/// Rays to the key light from each sample of a pixel.
constexpr int kKeyRays = 3;
/// Neighbouring pixels aim at different places of it; so many ways there are.
constexpr int kKeyPatterns = 16;

/// Where the key light grazes a smooth surface, its facets shadow each other; below this cosine the light fades early.
constexpr double kSoftTerminator = 0.35;
/// Shadows of what is nearer than this share of the object's size are left to the ambient occlusion.
constexpr double kShadowStart = 6e-3;

double smooth_step(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

double fraction(double x) { return x - std::floor(x); }

/// Point i of a low-discrepancy sequence in the unit square (multiples of 1/g and 1/g^2, g the plastic number).
Vec2d square_point(std::int64_t i) {
  const auto n = static_cast<double>(i);
  return {fraction(0.5 + n * 0.75487766624669276005), fraction(0.5 + n * 0.56984029099805326591)};
}

/// A unit vector around +z with a density that follows the cosine.
Vec3d cosine_direction(const Vec2d& s) {
  const double r = std::sqrt(s.x);
  const double angle = 2 * kPi * s.y;
  return {r * std::cos(angle), r * std::sin(angle), std::sqrt(1 - s.x)};
}

/// Two directions at right angles to a unit vector and each other.
std::pair<Vec3d, Vec3d> plane_of(const Vec3d& n) {
  const Vec3d away = std::abs(n.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  const Vec3d x = away.cross(n).normalized();
  return {x, n.cross(x)};
}

double unoccluded(const RayScene& scene, const Vec3d& at, const Vec3d& normal, int rays, double offset) {
  const auto [x, y] = plane_of(normal);
  std::array<Ray, RayScene::kPacket> packet;
  std::array<std::uint8_t, RayScene::kPacket> blocked{};
  int closed = 0;
  for (int first = 0; first < rays; first += RayScene::kPacket) {
    const int count = std::min<int>(RayScene::kPacket, rays - first);
    for (int i = 0; i < count; ++i) {
      const Vec3d d = cosine_direction(square_point(first + i));
      packet[i] = {at + normal * offset, x * d.x + y * d.y + normal * d.z};
    }
    closed += scene.occluded({packet.data(), static_cast<std::size_t>(count)}, blocked);
  }
  return 1 - static_cast<double>(closed) / rays;
}

/// [vertex] whether it is wanted
using Marked = std::vector<std::uint8_t>;

/// How much of the sky the vertices that are wanted see; 1 of others.
std::vector<float> vertex_occlusion(const RayScene& scene, const SurfaceView& surface, const Marked& wanted,
                                    const std::vector<Vec3f>& normals, double size) {
  std::vector<float> open(surface.positions.size(), 1.0F);
  const std::int64_t count = std::count(wanted.begin(), wanted.end(), 1);
  const auto rays =
      static_cast<int>(std::clamp(kOcclusionRays / std::max<std::int64_t>(count, 1), kFewestRays, kMostRays));
  for_each_index(open.size(), true, [&](std::size_t v) {
    const Vec3d n(normals[v]);
    if (wanted[v] == 0 || n.length() < 0.5) return;
    open[v] = static_cast<float>(unoccluded(scene, Vec3d(surface.positions[v]), n, rays, size * 1e-4));
  });
  return open;
}

struct Box {
  Vec3d low{0, 0, 0};
  Vec3d high{0, 0, 0};
  Vec3d middle() const { return (low + high) * 0.5; }
  double size() const { return std::max((high - low).length(), 1e-30); }
};

/// Of the vertices that triangles use.
Box box_of(const SurfaceView& surface) {
  Box box;
  bool first = true;
  for (const auto& t : surface.triangles) {
    for (const VertexId v : t) {
      const Vec3d p(surface.positions[v]);
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = first ? p[axis] : std::min(box.low[axis], p[axis]);
        box.high[axis] = first ? p[axis] : std::max(box.high[axis], p[axis]);
      }
      first = false;
    }
  }
  return box;
}

/// How much of the sky each place of the floor sees, on a grid around the object.
class Floor {
 public:
  Floor(const RayScene& scene, const Box& box) : height_(box.low.y), size_(box.size()) {
    const Vec3d middle = box.middle();
    corner_ = {middle.x - size_, middle.z - size_};
    open_.resize(static_cast<std::size_t>(kFloorGrid) * kFloorGrid);
    for_each_index(kFloorGrid, true, [&](std::size_t row) {
      const auto j = static_cast<std::int32_t>(row);
      for (std::int32_t i = 0; i < kFloorGrid; ++i) {
        const Vec3d at(corner_.x + (i + 0.5) * step(), height_ - 1e-3 * size_, corner_.y + (j + 0.5) * step());
        open_[row * kFloorGrid + i] = static_cast<float>(unoccluded(scene, at, {0, 1, 0}, kFloorRays, 0));
      }
    });
  }

  /// 1 where nothing is above; looking along the ray from the eye. 1 too where the ray misses the floor.
  double seen_along(const Vec3d& eye, const Vec3d& direction) const {
    if (!(direction.y < 0) || eye.y <= height_) return 1;
    const double t = (height_ - eye.y) / direction.y;
    const double x = (eye.x + direction.x * t - corner_.x) / step() - 0.5;
    const double y = (eye.z + direction.z * t - corner_.y) / step() - 0.5;
    if (!(x >= 0 && y >= 0 && x < kFloorGrid - 1 && y < kFloorGrid - 1)) return 1;
    const auto i = static_cast<std::int32_t>(x);
    const auto j = static_cast<std::int32_t>(y);
    const double fx = x - i;
    const double fy = y - j;
    const auto at = [&](std::int32_t a, std::int32_t b) { return open_[static_cast<std::size_t>(b) * kFloorGrid + a]; };
    const double open =
        (at(i, j) * (1 - fx) + at(i + 1, j) * fx) * (1 - fy) + (at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx) * fy;
    // The shadow fades out before the grid ends.
    const double edge = std::min({x, y, kFloorGrid - 1 - x, kFloorGrid - 1 - y}) / (0.25 * kFloorGrid);
    return 1 - (1 - open) * std::clamp(edge, 0.0, 1.0);
  }

 private:
  double step() const { return 2 * size_ / kFloorGrid; }

  double height_, size_;
  Vec2d corner_;
  std::vector<float> open_;
};

/// A light grey that is a little brighter in the middle.
Vec3f backdrop(double x, double y, const RenderOptions& options) {
  const double dx = 2 * x / options.width - 1;
  const double dy = 2 * y / options.height - 1;
  const double fall = std::clamp(0.17 * (dx * dx + dy * dy), 0.0, 1.0);
  const auto grey = static_cast<float>(0.86 * (1 - fall));
  return {grey * 0.985F, grey * 0.995F, grey};
}

Vec3f times(const Vec3f& a, const Vec3f& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// The rays of one pixel, and what became of them; kept from pixel to pixel.
struct PixelRays {
  std::vector<Vec2d> places;  ///< [sample] of the picture, in pixels
  std::vector<Ray> views;     ///< [sample]
  std::vector<RayHit> hits;   ///< [sample]

  std::vector<Ray> lights;            ///< to places of the key light
  std::vector<double> weights;        ///< [light] what it adds where nothing lies on it
  std::vector<std::size_t> of;        ///< [light] its sample
  std::vector<std::uint8_t> blocked;  ///< [light] whether something lies on it
};

}  // namespace

/// What a camera sees of a surface in the studio; the surface's own light is found for the vertices that it sees.
class Studio::Impl {
 public:
  Impl(const SurfaceView& surface, const std::vector<Vec3f>& normals, const RenderOptions& options)
      : surface_(surface),
        options_(options),
        camera_(surface, options),
        scene_(std::vector<Vec3f>(surface.positions.begin(), surface.positions.end()),
               std::vector<std::array<VertexId, 3>>(surface.triangles.begin(), surface.triangles.end())),
        box_(box_of(surface)),
        has_behind_(!boundary_sides(surface).empty()),
        key_directions_(key_directions()),
        floor_(scene_, box_) {
    Marked front(surface.positions.size(), 0);
    Marked behind(has_behind_ ? surface.positions.size() : 0, 0);
    mark_seen(front, behind);
    open_ = vertex_occlusion(scene_, surface, front, normals, box_.size());
    if (!has_behind_) return;
    std::vector<Vec3f> turned;
    for (const Vec3f& n : normals) turned.push_back(-n);
    open_behind_ = vertex_occlusion(scene_, surface, behind, turned, box_.size());
  }

  Picture picture(const LookFunction& look) const {
    Picture result(options_.width, options_.height, Vec3f(0, 0, 0));
    for_each_index(options_.height, true, [&](std::size_t row) {
      PixelRays rays;
      const auto y = static_cast<std::int32_t>(row);
      for (std::int32_t x = 0; x < options_.width; ++x) result.at(x, y) = pixel(x, y, look, rays);
    });
    return result;
  }

 private:
  /// A closed surface that is turned inside out stays dark.
  bool from_behind(const RayHit& hit) const { return !hit.front && has_behind_; }

  void trace_views(std::int32_t x, std::int32_t y, PixelRays& rays) const {
    const std::int32_t n = options_.subsamples;
    rays.places.clear();
    rays.views.clear();
    for (std::int32_t s = 0; s < n * n; ++s) {
      rays.places.emplace_back(x + (s % n + 0.5) / n, y + (s / n + 0.5) / n);
      rays.views.push_back({camera_.eye(), camera_.direction(rays.places.back().x, rays.places.back().y)});
    }
    rays.hits.resize(rays.views.size());
    scene_.closest_hits(rays.views, rays.hits);
  }

  /// The vertices whose light a picture needs.
  void mark_seen(Marked& front, Marked& behind) const {
    for_each_index(options_.height, true, [&](std::size_t row) {
      PixelRays rays;
      for (std::int32_t x = 0; x < options_.width; ++x) {
        trace_views(x, static_cast<std::int32_t>(row), rays);
        for (const RayHit& hit : rays.hits) {
          if (!hit.exists()) continue;
          Marked& side = from_behind(hit) ? behind : front;
          for (const VertexId v : surface_.triangles[hit.triangle]) {
            std::atomic_ref<std::uint8_t>(side[v]).store(1, std::memory_order_relaxed);
          }
        }
      }
    });
  }

  Vec3f pixel(std::int32_t x, std::int32_t y, const LookFunction& look_of, PixelRays& rays) const {
    trace_views(x, y, rays);
    const std::size_t samples = rays.views.size();
    std::vector<Look> looks(samples);
    for (std::size_t s = 0; s < samples; ++s) {
      if (!rays.hits[s].exists()) continue;
      looks[s] = look_of(surface_hit(rays, s), camera_);
      if (from_behind(rays.hits[s])) looks[s].normal = -looks[s].normal;
    }
    const std::vector<double> key = key_light(rays, looks, static_cast<std::size_t>(x * 7 + y * 3) % kKeyPatterns);
    Vec3f sum(0, 0, 0);
    for (std::size_t s = 0; s < samples; ++s) {
      const Vec3f c = rays.hits[s].exists() ? shade(rays, s, looks[s], key[s]) : surroundings(rays, s);
      // A highlight must not outweigh its neighbours.
      for (int k = 0; k < 3; ++k) sum[k] += std::min(c[k], 1.0F);
    }
    return sum / static_cast<float>(samples);
  }

  SurfaceHit surface_hit(const PixelRays& rays, std::size_t s) const {
    const RayHit& hit = rays.hits[s];
    return {hit.triangle, hit.weights, camera_.eye() + rays.views[s].direction * hit.distance, rays.places[s]};
  }

  Vec3f surroundings(const PixelRays& rays, std::size_t s) const {
    const double open = floor_.seen_along(camera_.eye(), rays.views[s].direction);
    return backdrop(rays.places[s].x, rays.places[s].y, options_) * static_cast<float>(0.25 + 0.75 * open);
  }

  Vec3f shade(const PixelRays& rays, std::size_t s, const Look& look, double key) const {
    const RayHit& hit = rays.hits[s];
    const std::vector<float>& seen = from_behind(hit) ? open_behind_ : open_;
    double open = 0;
    for (int c = 0; c < 3; ++c) open += hit.weights[c] * seen[surface_.triangles[hit.triangle][c]];
    const auto ambient_share = static_cast<float>((0.15 + 0.85 * open) * look.occlusion);
    const auto up = static_cast<float>(look.normal.y * 0.5 + 0.5);
    Vec3f light = (kGround * (1 - up) + kSky * up) * ambient_share;
    for (const Light* lamp : {&kSide, &kRim}) {
      const double cosine = std::max(look.normal.dot(camera_.world(lamp->direction)), 0.0);
      light += lamp->colour * static_cast<float>(cosine * open);
    }
    light += kKey.colour * static_cast<float>(key);
    // A broad, weak sheen, so that forms read on plain clay.
    const Vec3d half = (camera_.world(kKey.direction) - rays.views[s].direction).normalized();
    const double sheen = 0.06 * std::pow(std::max(look.normal.dot(half), 0.0), 24) * open;
    return times(look.albedo, light) + Vec3f(static_cast<float>(sheen));
  }

  /// [sample] cosine of the key light, as far as it is in sight.
  std::vector<double> key_light(PixelRays& rays, const std::vector<Look>& looks, std::size_t pattern) const {
    rays.lights.clear();
    rays.weights.clear();
    rays.of.clear();
    for (std::size_t s = 0; s < looks.size(); ++s) {
      if (!rays.hits[s].exists()) continue;
      for (int i = 0; i < kKeyRays; ++i) {
        const Vec3d& towards = key_directions_[kKeyRays * (s + pattern) + static_cast<std::size_t>(i)];
        const double cosine = looks[s].normal.dot(towards);
        if (cosine <= 0) continue;
        rays.lights.push_back(shadow_ray(rays, s, towards));
        rays.weights.push_back(cosine * smooth_step(cosine / kSoftTerminator) / kKeyRays);
        rays.of.push_back(s);
      }
    }
    rays.blocked.resize(rays.lights.size());
    scene_.occluded(rays.lights, rays.blocked);
    std::vector<double> sums(looks.size(), 0);
    for (std::size_t k = 0; k < rays.lights.size(); ++k) {
      if (rays.blocked[k] == 0) sums[rays.of[k]] += rays.weights[k];
    }
    return sums;
  }

  std::vector<Vec3d> key_directions() const {
    std::vector<Vec3d> directions;
    const auto [x, y] = plane_of(kKey.direction);
    const int samples = options_.subsamples * options_.subsamples;
    for (int i = 0; i < kKeyRays * (samples + kKeyPatterns); ++i) {
      const Vec2d s = square_point(i);
      const double r = kKeyRadius * std::sqrt(s.x);
      directions.push_back(camera_.world(
          (kKey.direction + x * (r * std::cos(2 * kPi * s.y)) + y * (r * std::sin(2 * kPi * s.y))).normalized()));
    }
    return directions;
  }

  Ray shadow_ray(const PixelRays& rays, std::size_t s, const Vec3d& towards) const {
    const RayHit& hit = rays.hits[s];
    const auto& [a, b, c] = surface_.triangles[hit.triangle];
    const Vec3d p(surface_.positions[a]);
    const Vec3d outside = (Vec3d(surface_.positions[b]) - p).cross(Vec3d(surface_.positions[c]) - p);
    const Vec3d face = from_behind(hit) ? -outside : outside;
    const double length = face.length();
    const double start = kShadowStart * box_.size();
    const Vec3d point = camera_.eye() + rays.views[s].direction * hit.distance;
    return {point + (length > 0 ? face / length : towards) * (0.1 * start), towards, start};
  }

  SurfaceView surface_;
  RenderOptions options_;
  Camera camera_;
  RayScene scene_;
  Box box_;
  bool has_behind_;                    ///< the surface has a boundary, so that its other side can be seen
  std::vector<Vec3d> key_directions_;  ///< [kKeyRays * (sample + pattern)] unit, towards the light
  std::vector<float> open_;            ///< [vertex] how much of the sky it sees
  std::vector<float> open_behind_;
  Floor floor_;
};

Camera::Camera(const SurfaceView& surface, const RenderOptions& options)
    : width_(options.width), height_(options.height) {
  const Vec3d towards(options.direction);
  back_ = towards.length() > 0 ? towards.normalized() : Vec3d(0, 0, 1);
  const Vec3d up = std::abs(back_.y) < 0.999 ? Vec3d(0, 1, 0) : Vec3d(0, 0, -1);
  right_ = up.cross(back_).normalized();
  up_ = back_.cross(right_);
  const double half_side = std::min(width_, height_) / 2;
  focal_ = half_side / std::tan(kHalfFieldOfView);

  // The middle of what is seen from far away, then the distance at which every vertex is inside.
  const Box box = box_of(surface);
  const Vec3d middle = box.middle();
  Vec2d low(0, 0), high(0, 0);
  for (const auto& t : surface.triangles) {
    for (const VertexId v : t) {
      const Vec3d p = Vec3d(surface.positions[v]) - middle;
      low = {std::min(low.x, p.dot(right_)), std::min(low.y, p.dot(up_))};
      high = {std::max(high.x, p.dot(right_)), std::max(high.y, p.dot(up_))};
    }
  }
  const Vec3d centre = middle + right_ * ((low.x + high.x) / 2) + up_ * ((low.y + high.y) / 2);
  double distance = box.size() * 1e-3;
  const double tangent_x = kFill * (width_ / 2) / focal_;
  const double tangent_y = kFill * (height_ / 2) / focal_;
  for (const auto& t : surface.triangles) {
    for (const VertexId v : t) {
      const Vec3d p = Vec3d(surface.positions[v]) - centre;
      distance = std::max({distance, p.dot(back_) + std::abs(p.dot(right_)) / tangent_x,
                           p.dot(back_) + std::abs(p.dot(up_)) / tangent_y});
    }
  }
  eye_ = centre + back_ * distance;
}

Vec3d Camera::direction(double x, double y) const {
  return (right_ * (x - width_ / 2) - up_ * (y - height_ / 2) - back_ * focal_).normalized();
}

Vec2d Camera::pixel(const Vec3d& point) const {
  const Vec3d p = point - eye_;
  const double scale = focal_ / std::max(-p.dot(back_), 1e-30);
  return {width_ / 2 + p.dot(right_) * scale, height_ / 2 - p.dot(up_) * scale};
}

double Camera::pixel_size(const Vec3d& point) const { return std::max(-(point - eye_).dot(back_), 0.0) / focal_; }

Studio::Studio(const SurfaceView& surface, const std::vector<Vec3f>& vertex_normals, const RenderOptions& options) {
  constexpr std::int32_t kLargestSide = 16384;
  if (options.width < 1 || options.height < 1 || options.width > kLargestSide || options.height > kLargestSide ||
      options.subsamples < 1 || options.subsamples > 16) {
    throw Error(ExitCode::kUsage, "a picture has 1 to 16384 pixels a side and 1 to 16 samples a side of a pixel");
  }
  impl_ = std::make_unique<Impl>(surface, vertex_normals, options);
}

Studio::~Studio() = default;

Picture Studio::picture(const LookFunction& look) const { return impl_->picture(look); }

Picture trace(const SurfaceView& surface, const std::vector<Vec3f>& vertex_normals, const LookFunction& look,
              const RenderOptions& options) {
  return Studio(surface, vertex_normals, options).picture(look);
}

}  // namespace lozenge
