// The whole way from a glTF asset to what an engine loads: all stages over one asset, in memory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "pipeline/maps/map_files.h"
#include "pipeline/quality/quality_report.h"
#include "stages/bake/bake.h"
#include "stages/compare/compare.h"
#include "stages/export/export.h"
#include "stages/import/import.h"
#include "stages/pack/pack.h"
#include "stages/parameterize/parameterize.h"
#include "stages/render/render.h"
#include "stages/sample/sample.h"

namespace lozenge {

class MapStore;
class OutputSet;
struct BuildResult;

struct BuildOptions {
  std::filesystem::path folder = ".";  ///< of the outputs; made where it doesn't exist
  std::string name;                    ///< NAME of the outputs; empty: the input's, without its extension

  ImportOptions import;
  ParameterizeOptions parameterize;
  SampleOptions sample;
  PackOptions pack;
  BakeOptions bake;  ///< its level is that of the asset, whatever is written here
  MapFiles maps;
  ExportOptions asset;
  CompareOptions compare;

  bool preview = true;  ///< whether to draw NAME.preview.png
  bool arrays = false;  ///< whether to write NAME.npz (pipeline/arrays.h)
  /// Who writes NAME.basisu.glb where the asset's textures are to be TextureFormat::kBasisu: basisu.mjs.
  std::filesystem::path basisu_script;
  RenderOptions preview_pictures{.width = 480, .height = 480, .subsamples = 2};

  std::filesystem::path report;  ///< where to write the report as JSON; empty: nowhere
  /// Called as each stage ends, from the thread that runs the build.
  std::function<void(const StageCost&)> stage_done;

  /// Where maps of earlier builds are; null: nowhere.
  const MapStore* map_store = nullptr;
  /// Called when all outputs are complete, before they appear: a cache takes them then.
  std::function<void(const BuildResult&, const OutputSet&)> complete;
};

struct BuildResult {
  QualityReport report;
  std::vector<std::filesystem::path> files;  ///< all that were written, by name
  std::vector<std::string> notes;            ///< what isn't as it was asked for, or was in the source
};

/// Makes NAME.glb, NAME.gim.exr, NAME.gim.json, NAME.normal.png, NAME.occlusion.png (and other maps that were asked
/// for) and NAME.preview.png of the glTF file `input`, and NAME.npz and NAME.basisu.glb if they are asked for. They
/// appear in the folder together, or none does. The same input and options give the same bytes, on any number of
/// threads, and the same as the commands of the single stages. \throws Error as the stages do, and Error(kUsage) where
/// an output would replace the input
BuildResult build_asset(const std::filesystem::path& input, const BuildOptions& options, const Progress& progress = {});

}  // namespace lozenge
