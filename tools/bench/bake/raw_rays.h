// What Embree alone takes for the rays of a bake: the same rays, in the same order, and nothing else.
//
// The program has functions of its own by the names of Embree's for packets, which the linker gives to the bake. They
// pass each packet on; and while someone listens, they keep it and trace it again, now and then, between two looks at
// the clock. So the rays are those that the bake asks for, however it comes to them.
#pragma once

#include <cstdint>
#include <memory>

namespace lozenge::bench {

/// Listens while it lives. One at a time; all rays come from one thread.
class RawRays {
 public:
  RawRays();
  ~RawRays();
  RawRays(const RawRays&) = delete;
  RawRays& operator=(const RawRays&) = delete;

  /// Traces what is left, which is also done when a scene goes.
  void finish();

  std::int64_t rays() const;
  /// Processor time of tracing them one by one: rtcIntersect1 and rtcOccluded1.
  double seconds_one_by_one() const;
  /// And in the bake's own packets: rtcIntersect16 and rtcOccluded16.
  double seconds_in_packets() const;

  struct Log;

 private:
  std::unique_ptr<Log> log_;
};

/// Processor time of this thread.
double thread_seconds();

}  // namespace lozenge::bench
