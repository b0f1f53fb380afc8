#include "pipeline/unwrap/unwrap_meshes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/files/gltf_asset.h"
#include "formats/files/gltf_of_asset.h"
#include "formats/files/input_format.h"
#include "formats/files/readers/gltf/moving_nodes.h"
#include "formats/files/readers/gltf/primitive.h"
#include "formats/files/readers/gltf/scene.h"
#include "formats/files/surface_builder.h"
#include "formats/surface/canonical_form.h"
#include "pipeline/unwrap/unwrap_atlas.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

/// How much a placement makes of lengths, on the whole.
double scale_of(const Imath::M44d& m) {
  const Vec3d x(m[0][0], m[0][1], m[0][2]);
  const Vec3d y(m[1][0], m[1][1], m[1][2]);
  const Vec3d z(m[2][0], m[2][1], m[2][2]);
  const double volume = std::abs(x.dot(y.cross(z)));
  if (volume > 0) return std::cbrt(volume);
  return std::max({x.length(), y.length(), z.length()});  // flattened
}

/// What joints make of lengths, the mean of them.
double scale_of(const std::vector<Imath::M44d>& joints) {
  double logarithms = 0;
  int count = 0;
  for (const Imath::M44d& joint : joints) {
    const double scale = scale_of(joint);
    if (!(scale > 0)) continue;
    logarithms += std::log(scale);
    ++count;
  }
  return count > 0 ? std::exp(logarithms / count) : 1;
}

std::vector<int> triangle_primitives(const GltfFile& file, int mesh) {
  std::vector<int> found;
  for (int p = 0; p < static_cast<int>(file.model->meshes[mesh].primitives.size()); ++p) {
    if (holds_triangles(file, mesh, p)) found.push_back(p);
  }
  return found;
}

/// One mesh, welded and repaired.
SourceMesh surface_of_mesh(const GltfFile& file, const PlacedMesh& placed, const ImportOptions& options,
                           OriginTable& origins, RepairReport& repairs) {
  SurfaceBuilder builder;
  for (const int p : triangle_primitives(file, placed.mesh)) {
    const Primitive primitive = read_primitive(file, placed.mesh, p);
    const std::size_t number = origins.add(placed.mesh, p, primitive);
    builder.add(with_origins(primitive, origins.primitives()[number].first), {},
                file.name + ": " + primitive_place(placed.mesh, p));
  }
  SourceMesh mesh = builder.finish({}).mesh;
  if (mesh.triangles.empty() || !mend(mesh, options, false, repairs)) return mesh;
  forget_caps(mesh);
  for (Vec3f& p : mesh.positions) p = Vec3f(Vec3d(p) * placed.scale);
  return mesh;
}

void append(SourceMesh& mesh, const SourceMesh& more) {
  const auto first = static_cast<VertexId>(mesh.positions.size());
  const std::size_t corners = 3 * mesh.triangles.size();
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  join(mesh.corner_attributes, corners, more.corner_attributes, 3 * more.triangles.size());
}

Vec3f position_of(const OriginTable::Primitive& primitive, std::uint32_t vertex) {
  const float* p = &primitive.positions[3 * static_cast<std::size_t>(vertex)];
  return {p[0], p[1], p[2]};
}

/// The corner of its origin that a place is, or -1.
int corner_of_origin(const Vec3f& weights) {
  for (int c = 0; c < 3; ++c) {
    if (weights[c] == 1) return c;
  }
  return -1;
}

/// Where the vertices of a surface are: one that is a vertex of the document has its position, whatever else it lies
/// on; any other has one position for all primitives that it belongs to.
class PointsOfSurface {
 public:
  PointsOfSurface(const ChartedSurface& surface, const OriginTable& origins) : points_(surface.positions.size()) {
    for (const bool old : {true, false}) {
      for (const ChartedTriangle& t : surface.triangles) {
        if (t.group < 0) continue;
        const OriginTable::Primitive& from = origins.primitives()[origins.primitive_of(t.group)];
        const auto& corners = from.triangles[t.group - from.first];
        for (const ChartedCorner& corner : t.corners) {
          auto& point = points_[corner.vertex];
          const int own = corner_of_origin(corner.carried);
          if (point || (own >= 0) != old) continue;
          if (own >= 0) {
            point = position_of(from, corners[own]);
            continue;
          }
          Vec3d sum(0, 0, 0);
          for (int c = 0; c < 3; ++c) sum += Vec3d(position_of(from, corners[c])) * corner.carried[c];
          point = without_negative_zeros(Vec3f(sum));
        }
      }
    }
  }

  const Vec3f& operator[](VertexId v) const { return *points_[v]; }

 private:
  std::vector<std::optional<Vec3f>> points_;
};

std::vector<const ChartedTriangle*> in_order_of_origins(const ChartedSurface& surface) {
  std::vector<const ChartedTriangle*> order;
  for (const ChartedTriangle& t : surface.triangles) {
    if (t.group >= 0) order.push_back(&t);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->group < b->group; });
  return order;
}

VertexBetween vertex_between(const std::array<std::uint32_t, 3>& vertices, const Vec3d& weights) {
  VertexBetween made;
  made.vertices = vertices;
  made.weights = {weights.x, weights.y, weights.z};
  for (int c = 0; c < 3; ++c) {
    if (weights[c] != 1) continue;
    made.vertices[0] = vertices[c];
    made.weights = {1, 0, 0};
  }
  return made;
}

/// Weights of the origin's corners.
Vec3d weights_of(const VertexBetween& corner, const std::array<std::uint32_t, 3>& vertices) {
  Vec3d weights(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) {
      if (vertices[c] == corner.vertices[k] && (!corner.is_old() || k == 0)) weights[c] = corner.weights[k];
    }
  }
  return weights;
}

/// Twice the area of a piece in weights of its origin: negative where it faces the other way.
double area_in_origin(const std::array<VertexBetween, 3>& corners, const std::array<std::uint32_t, 3>& vertices) {
  const Vec3d a = weights_of(corners[0], vertices);
  const Vec3d across = (weights_of(corners[1], vertices) - a).cross(weights_of(corners[2], vertices) - a);
  return across.x + across.y + across.z;
}

/// Appends the pieces of one origin. Repair turns some triangles over; in the document they stay as they are. All
/// pieces are asked at once: the thinnest ones face any way in numbers that are rounded.
void append_facing_origin(std::vector<std::array<VertexBetween, 3>> pieces,
                          const std::array<std::uint32_t, 3>& vertices, CutPrimitive& primitive) {
  double area = 0;
  for (const auto& piece : pieces) area += area_in_origin(piece, vertices);
  for (auto& piece : pieces) {
    if (area < 0) std::swap(piece[1], piece[2]);
    primitive.triangles.push_back(piece);
  }
}

/// Triangles that repair left out of all surfaces.
class LeftOut {
 public:
  LeftOut(const OriginTable& origins, CutPrimitives& cut) : origins_(origins), cut_(cut) {}

  void add_all() {
    find_pieces();
    for (std::size_t p = 0; p < origins_.primitives().size(); ++p) {
      const OriginTable::Primitive& from = origins_.primitives()[p];
      for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        if (!cut_.there[static_cast<std::size_t>(from.first) + t]) add(p, from.triangles[t]);
      }
    }
  }

 private:
  using Place = std::array<float, 3>;
  using Key = std::array<Place, 3>;  ///< of a triangle, sorted

  struct Piece {
    std::array<Place, 3> corners;  ///< of its origin
    std::array<Vec3d, 3> weights;
    std::array<VertexBetween, 3> vertices;
  };

  static Place place_of(const OriginTable::Primitive& primitive, std::uint32_t vertex) {
    const Vec3f p = without_negative_zeros(position_of(primitive, vertex));
    return {p.x, p.y, p.z};
  }

  static std::array<Place, 3> places_of(const OriginTable::Primitive& primitive,
                                        const std::array<std::uint32_t, 3>& vertices) {
    return {place_of(primitive, vertices[0]), place_of(primitive, vertices[1]), place_of(primitive, vertices[2])};
  }

  static Key key_of(std::array<Place, 3> places) {
    std::sort(places.begin(), places.end());
    return places;
  }

  /// The pieces of triangles that one which was left out lies on, and a point in the atlas for each place.
  void find_pieces() {
    for (std::size_t p = 0; p < origins_.primitives().size(); ++p) {
      const OriginTable::Primitive& from = origins_.primitives()[p];
      for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        if (cut_.there[static_cast<std::size_t>(from.first) + t]) continue;
        pieces_[key_of(places_of(from, from.triangles[t]))];
      }
    }
    for (std::size_t p = 0; p < origins_.primitives().size(); ++p) {
      const OriginTable::Primitive& from = origins_.primitives()[p];
      // Pieces come in the order of their origins, and each origin that is there has some.
      std::size_t next = 0;
      for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        if (!cut_.there[static_cast<std::size_t>(from.first) + t]) continue;
        const auto places = places_of(from, from.triangles[t]);
        const auto wanted = pieces_.find(key_of(places));
        for (; next < cut_.primitives[p].triangles.size(); ++next) {
          const auto& piece = cut_.primitives[p].triangles[next];
          if (!belongs_to(piece, from.triangles[t])) break;
          note(piece, from, places, wanted);
        }
      }
    }
  }

  static bool belongs_to(const std::array<VertexBetween, 3>& piece, const std::array<std::uint32_t, 3>& vertices) {
    return std::all_of(piece.begin(), piece.end(), [&](const VertexBetween& corner) {
      const auto known = [&](std::uint32_t v) {
        return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
      };
      return corner.is_old() ? known(corner.vertices[0])
                             : std::all_of(corner.vertices.begin(), corner.vertices.end(), known);
    });
  }

  void note(const std::array<VertexBetween, 3>& piece, const OriginTable::Primitive& from,
            const std::array<Place, 3>& places, std::map<Key, std::vector<Piece>>::iterator wanted) {
    for (const VertexBetween& corner : piece) {
      if (corner.is_old()) uv_at_.try_emplace(place_of(from, corner.vertices[0]), corner.uv);
    }
    if (wanted == pieces_.end()) return;
    Piece& noted = wanted->second.emplace_back();
    noted.corners = places;
    noted.vertices = piece;
    for (int k = 0; k < 3; ++k) {
      noted.weights[k] = Vec3d(0, 0, 0);
      if (!piece[k].is_old()) {
        noted.weights[k] = {piece[k].weights[0], piece[k].weights[1], piece[k].weights[2]};
        continue;
      }
      const Place here = place_of(from, piece[k].vertices[0]);
      for (int c = 0; c < 3; ++c) {
        if (places[c] == here) noted.weights[k][c] = 1;
      }
    }
  }

  void add(std::size_t p, const std::array<std::uint32_t, 3>& vertices) {
    const OriginTable::Primitive& from = origins_.primitives()[p];
    const auto places = places_of(from, vertices);
    const std::vector<Piece>& pieces = pieces_.at(key_of(places));
    std::vector<std::array<VertexBetween, 3>> own;
    for (const Piece& piece : pieces) {
      std::array<VertexBetween, 3>& corners = own.emplace_back();
      for (int k = 0; k < 3; ++k) {
        Vec3d weights(0, 0, 0);
        for (int c = 0; c < 3; ++c) {
          const auto at = std::find(piece.corners.begin(), piece.corners.end(), places[c]);
          weights[c] = piece.weights[k][static_cast<int>(at - piece.corners.begin())];
        }
        corners[k] = vertex_between(vertices, weights);
        corners[k].position = piece.vertices[k].position;
        corners[k].uv = piece.vertices[k].uv;
      }
    }
    append_facing_origin(std::move(own), vertices, cut_.primitives[p]);
    if (!pieces.empty()) return;
    Vec2f uv(0, 0);
    for (const Place& place : places) {
      const auto at = uv_at_.find(place);
      if (at == uv_at_.end()) continue;
      uv = at->second;
      break;
    }
    std::array<VertexBetween, 3> corners;
    for (int c = 0; c < 3; ++c) {
      Vec3d weights(0, 0, 0);
      weights[c] = 1;
      corners[c] = vertex_between(vertices, weights);
      corners[c].uv = uv;
    }
    cut_.primitives[p].triangles.push_back(corners);
  }

  const OriginTable& origins_;
  CutPrimitives& cut_;
  std::map<Key, std::vector<Piece>> pieces_;
  std::map<Place, Vec2f> uv_at_;
};

}  // namespace

GltfDocument open_as_gltf(const std::filesystem::path& path, const ImportOptions& options,
                          std::vector<std::string>& notes) {
  const InputLimits limits{
      .max_memory = options.max_memory,
      .max_triangles = static_cast<std::uint64_t>(std::max<std::int64_t>(options.max_triangles, 0))};
  if (!is_gltf(path)) return gltf_of_asset(open_input(path, limits));
  Deviations deviations;
  GltfDocument document = open_gltf_document(path, limits, &deviations);
  for (std::string& note : deviations.notes(document.file.name)) notes.push_back(std::move(note));
  if (options.strict && !deviations.none()) {
    throw Error(ExitCode::kUnusableInput, document.file.name + ": " + notes.front() +
                                              "; --strict forbids that: mend the file, or leave out --strict");
  }
  return document;
}

std::vector<PlacedMesh> placed_meshes(const GltfFile& file) {
  std::map<int, double> scales;
  std::vector<InputInstance> instances = scene_instances(file);
  std::vector<std::string> about_animations;                       // which stay what they are
  const std::vector<MeshTargets> none(file.model->meshes.size());  // targets move no node
  const Rig rig = find_rig(file, none, instances, about_animations);
  const std::vector<Imath::M44d> standing = standing_transforms(rig);
  for (const InputInstance& instance : instances) {
    double& scale = scales[instance.mesh];
    scale = std::max(scale, instance.skin >= 0
                                ? scale_of(standing_joints(rig, static_cast<std::size_t>(instance.skin), standing))
                                : scale_of(instance.transform));
  }
  std::vector<PlacedMesh> meshes;
  for (const auto& [mesh, scale] : scales) {
    const std::string& name = file.model->meshes[mesh].name;
    meshes.push_back({mesh, name.empty() ? "mesh " + std::to_string(mesh) : name, scale > 0 ? scale : 1});
  }
  return meshes;
}

void require_sensible(const GltfFile& file, const std::vector<PlacedMesh>& meshes, const ImportOptions& options) {
  constexpr std::uint64_t kBytesOfTriangle = 1500;  // origins, and each vertex once for each triangle
  const auto most =
      static_cast<std::uint64_t>(std::clamp<std::int64_t>(options.max_triangles, 0, std::int64_t{1} << 29));
  std::uint64_t triangles = 0;
  for (const PlacedMesh& placed : meshes) {
    for (const int p : triangle_primitives(file, placed.mesh)) {
      triangles += primitive_size(file, placed.mesh, p).triangles;
      if (triangles > most) {
        throw Error(ExitCode::kLimit, file.name + ": has more than " + std::to_string(most) +
                                          " triangles; reduce it, or raise --max-triangles");
      }
    }
  }
  require_memory(file.memory + triangles * kBytesOfTriangle, options.max_memory,
                 file.name + ": unwrapping " + std::to_string(triangles) + " triangles");
}

std::size_t OriginTable::add(int mesh, int primitive, const lozenge::Primitive& values) {
  primitives_.push_back({mesh, primitive, size_, values.positions, values.triangles});
  size_ += static_cast<OriginNumber>(values.triangles.size());
  return primitives_.size() - 1;
}

std::size_t OriginTable::primitive_of(OriginNumber triangle) const {
  const auto after = std::upper_bound(primitives_.begin(), primitives_.end(), triangle,
                                      [](OriginNumber t, const Primitive& p) { return t < p.first; });
  return static_cast<std::size_t>(after - primitives_.begin()) - 1;
}

SourceMesh surface_of_meshes(const GltfFile& file, const std::vector<PlacedMesh>& meshes, const ImportOptions& options,
                             OriginTable& origins, std::vector<std::string>& notes) {
  SourceMesh surface;
  RepairReport repairs;
  for (const PlacedMesh& placed : meshes) append(surface, surface_of_mesh(file, placed, options, origins, repairs));
  surface.origin = file.name;
  make_canonical(surface);
  for (const std::string& line : repair_lines(repairs)) notes.push_back(line);
  if (options.strict && !repairs.none()) {
    throw Error(ExitCode::kUnusableInput, file.name + ": needs repair, which --strict forbids: " +
                                              repair_lines(repairs).front() + "; mend it, or leave out --strict");
  }
  return surface;
}

void add_cut_primitives(const UnwrappedSurface& unwrapped, const OriginTable& origins, CutPrimitives& cut) {
  for (std::size_t p = cut.primitives.size(); p < origins.primitives().size(); ++p) {
    cut.primitives.push_back({origins.primitives()[p].mesh, origins.primitives()[p].primitive, {}});
  }
  cut.there.resize(static_cast<std::size_t>(origins.size()), false);
  const PointsOfSurface points(unwrapped.surface, origins);
  const std::vector<const ChartedTriangle*> order = in_order_of_origins(unwrapped.surface);
  std::vector<std::array<VertexBetween, 3>> pieces;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const ChartedTriangle& t = *order[n];
    const std::size_t p = origins.primitive_of(t.group);
    const OriginTable::Primitive& from = origins.primitives()[p];
    const std::array<std::uint32_t, 3>& vertices = from.triangles[t.group - from.first];
    std::array<VertexBetween, 3>& piece = pieces.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const ChartedCorner& corner = t.corners[c];
      piece[c] = vertex_between(vertices, Vec3d(corner.carried));
      piece[c].position = points[corner.vertex];
      piece[c].uv = Vec2f(unwrapped.layout.texcoord(t.patch, corner.place));
    }
    if (n + 1 < order.size() && order[n + 1]->group == t.group) continue;
    cut.there[t.group] = true;
    append_facing_origin(std::exchange(pieces, {}), vertices, cut.primitives[p]);
  }
}

std::int64_t add_left_out(const OriginTable& origins, CutPrimitives& cut) {
  cut.there.resize(static_cast<std::size_t>(origins.size()), false);
  const auto left_out = static_cast<std::int64_t>(std::count(cut.there.begin(), cut.there.end(), false));
  if (left_out > 0) LeftOut(origins, cut).add_all();
  return left_out;
}

}  // namespace lozenge
