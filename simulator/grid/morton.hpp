#pragma once
// Blocks of the grid are known by their Morton index: 21 bits of each block coordinate, interleaved. Its order keeps
// neighbours close and does not depend on who holds which block.

#include <array>
#include <cstdint>

namespace brisance::simulator {

using BlockKey = std::uint64_t;
using BlockPosition = std::array<int, 3>;  // may be negative; |component| < 2^20

namespace detail {

constexpr std::uint64_t spread(std::uint64_t x) {  // every third bit
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}
constexpr std::uint64_t gather(std::uint64_t x) {
  x &= 0x1249249249249249;
  x = (x ^ x >> 2) & 0x10c30c30c30c30c3;
  x = (x ^ x >> 4) & 0x100f00f00f00f00f;
  x = (x ^ x >> 8) & 0x1f0000ff0000ff;
  x = (x ^ x >> 16) & 0x1f00000000ffff;
  x = (x ^ x >> 32) & 0x1fffff;
  return x;
}

}  // namespace detail

inline constexpr int farthest_block = 1 << 20;

constexpr BlockKey block_key(const BlockPosition& b) {
  const auto shifted = [](int i) { return static_cast<std::uint64_t>(i + farthest_block); };
  return detail::spread(shifted(b[0])) | detail::spread(shifted(b[1])) << 1 | detail::spread(shifted(b[2])) << 2;
}
constexpr BlockPosition block_position(BlockKey key) {
  const auto back = [](std::uint64_t x) { return static_cast<int>(detail::gather(x)) - farthest_block; };
  return {back(key), back(key >> 1), back(key >> 2)};
}

}  // namespace brisance::simulator
