// lozenge::Error as Python's exceptions, which lozenge/errors.py declares: one class for each exit code.
#include <map>

#include "formats/base/error.h"
#include "tools/python/bindings.h"

namespace lozenge::python {
namespace {

namespace py = pybind11;

const char* class_of(ExitCode code) {
  switch (code) {
    case ExitCode::kUsage:
      return "UsageError";
    case ExitCode::kUnusableInput:
      return "UnusableInputError";
    case ExitCode::kUnsupported:
      return "UnsupportedError";
    case ExitCode::kLimit:
      return "LimitError";
    case ExitCode::kSystem:
      return "RefusedError";
    default:
      return "InternalError";
  }
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const py::object type = py::module_::import("lozenge.errors").attr(class_of(error.code()));
    PyErr_SetString(type.ptr(), error.what());
  }
}

}  // namespace

void bind_errors(const py::module_&) { py::register_exception_translator(&translate); }

}  // namespace lozenge::python
