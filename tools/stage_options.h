// The options of each stage, the same in its own command and in `build`.
#pragma once

#include <string>

namespace lozenge {

class Options;

struct BakeOptions;
struct ExportOptions;
struct ImportOptions;
struct MapFiles;
struct PackOptions;
struct ParameterizeOptions;
struct SampleOptions;

/// How large the asset may be, and what it may take.
void add_import_options(Options& options, ImportOptions& import);
void add_parameterize_options(Options& options, ParameterizeOptions& map);
void add_sample_options(Options& options, SampleOptions& sample);
void add_pack_options(Options& options, PackOptions& pack);
/// All but the level of detail.
void add_bake_options(Options& options, BakeOptions& bake, MapFiles& files);
/// Which level of detail is baked for and exported. \param samples  name of the option that tells its samples a side
void add_level_options(Options& options, const std::string& samples, ExportOptions& level);
/// All but the level of detail.
void add_export_options(Options& options, ExportOptions& asset);

}  // namespace lozenge
