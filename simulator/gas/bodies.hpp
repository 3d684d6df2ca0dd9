#pragma once
// Bodies with a prescribed motion in the gas, and rigid ones that the gas drives along an axis. They are made of particles; the
// contour of their smeared volume cuts the cells (cut_cells.hpp). With bodies the whole gas takes its steps unsplit
// (bodies_step.cpp).

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "simulator/gas/redistribution.hpp"
#include "simulator/ledger.hpp"
#include "simulator/step_failure.hpp"

namespace brisance::simulator::gas {

struct Gas;

/// What is empty is none.
struct BodyMotion {
  std::function<Vector(double time)> velocity;         // m/s
  std::function<Vector(double time)> rotation;         // rad/s, about the moving centre
  std::function<double(double time)> radial_velocity;  // m/s, of what is at `radius` from the centre at the start; every part
  double radius = 0.0;                                 // m      keeps its volume
};

struct MovingBody {
  std::string name;
  Vector centre{};             // at the start
  std::vector<Vector> places;  // of the particles at the start, from the centre
  std::vector<double> volumes;
  BodyMotion motion;
  double mass = 0.0;  // kg (per metre, per radian): driven by the gas along `axis`; 0: its motion is prescribed
  int axis = 0;

  struct State {
    Vector displacement{};
    std::array<Vector, 3> turn{Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0}, Vector{0.0, 0.0, 1.0}};  // rows of a rotation
    double growth = 0.0;                                                                              // m, of `radius`
    Vector velocity{}, acceleration{};  // m/s, m/s^2; of a driven body
  } state;
  Vector force{};                         // N, of the last step
  std::array<CompensatedSum, 3> impulse;  // N s, received from the gas since the start
  CompensatedSum work;                    // J
  double kinetic_energy() const { return 0.5 * mass * dot(state.velocity, state.velocity); }
};

/// Quantities in the cells of the window during a step.
struct StepFields {
  using Column = std::vector<double>;
  std::vector<Column> primitive, content;                 // as Primitive and Content; content per whole cell
  std::vector<Column> change;                             // of what the cells hold
  std::vector<Column> half;                               // as HalfStep
  std::array<Column, 3> flow, pressure;                   // at the low faces: volume per time, Pa
  Column volume;                                          // m^3, of the moved cell
  Column density, energy;                                 // kg/m^3, J/m^3 (internal), of the moved gas
  std::array<Column, 3> velocity;                         // m/s
  std::vector<Column> part, fluid_density, fluid_energy;  // of each of several fluids: of the volume, by its own volume
  std::array<std::vector<Column>, 3> passing;             // content through the low faces
  Column covered, mean;                                   // for the redistribution
  Column rubbing, heat;                                   // m/s, J: of the friction between rows; the heat of several fluids
  Column first_order;                                     // 1 where a cell does without slopes, if any do
};

/// Momentum and work that a body has received from the gas in a step.
struct Received {
  Vector impulse{};   // N s
  double work = 0.0;  // J, of the pressure on the wall
  double push = 0.0;  // N s, the impulses of all of its cells without their directions
};

/// A body is about to run into something, and the gas between has nowhere to go: what() says which body, into what, and when.
struct BodiesMeet : StepFailure {
  using StepFailure::StepFailure;
};

struct Bodies {
  std::vector<MovingBody> all;
  CellSet open;                           // the part of each cell's volume that is gas; what the cell holds is per whole cell
  std::vector<CompensatedSum> entrapped;  // masses, momentum, energy of the last gas of cells that had nowhere to go

  // Of pairs of bodies that are built into each other: the largest solid fraction of a node that they share, at the start.
  std::map<std::pair<int, int>, double> built_in;

  // As the rank sees them:
  Window window;
  std::vector<Part> windows;  // of all ranks
  BodyNodes nodes;
  OpenSpace space, next_space;
  CutCells step;
  Neighbourhoods small;
  StepFields fields;
  bool still = false;  // `step` is one in which nothing has moved
  // What the step under way would make of the bodies:
  std::vector<MovingBody::State> next;
  std::vector<Received> received;
  std::vector<double> entrapped_now;

  bool empty() const { return all.empty(); }
};

/// Points of a body in a state; with the velocities that take them there from another in a time dt (s), if it is not zero.
BodyPoints points_of(const MovingBody& body, Geometry geometry, const MovingBody::State& from, const MovingBody::State& to,
                     double dt);
/// Where a body will be after a step of dt (s). What the gas drives goes on as it was driven in the last step.
MovingBody::State moved(const MovingBody& body, double time, double dt);
/// The largest speed of a point, m/s.
double fastest(const Gas& gas);

/// Finds what the bodies leave open; before the gas is filled, and after a restart.
void place_bodies(Gas& gas, Domain& domain);

/// What the sides of the box do with bodies near them.
BoxImages images_of(const Gas& gas);
/// Notes the part of each own cell that is gas.
void keep_open_parts(Gas& gas);
/// Part of a cell that is gas.
double open_part(const Gas& gas, std::size_t block, int cell);

/// Finds where the bodies go in dt (s), and what that leaves open. False if a shorter step is needed: gas would change the side
/// of a thin wall. Throws BodiesMeet.
bool move_bodies(Gas& gas, double dt, Domain& domain);
/// The step of the gas around them; false if a cell does not bear it. Such cells are marked then, and those that `half_step`
/// calls of first order do without slopes, as in gas.cpp. Nothing of the state has changed in either case. Throws BodiesMeet.
bool try_step_with_bodies(Gas& gas, double dt, Domain& domain);
/// What has been found becomes the state of gas and bodies.
void settle_with_bodies(Gas& gas, double dt, Domain& domain);

/// Memory, with the particles.
std::size_t bytes_of(const Bodies& bodies);

/// What a checkpoint has to keep of them, and back.
std::vector<double> numbers_of(const Bodies& bodies);
void restore(Bodies& bodies, const double* numbers);

}  // namespace brisance::simulator::gas
