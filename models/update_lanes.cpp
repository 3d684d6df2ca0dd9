#include "models/phases.hpp"
#include "models/update.hpp"

namespace brisance {

// Apart from update.cpp only so that both compile at the same time.
template <>
void update(const Material& material, Batch<Lanes>& points, double dt) {
  phases::advance(material, points, dt);
}

}  // namespace brisance
