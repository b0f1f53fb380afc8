// Proves the guarantees of every file that Lozenge writes, one named line each, and says which one breaks where.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "formats/base/error.h"
#include "formats/domain/parameterization.h"
#include "formats/files/asset_file.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// One guarantee.
struct CheckLine {
  std::string name;  ///< "no folded triangle"; the same for every file of the kind
  bool passed = false;
  std::string detail;  ///< where it breaks, or what was counted to prove it
};

struct CheckReport {
  std::string kind;  ///< "parameterization", "geometry image", ...
  std::vector<CheckLine> lines;
  /// What a command should exit with: kDone, or kUnusableInput where a guarantee is broken, or the code of the reader's
  /// error where the file could not even be read (that is the failed line "readable").
  ExitCode code = ExitCode::kDone;

  bool passed() const;
  /// The line of this name, or nullptr.
  const CheckLine* find(std::string_view name) const;
  void add(std::string name, bool passed, std::string detail);
};

/// Recognises the file by its content, reads it and checks all that can be proved of it. A geometry image is also
/// compared with the JSON beside it. \throws Error(kUnusableInput) where the file cannot be opened or is none of
/// Lozenge's kinds
CheckReport check_file(const std::filesystem::path& path);

/// The same guarantees, of what is in memory.
CheckReport check_source_mesh(const SourceMesh& mesh);
CheckReport check_parameterization(const SourceMesh& mesh, const Parameterization& map);
CheckReport check_patch_set(const PatchSet& patches);
CheckReport check_geometry_image(const GeometryImage& image);
CheckReport check_asset(const Asset& asset);
/// The texels of a tangent- or object-space normal map must be unit vectors to within one step of its `bits` (32:
/// float).
CheckReport check_map(const BakedMap& map, int bits);

/// The report as text, a line for each guarantee ("ok    no folded triangle: 52000 triangles"), and as a JSON object
/// {kind, passed, checks: [{name, passed, detail}]}.
std::vector<std::string> report_lines(const CheckReport& report);
std::string report_json(const CheckReport& report);

}  // namespace lozenge
