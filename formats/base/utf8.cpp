#include "formats/base/utf8.h"

#include <nlohmann/json.hpp>

namespace lozenge {

std::string valid_utf8(std::string_view text) {
  // The JSON library knows how to write any bytes; what it wrote is read back.
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

}  // namespace lozenge
