// A backslash at the end of a line continues the statement on the next one. Indices count from 1, or backwards from
// what was there so far where they are negative.
#include "formats/files/readers/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "formats/base/utf8.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/mtl.h"
#include "formats/files/readers/polygon_mesh.h"
#include "formats/files/readers/text_scanner.h"
#include "formats/files/readers/vertex_colors.h"

namespace lozenge {

namespace {

/// Statements that make the surface, or say something about it that needs no mention.
constexpr std::array<std::string_view, 13> kKnown{"v", "vt", "vn",     "f", "fo", "usemtl", "g",
                                                  "o", "s",  "mtllib", "l", "p",  "mg"};

bool is_known(std::string_view statement) { return std::find(kKnown.begin(), kKnown.end(), statement) != kKnown.end(); }

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const InputLimits& limits)
      : folder_(path.parent_path()),
        limits_(limits),
        mesh_(file_name_of(path), limits, {.first = 1}),
        scanner_(InputFile(path, file_name_of(path))) {}

  InputAsset read() {
    do {
      read_statement(scanner_.word_of_line());
    } while (scanner_.next_line());
    InputAsset asset = mesh_.finish();
    if (!libraries_.empty()) read_materials(asset);
    if (!unknown_.empty()) {
      asset.notes.push_back(
          fmt::format("statements that Lozenge doesn't know left out: {}", fmt::join(unknown_, ", ")));
    }
    return asset;
  }

 private:
  /// That many are listed; more would be no OBJ.
  static constexpr std::size_t kMostUnknown = 8;

  /// An OBJ names few libraries; more would be no asset.
  static constexpr std::size_t kMostLibraries = 64;

  std::filesystem::path folder_;
  InputLimits limits_;
  PolygonMesh mesh_;
  TextScanner scanner_;
  bool continues_ = false;  ///< the word before stood before a backslash at the line's end
  std::vector<std::string> libraries_;
  std::set<std::string> unknown_;
  std::vector<PolygonCorner> corners_;

  /// The next word of the statement; empty at its end.
  std::string_view word() {
    for (;;) {
      if (continues_ && !scanner_.next_line()) return {};
      continues_ = false;
      std::string_view found = scanner_.word_of_line();
      if (!found.ends_with('\\')) return found;
      continues_ = true;
      found.remove_suffix(1);
      if (!found.empty()) return found;
    }
  }

  void read_materials(InputAsset& asset) const {
    MtlMaterials materials = read_mtl(folder_, libraries_, asset.material_names, limits_);
    asset.material_looks = std::move(materials.looks);
    asset.images = std::move(materials.images);
    for (const EncodedImage& image : asset.images) asset.memory += image.bytes->size();
    for (std::string& note : materials.notes) asset.notes.push_back(std::move(note));
    for (const std::string& picture : materials.broken_pictures) asset.deviations.add(Deviation::kPicture, picture);
  }

  void read_statement(std::string_view statement) {
    continues_ = false;
    if (statement == "v") {
      read_vertex();
    } else if (statement == "vt") {
      const float u = coordinate();
      mesh_.add_uv({u, coordinate_or(0)});
    } else if (statement == "vn") {
      const float x = coordinate();
      const float y = coordinate();
      mesh_.add_normal({x, y, coordinate()});
    } else if (statement == "f" || statement == "fo") {
      read_face();
    } else if (statement == "usemtl") {
      const std::string name = valid_utf8(scanner_.rest_of_line());
      mesh_.use_material(name.empty() ? "default" : name);
    } else if (statement == "l" || statement == "p") {
      mesh_.leave_out();
    } else if (statement == "mtllib") {
      const std::string name = scanner_.rest_of_line();
      const bool is_new = std::find(libraries_.begin(), libraries_.end(), name) == libraries_.end();
      if (is_new && libraries_.size() < kMostLibraries) libraries_.push_back(name);
    } else if (!statement.empty() && !is_known(statement) && unknown_.size() < kMostUnknown) {
      unknown_.insert(valid_utf8(statement.substr(0, 40)));
    }
  }

  float as_number(std::string_view text) const {
    float value = 0;
    if (parse_float(text, value)) return value;
    scanner_.refuse(text.empty()
                        ? std::string("a coordinate is missing")
                        : fmt::format("a coordinate is '{}', which is no number", valid_utf8(text.substr(0, 40))));
  }
  float coordinate() { return as_number(word()); }
  float coordinate_or(float fallback) {
    const std::string_view text = word();
    return text.empty() ? fallback : as_number(text);
  }

  void read_vertex() {
    // x y z, and after them w, or r g b, or r g b a.
    std::array<float, 7> values{0, 0, 0, 0, 0, 0, kOpaque};
    std::size_t count = 0;
    for (; count < values.size(); ++count) {
      const std::string_view text = word();
      if (text.empty() && count >= 3) break;
      values[count] = as_number(text);
    }
    mesh_.add_position({values[0], values[1], values[2]}, scanner_.line());
    if (count >= 6) mesh_.add_color({values[3], values[4], values[5], values[6]});
  }

  /// Counted from 0; -1 where the part of the word is empty.
  std::int64_t index_of(std::string_view part, std::string_view corner, std::int64_t count) const {
    if (part.empty()) return -1;
    std::int64_t index = 0;
    if (!parse_integer(part, index) || index == 0) {
      scanner_.refuse(fmt::format("'{}' is no corner of a face; indices count from 1, or from -1 backwards",
                                  valid_utf8(corner.substr(0, 40))));
    }
    if (index < -count) {
      scanner_.refuse(fmt::format("'{}' is no corner of a face: {} counts back from {}",
                                  valid_utf8(corner.substr(0, 40)), index, count));
    }
    return index > 0 ? index - 1 : count + index;
  }

  /// "3", "3/1", "3//2" or "3/1/2": position, texture coordinate, normal.
  PolygonCorner corner_of(std::string_view corner) const {
    const auto part = [](std::string_view& rest) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view found = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      return found;
    };
    std::string_view rest = corner;
    PolygonCorner found;
    found.position = index_of(part(rest), corner, mesh_.positions());
    if (found.position < 0)
      scanner_.refuse(fmt::format("'{}' is no corner of a face", valid_utf8(corner.substr(0, 40))));
    found.uv = index_of(part(rest), corner, mesh_.uvs());
    found.normal = index_of(part(rest), corner, mesh_.normals());
    return found;
  }

  void read_face() {
    const std::int64_t line = scanner_.line();
    corners_.clear();
    for (std::string_view text = word(); !text.empty(); text = word()) {
      corners_.push_back(corner_of(text));
      mesh_.require_sensible_polygon(corners_.size(), line);
    }
    mesh_.add_polygon(corners_, line);
  }
};

}  // namespace

Likeness likeness_to_obj(const InputStart& start) {
  const std::string_view text = without_mark(start.bytes);
  if (text.find('\0') != std::string_view::npos) return Likeness::kNone;
  bool has_statement = false;
  std::size_t line = 0;
  while (line < text.size()) {
    const std::size_t end = std::min(text.find_first_of("\r\n", line), text.size());
    // The last line may go on after what is known of the file.
    if (end == text.size() && start.bytes.size() < start.size) break;
    std::size_t at = 0;
    const std::string_view statement = next_word(text.substr(line, end - line), at);
    if (!statement.empty() && !is_known(statement)) return Likeness::kIfNamedSo;
    has_statement = has_statement || !statement.empty();
    line = end + 1;
  }
  return has_statement ? Likeness::kSure : Likeness::kIfNamedSo;
}

InputAsset read_obj(const std::filesystem::path& path, const InputLimits& limits) {
  return ObjReader(path, limits).read();
}

}  // namespace lozenge
