#pragma once
// Failure criteria. A law gives an excess, a dimensionless number that is >= 0 when the point has failed, and the cause that
// goes into the record. What it cannot do without it says by needs_melting_temperature, needs_damage, needs_porosity,
// needs_stability. What happens to a failed point is not the criterion's business.

#include <variant>

#include "models/failure/critical_damage.hpp"
#include "models/failure/critical_porosity.hpp"
#include "models/failure/instability.hpp"
#include "models/failure/melting.hpp"
#include "models/failure/tensile_limit.hpp"
#include "models/failure/tepla_f.hpp"

namespace brisance {

using Failure = std::variant<failure::Melting, failure::TeplaF, failure::CriticalDamage, failure::CriticalPorosity,
                             failure::Instability, failure::TensileLimit>;

}  // namespace brisance
