// The extension module behind the Python package `lozenge`. Everything that takes time runs without Python's lock.
#include "tools/python/bindings.h"

PYBIND11_MODULE(_lozenge, module) {
  using namespace lozenge::python;
  bind_errors(module);
  bind_images(module);
  bind_surfaces(module);
  bind_maps(module);
  bind_unwrap(module);
  bind_build(module);
}
