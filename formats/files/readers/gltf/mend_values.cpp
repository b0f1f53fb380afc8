// A walk over the whole document: what a value stands for is known by its key, wherever it is.
#include "formats/files/readers/gltf/mend_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace lozenge {

namespace {

using nlohmann::json;

/// Numbers under these keys are whole, wherever they are.
constexpr std::array<std::string_view, 32> kWholes{"buffer",     "bufferView", "byteOffset",    "byteLength",
                                                   "byteStride", "camera",     "componentType", "count",
                                                   "index",      "indices",    "input",         "light",
                                                   "magFilter",  "material",   "mesh",          "minFilter",
                                                   "mode",       "node",       "output",        "sampler",
                                                   "scene",      "skeleton",   "skin",          "source",
                                                   "target",     "texCoord",   "wrapS",         "wrapT",
                                                   "children",   "joints",     "nodes",         "inverseBindMatrices"};

/// Where these are absent, there is none.
constexpr std::array<std::string_view, 11> kOptional{"bufferView", "camera", "indices", "inverseBindMatrices",
                                                     "material",   "mesh",   "sampler", "scene",
                                                     "skeleton",   "skin",   "source"};

/// All values of these objects are whole.
constexpr std::array<std::string_view, 2> kObjectsOfWholes{"attributes", "targets"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool is_whole_as_fraction(const json& value) {
  if (!value.is_number_float()) return false;
  const double number = value.get<double>();
  return std::trunc(number) == number && std::abs(number) <= 9007199254740992.0;  // 2^53: exact
}

class Walk {
 public:
  Walk(const std::string& name, Deviations& deviations) : name_(name), deviations_(deviations) {}

  /// \param key  that the value is under, or the list that it is in
  void visit(json& value, std::string_view key, bool is_whole) {
    if (value.is_object()) visit_object(value, is_whole || is_among(kObjectsOfWholes, key));
    else if (value.is_array()) visit_list(value, key, is_whole);
    else if (is_whole && is_whole_as_fraction(value)) make_whole(value);
  }

 private:
  void visit_object(json& object, bool all_whole) {
    for (auto member = object.begin(); member != object.end();) {
      const std::string& key = member.key();
      place_.push_back(key);
      if (key != "extras") {
        if (is_superfluous(key, member.value(), all_whole)) {
          member = object.erase(member);
          place_.pop_back();
          continue;
        }
        // What is below an attribute's name isn't the attribute's: extensions of the object.
        visit(member.value(), key, (all_whole && key != "extensions") || is_among(kWholes, key));
      }
      place_.pop_back();
      ++member;
    }
  }

  void visit_list(json& list, std::string_view key, bool is_whole) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      place_.push_back(std::to_string(i));
      if (names_none(list[i], key)) found(Deviation::kMinusOne, list[i]);
      visit(list[i], key, is_whole && !list[i].is_object());
      place_.pop_back();
    }
    std::erase_if(list.get_ref<json::array_t&>(), [&](const json& element) { return names_none(element, key); });
  }

  static bool names_none(const json& element, std::string_view key) {
    return (key == "nodes" || key == "children") && element.is_number() && element.get<double>() < 0;
  }

  bool is_superfluous(const std::string& key, json& value, bool all_whole) {
    if (value.is_null()) return found(Deviation::kNull, value);
    if (key == "name" && !value.is_string()) return found(Deviation::kWrongType, value);
    const bool may_be_none = all_whole || is_among(kOptional, key);
    const bool is_minus_one = value.is_number() && value.get<double>() == -1;
    return may_be_none && is_minus_one && found(Deviation::kMinusOne, value);
  }

  void make_whole(json& value) {
    found(Deviation::kWholeNumber, value);
    const auto number = static_cast<std::int64_t>(value.get<double>());
    if (number < 0) value = number;
    else value = static_cast<std::uint64_t>(number);
  }

  bool found(Deviation kind, const json& value) {
    std::string text = name_ + ": ";
    for (const std::string& step : place_) text += "/" + step;
    deviations_.add(kind, text + " is " + (value.is_structured() ? "no text" : value.dump()));
    return true;
  }

  const std::string& name_;
  Deviations& deviations_;
  std::vector<std::string> place_;
};

/// A list of the document, and what messages call its elements.
struct ObjectList {
  const char* key;
  const char* noun;
};

constexpr std::array<ObjectList, 13> kLists{{{"buffers", "buffer"},
                                             {"bufferViews", "buffer view"},
                                             {"accessors", "accessor"},
                                             {"meshes", "mesh"},
                                             {"nodes", "node"},
                                             {"scenes", "scene"},
                                             {"materials", "material"},
                                             {"textures", "texture"},
                                             {"images", "image"},
                                             {"samplers", "sampler"},
                                             {"skins", "skin"},
                                             {"animations", "animation"},
                                             {"cameras", "camera"}}};

/// It is a list, its elements are objects.
void mend_list(json& owner, const ObjectList& list, const std::string& prefix, Deviations& deviations) {
  const auto at = owner.find(list.key);
  if (at == owner.end()) return;
  if (!at->is_array()) {
    deviations.lose(Deviation::kWrongType, prefix + list.key + " is not a list");
    owner.erase(at);
    return;
  }
  for (std::size_t i = 0; i < at->size(); ++i) {
    if ((*at)[i].is_object()) continue;
    deviations.lose(Deviation::kWrongType, prefix + list.noun + " " + std::to_string(i) + ": is not a JSON object");
    (*at)[i] = json::object();
  }
}

}  // namespace

void mend_gltf_values(json& document, const std::string& name, Deviations& deviations) {
  for (const ObjectList& list : kLists) mend_list(document, list, name + ": ", deviations);
  if (const auto meshes = document.find("meshes"); meshes != document.end()) {
    for (std::size_t m = 0; m < meshes->size(); ++m) {
      mend_list((*meshes)[m], {"primitives", "primitive"}, name + ": mesh " + std::to_string(m) + " ", deviations);
    }
  }
  Walk(name, deviations).visit(document, "", false);
}

}  // namespace lozenge
