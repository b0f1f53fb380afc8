// Values are read as floats, interpolated, and encoded again in the component type that they had. The old vertices that
// a new one lies between are taken in the order of their positions, so that primitives that meet agree by bits.
#include "formats/files/gltf_new_vertices.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "formats/files/readers/gltf/accessor.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {

namespace {

using nlohmann::json;

/// One attribute of the new vertices while it is made.
struct Values {
  std::string name;
  int component_type = TINYGLTF_COMPONENT_TYPE_FLOAT;
  bool normalized = false;
  int components = 1;
  std::vector<float> floats;  ///< [vertex * components + component]
};

/// Every corner of the new triangles, by what it lies between.
struct Corners {
  std::vector<VertexBetween> all;
  std::vector<std::array<WeightedElement, 3>> elements;  ///< in the order of the old positions, as many as there are
  std::vector<int> counts;
};

Values read_values(const GltfFile& file, int accessor, const std::string& name) {
  const tinygltf::Accessor& described = file.model->accessors[accessor];
  return {name, described.componentType, described.normalized, accessor_facts(file, accessor).components,
          read_floats(file, accessor)};
}

bool is_whole(const Values& values) {
  return values.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT && !values.normalized && values.name != "POSITION" &&
         !values.name.starts_with("TEXCOORD");
}

/// How values lie between others: by their semantic.
Interpolation interpolation_of(const Values& values) {
  if (values.name == "NORMAL") return Interpolation::kDirection;
  return is_whole(values) ? Interpolation::kNearest : Interpolation::kLinear;
}

std::span<const WeightedElement> elements_of(const Corners& corners, std::size_t c) {
  return {corners.elements[c].data(), static_cast<std::size_t>(corners.counts[c])};
}

/// The attribute of all corners. \param in_target  of a morph target: differences, that are linear whatever they are of
Values between(const Values& old, const Corners& corners, bool in_target) {
  Values made{old.name, old.component_type, old.normalized, old.components, {}};
  const Interpolation way = in_target ? Interpolation::kLinear : interpolation_of(old);
  const AttributeStream stream{
      AttributeKind{.semantic = "", .label = "", .components = old.components, .interpolation = way}, 0, old.floats};
  const auto width = static_cast<std::size_t>(old.components);
  made.floats.resize(corners.all.size() * width);
  for (std::size_t c = 0; c < corners.all.size(); ++c) {
    float* to = &made.floats[c * width];
    const auto elements = elements_of(corners, c);
    if (elements.size() == 1) std::copy_n(stream.at(elements[0].element), width, to);
    else interpolate(stream, elements, to);
  }
  return made;
}

/// Directions, with the handedness of the nearest vertex.
Values tangents_between(const Values& old, const Corners& corners) {
  Values made = between(old, corners, true);
  for (std::size_t c = 0; c < corners.all.size(); ++c) {
    const auto elements = elements_of(corners, c);
    if (elements.size() == 1) continue;
    float* t = &made.floats[4 * c];
    const float length = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    for (int axis = 0; axis < 3 && length > 0; ++axis) t[axis] /= length;
    const auto nearest = std::max_element(elements.begin(), elements.end(),
                                          [](const auto& a, const auto& b) { return a.weight < b.weight; });
    t[3] = old.floats[4 * nearest->element + 3];
  }
  return made;
}

/// Joints and weights of all sets together: the heaviest of all that the old vertices name.
void joints_between(std::vector<Values>& joints, std::vector<Values>& weights, const Corners& corners) {
  const std::size_t sets = joints.size();
  AttributeStream stream{AttributeKind{.semantic = "",
                                       .label = "",
                                       .components = static_cast<int>(8 * sets),
                                       .interpolation = Interpolation::kJointsAndWeights},
                         0,
                         {}};
  const std::size_t old = joints.front().floats.size() / 4;
  stream.values.resize(old * 8 * sets);
  for (std::size_t v = 0; v < old; ++v) {
    for (std::size_t s = 0; s < sets; ++s) {
      std::copy_n(&joints[s].floats[4 * v], 4, stream.at(v) + 4 * s);
      std::copy_n(&weights[s].floats[4 * v], 4, stream.at(v) + 4 * (sets + s));
    }
  }
  std::vector<float> value(8 * sets);
  for (std::size_t s = 0; s < sets; ++s) {
    joints[s].floats.resize(4 * corners.all.size());
    weights[s].floats.resize(4 * corners.all.size());
  }
  for (std::size_t c = 0; c < corners.all.size(); ++c) {
    const auto elements = elements_of(corners, c);
    if (elements.size() == 1) std::copy_n(stream.at(elements[0].element), value.size(), value.data());
    else interpolate(stream, elements, value.data());
    for (std::size_t s = 0; s < sets; ++s) {
      std::copy_n(&value[4 * s], 4, &joints[s].floats[4 * c]);
      std::copy_n(&value[4 * (sets + s)], 4, &weights[s].floats[4 * c]);
    }
  }
}

template <typename T>
void encode(const Values& values, std::size_t stride, std::vector<unsigned char>& bytes) {
  const auto width = static_cast<std::size_t>(values.components);
  const bool weights = values.name.starts_with("WEIGHTS");
  constexpr double kMost = std::numeric_limits<T>::max();
  for (std::size_t v = 0; v * width < values.floats.size(); ++v) {
    std::array<T, 16> element{};
    double sum = 0;
    for (std::size_t c = 0; c < width; ++c) {
      const double value = values.floats[v * width + c];
      const double rounded = std::round(values.normalized ? value * kMost : value);
      element[c] = static_cast<T>(std::clamp(rounded, static_cast<double>(std::numeric_limits<T>::lowest()), kMost));
      sum += element[c];
    }
    // Rounded weights add up to one again.
    if (weights && values.normalized && sum > 0 && std::abs(sum - kMost) < 4) {
      T& heaviest = *std::max_element(element.begin(), element.begin() + values.components);
      heaviest = static_cast<T>(heaviest + (kMost - sum));
    }
    std::memcpy(&bytes[v * stride], element.data(), width * sizeof(T));
  }
}

/// Bytes of an element, to a multiple of four.
std::size_t stride_of(const Values& values) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(values.component_type));
  return (static_cast<std::size_t>(size * values.components) + 3) / 4 * 4;
}

std::vector<unsigned char> encoded(const Values& values) {
  const std::size_t stride = stride_of(values);
  std::vector<unsigned char> bytes(values.floats.size() / static_cast<std::size_t>(values.components) * stride, 0);
  switch (values.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      encode<std::int8_t>(values, stride, bytes);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      encode<std::uint8_t>(values, stride, bytes);
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      encode<std::int16_t>(values, stride, bytes);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      encode<std::uint16_t>(values, stride, bytes);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      encode<std::uint32_t>(values, stride, bytes);
      break;
    default:
      if (!values.floats.empty()) std::memcpy(bytes.data(), values.floats.data(), bytes.size());
  }
  return bytes;
}

/// Numbers the elements that agree in all their bytes. \return [element] the number; `first` gets the first of each
std::vector<std::uint32_t> number_alike(const std::vector<const std::vector<unsigned char>*>& columns,
                                        const std::vector<std::size_t>& strides, std::size_t count,
                                        std::vector<std::uint32_t>& first) {
  std::size_t width = 0;
  for (const std::size_t stride : strides) width += stride;
  std::string rows(width * count, '\0');
  std::size_t at = 0;
  for (std::size_t n = 0; n < columns.size(); ++n) {
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(&rows[i * width + at], columns[n]->data() + i * strides[n], strides[n]);
    }
    at += strides[n];
  }
  std::unordered_map<std::string_view, std::uint32_t> known;
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [place, is_new] = known.try_emplace(std::string_view(&rows[i * width], width), first.size());
    if (is_new) first.push_back(static_cast<std::uint32_t>(i));
    numbers[i] = place->second;
  }
  return numbers;
}

/// The whole numbers of a set's name: "TEXCOORD_1" has 1.
bool is_set(const std::string& name, const std::string& semantic, int set) {
  return name == semantic + "_" + std::to_string(set);
}

class PrimitiveWriter {
 public:
  PrimitiveWriter(GltfRewrite& rewrite, GltfDocument& document, const CutPrimitive& cut, int set)
      : rewrite_(rewrite),
        file_(document.file),
        json_((*document.json)["meshes"][cut.mesh]["primitives"][cut.primitive]),
        cut_(cut),
        set_(set),
        drops_tangents_(drops_tangents(*document.json)) {}

  /// \pre nothing was added to the document before all primitives' accessors were read and let go of
  void read() {
    for (const auto& [name, accessor] : json_["attributes"].items()) {
      old_.push_back(read_values(file_, accessor.get<int>(), name));
    }
    for (const json& target : json_.value("targets", json::array())) {
      auto& values = targets_.emplace_back();
      for (const auto& [name, accessor] : target.items()) {
        if (name == "TANGENT" && drops_tangents_) continue;
        values.push_back(read_values(file_, accessor.get<int>(), name));
      }
    }
    const auto release = [&](const json& attributes) {
      for (const auto& [name, accessor] : attributes.items()) rewrite_.release(accessor.template get<int>());
    };
    release(json_["attributes"]);
    for (const json& target : json_.value("targets", json::array())) release(target);
    if (json_.contains("indices")) rewrite_.release(json_["indices"].get<int>());
  }

  void write() {
    find_corners();
    std::vector<Values> made = new_attributes();
    std::vector<std::vector<Values>> targets;
    for (const auto& target : targets_) {
      auto& values = targets.emplace_back();
      for (const Values& old : target) values.push_back(between(old, corners_, true));
    }
    const std::vector<std::uint32_t> numbers = number(made, targets);
    json attributes = json::object();
    for (const Values& values : made) attributes[values.name] = add(values, values.name == "POSITION");
    json_["attributes"] = std::move(attributes);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      json names = json::object();
      for (const Values& values : targets[t]) names[values.name] = add(values, values.name == "POSITION");
      json_["targets"][t] = std::move(names);
    }
    json_["indices"] = add_indices(numbers);
    json_.erase("mode");
  }

 private:
  /// Whether a primitive's tangents are those of the texture coordinates that are replaced.
  bool drops_tangents(const json& document) const {
    int set_of_normals = 0;
    if (const auto material = json_.find("material"); material != json_.end()) {
      const json& described = document["materials"][material->get<std::size_t>()];
      if (described.contains("normalTexture")) set_of_normals = described["normalTexture"].value("texCoord", 0);
    }
    return set_of_normals == set_;
  }

  const Values* find(const std::string& name) const {
    const auto at = std::find_if(old_.begin(), old_.end(), [&](const Values& v) { return v.name == name; });
    return at == old_.end() ? nullptr : &*at;
  }

  void find_corners() {
    const std::vector<float>& positions = find("POSITION")->floats;
    for (const auto& triangle : cut_.triangles) {
      for (const VertexBetween& corner : triangle) {
        std::array<WeightedElement, 3> elements{};
        int count = 0;
        for (int k = 0; k < 3; ++k) {
          if (corner.weights[k] > 0) elements[count++] = {corner.vertices[k], corner.weights[k]};
        }
        const auto place = [&](const WeightedElement& e) { return &positions[3 * e.element]; };
        for (int k = 1; k < count; ++k) {
          for (int at = k; at > 0; --at) {
            const float* here = place(elements[at]);
            const float* before = place(elements[at - 1]);
            if (!std::lexicographical_compare(here, here + 3, before, before + 3)) break;
            std::swap(elements[at], elements[at - 1]);
          }
        }
        corners_.all.push_back(corner);
        corners_.elements.push_back(elements);
        corners_.counts.push_back(count);
      }
    }
  }

  std::vector<Values> new_attributes() const {
    std::vector<Values> made;
    std::vector<Values> joints, weights;
    for (int s = 0; s < 2; ++s) {
      const Values* j = find("JOINTS_" + std::to_string(s));
      const Values* w = find("WEIGHTS_" + std::to_string(s));
      if (j == nullptr || w == nullptr) break;
      joints.push_back(*j);
      weights.push_back(*w);
    }
    if (!joints.empty()) joints_between(joints, weights, corners_);
    for (const Values& old : old_) {
      if (is_set(old.name, "TEXCOORD", set_) || (old.name == "TANGENT" && drops_tangents_)) continue;
      const auto joint = std::find_if(joints.begin(), joints.end(), [&](auto& v) { return v.name == old.name; });
      const auto weight = std::find_if(weights.begin(), weights.end(), [&](auto& v) { return v.name == old.name; });
      if (joint != joints.end()) made.push_back(*joint);
      else if (weight != weights.end()) made.push_back(*weight);
      else if (old.name == "TANGENT" && old.components == 4) made.push_back(tangents_between(old, corners_));
      else made.push_back(between(old, corners_, false));
      if (old.name == "POSITION") put_positions(made.back());
    }
    for (int s = 0; s <= set_; ++s) {
      const std::string name = "TEXCOORD_" + std::to_string(s);
      if (s == set_ || find(name) == nullptr) made.push_back(new_uvs(name));
    }
    return made;
  }

  void put_positions(Values& positions) const {
    for (std::size_t c = 0; c < corners_.all.size(); ++c) {
      if (const auto& p = corners_.all[c].position; p && corners_.counts[c] > 1) {
        for (int axis = 0; axis < 3; ++axis) positions.floats[3 * c + static_cast<std::size_t>(axis)] = (*p)[axis];
      }
    }
  }

  Values new_uvs(const std::string& name) const {
    Values uvs{name, TINYGLTF_COMPONENT_TYPE_FLOAT, false, 2, {}};
    for (const VertexBetween& corner : corners_.all) uvs.floats.insert(uvs.floats.end(), {corner.uv.x, corner.uv.y});
    return uvs;
  }

  /// Joins what agrees in everything. \return [corner] its vertex
  std::vector<std::uint32_t> number(std::vector<Values>& made, std::vector<std::vector<Values>>& targets) const {
    std::vector<std::vector<unsigned char>> bytes;
    std::vector<std::size_t> strides;
    std::vector<Values*> all;
    for (Values& values : made) all.push_back(&values);
    for (auto& target : targets) {
      for (Values& values : target) all.push_back(&values);
    }
    for (const Values* values : all) {
      bytes.push_back(encoded(*values));
      strides.push_back(stride_of(*values));
    }
    std::vector<const std::vector<unsigned char>*> columns;
    for (const auto& column : bytes) columns.push_back(&column);
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> numbers = number_alike(columns, strides, corners_.all.size(), first);
    for (Values* values : all) {
      values->floats = gathered<std::uint32_t>(values->floats, static_cast<std::size_t>(values->components), first);
    }
    return numbers;
  }

  int add(const Values& values, bool with_bounds) {
    static constexpr std::array<const char*, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
    AccessorBytes made;
    const auto width = static_cast<std::size_t>(values.components);
    made.component_type = values.component_type;
    made.type = width == 16 ? "MAT4" : width == 9 ? "MAT3" : kTypes[width - 1];
    made.count = values.floats.size() / width;
    made.normalized = values.normalized;
    made.bytes = encoded(values);
    made.stride = static_cast<int>(stride_of(values));
    const int tight =
        values.components * tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(values.component_type));
    if (made.stride == tight) made.stride = 0;
    made.target = TINYGLTF_TARGET_ARRAY_BUFFER;
    if (with_bounds) add_bounds(values, made);
    return rewrite_.add(std::move(made));
  }

  /// As glTF stores them: integers as they are.
  static void add_bounds(const Values& values, AccessorBytes& made) {
    const double unit = !values.normalized ? 1 : most_of(values.component_type);
    const auto width = static_cast<std::size_t>(values.components);
    for (std::size_t c = 0; c < width; ++c) {
      float low = std::numeric_limits<float>::infinity();
      float high = -low;
      for (std::size_t i = c; i < values.floats.size(); i += width) {
        low = std::min(low, values.floats[i]);
        high = std::max(high, values.floats[i]);
      }
      made.min.push_back(low * unit);
      made.max.push_back(high * unit);
    }
  }

  static double most_of(int component_type) {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::numeric_limits<std::int8_t>::max();
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return std::numeric_limits<std::uint8_t>::max();
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::numeric_limits<std::int16_t>::max();
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return std::numeric_limits<std::uint16_t>::max();
      default:
        return 1;
    }
  }

  int add_indices(const std::vector<std::uint32_t>& indices) {
    const std::uint32_t most = indices.empty() ? 0 : *std::max_element(indices.begin(), indices.end());
    const bool narrow = most < std::numeric_limits<std::uint16_t>::max();
    AccessorBytes made;
    made.component_type = narrow ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    made.count = indices.size();
    made.target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    for (const std::uint32_t index : indices) {
      for (int shift = 0; shift < (narrow ? 16 : 32); shift += 8) {
        made.bytes.push_back(static_cast<unsigned char>(index >> shift));
      }
    }
    return rewrite_.add(std::move(made));
  }

  GltfRewrite& rewrite_;
  const GltfFile& file_;
  json& json_;
  const CutPrimitive& cut_;
  int set_;
  bool drops_tangents_;
  std::vector<Values> old_;
  std::vector<std::vector<Values>> targets_;
  Corners corners_;
};

}  // namespace

void rewrite_primitives(GltfRewrite& rewrite, GltfDocument& document, const std::vector<CutPrimitive>& primitives,
                        int set) {
  std::vector<PrimitiveWriter> writers;
  writers.reserve(primitives.size());
  for (const CutPrimitive& cut : primitives) writers.emplace_back(rewrite, document, cut, set).read();
  for (PrimitiveWriter& writer : writers) writer.write();
}

}  // namespace lozenge
