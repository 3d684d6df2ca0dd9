#include "simulator/gas/reaction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "models/equation_of_state/thermodynamics.hpp"
#include "simulator/gas/equilibrium.hpp"
#include "simulator/gas/gas.hpp"
#include "simulator/gas/ghosts.hpp"
#include "simulator/gas/own_blocks.hpp"
#include "simulator/parallel.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator::gas {
namespace {

/// Most that burns in a cell in a step, of the mass that the reactant would fill it with. More would be set free before its
/// pressure can push anything away.
constexpr double most_of_a_cell = 0.2;
/// The last of a cell's reactant burns at once: laws whose rate falls with what is left never come to an end.
constexpr double least_unburned = 1e-6;

// Burning area ---------------------------------------------------------------------------------------------------------

enum class Stencil { smooth, difference };

/// One quantity along one axis, from one set to another: the mean of three cells (1, 2, 1)/4, or half the difference of the two
/// neighbours. Of all own cells.
void filter(Gas& gas, int quantity, int axis, Stencil stencil) {
  for_each_own_block(gas, [&](auto D, std::size_t, std::size_t block) {
    for (int n = 0; n < BlockShape<D()>::pencils; ++n) {
      Pencil q, result;
      load<D()>(gas.cells, gas.filtered, block, quantity, axis, n, q);
      for (std::size_t c = ring; c < ring + line; ++c)
        result[c] = stencil == Stencil::smooth ? 0.25 * (q[c - 1] + q[c + 1]) + 0.5 * q[c] : 0.5 * (q[c + 1] - q[c - 1]);
      store<D()>(gas.filtering, block, quantity, axis, n, result);
    }
  });
}

/// f(block, pack) for the cells of own blocks.
template <class F>
void for_each_pack(Gas& gas, F&& f) {
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    for (int k = 0; k < gas.cells.packs(); ++k) f(static_cast<std::size_t>(gas.cells.mine[i]), k);
  });
}

/// Each of the quantities through one filter along each axis; `stencil(quantity, axis)` tells which.
template <class F>
void filter_all(Gas& gas, int quantities, Beyond beyond, Domain& domain, F&& stencil) {
  for (int axis = 0; axis < gas.dimensions(); ++axis) {
    share_scalars(gas, gas.filtered, beyond, domain);
    for (int q = 0; q < quantities; ++q) filter(gas, q, axis, stencil(q, axis));
    std::swap(gas.filtered, gas.filtering);
  }
}

Lanes fraction_of(const Gas& gas, int fluid, std::size_t block, int k) {
  const int volume = Content::of(gas.dimensions(), fluid, Content::volume);
  return gas.content.at(block, volume)[k] / gas.content.at(block, Content::cell_volume)[k];
}
constexpr auto smooth = [](int, int) { return Stencil::smooth; };
Lanes fourth_power(const Lanes& x) {
  return (x * x) * (x * x);
}

}  // namespace

void find_burning_area(Gas& gas, int fluid, Domain& domain) {
  const int D = gas.dimensions();
  const double inverse_cell_size = 1.0 / gas.cells.cell_size;
  const auto set = [&](std::size_t block, int quantity, int k) -> Lanes& { return gas.filtered.at(block, quantity)[k]; };
  // Component a of the gradient: the difference along a, smoothed along the other axes. Beside it what is not reactant.
  for_each_pack(gas, [&](std::size_t block, int k) {
    const Lanes fraction = fraction_of(gas, fluid, block, k);
    for (int a = 0; a < D; ++a) set(block, a, k) = fraction;
    set(block, D, k) = max(1.0 - fraction, Lanes(0.0));
  });
  filter_all(gas, D + 1, Beyond::continued, domain,
             [](int component, int axis) { return component == axis ? Stencil::difference : Stencil::smooth; });
  // Only cells with reactant burn, and those first that the gas has eaten into: a front that burned into full cells would blur.
  // So every cell deals its area out to itself and its neighbours by their appetite.
  for_each_pack(gas, [&](std::size_t block, int k) {
    Lanes square(0.0);
    for (int a = 0; a < D; ++a) square += set(block, a, k) * set(block, a, k);
    gas.burning_area.at(block, 0)[k] = sqrt(square) * inverse_cell_size * gas.content.at(block, Content::cell_volume)[k];
    const Lanes reactant = max(fraction_of(gas, fluid, block, k), Lanes(0.0));
    gas.burning_area.at(block, 1)[k] = set(block, 0, k) = reactant * fourth_power(set(block, D, k) * set(block, D, k));
  });
  filter_all(gas, 1, Beyond::continued, domain, smooth);
  for_each_pack(gas, [&](std::size_t block, int k) {
    Lanes& appetite = set(block, 0, k);
    appetite = select(appetite > 0.0, gas.burning_area.at(block, 0)[k] / max(appetite, Lanes(1e-300)), Lanes(0.0));
  });
  filter_all(gas, 1, Beyond::continued, domain, smooth);
  for_each_pack(gas, [&](std::size_t block, int k) {
    gas.burning_area.at(block, 0)[k] = gas.burning_area.at(block, 1)[k] * set(block, 0, k);
  });
}

std::optional<double> distance(const Shape& region, const Vector& place) {
  if (const Box* box = std::get_if<Box>(&region.form)) {
    double square = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double beyond = std::max({box->lower[a] - place[a], place[a] - box->upper[a], 0.0});
      square += beyond * beyond;
    }
    return std::sqrt(square);
  }
  if (const Sphere* sphere = std::get_if<Sphere>(&region.form); sphere && sphere->inner_radius == 0.0)
    return std::max(magnitude(place - sphere->centre) - sphere->radius, 0.0);
  if (const Union* all = std::get_if<Union>(&region.form)) {
    std::optional<double> nearest;
    for (const ShapePointer& part : all->parts) {
      const std::optional<double> one = distance(*part, place);
      if (!one) return std::nullopt;
      nearest = std::min(nearest.value_or(*one), *one);
    }
    return nearest;
  }
  return std::nullopt;
}

// Burning --------------------------------------------------------------------------------------------------------------

namespace {

/// When a programmed detonation reaches a place, s: straight rays from where it is lit first.
double arrival_time(const Burn& burn, const reaction::ProgramBurn& law, const Vector& place) {
  if (burn.ignitions.empty()) return law.arrival_time(place);
  double first = std::numeric_limits<double>::infinity();
  for (const Ignition& ignition : burn.ignitions) {
    const double way = ignition.region ? distance(*ignition.region, place).value() : 0.0;
    first = std::min(first, ignition.time + way / law.detonation_velocity);
  }
  return first;
}

bool is_lit(const Burn& burn, const Vector& place, double time) {
  return std::any_of(burn.ignitions.begin(), burn.ignitions.end(), [&](const Ignition& ignition) {
    return time >= ignition.time && (!ignition.region || contains(*ignition.region, place));
  });
}
template <class F>
Lanes for_lanes(const Gas& gas, std::size_t block, int k, F&& value_at) {
  Lanes result;
  for (int l = 0; l < 8; ++l) result.set(l, value_at(gas.cells.centre(block, 8 * k + l)));
  return result;
}

/// The same law for a surface that has been lit, however cold it is.
reaction::PressurePower without_threshold(reaction::PressurePower law) {
  law.temperature_threshold = 0.0;
  return law;
}
reaction::WardSonBrewster without_threshold(reaction::WardSonBrewster law) {
  law.ignition_temperature = 0.0;
  return law;
}

using Arguments = reaction::Arguments<Lanes>;

/// What a cell has that may burn, and where.
struct Reactant {
  const Gas& gas;
  const Burn& burn;
  std::size_t block;
  int pack;
  Lanes mass, together;  // kg, of the reactant; with its product
};

/// Mass that a law burns in a step, kg.
template <class Law>
Lanes burned_mass(const Law& law, const Reactant& r, Arguments& at, double dt) {
  if constexpr (Law::kind == reaction::Kind::surface) {
    const Lanes area = r.gas.burning_area.at(r.block, 0)[r.pack];
    if (none(area > 0.0)) return Lanes(0.0);
    Lanes rate = law(at);
    if (!r.burn.ignitions.empty()) {
      const Lanes lit =
          for_lanes(r.gas, r.block, r.pack, [&](const Vector& x) { return is_lit(r.burn, x, r.gas.time + dt) ? 1.0 : 0.0; });
      rate = select(lit > 0.0, without_threshold(law)(at), rate);
    }
    return rate * area * dt;
  } else if constexpr (std::is_same_v<Law, reaction::ProgramBurn>) {
    at.arrival_time = for_lanes(r.gas, r.block, r.pack, [&](const Vector& x) { return arrival_time(r.burn, law, x); });
    return max(Lanes(law.prescribed_fraction(at) - at.burned_fraction), Lanes(0.0)) * r.together;
  } else {
    // What is left decays with a rate of its own over the step.
    const Lanes decay = law(at) * r.together / max(r.mass, Lanes(1e-300));
    return -r.mass * expm1(-decay * dt);
  }
}

/// What a surface has set free in each cell, as gas.filtered holds it; then momentum.
struct Released {
  static constexpr int mass = 0, volume = 1, internal = 2, energy = 3, momentum = 4;
  static constexpr int count(int dimensions) { return momentum + dimensions; }
};

/// Lets what one block holds burn. Returns in how many cells the step was too long for the reaction.
std::int64_t burn_block(Gas& gas, CellSet& held, std::size_t number, std::size_t block, double dt) {
  const Burn& burn = gas.burns[number];
  const int D = gas.dimensions();
  const Fluid& reactant = gas.fluids[static_cast<std::size_t>(burn.reactant)];
  const double heat = std::visit([](const auto& law) { return law.heat(); }, burn.law);
  const bool surface = has_surface(burn.law);
  auto& book = gas.passages[static_cast<std::size_t>(gas.book_of_burn[block * gas.burns.size() + number])].step;
  const auto at = [&](int quantity, int k) -> Lanes& { return held.at(block, quantity)[k]; };
  const auto set_free = [&](int quantity, int k) -> Lanes& { return gas.filtered.at(block, quantity)[k]; };
  std::int64_t capped = 0;
  for (int k = 0; k < gas.cells.packs(); ++k) {
    for (int q = 0; surface && q < Released::count(D); ++q) set_free(q, k) = Lanes(0.0);
    const std::uint8_t inside = cells_inside(gas.cells, block, k);
    const auto of = [&](int fluid, int quantity) -> Lanes& { return at(Content::of(D, fluid, quantity), k); };
    Lanes &mass = of(burn.reactant, Content::mass), &volume = of(burn.reactant, Content::volume);
    Lanes& internal = of(burn.reactant, Content::internal);
    const Lanes open = gas.bodies.empty() ? Lanes(1.0) : gas.bodies.open.at(block, 0)[k];
    const LanesMask present = lanes_of(inside) & (mass > 0.0) & (volume > 0.0) & (open > 0.0);
    if (none(present)) continue;
    Lanes& product = of(burn.product, Content::mass);
    const Reactant what{gas, burn, block, k, mass, mass + product};
    Arguments state;
    state.density = select(present, mass / volume, Lanes(reactant.usual_density));
    const Lanes energy = select(present, internal / mass, Lanes(reactant.usual_energy));
    state.pressure = gas.primitive.at(block, Primitive::pressure)[k] + gas.half_step.at(block, HalfStep::pressure)[k];
    state.burned_fraction = select(present, product / what.together, Lanes(0.0));
    state.time = gas.time + dt, state.cell_size = gas.cells.cell_size;
    if (surface)
      state.temperature =
          std::visit([&](const auto& law) { return equation_of_state::temperature(law, state.density, energy); },
                     reactant.equation_of_state);
    const Lanes wanted = std::visit([&](const auto& law) { return burned_mass(law, what, state, dt); }, burn.law);
    const LanesMask burns = present & (wanted > 0.0);
    if (none(burns)) continue;
    const Lanes most = most_of_a_cell * reactant.usual_density * at(Content::cell_volume, k);
    const LanesMask too_much = burns & (wanted > most) & (mass > most);
    const LanesMask last = mass - wanted <= least_unburned * what.together;
    const Lanes burned = select(burns, min(select(last, mass, wanted), select(too_much, most, mass)), Lanes(0.0));
    const Lanes part = select(burns, burned / mass, Lanes(0.0)), heat_free = heat * burned;
    const Lanes gone = part * volume, taken = part * internal;
    if (surface) {
      Lanes whole(0.0), kinetic(0.0);
      for (int r = 0; r < static_cast<int>(gas.fluids.size()); ++r) whole += of(r, Content::mass);
      for (int a = 0; a < D; ++a) {
        Lanes& momentum = at(Content::momentum + a, k);
        const Lanes carried = burned * (momentum / whole);
        kinetic += 0.5 * carried * (momentum / whole);
        momentum -= carried, set_free(Released::momentum + a, k) = carried;
      }
      at(Content::energy, k) -= taken + kinetic;
      set_free(Released::mass, k) = burned, set_free(Released::volume, k) = gone;
      set_free(Released::internal, k) = taken + heat_free, set_free(Released::energy, k) = taken + heat_free + kinetic;
    } else {
      product += burned, of(burn.product, Content::volume) += gone;
      of(burn.product, Content::internal) += taken + heat_free, at(Content::energy, k) += heat_free;
    }
    mass -= burned, volume -= gone, internal -= taken;
    for (int l = 0; l < 8; ++l) {
      if (!burns[l]) continue;
      capped += too_much[l] ? 1 : 0;
      book.mass[static_cast<std::size_t>(burn.reactant)] -= open[l] * burned[l];
      if (!surface) book.mass[static_cast<std::size_t>(burn.product)] += open[l] * burned[l];
      book.energy += open[l] * heat_free[l];
    }
  }
  return capped;
}

/// Deals what a surface has set free out to the cells about it, by the gas that they hold.
void release(Gas& gas, std::size_t number, Domain& domain) {
  const Burn& burn = gas.burns[number];
  const int D = gas.dimensions(), count = Released::count(D);
  const auto set = [&](std::size_t block, int quantity, int k) -> Lanes& { return gas.filtered.at(block, quantity)[k]; };
  constexpr double own_cell = 1e-30;  // without any gas about it
  const auto kept = [&](std::size_t block, int quantity, int k) -> Lanes& { return gas.released.at(block, quantity)[k]; };
  for_each_pack(gas, [&](std::size_t block, int k) {
    for (int q = 0; q < count; ++q) kept(block, q, k) = set(block, q, k);
    const Lanes gas_part = clamp(1.0 - fraction_of(gas, burn.reactant, block, k), 0.0, 1.0);
    const Lanes inside = select(lanes_of(cells_inside(gas.cells, block, k)), Lanes(1.0), Lanes(0.0));
    kept(block, count, k) = set(block, 0, k) = inside * (fourth_power(fourth_power(gas_part)) + own_cell);
  });
  filter_all(gas, 1, Beyond::nothing, domain, smooth);
  for_each_pack(gas, [&](std::size_t block, int k) {
    const Lanes about = set(block, 0, k);
    for (int q = 0; q < count; ++q)
      set(block, q, k) = select(about > 0.0, kept(block, q, k) / max(about, Lanes(1e-300)), Lanes(0.0));
  });
  filter_all(gas, count, Beyond::nothing, domain, smooth);
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    const auto block = static_cast<std::size_t>(gas.cells.mine[i]);
    auto& book = gas.passages[static_cast<std::size_t>(gas.book_of_burn[block * gas.burns.size() + number])].step;
    const auto product = [&](int quantity) { return Content::of(D, burn.product, quantity); };
    for (int k = 0; k < gas.cells.packs(); ++k) {
      const auto add = [&](int quantity, int released) {
        const Lanes received = kept(block, count, k) * set(block, released, k);
        gas.moved.at(block, quantity)[k] += received;
        return received;
      };
      const Lanes mass = add(product(Content::mass), Released::mass);
      add(product(Content::volume), Released::volume), add(product(Content::internal), Released::internal);
      add(Content::energy, Released::energy);
      for (int a = 0; a < D; ++a) add(Content::momentum + a, Released::momentum + a);
      for (int l = 0; l < 8; ++l) book.mass[static_cast<std::size_t>(burn.product)] += mass[l];
    }
  });
}

}  // namespace

void prepare_burns(Gas& gas) {
  gas.book_of_burn.assign(gas.cells.blocks.size() * gas.burns.size(), -1);
  for (const std::int32_t b : gas.cells.mine)
    for (std::size_t n = 0; n < gas.burns.size(); ++n) {
      Passage book;
      book.block = b, book.side = first_burn_side + static_cast<int>(n);
      book.mass.resize(gas.fluids.size()), book.step.mass.resize(gas.fluids.size());
      gas.book_of_burn[static_cast<std::size_t>(b) * gas.burns.size() + n] = static_cast<std::int32_t>(gas.passages.size());
      gas.passages.push_back(book);
    }
  const bool surface = std::any_of(gas.burns.begin(), gas.burns.end(), [](const Burn& b) { return has_surface(b.law); });
  if (!surface) return;
  const int packs = gas.cells.packs(), released = Released::count(gas.dimensions());
  gas.burning_area = CellSet(2, packs);
  gas.filtered = gas.filtering = CellSet(released, packs), gas.released = CellSet(released + 1, packs);
  for (CellSet* set : {&gas.burning_area, &gas.filtered, &gas.filtering, &gas.released}) set->resize(gas.cells.blocks.size());
}

namespace {

void burn_blocks(Gas& gas, CellSet& held, std::size_t number, double dt) {
  std::vector<std::int64_t> capped(gas.cells.mine.size());
  parallel_for_blocks(gas.cells.mine.size(), [&](std::size_t i) {
    capped[i] = burn_block(gas, held, number, static_cast<std::size_t>(gas.cells.mine[i]), dt);
  });
  gas.capped = std::accumulate(capped.begin(), capped.end(), gas.capped);
}

}  // namespace

void burn_cells(Gas& gas, std::size_t number, double dt, Domain& domain) {
  burn_blocks(gas, gas.moved, number, dt);
  if (has_surface(gas.burns[number].law)) release(gas, number, domain);
}

void react_around_bodies(Gas& gas, double dt, Domain& domain) {
  if (gas.burns.empty()) return;
  find_equilibrium(gas, domain);
  for (std::size_t number = 0; number < gas.burns.size(); ++number) burn_blocks(gas, gas.content, number, dt);
}

void react(Gas& gas, double dt, Domain& domain) {
  for (std::size_t number = 0; number < gas.burns.size(); ++number) {
    if (has_surface(gas.burns[number].law)) find_burning_area(gas, gas.burns[number].reactant, domain);
    burn_cells(gas, number, dt, domain);
  }
}

}  // namespace brisance::simulator::gas
