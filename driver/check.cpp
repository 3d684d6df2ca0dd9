#include "driver/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "driver/commands.hpp"
#include "driver/point.hpp"
#include "models/equation_of_state/thermodynamics.hpp"
#include "models/input/material_folders.hpp"
#include "models/input/material_reader.hpp"
#include "models/update.hpp"
#include "models/visit.hpp"

namespace brisance::driver {
namespace {

constexpr double room_temperature = 298.0;  // K
constexpr std::array plastic_strains{0.0, 0.01, 0.1, 0.3, 1.0};
constexpr std::array strain_rates{1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6};  // 1/s
constexpr std::array melting_fractions{0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};

/// The findings of one file.
struct Report {
  std::vector<Finding> findings;
  void add(Verdict verdict, std::string subject, std::string text) {
    findings.push_back({verdict, std::move(subject), std::move(text)});
  }
  /// `fine` or else the verdict with its reason.
  void require(bool fine, Verdict otherwise, const std::string& subject, const std::string& good, const std::string& bad) {
    add(fine ? Verdict::ok : otherwise, subject, fine ? good : bad);
  }
};

double melting_temperature(const Material& m) {
  double result = 1e30;
  visit_law(m.melting, [&](const auto& law) { result = law(melting::Arguments<double>{}); });
  return result;
}

/// At no pressure; zero for a material without shear modulus.
double shear_modulus_at(const Material& m, double temperature) {
  double result = 0.0;
  visit_law(m.shear_modulus, [&](const auto& law) {
    result = law(shear_modulus::Arguments<double>{temperature, melting_temperature(m), 0.0, m.density, 1.0});
  });
  return result;
}

void check_sources(const MaterialFile& file, Report& report) {
  const Material& m = file.material;
  std::vector<std::string> missing;
  const auto need = [&](bool present, const std::string& key) {
    const auto covers = [&](const auto& entry) { return entry.first == key && !entry.second.empty(); };
    if (present && std::none_of(file.sources.begin(), file.sources.end(), covers)) missing.push_back(key);
  };
  need(true, "density");
  need(true, "equation_of_state");
  need(m.bulk_modulus.has_value(), "bulk_modulus");
  need(m.thermal_conductivity.has_value(), "thermal_conductivity");
  need(m.shear_modulus.has_value(), "shear_modulus");
  need(m.melting.has_value(), "melting");
  need(m.specific_heat.has_value(), "specific_heat");
  need(m.flow_stress.has_value(), "flow_stress");
  need(m.yield.has_value(), "yield");
  need(m.viscoelastic.has_value(), "viscoelastic");
  need(m.porosity.has_value(), "porosity");
  need(m.damage.has_value(), "damage");
  need(m.heating.has_value(), "heating");
  need(m.reaction.has_value(), "reaction");
  report.require(missing.empty(), Verdict::error, "sources", "every table has one",
                 fmt::format("missing for {}", fmt::join(missing, ", ")));
}

void check_flow_stress(const Material& m, Report& report) {
  const double Tm = melting_temperature(m);
  visit_law(m.flow_stress, [&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    const auto Y = [&](double strain, double rate, double temperature) {
      flow_stress::Arguments<double> at{
          strain, rate, temperature, Tm, shear_modulus_at(m, std::min(temperature, 0.999 * Tm)), 0.0, m.density};
      // A history is grown from nothing, in steps.
      constexpr int steps = 200;
      double history = 0.0;
      if constexpr (flow_stress::WithHistory<Law>)
        for (int i = 0; i < steps; ++i) history = flow_stress::advance_history(law, at, history, strain / steps);
      return flow_stress::evaluate(law, at, history, 0.0).flow_stress;
    };
    bool finite = true, rate_hardens = true, heat_softens = true;
    double lowest = 1e300, highest = 0.0;
    for (const double strain : plastic_strains)
      for (std::size_t k = 0; k < melting_fractions.size(); ++k) {
        const double T = melting_fractions[k] * std::min(Tm, 3000.0);
        double slower = 0.0;
        for (const double rate : strain_rates) {
          const double y = Y(strain, rate, T);
          finite = finite && std::isfinite(y) && y >= 0.0;
          rate_hardens = rate_hardens && y >= slower * (1.0 - 1e-12);
          if (k > 0)
            heat_softens = heat_softens && y <= Y(strain, rate, melting_fractions[k - 1] * std::min(Tm, 3000.0)) * (1.0 + 1e-9);
          slower = y;
          lowest = std::min(lowest, y);
          highest = std::max(highest, y);
        }
      }
    report.require(finite, Verdict::error, "flow_stress",
                   fmt::format("{}: finite and >= 0: {:.4g} to {:.4g} MPa", Law::name, lowest * 1e-6, highest * 1e-6),
                   fmt::format("{}: not finite, or negative", Law::name));
    report.require(rate_hardens, Verdict::error, "flow_stress", "does not fall with the strain rate",
                   "falls with the strain rate");
    report.require(heat_softens, Verdict::warning, "flow_stress", "does not rise with temperature",
                   "rises with temperature somewhere below melting");
    if (m.melting)
      if constexpr (requires { Law::needs_melting_temperature; })
        report.require(Y(0.1, 1e3, Tm) == 0.0, Verdict::error, "flow_stress", fmt::format("zero at melting, {:.4g} K", Tm),
                       fmt::format("{:.4g} MPa at melting, {:.4g} K", Y(0.1, 1e3, Tm) * 1e-6, Tm));
    const double ambient = Y(0.0, 1.0, room_temperature);
    const double G = shear_modulus_at(m, room_temperature);
    report.require(
        ambient < 0.1 * G, Verdict::warning, "flow_stress", fmt::format("initial {:.4g} MPa at 1/s and 298 K", ambient * 1e-6),
        fmt::format("initial {:.4g} MPa at 1/s and 298 K is more than a tenth of the shear modulus", ambient * 1e-6));
  });
}

void check_shear_modulus(const Material& m, Report& report) {
  if (!m.shear_modulus) return;
  const double Tm = melting_temperature(m);
  bool positive = true, falls = true;
  double before = 1e300;
  for (const double fraction : melting_fractions) {
    const double G = shear_modulus_at(m, fraction * std::min(Tm, 3000.0));
    positive = positive && G > 0.0 && std::isfinite(G);
    falls = falls && G <= before * (1.0 + 1e-9);
    before = G;
  }
  report.require(positive, m.melting ? Verdict::error : Verdict::warning, "shear_modulus",
                 fmt::format("positive below melting: {:.4g} GPa at 298 K", shear_modulus_at(m, room_temperature) * 1e-9),
                 "not positive everywhere below melting");
  report.require(falls, Verdict::warning, "shear_modulus", "does not rise with temperature", "rises with temperature");
  if (m.melting)
    report.require(initial_state(m, 1.0001 * Tm).shear_modulus == 0.0, Verdict::error, "shear_modulus", "zero above melting",
                   "not zero above melting");
}

void check_equation_of_state(const Material& m, Report& report) {
  using namespace equation_of_state;
  const double e = energy(m.equation_of_state, m.density, room_temperature);
  const double c2 = sound_speed_squared(m.equation_of_state, m.density, e);
  const double K = m.density * c2;
  report.require(std::isfinite(K) && K > 0.0, Verdict::error, "equation_of_state",
                 fmt::format("rho c^2 = {:.4g} GPa, c = {:.5g} m/s", K * 1e-9, std::sqrt(c2)), "rho c^2 is not positive");
  if (m.bulk_modulus)
    report.require(
        std::abs(K / *m.bulk_modulus - 1.0) <= 0.1, Verdict::warning, "equation_of_state",
        fmt::format("rho c^2 is {:+.1f} % from the measured bulk modulus, {:.4g} GPa", 100.0 * (K / *m.bulk_modulus - 1.0),
                    *m.bulk_modulus * 1e-9),
        fmt::format("rho c^2 is {:+.1f} % from the measured bulk modulus, {:.4g} GPa: waves and yield in uniaxial strain "
                    "will not agree",
                    100.0 * (K / *m.bulk_modulus - 1.0), *m.bulk_modulus * 1e-9));
  if (m.shear_modulus) {
    const double G = shear_modulus_at(m, room_temperature);
    const double nu = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
    report.require(nu > 0.0 && nu < 0.5, Verdict::warning, "elasticity", fmt::format("Poisson's ratio {:.3f}", nu),
                   fmt::format("Poisson's ratio {:.3f} is outside 0 to 1/2", nu));
    if (caloric(m.equation_of_state) != Caloric::complete) {
      const double rho = density_at(m.equation_of_state, 0.0, room_temperature);
      report.require(std::abs(rho / m.density - 1.0) < 0.01, Verdict::warning, "equation_of_state",
                     fmt::format("free of pressure at {:.5g} kg/m^3 and 298 K", rho),
                     fmt::format("free of pressure at {:.5g} kg/m^3 and 298 K, but the density is {:.5g}", rho, m.density));
    }
  }
}

void check_specific_heat(const Material& m, Report& report) {
  const double top = std::min(melting_temperature(m), 3000.0);
  visit_law(m.specific_heat, [&](const auto& law) {
    double lowest = 1e300, highest = 0.0;
    for (double T = 50.0; T <= top; T += 5.0) {
      const double cp = law(T);
      lowest = std::min(lowest, std::isfinite(cp) ? cp : -1.0);
      highest = std::max(highest, cp);
    }
    report.require(
        lowest > 0.0, Verdict::error, "specific_heat",
        fmt::format("{:.4g} J/(kg K) at 298 K, {:.4g} to {:.4g} below melting", law(room_temperature), lowest, highest),
        "not positive everywhere below melting");
  });
}

/// Reversible compression warms what expands when it is heated.
void check_heating(const Material& m, Report& report) {
  using namespace equation_of_state;
  const Caloric kind = caloric(m.equation_of_state);
  if (!m.heating || (kind != Caloric::thermal && kind != Caloric::energy)) return;
  constexpr double compression = 0.05;
  const double e = energy(m.equation_of_state, m.density, room_temperature);
  const double gruneisen = gruneisen_coefficient(m.equation_of_state, m.density, e);
  const double rise = room_temperature * std::expm1(gruneisen * compression);
  report.require(
      m.heating->thermoelastic, Verdict::warning, "heating",
      fmt::format("5 % of compression warms it by {:.0f} K, from 298 K and without plastic work", rise),
      fmt::format("thermoelastic = false: compression does not warm it, by {:.0f} K for 5 % from 298 K; right only where "
                  "pressures stay below a GPa or so, or the source left it out",
                  rise));
}

void check_melting(const Material& m, Report& report) {
  if (!m.melting) return;
  const double Tm = melting_temperature(m);
  report.require(std::isfinite(Tm) && Tm > room_temperature && Tm < 5000.0, Verdict::error, "melting",
                 fmt::format("{:.5g} K at ambient pressure", Tm), fmt::format("{:.5g} K at ambient pressure", Tm));
  visit_law(m.melting, [&](const auto& law) {
    double before = 0.0;
    bool rises = true;
    for (const double compression : {1.0, 1.05, 1.1, 1.2, 1.3}) {
      double pressure = 0.0;
      visit_law(m.equation_of_state, [&](const auto& eos) {
        const double rho = compression * m.density;
        pressure = eos.pressure(rho, eos.energy(rho, room_temperature));
      });
      const double T = law(melting::Arguments<double>{pressure, compression});
      rises = rises && std::isfinite(T) && T >= before;
      before = T;
    }
    report.require(rises, Verdict::warning, "melting", "does not fall with pressure", "falls with pressure");
  });
}

void check_damage(const Material& m, Report& report) {
  const double Tm = melting_temperature(m);
  visit_law(m.damage, [&](const auto& law) {
    double lowest = 1e300, at_lowest = 0.0;
    for (double triaxiality = -1.0 / 3.0; triaxiality <= 3.0; triaxiality += 1.0 / 30.0)
      for (const double rate : strain_rates) {
        const double strain = law(damage::Arguments<double>{triaxiality, rate, room_temperature, Tm});
        if (!(strain >= lowest)) lowest = strain, at_lowest = triaxiality;
      }
    report.require(lowest > 0.0 && std::isfinite(lowest), Verdict::error, "damage",
                   fmt::format("fracture strain > 0 for triaxialities -1/3 to 3; least {:.4g} at {:.2f}", lowest, at_lowest),
                   fmt::format("fracture strain {:.4g} at a triaxiality of {:.2f}", lowest, at_lowest));
  });
}

void check_yield(const Material& m, Report& report) {
  visit_law(m.yield, [&](const auto& surface) {
    if constexpr (requires { surface.ultimate_porosity(); }) {
      const double fu = surface.ultimate_porosity();
      const double f = surface.coalescence_porosity + (fu - surface.coalescence_porosity) / surface.coalescence_slope;
      report.require(surface.q3 <= surface.q1 * surface.q1 * (1.0 + 1e-12) && fu > surface.coalescence_porosity, Verdict::error,
                     "yield", fmt::format("no strength is left at a porosity of {:.4g}", f),
                     "q3 exceeds q1^2, or coalescence begins after all strength is lost");
    }
  });
}

/// One elastic and one plastic step, as a simulation would take them.
void check_update(const Material& m, Report& report) {
  if (!m.shear_modulus && !m.viscoelastic) return;
  PointUpdate update(m);
  State<double> state = initial_state(m, room_temperature);
  Tensor<double> L;
  L.xx = -1e4;
  bool fine = true;
  double c = 0.0;
  for (int step = 0; step < 50 && fine; ++step) {
    const Point<double>& point = update(state, L, 1e-7, 1e-7 * (step + 1));
    fine = trouble_of(point) == Trouble::none;
    c = longitudinal_sound_speed(point);
    fine = fine && std::isfinite(c) && c > 0.0;
    state = point.state;
  }
  report.require(fine, Verdict::error, "update",
                 fmt::format("5 % of uniaxial compression at 1e4 /s ends at {:.4g} GPa", -state.stress.xx * 1e-9),
                 "5 % of uniaxial compression at 1e4 /s fails: " + facts(state, 0.0));
}

}  // namespace

std::vector<Finding> check_material(const std::filesystem::path& path) {
  const MaterialFile file = read_material_file(path);
  Report report;
  report.add(Verdict::ok, "file", file.material.name);
  check_sources(file, report);
  check_equation_of_state(file.material, report);
  check_shear_modulus(file.material, report);
  check_melting(file.material, report);
  check_specific_heat(file.material, report);
  check_heating(file.material, report);
  check_flow_stress(file.material, report);
  check_yield(file.material, report);
  check_damage(file.material, report);
  check_update(file.material, report);
  return report.findings;
}

int run_check(const std::vector<std::filesystem::path>& given) {
  // A name means what it means in a case file.
  std::vector<std::filesystem::path> files = given.empty() ? bundled_materials() : given;
  for (std::filesystem::path& file : files) file = find_material(file, "").value_or(file);
  constexpr std::array<std::string_view, 3> words{"ok", "warning", "ERROR"};
  std::array<int, 3> counts{};
  bool readable = true;
  const auto findings_of = [&](const std::filesystem::path& file) -> std::vector<Finding> {
    try {
      return check_material(file);
    } catch (const InputError& error) {
      readable = false;
      return {{Verdict::error, "file", error.what()}};
    }
  };
  for (const std::filesystem::path& file : files) {
    fmt::print("{}\n", file.filename().string());
    for (const Finding& finding : findings_of(file)) {
      ++counts[static_cast<std::size_t>(finding.verdict)];
      fmt::print("  {:8} {:18} {}\n", words[static_cast<std::size_t>(finding.verdict)], finding.subject, finding.text);
    }
  }
  fmt::print("\n{} files: {} ok, {} warnings, {} errors\n", files.size(), counts[0], counts[1], counts[2]);
  if (!readable) return bad_input;
  return counts[2] == 0 ? done : failed_while_running;
}

}  // namespace brisance::driver
