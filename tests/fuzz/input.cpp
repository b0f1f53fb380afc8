#include "tests/fuzz/input.h"

#include <cmath>
#include <cstdlib>

#include "tests/fuzz/fuzz_target.h"

namespace lozenge::fuzz {

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const InputAsset& asset, const InputPrimitive& promised, const Primitive& primitive) {
  require(primitive.vertices() == promised.vertices && primitive.triangles.size() == promised.triangles);
  require(primitive.material == promised.material && primitive.material >= -1);
  require(primitive.material < static_cast<std::int32_t>(asset.material_names.size()));
  for (const float coordinate : primitive.positions) require(std::isfinite(coordinate));
  for (const auto& triangle : primitive.triangles) {
    for (const std::uint32_t v : triangle) require(v < primitive.vertices());
  }
  for (const AttributeStream& stream : primitive.attributes) require(stream.count() == primitive.vertices());
}

}  // namespace

void read_as_input(const std::uint8_t* data, std::size_t size, const std::string& name,
                   InputAsset (*read)(const std::filesystem::path& path, const InputLimits& limits)) {
  read_as_file(data, size, name, [&](const std::filesystem::path& file) {
    const InputAsset asset = read(file, {.max_memory = 500'000'000, .max_triangles = 100'000});
    for (const InputInstance& instance : asset.instances) {
      const std::vector<InputPrimitive>& primitives = asset.meshes.at(instance.mesh).primitives;
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        check(asset, primitives[p], asset.read(instance.mesh, static_cast<int>(p)));
      }
    }
  });
}

}  // namespace lozenge::fuzz
