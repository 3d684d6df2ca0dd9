#pragma once
// Exact solutions of the Euler equations and initial states of problems without one, for an ideal gas
// p = (gamma - 1) rho e. `dimension` is 1 for planes, 2 for cylinders, 3 for spheres.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "simulator/gas/gas_state.hpp"

namespace brisance::simulator::gas {

// Implosion and explosion --------------------------------------------------------------------------------------------

/// Cold gas of density 1 that falls towards the origin at velocity 1 from t = 0 on (Noh, J. Comput. Phys. 72, 1987). The gas
/// behind the shock is at rest.
struct Noh {
  double gamma = 5.0 / 3.0;
  int dimension = 1;

  double shock_radius(double t) const { return 0.5 * (gamma - 1.0) * t; }
  GasState at(double r, double t) const {
    const double compression = (gamma + 1.0) / (gamma - 1.0);
    if (r >= shock_radius(t)) return {std::pow(1.0 + t / r, dimension - 1), -1.0, 0.0};
    const double density = std::pow(compression, dimension);
    return {density, 0.0, 0.5 * (gamma - 1.0) * density};
  }
};

/// Point blast in a cold uniform gas at rest: Sedov, Similarity and Dimensional Methods in Mechanics (1959), as arranged by
/// Kamm and Timmes, LA-UR-07-2849 (2007), for uniform density; gamma other than 2 and below 7 in three dimensions, so that
/// pressure remains at the centre.
///
/// The energy is all of it: of both half-spaces per area, per length of a line, of a sphere.
class Sedov {
 public:
  Sedov(double gamma, int dimension, double energy, double density = 1.0)
      : gamma_(gamma), j_(dimension), energy_(energy), density_(density) {
    const double g = gamma_, j = j_;
    exponent2_ = -(g - 1.0) / (2.0 * (g - 1.0) + j);
    exponent1_ = (j + 2.0) * g / (2.0 + j * (g - 1.0)) * (2.0 * j * (2.0 - g) / (g * (j + 2.0) * (j + 2.0)) - exponent2_);
    exponent3_ = j / (2.0 * (g - 1.0) + j);
    exponent4_ = exponent1_ * (j + 2.0) / (2.0 - g);
    exponent5_ = -2.0 / (2.0 - g);
    alpha_ = energy_integral();
  }

  /// The radius is (E t^2/(alpha rho))^(1/(dimension + 2)).
  double alpha() const { return alpha_; }
  double shock_radius(double t) const { return std::pow(energy_ * t * t / (alpha_ * density_), 1.0 / (j_ + 2.0)); }
  double shock_speed(double t) const { return 2.0 / (j_ + 2.0) * shock_radius(t) / t; }

  GasState at(double r, double t) const {
    const double part = r / shock_radius(t), speed = shock_speed(t);
    if (part >= 1.0) return {density_, 0.0, 0.0};
    // The radius rises with the parameter from the centre (0) to the shock (1).
    double low = 0.0, high = 1.0;
    for (double middle = 0.5; middle > low && middle < high; middle = 0.5 * (low + high))
      (profile(middle).radius < part ? low : high) = middle;
    const Profile at_r = profile(high);
    return {density_ * at_r.density, speed * at_r.velocity, density_ * speed * speed * at_r.pressure};
  }

 private:
  /// Over shock radius, density ahead, shock speed and density times its square.
  struct Profile {
    double radius, density, velocity, pressure;
    double slope;  // of the radius by the parameter
  };

  /// Sedov's parameter V lies between that of the centre and that of the shock; the radius near the centre is a power of its
  /// distance from the former, which s takes out, so that everything is smooth in s.
  Profile profile(double s) const {
    const double g = gamma_, j = j_, power = -1.0 / exponent2_;
    const double centre = 2.0 / ((j + 2.0) * g), shock = 4.0 / ((j + 2.0) * (g + 1.0));
    const double step = (shock - centre) * std::pow(s, power), V = centre + step;
    const double b = (g + 1.0) / (g - 1.0), e = 0.5 * (2.0 + j * (g - 1.0));
    const double x1 = V / shock, x2 = b * 0.5 * (j + 2.0) * g * step;
    const double x3 = (j + 2.0) * (g + 1.0) / ((j + 2.0) * (g + 1.0) - 2.0 * (2.0 + j * (g - 1.0))) * (1.0 - e * V);
    const double x4 = b * (1.0 - 0.5 * (j + 2.0) * V);
    const double slow = std::pow(x1, -2.0 / (j + 2.0)) * std::pow(x3, -exponent1_);
    Profile p{};
    p.radius = slow * std::pow(x2, -exponent2_);
    // x2^(-exponent2) is s times a constant: the ratio stays finite at the centre.
    const double over_s = slow * std::pow(b * 0.5 * (j + 2.0) * g * (shock - centre), -exponent2_);
    p.slope = over_s * (1.0 + power * step * (-2.0 / ((j + 2.0) * V) + exponent1_ * e / (1.0 - e * V)));
    p.velocity = 2.0 / (g + 1.0) * x1 * p.radius;
    p.density = b * std::pow(x2, exponent3_) * std::pow(x3, exponent4_) * std::pow(x4, exponent5_);
    p.pressure = 2.0 / (g + 1.0) * std::pow(x1, 2.0 * j / (j + 2.0)) * std::pow(x3, exponent4_ - 2.0 * exponent1_) *
                 std::pow(x4, 1.0 + exponent5_);
    return p;
  }

  /// Of the blast of radius 1 at t = 1 into density 1, by Simpson's rule in s.
  double energy_integral() const {
    constexpr int intervals = 4000;
    const double speed2 = 4.0 / ((j_ + 2.0) * (j_ + 2.0));
    double sum = 0.0;
    for (int k = 0; k <= intervals; ++k) {
      const Profile p = profile(static_cast<double>(k) / intervals);
      const double energy = 0.5 * p.density * p.velocity * p.velocity + p.pressure / (gamma_ - 1.0);
      const double weight = k == 0 || k == intervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum += weight * energy * std::pow(p.radius, j_ - 1) * p.slope;
    }
    const double around = j_ == 1 ? 2.0 : j_ == 2 ? 2.0 * std::numbers::pi : 4.0 * std::numbers::pi;
    return around * speed2 * sum / (3.0 * intervals);
  }

  double gamma_;
  int j_;
  double energy_, density_;
  double exponent1_, exponent2_, exponent3_, exponent4_, exponent5_, alpha_;
};

// Gas and rigid bodies -----------------------------------------------------------------------------------------------

/// A projectile driven by gas from a chamber of endless length, until the barrel ends: the wave that runs back into the gas is
/// simple (Lagrange's problem). No pressure in front of it; per area of the bore.
struct GasDrivenProjectile {
  double gamma = 1.4;
  double pressure = 0.0, density = 0.0;  // of the gas at rest, Pa and kg/m^3
  double areal_mass = 0.0;               // of the projectile, kg/m^2

  double sound_speed() const { return std::sqrt(gamma * pressure / density); }
  double velocity(double t) const { return 2.0 * sound_speed() / (gamma - 1.0) * (1.0 - std::pow(1.0 + rate() * t, -decay())); }
  double distance(double t) const {
    const double risen = (std::pow(1.0 + rate() * t, 1.0 - decay()) - 1.0) / (rate() * (1.0 - decay()));
    return 2.0 * sound_speed() / (gamma - 1.0) * (t - risen);
  }
  /// Pressure on the base at a velocity.
  double base_pressure(double v) const {
    return pressure * std::pow(1.0 - 0.5 * (gamma - 1.0) * v / sound_speed(), 2.0 * gamma / (gamma - 1.0));
  }

 private:
  double rate() const { return 0.5 * (gamma + 1.0) * pressure / (sound_speed() * areal_mass); }
  double decay() const { return (gamma - 1.0) / (gamma + 1.0); }
};

/// A piston between two gas columns closed at their far ends, slow against the sound: each is compressed adiabatically and
/// uniformly. Per area.
struct GasSpring {
  double gamma = 1.4, pressure = 0.0;     // Pa, of both columns at rest
  double below = 0.0, above = 0.0;        // lengths of the columns, m; above 0: constant pressure
  double areal_mass = 0.0;                // of the piston, kg/m^2
  double position = 0.0, velocity = 0.0;  // of the piston, m from rest and m/s

  double pressure_below() const { return pressure * std::pow(below / (below + position), gamma); }
  double pressure_above() const { return above > 0.0 ? pressure * std::pow(above / (above - position), gamma) : pressure; }
  /// Energy in the piston and the columns (or of what pushes at constant pressure), J/m^2; constant.
  double energy() const {
    const double column = above > 0.0 ? pressure_above() * (above - position) / (gamma - 1.0) : pressure * position;
    return 0.5 * areal_mass * velocity * velocity + pressure_below() * (below + position) / (gamma - 1.0) + column;
  }
  /// Period of small oscillations.
  double small_period() const {
    const double stiffness = gamma * pressure * (1.0 / below + (above > 0.0 ? 1.0 / above : 0.0));
    return 2.0 * std::numbers::pi * std::sqrt(areal_mass / stiffness);
  }
  /// Motion over dt, in one step of Runge and Kutta's fourth-order rule.
  void advance(double dt) {
    const GasSpring start = *this;
    double moved = 0.0, sped = 0.0;
    for (const auto& [way, weight] : {std::pair{0.5, 1.0}, {0.5, 2.0}, {1.0, 2.0}, {0.0, 1.0}}) {
      const double v = velocity, a = (pressure_below() - pressure_above()) / areal_mass;
      moved += weight * v, sped += weight * a;
      position = start.position + way * dt * v, velocity = start.velocity + way * dt * a;
    }
    position = start.position + dt * moved / 6.0, velocity = start.velocity + dt * sped / 6.0;
  }
};

/// Mass flow through an opening of an area from a reservoir at rest into a pressure low enough, kg/s; `gas_constant` in J/kg/K.
inline double choked_mass_flow(double pressure, double temperature, double area, double gamma, double gas_constant) {
  return pressure * area * std::sqrt(gamma / (gas_constant * temperature)) *
         std::pow(2.0 / (gamma + 1.0), 0.5 * (gamma + 1.0) / (gamma - 1.0));
}

// Smooth flows -------------------------------------------------------------------------------------------------------

/// Density 1 + amplitude sin(2 pi (x - u t)) carried by the velocity u at a uniform pressure; period 1.
struct EntropyWave {
  double amplitude = 0.2, velocity = 1.0, pressure = 1.0;

  GasState at(double x, double t) const {
    return {1.0 + amplitude * std::sin(2.0 * std::numbers::pi * (x - velocity * t)), velocity, pressure};
  }
  GasState average(double from, double to, double t) const {
    constexpr double k = std::numbers::pi;
    const double middle = 0.5 * (from + to) - velocity * t, half = k * (to - from);
    return {1.0 + amplitude * std::sin(2.0 * k * middle) * std::sin(half) / half, velocity, pressure};
  }
};

/// A gas at a point of a plane.
struct PlaneGasState {
  double density, velocity_x, velocity_y, pressure;
};

/// Vortex of uniform entropy in a stream (Shu 1998, ICASE Report 97-65): temperature p/rho and density 1 far away. It moves
/// with the stream unchanged; at 5 from its centre what is left of it is 1e-5.
struct IsentropicVortex {
  double gamma = 1.4, strength = 5.0;
  double stream_x = 1.0, stream_y = 1.0;
  double centre_x = 0.0, centre_y = 0.0;  // at t = 0
  double period = 10.0;                   // of the plane along x and y

  PlaneGasState at(double x, double y, double t) const {
    const double dx = std::remainder(x - centre_x - stream_x * t, period),
                 dy = std::remainder(y - centre_y - stream_y * t, period);
    const double swirl = strength / (2.0 * std::numbers::pi) * std::exp(0.5 * (1.0 - dx * dx - dy * dy));  // 1/s
    const double temperature = 1.0 - 0.5 * (gamma - 1.0) / gamma * swirl * swirl;
    const double density = std::pow(temperature, 1.0 / (gamma - 1.0));
    return {density, stream_x - swirl * dy, stream_y + swirl * dx, density * temperature};
  }
};

/// Vortex at rest whose pressure balances the centrifugal force (Gresho and Chan, Int. J. Numer. Methods Fluids 11, 1990), of
/// density 1 and largest velocity 1, at radius 0.2; the pressure there gives the Mach number (Miczek, Roepke and Edelmann,
/// Astron. Astrophys. 576, 2015).
struct GreshoVortex {
  double gamma = 1.4, mach = 0.1;
  static constexpr double kinetic_energy = 2.0 * std::numbers::pi / 75.0;  // per length

  static double swirl(double r) { return r < 0.2 ? 5.0 * r : r < 0.4 ? 2.0 - 5.0 * r : 0.0; }
  double pressure(double r) const {
    const double centre = 1.0 / (gamma * mach * mach) - 0.5;
    if (r < 0.2) return centre + 12.5 * r * r;
    const double inside = std::min(r, 0.4);
    return centre + 12.5 * inside * inside + 4.0 * (1.0 - 5.0 * inside + std::log(5.0 * inside));
  }
  /// With the centre at the origin.
  PlaneGasState at(double x, double y) const {
    const double r = std::hypot(x, y), rotation = r > 0.0 ? swirl(r) / r : 5.0;
    return {1.0, -rotation * y, rotation * x, pressure(r)};
  }
};

// Initial states -----------------------------------------------------------------------------------------------------

/// Shock of Mach 3 into a wavy density, gamma 1.4, -5 < x < 5, t = 1.8 (Shu and Osher, J. Comput. Phys. 83, 1989).
inline GasState shu_osher_start(double x) {
  return x < -4.0 ? GasState{27.0 / 7.0, 4.0 * std::sqrt(35.0) / 9.0, 31.0 / 3.0}
                  : GasState{1.0 + 0.2 * std::sin(5.0 * x), 0.0, 1.0};
}

/// Two blast waves between walls, gamma 1.4, 0 < x < 1, t = 0.038 (Woodward and Colella, J. Comput. Phys. 54, 1984).
inline GasState woodward_colella_start(double x) {
  return {1.0, 0.0, x < 0.1 ? 1000.0 : x < 0.9 ? 0.01 : 100.0};
}

}  // namespace brisance::simulator::gas
