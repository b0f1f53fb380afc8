#include "stages/info/describe_input.h"

#include <fmt/format.h>

#include "formats/base/error.h"
#include "formats/files/input_format.h"
#include "formats/files/readers/input_file.h"
#include "stages/info/facts.h"

namespace lozenge {

namespace {

/// What any of the primitives carries, in the order of the table of attributes.
std::vector<std::string> attributes_of(const InputAsset& asset) {
  std::vector<bool> found(kAttributeKinds.size(), false);
  for (std::size_t p = 0; p < asset.meshes[0].primitives.size(); ++p) {
    const Primitive primitive = asset.read(0, static_cast<int>(p));
    for (std::size_t k = 0; k < found.size(); ++k) {
      found[k] = found[k] || find_stream(primitive.attributes, kAttributeKinds[k]) != nullptr;
    }
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k]) names.emplace_back(kAttributeKinds[k].label);
  }
  return names;
}

}  // namespace

FileInfo describe_input(const std::filesystem::path& path) {
  const InputAsset asset = open_input(path);
  const InputFormat* format = find_input_format(path, start_of(path));
  Facts facts(fmt::format("{} mesh", format == nullptr ? "foreign" : format->name));
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (const InputPrimitive& primitive : asset.meshes[0].primitives) {
    vertices += primitive.vertices;
    triangles += primitive.triangles;
  }
  facts.add("triangles", triangles, fmt::format("triangles    {}", triangles));
  facts.add("vertices", vertices, fmt::format("vertices     {}, before welding", vertices));
  const std::vector<std::string> attributes = attributes_of(asset);
  facts.add(
      "attributes", attributes,
      fmt::format("attributes   {}", attributes.empty() ? "none" : fmt::format("{}", fmt::join(attributes, ", "))));
  facts.add("materials", asset.material_names, fmt::format("materials    {}", asset.material_names.size()));
  for (const std::string& note : asset.notes) facts.line("note         " + note);
  return facts.take();
}

}  // namespace lozenge
