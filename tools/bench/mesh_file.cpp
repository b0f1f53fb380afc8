#include "tools/bench/mesh_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <iterator>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/file_kind.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/input_format.h"
#include "formats/files/surface_builder.h"

namespace lozenge::bench {
namespace {

/// All primitives of an asset as its file has them: neither welded nor repaired.
Surface surface_of(const InputAsset& asset) {
  Surface surface;
  for (std::size_t p = 0; p < asset.meshes[0].primitives.size(); ++p) {
    const Primitive primitive = asset.read(0, static_cast<int>(p));
    const auto first = static_cast<VertexId>(surface.positions.size());
    for (std::size_t i = 0; i < primitive.positions.size(); i += 3) {
      surface.positions.emplace_back(primitive.positions[i], primitive.positions[i + 1], primitive.positions[i + 2]);
    }
    for (const auto& [a, b, c] : primitive.triangles) {
      surface.triangles.push_back(
          {first + static_cast<VertexId>(a), first + static_cast<VertexId>(b), first + static_cast<VertexId>(c)});
    }
  }
  return surface;
}

std::vector<float> flat(const std::vector<Vec3f>& positions) {
  std::vector<float> values;
  values.reserve(positions.size() * 3);
  for (const Vec3f& p : positions) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

void write_plain_glb(const std::filesystem::path& path, const Surface& mesh) {
  tinygltf::Model model;
  GltfBuffer buffer(model);
  std::vector<std::uint32_t> indices;
  indices.reserve(mesh.triangles.size() * 3);
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const VertexId corner : {a, b, c}) indices.push_back(static_cast<std::uint32_t>(corner));
  }
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = buffer.add_floats(flat(mesh.positions), 3, true);
  primitive.indices = buffer.add_indices(indices);
  model.meshes.emplace_back().primitives.push_back(std::move(primitive));
  model.meshes[0].name = path.stem().string();
  model.nodes.emplace_back().mesh = 0;
  model.scenes.emplace_back().nodes = {0};
  model.defaultScene = 0;
  write_glb(path, model);
}

void write_off(const std::filesystem::path& path, const Surface& mesh) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3f& p : mesh.positions) fmt::format_to(std::back_inserter(text), "{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", a, b, c);
  write_file_whole(path, {text.data(), text.size()});
}

}  // namespace

Surface read_mesh(const std::filesystem::path& path) {
  if (recognise_file(path) != FileKind::kForeignMesh) return read_surface(path, 0);
  return surface_of(open_input(path));
}

void write_mesh(const std::filesystem::path& path, const Surface& mesh) {
  const std::string ending = in_lower_case(path.extension().string());
  if (ending == ".glb") {
    write_plain_glb(path, mesh);
  } else if (ending == ".off") {
    write_off(path, mesh);
  } else {
    throw Error(ExitCode::kUsage, path.string() + ": can't be written; the output is a .glb or an .off");
  }
}

Surface welded(const Surface& mesh) {
  Primitive primitive;
  primitive.positions = flat(mesh.positions);
  for (const auto& [a, b, c] : mesh.triangles) {
    primitive.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  }
  SurfaceBuilder builder;
  builder.add(std::move(primitive), {}, "mesh");
  SourceMesh source = builder.finish({}).mesh;
  return {std::move(source.positions), std::move(source.triangles)};
}

}  // namespace lozenge::bench
