#include "formats/files/readers/mtl.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"
#include "formats/base/srgb.h"
#include "formats/base/utf8.h"
#include "formats/files/picture_header.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/readers/gltf/container.h"
#include "formats/files/readers/text_scanner.h"

namespace lozenge {

namespace {

namespace fs = std::filesystem;

/// Statements about what no map of ours holds, or that go without saying.
constexpr std::array<std::string_view, 12> kIgnored{"Ka", "Ks",  "Ni", "Tf",    "illum",  "sharpness",
                                                    "Pc", "Pcr", "Ps", "aniso", "anisor", "map_aat"};

/// How many words follow an option of a texture.
const std::map<std::string, int>& option_words() {
  static const std::map<std::string, int> words{{"-blendu", 1}, {"-blendv", 1}, {"-boost", 1}, {"-mm", 2},
                                                {"-texres", 1}, {"-clamp", 1},  {"-bm", 1},    {"-imfchan", 1},
                                                {"-type", 1},   {"-o", 3},      {"-s", 3},     {"-t", 3}};
  return words;
}

/// A path as programs on all systems write it, to a file beside.
std::string local_name(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  // Whole paths are of the machine that the file comes from: what is meant lies beside it, if anywhere.
  if (name.starts_with('/') || name.find(':') != std::string::npos) name.erase(0, name.find_last_of("/:") + 1);
  return name;
}

/// Splits a line into words.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(" \t", at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    at = end;
  }
  return words;
}

class MtlReader {
 public:
  MtlReader(const fs::path& folder, const InputLimits& limits) : folder_(folder), budget_(limits.max_memory) {}

  void read_library(const std::string& name) {
    try {
      const fs::path path = resolve_gltf_uri(local_name(name), folder_, valid_utf8(name));
      files_.push_back(path);
      TextScanner scanner(InputFile(path, valid_utf8(name)));
      material_ = nullptr;
      do {
        read_statement(scanner);
      } while (scanner.next_line());
      has_any_ = true;
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnusableInput) throw;
      notes_.push_back(fmt::format("{}; materials of that library are without looks", error.what()));
    }
  }

  MtlMaterials take(const std::vector<std::string>& names) {
    MtlMaterials materials;
    for (const std::string& name : names) {
      if (has_any_) materials.looks.push_back(materials_.contains(name) ? materials_[name] : plain());
    }
    materials.images = std::move(images_);
    materials.notes = std::move(notes_);
    materials.broken_pictures = std::move(broken_pictures_);
    materials.files = std::move(files_);
    if (!left_out_.empty())
      materials.notes.push_back(fmt::format("materials taken without {}", fmt::join(left_out_, ", ")));
    return materials;
  }

 private:
  static constexpr std::size_t kMostNames = 12;

  static Material plain() {
    Material material;
    material.metallic = 0;
    return material;
  }

  void read_statement(TextScanner& scanner) {
    const std::string statement(scanner.word_of_line());
    if (statement.empty()) return;
    if (statement == "newmtl") {
      material_ = &(materials_[valid_utf8(scanner.rest_of_line())] = plain());
      return;
    }
    if (material_ == nullptr) return;
    if (statement == "Kd") {
      if (const auto c = colour(scanner)) set_colour(*c);
    } else if (statement == "Ke") {
      if (const auto c = colour(scanner)) material_->emissive = *c;
    } else if (statement == "d" || statement == "Tr") {
      if (const auto share = number(scanner)) set_opacity(statement == "d" ? *share : 1 - *share);
    } else if (statement == "Ns") {
      // Of a Blinn-Phong lobe of this exponent (Karis 2013, "Specular BRDF Reference": exponent = 2 / roughness^4 - 2).
      if (const auto exponent = number(scanner))
        material_->roughness = std::pow(2 / (std::max(*exponent, 0.0) + 2), 0.25);
    } else if (statement == "Pr") {
      if (const auto share = number(scanner)) material_->roughness = std::clamp(*share, 0.0, 1.0);
    } else if (statement == "Pm") {
      if (const auto share = number(scanner)) material_->metallic = std::clamp(*share, 0.0, 1.0);
    } else if (statement == "map_Kd") {
      set_texture(TextureRole::kBaseColour, scanner);
    } else if (statement == "map_Ke") {
      set_texture(TextureRole::kEmissive, scanner);
      if (material_->emissive == Vec3d(0, 0, 0)) material_->emissive = {1, 1, 1};
    } else if (statement == "norm" || statement == "map_Kn") {
      set_texture(TextureRole::kNormal, scanner);
    } else if (std::find(kIgnored.begin(), kIgnored.end(), statement) == kIgnored.end() &&
               left_out_.size() < kMostNames) {
      left_out_.insert(valid_utf8(statement.substr(0, 40)));
    }
  }

  static std::optional<double> number(TextScanner& scanner) {
    double value = 0;
    if (!parse_number(scanner.word_of_line(), value) || !std::isfinite(value)) return std::nullopt;
    return value;
  }

  /// Linear.
  static std::optional<Vec3d> colour(TextScanner& scanner) {
    Vec3d linear;
    for (int c = 0; c < 3; ++c) {
      const auto share = number(scanner);
      if (!share) return std::nullopt;
      linear[c] = linear_of_srgb(std::clamp(*share, 0.0, 1.0));
    }
    return linear;
  }

  void set_colour(const Vec3d& c) { material_->base_colour = {c.x, c.y, c.z, material_->base_colour.w}; }

  void set_opacity(double share) {
    material_->base_colour.w = std::clamp(share, 0.0, 1.0);
    material_->alpha_mode = material_->base_colour.w < 1 ? AlphaMode::kBlend : AlphaMode::kOpaque;
  }

  void set_texture(TextureRole role, TextScanner& scanner) {
    const std::string line = scanner.rest_of_line();
    std::vector<std::string> words = words_of(line);
    TextureUse use;
    std::size_t next = 0;
    while (next < words.size() && option_words().contains(words[next])) next = read_option(words, next, use);
    if (next >= words.size()) return;
    // What is left is the name, blanks and all.
    const std::size_t begin =
        line.find(words[next], next == 0 ? 0 : line.find(words[next - 1]) + words[next - 1].size());
    use.image = image(line.substr(begin));
    if (use.exists()) material_->texture(role) = use;
  }

  /// \return the word after it
  static std::size_t read_option(const std::vector<std::string>& words, std::size_t at, TextureUse& use) {
    const std::string& option = words[at++];
    std::array<double, 3> values{};
    std::size_t count = 0;
    const auto most = static_cast<std::size_t>(option_words().at(option));
    // The last numbers of a row of three may be missing.
    while (count < most && at + count < words.size()) {
      const bool is_number = parse_number(words[at + count], values[count]) && std::isfinite(values[count]);
      if (most == 3 && !is_number) break;
      ++count;
    }
    if (option == "-clamp" && count > 0 && words[at] == "on") use.wrap_u = use.wrap_v = Wrap::kClamp;
    // In OBJ v runs up: v' = s v + o is 1 - v' = s (1 - v) + (1 - s - o) in glTF.
    if (option == "-s" && count > 0) {
      use.scale = {values[0], count > 1 ? values[1] : 1};
      use.offset.y += 1 - use.scale.y;
    }
    if (option == "-o" && count > 0) {
      use.offset.x = values[0];
      if (count > 1) use.offset.y -= values[1];
    }
    return at + count;
  }

  /// The picture's number; -1 where it can't be read.
  std::int32_t image(const std::string& given) {
    const std::string name = local_name(given);
    const auto [place, is_new] = image_of_.try_emplace(name, -1);
    if (!is_new) return place->second;
    const std::string what = fmt::format("picture {:.100}", valid_utf8(name));
    try {
      const fs::path path = resolve_gltf_uri(name, folder_, what);
      files_.push_back(path);
      std::error_code error;
      const std::uint64_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
      if (error || size == 0) throw Error(ExitCode::kUnusableInput, what + ": there is no such file, or it is empty");
      budget_.take(size, what + ": reading it");
      std::vector<unsigned char> bytes = read_file_start(path, size, what);
      if (const auto defect = find_texture_defect(bytes)) throw Error(ExitCode::kUnusableInput, what + " " + *defect);
      const std::string mime_type(read_picture_header(bytes)->mime_type);
      place->second = static_cast<std::int32_t>(images_.size());
      images_.push_back(
          {valid_utf8(name), mime_type, std::make_shared<const std::vector<unsigned char>>(std::move(bytes))});
    } catch (const Error& error) {
      if (error.code() == ExitCode::kLimit) throw;
      broken_pictures_.emplace_back(error.what());
    }
    return place->second;
  }

  fs::path folder_;
  MemoryBudget budget_;
  bool has_any_ = false;
  std::map<std::string, Material> materials_;
  Material* material_ = nullptr;  ///< that statements are about
  std::map<std::string, std::int32_t> image_of_;
  std::vector<EncodedImage> images_;
  std::set<std::string> left_out_;
  std::vector<std::string> notes_;
  std::vector<std::string> broken_pictures_;
  std::vector<fs::path> files_;
};

}  // namespace

MtlMaterials read_mtl(const fs::path& folder, const std::vector<std::string>& libraries,
                      const std::vector<std::string>& names, const InputLimits& limits) {
  MtlReader reader(folder, limits);
  for (const std::string& library : libraries) reader.read_library(library);
  return reader.take(names);
}

std::vector<fs::path> files_named_by_obj(const fs::path& path) {
  std::vector<std::string> libraries;
  TextScanner scanner(InputFile(path, valid_utf8(path.filename().string())));
  do {
    if (scanner.word_of_line() == "mtllib") libraries.push_back(scanner.rest_of_line());
  } while (scanner.next_line());
  std::sort(libraries.begin(), libraries.end());
  libraries.erase(std::unique(libraries.begin(), libraries.end()), libraries.end());
  return read_mtl(path.parent_path(), libraries, {}, {}).files;
}

}  // namespace lozenge
