// The whole way from a file to an asset, as the command `build` goes it.
#include "pipeline/build.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/arrays.h"
#include "tools/python/bindings.h"
#include "tools/python/work.h"

namespace lozenge::python {
namespace {

py::tuple build(const std::filesystem::path& path, const std::filesystem::path& folder, const std::string& name,
                const py::object& faces, std::int32_t samples, double error, std::int32_t map_size,
                std::int64_t triangle_budget, double fill_holes, bool preview, bool arrays, int threads,
                const py::object& progress) {
  BuildOptions options;
  options.folder = folder;
  options.name = name;
  options.parameterize = parameterize_options(faces, "isometric");
  options.sample = {samples, error};
  options.bake.size = map_size;
  options.asset.triangle_budget = triangle_budget;
  options.asset.error = error;
  options.import.fill_holes = fill_holes;
  options.preview = preview;
  options.arrays = arrays;
  const Progress listener = progress_to(progress);
  BuildResult made;
  {
    const Work work(threads);
    made = build_asset(path, options, listener);
  }
  return py::make_tuple(made.files, made.notes, report_json(made.report));
}

}  // namespace

void bind_build(py::module_& module) { module.def("_build", build); }

}  // namespace lozenge::python
