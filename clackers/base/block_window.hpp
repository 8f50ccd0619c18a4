#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace clackers {

/// A long table whose rows are made in blocks whenever they are asked for, mostly one after another, so
/// that it takes no memory. A row is `width` elements.
template <class Element>
class BlockWindow {
 public:
  /// Writes `count` rows from number `first` on.
  using Make = std::function<void(std::size_t first, std::size_t count, Element* to)>;
  static constexpr std::size_t block_size = 512;  ///< rows

  BlockWindow(std::size_t size, std::size_t width, Make make)
      : size_(size), width_(width), make_(std::move(make)) {}

  std::size_t size() const { return size_; }
  /// Row `i`, which stays where it is until rows of two other blocks are asked for.
  const Element* operator[](std::size_t i) {
    if (i - first_ >= block_size) find(i / block_size);
    return rows_ + (i - first_) * width_;
  }
  /// Makes only row `i`.
  void copy(std::size_t i, Element* to) const { make_(i, 1, to); }

 private:
  struct Block {
    std::size_t number = std::numeric_limits<std::size_t>::max() / 2;  ///< of none
    std::vector<Element> rows{};
  };

  [[gnu::noinline]] void find(std::size_t number) {
    auto block = std::ranges::find(blocks_, number, &Block::number);
    if (block == blocks_.end()) {
      if (blocks_[oldest_].number * block_size == first_) oldest_ = (oldest_ + 1) % blocks_.size();
      block = blocks_.begin() + std::ptrdiff_t(oldest_);
      oldest_ = (oldest_ + 1) % blocks_.size();
      block->number = number;
      block->rows.resize(block_size * width_);
      const auto first = number * block_size;
      make_(first, std::min(block_size, size_ - first), block->rows.data());
    }
    first_ = number * block_size;
    rows_ = block->rows.data();
  }

  std::size_t size_, width_;
  Make make_;
  std::array<Block, 8> blocks_{};
  std::size_t oldest_ = 0;
  std::size_t first_ = std::numeric_limits<std::size_t>::max() / 2;  ///< of the block used last
  const Element* rows_ = nullptr;
};

}  // namespace clackers
