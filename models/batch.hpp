#pragma once
// 64 points of one material on their way through the update: 8 packs of 8 lanes, or 64 doubles.

#include <array>

#include "models/requests.hpp"
#include "models/state.hpp"

namespace brisance {

/// What went wrong with a point; kernels neither throw nor print, the caller reads this and raises one error.
enum class Trouble { none, increment_too_large, not_finite, yield_not_converged, compression_out_of_range };

/// One point (or one pack of points) within a step: its state, what drives it, and what the phases hand on to each other.
template <class Real>
struct Point {
  State<Real> state;

  // Given by the caller.
  Tensor<Real> velocity_gradient;  // 1/s, constant over the step, at mid-step
  Real cell_size{0.0};             // m, for the artificial viscosity; 0 switches it off
  Real heat{0.0};                  // J/kg, that comes from outside over the step

  // Kinematics.
  Tensor<Real> rotation;                   // of the step: what it has already done to the stress
  SymmetricTensor<Real> strain_increment;  // logarithmic, in the frame of the end of the step
  Real density_before{0.0};                // kg/m^3
  Real metal_density_before{0.0};          // kg/m^3, without the volume of the voids that plastic flow has opened
  Real metal_density{0.0};                 // kg/m^3, the same at the end of the step
  Real pressure_before{0.0};               // Pa

  // State functions at the start of the step, then results.
  Real melting_temperature{0.0};          // K; infinite when the material has no melting law
  Real bulk_modulus{0.0};                 // Pa, isentropic tangent
  Real trial_pressure{0.0};               // Pa
  Real artificial_viscosity_before{0.0};  // Pa
  Real artificial_viscosity{0.0};         // Pa, to be added to the pressure in forces; comes as it was
  SymmetricTensor<Real> deviator;         // Pa; before the step, then trial, then returned
  SymmetricTensor<Real> deviator_before;  // Pa
  Real flow_stress{0.0};                  // Pa, of the matrix
  Real plastic_strain_increment{0.0};     // -, of the matrix
  Real plastic_volume_increment{0.0};     // -
  Real plastic_work{0.0};                 // J/m^3
  Real released_heat{0.0};                // J/kg, elastic energy set free by melting
  Real warming{0.0};                      // K kg/J, temperature rise per plastic work: chi/cp
  Real pressure{0.0};                     // Pa
  Real stability_margin{1.0};             // -, <= 0 is unstable
  Real trouble{0.0};                      // Trouble as a number
};

template <class Real>
struct Batch {
  static constexpr int capacity = 64 / width_of<Real>;
  std::array<Point<Real>, capacity> points;
  int size = capacity;  // packs in use
  double time = 0.0;    // s, at the end of the step
  Requests ahead;       // of the caller, for what it reads after the update; sent on the way from point to point

  class Iterator {
   public:
    Iterator(Point<Real>* at, Requests& ahead) : at_(at), ahead_(ahead) {}
    Point<Real>& operator*() const { return *at_; }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }
    [[gnu::always_inline]] Iterator& operator++() {
      constexpr int lines = 5;  // an update passes each of its points some 15 times, and a point is some 43 lines of columns
      ++at_, ahead_.send(lines);
      return *this;
    }

   private:
    Point<Real>* at_;
    Requests& ahead_;
  };
  Iterator begin() { return {points.data(), ahead}; }
  Iterator end() { return {points.data() + size, ahead}; }
  const Point<Real>* begin() const { return points.data(); }
  const Point<Real>* end() const { return points.data() + size; }
};

}  // namespace brisance
