#pragma once
// Viscoelastic deviatoric stress, in the place of shear modulus, flow stress and yield. A law keeps its partial stresses in the
// history columns of the state:
//   initial_history(), rate(D', mean stress, history), advance(history, D', mean stress, dt), stored_energy(history)
// The stress is total(history); the caller rotates the history with the material.

#include <variant>

#include "models/viscoelastic/visco_scram.hpp"

namespace brisance {

using Viscoelastic = std::variant<viscoelastic::ViscoScram>;

}  // namespace brisance
