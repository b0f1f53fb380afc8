// One rule for all: a part is checked as a strict reader would; where that throws, the part goes, and what it said is
// kept as the reason for whatever needs it. Only what would take absurd memory is refused.
#include "formats/files/readers/gltf/mend_structure.h"

#include <algorithm>
#include <array>
#include <optional>

#include "formats/files/readers/gltf/accessor.h"
#include "formats/files/readers/gltf/json.h"
#include "formats/files/readers/gltf/mend_nodes.h"
#include "formats/surface/attribute.h"

namespace lozenge {

namespace {

using nlohmann::json;

/// Elements that an accessor without a buffer view may have: it is all zeros, but for its sparse part, and its size is
/// not vouched for by bytes in the file.
constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 24;

std::uint64_t component_size(const GltfObject& owner, std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      owner.broken("componentType " + std::to_string(type) + " does not exist in glTF 2.0");
  }
}

/// Bytes of one element, the padding of small matrices' columns included.
std::uint64_t element_size(const GltfObject& owner, const std::string& type, std::uint64_t component) {
  static const std::map<std::string, std::uint64_t> vectors{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  static const std::map<std::string, std::uint64_t> matrices{{"MAT2", 2}, {"MAT3", 3}, {"MAT4", 4}};
  if (const auto at = vectors.find(type); at != vectors.end()) return at->second * component;
  if (const auto at = matrices.find(type); at != matrices.end()) {
    const std::uint64_t column = (at->second * component + 3) / 4 * 4;
    return column * at->second;
  }
  owner.broken("type \"" + type + "\" does not exist in glTF");
}

/// What is wrong where `check` throws; nothing where it doesn't. \throws Error(kLimit) as it does
template <typename Check>
std::optional<std::string> defect_of(const Check& check) {
  try {
    check();
  } catch (const Error& error) {
    if (error.code() == ExitCode::kLimit) throw;
    return error.what();
  }
  return std::nullopt;
}

/// The kind of an attribute that is read, by its name in files.
const AttributeKind* kind_of(const std::string& attribute) {
  for (const AttributeKind& kind : kAttributeKinds) {
    if (kind == kInfluences) continue;
    if (attribute == kind.loose_semantic) return &kind;
    for (int set = 0; set < kind.sets; ++set) {
      if (attribute == attribute_name(kind, set)) return &kind;
    }
  }
  return nullptr;
}

class StructureMender {
 public:
  StructureMender(json& document, const std::vector<std::uint64_t>& buffer_sizes, const GltfDefects& defects,
                  const std::string& name, Deviations& deviations)
      : document_(document), buffer_sizes_(buffer_sizes), defects_(defects), name_(name), deviations_(deviations) {}

  void run() {
    for (std::uint64_t i = 0; i < list("bufferViews").size(); ++i) mend_view(i);
    for (std::uint64_t i = 0; i < list("accessors").size(); ++i) mend_accessor(i);
    is_quantized_ = uses("KHR_mesh_quantization");
    std::vector<bool> has_primitives;
    for (std::uint64_t i = 0; i < list("meshes").size(); ++i) has_primitives.push_back(mend_mesh(i));
    const auto require_accessor = [&](const GltfObject& owner, const char* key) { sound_accessor(owner, key); };
    mend_gltf_nodes(document_, has_primitives, require_accessor, name_, deviations_);
    for (std::uint64_t i = 0; i < list("images").size(); ++i) mend_image(i);
  }

 private:
  struct View {
    std::uint64_t length = 0;
    std::uint64_t stride = 0;
    std::optional<std::string> defect;
  };
  struct Accessor {
    AccessorFacts facts;  ///< but for its components
    std::string type;
    bool has_view = false;
    std::optional<std::string> defect;
  };

  /// Empty where the document has none.
  json& list(const char* key) {
    const auto at = document_.find(key);
    return at != document_.end() ? *at : none_;
  }

  std::string place(const char* noun, std::uint64_t number) const {
    return name_ + ": " + noun + " " + std::to_string(number);
  }

  void mend_view(std::uint64_t number) {
    json& value = list("bufferViews")[number];
    const GltfObject view(value, place("buffer view", number));
    View& found = views_.emplace_back();
    if (const auto known = defects_.views.find(number); known != defects_.views.end()) {
      found.defect = known->second;
    } else {
      if (view.whole_or_none("byteStride") == 0U) {
        deviations_.add(Deviation::kNoStride,
                        view.place() + ": byteStride is 0; it must be a multiple of 4 from 4 to 252");
        value.erase("byteStride");
      }
      found.defect = defect_of([&] { check_view(view, found); });
      if (found.defect) deviations_.add(Deviation::kBrokenData, *found.defect);
    }
    if (found.defect) value = {{"buffer", 0U}, {"byteLength", 1U}};
  }

  void check_view(const GltfObject& view, View& found) const {
    const std::uint64_t buffer = view.required_index("buffer", buffer_sizes_.size());
    const std::uint64_t offset = view.whole_or("byteOffset", 0);
    found.length = view.required_whole("byteLength");
    found.stride = view.whole_or("byteStride", 0);
    if (found.length == 0) view.broken("byteLength is 0");
    if (offset + found.length > buffer_sizes_[buffer]) {
      if (const auto short_one = defects_.buffers.find(buffer); short_one != defects_.buffers.end())
        throw Error(ExitCode::kUnusableInput, short_one->second);
      view.broken("ends " + std::to_string(offset + found.length - buffer_sizes_[buffer]) + " bytes past buffer " +
                  std::to_string(buffer) + ", which has " + std::to_string(buffer_sizes_[buffer]));
    }
    const std::uint64_t stride = found.stride;
    if (view.has("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0)) {
      view.broken("byteStride is " + std::to_string(stride) + "; it must be a multiple of 4 from 4 to 252");
    }
  }

  /// \throws Error(kUnusableInput) with the view's defect where it has one
  std::uint64_t sound_view(const GltfObject& owner, std::uint64_t view) const {
    if (view >= views_.size()) owner.broken("bufferView is " + std::to_string(view));
    if (views_[view].defect) throw Error(ExitCode::kUnusableInput, *views_[view].defect);
    return view;
  }

  /// `count` elements of `size` bytes, `stride` apart (0: tightly), from `offset`, lie inside the view.
  void check_range(const GltfObject& owner, std::uint64_t view, std::uint64_t offset, std::uint64_t count,
                   std::uint64_t size, std::uint64_t stride) const {
    const std::uint64_t length = views_[sound_view(owner, view)].length;
    const std::uint64_t step = stride == 0 ? size : stride;
    if (step < size)
      owner.broken("its elements of " + std::to_string(size) + " bytes overlap, byteStride is " + std::to_string(step));
    const std::uint64_t end = offset + (count - 1) * step + size;
    if (end > length) {
      owner.broken("ends " + std::to_string(end - length) + " bytes past buffer view " + std::to_string(view) +
                   ", which has " + std::to_string(length));
    }
  }

  void mend_accessor(std::uint64_t number) {
    json& value = list("accessors")[number];
    const GltfObject accessor(value, place("accessor", number));
    Accessor& found = accessors_.emplace_back();
    found.defect = defect_of([&] { check_accessor(accessor, found); });
    if (!found.defect) return;
    const bool is_known = std::any_of(views_.begin(), views_.end(),
                                      [&](const View& view) { return view.defect && *view.defect == *found.defect; });
    if (!is_known) deviations_.add(Deviation::kBrokenData, *found.defect);
    value = {{"componentType", 5126U}, {"count", 1U}, {"type", "SCALAR"}};
  }

  void check_accessor(const GltfObject& accessor, Accessor& found) const {
    const std::uint64_t component_type = accessor.required_whole("componentType");
    const std::uint64_t component = component_size(accessor, component_type);
    found.facts.is_float = component_type == 5126;
    found.facts.is_signed = component_type == 5120 || component_type == 5122;
    found.type = accessor.text("type");
    const std::uint64_t size = element_size(accessor, found.type, component);
    // At most 2^40 elements 252 bytes apart: no sum overflows.
    const std::uint64_t count = found.facts.count = accessor.required_whole("count");
    const std::uint64_t offset = accessor.whole_or("byteOffset", 0);
    if (count == 0) accessor.broken("count is 0");
    if (accessor.has("normalized")) {
      const json& normalized = accessor.value()["normalized"];
      if (!normalized.is_boolean()) accessor.broken("normalized is neither true nor false");
      found.facts.normalized = normalized.get<bool>();
    }
    if (const auto view = accessor.index("bufferView", views_.size())) {
      check_range(accessor, *view, offset, count, size, views_[*view].stride);
      found.has_view = true;
    }
    if (const auto sparse = accessor.object("sparse")) check_sparse(*sparse, count, size);
  }

  void check_sparse(const GltfObject& sparse, std::uint64_t count, std::uint64_t size) const {
    const std::uint64_t replaced = sparse.required_whole("count", INT32_MAX);
    if (replaced == 0 || replaced > count) {
      sparse.broken("count is " + std::to_string(replaced) + " of " + std::to_string(count) + " elements");
    }
    const auto indices = sparse.object("indices");
    const auto values = sparse.object("values");
    if (!indices || !values) sparse.broken("indices or values are missing");
    const std::uint64_t type = indices->required_whole("componentType");
    if (type != 5121 && type != 5123 && type != 5125)
      indices->broken("componentType " + std::to_string(type) + " is not unsigned");
    // tinygltf keeps the count and these offsets as int.
    check_range(*indices, indices->required_index("bufferView", views_.size()),
                indices->whole("byteOffset", INT32_MAX).value_or(0), replaced, component_size(*indices, type), 0);
    check_range(*values, values->required_index("bufferView", views_.size()),
                values->whole("byteOffset", INT32_MAX).value_or(0), replaced, size, 0);
  }

  /// \return whether it has a primitive
  bool mend_mesh(std::uint64_t number) {
    json& mesh = list("meshes")[number];
    json kept = json::array();
    const auto given = mesh.find("primitives");
    if (given == mesh.end() || !given->is_array() || given->empty()) {
      deviations_.add(Deviation::kNoPrimitives, place("mesh", number) + ": has no primitives");
    } else {
      for (std::uint64_t p = 0; p < given->size(); ++p) {
        const std::string where = place("mesh", number) + " primitive " + std::to_string(p);
        if (const auto defect = defect_of_primitive((*given)[p], where, {number, p})) {
          deviations_.lose(Deviation::kBrokenPrimitive, *defect);
        } else {
          kept.push_back(std::move((*given)[p]));
        }
      }
    }
    const bool has_any = !kept.empty();
    mesh["primitives"] = std::move(kept);
    return has_any;
  }

  /// Mends what can be mended of it. \return why it can't be read
  std::optional<std::string> defect_of_primitive(json& value, const std::string& where,
                                                 const std::pair<std::uint64_t, std::uint64_t>& number) {
    if (const auto known = defects_.primitives.find(number); known != defects_.primitives.end()) return known->second;
    return defect_of([&] {
      const GltfObject primitive(value, where);
      const auto attributes = primitive.object("attributes");
      if (!attributes) primitive.broken("attributes are missing");
      if (!attributes->has("POSITION")) primitive.broken("has no POSITION");
      const std::uint64_t positions = sound_accessor(*attributes, "POSITION");
      const std::uint64_t corners =
          accessors_[primitive.has("indices") ? sound_accessor(primitive, "indices") : positions].facts.count;
      constexpr std::uint64_t kTriangles = 4;
      const std::uint64_t mode = primitive.whole("mode", 6).value_or(kTriangles);
      if (mode == kTriangles && corners % 3 != 0) {
        const std::string text = "has " + std::to_string(corners) + " corners, which is not a multiple of 3";
        if (corners < 3) primitive.broken(text);
        deviations_.add(Deviation::kLeftOverCorners, where + ": " + text);
      }
      mend_attributes(value, where, positions);
      mend_targets(value, where);
      if (!defect_of([&] { primitive.index("material", list("materials").size()); })) return;
      deviations_.add(Deviation::kNothingThere, where + ": material is " + value["material"].dump() +
                                                    ", but there are " + std::to_string(list("materials").size()));
      value.erase("material");
    });
  }

  /// The accessor under a key, which can be read. \throws Error(kUnusableInput), Error(kLimit)
  std::uint64_t sound_accessor(const GltfObject& owner, const char* key) const {
    const std::uint64_t number = owner.required_index(key, accessors_.size());
    const Accessor& accessor = accessors_[number];
    if (accessor.defect) throw Error(ExitCode::kUnusableInput, *accessor.defect);
    if (!accessor.has_view && accessor.facts.count > kMostZeros) {
      throw Error(ExitCode::kLimit, place("accessor", number) + ": has no buffer view and a count of " +
                                        std::to_string(accessor.facts.count) + "; at most " +
                                        std::to_string(kMostZeros) + " are read");
    }
    return number;
  }

  /// Takes out those that the mesh can be read without.
  void mend_attributes(json& primitive, const std::string& where, std::uint64_t positions) {
    json& attributes = primitive["attributes"];
    for (auto at = attributes.begin(); at != attributes.end();) {
      const std::string& name = at.key();
      const auto defect = defect_of([&] {
        const GltfObject owner(attributes, where);
        const std::uint64_t accessor = sound_accessor(owner, name.c_str());
        if (const AttributeKind* kind = kind_of(name)) check_attribute(owner, name, *kind, accessor, positions);
      });
      if (defect) {
        deviations_.add(Deviation::kBrokenAttribute, *defect);
        at = attributes.erase(at);
      } else {
        ++at;
      }
    }
  }

  void check_attribute(const GltfObject& owner, const std::string& name, const AttributeKind& kind,
                       std::uint64_t number, std::uint64_t positions) const {
    const Accessor& accessor = accessors_[number];
    static constexpr std::array<const char*, 5> kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto is_of = [&](int components) {
      return components > 0 && components < 5 && accessor.type == kTypes[static_cast<std::size_t>(components)];
    };
    if (!(is_of(kind.components) || is_of(kind.fewest_components)) ||
        !may_hold(kind.integers, accessor.facts, is_quantized_)) {
      owner.broken(name + " is of a type that glTF doesn't allow for it");
    }
    if (accessor.facts.count != accessors_[positions].facts.count) {
      owner.broken(name + " has " + std::to_string(accessor.facts.count) + " elements, but there are " +
                   std::to_string(accessors_[positions].facts.count) + " vertices");
    }
  }

  /// All of them, or none.
  void mend_targets(json& primitive, const std::string& where) {
    const auto targets = primitive.find("targets");
    if (targets == primitive.end()) return;
    const auto defect = defect_of([&] {
      for (const GltfObject& target : GltfObject(primitive, where).list("targets", where + " ", "morph target")) {
        for (const auto& [name, value] : target.value().items()) sound_accessor(target, name.c_str());
      }
    });
    if (!defect) return;
    deviations_.add(Deviation::kBrokenAttribute, *defect);
    primitive.erase("targets");
  }

  void mend_image(std::uint64_t number) {
    json& image = list("images")[number];
    for (const char* key : {"uri", "mimeType"}) {
      if (!image.contains(key) || image[key].is_string()) continue;
      deviations_.add(Deviation::kWrongType, place("image", number) + ": " + key + " is not a text");
      image.erase(key);
    }
    const auto defect = defect_of([&] {
      const GltfObject object(image, place("image", number));
      if (const auto view = object.index("bufferView", views_.size())) sound_view(object, *view);
    });
    if (!defect) return;
    deviations_.add(Deviation::kNothingThere, *defect);
    image.erase("bufferView");
  }

  bool uses(const char* extension) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
      const json& names = list(key);
      if (names.is_array() && std::find(names.begin(), names.end(), extension) != names.end()) return true;
    }
    return false;
  }

  json& document_;
  const std::vector<std::uint64_t>& buffer_sizes_;
  const GltfDefects& defects_;
  const std::string& name_;
  Deviations& deviations_;
  json none_ = json::array();
  bool is_quantized_ = false;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
};

}  // namespace

void mend_gltf_structure(json& document, const std::vector<std::uint64_t>& buffer_sizes, const GltfDefects& defects,
                         const std::string& name, Deviations& deviations) {
  StructureMender(document, buffer_sizes, defects, name, deviations).run();
}

}  // namespace lozenge
