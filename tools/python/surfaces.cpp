// Meshes and their maps: read, parameterize.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <tuple>

#include "formats/base/error.h"
#include "formats/domain/source_locator.h"
#include "formats/files/surface_builder.h"
#include "formats/patches/map_layout.h"
#include "formats/surface/canonical_form.h"
#include "pipeline/unwrap/origins.h"
#include "stages/bake/texel_sources.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "stages/pack/pack.h"
#include "stages/sample/sample.h"
#include "tools/python/arrays.h"
#include "tools/python/bindings.h"
#include "tools/python/work.h"

namespace lozenge::python {
namespace {

using MapPointer = std::shared_ptr<Map>;
using MeshPointer = std::shared_ptr<SourceMesh>;
using ImagePointer = std::shared_ptr<GeometryImage>;

py::array triangles_view(const std::vector<std::array<VertexId, 3>>& triangles, py::handle owner) {
  return view<VertexId>(triangles.empty() ? nullptr : triangles[0].data(), {length(triangles.size()), 3}, owner);
}

MeshPointer read(const std::filesystem::path& path, double fill_holes, bool strict, int threads,
                 const py::object& progress) {
  ImportOptions options;
  options.fill_holes = fill_holes;
  options.strict = strict;
  const Progress listener = progress_to(progress);
  const Work work(threads);
  auto mesh = std::make_shared<SourceMesh>(import_surface(path, options, listener));
  be_own_origin(*mesh);
  return mesh;
}

MapPointer mapped(SourceMesh mesh, const ParameterizeOptions& options, const Progress& progress) {
  require_manifold(mesh, mesh.origin);
  ParameterizeResult made = parameterize(std::move(mesh), options, progress);
  auto map = std::make_shared<Map>();
  if (std::string note = note_on_domain_size(made, options); !note.empty()) map->notes.push_back(std::move(note));
  map->surface = std::move(made.surface);
  map->map = std::move(made.map);
  map->distortion = made.distortion;
  return map;
}

/// Arrays as the importer takes a file: welded, mended, its holes filled.
SourceMesh surface_of(Primitive given, double fill_holes, std::vector<std::string>& notes) {
  SurfaceBuilder builder;
  builder.add(with_origins(given, 0), {}, "positions");
  given = {};
  SourceMesh mesh = builder.finish({}).mesh;
  ImportOptions options;
  options.fill_holes = fill_holes;
  RepairReport repairs;
  if (mesh.triangles.empty() || !mend(mesh, options, false, repairs)) {
    throw Error(ExitCode::kUnusableInput, "triangles: none has any area");
  }
  notes = repair_lines(repairs);
  forget_caps(mesh);
  mesh.scene_name = "arrays";
  mesh.origin = "arrays";
  make_canonical(mesh);
  return mesh;
}

MapPointer parameterize_arrays(const py::array& positions, const py::array& triangles, const py::object& faces,
                               const std::string& energy, double fill_holes, int threads, const py::object& progress) {
  Primitive given;
  given.positions = vectors_of(positions, "positions");
  given.triangles = triangles_of(triangles, given.vertices());
  const ParameterizeOptions options = parameterize_options(faces, energy);
  const Progress listener = progress_to(progress);
  const Work work(threads);
  std::vector<std::string> notes;
  MapPointer map = mapped(surface_of(std::move(given), fill_holes, notes), options, listener);
  map->notes.insert(map->notes.begin(), notes.begin(), notes.end());
  return map;
}

MapPointer parameterize_mesh(const MeshPointer& mesh, const py::object& faces, const std::string& energy, int threads,
                             const py::object& progress) {
  const ParameterizeOptions options = parameterize_options(faces, energy);
  const Progress listener = progress_to(progress);
  const Work work(threads);
  return mapped(*mesh, options, listener);
}

struct Samples {
  PatchSet patches;
};
using SamplesPointer = std::shared_ptr<Samples>;

SamplesPointer sample_map(const MapPointer& map, std::int32_t samples, double error, int threads,
                          const py::object& progress) {
  const Progress listener = progress_to(progress);
  const Work work(threads);
  return std::make_shared<Samples>(Samples{sample(map->surface, map->map, {samples, error}, listener)});
}

ImagePointer image_of(const SamplesPointer& samples) {
  const Work work;
  return std::make_shared<GeometryImage>(pack(samples->patches));
}

ImagePointer image_of_map(const MapPointer& map) {
  const Work work;
  return std::make_shared<GeometryImage>(pack(sample(map->surface, map->map)));
}

/// Points of the surface as points of the triangles that it was made of: their numbers, and weights of their corners.
struct OriginPoints {
  std::vector<std::int32_t> triangles;
  std::vector<float> weights;

  OriginPoints(const SourceMesh& surface, std::size_t count)
      : triangles(count, -1), weights(3 * count), origins(surface) {}

  void set(std::size_t n, const SourcePoint& point) {
    if (point.triangle < 0) return;
    triangles[n] = origins.of_triangle(point.triangle);
    std::array<WeightedElement, 3> corners;
    for (int c = 0; c < 3; ++c) corners[c] = {3 * static_cast<std::size_t>(point.triangle) + c, point.weights[c]};
    const Vec3f at = origins.weights(corners);
    for (int c = 0; c < 3; ++c) weights[3 * n + c] = at[c];
  }

 private:
  Origins origins;
};

/// That of maps, or of maps that nobody baked yet.
MapLayout atlas_of(const PatchLayout& patches, std::int32_t size, std::optional<std::int32_t> gutter,
                   const std::shared_ptr<Maps>& maps) {
  if (!maps) return make_map_layout(patches, size, gutter ? *gutter : default_gutter(patches, size));
  if (maps->maps.empty()) throw Error(ExitCode::kUsage, "maps: there are none whose atlas could be meant");
  const MapLayout& layout = maps->maps.front().layout;
  if (layout.width != size || (gutter && layout.gutter != *gutter) || !layout.fits(patches)) {
    throw Error(ExitCode::kUsage,
                fmt::format("maps: their atlas is another one, of {0} x {0} texels, gutter {1} and {2} "
                            "patches",
                            layout.width, layout.gutter, layout.patches()));
  }
  return layout;
}

py::tuple correspondence(const MapPointer& map, std::int32_t size, const ImagePointer& image,
                         std::optional<std::int32_t> gutter, const std::shared_ptr<Maps>& maps, int threads,
                         const py::object& progress) {
  const Progress listener = progress_to(progress);
  std::optional<OriginPoints> points;
  {
    const Work work(threads);
    const ImagePointer of = image ? image : std::make_shared<GeometryImage>(pack(sample(map->surface, map->map)));
    const MapLayout layout = atlas_of(of->layout, size, gutter, maps);
    const std::vector<SourcePoint> sources = texel_sources(map->surface, map->map, *of, layout, listener);
    points.emplace(map->surface, sources.size());
    for (std::size_t n = 0; n < sources.size(); ++n) points->set(n, sources[n]);
  }
  return py::make_tuple(taken(std::move(points->triangles), {size, size}),
                        taken(std::move(points->weights), {size, size, 3}));
}

/// Of all samples, patch by patch: not all patches have the same number.
py::tuple sample_sources(const Samples& samples, const Map& map) {
  const PatchSet& patches = samples.patches;
  const auto triangles = static_cast<TriangleId>(map.surface.triangles.size());
  const auto is_known = [&](TriangleId t) { return t < triangles; };
  if (!std::all_of(patches.source_triangles.begin(), patches.source_triangles.end(), is_known)) {
    throw Error(ExitCode::kUsage, "of: isn't the map that these are samples of");
  }
  OriginPoints points(map.surface, patches.source_triangles.size());
  for (std::size_t n = 0; n < patches.source_triangles.size(); ++n) {
    points.set(n, {patches.source_triangles[n], Vec3d(patches.source_weights[n])});
  }
  const auto count = length(patches.source_triangles.size());
  return py::make_tuple(taken(std::move(points.triangles), {count}), taken(std::move(points.weights), {count, 3}));
}

py::array domain_array(const MapPointer& map, py::handle owner) {
  const auto& triangles = map->map.domain.triangles;
  return view<DomainVertex>(triangles.data()->corners.data(), {length(triangles.size()), 3}, owner,
                            {sizeof(DomainTriangle), sizeof(DomainVertex)});
}

py::array neighbours_array(const MapPointer& map, py::handle owner) {
  const auto& triangles = map->map.domain.triangles;
  return view<std::int32_t>(&triangles.data()->neighbours[0].triangle, {length(triangles.size()), 3, 2}, owner,
                            {sizeof(DomainTriangle), sizeof(DomainSide), sizeof(std::int32_t)});
}

py::dict distortion_of(const MapPointer& map) {
  py::dict made;
  made["area"] = map->distortion.area;
  made["angle"] = map->distortion.angle;
  made["aggregate"] = map->distortion.aggregate;
  made["l2_stretch"] = map->distortion.l2_stretch;
  return made;
}

/// The property of an object that is an array which the object keeps.
template <typename Held, typename Get>
auto array_of(const Get& get) {
  return py::cpp_function([get](const py::object& self) { return get(self.cast<std::shared_ptr<Held>>(), self); });
}

void bind_mesh(py::module_& module) {
  py::class_<SourceMesh, MeshPointer>(module, "Mesh",
                                      "A surface as the importer makes it: welded, mended, small holes filled.")
      .def_property_readonly("positions", array_of<SourceMesh>([](const MeshPointer& m, py::handle self) {
                               return view(m->positions, self);
                             }),
                             "[vertices, 3], a view.")
      .def_property_readonly("triangles", array_of<SourceMesh>([](const MeshPointer& m, py::handle self) {
                               return triangles_view(m->triangles, self);
                             }),
                             "[triangles, 3], a view.")
      .def_readonly("origin", &SourceMesh::origin, "The name of the file that it came from.")
      .def_readonly("material_names", &SourceMesh::material_names, "Of the materials, in their order.");
}

void bind_map(py::module_& module) {
  py::class_<Map, MapPointer>(module, "Map")
      .def_property_readonly(
          "positions",
          array_of<Map>([](const MapPointer& m, py::handle self) { return view(m->surface.positions, self); }),
          "[vertices, 3] of the surface that is mapped: the source's, where long edges were split some more. A view.")
      .def_property_readonly("triangles", array_of<Map>([](const MapPointer& m, py::handle self) {
                               return triangles_view(m->surface.triangles, self);
                             }),
                             "[triangles, 3] of that surface, a view.")
      .def_property_readonly("domain_triangle", array_of<Map>([](const MapPointer& m, py::handle self) {
                               return view<std::int32_t>(&m->map.phi.data()->triangle, {length(m->map.phi.size())},
                                                         self, {sizeof(DomainPoint)});
                             }),
                             "[vertex] the domain triangle that it lies in, a view.")
      .def_property_readonly("alpha_beta", array_of<Map>([](const MapPointer& m, py::handle self) {
                               return view<double>(&m->map.phi.data()->alpha, {length(m->map.phi.size()), 2}, self,
                                                   {sizeof(DomainPoint), sizeof(double)});
                             }),
                             "[vertex, 2] the weights of that triangle's corners 0 and 1, multiples of 2^-40; a view.")
      .def_property_readonly("domain", array_of<Map>(domain_array),
                             "[domain triangle, 3] vertices of the domain, a view.")
      .def_property_readonly("neighbours", array_of<Map>(neighbours_array),
                             "[domain triangle, side, (triangle, side)]; -1, -1 at the boundary. A view.")
      .def_property_readonly("distortion", distortion_of,
                             "\"area\", \"angle\", \"aggregate\" (0: none), \"l2_stretch\" (1: none).")
      .def_readonly("notes", &Map::notes, "Sentences on repairs and on the domain's size.")
      .def("sample", sample_map, py::arg("samples") = 0, py::kw_only(), py::arg("error") = kUsualError,
           py::arg("threads") = 0, py::arg("progress") = py::none(),
           "Samples a side of each patch: 2^k + 1; 0: the fewest that hold the source to `error` (RMS, percent of its "
           "box's diagonal).")
      .def_property_readonly("geometry_image", image_of_map, "`sample().geometry_image`, made anew each time.")
      .def("_correspondence", correspondence);
}

void bind_samples(py::module_& module) {
  py::class_<Samples, SamplesPointer>(module, "Samples")
      .def_property_readonly(
          "samples", [](const Samples& s) { return s.patches.layout.samples; }, "N, a side of the largest patches.")
      .def_property_readonly(
          "patches", [](const Samples& s) { return s.patches.size(); }, "How many there are.")
      .def_property_readonly(
          "first",
          [](const Samples& s) {
            std::vector<std::int64_t> first;
            for (std::int32_t p = 0; p < s.patches.size(); ++p) first.push_back(length(s.patches.grids.first(p)));
            first.push_back(length(s.patches.grids.size()));
            const auto count = length(first.size());
            return taken(std::move(first), {count});
          },
          "[patches + 1] where each patch's samples begin, row by row.")
      .def_property_readonly("positions", array_of<Samples>([](const SamplesPointer& s, py::handle self) {
                               return view(s->patches.positions, self);
                             }),
                             "[all samples, 3], a view.")
      .def_property_readonly("normals", array_of<Samples>([](const SamplesPointer& s, py::handle self) {
                               return view(s->patches.normals, self);
                             }),
                             "[all samples, 3], unit, a view.")
      .def_property_readonly("geometry_image", image_of,
                             "The patches in an atlas, with levels of detail; made anew each time.")
      .def("_sources", sample_sources);
}

}  // namespace

ParameterizeOptions parameterize_options(const py::object& faces, const std::string& energy) {
  ParameterizeOptions options;
  if (py::isinstance<py::int_>(faces)) {
    options.min_domain_faces = options.max_domain_faces = faces.cast<std::int32_t>();
  } else if (!faces.is_none()) {
    std::tie(options.min_domain_faces, options.max_domain_faces) = faces.cast<std::pair<std::int32_t, std::int32_t>>();
  }
  const bool is_range = options.min_domain_faces >= 4 && options.max_domain_faces >= options.min_domain_faces;
  if (!faces.is_none() && !is_range) {
    throw Error(ExitCode::kUsage, "domain_faces: is a number from 4 on, or a pair of such, the lower one first");
  }
  if (energy == "mips") {
    options.energy = EnergyKind::kMips;
  } else if (energy == "symmetric-dirichlet") {
    options.energy = EnergyKind::kSymmetricDirichlet;
  } else if (energy != "isometric") {
    throw Error(ExitCode::kUsage, "energy: '" + energy + "' isn't isometric, mips or symmetric-dirichlet");
  }
  return options;
}

void bind_surfaces(py::module_& module) {
  bind_mesh(module);
  bind_samples(module);
  bind_map(module);
  module.def("read", read, py::arg("path"), py::kw_only(), py::arg("fill_holes") = ImportOptions{}.fill_holes,
             py::arg("strict") = false, py::arg("threads") = 0, py::arg("progress") = py::none(),
             "The surface of an asset in any format that the command reads. fill_holes: longest hole that is filled, "
             "in percent of the diagonal of its box; strict: refuse what needs repair.");
  module.def("_parameterize_mesh", parameterize_mesh);
  module.def("_parameterize_arrays", parameterize_arrays);
}

}  // namespace lozenge::python
