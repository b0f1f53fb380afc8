// Embree builds its tree in parallel, and which of two triangles is met first on their shared edge depends on the tree.
// So the tree is built in an arena of one thread: a million triangles take about a second, and every thread count gives
// the same tree, hence the same hits.
#include "formats/surface/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/nearest_point.h"

#if LOZENGE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace lozenge {

namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// \throws Error where Embree reported something since the last call
void require_no_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ExitCode::kLimit, "memory ran out while the mesh was prepared for ray tracing; give it more memory");
  }
  throw Error(ExitCode::kInternal, "Embree failed with its error " + std::to_string(static_cast<int>(error)) +
                                       "; check that the installed Embree supports this processor");
}

Device make_device() {
  Device device(rtcNewDevice(nullptr));
  if (!device) require_no_error(nullptr);
  return device;
}

Vec3d middle_of(const std::vector<Vec3f>& positions) {
  if (positions.empty()) return {0, 0, 0};
  Vec3f low = positions.front();
  Vec3f high = low;
  for (const Vec3f& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return (Vec3d(low) + Vec3d(high)) * 0.5;
}

/// More than rounding makes of a distance, by what is farthest from the origin. Of triangles that share what is nearest
/// the lowest counts, whichever of them rounding leaves a hair nearer to its box.
constexpr double kRoundings = 1e-12;

/// Of a point query, for triangles up to `distance`: a little more, so that rounding to float hides no equally near
/// one.
float search_radius(double distance, double slack) {
  return static_cast<float>((distance + slack) * (1 + 1e-6) + 1e-30);
}

/// No more than the squared distance of a point from any point of a triangle: that from its box.
double least_squared(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(std::min(t[0][axis], t[1][axis]), t[2][axis]);
    const double high = std::max(std::max(t[0][axis], t[1][axis]), t[2][axis]);
    const double away = std::max(std::max(low - p[axis], p[axis] - high), 0.0);
    sum += away * away;
  }
  return sum;
}

/// Which rays of a packet there are, as Embree wants to be told: -1 of those, 0 of others.
struct alignas(64) Valid : std::array<int, RayScene::kPacket> {};

Valid first_of(std::size_t count) {
  Valid valid{};
  std::fill_n(valid.begin(), count, -1);
  return valid;
}

/// What Embree makes of the end of a ray where something lies on it: minus infinity.
bool is_occluded(float end) { return end < 0; }

}  // namespace

struct RayScene::Impl {
  Vec3d origin{0, 0, 0};         ///< of the local frame, in the mesh's
  std::vector<Vec3f> positions;  ///< local
  std::vector<std::array<VertexId, 3>> triangles;
  double rounding = 0;  ///< of distances
  Device device;
  Scene scene;

  std::array<Vec3d, 3> corners(TriangleId t) const {
    const auto& [a, b, c] = triangles[t];
    return {Vec3d(positions[a]), Vec3d(positions[b]), Vec3d(positions[c])};
  }

  void upload();
  RTCRay local(const Ray& ray) const;
  /// As the i-th of a packet.
  void put(RTCRay16& packet, std::size_t i, const Ray& ray) const;
  RayHit hit(const Ray& ray, unsigned triangle, float u, float v, float distance) const;
};

void RayScene::Impl::upload() {
  device = make_device();
  scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!triangles.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), positions.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), triangles.size()));
    if (vertex && index) {
      for (const Vec3f& p : positions) vertex = std::copy_n(&p.x, 3, vertex);
      for (const auto& t : triangles) index = std::copy(t.begin(), t.end(), index);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene.get(), geometry);
    }
    rtcReleaseGeometry(geometry);
    require_no_error(device.get());
  }
  on_this_thread([&] { rtcJoinCommitScene(scene.get()); });
  require_no_error(device.get());
}

RTCRay RayScene::Impl::local(const Ray& ray) const {
  const Vec3f from(ray.origin - origin);
  const Vec3f along(ray.direction);
  RTCRay result{};
  result.org_x = from.x;
  result.org_y = from.y;
  result.org_z = from.z;
  result.dir_x = along.x;
  result.dir_y = along.y;
  result.dir_z = along.z;
  result.tnear = static_cast<float>(ray.nearest);
  result.tfar = static_cast<float>(ray.farthest);
  result.mask = ~0U;
  return result;
}

void RayScene::Impl::put(RTCRay16& packet, std::size_t i, const Ray& ray) const {
  const RTCRay one = local(ray);
  packet.org_x[i] = one.org_x;
  packet.org_y[i] = one.org_y;
  packet.org_z[i] = one.org_z;
  packet.dir_x[i] = one.dir_x;
  packet.dir_y[i] = one.dir_y;
  packet.dir_z[i] = one.dir_z;
  packet.tnear[i] = one.tnear;
  packet.tfar[i] = one.tfar;
  packet.mask[i] = one.mask;
}

RayHit RayScene::Impl::hit(const Ray& ray, unsigned triangle, float u_met, float v_met, float distance) const {
  RayHit hit;
  hit.triangle = static_cast<TriangleId>(triangle);
  const double u = std::clamp(static_cast<double>(u_met), 0.0, 1.0);
  const double v = std::clamp(static_cast<double>(v_met), 0.0, 1.0 - u);
  hit.weights = {1 - u - v, u, v};
  hit.distance = distance;
  const std::array<Vec3d, 3> t = corners(hit.triangle);
  hit.front = (t[1] - t[0]).cross(t[2] - t[0]).dot(ray.direction) < 0;
  return hit;
}

RayScene::RayScene(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles)
    : impl_(std::make_unique<Impl>()) {
  impl_->origin = middle_of(positions);
  impl_->positions.reserve(positions.size());
  double farthest = 0;
  for (const Vec3f& p : positions) {
    const Vec3d local = Vec3d(p) - impl_->origin;
    farthest = std::max({farthest, std::abs(local.x), std::abs(local.y), std::abs(local.z)});
    impl_->positions.emplace_back(local);
  }
  impl_->rounding = kRoundings * farthest;
  impl_->triangles = triangles;
  impl_->upload();
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

RayHit RayScene::closest_hit(const Ray& ray) const {
  RTCRayHit query{};
  query.ray = impl_->local(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if LOZENGE_EMBREE_MAJOR >= 4
  rtcIntersect1(impl_->scene.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene.get(), &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return impl_->hit(ray, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar);
}

void RayScene::closest_hits(std::span<const Ray> rays, std::span<RayHit> hits) const {
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::span<const Ray> packet = rays.subspan(first, std::min(kPacket, rays.size() - first));
    const Valid valid = first_of(packet.size());
    RTCRayHit16 query{};
    for (std::size_t i = 0; i < packet.size(); ++i) {
      impl_->put(query.ray, i, packet[i]);
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
#if LOZENGE_EMBREE_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid.data(), impl_->scene.get(), &query, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), impl_->scene.get(), &context, &query);
#endif
    for (std::size_t i = 0; i < packet.size(); ++i) {
      const bool met = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      hits[first + i] =
          met ? impl_->hit(packet[i], query.hit.primID[i], query.hit.u[i], query.hit.v[i], query.ray.tfar[i])
              : RayHit();
    }
  }
}

bool RayScene::occluded(const Ray& ray) const {
  RTCRay query = impl_->local(ray);
#if LOZENGE_EMBREE_MAJOR >= 4
  rtcOccluded1(impl_->scene.get(), &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene.get(), &context, &query);
#endif
  return is_occluded(query.tfar);
}

std::int32_t RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  std::int32_t count = 0;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::span<const Ray> packet = rays.subspan(first, std::min(kPacket, rays.size() - first));
    const Valid valid = first_of(packet.size());
    RTCRay16 query{};
    for (std::size_t i = 0; i < packet.size(); ++i) impl_->put(query, i, packet[i]);
#if LOZENGE_EMBREE_MAJOR >= 4
    rtcOccluded16(valid.data(), impl_->scene.get(), &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid.data(), impl_->scene.get(), &context, &query);
#endif
    for (std::size_t i = 0; i < packet.size(); ++i) {
      blocked[first + i] = is_occluded(query.tfar[i]);
      count += blocked[first + i];
    }
  }
  return count;
}

NearestPoint RayScene::nearest(const Vec3d& p, double radius) const { return nearest_of({}, p, radius); }

NearestPoint RayScene::nearest_from(TriangleId close, const Vec3d& p) const {
  if (close < 0) return nearest(p);
  const std::array<Vec3d, 3> corners = impl_->corners(close);
  const Vec3d local = p - impl_->origin;
  const double most = (point_at(corners, nearest_weights(local, corners)) - local).length();
  return nearest(p, most + impl_->rounding);
}

NearestPoint RayScene::nearest_of(const std::function<bool(TriangleId)>& counts, const Vec3d& p, double radius) const {
  struct State {
    const Impl& scene;
    const std::function<bool(TriangleId)>& counts;
    Vec3d p;       ///< local
    double slack;  ///< how far off the rounded point is that the tree is searched from
    double squared;
    double passed_by;  ///< as `squared`, and a rounding more: of boxes that are farther no triangle is asked
    NearestPoint best;
  };
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) -> bool {
    State& s = *static_cast<State*>(arguments->userPtr);
    const auto t = static_cast<TriangleId>(arguments->primID);
    const std::array<Vec3d, 3> corners = s.scene.corners(t);
    if (least_squared(s.p, corners) > s.passed_by) return false;
    const Vec3d weights = nearest_weights(s.p, corners);
    const Vec3d point = point_at(corners, weights);
    const Vec3d away = point - s.p;
    const double squared = away.dot(away);
    const bool better = squared < s.squared || (squared == s.squared && (!s.best.exists() || t < s.best.triangle));
    if (!better || (s.counts && !s.counts(t))) return false;
    s.squared = squared;
    s.best = {t, weights, point, std::sqrt(squared)};
    s.passed_by = std::pow(s.best.distance + s.scene.rounding, 2);
    const float reach = search_radius(s.best.distance, s.slack);
    if (reach >= arguments->query->radius) return false;
    arguments->query->radius = reach;
    return true;
  };
  const Vec3d local = p - impl_->origin;
  const Vec3f at(local);
  State state{
      *impl_, counts, local, (Vec3d(at) - local).length(), radius * radius, std::pow(radius + impl_->rounding, 2), {}};
  RTCPointQuery query{};
  query.x = at.x;
  query.y = at.y;
  query.z = at.z;
  query.radius = search_radius(radius, state.slack);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene.get(), &query, &context, visit, &state);
  if (state.best.exists()) state.best.point += impl_->origin;
  return state.best;
}

}  // namespace lozenge
