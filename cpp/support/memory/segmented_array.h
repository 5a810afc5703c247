// SPDX-License-Identifier: BSD-3-Clause
// An array that grows in place.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace carreau {

/// Like std::vector, in segments of a fixed length: its elements never move. A large vector that doubles touches three
/// times its final memory, and memory that is touched for the first time is slow. Segments are filled as they are
/// needed.
template <typename T, std::size_t segment = 512>
class SegmentedArray {
  static_assert((segment & (segment - 1)) == 0, "indices are taken apart by bits");

 public:
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  T& operator[](std::size_t i) noexcept { return begins_[i / segment][i % segment]; }
  const T& operator[](std::size_t i) const noexcept { return begins_[i / segment][i % segment]; }
  void push_back(const T& value) {
    if (size_ % segment == 0) open_segment();
    segments_.back().push_back(value);
    ++size_;
  }
  /// Appends `count` values; `count` divides the length of a segment, and so do all counts.
  void append(std::size_t count) {
    if (size_ % segment == 0) open_segment();
    segments_.back().resize(segments_.back().size() + count);
    size_ += count;
  }

 private:
  void open_segment() {
    std::vector<T> fresh;
    fresh.reserve(segment);
    begins_.push_back(fresh.data());
    segments_.push_back(std::move(fresh));
  }

  std::vector<std::vector<T>> segments_;
  std::vector<T*> begins_;
  std::size_t size_ = 0;
};

}  // namespace carreau
