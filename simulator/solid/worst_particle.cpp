#include "simulator/solid/worst_particle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "simulator/domain/message.hpp"

namespace brisance::simulator {
namespace {

template <int D>
std::string facts_of(const Body& body, int p) {
  using L = Layout<D>;
  const Particles& ps = body.particles;
  const auto vector = [&](int first) {
    std::string text;
    for (int a = 0; a < D; ++a) text += fmt::format("{}{:.6g}", a ? ", " : "", ps.motion.at(first + a, p));
    return text;
  };
  const auto of = [&](int column) { return ps.rest.at(column, p); };
  const auto sigma = [&](int k) { return ps.load.at(L::Load::stress + k, p); };
  return fmt::format(
      "particle {} of {} at ({}) m with ({}) m/s: {}, temperature {:.5g} K, pressure {:.4g} Pa, density {:.6g} kg/m^3, plastic "
      "strain {:.4g}, plastic strain rate {:.4g} /s, shear modulus {:.4g} Pa, failure cause {:.0f}",
      ps.id[static_cast<std::size_t>(p)], body.name, vector(L::Motion::position), vector(L::Motion::velocity),
      body.material.name, of(L::Rest::temperature), -(sigma(0) + sigma(1) + sigma(2)) / 3.0, ps.load.at(L::Load::density, p),
      of(L::Rest::plastic_strain), of(L::Rest::plastic_strain_rate), of(L::Rest::shear_modulus), of(L::Rest::failure_cause));
}

bool is_finite(const ColumnSet& columns, int particle) {
  for (int k = 0; k < columns.columns(); ++k)
    if (!std::isfinite(columns.at(k, particle))) return false;
  return true;
}

}  // namespace

std::string facts(const Simulation& s, const Body& body, int particle) {
  return s.dimensions() == 3 ? facts_of<3>(body, particle) : facts_of<2>(body, particle);
}

std::string highest_rated(Domain& domain, const Remark& mine) {
  Message message;
  append(message, mine.rating), append(message, mine.id),
      append(message, std::vector<char>(mine.text.begin(), mine.text.end()));
  Remark highest;
  for (const Message& m : all_gather(domain, message)) {
    MessageReader reader(m);
    Remark remark{reader.read<double>(), reader.read<std::uint64_t>(), {}};
    const auto words = reader.read_list<char>();
    if (words.empty()) continue;
    remark.text.assign(words.begin(), words.end());
    if (highest.text.empty() || remark.rating > highest.rating || (remark.rating == highest.rating && remark.id < highest.id))
      highest = std::move(remark);
  }
  return highest.text;
}

std::string fastest_deforming(const Simulation& s) {
  // What pushes the grid with something that is not finite comes before those that have it from there.
  constexpr double infinity = std::numeric_limits<double>::infinity(), spoilt = infinity,
                   not_finite = std::numeric_limits<double>::max();
  const Body* body = nullptr;
  int particle = 0;
  Remark worst;
  double gradient = 0.0;
  for (const Body& b : s.bodies) {
    const Particles& ps = b.particles;
    for (int p = 0; p < ps.size; ++p) {
      double square = 0.0;
      for (int k = 0; k < ps.gradient.columns(); ++k) square += ps.gradient.at(k, p) * ps.gradient.at(k, p);
      const double rating = !is_finite(ps.motion, p) || !is_finite(ps.load, p) ? spoilt
                            : std::isfinite(square)                            ? std::sqrt(square)
                                                                               : not_finite;
      const std::uint64_t id = ps.id[static_cast<std::size_t>(p)];
      if (!body || rating > worst.rating || (rating == worst.rating && id < worst.id))
        body = &b, particle = p, worst.rating = rating, worst.id = id,
        gradient = std::isfinite(square) ? std::sqrt(square) : infinity;
    }
  }
  if (body) worst.text = fmt::format("|L| is {:.4g} /s at {}", gradient, facts(s, *body, particle));
  return highest_rated(*s.domain, worst);
}

}  // namespace brisance::simulator
