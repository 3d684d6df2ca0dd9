#include "simulator/solid/internal_energy.hpp"

#include <vector>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/visit.hpp"
#include "simulator/domain/message.hpp"
#include "simulator/parallel.hpp"
#include "simulator/solid/packs.hpp"
#include "simulator/table.hpp"

namespace brisance::simulator {
namespace {

/// Heat (J/kg) between two temperatures (K), at a density (kg/m^3) where the equation of state has to tell.
double heat_between(const Material& material, double density, double from, double to) {
  if (!is_present(material.specific_heat)) {
    const EquationOfState& law = material.equation_of_state;
    return equation_of_state::energy(law, density, to) - equation_of_state::energy(law, density, from);
  }
  // Gauss and Legendre's rule of three points: exact for polynomials of fifth degree.
  constexpr double node = 0.774596669241483377, outer = 5.0 / 18.0, inner = 8.0 / 18.0;
  const double middle = 0.5 * (from + to), reach = 0.5 * (to - from) * node;
  double mean = 0.0;
  visit_law(material.specific_heat,
            [&](const auto& law) { mean = outer * (law(middle - reach) + law(middle + reach)) + inner * law(middle); });
  return mean * (to - from);
}

/// Part of the plastic work that has become heat: the mean of Taylor and Quinney's coefficient over the strain, which is exact
/// where it is constant.
double heated_part(const Material& material, double plastic_strain) {
  double part = 0.0;
  visit_law(material.heating, [&](const Heating& heating) {
    const Table& chi = heating.taylor_quinney;
    part = chi.size > 1 && plastic_strain > 0.0 ? integral(chi, plastic_strain) / plastic_strain : chi(plastic_strain);
  });
  return part;
}

template <int D>
InternalEnergy of_bin(const Body& body, const Bin& bin) {
  using L = Layout<D>;
  InternalEnergy sum;
  for (std::uint32_t i = bin.begin; i < bin.end; ++i) {
    const int p = static_cast<int>(body.bins.order[i]);
    const double *load = body.particles.load.particle(p), *rest = body.particles.rest.particle(p);
    const auto of = [&](int column) { return rest[column * chunk_size]; };
    const double m = load[L::Load::mass * chunk_size], V = m / load[L::Load::density * chunk_size],
                 mu = of(L::Rest::shear_modulus);
    const auto sigma = [&](int k) { return load[(L::Load::stress + k) * chunk_size]; };
    const SymmetricTensor<double> stress{
        sigma(0), sigma(1), sigma(2), D == 3 ? sigma(3) : 0.0, D == 3 ? sigma(4) : 0.0, D == 3 ? sigma(5) : sigma(3)};
    const SymmetricTensor<double> dev = deviator(stress);
    const double density = load[L::Load::density * chunk_size], work = m * of(L::Rest::plastic_work);
    sum += {m * of(L::Rest::energy),
            m * (of(L::Rest::energy) - body.initial_energy),
            m * of(L::Rest::stress_work),
            m * of(L::Rest::viscous_work),
            work,
            work > 0.0 ? heated_part(body.material, of(L::Rest::plastic_strain)) * work : 0.0,
            body.stress ? 0.0 : m * heat_between(body.material, density, body.initial_temperature, of(L::Rest::temperature)),
            mu > 0.0 ? V * double_dot(dev, dev) / (4.0 * mu) : 0.0,
            m};
  }
  return sum;
}

}  // namespace

InternalEnergy internal_energy(const Simulation& s, const Body& body) {
  const std::vector<Bin>& bins = body.bins.bins;
  std::vector<InternalEnergy> parts(bins.size());
  parallel_for_blocks(bins.size(), [&](std::size_t b) {
    parts[b] = s.dimensions() == 3 ? of_bin<3>(body, bins[b]) : of_bin<2>(body, bins[b]);
  });
  Message mine;
  append(mine, parts.data(), parts.size());
  InternalEnergy sum;
  for (const Message& list : all_gather(*s.domain, mine))
    for (MessageReader reader(list); !reader.at_end();) sum += reader.read<InternalEnergy>();
  return sum;
}

InternalEnergy internal_energy(const Simulation& s) {
  InternalEnergy sum;
  for (const Body& body : s.bodies) sum += internal_energy(s, body);
  return sum;
}

}  // namespace brisance::simulator
