#include "simulator/gas/redistribution.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::simulator::gas {
namespace {

/// Looks for the other members of a small cell's neighbourhood.
struct Search {
  const Window& w;
  const OpenSpace& after;
  const CutCells& step;
  Neighbourhood found;
  double volume = 0.0;

  std::size_t stride(int axis) const { return static_cast<std::size_t>(w.stride[static_cast<std::size_t>(axis)]); }
  std::size_t next(std::size_t n, int axis, int way) const { return way > 0 ? n + stride(axis) : n - stride(axis); }
  double opening(std::size_t n, int axis, int way) const {
    return step.area[static_cast<std::size_t>(axis)][way > 0 ? n + stride(axis) : n];
  }
  bool open(std::size_t n, int axis, int way) const {
    return opening(n, axis, way) > 0.0 && after.volume[next(n, axis, way)] > 0.0;
  }
  void add(std::size_t n) {
    found.members[static_cast<std::size_t>(found.count++)] = n;
    volume += after.volume[n];
  }
  /// The open neighbour with the widest opening and most gas.
  void add_widest(int& axis, int& way) {
    double widest = 0.0;
    for (int a = 0; a < w.dimensions; ++a)
      for (const int s : {-1, 1}) {
        if (!open(found.cell, a, s)) continue;
        const double width = opening(found.cell, a, s) * after.volume[next(found.cell, a, s)];
        if (width > widest) widest = width, axis = a, way = s;
      }
    if (widest > 0.0) add(next(found.cell, axis, way));
  }
  /// Takes in the members' neighbours on one side as far as they can be reached.
  void widen(int axis, int way) {
    const int before = found.count;
    for (int m = 0; m < before; ++m) {
      const std::size_t from = found.members[static_cast<std::size_t>(m)], to = next(from, axis, way);
      if (open(from, axis, way)) {
        add(to);
        continue;
      }
      // Round the corner: from a neighbour of this member that is already in.
      for (int k = before; k < found.count; ++k) {
        const std::size_t other = found.members[static_cast<std::size_t>(k)];
        bool reached = false;
        for (int a = 0; a < w.dimensions && !reached; ++a)
          for (const int s : {-1, 1}) reached = reached || (a != axis && next(other, a, s) == to && open(other, a, s));
        if (reached) {
          add(to);
          break;
        }
      }
    }
  }
};

Neighbourhood neighbourhood_of(const Window& w, const OpenSpace& after, const CutCells& step, const CutCell& cut,
                               double enough) {
  Search search{w, after, step, {}, 0.0};
  search.found.cell = cut.cell;
  search.add(cut.cell);
  // Away from the wall, along the axes by how much the wall faces them.
  std::array<int, 3> order{0, 1, 2};
  const auto towards = [&](int a) { return std::abs(cut.wall[static_cast<std::size_t>(a)]); };
  std::stable_sort(order.begin(), order.begin() + w.dimensions, [&](int a, int b) { return towards(a) > towards(b); });
  const auto away = [&](int a) { return cut.wall[static_cast<std::size_t>(a)] > 0.0 ? -1 : 1; };
  int first = order[0], way = away(first);
  if (search.open(cut.cell, first, way))
    search.add(search.next(cut.cell, first, way));
  else
    search.add_widest(first, way);
  for (int k = 0; k < w.dimensions && search.volume < enough; ++k) {
    const int axis = order[static_cast<std::size_t>(k)];
    if (axis != first) search.widen(axis, away(axis));
  }
  Neighbourhood& found = search.found;
  for (std::size_t m = 1; m < static_cast<std::size_t>(found.count) && m < found.members.size(); ++m)
    for (std::size_t k = m; k > 0 && found.members[k] < found.members[k - 1]; --k)
      std::swap(found.members[k], found.members[k - 1]);
  return found;
}

}  // namespace

void find_neighbourhoods(const Window& w, const Cells& cells, const OpenSpace& before, const OpenSpace& after,
                         const CutCells& step, Neighbourhoods& all) {
  if (all.number.size() != w.length) all.number.assign(w.length, -1), all.overlaps.assign(w.length, 1);
  for (const Neighbourhood& old : all.small) all.number[old.cell] = -1;
  for (const std::size_t n : all.shared) all.overlaps[n] = 1;
  all.small.clear(), all.shared.clear();
  for (const CutCell& cut : step.cut) {
    const std::array<int, 3> index = w.index(cut.cell);
    if (!w.holds(index, 2)) continue;
    const double enough = 0.5 * whole_cell(cells, index[0]).volume;
    // A cell that has just been opened holds nothing yet, whatever its size.
    if (after.volume[cut.cell] >= enough && before.volume[cut.cell] > 0.0) continue;
    all.number[cut.cell] = static_cast<std::int32_t>(all.small.size());
    all.small.push_back(neighbourhood_of(w, after, step, cut, enough));
  }
  for (const Neighbourhood& n : all.small) {
    for (int m = 0; m < n.count; ++m) {
      const std::size_t member = n.members[static_cast<std::size_t>(m)];
      all.shared.push_back(member);
      if (member != n.cell) ++all.overlaps[member];
    }
  }
  std::sort(all.shared.begin(), all.shared.end());
  all.shared.erase(std::unique(all.shared.begin(), all.shared.end()), all.shared.end());
}

std::vector<NeighbourhoodMean> redistribute(const Window& w, const Neighbourhoods& all, const std::vector<double>& volume,
                                            std::vector<double>& density, const std::vector<double>& covered,
                                            const SlopeAt& slope) {
  // Means are taken of differences to one of the members: what is the same in all of them stays so to the last bit.
  std::vector<NeighbourhoodMean> mean(all.small.size());
  for (std::size_t i = 0; i < all.small.size(); ++i) {
    const Neighbourhood& n = all.small[i];
    const std::array<std::size_t, 8>& member = n.members;
    double base = 0.0, sum = 0.0, volume_sum = 0.0;
    for (int m = n.count; m-- > 0;)
      if (volume[member[static_cast<std::size_t>(m)]] > 0.0) base = density[member[static_cast<std::size_t>(m)]];
    for (int m = 0; m < n.count; ++m) {
      const std::size_t cell = member[static_cast<std::size_t>(m)];
      const double part = 1.0 / all.overlaps[cell];
      if (volume[cell] > 0.0)
        sum += part * volume[cell] * (density[cell] - base), volume_sum += part * volume[cell];
      else
        sum += part * covered[cell];
    }
    mean[i].value = volume_sum > 0.0 ? base + sum / volume_sum : base;
    if (!slope || !(volume_sum > 0.0)) continue;
    for (int m = n.count; m-- > 0;) {
      const std::size_t cell = member[static_cast<std::size_t>(m)];
      if (!(volume[cell] > 0.0)) continue;
      mean[i].slope = slope(cell);
      const std::array<int, 3> index = w.index(cell);
      for (std::size_t a = 0; a < 3; ++a) mean[i].middle[a] += volume[cell] / all.overlaps[cell] / volume_sum * index[a];
    }
  }
  // A cell takes the mean of the neighbourhoods that it is in, those of the cells around it in order.
  std::vector<double> now(all.shared.size());
  for (std::size_t k = 0; k < all.shared.size(); ++k) {
    const std::size_t cell = all.shared[k];
    double change = 0.0;
    const std::array<int, 3> index = w.index(cell);
    Part around;
    for (std::size_t a = 0; a < 3; ++a) {
      const int reach_of = static_cast<int>(a) < w.dimensions ? 1 : 0;
      around.lower[a] = index[a] - reach_of, around.upper[a] = index[a] + reach_of + 1;
    }
    for_each_cell_of(around, [&](const std::array<int, 3>& other) {
      if (!w.holds(other)) return;
      const std::int32_t number = all.number[w.at(other)];
      if (number < 0) return;  // alone: its mean is itself
      const Neighbourhood& n = all.small[static_cast<std::size_t>(number)];
      bool in = false;
      for (int m = 0; m < n.count; ++m) in = in || n.members[static_cast<std::size_t>(m)] == cell;
      if (in) change += mean[static_cast<std::size_t>(number)].at(index) - density[cell];
    });
    now[k] = density[cell] + change / all.overlaps[cell];
  }
  for (std::size_t k = 0; k < all.shared.size(); ++k)
    if (volume[all.shared[k]] > 0.0) density[all.shared[k]] = now[k];
  return mean;
}

}  // namespace brisance::simulator::gas
