// Work that takes time: done without Python's lock, on as many threads as the caller asks for.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

namespace lozenge::python {

/// While it lives, other threads of Python run, and Lozenge, oneTBB, OpenEXR and OpenImageIO use no more threads than
/// were asked for. That is so for the whole process: of several at once, the lowest number counts.
class Work {
 public:
  /// \param threads  0: one for each core that the process may use
  /// \throws Error(kUsage) where it is negative
  explicit Work(int threads = 0);
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

 private:
  struct Limits;
  std::unique_ptr<Limits> limits_;         // none where nobody asked for any
  pybind11::gil_scoped_release unlocked_;  // goes first, so that limits end with the lock held
};

}  // namespace lozenge::python
