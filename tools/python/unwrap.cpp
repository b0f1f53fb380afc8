// Texture coordinates for arrays: what `lozenge unwrap` does to a file.
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/files/surface_builder.h"
#include "formats/surface/canonical_form.h"
#include "pipeline/unwrap/unwrap_atlas.h"
#include "pipeline/unwrap/unwrap_meshes.h"
#include "stages/import/import_surface.h"
#include "tools/python/arrays.h"
#include "tools/python/bindings.h"
#include "tools/python/work.h"

namespace lozenge::python {
namespace {

/// Vertices as they go into arrays, each once: those of the mesh that was given, and some between them.
class NewVertices {
 public:
  explicit NewVertices(const Primitive& given) : given_(given) {}

  std::int32_t number_of(const VertexBetween& vertex) {
    std::array<std::uint32_t, 3> sources = vertex.vertices;
    std::array<float, 3> shares;
    std::copy(vertex.weights.begin(), vertex.weights.end(), shares.begin());
    if (vertex.is_old()) sources = {sources[0], sources[0], sources[0]};
    const Vec3f place = place_of(vertex);
    const Key key{sources, shares, {vertex.uv.x, vertex.uv.y}, {place.x, place.y, place.z}};
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::int32_t>(numbers_.size()));
    if (!is_new) return at->second;
    positions.insert(positions.end(), {place.x, place.y, place.z});
    uvs.insert(uvs.end(), {vertex.uv.x, vertex.uv.y});
    source_vertices.insert(source_vertices.end(), sources.begin(), sources.end());
    weights.insert(weights.end(), shares.begin(), shares.end());
    return at->second;
  }

  std::vector<float> positions;
  std::vector<float> uvs;
  std::vector<std::int32_t> source_vertices;
  std::vector<float> weights;

 private:
  using Key =
      std::tuple<std::array<std::uint32_t, 3>, std::array<float, 3>, std::array<float, 2>, std::array<float, 3>>;

  Vec3f given_position(std::uint32_t v) const {
    const float* p = &given_.positions[3 * static_cast<std::size_t>(v)];
    return {p[0], p[1], p[2]};
  }

  Vec3f place_of(const VertexBetween& vertex) const {
    if (vertex.is_old()) return given_position(vertex.vertices[0]);
    if (vertex.position) return *vertex.position;
    Vec3d sum(0, 0, 0);
    for (int c = 0; c < 3; ++c) sum += Vec3d(given_position(vertex.vertices[c])) * vertex.weights[c];
    return Vec3f(sum);
  }

  const Primitive& given_;
  std::map<Key, std::int32_t> numbers_;
};

CutPrimitives cut_arrays(const Primitive& given, const UnwrapOptions& options, const Progress& progress) {
  const GltfFile no_file;
  OriginTable origins(no_file);
  origins.add(0, 0, given);
  SurfaceBuilder builder;
  builder.add(with_origins(given, 0), {}, "positions");
  SourceMesh mesh = builder.finish({}).mesh;
  RepairReport repairs;
  if (mesh.triangles.empty() || !mend(mesh, options.import, false, repairs)) {
    throw Error(ExitCode::kUnusableInput, "triangles: none has any area");
  }
  forget_caps(mesh);
  mesh.origin = "arrays";
  make_canonical(mesh);
  std::vector<std::string> notes;
  CutPrimitives cut;
  add_cut_primitives(unwrap_surface(std::move(mesh), "arrays", options, progress, notes), origins, cut);
  add_left_out(origins, cut);
  return cut;
}

py::tuple unwrap_arrays(const py::array& positions, const py::array& triangles, std::int32_t map_size,
                        std::int32_t gutter, double texels_per_unit, const py::object& faces, double fill_holes,
                        int threads, const py::object& progress) {
  Primitive given;
  given.positions = vectors_of(positions, "positions");
  given.triangles = triangles_of(triangles, given.vertices());
  UnwrapOptions options;
  options.map_size = map_size;
  options.gutter = gutter;
  options.texels_per_unit = texels_per_unit;
  options.import.fill_holes = fill_holes;
  options.parameterize = parameterize_options(faces, "isometric");
  const Progress listener = progress_to(progress);
  NewVertices made(given);
  std::vector<std::int32_t> corners;
  {
    const Work work(threads);
    const CutPrimitives cut = cut_arrays(given, options, listener);
    for (const auto& triangle : cut.primitives.front().triangles) {
      for (const VertexBetween& corner : triangle) corners.push_back(made.number_of(corner));
    }
  }
  const auto vertices = length(made.uvs.size() / 2);
  const auto pieces = length(corners.size() / 3);
  return py::make_tuple(taken(std::move(made.positions), {vertices, 3}), taken(std::move(corners), {pieces, 3}),
                        taken(std::move(made.uvs), {vertices, 2}),
                        taken(std::move(made.source_vertices), {vertices, 3}),
                        taken(std::move(made.weights), {vertices, 3}));
}

}  // namespace

void bind_unwrap(py::module_& module) { module.def("_unwrap", unwrap_arrays); }

}  // namespace lozenge::python
