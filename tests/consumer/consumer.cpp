// The least a project of its own does with the library: a copper point in uniaxial compression, on its yield surface.
#include <cmath>
#include <cstdio>

#include "models/update.hpp"

int main() {
  using namespace brisance;
  Material copper;
  copper.name = "copper", copper.density = 8930.0;
  copper.equation_of_state = equation_of_state::MieGruneisenTemperature{8930.0, 3940.0, 1.489, 2.02, 383.0, 294.0};
  copper.shear_modulus = shear_modulus::Constant{47.7e9};
  copper.flow_stress = flow_stress::LinearHardening{90e6, 0.0};
  copper.yield = yield::VonMises{};
  Batch<double> point;
  point.size = 1;
  point.points[0].state = initial_state(copper, 294.0);
  point.points[0].velocity_gradient.xx = -1e3;
  for (int i = 0; i < 100; ++i) update(copper, point, 1e-7);
  const double q = equivalent_stress(deviator(point.points[0].state.stress));
  std::printf("q = %.6g Pa\n", q);
  return std::abs(q - 90e6) < 1.0 ? 0 : 1;
}
