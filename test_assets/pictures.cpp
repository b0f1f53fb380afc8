#include "test_assets/pictures.h"

namespace lozenge::test_assets {

std::vector<std::uint8_t> hills() {
  return picture([](double x, double y) {
    const double dx = 0.4 * std::cos(kTurn * x);
    const double dy = 0.4 * std::cos(kTurn * y);
    const double length = std::sqrt(dx * dx + dy * dy + 1);
    return Shares{0.5 - 0.5 * dx / length, 0.5 + 0.5 * dy / length, 0.5 + 0.5 / length};
  });
}

void add_image(Encoded& encoded, nlohmann::json& root, const std::string& name, const std::vector<std::uint8_t>& png) {
  encoded.binary.resize((encoded.binary.size() + 3) / 4 * 4);
  root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", encoded.binary.size()}, {"byteLength", png.size()}});
  encoded.binary.insert(encoded.binary.end(), png.begin(), png.end());
  root["images"].push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", root["bufferViews"].size() - 1}});
}

}  // namespace lozenge::test_assets
