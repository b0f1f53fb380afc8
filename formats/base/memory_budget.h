// Memory that reading a file may take, asked for before it is taken.
#pragma once

#include <cstdint>
#include <string>

namespace lozenge {

/// "3.2 GB", "15 MB": decimal units, as tools and disks count.
std::string readable_bytes(std::uint64_t bytes);

/// \throws Error(kLimit) where `bytes` are more than `limit` (0: no limit), saying what was asked for, the limit, and
///         what to do. \param what  takes the memory: "statue.glb: reading it"
void require_memory(std::uint64_t bytes, std::uint64_t limit, const std::string& what);

/// Adds up what is taken, piece by piece, and stops at the first that is too much.
class MemoryBudget {
 public:
  /// \param limit  in bytes; 0: none
  explicit MemoryBudget(std::uint64_t limit = 0) : limit_(limit) {}

  /// To be called before `bytes` are allocated. \throws Error(kLimit) where all that was taken exceeds the limit
  void take(std::uint64_t bytes, const std::string& what);
  std::uint64_t taken() const { return taken_; }
  std::uint64_t limit() const { return limit_; }

 private:
  std::uint64_t limit_;
  std::uint64_t taken_ = 0;
};

}  // namespace lozenge
