// Geometry images: read, write, their samples and their table of neighbours.
#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "formats/base/error.h"
#include "formats/files/geometry_image_file.h"
#include "tools/python/arrays.h"
#include "tools/python/bindings.h"
#include "tools/python/work.h"

namespace lozenge::python {
namespace {

using ImagePointer = std::shared_ptr<GeometryImage>;

ImagePointer read(const std::filesystem::path& path) {
  const Work work;
  return std::make_shared<GeometryImage>(read_geometry_image(path));
}

void write(const std::filesystem::path& path, const GeometryImage& image) {
  const Work work;
  write_geometry_image(path, image);
}

const GeometryLevel& level_of(const GeometryImage& image, std::size_t level) {
  if (level < image.levels.size()) return image.levels[level];
  throw Error(ExitCode::kUsage, fmt::format("level: {} isn't one of {}", level, image.levels.size()));
}

/// The picture of a level, a view.
py::array picture(const py::object& self, std::vector<Vec3f> GeometryLevel::*values, std::size_t level) {
  const auto& image = self.cast<const GeometryImage&>();
  const GeometryLevel& of = level_of(image, level);
  return view<float>(&(of.*values).data()->x, {GeometryImage::height(of), image.width(of), 3}, self);
}

/// The patches that exist on a level, one after the other: [patch, N, N, 3], a copy.
py::array grids(const GeometryImage& image, std::vector<Vec3f> GeometryLevel::*values, std::size_t level) {
  const GeometryLevel& of = level_of(image, level);
  const std::int32_t patches = image.layout.count_on(static_cast<std::int32_t>(level));
  const auto side = static_cast<std::size_t>(of.samples);
  std::vector<float> gathered;
  gathered.reserve(3 * side * side * static_cast<std::size_t>(patches));
  for (std::int32_t patch = 0; patch < patches; ++patch) {
    for (std::int32_t j = 0; j < of.samples; ++j) {
      const float* row = &(of.*values)[image.index(of, patch, 0, j)].x;
      gathered.insert(gathered.end(), row, row + 3 * side);
    }
  }
  return taken(std::move(gathered), {patches, of.samples, of.samples, 3});
}

/// Whether the surface has a sample: of halves of patches, at its boundary, only those where v >= u.
py::array mask(const GeometryImage& image, std::size_t level) {
  const GeometryLevel& of = level_of(image, level);
  const std::int32_t patches = image.layout.count_on(static_cast<std::int32_t>(level));
  std::vector<std::uint8_t> there;
  for (std::int32_t patch = 0; patch < patches; ++patch) {
    const bool is_whole = image.layout.places[patch].right.exists();
    for (std::int32_t j = 0; j < of.samples; ++j) {
      for (std::int32_t i = 0; i < of.samples; ++i) there.push_back(is_whole || j >= i ? 1 : 0);
    }
  }
  return taken(std::move(there), {patches, of.samples, of.samples}).attr("view")("bool");
}

py::array adjacency(const py::object& self) {
  const auto& sides = self.cast<const GeometryImage&>().layout.adjacency;
  return view<std::int32_t>(&sides.data()->data()->patch, {length(sides.size()), 4, 2}, self);
}

py::array places(const py::object& self) {
  const auto& of = self.cast<const GeometryImage&>().layout.places;
  static_assert(sizeof(PatchPlace) == 6 * sizeof(std::int32_t));
  return view<std::int32_t>(&of.data()->a, {length(of.size()), 6}, self);
}

}  // namespace

void bind_images(py::module_& module) {
  py::class_<GeometryImage, ImagePointer>(module, "GeometryImage")
      .def_property_readonly(
          "samples", [](const GeometryImage& image) { return image.layout.samples; },
          "N, a side of the patches on level 0.")
      .def_property_readonly("patches", &GeometryImage::size, "How many there are.")
      .def_property_readonly(
          "columns", [](const GeometryImage& image) { return image.columns; }, "Tiles side by side in the pictures.")
      .def_property_readonly(
          "levels", [](const GeometryImage& image) { return image.levels.size(); }, "Of detail; 0 is the finest.")
      .def_property_readonly(
          "first_levels",
          [](const GeometryImage& image) {
            std::vector<std::int32_t> levels;
            for (std::int32_t p = 0; p < image.size(); ++p) {
              levels.push_back(image.layout.first_level(p));
            }
            return taken(std::move(levels), {image.size()});
          },
          "[patch] the finest level that has it.")
      .def_property_readonly("adjacency", py::cpp_function(adjacency),
                             "[patch, side, (patch, side)] across each side; -1, -1 where the surface ends. Sides: "
                             "docs/format.md. A view.")
      .def_property_readonly(
          "places", py::cpp_function(places),
          "[patch, 6] on the domain: vertices a and b, triangle and side on the left, and on the right. A view.")
      .def(
          "position_picture",
          [](const py::object& self, std::size_t level) { return picture(self, &GeometryLevel::positions, level); },
          py::arg("level") = 0, "[height, width, 3]: the picture of all tiles, a view.")
      .def(
          "normal_picture",
          [](const py::object& self, std::size_t level) { return picture(self, &GeometryLevel::normals, level); },
          py::arg("level") = 0, "[height, width, 3] of unit normals, a view.")
      .def(
          "positions",
          [](const GeometryImage& image, std::size_t level) { return grids(image, &GeometryLevel::positions, level); },
          py::arg("level") = 0,
          "[patch, N, N, 3]: row j is v = j / (N - 1), column i is u; of the patches that the level has. A copy.")
      .def(
          "normals",
          [](const GeometryImage& image, std::size_t level) { return grids(image, &GeometryLevel::normals, level); },
          py::arg("level") = 0, "The same of unit normals.")
      .def("mask", mask, py::arg("level") = 0, "[patch, N, N]: whether the surface has the sample.")
      .def(
          "write", [](const GeometryImage& image, const std::filesystem::path& path) { write(path, image); },
          py::arg("path"), "Writes PATH and the JSON beside it.");
  module.def("read_geometry_image", read, py::arg("path"), "The image that a .gim.exr holds; all of it is checked.");
  module.def("write_geometry_image", write, py::arg("path"), py::arg("image"),
             "Writes PATH (.gim.exr) and the JSON beside it.");
}

}  // namespace lozenge::python
