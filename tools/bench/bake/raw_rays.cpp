#include "tools/bench/bake/raw_rays.h"

#include <dlfcn.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "formats/base/error.h"

#if LOZENGE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace lozenge::bench {

namespace {

constexpr std::size_t kPacket = 16;
/// Packets that are kept before they are traced again: more than a few, so that looking at the clock takes no time, and
/// few enough for the processor's caches.
constexpr std::size_t kKept = 1024;

template <typename Query>
struct Packet {
  alignas(64) std::array<int, kPacket> valid;
  RTCScene scene;
  Query query;
};

/// Embree's own function, which ours hides.
template <typename Function>
Function* hidden(const char* name) {
  auto* function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  if (function == nullptr) throw Error(ExitCode::kInternal, std::string(name) + " isn't in a library of the program");
  return function;
}

/// Who listens. The functions below have Embree's signatures, so there is no other way for them to know.
RawRays::Log*& listener() {
  static RawRays::Log* one = nullptr;
  return one;
}

RTCRay ray_of(const RTCRay16& packet, std::size_t i) {
  RTCRay ray{};
  ray.org_x = packet.org_x[i];
  ray.org_y = packet.org_y[i];
  ray.org_z = packet.org_z[i];
  ray.dir_x = packet.dir_x[i];
  ray.dir_y = packet.dir_y[i];
  ray.dir_z = packet.dir_z[i];
  ray.tnear = packet.tnear[i];
  ray.tfar = packet.tfar[i];
  ray.mask = packet.mask[i];
  return ray;
}

template <typename Query>
std::int64_t rays_in(const std::vector<Packet<Query>>& packets) {
  std::int64_t count = 0;
  for (const Packet<Query>& packet : packets) count += std::count(packet.valid.begin(), packet.valid.end(), -1);
  return count;
}

#if LOZENGE_EMBREE_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query); }
void occlude(RTCScene scene, RTCRay& query) { rtcOccluded1(scene, &query); }
void intersect(Packet<RTCRayHit16>& packet) {
  static auto* const real = hidden<decltype(rtcIntersect16)>("rtcIntersect16");
  real(packet.valid.data(), packet.scene, &packet.query, nullptr);
}
void occlude(Packet<RTCRay16>& packet) {
  static auto* const real = hidden<decltype(rtcOccluded16)>("rtcOccluded16");
  real(packet.valid.data(), packet.scene, &packet.query, nullptr);
}
#else
RTCIntersectContext usual_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return context;
}
void intersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context = usual_context();
  rtcIntersect1(scene, &context, &query);
}
void occlude(RTCScene scene, RTCRay& query) {
  RTCIntersectContext context = usual_context();
  rtcOccluded1(scene, &context, &query);
}
void intersect(Packet<RTCRayHit16>& packet) {
  static auto* const real = hidden<decltype(rtcIntersect16)>("rtcIntersect16");
  RTCIntersectContext context = usual_context();
  real(packet.valid.data(), packet.scene, &context, &packet.query);
}
void occlude(Packet<RTCRay16>& packet) {
  static auto* const real = hidden<decltype(rtcOccluded16)>("rtcOccluded16");
  RTCIntersectContext context = usual_context();
  real(packet.valid.data(), packet.scene, &context, &packet.query);
}
#endif

}  // namespace

struct RawRays::Log {
  std::vector<Packet<RTCRayHit16>> hits;
  std::vector<Packet<RTCRay16>> sky;
  std::int64_t rays = 0;
  double one_by_one = 0;
  double in_packets = 0;

  template <typename Query>
  void keep(std::vector<Packet<Query>>& packets, const int* valid, RTCScene scene, const Query& query) {
    Packet<Query>& packet = packets.emplace_back();
    std::copy_n(valid, kPacket, packet.valid.begin());
    packet.scene = scene;
    packet.query = query;
    if (packets.size() >= kKept) trace();
  }

  void trace() {
    rays += rays_in(hits) + rays_in(sky);
    trace_one_by_one();
    const double start = thread_seconds();
    for (auto& packet : hits) intersect(packet);
    for (auto& packet : sky) occlude(packet);
    in_packets += thread_seconds() - start;
    hits.clear();
    sky.clear();
  }

 private:
  void trace_one_by_one() {
    std::vector<std::pair<RTCScene, RTCRayHit>> for_hits;
    std::vector<std::pair<RTCScene, RTCRay>> for_sky;
    for (const auto& packet : hits) {
      for (std::size_t i = 0; i < kPacket; ++i) {
        if (packet.valid[i] == 0) continue;
        RTCRayHit query{};
        query.ray = ray_of(packet.query.ray, i);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        for_hits.emplace_back(packet.scene, query);
      }
    }
    for (const auto& packet : sky) {
      for (std::size_t i = 0; i < kPacket; ++i) {
        if (packet.valid[i] != 0) for_sky.emplace_back(packet.scene, ray_of(packet.query, i));
      }
    }
    const double start = thread_seconds();
    for (auto& [scene, query] : for_hits) intersect(scene, query);
    for (auto& [scene, query] : for_sky) occlude(scene, query);
    one_by_one += thread_seconds() - start;
  }
};

RawRays::RawRays() : log_(std::make_unique<Log>()) { listener() = log_.get(); }
RawRays::~RawRays() { listener() = nullptr; }
void RawRays::finish() { log_->trace(); }
std::int64_t RawRays::rays() const { return log_->rays; }
double RawRays::seconds_one_by_one() const { return log_->one_by_one; }
double RawRays::seconds_in_packets() const { return log_->in_packets; }

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace lozenge::bench

extern "C" {

void rtcReleaseScene(RTCScene scene) {
  using namespace lozenge::bench;
  if (listener() != nullptr) listener()->trace();
  static auto* const real = hidden<decltype(rtcReleaseScene)>("rtcReleaseScene");
  real(scene);
}

#if LOZENGE_EMBREE_MAJOR >= 4
void rtcIntersect16(const int* valid, RTCScene scene, RTCRayHit16* rayhit, RTCIntersectArguments* args) {
  using namespace lozenge::bench;
  if (listener() != nullptr) listener()->keep(listener()->hits, valid, scene, *rayhit);
  static auto* const real = hidden<decltype(rtcIntersect16)>("rtcIntersect16");
  real(valid, scene, rayhit, args);
}
void rtcOccluded16(const int* valid, RTCScene scene, RTCRay16* ray, RTCOccludedArguments* args) {
  using namespace lozenge::bench;
  if (listener() != nullptr) listener()->keep(listener()->sky, valid, scene, *ray);
  static auto* const real = hidden<decltype(rtcOccluded16)>("rtcOccluded16");
  real(valid, scene, ray, args);
}
#else
void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* rayhit) {
  using namespace lozenge::bench;
  if (listener() != nullptr) listener()->keep(listener()->hits, valid, scene, *rayhit);
  static auto* const real = hidden<decltype(rtcIntersect16)>("rtcIntersect16");
  real(valid, scene, context, rayhit);
}
void rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* ray) {
  using namespace lozenge::bench;
  if (listener() != nullptr) listener()->keep(listener()->sky, valid, scene, *ray);
  static auto* const real = hidden<decltype(rtcOccluded16)>("rtcOccluded16");
  real(valid, scene, context, ray);
}
#endif

}  // extern "C"
