// Text from outside (file names, EXR attributes), made safe for JSON.
#pragma once

#include <string>
#include <string_view>

namespace lozenge {

/// `text` with U+FFFD in place of every byte that isn't part of well-formed UTF-8. JSON, and so glTF, takes nothing
/// else.
std::string valid_utf8(std::string_view text);

}  // namespace lozenge
