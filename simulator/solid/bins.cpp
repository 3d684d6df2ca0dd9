#include "simulator/solid/bins.hpp"

#include <algorithm>
#include <numeric>

namespace brisance::simulator {
namespace {

struct Earlier {
  const Particles& p;
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    return p.block[a] != p.block[b] ? p.block[a] < p.block[b] : p.id[a] < p.id[b];
  }
};

void find_bins(const Particles& p, Bins& bins) {
  bins.bins.clear();
  const auto count = static_cast<std::uint32_t>(bins.order.size());
  for (std::uint32_t i = 0; i < count;) {
    const BlockKey block = p.block[bins.order[i]];
    std::uint32_t end = i + 1;
    while (end < count && p.block[bins.order[end]] == block) ++end;
    bins.bins.push_back({block, i, end});
    i = end;
  }
}

}  // namespace

void Bins::sort(const Particles& particles) {
  order.resize(static_cast<std::size_t>(particles.size));
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), Earlier{particles});
  find_bins(particles, *this);
}

void Bins::move(const Particles& particles, std::span<const std::uint32_t> movers) {
  if (movers.empty()) return;
  std::vector<std::uint32_t> moved(movers.begin(), movers.end()), sorted_numbers = moved;
  std::sort(moved.begin(), moved.end(), Earlier{particles});
  std::sort(sorted_numbers.begin(), sorted_numbers.end());
  // Whoever stays is in order already.
  std::vector<std::uint32_t> stay;
  stay.reserve(order.size());
  const std::vector<bool> moves = [&] {
    std::vector<bool> m(order.size(), false);
    for (const std::uint32_t i : sorted_numbers) m[i] = true;
    return m;
  }();
  for (const std::uint32_t i : order)
    if (!moves[i]) stay.push_back(i);
  std::merge(stay.begin(), stay.end(), moved.begin(), moved.end(), order.begin(), Earlier{particles});
  find_bins(particles, *this);
  strayed += moved.size();
}

void tidy(Particles& particles, Bins& bins) {
  // One in so many: to put them in order costs about a step, and those that are not slow down their neighbours.
  constexpr std::size_t most = 8;
  if (most * bins.strayed < static_cast<std::size_t>(particles.size)) return;
  particles.reorder(bins.order);
  std::iota(bins.order.begin(), bins.order.end(), 0u);
  bins.strayed = 0;
}

}  // namespace brisance::simulator
