#include "tools/threads.h"

#include <OpenEXR/ImfThreading.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

namespace lozenge {

struct ThreadLimit::Control {
  explicit Control(int threads)
      : tbb(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control tbb;
  int exr_threads = Imf::globalThreadCount();  ///< before
};

ThreadLimit::ThreadLimit(int threads) : threads_(threads > 0 ? threads : tbb::info::default_concurrency()) {
  control_ = std::make_unique<Control>(threads_);
  Imf::setGlobalThreadCount(threads_ == 1 ? 0 : threads_);  // 0: none but the caller's
}

ThreadLimit::~ThreadLimit() { Imf::setGlobalThreadCount(control_->exr_threads); }

}  // namespace lozenge
