#include "formats/surface/attribute.h"

#include <algorithm>

namespace lozenge {

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
