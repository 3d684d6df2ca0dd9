#pragma once
// The gas between two steps: any number of fluids that share one velocity and one pressure in each cell, on the cells of the
// grid. Conservative ICE: a cell-centred Lagrangian phase driven by the velocities and pressures of the faces, then a remap of
// what the faces have swept. Mass of each fluid, momentum, total energy and the volumes of the fluids are conserved to
// round-off: every one of them leaves a cell only through a face, and enters the next one there.
//
// The scheme keeps the skeleton of ICE (Kashiwa et al., LA-UR-93-3922, 1993) with the acoustic face states of
// Lagrange-projection schemes (Chalons, Girardin & Kokh, J. Comput. Phys. 335 (2017) 885) and total instead of internal energy.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/equation_of_state/equation_of_state.hpp"
#include "models/reaction/reaction.hpp"
#include "simulator/gas/bodies.hpp"
#include "simulator/gas/cells.hpp"
#include "simulator/gas/fan.hpp"
#include "simulator/ledger.hpp"

namespace brisance::simulator::gas {

/// What one cell, or the world beyond a boundary, is filled with.
struct Filling {
  int fluid = 0;
  double density = 0.0;      // kg/m^3
  double pressure = 0.0;     // Pa
  Vector velocity{};         // m/s
  double temperature = 0.0;  // K, of a fluid whose pressure tells nothing of it; 0: that of its law
};
using FillingFunction = std::function<Filling(const Vector& position, double time)>;

struct Edge {
  std::string name;
  EdgeKind kind = EdgeKind::wall;
  FillingFunction beyond;               // inflow, non_reflecting; of pressure only the pressure; of no_slip the velocity
  std::optional<double> temperature{};  // K, of a wall of kind no_slip; none: no heat passes it
};

/// Nothing passes it; also a plane of symmetry, and the axis.
constexpr bool is_wall(EdgeKind kind) {
  return kind == EdgeKind::wall || kind == EdgeKind::no_slip;
}

struct Fluid {
  std::string name;
  EquationOfState equation_of_state;
  double usual_density = 1.0, usual_energy = 1.0;  // kg/m^3, J/kg; a state that it can have, for lanes without this fluid
  double usual_heat = 1.0;                         // J/kg, of its energy
  double least_pressure = -1e300;                  // Pa, at T = 0 and any density
  double viscosity = 0.0, bulk_viscosity = 0.0;    // Pa s
  double conductivity = 0.0;                       // W/(m K)
};

/// Where, and from when on: a surface burns there however cold it is; a programmed detonation starts there.
struct Ignition {
  ShapePointer region;  // absent: everywhere
  double time = 0.0;    // s
};

/// A fluid that turns into another by a law.
struct Burn {
  std::string name;
  int reactant = 0, product = 1;  // fluids
  Reaction law;
  std::vector<Ignition> ignitions;
};

/// Content of a cell, per whole cell, radian or steradian (see Metric). With one fluid its volume and energy are not kept.
struct Content {
  static constexpr int cell_volume = 0;  // m^3; what it has become in the Lagrangian phase
  static constexpr int energy = 1;       // J, total
  static constexpr int momentum = 2;     // kg m/s, as many components as dimensions
  static constexpr int fluids(int dimensions) { return momentum + dimensions; }
  static constexpr int mass = 0;      // kg, of a fluid
  static constexpr int volume = 1;    // m^3
  static constexpr int internal = 2;  // J
  /// Of a fluid: its mass, volume or internal energy.
  static constexpr int of(int dimensions, std::integral auto fluid, int quantity) {
    return fluids(dimensions) + 3 * static_cast<int>(fluid) + quantity;
  }
  static constexpr int fluid_of(int dimensions, int index) { return (index - fluids(dimensions)) / 3; }
  /// Whether this is that quantity of some fluid.
  static constexpr bool is_of_fluid(int dimensions, int index, int quantity) {
    return index >= fluids(dimensions) && (index - fluids(dimensions)) % 3 == quantity;
  }
};
/// State of a cell as the pressure equilibrium gives it.
struct Primitive {
  static constexpr int density = 0, pressure = 1, sound_speed = 2, gruneisen = 3, velocity = 4;
  static constexpr int count(int dimensions) { return velocity + dimensions; }
  /// With several fluids: the part of the cell's compressibility that each has, and the mean of their impedances by these parts
  /// over the impedance of the cell, 1 or less.
  static constexpr int share(int dimensions, int fluid) { return count(dimensions) + fluid; }
  static constexpr int impedance_ratio(int dimensions, int fluids) { return share(dimensions, fluids); }
  static constexpr int all(int dimensions, int fluids) {
    return fluids > 1 ? impedance_ratio(dimensions, fluids) + 1 : count(dimensions);
  }
};
/// What half a step changes in the Lagrangian frame, and which cells are of first order, without slopes (1, others 0).
struct HalfStep {
  static constexpr int pressure = 0, velocity = 1;
  static constexpr int first_order(int dimensions) { return 1 + dimensions; }
  /// Of the area across an axis, in parts of itself: by how much it grows (the same axis), how far it tilts towards another
  /// one. There is none in one dimension. See moving_faces.hpp.
  static constexpr int area(int dimensions, int across, int towards) { return 2 + dimensions + dimensions * across + towards; }
  static constexpr int count(int dimensions) { return dimensions == 1 ? 3 : area(dimensions, dimensions, 0); }
};

/// Coefficients, temperature and velocity gradients of a cell, from which stress and heat flow follow.
struct Transport {
  static constexpr int viscosity = 0, bulk_viscosity = 1, conductivity = 2, temperature = 3;  // Pa s, W/(m K), K
  static constexpr int gradient = 4;  // 1/s: of each component along each axis
  static constexpr int count(int dimensions) { return gradient + dimensions * dimensions; }
};

/// What has passed the faces of one block on one side of the box, into it: mass of each fluid (kg), impulse of the pressure and
/// momentum carried (N s), energy (J).
struct Passage {
  std::int32_t block = 0;
  int side = 0;                         // as Gas::edges
  int face = 0;                         // of the block's pencils
  std::array<std::uint8_t, 8> lanes{};  // of each pencil, that lie within the box
  std::vector<CompensatedSum> mass;
  std::array<CompensatedSum, 3> momentum;
  CompensatedSum energy;
  struct {
    std::vector<double> mass;
    Vector momentum{};
    double energy = 0.0;
  } step;  // the same of the step that is under way
};

/// Mass of each fluid, momentum and energy of all cells, summed in Morton order. Per metre, radian or steradian as Metric says.
struct Totals {
  std::vector<double> mass;  // kg
  Vector momentum{};         // kg m/s
  double energy = 0.0;       // J
  double kinetic = 0.0;      // J
};

/// The velocity of a face as the pressures at its sides make it: free - yield (high - low).
struct FaceLaw {
  Lanes free;   // m/s
  Lanes yield;  // m/(s Pa)
};

/// What the classic scheme keeps instead of the contents: each fluid has a velocity of its own. See classic.hpp.
struct ClassicState {
  static constexpr int mass = 0, volume = 1, internal = 2,
                       momentum = 3;  // kg, m^3, J, kg m/s in as many components as dimensions
  static constexpr int count(int dimensions) { return momentum + dimensions; }
  static constexpr int of(int dimensions, int fluid, int quantity) { return fluid * count(dimensions) + quantity; }
  double momentum_exchange = 1e15;  // kg/(m^3 s)
  CellSet state;
};

/// When a fluid was denser or thinner than its equation of state declares: see range_watch.hpp.
struct OutsideRange {
  std::int64_t cell_steps = 0;
  double excess = 1.0;   // of the worst: density over the highest, or the lowest over it
  double density = 0.0;  // kg/m^3
  double time = 0.0;     // s
  Vector place{};        // m, middle of its cell
};

/// Where the time of a step goes.
enum class Phase {
  half_step,
  pressure_solve,
  lagrangian,
  transport,
  reaction,
  remap,
  bodies,
  classic,
  equilibrium,
  ghosts,
  count
};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Phase::count)> phase_names{
    "half step", "pressure solve", "Lagrangian phase", "viscosity, heat", "reaction",
    "remap",     "bodies, cuts",   "classic scheme",   "equilibrium",     "ghosts, halo, books"};

/// What a reaction has burned within one block is kept as a passage, too: of a side with this number and those after it.
inline constexpr int first_burn_side = 100;

struct Gas {
  Cells cells;
  std::vector<Fluid> fluids;
  std::vector<Edge> edges;  // low x, high x, low y, ...
  std::vector<Burn> burns;
  Vector gravity{};
  double courant = 0.0;      // 0: what the geometry allows
  double least_mach = 1e-3;  // below, the dissipation of the faces falls no further with the Mach number

  bool implicit = false;                // the pressures of a step are solved for
  double acoustic_courant = 20.0;       // of its steps then
  double heat_exchange = 0.0;           // W/(m^3 K), between each two fluids
  std::optional<ClassicState> classic;  // instead of the scheme above

  CellSet content;                                      // at the start of the step
  CellSet moved, next;                                  // after the Lagrangian phase and each sweep of the remap
  CellSet marks;                                        // cells that have not borne an attempt at the step: 1, others 0
  CellSet primitive, half_step;                         // scratch
  CellSet transport;                                    // with viscosity or conduction: see Transport
  CellSet unknown;                                      // implicit: number of each cell among the unknowns; -1: none
  std::vector<FaceLaw> face_laws;                       // implicit: [block][axis][pencil][face]
  std::vector<Lanes> swept;                             // m^3 that pass the faces in a step: [block][axis][pencil][face]
  std::vector<std::vector<Fan>> fans;                   // of each block, that open in a step
  std::vector<Passage> passages;                        // in Morton order of the blocks
  std::vector<std::array<std::int32_t, 7>> passage_of;  // of each block and side, and of gravity; -1: none

  CellSet burning_area, filtered, filtering, released;  // scratch of reactions with a surface
  std::vector<std::int32_t> book_of_burn;               // passage of each block and reaction

  double time = 0.0;  // s
  std::int64_t step = 0;
  Totals initial;
  double wave_rate = 0.0;       // 1/s, largest sum over the axes of (|u| + c)/h
  double motion_rate = 0.0;     // 1/s, largest |u|/h of one axis
  double diffusion_rate = 0.0;  // 1/s, largest sum over the axes of 2 (diffusivity)/h^2
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds{};  // of wall time, by phase, in this process
  std::int64_t flattened = 0;               // slopes that were taken back so that no cell loses more energy than it has
  bool any_first_order = false;             // of the cells in this step: with slopes it would leave them without volume or heat
  std::int64_t first_order_cell_steps = 0;  // cells of this process times steps
  Bodies bodies;                            // solids in the gas
  std::int64_t capped = 0;                  // cells times steps in which less has burned than the law wanted
  std::vector<OutsideRange> outside;        // of each fluid, in this process

  bool empty() const { return fluids.empty(); }
  int dimensions() const { return cells.dimensions; }
  std::size_t bytes() const;
  /// Where the faces of a pencil begin among those of all blocks.
  std::size_t first_face(std::size_t block, int axis, int pencil) const {
    const std::size_t pencils = dimensions() == 3 ? 8 : 1;
    return ((block * static_cast<std::size_t>(dimensions()) + static_cast<std::size_t>(axis)) * pencils +
            static_cast<std::size_t>(pencil)) *
           line_faces;
  }
  Lanes* swept_faces(std::size_t block, int axis, int pencil) { return swept.data() + first_face(block, axis, pencil); }
  int contents() const {
    return fluids.size() == 1 ? Content::of(dimensions(), 0, Content::mass) + 1 : Content::of(dimensions(), fluids.size(), 0);
  }
};

/// Allocates the cells and fills them with what is at their middles; makes the gas ready for its first step.
void fill(Gas& gas, const FillingFunction& filling, Domain& domain);
/// What fills a part of a cell's volume.
struct Portion {
  double part = 1.0;
  Filling filling;
};
/// The same with a mixture in each cell: masses, momenta and energies of its portions. Their parts add up to 1; of several
/// fluids each takes its part of the volume, and they come to one pressure.
using PortionsFunction = std::function<std::vector<Portion>(const Vector& middle)>;
void fill_in_portions(Gas& gas, const PortionsFunction& portions, Domain& domain);
/// Pressures and rates from the contents: after filling, and after a restart.
void begin(Gas& gas, Domain& domain);
/// The larger of two rates (1/s). What is no number counts as infinite: a state that is none must not pass for one without
/// waves.
inline double largest_rate(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}
/// The largest step (s) for a Courant number.
double largest_step(const Gas& gas, double courant);
enum class Outcome { done, rejected };
/// Advances by dt (s). What a cell would not bear is tried again with first order there; a step that is rejected changes
/// nothing. Throws StepFailure, nothing having changed.
Outcome advance(Gas& gas, double dt, Domain& domain);
Totals totals(const Gas& gas, Domain& domain);
/// What has come through each side of the box since the start, then by gravity, then by each body, and what bodies have
/// entrapped: mass, impulse, energy (its kinetic part stays 0).
std::vector<Totals> passed(const Gas& gas, Domain& domain);
/// What each reaction has made of each fluid since the start (negative: used up), and the heat that it has set free.
std::vector<Totals> burned(const Gas& gas, Domain& domain);

/// Everything that a checkpoint has to keep, and back. `restore` throws std::runtime_error if it is of another gas.
std::vector<double> numbers_of(const Gas& gas);
void restore(Gas& gas, const std::vector<double>& numbers, Domain& domain);

}  // namespace brisance::simulator::gas
