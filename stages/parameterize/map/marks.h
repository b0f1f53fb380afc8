// Sets of small numbers, and numbers given to some of many, that are emptied in no time: what an operation needs to
// know whom it has met, again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lozenge {

/// A set of small numbers that is emptied in no time.
class Marks {
 public:
  void clear(std::size_t size) {
    if (marked_.size() < size) marked_.resize(size, 0);
    ++now_;
  }
  bool has(std::int32_t i) const { return marked_[i] == now_; }
  /// \return whether it was not there before
  bool add(std::int32_t i) {
    if (marked_[i] == now_) return false;
    marked_[i] = now_;
    return true;
  }

 private:
  std::vector<std::int32_t> marked_;
  std::int32_t now_ = 0;
};

/// Numbers given to some of many, all forgotten in no time.
class Numbering {
 public:
  void clear(std::size_t size) {
    marks_.clear(size);
    if (numbers_.size() < size) numbers_.resize(size);
  }
  void set(std::int32_t i, std::int32_t number) {
    marks_.add(i);
    numbers_[i] = number;
  }
  /// -1 where it has none
  std::int32_t find(std::int32_t i) const { return marks_.has(i) ? numbers_[i] : -1; }

 private:
  Marks marks_;
  std::vector<std::int32_t> numbers_;
};

}  // namespace lozenge
