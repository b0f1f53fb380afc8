// Buffer views are taken apart, changed one by one, and put into a new buffer in their order.
#include "stages/export/quantize.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "formats/base/vector.h"
#include "formats/surface/placement.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr double kUnsignedSteps = 65535;
constexpr double kSignedSteps = 32767;
constexpr double kByteSteps = 127;

/// From 0..1 (or -1..1, of offsets) to the space of the mesh.
struct Grid {
  Vec3d origin{0, 0, 0};
  double scale = 1;

  Placement placement() const {
    return {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, origin.x, origin.y, origin.z, 1};
  }
};

/// Column-major, as glTF has them.
template <typename M>
std::array<double, 16> times(const M& a, const Placement& b) {
  std::array<double, 16> product{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return product;
}

template <typename Integer>
void append(Bytes& bytes, Integer value) {
  const auto* first = reinterpret_cast<const unsigned char*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

/// Places of a grid for positions: for equal ones the same, for others another.
class GridPlaces {
 public:
  using Place = std::array<std::uint16_t, 3>;

  explicit GridPlaces(const Grid& grid) : grid_(grid) {}

  Place of(const float* position) {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy(bits.data(), position, sizeof bits);
    const auto [known, is_new] = places_.try_emplace(bits);
    if (is_new) known->second = free_place(position);
    return known->second;
  }

 private:
  Place free_place(const float* position) {
    std::array<int, 3> middle{};
    for (int c = 0; c < 3; ++c) {
      const double share = (position[c] - grid_.origin[c]) / grid_.scale;
      middle[static_cast<std::size_t>(c)] = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kUnsignedSteps));
    }
    // The first shell that has one: there are more places than vertices.
    for (int radius = 0;; ++radius) {
      for (int x = -radius; x <= radius; ++x) {
        for (int y = -radius; y <= radius; ++y) {
          for (int z = -radius; z <= radius; ++z) {
            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != radius) continue;
            const std::array<int, 3> at{middle[0] + x, middle[1] + y, middle[2] + z};
            if (std::any_of(at.begin(), at.end(), [](int c) { return c < 0 || c > 65535; })) continue;
            const Place place{static_cast<std::uint16_t>(at[0]), static_cast<std::uint16_t>(at[1]),
                              static_cast<std::uint16_t>(at[2])};
            if (taken_.insert(place).second) return place;
          }
        }
      }
    }
  }

  Grid grid_;
  std::map<std::array<std::uint32_t, 3>, Place> places_;
  std::set<Place> taken_;
};

class Quantizer {
 public:
  explicit Quantizer(tinygltf::Model& model) : model_(model) {
    const Bytes& buffer = model.buffers[0].data;
    for (const tinygltf::BufferView& view : model.bufferViews) {
      const auto first = buffer.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
      views_.emplace_back(first, first + static_cast<std::ptrdiff_t>(view.byteLength));
    }
    find_movers();
  }

  void quantize(const MeshGroup& group) {
    const Grid grid = grid_of(group);
    GridPlaces places(grid);
    for (int m = group.first; m < group.first + group.count; ++m) {
      for (const tinygltf::Primitive& primitive : model_.meshes[m].primitives) {
        quantize_positions(primitive.attributes.at("POSITION"), places);
        quantize_directions(primitive.attributes, "NORMAL");
        quantize_directions(primitive.attributes, "TANGENT");
        quantize_texcoords(primitive.attributes);
        for (const auto& target : primitive.targets) quantize_target(target, grid);
      }
    }
    place_nodes(group, grid);
  }

  void finish() {
    Bytes& buffer = model_.buffers[0].data;
    buffer.clear();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      buffer.resize((buffer.size() + 3) / 4 * 4);
      model_.bufferViews[v].byteOffset = buffer.size();
      model_.bufferViews[v].byteLength = views_[v].size();
      buffer.insert(buffer.end(), views_[v].begin(), views_[v].end());
    }
    model_.extensionsUsed.emplace_back("KHR_mesh_quantization");
    model_.extensionsRequired.emplace_back("KHR_mesh_quantization");
  }

 private:
  // ---- Numbers

  std::vector<float> floats_in(int view, std::size_t offset, std::size_t count) const {
    std::vector<float> values(count);
    if (count > 0) std::memcpy(values.data(), views_[view].data() + offset, count * sizeof(float));
    return values;
  }

  /// Those that an accessor names: of a sparse one only what differs from 0.
  std::vector<float> floats_of(int number) const {
    const tinygltf::Accessor& accessor = model_.accessors[number];
    const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
    if (accessor.sparse.isSparse) {
      return floats_in(accessor.sparse.values.bufferView, 0, width * static_cast<std::size_t>(accessor.sparse.count));
    }
    if (accessor.bufferView < 0) return {};
    return floats_in(accessor.bufferView, accessor.byteOffset, width * accessor.count);
  }

  /// \param stride  of elements that don't follow each other closely
  void store(int number, Bytes bytes, int component_type, std::size_t stride) {
    tinygltf::Accessor& accessor = model_.accessors[number];
    accessor.componentType = component_type;
    accessor.normalized = true;
    if (accessor.sparse.isSparse) {
      views_[accessor.sparse.values.bufferView] = std::move(bytes);
    } else if (accessor.bufferView >= 0) {
      accessor.byteOffset = 0;
      views_[accessor.bufferView] = std::move(bytes);
      model_.bufferViews[accessor.bufferView].byteStride = stride;
    }
  }

  void set_bounds(int number, const std::vector<int>& least, const std::vector<int>& greatest) {
    model_.accessors[number].minValues.assign(least.begin(), least.end());
    model_.accessors[number].maxValues.assign(greatest.begin(), greatest.end());
  }

  Grid grid_of(const MeshGroup& group) const {
    Bounds bounds;
    bool any = false;
    double farthest = 0;
    for (int m = group.first; m < group.first + group.count; ++m) {
      for (const tinygltf::Primitive& primitive : model_.meshes[m].primitives) {
        const tinygltf::Accessor& positions = model_.accessors[primitive.attributes.at("POSITION")];
        for (int c = 0; c < 3; ++c) {
          const auto low = static_cast<float>(positions.minValues[static_cast<std::size_t>(c)]);
          const auto high = static_cast<float>(positions.maxValues[static_cast<std::size_t>(c)]);
          bounds.low[c] = any ? std::min(bounds.low[c], low) : low;
          bounds.high[c] = any ? std::max(bounds.high[c], high) : high;
        }
        any = true;
        for (const auto& target : primitive.targets) {
          for (const float offset : floats_of(target.at("POSITION"))) {
            farthest = std::max(farthest, std::abs(static_cast<double>(offset)));
          }
        }
      }
    }
    Grid grid{Vec3d(bounds.low), farthest};
    for (int c = 0; c < 3; ++c) grid.scale = std::max(grid.scale, double{bounds.high[c]} - double{bounds.low[c]});
    if (!(grid.scale > 0)) grid.scale = 1;
    return grid;
  }

  // ---- Attributes

  void quantize_positions(int number, GridPlaces& places) {
    const std::vector<float> positions = floats_of(number);
    Bytes bytes;
    std::vector<int> least(3, 65535);
    std::vector<int> greatest(3, 0);
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
      const GridPlaces::Place place = places.of(&positions[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        append(bytes, place[c]);
        least[c] = std::min<int>(least[c], place[c]);
        greatest[c] = std::max<int>(greatest[c], place[c]);
      }
      append(bytes, std::uint16_t{0});
    }
    store(number, std::move(bytes), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 4 * sizeof(std::uint16_t));
    set_bounds(number, least, greatest);
  }

  /// Bytes, where all are from -1 to 1.
  void quantize_directions(const std::map<std::string, int>& attributes, const std::string& name) {
    const auto at = attributes.find(name);
    if (at == attributes.end()) return;
    const std::vector<float> values = floats_of(at->second);
    if (std::any_of(values.begin(), values.end(), [](float x) { return !(std::abs(x) <= 1); })) return;
    const tinygltf::Accessor& accessor = model_.accessors[at->second];
    const std::size_t width = accessor.type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    const bool has_padding = width == 3 && !accessor.sparse.isSparse;
    Bytes bytes;
    for (std::size_t i = 0; i < values.size(); ++i) {
      append(bytes, static_cast<std::int8_t>(std::lround(values[i] * kByteSteps)));
      if (has_padding && i % 3 == 2) append(bytes, std::int8_t{0});
    }
    store(at->second, std::move(bytes), TINYGLTF_COMPONENT_TYPE_BYTE, has_padding ? 4 : 0);
  }

  void quantize_texcoords(const std::map<std::string, int>& attributes) {
    const auto at = attributes.find("TEXCOORD_0");
    if (at == attributes.end()) return;
    const std::vector<float> values = floats_of(at->second);
    if (std::any_of(values.begin(), values.end(), [](float x) { return !(x >= 0 && x <= 1); })) return;
    Bytes bytes;
    for (const float x : values) append(bytes, static_cast<std::uint16_t>(std::lround(x * kUnsignedSteps)));
    store(at->second, std::move(bytes), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 0);
  }

  void quantize_target(const std::map<std::string, int>& target, const Grid& grid) {
    const int number = target.at("POSITION");
    const bool has_padding = !model_.accessors[number].sparse.isSparse;
    const bool is_whole = has_padding && model_.accessors[number].bufferView >= 0;
    const std::vector<float> offsets = floats_of(number);
    Bytes bytes;
    // What a sparse accessor doesn't name is 0.
    std::vector<int> least(3, is_whole ? 32767 : 0);
    std::vector<int> greatest(3, is_whole ? -32767 : 0);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const auto step = static_cast<std::int16_t>(std::lround(offsets[i] / grid.scale * kSignedSteps));
      append(bytes, step);
      least[i % 3] = std::min<int>(least[i % 3], step);
      greatest[i % 3] = std::max<int>(greatest[i % 3], step);
      if (has_padding && i % 3 == 2) append(bytes, std::int16_t{0});
    }
    store(number, std::move(bytes), TINYGLTF_COMPONENT_TYPE_SHORT, has_padding ? 4 * sizeof(std::int16_t) : 0);
    set_bounds(number, least, greatest);
    quantize_directions(target, "NORMAL");
    quantize_directions(target, "TANGENT");
  }

  // ---- Nodes

  /// Nodes whose transforms are others' business, or take no other one in: what they show goes to a child.
  void find_movers() {
    is_mover_.assign(model_.nodes.size(), false);
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      const tinygltf::Node& node = model_.nodes[n];
      const std::size_t lods = node.extensions.count("MSFT_lod");
      const bool is_turned = !node.rotation.empty() || !node.scale.empty();
      is_mover_[n] = is_turned || !node.children.empty() || node.camera >= 0 || node.extensions.size() > lods;
    }
    for (const tinygltf::Skin& skin : model_.skins) {
      for (const int joint : skin.joints) is_mover_[joint] = true;
    }
    for (const tinygltf::Animation& animation : model_.animations) {
      for (const tinygltf::AnimationChannel& channel : animation.channels) {
        if (channel.target_node >= 0 && channel.target_path != "weights") is_mover_[channel.target_node] = true;
      }
    }
  }

  void place_nodes(const MeshGroup& group, const Grid& grid) {
    std::map<int, int> skins;  // [skin] that takes the group's positions back
    const std::size_t count = is_mover_.size();
    for (std::size_t n = 0; n < count; ++n) {
      const int mesh = model_.nodes[n].mesh;
      if (mesh < group.first || mesh >= group.first + group.count) continue;
      if (int& skin = model_.nodes[n].skin; skin >= 0) {
        const auto [known, is_new] = skins.try_emplace(skin, -1);
        if (is_new) known->second = skin_over(skin, grid);
        skin = known->second;
      } else {
        dequantize(is_mover_[n] ? child_that_shows(n) : n, grid);
      }
    }
  }

  void dequantize(std::size_t number, const Grid& grid) {
    tinygltf::Node& node = model_.nodes[number];
    if (!node.matrix.empty()) {
      const auto product = times(node.matrix, grid.placement());
      node.matrix.assign(product.begin(), product.end());
      return;
    }
    node.translation.resize(3, 0.0);
    for (int c = 0; c < 3; ++c) node.translation[static_cast<std::size_t>(c)] += grid.origin[c];
    node.scale.assign(3, grid.scale);
  }

  /// A new node below one, which gets its mesh, and the weights of morph targets that are animated there.
  std::size_t child_that_shows(std::size_t parent) {
    const auto child = static_cast<int>(model_.nodes.size());
    tinygltf::Node shown;
    shown.mesh = std::exchange(model_.nodes[parent].mesh, -1);
    shown.name = model_.meshes[shown.mesh].name;
    model_.nodes[parent].children.push_back(child);
    model_.nodes.push_back(std::move(shown));
    for (tinygltf::Animation& animation : model_.animations) {
      for (tinygltf::AnimationChannel& channel : animation.channels) {
        if (channel.target_node == static_cast<int>(parent) && channel.target_path == "weights")
          channel.target_node = child;
      }
    }
    return static_cast<std::size_t>(child);
  }

  /// The skin whose inverse bind matrices take positions back first: this one itself, unless another group has it.
  int skin_over(int number, const Grid& grid) {
    const auto [original, is_first] = original_matrices_.try_emplace(number, model_.skins[number].inverseBindMatrices);
    const std::size_t joints = model_.skins[number].joints.size();
    const std::vector<float> matrices = original->second < 0 ? std::vector<float>() : floats_of(original->second);
    std::vector<float> changed;
    for (std::size_t j = 0; j < joints; ++j) {
      Placement bind = kUnmoved;
      for (std::size_t i = 0; i < bind.size() && 16 * j + i < matrices.size(); ++i) bind[i] = matrices[16 * j + i];
      for (const double x : times(bind, grid.placement())) changed.push_back(static_cast<float>(x));
    }
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(views_.size());
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_MAT4;
    accessor.count = joints;
    const auto* first = reinterpret_cast<const unsigned char*>(changed.data());
    views_.emplace_back(first, first + changed.size() * sizeof(float));
    model_.bufferViews.emplace_back().buffer = 0;
    int skin = number;
    if (!is_first) {
      skin = static_cast<int>(model_.skins.size());
      model_.skins.push_back(model_.skins[number]);
    }
    model_.skins[skin].inverseBindMatrices = static_cast<int>(model_.accessors.size());
    model_.accessors.push_back(std::move(accessor));
    return skin;
  }

  tinygltf::Model& model_;
  std::vector<Bytes> views_;
  std::vector<bool> is_mover_;            ///< [node]
  std::map<int, int> original_matrices_;  ///< [skin] accessor, of those that were changed
};

}  // namespace

void quantize_vertices(tinygltf::Model& model, const std::vector<MeshGroup>& groups) {
  Quantizer quantizer(model);
  for (const MeshGroup& group : groups) quantizer.quantize(group);
  quantizer.finish();
}

}  // namespace lozenge
