#include "tools/python/arrays.h"

#include <fmt/format.h>

#include <cstring>

#include "formats/base/error.h"

namespace lozenge::python {
namespace {

void require_rows_of_three(const py::array& array, const std::string& name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  std::string shape;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    shape += fmt::format("{}{}", axis ? ", " : "", array.shape(axis));
  throw Error(ExitCode::kUsage, fmt::format("{}: has shape ({}), not (n, 3)", name, shape));
}

template <typename Index>
std::vector<std::array<std::uint32_t, 3>> checked(const py::array& array, std::size_t vertices) {
  const auto indices = py::array_t<Index, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!indices) throw py::error_already_set();
  std::vector<std::array<std::uint32_t, 3>> triangles(static_cast<std::size_t>(indices.shape(0)));
  const Index* from = indices.data();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t& corner : triangles[t]) {
      const Index index = *from++;
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
        throw Error(ExitCode::kUnusableInput,
                    fmt::format("triangles: triangle {} names vertex {}, of {}", t, index, vertices));
      }
      corner = static_cast<std::uint32_t>(index);
    }
  }
  return triangles;
}

}  // namespace

std::vector<float> vectors_of(const py::array& array, const std::string& name) {
  require_rows_of_three(array, name);
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!values) throw py::error_already_set();
  return {values.data(), values.data() + values.size()};
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const py::array& array, std::size_t vertices) {
  require_rows_of_three(array, "triangles");
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u') throw Error(ExitCode::kUsage, "triangles: are no integers");
  if (kind == 'i' && array.itemsize() == 4) return checked<std::int32_t>(array, vertices);
  return checked<std::int64_t>(array, vertices);
}

Progress progress_to(const py::object& callable) {
  return [&callable](std::string_view what, double done) {
    const py::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!callable.is_none()) callable(py::str(what.data(), what.size()), done);
  };
}

}  // namespace lozenge::python
