// What tinygltf keeps of values that mean nothing to it, as JSON and back.
#pragma once

#include <string>

namespace tinygltf {
class Value;
}

namespace lozenge {

/// Empty where there is no value.
std::string text_of(const tinygltf::Value& value);

/// \pre the text is one that `text_of` made
tinygltf::Value value_of(const std::string& text);

}  // namespace lozenge
