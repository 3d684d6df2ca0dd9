#pragma once
// How lanes are put together from numbers that stand elsewhere, and taken apart again: for the transfers, in which lanes are
// now eight particles, now the eight channels of a node.

#include <array>
#include <cstdint>

#include "models/real.hpp"

namespace brisance::simulator {

/// a b + c in lanes, rounded once.
inline Lanes multiply_add(double a, const Lanes& b, const Lanes& c) {
  return multiply_add(Lanes(a), b, c);
}

/// Eight numbers side by side.
inline Lanes pack(double a, double b, double c, double d, double e = 0.0, double f = 0.0, double g = 0.0, double h = 0.0) {
  const double all[8] = {a, b, c, d, e, f, g, h};
  return Lanes::load(all);
}

/// The largest integers that are not above the numbers, for |x| < 2^51.
inline Lanes floor(const Lanes& x) {
  const Lanes nearest = (x + simd::shifter) - simd::shifter;
  return select(nearest > x, nearest - 1.0, nearest);
}

/// A pack in memory. Unlike lanes it is nothing until something is put there, and its elements are cheap to take one by one.
struct alignas(64) StoredPack {
  double element[8];

  StoredPack() = default;
  StoredPack(const Lanes& values) { values.store(element); }
  operator Lanes() const { return Lanes::load(element); }
  double operator[](std::size_t i) const { return element[i]; }
};
/// Eight particles by eight channels, or the other way round.
using Square = std::array<StoredPack, 8>;

/// Where eight numbers stand, counted from some address. Those of neighbours in memory are the end of one pack and the start of
/// the next: two loads take them, of which each leaves out what is not its own.
struct alignas(64) Places {
  std::array<std::int64_t, 8> at{};  // of numbers that are no neighbours
  bool neighbours = false;
  std::uint8_t in_first = 0xff;        // bit i: number i stands in the first pack
  std::int64_t first = 0, second = 0;  // where number 0 stands, and where it would if the second pack reached back to it

  std::int64_t place(std::size_t i) const {
    if (!neighbours) return at[i];
    return static_cast<std::int64_t>(i) + ((in_first >> i) & 1 ? first : second);
  }
};
inline Lanes gather(const double* from, const Places& places) {
#if defined(__AVX512F__)
  Lanes r;
  if (places.neighbours) {
    const auto second = static_cast<std::uint8_t>(~places.in_first);
    r.part[0] = _mm512_maskz_loadu_pd(places.in_first, from + places.first);
    r.part[0] = _mm512_mask_loadu_pd(r.part[0], second, from + places.second);
  } else {
    r.part[0] = _mm512_mask_i64gather_pd(simd::Register{}, 0xff, _mm512_load_si512(places.at.data()), from, 8);
  }
  return r;
#else
  std::array<double, 8> numbers;
  for (std::size_t i = 0; i < 8; ++i) numbers[i] = from[places.place(i)];
  return Lanes::load(numbers.data());
#endif
}
/// Where places coincide, the last of the numbers stays.
inline void scatter(const Lanes& values, double* to, const Places& places) {
#if defined(__AVX512F__)
  if (places.neighbours) {
    _mm512_mask_storeu_pd(to + places.first, places.in_first, values.part[0]);
    _mm512_mask_storeu_pd(to + places.second, static_cast<std::uint8_t>(~places.in_first), values.part[0]);
  } else {
    _mm512_i64scatter_pd(to, _mm512_load_si512(places.at.data()), values.part[0], 8);
  }
#else
  for (std::size_t i = 0; i < 8; ++i) to[places.place(i)] = values[static_cast<int>(i)];
#endif
}

// Lanes in two halves of four.

/// The first four of a pack in memory, twice.
inline Lanes first_half_twice(const Lanes& pack) {
  Lanes r;
#if defined(__AVX512F__)
  r.part[0] = _mm512_maskz_broadcast_f64x4(0xff, _mm256_load_pd(reinterpret_cast<const double*>(&pack)));
#else
  constexpr int parts = Lanes::parts / 2;
  for (int i = 0; i < parts; ++i) r.part[i] = r.part[parts + i] = pack.part[i];
#endif
  return r;
}
/// The first half of one and the second half of another.
inline Lanes halves(const Lanes& first, const Lanes& second) {
  Lanes r = second;
#if defined(__AVX512F__)
  r.part[0] = _mm512_mask_blend_pd(0xf0, first.part[0], second.part[0]);
#else
  for (int i = 0; i < Lanes::parts / 2; ++i) r.part[i] = first.part[i];
#endif
  return r;
}

/// Element j of row i becomes element i of row j.
[[gnu::always_inline]] inline Square transposed(const Square& rows) {
  Square result;
#if defined(__AVX512F__)
  std::array<simd::Register, 8> row, two, four;  // columns of two rows, of four
  for (std::size_t i = 0; i < 8; ++i) row[i] = Lanes(rows[i]).part[0];
  for (std::size_t i = 0; i < 8; i += 2) {
    two[i] = __builtin_shufflevector(row[i], row[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    two[i + 1] = __builtin_shufflevector(row[i], row[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (const std::size_t i : {0, 1, 4, 5}) {
    four[i] = __builtin_shufflevector(two[i], two[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    four[i + 2] = __builtin_shufflevector(two[i], two[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  Lanes column;
  for (std::size_t i = 0; i < 4; ++i) {
    column.part[0] = __builtin_shufflevector(four[i], four[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    result[i] = column;
    column.part[0] = __builtin_shufflevector(four[i], four[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    result[i + 4] = column;
  }
#else
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 8; ++j) result[i].element[j] = rows[j][i];
#endif
  return result;
}

}  // namespace brisance::simulator
