// One step of a gas with bodies in it.

#include <algorithm>

#include "simulator/gas/bodies_step.hpp"
#include "simulator/gas/sums.hpp"
#include "simulator/gas/timed.hpp"

namespace brisance::simulator::gas {

bool move_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  bodies.next.clear();
  bool still = true;
  for (const MovingBody& body : bodies.all) {
    bodies.next.push_back(moved(body, gas.time, dt));
    const MovingBody::State& next = bodies.next.back();
    still = still && next.displacement == body.state.displacement && next.turn == body.state.turn &&
            next.growth == body.state.growth;
  }
  if (still && bodies.still) return true;
  unsplit::Meeting meeting;
  bool changes_sides = false;
  if (!bodies.window.empty()) {
    std::vector<BodyPoints> points;
    for (std::size_t b = 0; b < bodies.all.size(); ++b)
      points.push_back(points_of(bodies.all[b], gas.cells.geometry, bodies.all[b].state, bodies.next[b], dt));
    put_on_nodes(bodies.window, gas.cells, images_of(gas), points, bodies.nodes);
    find_open_space(bodies.window, gas.cells, bodies.nodes, bodies.next_space);
    find_cut_cells(bodies.window, gas.cells, bodies.space, bodies.next_space, bodies.nodes, bodies.step);
    find_neighbourhoods(bodies.window, gas.cells, bodies.space, bodies.next_space, bodies.step, bodies.small);
    unsplit::note_meetings(gas, meeting);
    changes_sides = unsplit::gas_changes_sides(gas);
  }
  bodies.still = still;
  return !unsplit::bodies_meet(gas, meeting, dt, domain) && domain.maximum(changes_sides ? 1.0 : 0.0) == 0.0;
}

bool try_step_with_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  const bool here = !bodies.window.empty();
  timed(gas, Phase::ghosts, [&] { unsplit::take_state(gas, domain); });
  if (here) timed(gas, Phase::half_step, [&] { unsplit::half_step(gas, dt); });
  timed(gas, Phase::lagrangian, [&] {
    std::vector<Received> received;
    if (here) unsplit::find_faces(gas, dt), unsplit::push_cells(gas, dt), received = unsplit::push_by_walls(gas, dt);
    if (here) unsplit::pull_by_gravity(gas, dt);
    unsplit::push_bodies(gas, received, dt, domain);
    if (here) unsplit::hold_rows_together(gas, dt);
    if (here && gas.fluids.size() > 1) unsplit::share_changes(gas);
  });
  bodies.entrapped_now.assign(bodies.entrapped.size(), 0.0);
  bool good = true;
  unsplit::Meeting meeting;
  std::int64_t flattened = 0;
  if (here) {
    timed(gas, Phase::remap, [&] {
      unsplit::find_donors(gas);
      good = unsplit::nothing_is_overdrawn(gas, dt);
      flattened = unsplit::remap(gas, dt);
    });
    timed(gas, Phase::bodies, [&] { unsplit::redistribute_all(gas, bodies.entrapped_now, meeting); });
    good = timed(gas, Phase::equilibrium, [&] { return unsplit::all_is_well(gas); }) && good;
  }
  if (unsplit::bodies_meet(gas, meeting, dt, domain)) return false;
  gas.flattened += flattened;
  return domain.maximum(good ? 0.0 : 1.0) == 0.0;
}

void settle_with_bodies(Gas& gas, double dt, Domain& domain) {
  Bodies& bodies = gas.bodies;
  const bool here = !bodies.window.empty();
  if (here) unsplit::book_sides(gas, dt), unsplit::keep(gas);
  const std::vector<double>& entrapped = bodies.entrapped_now;
  const bool lost = std::any_of(entrapped.begin(), entrapped.end(), [](double x) { return x != 0.0; });
  if (domain.maximum(lost ? 1.0 : 0.0) > 0.0) {
    const std::vector<double> total = sum_of_ranks(entrapped, entrapped.size(), domain);
    for (std::size_t n = 0; n < total.size(); ++n) bodies.entrapped[n].add(total[n]);
  }
  for (std::size_t b = 0; b < bodies.all.size(); ++b) {
    MovingBody& body = bodies.all[b];
    body.state = bodies.next[b], body.force = (1.0 / dt) * bodies.received[b].impulse;
    for (std::size_t a = 0; a < 3; ++a) body.impulse[a].add(bodies.received[b].impulse[a]);
    body.work.add(bodies.received[b].work);
  }
  if (here) {
    if (!bodies.still) std::swap(bodies.space, bodies.next_space);
    keep_open_parts(gas);
  }
}

}  // namespace brisance::simulator::gas
