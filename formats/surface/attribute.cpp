#include "formats/surface/attribute.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

bool is_influence(const float* element) {
  constexpr int kMost = kInfluences.components / 2;
  constexpr float kMostNumbers = 1 << 16;
  double total = 0;
  for (int i = 0; i < kMost; ++i) {
    const float joint = element[i];
    const float weight = element[kMost + i];
    if (!(joint >= 0 && joint < kMostNumbers) || joint != std::floor(joint) || !(weight >= 0 && weight <= 1))
      return false;
    if (weight == 0 && joint != 0) return false;
    total += weight;
  }
  return is_unmoved(element) || std::abs(total - 1) < 1e-5;
}

int sets_of_joints(const std::vector<float>& influences) {
  constexpr std::size_t kFifth = kMostJoints + kJointsOfSet;
  for (std::size_t at = 0; at + kInfluences.components <= influences.size(); at += kInfluences.components) {
    if (influences[at + kFifth] > 0) return 2;
  }
  return 1;
}

bool is_unmoved(const float* element) {
  return std::all_of(element, element + kInfluences.components, [](float x) { return x == 0; });
}

std::string attribute_name(const AttributeKind& kind, int set) {
  std::string name(kind.semantic);
  return kind.numbered ? name + "_" + std::to_string(set) : name;
}

const AttributeStream* find_stream(const AttributeStreams& streams, const AttributeKind& kind, int set) {
  const auto found = std::find_if(streams.begin(), streams.end(), [&](const AttributeStream& stream) {
    return stream.kind == kind && stream.set == set;
  });
  return found == streams.end() ? nullptr : &*found;
}

}  // namespace lozenge
