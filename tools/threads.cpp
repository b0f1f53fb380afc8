#include "tools/threads.h"

#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

namespace lozenge {

struct ThreadLimit::Control {
  explicit Control(int threads)
      : tbb(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control tbb;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) threads = tbb::info::default_concurrency();
  control_ = std::make_unique<Control>(threads);
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);  // -1: none but the caller's
  Imf::setGlobalThreadCount(threads == 1 ? 0 : threads);        // 0: none but the caller's
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace lozenge
