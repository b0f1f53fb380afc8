// NumPy's arrays and our vectors: views of what lives in an object, arrays that own what was made for them, and the
// check of what comes from outside.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "formats/base/progress.h"
#include "formats/base/vector.h"

namespace lozenge::python {

namespace py = pybind11;

/// A view of memory that `owner` keeps alive. \param strides  in bytes; none: values follow each other
template <typename Value>
py::array view(const Value* values, std::vector<py::ssize_t> shape, py::handle owner,
               std::vector<py::ssize_t> strides = {}, bool writable = false) {
  py::array_t<Value> array(std::move(shape), std::move(strides), values, owner);
  if (!writable) array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An array that takes a vector over.
template <typename Value>
py::array taken(std::vector<Value> values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<Value>(std::move(values));
  const py::capsule owner(kept, [](void* held) { delete static_cast<std::vector<Value>*>(held); });
  return py::array_t<Value>(std::move(shape), kept->data(), owner);
}

inline py::ssize_t length(std::size_t count) { return static_cast<py::ssize_t>(count); }

/// [n, 3], a view.
inline py::array view(const std::vector<Vec3f>& vectors, py::handle owner) {
  return view<float>(vectors.empty() ? nullptr : &vectors[0].x, {length(vectors.size()), 3}, owner);
}

/// The numbers of an array [n, 3], copied once.
/// \throws Error(kUsage) where the shape is another one
std::vector<float> vectors_of(const py::array& array, const std::string& name);

/// The corners of triangles [m, 3].
/// \throws Error(kUsage) where the shape is another one or they aren't integers, Error(kUnusableInput) where one is no
/// vertex
std::vector<std::array<std::uint32_t, 3>> triangles_of(const py::array& array, std::size_t vertices);

/// Asks Python whether Ctrl-C was pressed, and calls `callable` unless it is None. It must outlive what is returned.
Progress progress_to(const py::object& callable);

}  // namespace lozenge::python
