#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::reaction {

/// What a burn rate may depend on. A law reads only what its formula names.
template <class Real>
struct Arguments {
  Real pressure;              // Pa, of the gas at a burning surface, of the mixture in a bulk burn
  Real temperature;           // K, of the solid
  Real density;               // kg/m^3, of the solid
  Real burned_fraction{0.0};  // by mass
  Real time{0.0};             // s
  Real arrival_time{0.0};     // s, when the detonation front reaches this place
  Real cell_size{0.0};        // m
};

/// What the value of a law means.
enum class Kind {
  surface,  // kg/(m^2 s), mass burned per burning area and time
  bulk      // 1/s, rate of the burned mass fraction
};

}  // namespace brisance::reaction
