// Facts gathered once, as lines for people and as JSON for scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "stages/info/info.h"

namespace lozenge {

using Json = nlohmann::ordered_json;

class Facts {
 public:
  explicit Facts(std::string_view kind) {
    info_.kind = kind;
    json_["kind"] = info_.kind;
  }

  /// \param line  is left out where it is empty
  void add(const std::string& key, Json value, const std::string& line) {
    json_[key] = std::move(value);
    if (!line.empty()) info_.lines.push_back(line);
  }
  void line(const std::string& text) { info_.lines.push_back(text); }

  FileInfo take() {
    info_.json = json_.dump(2, ' ', false, Json::error_handler_t::replace);
    return std::move(info_);
  }

 private:
  FileInfo info_;
  Json json_;
};

}  // namespace lozenge
