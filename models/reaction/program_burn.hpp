#pragma once

#include <cmath>

#include "models/reaction/arguments.hpp"

namespace brisance::reaction {

struct ProgramBurn {
  static constexpr std::string_view name = "program_burn";
  static constexpr std::string_view equation =
      "F = clamp(D (t - ta)/(k h), 0, 1) with the arrival time ta = t0 + (distance from the initiation point)/D and cells of "
      "size h; dF/dt = D/(k h) from ta on while F < 1";
  static constexpr std::string_view source = "Wilkins, Computer Simulation of Dynamic Phenomena (Springer 1999), chapter 4";
  static constexpr Kind kind = Kind::bulk;

  double detonation_velocity, start_time, cells_in_front, heat_of_reaction;
  std::array<double, 3> initiation_point;

  static constexpr auto parameters =
      std::tuple{Parameter{"detonation_velocity", &ProgramBurn::detonation_velocity, Unit::m_per_s, "D", positive},
                 Parameter{"initiation_point", &ProgramBurn::initiation_point, Unit::m, "where the detonation starts"},
                 Parameter{"start_time", &ProgramBurn::start_time, Unit::s, "t0, when the detonation starts", any_value, 0.0},
                 Parameter{"cells_in_front", &ProgramBurn::cells_in_front, Unit::one, "k, width of the front in cells",
                           at_least(1.0), 3.0},
                 Parameter{"heat_of_reaction", &ProgramBurn::heat_of_reaction, Unit::J_per_kg,
                           "Q = E0/rho0, heat set free per burned mass", non_negative}};

  double heat() const { return heat_of_reaction; }

  /// When the front reaches a place, s. Straight rays: the explosive has no obstacle between it and the initiation point.
  double arrival_time(const std::array<double, 3>& place) const {
    const double distance =
        std::hypot(place[0] - initiation_point[0], place[1] - initiation_point[1], place[2] - initiation_point[2]);
    return start_time + distance / detonation_velocity;
  }

  /// F that the program prescribes, whatever happened before.
  template <class Real>
  Real prescribed_fraction(const Arguments<Real>& at) const {
    return clamp(Real(detonation_velocity * (at.time - at.arrival_time) / (cells_in_front * at.cell_size)), 0.0, 1.0);
  }

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Real rate = detonation_velocity / (cells_in_front * at.cell_size);
    const Real unfinished = select(at.burned_fraction < 1.0, rate, Real(0.0));
    return select(at.time > at.arrival_time, unfinished, Real(0.0));
  }
};

}  // namespace brisance::reaction
