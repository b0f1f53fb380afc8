// The parts of the module: each adds its classes and functions.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "formats/domain/distortion.h"
#include "formats/domain/parameterization.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/parameterize.h"

namespace lozenge::python {

/// A surface and its map, whose corners know the triangles that they come from (pipeline/unwrap/origins.h).
struct Map {
  SourceMesh surface;
  Parameterization map;
  Distortion distortion;
  std::vector<std::string> notes;
};

/// Maps, and the texels of those that were replaced: somebody may still look at them.
struct Maps : BakedMaps {
  std::vector<std::vector<float>> replaced;
};

/// What lozenge.parameterize's keywords ask for. \param faces  None, a number, or a pair of them
ParameterizeOptions parameterize_options(const pybind11::object& faces, const std::string& energy);

void bind_errors(const pybind11::module_& module);
void bind_surfaces(pybind11::module_& module);
void bind_images(pybind11::module_& module);
void bind_maps(pybind11::module_& module);
void bind_unwrap(pybind11::module_& module);
void bind_build(pybind11::module_& module);

}  // namespace lozenge::python
