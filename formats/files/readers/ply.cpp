// Everything is read as numbers by the header's types, element by element; what isn't needed is dropped at once.
#include "formats/files/readers/ply.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "formats/files/readers/input_file.h"
#include "formats/files/readers/ply_header.h"
#include "formats/files/readers/ply_values.h"
#include "formats/files/readers/polygon_mesh.h"
#include "formats/files/readers/vertex_colors.h"

namespace lozenge {

namespace {

/// The largest that a whole number of a file may be: so that nothing overflows that is added to it.
constexpr double kLargest = 1e15;

/// Which properties of a vertex make one of its attributes; -1 for one that isn't there.
template <std::size_t N>
using Columns = std::array<int, N>;

template <std::size_t N>
bool has_first(const Columns<N>& columns, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    if (columns[k] < 0) return false;
  }
  return true;
}

struct VertexColumns {
  Columns<3> position;
  Columns<3> normal;
  Columns<4> color;
  Columns<2> uv;

  explicit VertexColumns(const PlyElement& e)
      : position{e.find({"x"}, false), e.find({"y"}, false), e.find({"z"}, false)},
        normal{e.find({"nx"}, false), e.find({"ny"}, false), e.find({"nz"}, false)},
        color{e.find({"red", "r", "diffuse_red"}, false), e.find({"green", "g", "diffuse_green"}, false),
              e.find({"blue", "b", "diffuse_blue"}, false), e.find({"alpha", "a", "diffuse_alpha"}, false)},
        uv{e.find({"s", "u", "texture_u"}, false), e.find({"t", "v", "texture_v"}, false)} {}

  bool has_normals() const { return has_first(normal, 3); }
  bool has_colors() const { return has_first(color, 3); }
  bool has_uvs() const { return has_first(uv, 2); }
};

/// What stands for one in an integer colour.
double full_color(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 255;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 65535;
    case PlyType::kInt32:
    case PlyType::kUint32:
      return 4294967295.0;
    default:
      return 1;
  }
}

/// The file's elements, as they come.
class PlyReader {
 public:
  PlyReader(TextScanner& scanner, const std::string& name, const PlyHeader& header, const InputLimits& limits)
      : header_(header),
        values_(ply_values(scanner, header.encoding)),
        mesh_(name, limits, {.unit = values_->unit()}) {}

  InputAsset read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        pass(element);
      }
    }
    return mesh_.finish();
  }

 private:
  const PlyHeader& header_;
  std::unique_ptr<PlyValues> values_;
  PolygonMesh mesh_;
  bool vertices_have_normals_ = false;
  bool vertices_have_uvs_ = false;
  bool has_vertices_ = false;

  /// [property] its value, of one vertex; nothing of lists.
  using Row = std::vector<double>;

  void pass_list(const PlyProperty& property) {
    const std::int64_t count = values_->next_count(property);
    for (std::int64_t k = 0; k < count; ++k) values_->next(property);
  }

  void pass(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::int64_t e = 0; e < element.count; ++e) {
      for (const PlyProperty& property : element.properties) {
        if (property.is_list()) {
          pass_list(property);
        } else {
          values_->next(property);
        }
      }
    }
  }

  void read_vertices(const PlyElement& element) {
    const VertexColumns columns(element);
    if (!has_first(columns.position, 3)) values_->refuse("its vertices have no x, y and z");
    if (has_vertices_) values_->refuse("it has the element 'vertex' twice");
    has_vertices_ = true;
    vertices_have_normals_ = columns.has_normals();
    vertices_have_uvs_ = columns.has_uvs();
    mesh_.reserve(static_cast<std::uint64_t>(element.count), triangles_to_come());
    Row row(element.properties.size());
    for (std::int64_t v = 0; v < element.count; ++v) {
      const std::int64_t place = values_->place();
      for (std::size_t p = 0; p < row.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list()) {
          pass_list(property);
        } else {
          row[p] = values_->next(property);
        }
      }
      add_vertex(element, columns, row, place);
    }
  }

  /// As many as the faces, if they are triangles.
  std::uint64_t triangles_to_come() const {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "face") return static_cast<std::uint64_t>(element.count);
    }
    return 0;
  }

  void add_vertex(const PlyElement& element, const VertexColumns& columns, const Row& row, std::int64_t place) {
    const auto value = [&](int column) { return static_cast<float>(row[static_cast<std::size_t>(column)]); };
    const auto& [x, y, z] = columns.position;
    mesh_.add_position({value(x), value(y), value(z)}, place);
    if (vertices_have_normals_) {
      const auto& [nx, ny, nz] = columns.normal;
      mesh_.add_normal({value(nx), value(ny), value(nz)});
    }
    if (vertices_have_uvs_) mesh_.add_uv({value(columns.uv[0]), value(columns.uv[1])});
    if (!columns.has_colors()) return;
    Vec4f color(1, 1, 1, kOpaque);
    for (int c = 0; c < 4; ++c) {
      const int column = columns.color[static_cast<std::size_t>(c)];
      if (column < 0) continue;
      const auto at = static_cast<std::size_t>(column);
      color[c] = static_cast<float>(row[at] / full_color(element.properties[at].type));
    }
    mesh_.add_color(color);
  }

  std::int64_t next_index(const PlyProperty& property) {
    const double value = values_->next(property);
    if (!(std::abs(value) < kLargest) || value != std::floor(value)) {
      values_->refuse(fmt::format("{} is {}, which is no number of a vertex", property.name, value));
    }
    return static_cast<std::int64_t>(value);
  }

  void read_faces(const PlyElement& element) {
    const int corner_list = element.find({"vertex_indices", "vertex_index"}, true);
    const int uv_list = element.find({"texcoord"}, true);
    if (corner_list < 0) return pass(element);
    std::vector<PolygonCorner> corners;
    std::vector<Vec2f> uvs;
    for (std::int64_t f = 0; f < element.count; ++f) {
      const std::int64_t place = values_->place();
      corners.clear();
      uvs.clear();
      for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
        const PlyProperty& property = element.properties[static_cast<std::size_t>(p)];
        if (p == corner_list) {
          read_corners(property, corners);
        } else if (p == uv_list) {
          read_uvs(property, uvs);
        } else if (property.is_list()) {
          pass_list(property);
        } else {
          values_->next(property);
        }
      }
      add_face(corners, uvs, place);
    }
  }

  /// Of a list that is kept.
  std::int64_t sensible_count(const PlyProperty& property) {
    const std::int64_t count = values_->next_count(property);
    mesh_.require_sensible_polygon(static_cast<std::uint64_t>(count), values_->place());
    return count;
  }

  void read_corners(const PlyProperty& property, std::vector<PolygonCorner>& corners) {
    const std::int64_t count = sensible_count(property);
    for (std::int64_t k = 0; k < count; ++k) corners.push_back({next_index(property)});
  }

  void read_uvs(const PlyProperty& property, std::vector<Vec2f>& uvs) {
    const std::int64_t count = sensible_count(property);
    for (std::int64_t k = 0; k + 1 < count; k += 2) {
      const auto u = static_cast<float>(values_->next(property));
      uvs.emplace_back(u, static_cast<float>(values_->next(property)));
    }
    if (count % 2 == 1) values_->next(property);
  }

  /// Texture coordinates of its corners go before those of its vertices; a face without them has the vertices'.
  void add_face(std::vector<PolygonCorner>& corners, const std::vector<Vec2f>& uvs, std::int64_t place) {
    const bool of_corners = !corners.empty() && uvs.size() == corners.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (vertices_have_normals_) corners[k].normal = corners[k].position;
      if (vertices_have_uvs_) corners[k].uv = corners[k].position;
      if (!of_corners) continue;
      corners[k].uv = mesh_.uvs();
      mesh_.add_uv(uvs[k]);
    }
    mesh_.add_polygon(corners, place);
  }
};

}  // namespace

Likeness likeness_to_ply(const InputStart& start) {
  const bool begins = start.bytes.starts_with("ply") && start.bytes.find_first_of("\r\n") <= 8;
  return begins ? Likeness::kSure : Likeness::kIfNamedSo;
}

InputAsset read_ply(const std::filesystem::path& path, const InputLimits& limits) {
  const std::string name = file_name_of(path);
  TextScanner scanner(InputFile(path, name));
  const PlyHeader header = read_ply_header(scanner);
  return PlyReader(scanner, name, header, limits).read();
}

}  // namespace lozenge
