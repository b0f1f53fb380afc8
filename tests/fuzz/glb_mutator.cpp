// A change of some random byte breaks a GLB's lengths or its JSON, and gets no farther. So one of the two chunks is
// changed alone, and the file is put together again with the right lengths around it; values of the JSON are replaced
// as a whole, too.
#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <string>

#include "tests/fuzz/mutator.h"

namespace {

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::string word(std::size_t value) {
  const auto stored = static_cast<std::uint32_t>(value);
  return {reinterpret_cast<const char*>(&stored), 4};
}

/// The JSON and the binary chunk of a GLB; false where it is none.
bool take_apart(const std::string& glb, std::string& json, std::string& binary) {
  if (glb.size() < 20 || glb.compare(0, 4, "glTF") != 0) return false;
  const std::size_t length = word_at(glb, 12);
  if (length > glb.size() - 20) return false;
  json = glb.substr(20, length);
  if (glb.size() >= 28 + length) binary = glb.substr(28 + length);
  return true;
}

std::string put_together(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string chunks = word(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

void mutate(std::string& text, std::size_t room) {
  const std::size_t size = text.size();
  text.resize(size + room);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
}

/// Puts another number in place of one in the JSON.
void replace_number(std::string& json, std::minstd_rand& random) {
  static constexpr std::array<const char*, 16> kNumbers{
      "0",    "1",    "2",        "3",     "4",          "5120",       "5121",  "5123",
      "5125", "5126", "16777216", "65536", "2147483647", "4294967295", "1e308", "-1"};
  const char* digits = "0123456789";
  const std::size_t at = json.find_first_of(digits, random() % json.size());
  if (at == std::string::npos) return;
  const std::size_t end = std::min(json.find_first_not_of(digits, at), json.size());
  json.replace(at, end - at, random() % 2 == 0 ? kNumbers[random() % kNumbers.size()] : std::to_string(random() % 64));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  std::string json;
  std::string binary;
  const bool whole = random() % 16 == 0;
  if (whole || !take_apart({reinterpret_cast<const char*>(data), size}, json, binary) || json.empty()) {
    return LLVMFuzzerMutate(data, size, max_size);
  }
  switch (random() % 4) {
    case 0:
      mutate(json, 16);
      break;
    case 1:
      mutate(binary, 16);
      break;
    default:
      replace_number(json, random);
  }
  const std::string glb = put_together(std::move(json), std::move(binary));
  if (glb.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(glb.begin(), glb.end(), data);
  return glb.size();
}
