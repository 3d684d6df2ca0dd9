#pragma once
// Eight particles side by side, taken in the order of a bin, so that what is done to them does not depend on where they stand
// in memory.

#include <algorithm>

#include "models/requests.hpp"
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

/// Requests for columns of the particle at a place of the bins' order. As a rule it is the last of eight neighbours in memory,
/// of which the others are in the same pack or in the one before, which the eight before have asked for.
inline Requests requests_for(const Bins& bins, std::size_t place, std::initializer_list<Wanted> wanted) {
  Requests requests;
  if (place < bins.order.size())
    for (const Wanted& w : wanted)
      requests.add(w.set.particle(static_cast<int>(bins.order[place])) + w.first * chunk_size, w.count);
  return requests;
}

/// Calls f(eight) for the particles of a bin.
template <class F>
void for_each_eight(const Bins& bins, const Bin& bin, F&& f) {
  for (std::uint32_t first = bin.begin; first < bin.end; first += 8) f(Eight(bins, first, bin.end));
}
/// Calls f(eight, requests), which sends the requests: for what is wanted of the particles `distance` places further on.
template <class F>
void for_each_eight(const Bins& bins, const Bin& bin, std::uint32_t distance, std::initializer_list<Wanted> wanted, F&& f) {
  for (std::uint32_t first = bin.begin; first < bin.end; first += 8) {
    Requests requests = requests_for(bins, first + distance + 7, wanted);
    f(Eight(bins, first, bin.end), requests);
  }
}
inline constexpr std::uint32_t after_the_next_eight = 16;

/// D columns from the first on.
template <std::size_t D>
std::array<Lanes, D> read_vector(const Columns& columns, int first) {
  std::array<Lanes, D> v;
  for (std::size_t a = 0; a < D; ++a) v[a] = columns[first + static_cast<int>(a)];
  return v;
}

}  // namespace brisance::simulator
