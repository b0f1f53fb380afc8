#include "pipeline/arrays.h"

#include <optional>

#include "formats/base/error.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/npz_file.h"
#include "formats/files/tile_pictures.h"
#include "pipeline/output_set.h"
#include "stages/export/patch_arrays.h"
#include "stages/sample/sample.h"

namespace lozenge {
namespace {

void require_ending(const std::filesystem::path& path, const char* ending) {
  if (path.extension() == ending) return;
  throw Error(ExitCode::kUsage, path.string() + ": its name must end in " + ending);
}

void write_pictures(const std::filesystem::path& json, const std::vector<NamedArray>& arrays,
                    const GeometryImage& image) {
  OutputSet outputs(json.has_parent_path() ? json.parent_path() : ".");
  const std::string name = json.filename().string();
  write_tile_pictures(outputs.staged(name), geometry_image_json(image), arrays);
  outputs.commit(name);
}

}  // namespace

void write_arrays(const std::filesystem::path& path, ArrayFormat format, const GeometryImage& image,
                  const BakedMaps& maps, const SourceSurface* source, const Progress& progress) {
  require_ending(path, format == ArrayFormat::kNpz ? ".npz" : ".json");
  std::optional<PatchSet> samples;
  if (source != nullptr) samples = sample(*source->mesh, *source->map, {.samples = image.layout.samples}, progress);
  const SampleSources sources{source != nullptr ? source->mesh : nullptr, samples ? &*samples : nullptr};
  const std::vector<NamedArray> arrays = patch_arrays(image, maps, samples ? &sources : nullptr);
  if (format == ArrayFormat::kNpz) {
    write_npz(path, arrays);
  } else {
    write_pictures(path, arrays, image);
  }
}

}  // namespace lozenge
