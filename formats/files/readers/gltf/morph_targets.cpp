// A target that moves nothing costs memory on every level of an asset, and exporters write many: all of a face are
// there for the eyes, too. So offsets are looked at once before they are read.
#include "formats/files/readers/gltf/morph_targets.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/base/error.h"
#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/primitive.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {

namespace {

const tinygltf::Primitive& primitive_at(const GltfFile& file, int mesh, int primitive) {
  return file.model->meshes[mesh].primitives[primitive];
}

/// Differences of an attribute of a target, three for each vertex; none where it has none of that.
std::vector<float> read_differences(const GltfFile& file, int mesh, int primitive, int target,
                                    const std::string& attribute) {
  const tinygltf::Primitive& from = primitive_at(file, mesh, primitive);
  if (static_cast<std::size_t>(target) >= from.targets.size()) return {};
  const auto found = from.targets[target].find(attribute);
  const auto base = from.attributes.find(attribute);
  if (found == from.targets[target].end() || base == from.attributes.end()) return {};
  const AccessorFacts facts = accessor_facts(file, found->second);
  if (facts.components == 3 && facts.count == accessor_facts(file, base->second).count) {
    return read_floats(file, found->second);
  }
  throw Error(ExitCode::kUnusableInput,
              fmt::format("{}: {}: {} of morph target {} are not three numbers for each vertex", file.name,
                          primitive_place(mesh, primitive), attribute, target));
}

std::string name_of(const tinygltf::Mesh& mesh, int target) {
  if (!mesh.extras.IsObject() || !mesh.extras.Has("targetNames")) return "";
  const tinygltf::Value& names = mesh.extras.Get("targetNames");
  if (!names.IsArray() || static_cast<std::size_t>(target) >= names.ArrayLen()) return "";
  return names.Get(target).IsString() ? names.Get(target).Get<std::string>() : "";
}

/// Looks at each accessor once, however many targets have it.
class TargetFinder {
 public:
  TargetFinder(const GltfFile& file, bool idle) : file_(file), idle_(idle) {}

  MeshTargets find(int mesh) {
    const tinygltf::Mesh& from = file_.model->meshes[mesh];
    MeshTargets found;
    for (const tinygltf::Primitive& primitive : from.primitives) {
      found.in_file = std::max(found.in_file, static_cast<int>(primitive.targets.size()));
    }
    for (int t = 0; t < found.in_file && found.numbers.size() < static_cast<std::size_t>(kMostMorphTargets); ++t) {
      if (idle_ || does_anything(mesh, t)) found.numbers.push_back(t);
    }
    const std::vector<double> weights = weights_of(found, from.weights);
    for (std::size_t i = 0; i < found.numbers.size(); ++i) {
      found.targets.push_back({name_of(from, found.numbers[i]), std::isfinite(weights[i]) ? weights[i] : 0});
    }
    return found;
  }

 private:
  bool does_anything(int mesh, int target) {
    const auto count = static_cast<int>(file_.model->meshes[mesh].primitives.size());
    for (int p = 0; p < count; ++p) {
      if (holds_triangles(file_, mesh, p) &&
          (differs(mesh, p, target, "POSITION") || differs(mesh, p, target, "NORMAL")))
        return true;
    }
    return false;
  }

  bool differs(int mesh, int primitive, int target, const std::string& attribute) {
    const auto& targets = primitive_at(file_, mesh, primitive).targets;
    if (static_cast<std::size_t>(target) >= targets.size()) return false;
    const auto accessor = targets[target].find(attribute);
    if (accessor == targets[target].end()) return false;
    const auto [known, is_new] = differs_.try_emplace(accessor->second, false);
    if (is_new) {
      const std::vector<float> values = read_differences(file_, mesh, primitive, target, attribute);
      known->second = std::any_of(values.begin(), values.end(), [](float x) { return x != 0; });
    }
    return known->second;
  }

  const GltfFile& file_;
  bool idle_;
  std::map<int, bool> differs_;  ///< [accessor] whether it holds anything but zeros
};

}  // namespace

std::vector<MeshTargets> find_targets(const GltfFile& file, const std::vector<InputInstance>& instances, bool idle) {
  std::vector<MeshTargets> targets(file.model->meshes.size());
  TargetFinder finder(file, idle);
  for (const InputInstance& instance : instances) {
    if (targets[instance.mesh].in_file == 0) targets[instance.mesh] = finder.find(instance.mesh);
  }
  return targets;
}

void add_targets(const GltfFile& file, int mesh, int primitive, const MeshTargets& targets, Primitive& read) {
  const AttributeStream* normals = find_stream(read.attributes, kNormals);
  const std::vector<float> base = normals == nullptr ? std::vector<float>() : normals->values;
  for (std::size_t i = 0; i < targets.numbers.size(); ++i) {
    const auto set = static_cast<int>(i);
    const int number = targets.numbers[i];
    std::vector<float> offsets = read_differences(file, mesh, primitive, number, "POSITION");
    if (!offsets.empty()) stream_for(read.attributes, kMorphOffsets, set).values = std::move(offsets);
    std::vector<float> turned = read_differences(file, mesh, primitive, number, "NORMAL");
    if (turned.empty() || turned.size() != base.size()) continue;
    for (std::size_t c = 0; c < turned.size(); ++c) turned[c] += base[c];
    stream_for(read.attributes, kMorphNormals, set).values = std::move(turned);
  }
}

}  // namespace lozenge
