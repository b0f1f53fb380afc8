#include "tools/bench/mesh_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <fstream>
#include <iterator>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/surface_builder.h"
#include "tools/bench/mesh_formats.h"

namespace lozenge::bench {
namespace {

using Reader = void (*)(std::string_view, const std::string&, PolygonMesh&);

/// In lower case, with its dot.
std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

Reader reader_for(const std::string& ending) {
  if (ending == ".off") return read_off;
  if (ending == ".obj") return read_obj;
  if (ending == ".ply") return read_ply;
  if (ending == ".stl") return read_stl;
  return nullptr;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  // A folder can be opened, too, and only fails when it is read.
  if (!stream || std::filesystem::is_directory(path)) {
    throw Error(ExitCode::kUnusableInput, path.string() + ": can't be read; give a file that exists");
  }
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.empty()) throw Error(ExitCode::kUnusableInput, path.string() + ": is empty");
  return bytes;
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
  const std::string ending = ending_of(path);
  const Reader read = reader_for(ending);
  if (read == nullptr) {
    if (ending == ".glb" || ending == ".gltf" || ending == ".exr") return read_surface(path, 0);
    throw Error(ExitCode::kUsage, path.string() + ": is none of .off, .obj, .ply, .stl, .glb, .gltf");
  }
  const std::string file = path.filename().string();
  PolygonMesh mesh(file);
  read(content_of(path), file, mesh);
  return mesh.finish();
}

void write_mesh(const std::filesystem::path& path, const Surface& mesh) {
  const std::string ending = ending_of(path);
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
  builder.add(std::move(primitive), Imath::M44d(), "mesh");
  SourceMesh source = builder.finish({}).mesh;
  return {std::move(source.positions), std::move(source.triangles)};
}

}  // namespace lozenge::bench
