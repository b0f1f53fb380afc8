// Ranges were checked when the file was opened (gltf_check.h); what is left to check here are the values.
#include "formats/files/readers/gltf/accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "formats/base/error.h"

namespace lozenge {

namespace {

using tinygltf::Accessor;
using tinygltf::Model;

/// Elements of a buffer view: `count` of them, `stride` bytes apart.
struct Elements {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
};

std::size_t size_of_component(int type) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
}

Elements elements_of(const Model& model, int view, std::size_t offset, std::size_t element_size) {
  const tinygltf::BufferView& v = model.bufferViews[view];
  return {model.buffers[v.buffer].data.data() + v.byteOffset + offset, v.byteStride == 0 ? element_size : v.byteStride};
}

/// Calls `work` with a value of the type that the component type stands for.
template <typename Work>
void with_component_type(int type, Work&& work) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return work(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return work(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return work(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return work(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return work(std::uint32_t{});
    default:
      return work(float{});
  }
}

template <typename T>
T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// glTF 2.0 specification, Sec. 3.11: signed values have one step too many at their low end.
template <typename T>
float to_float(T value, bool normalized) {
  if constexpr (std::is_integral_v<T>) {
    if (normalized) {
      const double unit = static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max());
      return static_cast<float>(std::max(unit, -1.0));
    }
  }
  return static_cast<float>(value);
}

template <typename From, typename To, typename Convert>
void copy_elements(const Elements& from, std::size_t count, std::size_t components, To* to, Convert convert) {
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned char* element = from.data + i * from.stride;
    for (std::size_t c = 0; c < components; ++c) *to++ = convert(load<From>(element + c * sizeof(From)));
  }
}

std::string accessor_name(const GltfFile& file, int accessor) {
  return file.name + ": accessor " + std::to_string(accessor);
}

/// The elements that the sparse part replaces, in ascending order as the specification demands.
std::vector<std::uint32_t> sparse_targets(const GltfFile& file, int id) {
  const Accessor& accessor = file.model->accessors[id];
  const auto& sparse = accessor.sparse;
  std::vector<std::uint32_t> targets(static_cast<std::size_t>(sparse.count));
  with_component_type(sparse.indices.componentType, [&](auto zero) {
    using T = decltype(zero);
    const auto from = elements_of(*file.model, sparse.indices.bufferView,
                                  static_cast<std::size_t>(sparse.indices.byteOffset), sizeof(T));
    copy_elements<T>({from.data, sizeof(T)}, targets.size(), 1, targets.data(),
                     [](T value) { return static_cast<std::uint32_t>(value); });
  });
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] >= accessor.count || (i > 0 && targets[i] <= targets[i - 1])) {
      throw Error(ExitCode::kUnusableInput, accessor_name(file, id) + ": sparse index " + std::to_string(i) + " is " +
                                                std::to_string(targets[i]) +
                                                "; they must ascend and stay below its count of " +
                                                std::to_string(accessor.count));
    }
  }
  return targets;
}

/// The elements of the accessor, each component through `convert`, which takes any component type.
/// \param chosen  ascending; all where null
template <typename To, typename Convert>
std::vector<To> read_elements(const GltfFile& file, int id, const std::vector<std::uint32_t>* chosen, Convert convert) {
  const Model& model = *file.model;
  const Accessor& accessor = model.accessors[id];
  const auto components = static_cast<std::size_t>(accessor_facts(file, id).components);
  const std::size_t size = components * size_of_component(accessor.componentType);
  std::vector<To> values((chosen != nullptr ? chosen->size() : accessor.count) * components);
  with_component_type(accessor.componentType, [&](auto zero) {
    using T = decltype(zero);
    const auto copy = [&](const Elements& from, std::size_t count, std::size_t to) {
      copy_elements<T>(from, count, components, values.data() + to * components, convert);
    };
    if (accessor.bufferView >= 0) {
      const Elements all = elements_of(model, accessor.bufferView, accessor.byteOffset, size);
      if (chosen == nullptr) copy(all, accessor.count, 0);
      for (std::size_t i = 0; chosen != nullptr && i < chosen->size(); ++i) {
        copy({all.data + (*chosen)[i] * all.stride, all.stride}, 1, i);
      }
    }
    if (!accessor.sparse.isSparse) return;
    const std::vector<std::uint32_t> targets = sparse_targets(file, id);
    const auto& replaced = accessor.sparse.values;
    Elements from = elements_of(model, replaced.bufferView, static_cast<std::size_t>(replaced.byteOffset), size);
    for (const std::uint32_t target : targets) {
      if (chosen == nullptr) {
        copy({from.data, size}, 1, target);
      } else if (const auto at = std::lower_bound(chosen->begin(), chosen->end(), target);
                 at != chosen->end() && *at == target) {
        copy({from.data, size}, 1, static_cast<std::size_t>(at - chosen->begin()));
      }
      from.data += size;
    }
  });
  return values;
}

}  // namespace

AccessorFacts accessor_facts(const GltfFile& file, int id) {
  const Accessor& accessor = file.model->accessors[id];
  AccessorFacts facts;
  facts.count = accessor.count;
  facts.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  facts.is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  facts.is_signed =
      accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE || accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
  facts.normalized = accessor.normalized;
  return facts;
}

bool may_hold(Integers integers, const AccessorFacts& facts, bool is_quantized) {
  if (facts.is_float) return true;
  if (integers != Integers::kQuantized && facts.normalized && !facts.is_signed) return true;
  return integers != Integers::kNormalized && is_quantized;
}

std::vector<float> read_floats(const GltfFile& file, int id) {
  const bool normalized = file.model->accessors[id].normalized;
  return read_elements<float>(file, id, nullptr, [normalized](auto value) { return to_float(value, normalized); });
}

std::vector<float> read_floats_of(const GltfFile& file, int id, const std::vector<std::uint32_t>& elements) {
  const bool normalized = file.model->accessors[id].normalized;
  return read_elements<float>(file, id, &elements, [normalized](auto value) { return to_float(value, normalized); });
}

std::vector<std::uint32_t> read_indices(const GltfFile& file, int id, std::uint64_t vertices,
                                        const std::string& place) {
  const AccessorFacts facts = accessor_facts(file, id);
  if (facts.components != 1 || facts.is_float || facts.is_signed || facts.normalized) {
    throw Error(ExitCode::kUnusableInput,
                accessor_name(file, id) + ": holds no unsigned integers, but is used as the indices of " + place);
  }
  auto indices =
      read_elements<std::uint32_t>(file, id, nullptr, [](auto value) { return static_cast<std::uint32_t>(value); });
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices) {
      throw Error(ExitCode::kUnusableInput, file.name + ": " + place + ": index " + std::to_string(i) + " is " +
                                                std::to_string(indices[i]) + ", but there are " +
                                                std::to_string(vertices) + " vertices");
    }
  }
  return indices;
}

}  // namespace lozenge
