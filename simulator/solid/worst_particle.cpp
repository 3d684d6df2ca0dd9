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

/// A candidate for the worst particle, as the ranks tell each other.
struct Candidate {
  bool spoilt = false;  // what it pushes the grid with is not finite: the others have it from there
  double norm = -1.0;   // |L|, 1/s; infinite where it is not a number
  std::size_t body = 0;
  std::uint64_t id = 0;
  bool worse_than(const Candidate& b) const {
    if (spoilt != b.spoilt) return spoilt;
    if (norm != b.norm) return norm > b.norm;
    return body != b.body ? body < b.body : id < b.id;
  }
};

bool is_finite(const ColumnSet& columns, int particle) {
  for (int k = 0; k < columns.columns(); ++k)
    if (!std::isfinite(columns.at(k, particle))) return false;
  return true;
}

}  // namespace

std::string facts(const Simulation& s, const Body& body, int particle) {
  return s.dimensions() == 3 ? facts_of<3>(body, particle) : facts_of<2>(body, particle);
}

std::string fastest_deforming(const Simulation& s) {
  Candidate worst;
  int particle = -1;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const Particles& ps = s.bodies[b].particles;
    for (int p = 0; p < ps.size; ++p) {
      double square = 0.0;
      for (int k = 0; k < ps.gradient.columns(); ++k) square += ps.gradient.at(k, p) * ps.gradient.at(k, p);
      const double norm = std::isfinite(square) ? std::sqrt(square) : std::numeric_limits<double>::infinity();
      const Candidate candidate{!is_finite(ps.motion, p) || !is_finite(ps.load, p), norm, b,
                                ps.id[static_cast<std::size_t>(p)]};
      if (particle < 0 || candidate.worse_than(worst)) worst = candidate, particle = p;
    }
  }
  const std::string mine = particle < 0 ? "" : facts(s, s.bodies[worst.body], particle);
  Message message;
  append(message, worst), append(message, std::vector<char>(mine.begin(), mine.end()));
  Candidate of_all;
  std::string text;
  for (const Message& m : all_gather(*s.domain, message)) {
    MessageReader reader(m);
    const auto candidate = reader.read<Candidate>();
    const auto words = reader.read_list<char>();
    if (!candidate.worse_than(of_all)) continue;
    of_all = candidate;
    text = fmt::format("|L| is {:.4g} /s at {}", candidate.norm, std::string(words.begin(), words.end()));
  }
  return text;
}

}  // namespace brisance::simulator
