#include "simulator/gas/range_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <span>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/domain/message.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double least_part = 1e-3;  // of a cell's volume, to be looked at

equation_of_state::DensityRange range_of(const Fluid& fluid) {
  return std::visit([](const auto& law) { return law.range(); }, fluid.equation_of_state);
}

/// Keeps the worst of two; of equals the first in time, then `a`.
void add(OutsideRange& a, const OutsideRange& b) {
  const std::int64_t cell_steps = a.cell_steps + b.cell_steps;
  if (a.cell_steps == 0 || b.excess > a.excess || (b.excess == a.excess && b.time < a.time)) a = b;
  a.cell_steps = cell_steps;
}

OutsideRange look(const Gas& gas, std::size_t block, std::size_t fluid, const equation_of_state::DensityRange& range) {
  OutsideRange found;
  const auto of_fluid = [&](int quantity) { return Content::of(gas.dimensions(), fluid, quantity); };
  const int volume_at = gas.fluids.size() == 1 ? Content::cell_volume : of_fluid(Content::volume);
  const Lanes* const masses = gas.content.at(block, of_fluid(Content::mass));
  const Lanes* const volumes = gas.content.at(block, volume_at);
  const Lanes* const cell_volumes = gas.content.at(block, Content::cell_volume);
  for (int k = 0; k < gas.cells.packs(); ++k) {
    const Lanes mass = masses[k], volume = volumes[k];
    LanesMask outside = (mass > range.highest * volume) | (mass < range.lowest * volume);
    if (none(outside)) continue;
    outside &= (volume > least_part * cell_volumes[k]) & lanes_of(cells_inside(gas.cells, block, k));
    const Lanes density = mass / volume, excess = max(density * (1.0 / range.highest), range.lowest / density);
    for (int l = 0; l < 8; ++l) {
      const int cell = 8 * k + l;
      if (!outside[l] || !(open_part(gas, block, cell) > 0.0)) continue;
      add(found, {1, excess[l], density[l], gas.time, gas.cells.centre(block, cell)});
    }
  }
  return found;
}

}  // namespace

void watch_ranges(Gas& gas) {
  gas.outside.resize(gas.fluids.size());
  std::vector<OutsideRange> of_block(gas.cells.mine.size());
  for (std::size_t r = 0; r < gas.fluids.size(); ++r) {
    const equation_of_state::DensityRange range = range_of(gas.fluids[r]);
    if (range.lowest <= 0.0 && std::isinf(range.highest)) continue;
    parallel_for_blocks(of_block.size(),
                        [&](std::size_t i) { of_block[i] = look(gas, static_cast<std::size_t>(gas.cells.mine[i]), r, range); });
    for (const OutsideRange& found : of_block)
      if (found.cell_steps > 0) add(gas.outside[r], found);
  }
}

std::vector<RangeReport> range_reports(const Gas& gas, Domain& domain) {
  std::vector<OutsideRange> all(gas.fluids.size());
  Message mine;
  append(mine, gas.outside);
  for (const Message& message : all_gather(domain, mine)) {
    const auto of_rank = MessageReader(message).read_list<OutsideRange>();
    for (std::size_t r = 0; r < of_rank.size(); ++r)
      if (of_rank[r].cell_steps > 0) add(all[r], of_rank[r]);
  }
  std::vector<RangeReport> reports;
  for (std::size_t r = 0; r < all.size(); ++r)
    if (all[r].cell_steps > 0) reports.push_back({gas.fluids[r].name, range_of(gas.fluids[r]), all[r]});
  return reports;
}

std::string in_words(const RangeReport& report, int dimensions) {
  const OutsideRange& o = report.outside;
  const bool above = o.density > report.range.highest;
  return fmt::format(
      "{} was outside of the densities that its equation of state declares, {} times (cells times steps); farthest: {:.6g} "
      "kg/m^3, {} {:.6g}, at ({:.6g}) m and {:.6g} s. There its pressure is extrapolated: if that place and time matter to "
      "you, take a law that holds there",
      report.fluid, o.cell_steps, o.density, above ? "above" : "below", above ? report.range.highest : report.range.lowest,
      fmt::join(std::span(o.place).first(static_cast<std::size_t>(dimensions)), ", "), o.time);
}

}  // namespace brisance::simulator::gas
