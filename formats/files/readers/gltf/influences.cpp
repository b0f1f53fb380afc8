#include "formats/files/readers/gltf/influences.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "formats/files/readers/gltf/accessor.h"
#include "formats/surface/attribute.h"

namespace lozenge {

namespace {

constexpr std::size_t kKept = kInfluences.components / 2;

struct Influence {
  float joint = 0;
  double weight = 0;
};

/// Whether they are four numbers for each vertex.
bool fits(const GltfFile& file, int accessor, bool are_weights, std::uint64_t vertices) {
  const AccessorFacts facts = accessor_facts(file, accessor);
  const bool is_of_type = facts.is_float || (facts.normalized == are_weights && !facts.is_signed);
  return facts.components == 4 && is_of_type && facts.count == vertices;
}

void append(std::vector<Influence>& influences, float joint, float weight) {
  const double sound = weight > 0 && std::isfinite(weight) ? weight : 0;
  const float number = joint >= 0 && std::isfinite(joint) ? joint : 0;
  const auto known = std::find_if(influences.begin(), influences.end(),
                                  [&](const Influence& influence) { return influence.joint == number; });
  if (known == influences.end()) influences.push_back({number, sound});
  else known->weight += sound;
}

void store(std::vector<Influence>& influences, std::size_t most, float* element) {
  const float first = influences.empty() ? 0 : influences.front().joint;
  std::erase_if(influences, [](const Influence& influence) { return influence.weight == 0; });
  std::stable_sort(influences.begin(), influences.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  if (influences.size() > most) influences.resize(most);
  if (influences.empty()) influences.push_back({first, 1});
  double total = 0;
  for (const Influence& influence : influences) total += influence.weight;
  for (std::size_t i = 0; i < influences.size(); ++i) {
    element[i] = influences[i].joint;
    element[kKept + i] = static_cast<float>(influences[i].weight / total);
  }
}

/// The accessors of the sets of a primitive: joints, then weights.
using Sets = std::vector<std::pair<int, int>>;

Sets sets_of(const tinygltf::Primitive& primitive, bool are_stored) {
  Sets sets;
  while (!are_stored || sets.size() < kStoredJoints.size()) {
    const std::string number = std::to_string(sets.size());
    const auto joints = primitive.attributes.find(are_stored ? kStoredJoints[sets.size()] : "JOINTS_" + number);
    const auto weights = primitive.attributes.find(are_stored ? kStoredWeights[sets.size()] : "WEIGHTS_" + number);
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) break;
    sets.emplace_back(joints->second, weights->second);
  }
  return sets;
}

}  // namespace

std::vector<float> read_influences(const GltfFile& file, const tinygltf::Primitive& primitive, std::uint64_t vertices,
                                   int most) {
  Sets sets = sets_of(primitive, true);
  const bool are_stored = !sets.empty();
  if (!are_stored) sets = sets_of(primitive, false);
  const bool sound = std::all_of(sets.begin(), sets.end(), [&](const auto& set) {
    return fits(file, set.first, false, vertices) && fits(file, set.second, true, vertices);
  });
  if (sets.empty() || !sound) return {};
  std::vector<std::vector<Influence>> influences(are_stored ? 0 : vertices);
  std::vector<float> values(vertices * kInfluences.components, 0.0F);
  for (std::size_t set = 0; set < sets.size(); ++set) {
    const std::vector<float> joints = read_floats(file, sets[set].first);
    const std::vector<float> weights = read_floats(file, sets[set].second);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (!are_stored) {
        append(influences[i / 4], joints[i], weights[i]);
        continue;
      }
      float* element = &values[i / 4 * kInfluences.components];
      element[kJointsOfSet * set + i % 4] = joints[i];
      element[kKept + kJointsOfSet * set + i % 4] = weights[i];
    }
  }
  for (std::size_t v = 0; v < influences.size(); ++v) {
    store(influences[v], static_cast<std::size_t>(most), &values[v * kInfluences.components]);
  }
  return values;
}

}  // namespace lozenge
