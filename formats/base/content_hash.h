// Names for contents: equal bytes have the same one, and nobody finds other bytes that have it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lozenge {

/// BLAKE2b of 256 bits (RFC 7693), fed piece by piece.
class ContentHasher {
 public:
  ContentHasher();

  ContentHasher& add(std::string_view bytes);
  /// The same with its length before it, so that fields can't run into each other: "ab", "c" is another than "a", "bc".
  ContentHasher& add_field(std::string_view bytes);

  /// Of all that was added, as 64 hexadecimal digits. \pre called once, last
  std::string finish();

 private:
  void compress(const unsigned char* block, bool last);

  std::array<std::uint64_t, 8> state_{};
  std::uint64_t count_ = 0;  ///< bytes that are in the state
  std::array<unsigned char, 128> block_{};
  std::size_t filled_ = 0;  ///< of block_
};

std::string content_hash(std::string_view bytes);

/// \throws Error(kUnusableInput) where there is no such file, Error(kSystem) where it can't be read
std::string content_hash_of_file(const std::filesystem::path& path);

}  // namespace lozenge
