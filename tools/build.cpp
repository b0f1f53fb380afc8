// lozenge build: the whole way, from an asset to what an engine loads.
#include "pipeline/build.h"

#include <fmt/format.h>

#include "pipeline/cache/map_store.h"
#include "pipeline/output_set.h"
#include "tools/build_arguments.h"
#include "tools/commands.h"
#include "tools/memory_limit.h"
#include "tools/program.h"

namespace lozenge {
namespace {

void store_build(const BuildResult& result, const OutputSet& outputs, Recall& recall, Console& console) {
  Cache::Content content;
  for (const std::string& name : outputs.names()) content.files[name] = outputs.staged(name);
  content.texts[kTalkPart] = talk_text({result.notes, report_lines(result.report), report_json(result.report)});
  recall.store(recall.key(), content, console);
}

ExitCode run(const BuildArguments& arguments, Console& console, Recall& recall) {
  if (recall_build(arguments, console, recall)) return ExitCode::kDone;
  BuildOptions options = arguments.options;
  limit_memory(options.import.max_memory);
  options.folder = arguments.folder;
  options.asset.error = options.sample.error;
  options.report = arguments.report;
  options.preview = !arguments.no_preview;
  options.basisu_script = builder_program().parent_path() / "basisu/basisu.mjs";
  options.stage_done = [&](const StageCost& cost) {
    console.say(fmt::format("{} done in {:.2f} s, {:.0f} MB", cost.name, cost.seconds, cost.peak_memory_mb));
  };
  std::optional<MapStore> maps;
  if (recall.is_on()) {
    maps.emplace(recall.cache(), recall.key_of_stages({"import", "parameterize"}));
    options.map_store = &*maps;
    options.complete = [&](const BuildResult& result, const OutputSet& outputs) {
      store_build(result, outputs, recall, console);
    };
  }
  const BuildResult result = build_asset(arguments.input, options, console.progress());
  recall.write_depfile(arguments.asset());
  for (const std::string& note : result.notes) console.note(arguments.input, note);
  print_build(report_lines(result.report), report_json(result.report), result.files, console);
  return ExitCode::kDone;
}

}  // namespace

Command build_command() { return make_recalling_command<BuildArguments>(build_help(), declare_build, run); }

}  // namespace lozenge
