#include "stages/sample/sample.h"

#include <string>

#include "formats/base/error.h"
#include "stages/sample/sample_count.h"
#include "stages/sample/surface_samples.h"

namespace lozenge {

std::int32_t samples_at_most(const SampleOptions& options) {
  return options.samples > 0 ? options.samples : kMostChosenSamples;
}

PatchSet sample(const SourceMesh& mesh, const Parameterization& map, const SampleOptions& options,
                const Progress& progress) {
  const std::int32_t n = options.samples;
  if (n != 0 && (n < 2 || n > kMostSamples || ((n - 1) & (n - 2)) != 0)) {
    throw Error(ExitCode::kUsage, "the samples a side of a patch are " + std::to_string(n) +
                                      "; give a power of two plus one, from 2 to " + std::to_string(kMostSamples) +
                                      ": 2, 3, 5, 9, 17, 33, ...");
  }
  report(progress, "locating", 0);
  const PatchSampler sampler(mesh, map);
  if (n != 0) return sampler.sample(sampler.layout(n), progress);
  const SampleChoice choice = choose_samples(sampler, options.error, progress);
  PatchSet set = sampler.sample(sampler.layout(choice.samples), progress);
  set.layout.deviation = choice.deviation;
  return set;
}

}  // namespace lozenge
