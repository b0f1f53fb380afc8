// bake_benchmark [--size N] ASSET...: what the bake takes, against Embree and OpenImageIO alone with the same rays and
// look-ups. README.md, in the folder above, tells how to run it.
//
// One thread, and its processor time: ratios mean something on a busy machine, too.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/base/error.h"
#include "formats/base/scratch_folder.h"
#include "formats/files/texture_files.h"
#include "stages/bake/bake.h"
#include "stages/bake/normal_maps.h"
#include "stages/bake/occlusion_map.h"
#include "stages/import/import_surface.h"
#include "stages/pack/pack.h"
#include "stages/parameterize/parameterize.h"
#include "stages/sample/sample.h"
#include "tools/bench/bake/raw_look_ups.h"
#include "tools/bench/bake/raw_rays.h"
#include "tools/threads.h"

namespace lozenge::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::int32_t kUsualSize = 2048;
/// Of the occlusion map, as many times narrower than the others as 512 in 2048.
constexpr std::int32_t kOcclusionShrink = 4;

/// A surface on its way to the bake.
struct Subject {
  std::string name;
  SourceMesh mesh;
  Parameterization map;
  GeometryImage image;
};

Subject subject_of(std::string name, SourceMesh source) {
  ParameterizeResult made = parameterize(std::move(source), {}, {});
  GeometryImage image = pack(sample(made.surface, made.map));
  return {std::move(name), std::move(made.surface), std::move(made.map), std::move(image)};
}

BakeOptions options_of(std::int32_t size, std::vector<MapKind> maps) {
  BakeOptions options;
  options.maps = std::move(maps);
  options.size = size;
  options.occlusion = OcclusionOf::kBaked;
  options.occlusion_size = size / kOcclusionShrink;
  return options;
}

/// \return processor seconds
double seconds_of(const std::function<void()>& work) {
  const double start = thread_seconds();
  work();
  return thread_seconds() - start;
}

benchmark::Counter rate(double items, double seconds) { return {items / seconds, benchmark::Counter::kDefaults}; }

/// The loops that trace rays, with all that they do around that.
void bake_rays(benchmark::State& state, const Subject& subject, std::int32_t size,
               const std::function<void(AtlasBaker&)>& maps) {
  const BakeOptions options = options_of(size, {});
  const Progress untold;
  AtlasBaker baker(subject.mesh, subject.map, subject.image, options, nullptr, untold);
  double of_bake = 0;
  double one_by_one = 0;
  double in_packets = 0;
  double rays = 0;
  while (state.KeepRunning()) {
    const double seconds = seconds_of([&] { maps(baker); });
    RawRays raw;
    maps(baker);
    raw.finish();
    state.SetIterationTime(seconds);
    of_bake += seconds;
    one_by_one += raw.seconds_one_by_one();
    in_packets += raw.seconds_in_packets();
    rays += static_cast<double>(raw.rays());
  }
  state.counters["rays"] = rays / static_cast<double>(state.iterations());
  state.counters["rays/s"] = rate(rays, of_bake);
  state.counters["one_by_one/s"] = rate(rays, one_by_one);
  state.counters["packets/s"] = rate(rays, in_packets);
  state.counters["of_one_by_one"] = one_by_one / of_bake;
  state.counters["of_packets"] = in_packets / of_bake;
}

/// The folder that TextureFiles has made in another one, which is empty else.
fs::path folder_in(const fs::path& parent) {
  for (const auto& entry : fs::directory_iterator(parent)) {
    if (entry.is_directory()) return entry.path();
  }
  throw Error(ExitCode::kInternal, parent.string() + ": no textures were written there");
}

/// The whole bake: of maps of colours, roughness and normals, and an occlusion map a quarter as wide.
void bake_textured(benchmark::State& state, const Subject& subject, std::int32_t size) {
  BakeOptions options = options_of(
      size, {MapKind::kTangentNormal, MapKind::kOcclusion, MapKind::kBaseColour, MapKind::kOcclusionRoughnessMetal});
  const ScratchFolder folder(fs::temp_directory_path(), "lozenge-bench-");
  setenv("TMPDIR", folder.path().c_str(), 1);
  std::unique_ptr<TextureFiles> textures;
  const double of_conversion = seconds_of(
      [&] { textures = std::make_unique<TextureFiles>(subject.mesh, texture_roles(options, subject.mesh)); });
  double of_bake = 0;
  double of_rays = 0;
  double of_packets = 0;
  double of_look_ups = 0;
  double rays = 0;
  double look_ups = 0;
  while (state.KeepRunning()) {
    const double seconds =
        seconds_of([&] { bake(subject.mesh, subject.map, subject.image, options, {}, textures.get()); });
    RawRays raw_rays;
    RawLookUps raw_look_ups(*textures, folder_in(folder.path()));
    bake(subject.mesh, subject.map, subject.image, options, {}, &raw_look_ups);
    raw_look_ups.finish();
    state.SetIterationTime(seconds);
    of_bake += seconds;
    of_rays += raw_rays.seconds_one_by_one();
    of_packets += raw_rays.seconds_in_packets();
    of_look_ups += raw_look_ups.seconds();
    rays += static_cast<double>(raw_rays.rays());
    look_ups += static_cast<double>(raw_look_ups.count());
  }
  const auto times = static_cast<double>(state.iterations());
  state.counters["rays"] = rays / times;
  state.counters["look_ups"] = look_ups / times;
  state.counters["bake_s"] = of_bake / times;
  state.counters["rays_s"] = of_rays / times;
  state.counters["packets_s"] = of_packets / times;
  state.counters["look_ups_s"] = of_look_ups / times;
  state.counters["conversion_s"] = of_conversion;
  state.counters["times_raw"] = of_bake / (of_rays + of_look_ups);
  state.counters["times_raw_packets"] = of_bake / (of_packets + of_look_ups);
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
#ifndef __clang_analyzer__  // takes what the library keeps for lost
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseManualTime();
#endif
}

void add_benchmarks(const std::shared_ptr<const Subject>& subject, std::int32_t size) {
  const auto add_rays = [&](const std::string& what, const std::function<void(AtlasBaker&)>& maps) {
    add(what + "/" + subject->name, [=](benchmark::State& state) { bake_rays(state, *subject, size, maps); });
  };
  const auto normals = [](AtlasBaker& baker) { benchmark::DoNotOptimize(bake_object_normals(baker)); };
  const auto occlusion = [](AtlasBaker& baker) { benchmark::DoNotOptimize(bake_occlusion(baker)); };
  add_rays("normals", normals);
  add_rays("occlusion", occlusion);
  add_rays("rays", [=](AtlasBaker& baker) {
    normals(baker);
    occlusion(baker);
  });
  if (subject->mesh.images.empty()) return;
  add("textured/" + subject->name, [=](benchmark::State& state) { bake_textured(state, *subject, size); });
}

/// \return the program's exit code
int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const ThreadLimit one_thread(1);
  std::int32_t size = kUsualSize;
  std::vector<std::string> assets(argv + 1, argv + argc);
  if (assets.size() >= 2 && assets.front() == "--size") {
    size = std::atoi(assets[1].c_str());
    assets.erase(assets.begin(), assets.begin() + 2);
  }
  if (assets.empty() || size < 1) throw Error(ExitCode::kUsage, "usage: bake_benchmark [--size N] ASSET...");
  for (const std::string& asset : assets) {
    add_benchmarks(std::make_shared<Subject>(subject_of(fs::path(asset).stem().string(), import_surface(asset))), size);
  }
  const std::size_t count = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (count == 0) throw Error(ExitCode::kUsage, "no benchmark has such a name");
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace
}  // namespace lozenge::bench

int main(int argc, char** argv) {
  try {
    return lozenge::bench::run(argc, argv);
  } catch (const lozenge::Error& error) {
    fmt::print(stderr, "bake_benchmark: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
