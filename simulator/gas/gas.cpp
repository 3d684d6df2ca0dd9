#include "simulator/gas/gas.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "simulator/gas/classic.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/fluid_state.hpp"
#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/implicit.hpp"
#include "simulator/gas/lagrangian.hpp"
#include "simulator/gas/passages.hpp"
#include "simulator/gas/range_watch.hpp"
#include "simulator/gas/reaction.hpp"
#include "simulator/gas/remap.hpp"
#include "simulator/gas/sums.hpp"
#include "simulator/gas/timed.hpp"
#include "simulator/gas/transport.hpp"
#include "simulator/parallel.hpp"

namespace brisance::simulator::gas {
namespace {

/// The volume of a cell is what it was before the step, to the last bit.
void settle(Gas& gas) {
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    std::copy_n(gas.content.at(block, Content::cell_volume), gas.cells.packs(), gas.moved.at(block, Content::cell_volume));
  });
  std::swap(gas.content, gas.moved);
}

/// Marked cells do without slopes in the next attempt. Neighbours read who does while cells are being marked, so the marks
/// stand apart until the attempt is over.
void make_marked_cells_first_order(Gas& gas) {
  for (const std::int32_t b : gas.cells.mine)
    for (int k = 0; k < gas.cells.packs(); ++k) {
      Lanes& mark = gas.marks.at(static_cast<std::size_t>(b), 0)[k];
      Lanes& first_order = gas.half_step.at(static_cast<std::size_t>(b), HalfStep::first_order(gas.dimensions()))[k];
      first_order = max(first_order, mark), mark = Lanes(0.0);
    }
}
void forget_marks(Gas& gas) {
  for (const std::int32_t b : gas.cells.mine)
    std::fill_n(gas.marks.at(static_cast<std::size_t>(b), 0), gas.cells.packs(), Lanes(0.0));
}
/// No cell is of first order any more; counts those of this process that were.
std::int64_t forget_first_order_cells(Gas& gas) {
  std::int64_t count = 0;
  for (const std::int32_t b : gas.cells.mine)
    for (int k = 0; k < gas.cells.packs(); ++k) {
      Lanes& first_order = gas.half_step.at(static_cast<std::size_t>(b), HalfStep::first_order(gas.dimensions()))[k];
      for (int l = 0; l < 8; ++l) count += first_order[l] > 0.0 ? 1 : 0;
      first_order = Lanes(0.0);
    }
  return count;
}

/// The step as it is in `moved`, from what is in `content`; false if a cell does not bear it. Such cells are marked then.
bool try_step(Gas& gas, double dt, Domain& domain) {
  if (gas.implicit) {
    if (!timed(gas, Phase::pressure_solve, [&] { return solve_pressure(gas, dt, domain); })) return false;
  } else {
    timed(gas, Phase::half_step, [&] { advance_half_step(gas, dt); });
  }
  timed(gas, Phase::ghosts, [&] { share_half_step(gas, dt, domain); });
  const auto all_bear = [&](bool borne) { return domain.maximum(borne ? 0.0 : 1.0) == 0.0; };
  if (!all_bear(timed(gas, Phase::lagrangian, [&] { return lagrangian_phase(gas, dt); }))) return false;
  timed(gas, Phase::transport, [&] { apply_transport(gas, dt); });
  timed(gas, Phase::reaction, [&] { react(gas, dt, domain); });
  // The order of the axes turns around with every step, so that none is always first.
  const int D = gas.dimensions();
  Vector moved{dt, dt, dt};
  for (int n = 0; n < D; ++n) {
    const int axis = gas.step % 2 == 0 ? n : D - 1 - n;
    timed(gas, Phase::ghosts, [&] { share_moved(gas, axis, gas.time + dt, moved, domain); });
    if (!all_bear(timed(gas, Phase::remap, [&] { return sweep(gas, axis); }))) return false;
    std::swap(gas.moved, gas.next);
    moved[static_cast<std::size_t>(axis)] = 0.0;
  }
  return all_bear(timed(gas, Phase::equilibrium, [&] { return all_cells_hold_heat(gas, gas.moved); }));
}

}  // namespace

void fill(Gas& gas, const FillingFunction& filling, Domain& domain) {
  fill_in_portions(
      gas,
      [&](const Vector& middle) {
        return std::vector<Portion>{{1.0, filling(middle, gas.time)}};
      },
      domain);
}

void fill_in_portions(Gas& gas, const PortionsFunction& portions, Domain& domain) {
  const int packs = gas.cells.packs(), D = gas.dimensions();
  const std::size_t blocks = gas.cells.blocks.size();
  for (CellSet* set : {&gas.content, &gas.moved, &gas.next}) {
    *set = CellSet(gas.contents(), packs);
    set->resize(blocks);
  }
  gas.primitive = CellSet(Primitive::all(D, static_cast<int>(gas.fluids.size())), packs);
  gas.half_step = CellSet(HalfStep::count(D), packs);
  gas.marks = CellSet(1, packs);
  gas.primitive.resize(blocks), gas.half_step.resize(blocks), gas.marks.resize(blocks);
  gas.swept.assign(blocks * static_cast<std::size_t>(D * (D == 3 ? 8 : 1) * line_faces), Lanes(0.0));
  gas.fans.resize(blocks);
  open_passages(gas);
  prepare_burns(gas);
  for (Fluid& fluid : gas.fluids) give_usual_state(fluid);
  // Cells that are not of the box hold something all the same: they are computed with, to no effect.
  Vector corner{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(D); ++a) corner[a] = (gas.cells.lower[a] + 0.5) * gas.cells.cell_size;
  const std::vector<Portion> beyond = {{1.0, portions(corner).front().filling}};
  parallel_for_blocks(blocks, [&](std::size_t block) {
    for (int c = 0; c < 8 * packs; ++c) {
      const bool inside = gas.cells.contains(gas.cells.index(block, c));
      const std::vector<Portion> held = inside ? portions(gas.cells.centre(block, c)) : beyond;
      write_content(gas, gas.content, block, c, held);
      for (CellSet* set : {&gas.moved, &gas.next})
        for (int q = 0; q < set->quantities(); ++q) set->cell(block, q, c) = gas.content.cell(block, q, c);
      write_primitive(gas, block, c, held.front().filling);
    }
  });
  if (gas.implicit) open_implicit(gas, domain);
  place_bodies(gas, domain);
  if (gas.classic) open_classic(gas);
  begin(gas, domain);
  gas.initial = totals(gas, domain);
  watch_ranges(gas);
}

void begin(Gas& gas, Domain& domain) {
  if (gas.classic) return timed(gas, Phase::classic, [&] { show_classic(gas, domain); });
  timed(gas, Phase::equilibrium, [&] { find_equilibrium(gas, domain); });
  timed(gas, Phase::ghosts, [&] { share_primitives(gas, gas.time, domain); });
  timed(gas, Phase::transport, [&] { prepare_transport(gas, domain); });
}

double largest_step(const Gas& gas, double courant) {
  constexpr double most_swept = 0.5;     // of a cell, through one face
  constexpr double most_diffused = 0.8;  // of what makes neighbours alike at once
  constexpr double farthest = 0.25;      // cells that a wall may move
  constexpr double least = 1e-300;
  const double wall = gas.bodies.empty() ? 0.0 : fastest(gas) / gas.cells.cell_size;
  return std::min({(gas.implicit ? gas.acoustic_courant : courant) / gas.wave_rate,
                   most_swept / std::max(gas.motion_rate, least), most_diffused / std::max(gas.diffusion_rate, least),
                   farthest / std::max(wall, least)});
}

namespace {

/// The step with bodies or without; false if a cell does not bear it. If so, or if it throws, the counts are as before.
bool attempt_step(Gas& gas, double dt, Domain& domain) {
  const std::int64_t flattened = gas.flattened, capped = gas.capped;
  const auto not_done = [&] { gas.flattened = flattened, gas.capped = capped; };
  try {
    const bool borne = gas.bodies.empty() ? try_step(gas, dt, domain) : try_step_with_bodies(gas, dt, domain);
    if (borne) ask_beyond(gas, gas.time + dt);  // the next step begins there
    if (!borne) not_done();
    return borne;
  } catch (const StepFailure&) {
    not_done();
    throw;
  }
}

Outcome advance_fluids(Gas& gas, double dt, Domain& domain) {
  clear_step(gas.passages);
  if (gas.classic) {
    if (timed(gas, Phase::classic, [&] { return advance_classic(gas, dt, domain); }) == Outcome::rejected)
      return Outcome::rejected;
    book_step(gas.passages);
    gas.time += dt, ++gas.step;
    begin(gas, domain);
    return Outcome::done;
  }
  const bool with_bodies = !gas.bodies.empty();
  if (gas.any_first_order) forget_marks(gas);  // of a step that was rejected
  if (with_bodies && !timed(gas, Phase::bodies, [&] { return move_bodies(gas, dt, domain); })) return Outcome::rejected;
  gas.any_first_order = false;
  const int most_attempts = gas.implicit ? 1 : 3;  // the faces of the solve know no slopes to do without
  for (int attempt = 1; !attempt_step(gas, dt, domain); ++attempt) {
    clear_step(gas.passages);
    gas.any_first_order = true;
    if (attempt == most_attempts) {  // the marks stay: they tell why
      forget_first_order_cells(gas);
      return Outcome::rejected;
    }
    make_marked_cells_first_order(gas);
  }
  if (gas.any_first_order) gas.first_order_cell_steps += forget_first_order_cells(gas);
  timed(gas, Phase::ghosts, [&] { with_bodies ? settle_with_bodies(gas, dt, domain) : settle(gas); });
  if (with_bodies) timed(gas, Phase::reaction, [&] { react_around_bodies(gas, dt, domain); });
  timed(gas, Phase::ghosts, [&] { book_step(gas.passages); });
  gas.time += dt, ++gas.step;
  begin(gas, domain);
  return Outcome::done;
}

}  // namespace

Outcome advance(Gas& gas, double dt, Domain& domain) {
  const Outcome outcome = advance_fluids(gas, dt, domain);
  if (outcome == Outcome::done) timed(gas, Phase::ghosts, [&] { watch_ranges(gas); });
  return outcome;
}

Totals totals(const Gas& gas, Domain& domain) {
  const int D = gas.dimensions();
  const std::size_t fluids = gas.fluids.size();
  const std::size_t numbers = fluids + 5;
  std::vector<double> sums;  // of each own block
  for (const std::int32_t b : gas.cells.mine) {
    const auto block = static_cast<std::size_t>(b);
    std::vector<double> sum(numbers, 0.0);
    for (int c = 0; c < 8 * gas.cells.packs(); ++c) {
      if (gas.cells.partial[block] && !gas.cells.contains(gas.cells.index(block, c))) continue;
      const double open = open_part(gas, block, c);
      double mass = 0.0, square = 0.0;
      for (std::size_t r = 0; r < fluids; ++r) {
        const double m = open * gas.content.cell(block, Content::of(D, r, Content::mass), c);
        sum[r] += m, mass += m;
      }
      for (int a = 0; a < D; ++a) {
        const double p = open * gas.content.cell(block, Content::momentum + a, c);
        sum[fluids + static_cast<std::size_t>(a)] += p, square += p * p;
      }
      sum[fluids + 3] += open * gas.content.cell(block, Content::energy, c);
      if (mass > 0.0) sum[fluids + 4] += 0.5 * square / mass;
    }
    sums.insert(sums.end(), sum.begin(), sum.end());
  }
  const std::vector<double> total = sum_of_ranks(sums, numbers, domain);
  Totals result;
  result.mass.assign(total.begin(), total.begin() + static_cast<std::ptrdiff_t>(fluids));
  for (std::size_t a = 0; a < 3; ++a) result.momentum[a] = total[fluids + a];
  result.energy = total[fluids + 3], result.kinetic = total[fluids + 4];
  return result;
}

namespace {

/// What the passages of one side have booked.
Totals through(const Gas& gas, int side, Domain& domain) {
  const std::size_t fluids = gas.fluids.size();
  std::vector<double> sums;
  for (const Passage& p : gas.passages) {
    if (p.side != side) continue;
    for (const CompensatedSum& mass : p.mass) sums.push_back(mass.value());
    for (const CompensatedSum& momentum : p.momentum) sums.push_back(momentum.value());
    sums.push_back(p.energy.value());
  }
  const std::vector<double> total = sum_of_ranks(sums, fluids + 4, domain);
  Totals result;
  result.mass.assign(total.begin(), total.begin() + static_cast<std::ptrdiff_t>(fluids));
  for (std::size_t a = 0; a < 3; ++a) result.momentum[a] = total[fluids + a];
  result.energy = total[fluids + 3];
  return result;
}

}  // namespace

std::vector<Totals> passed(const Gas& gas, Domain& domain) {
  const std::size_t fluids = gas.fluids.size();
  std::vector<Totals> result;
  for (int side = 0; side <= 2 * gas.dimensions(); ++side) result.push_back(through(gas, side, domain));
  for (const MovingBody& body : gas.bodies.all) {
    Totals received{std::vector<double>(fluids, 0.0), {}, -body.work.value(), 0.0};
    for (std::size_t a = 0; a < 3; ++a) received.momentum[a] = -body.impulse[a].value();
    result.push_back(received);
  }
  if (!gas.bodies.empty()) {
    const auto lost = [&](std::size_t n) { return 0.0 - gas.bodies.entrapped[n].value(); };
    Totals entrapped{std::vector<double>(fluids, 0.0), {}, lost(gas.bodies.entrapped.size() - 1), 0.0};
    for (std::size_t r = 0; r < fluids; ++r) entrapped.mass[r] = lost(r);
    for (std::size_t a = 0; a < static_cast<std::size_t>(gas.dimensions()); ++a) entrapped.momentum[a] = lost(fluids + a);
    result.push_back(entrapped);
  }
  return result;
}

std::vector<Totals> burned(const Gas& gas, Domain& domain) {
  std::vector<Totals> result;
  for (std::size_t n = 0; n < gas.burns.size(); ++n)
    result.push_back(through(gas, first_burn_side + static_cast<int>(n), domain));
  return result;
}

std::size_t Gas::bytes() const {
  std::size_t sum = swept.capacity() * sizeof(Lanes) + face_laws.capacity() * sizeof(FaceLaw) + bytes_of(bodies);
  for (const std::vector<Fan>& of_block : fans) sum += of_block.capacity() * sizeof(Fan);
  if (classic) sum += classic->state.bytes();
  for (const CellSet* set : {&content, &moved, &next, &marks, &primitive, &half_step, &transport, &unknown, &burning_area,
                             &filtered, &filtering, &released})
    sum += set->bytes();
  return sum;
}

namespace {

/// The fields that a checkpoint keeps. The pressures as well: to find them once more from the contents would change last
/// digits.
template <class AnyGas>
auto kept_sets(AnyGas& gas) {
  std::vector sets{&gas.content, &gas.primitive};
  if (gas.classic) sets.push_back(&gas.classic->state);
  return sets;
}

}  // namespace

std::vector<double> numbers_of(const Gas& gas) {
  std::vector<double> numbers{gas.time,
                              static_cast<double>(gas.step),
                              gas.wave_rate,
                              gas.motion_rate,
                              static_cast<double>(gas.flattened),
                              static_cast<double>(gas.cells.mine.size()),
                              static_cast<double>(gas.contents()),
                              static_cast<double>(gas.first_order_cell_steps)};
  for (const CellSet* set : kept_sets(gas))
    for (const std::int32_t b : gas.cells.mine) {
      const double* first = reinterpret_cast<const double*>(set->at(static_cast<std::size_t>(b), 0));
      numbers.insert(numbers.end(), first, first + set->quantities() * set->packs() * 8);
    }
  for (const Passage& p : gas.passages) {
    const auto keep = [&](const CompensatedSum& sum) {
      const double* first = reinterpret_cast<const double*>(&sum);
      numbers.insert(numbers.end(), first, first + sizeof(CompensatedSum) / sizeof(double));
    };
    for (const CompensatedSum& mass : p.mass) keep(mass);
    for (const CompensatedSum& momentum : p.momentum) keep(momentum);
    keep(p.energy);
  }
  numbers.push_back(static_cast<double>(gas.capped));
  for (const OutsideRange& o : gas.outside)
    numbers.insert(numbers.end(),
                   {static_cast<double>(o.cell_steps), o.excess, o.density, o.time, o.place[0], o.place[1], o.place[2]});
  const std::vector<double> bodies = numbers_of(gas.bodies);
  numbers.insert(numbers.end(), bodies.begin(), bodies.end());
  return numbers;
}

void restore(Gas& gas, const std::vector<double>& numbers, Domain& domain) {
  if (numbers.size() != numbers_of(gas).size() || numbers[5] != static_cast<double>(gas.cells.mine.size()) ||
      numbers[6] != static_cast<double>(gas.contents()))
    throw std::runtime_error("its gas is of another case or another version of this program");
  const double* next = numbers.data();
  gas.time = next[0], gas.step = static_cast<std::int64_t>(next[1]), gas.wave_rate = next[2], gas.motion_rate = next[3];
  gas.flattened = static_cast<std::int64_t>(next[4]), gas.first_order_cell_steps = static_cast<std::int64_t>(next[7]);
  next += 8;
  for (CellSet* set : kept_sets(gas))
    for (const std::int32_t b : gas.cells.mine) {
      const int count = set->quantities() * set->packs() * 8;
      std::copy_n(next, count, reinterpret_cast<double*>(set->at(static_cast<std::size_t>(b), 0)));
      next += count;
    }
  for (Passage& p : gas.passages) {
    const auto take = [&](CompensatedSum& sum) {
      static_assert(std::is_trivially_copyable_v<CompensatedSum>);
      std::memcpy(static_cast<void*>(&sum), next, sizeof(CompensatedSum));
      next += sizeof(CompensatedSum) / sizeof(double);
    };
    for (CompensatedSum& mass : p.mass) take(mass);
    for (CompensatedSum& momentum : p.momentum) take(momentum);
    take(p.energy);
  }
  gas.capped = static_cast<std::int64_t>(*next++);
  for (OutsideRange& o : gas.outside) {
    o.cell_steps = static_cast<std::int64_t>(*next++);
    for (double* value : {&o.excess, &o.density, &o.time, &o.place[0], &o.place[1], &o.place[2]}) *value = *next++;
  }
  restore(gas.bodies, next);
  place_bodies(gas, domain);
  share_primitives(gas, gas.time, domain);
  prepare_transport(gas, domain);
}

}  // namespace brisance::simulator::gas
