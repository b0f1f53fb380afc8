// Recursion is as deep as the document was, whose depth is bounded (json.h).
#include "formats/files/readers/gltf/values.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

namespace lozenge {

namespace {

using nlohmann::ordered_json;
using tinygltf::Value;

ordered_json json_of(const Value& value) {
  if (value.IsBool()) return value.Get<bool>();
  if (value.IsInt()) return value.GetNumberAsInt();
  if (value.IsNumber()) return value.GetNumberAsDouble();
  if (value.IsString()) return value.Get<std::string>();
  if (value.IsArray()) {
    ordered_json list = ordered_json::array();
    for (const Value& element : value.Get<Value::Array>()) list.push_back(json_of(element));
    return list;
  }
  if (value.IsObject()) {
    ordered_json object = ordered_json::object();
    for (const auto& [key, member] : value.Get<Value::Object>()) object[key] = json_of(member);
    return object;
  }
  return nullptr;
}

Value value_of(const ordered_json& json) {
  if (json.is_boolean()) return Value(json.get<bool>());
  if (json.is_number_integer()) return Value(json.get<int>());
  if (json.is_number()) return Value(json.get<double>());
  if (json.is_string()) return Value(json.get<std::string>());
  if (json.is_array()) {
    Value::Array list;
    for (const ordered_json& element : json) list.push_back(value_of(element));
    return Value(std::move(list));
  }
  if (json.is_object()) {
    Value::Object object;
    for (const auto& [key, member] : json.items()) object[key] = value_of(member);
    return Value(std::move(object));
  }
  return {};
}

}  // namespace

std::string text_of(const Value& value) {
  if (value.Type() == tinygltf::NULL_TYPE) return {};
  return json_of(value).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Value value_of(const std::string& text) {
  if (text.empty()) return {};
  return value_of(ordered_json::parse(text, nullptr, false));
}

}  // namespace lozenge
