#pragma once
// Eight particles side by side, taken in the order of a bin, so that what is done to them does not depend on where they stand
// in memory.

#include <algorithm>

#include "simulator/solid/bins.hpp"
#include "simulator/solid/packs.hpp"

namespace brisance::simulator {

/// Neighbours in the order of a bin. Lanes beyond the last particle repeat it.
struct Eight {
  std::array<std::uint32_t, 8> particle;
  int used;
  bool neighbours = false;  // their numbers follow each other

  explicit Eight(std::uint32_t one) : used(1) { particle.fill(one); }
  Eight(const Bins& bins, std::uint32_t first, std::uint32_t end) : used(static_cast<int>(std::min(end - first, 8u))) {
    const std::uint32_t* in_order = bins.order.data() + first;
    if (used == 8)
      std::copy_n(in_order, 8, particle.begin());
    else
      for (std::uint32_t i = 0; i < 8; ++i) particle[i] = in_order[std::min(i, end - 1 - first)];
    std::uint32_t differences = 0;
    for (std::uint32_t i = 0; i < 8; ++i) differences |= particle[i] ^ (particle[0] + i);
    neighbours = differences == 0;
  }
  /// The value in the lanes in use, zero beyond.
  Lanes only_used(const Lanes& value) const {
    return select(pack(0, 1, 2, 3, 4, 5, 6, 7) < static_cast<double>(used), value, Lanes(0.0));
  }
};

/// Columns of eight particles.
class Columns {
 public:
  Columns(const ColumnSet& set, const Eight& eight) : Columns(const_cast<ColumnSet&>(set), eight) {}
  Columns(ColumnSet& set, const Eight& eight) : data_(set.chunk(0)) {
    if (!eight.neighbours) {
      for (std::size_t i = 0; i < 8; ++i) places_.at[i] = set.offset(eight.particle[i]);
      return;
    }
    const auto beyond = eight.particle[0] % chunk_size;
    places_.neighbours = true;
    places_.in_first = static_cast<std::uint8_t>(0xff >> beyond);
    places_.first = set.offset(eight.particle[0]);
    places_.second = beyond == 0 ? places_.first : set.offset(eight.particle[7]) - 7;
  }
  Lanes operator[](int column) const { return gather(data_ + column * chunk_size, places_); }
  void write(int column, const Lanes& values) { scatter(values, data_ + column * chunk_size, places_); }

 private:
  double* data_;
  Places places_;
};

/// Columns that a loop over particles is going to read or write.
struct Wanted {
  const ColumnSet& set;
  int first, count;
};

/// Asks the memory for columns of the particle at a place of the bins' order. As a rule it is the last of eight neighbours in
/// memory, of which the others are in the same pack or in the one before, which the eight before have asked for. Inlined, or
/// GCC takes what does nothing else for a function without effect, and leaves it out.
[[gnu::always_inline]] inline void fetch(const Bins& bins, std::size_t place, std::initializer_list<Wanted> wanted) {
  if (place >= bins.order.size()) return;
  for (const Wanted& w : wanted) {
    const double* from = w.set.particle(static_cast<int>(bins.order[place])) + w.first * chunk_size;
    for (int k = 0; k < w.count; ++k) __builtin_prefetch(from + k * chunk_size);
  }
}

/// Calls f(eight) for the particles of a bin. What is wanted of those after the next eight is on its way from memory meanwhile.
template <class F>
void for_each_eight(const Bins& bins, const Bin& bin, std::initializer_list<Wanted> wanted, F&& f) {
  for (std::uint32_t first = bin.begin; first < bin.end; first += 8) {
    fetch(bins, first + 16 + 7, wanted);
    f(Eight(bins, first, bin.end));
  }
}

/// D columns from the first on.
template <std::size_t D>
std::array<Lanes, D> read_vector(const Columns& columns, int first) {
  std::array<Lanes, D> v;
  for (std::size_t a = 0; a < D; ++a) v[a] = columns[first + static_cast<int>(a)];
  return v;
}

}  // namespace brisance::simulator
