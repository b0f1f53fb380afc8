// The options of each stage, the same in its own command and in `build`.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lozenge {

struct BakeOptions;
struct ExportOptions;
struct ImportOptions;
struct MapFiles;
struct PackOptions;
struct ParameterizeOptions;
struct SampleOptions;

/// How large the asset may be, and what it may take.
void add_import_options(CLI::App& command, ImportOptions& options);
void add_parameterize_options(CLI::App& command, ParameterizeOptions& options);
void add_sample_options(CLI::App& command, SampleOptions& options);
void add_pack_options(CLI::App& command, PackOptions& options);
/// All but the level of detail.
void add_bake_options(CLI::App& command, BakeOptions& options, MapFiles& files);
/// Which level of detail is baked for and exported. \param samples  name of the option that tells its samples a side
void add_level_options(CLI::App& command, const std::string& samples, ExportOptions& options);
/// All but the level of detail.
void add_export_options(CLI::App& command, ExportOptions& options);

}  // namespace lozenge
