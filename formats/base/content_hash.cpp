// RFC 7693, Sec. 3: a state of eight words; blocks of sixteen are mixed into it in twelve rounds, each of which takes
// the words in another order. The last block is filled with zeros, and says that it is the last.
#include "formats/base/content_hash.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "formats/base/error.h"

namespace lozenge {
namespace {

constexpr std::size_t kBytes = 32;  ///< of a hash

/// Sec. 2.6: the fractional parts of the square roots of the first eight primes.
constexpr std::array<std::uint64_t, 8> kInitial{0x6a09e667f3bcc908, 0xbb67ae8584caa73b, 0x3c6ef372fe94f82b,
                                                0xa54ff53a5f1d36f1, 0x510e527fade682d1, 0x9b05688c2b3e6c1f,
                                                0x1f83d9abfb41bd6b, 0x5be0cd19137e2179};

/// Sec. 2.7: in which order a round takes the words of the block; the eleventh is the first again.
constexpr std::array<std::array<std::uint8_t, 16>, 10> kOrder{{
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
    {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
    {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
    {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
    {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
    {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
    {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
    {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
    {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0},
}};
constexpr int kRounds = 12;

/// Little-endian, as the RFC has it.
std::uint64_t word_at(const unsigned char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

/// G of Sec. 3.1.
void mix(std::uint64_t& a, std::uint64_t& b, std::uint64_t& c, std::uint64_t& d, std::uint64_t x, std::uint64_t y) {
  a += b + x;
  d = std::rotr(d ^ a, 32);
  c += d;
  b = std::rotr(b ^ c, 24);
  a += b + y;
  d = std::rotr(d ^ a, 16);
  c += d;
  b = std::rotr(b ^ c, 63);
}

}  // namespace

ContentHasher::ContentHasher() : state_(kInitial) {
  // Parameters (Sec. 2.5): no key, one thread, so many bytes of hash.
  state_[0] ^= 0x01010000 ^ kBytes;
}

void ContentHasher::compress(const unsigned char* block, bool last) {
  std::array<std::uint64_t, 16> words{};
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = word_at(block + 8 * k);
  std::array<std::uint64_t, 16> v{};
  std::copy(state_.begin(), state_.end(), v.begin());
  std::copy(kInitial.begin(), kInitial.end(), v.begin() + 8);
  v[12] ^= count_;
  if (last) v[14] = ~v[14];
  for (int round = 0; round < kRounds; ++round) {
    const auto& order = kOrder[round % kOrder.size()];
    mix(v[0], v[4], v[8], v[12], words[order[0]], words[order[1]]);
    mix(v[1], v[5], v[9], v[13], words[order[2]], words[order[3]]);
    mix(v[2], v[6], v[10], v[14], words[order[4]], words[order[5]]);
    mix(v[3], v[7], v[11], v[15], words[order[6]], words[order[7]]);
    mix(v[0], v[5], v[10], v[15], words[order[8]], words[order[9]]);
    mix(v[1], v[6], v[11], v[12], words[order[10]], words[order[11]]);
    mix(v[2], v[7], v[8], v[13], words[order[12]], words[order[13]]);
    mix(v[3], v[4], v[9], v[14], words[order[14]], words[order[15]]);
  }
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] ^= v[k] ^ v[k + 8];
}

ContentHasher& ContentHasher::add(std::string_view bytes) {
  while (!bytes.empty()) {
    // A full block waits until it is known whether it is the last.
    if (filled_ == block_.size()) {
      count_ += filled_;
      compress(block_.data(), false);
      filled_ = 0;
    }
    const std::size_t taken = std::min(bytes.size(), block_.size() - filled_);
    std::memcpy(block_.data() + filled_, bytes.data(), taken);
    filled_ += taken;
    bytes.remove_prefix(taken);
  }
  return *this;
}

ContentHasher& ContentHasher::add_field(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  std::array<char, sizeof size> length{};
  std::memcpy(length.data(), &size, sizeof size);
  return add({length.data(), length.size()}).add(bytes);
}

std::string ContentHasher::finish() {
  count_ += filled_;
  std::fill(block_.begin() + static_cast<std::ptrdiff_t>(filled_), block_.end(), 0);
  compress(block_.data(), true);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hash;
  for (std::size_t k = 0; k < kBytes; ++k) {
    const auto byte = static_cast<unsigned>(state_[k / 8] >> (8 * (k % 8))) & 0xFF;
    hash += kDigits[byte >> 4];
    hash += kDigits[byte & 15];
  }
  return hash;
}

std::string content_hash(std::string_view bytes) { return ContentHasher().add(bytes).finish(); }

std::string content_hash_of_file(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) {
    const ExitCode code = code_of_refusal(errno) == ExitCode::kUsage ? ExitCode::kUnusableInput : ExitCode::kSystem;
    throw Error(code, path.string() + ": can't be read: " + std::strerror(errno));
  }
  ContentHasher hasher;
  std::vector<char> buffer(std::size_t{1} << 18);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    hasher.add({buffer.data(), count});
  }
  if (std::ferror(file.get()) != 0) {
    throw Error(ExitCode::kSystem, path.string() + ": can't be read: " + std::strerror(errno));
  }
  return hasher.finish();
}

}  // namespace lozenge
