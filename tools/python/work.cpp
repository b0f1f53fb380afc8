#include "tools/python/work.h"

#include "formats/base/error.h"
#include "formats/files/openimageio.h"
#include "tools/threads.h"

namespace lozenge::python {
namespace {

int attribute(const char* name) {
  int value = 0;
  OIIO::getattribute(name, value);
  return value;
}

int checked(int threads) {
  if (threads >= 0) return threads;
  throw Error(ExitCode::kUsage, "threads: is a number from 1 on, or 0 for one for each core");
}

}  // namespace

struct Work::Limits {
  explicit Limits(int threads) : ours(threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);  // -1: none but the caller's
  }
  ~Limits() {
    OIIO::attribute("threads", image_threads);
    OIIO::attribute("exr_threads", exr_threads);
  }
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;

  int image_threads = attribute("threads");
  int exr_threads = attribute("exr_threads");
  ThreadLimit ours;
};

Work::Work(int threads) : limits_(checked(threads) > 0 ? std::make_unique<Limits>(threads) : nullptr) {}
Work::~Work() = default;

}  // namespace lozenge::python
