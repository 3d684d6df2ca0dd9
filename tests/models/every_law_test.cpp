// What every law of every list must hold to, whoever adds it: a complete table of parameters, one value on every kind of
// number, finite results, no jumps, the right direction, and thermodynamics. A law without a sample in sample_laws.hpp or
// sample_materials.hpp fails here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <set>
#include <span>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/material.hpp"
#include "tests/models/sample_materials.hpp"

namespace brisance {
namespace {

// The lanes have their own exp, log and pow, good to about one unit of round-off like those of the mathematics library; a
// formula strings some ten of them together, and a difference of near numbers inside it loses a few more digits.
constexpr double same_value = 1e-12;
// Where a formula of nested powers passes near a zero: round-off of its arguments, times its slopes.
constexpr double argument_round_off = 1e-14;
// A monotone formula may wobble by round-off.
constexpr double wobble = 1e-13;
// Part of a function's variation over a line that may still lie between two neighbouring numbers.
constexpr double largest_jump = 1e-9;

// The lists ------------------------------------------------------------------------------------------------------------

/// Calls f.template operator()<Law>() for every alternative.
template <class Variant, class F>
void for_each_alternative(const F& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f.template operator()<std::variant_alternative_t<I, Variant>>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// Calls f.template operator()<Variant>(folder, names that input files use).
template <class F>
void for_each_list(const F& f) {
  using Names = std::vector<std::string_view>;
  f.template operator()<FlowStress>(
      "flow_stress",
      Names{"johnson_cook", "mechanical_threshold_stress", "steinberg_cochran_guinan", "steinberg_cochran_guinan_lund",
            "zerilli_armstrong", "preston_tonks_wallace", "linear_hardening", "voce"});
  f.template operator()<ShearModulus>("shear_modulus", Names{"constant", "varshni_chen_gray", "steinberg_cochran_guinan",
                                                             "nadal_le_poac", "preston_tonks_wallace"});
  f.template operator()<Melting>(
      "melting", Names{"constant", "steinberg_cochran_guinan", "burakovsky_preston_silbar", "linear_in_pressure"});
  f.template operator()<SpecificHeat>("specific_heat", Names{"constant", "polynomial", "steel_lambda", "steel_goto", "copper"});
  f.template operator()<EquationOfState>(
      "equation_of_state", Names{"hypoelastic", "logarithmic", "hyperelastic", "mie_gruneisen_temperature",
                                 "mie_gruneisen_energy", "jones_wilkins_lee", "ideal_gas", "abel", "stiffened_gas", "murnaghan",
                                 "birch_murnaghan", "tillotson", "twu_sim_tassone"});
  f.template operator()<Yield>("yield", Names{"von_mises", "gurson_tvergaard_needleman"});
  f.template operator()<Porosity>("porosity", Names{"growth", "chu_needleman"});
  f.template operator()<InitialPorosity>("initial_porosity", Names{"constant", "gaussian", "weibull"});
  f.template operator()<Damage>("damage", Names{"johnson_cook", "hancock_mackenzie"});
  f.template operator()<Stability>("stability", Names{"drucker", "acoustic_tensor"});
  f.template operator()<Failure>(
      "failure", Names{"melting", "tepla_f", "critical_damage", "critical_porosity", "instability", "tensile_limit"});
  f.template operator()<Reaction>("reaction", Names{"pressure_power", "ward_son_brewster", "jwl_plus_plus", "program_burn"});
  f.template operator()<Viscoelastic>("viscoelastic", Names{"visco_scram"});
}

template <class Variant>
std::vector<Variant> samples_of();
template <>
std::vector<FlowStress> samples_of() {
  std::vector<FlowStress> laws;
  for (const auto& sample : samples::flow_stresses()) laws.push_back(sample.law);
  return laws;
}
template <>
std::vector<ShearModulus> samples_of() {
  return samples::shear_moduli();
}
template <>
std::vector<Melting> samples_of() {
  return samples::meltings();
}
template <>
std::vector<SpecificHeat> samples_of() {
  return samples::specific_heats();
}
template <>
std::vector<EquationOfState> samples_of() {
  return samples::equations_of_state();
}
template <>
std::vector<Yield> samples_of() {
  return samples::yields();
}
template <>
std::vector<Porosity> samples_of() {
  return samples::porosities();
}
template <>
std::vector<InitialPorosity> samples_of() {
  return samples::initial_porosities();
}
template <>
std::vector<Damage> samples_of() {
  return samples::damages();
}
template <>
std::vector<Stability> samples_of() {
  return samples::stabilities();
}
template <>
std::vector<Failure> samples_of() {
  return samples::failures();
}
template <>
std::vector<Reaction> samples_of() {
  return samples::reactions();
}
template <>
std::vector<Viscoelastic> samples_of() {
  return samples::viscoelastics();
}

/// Every law with its own table: the alternatives of the lists, and the two tables that are no alternatives.
template <class F>
void for_each_law_type(const F& f) {
  for_each_list([&]<class Variant>(const char* folder, const auto&) {
    for_each_alternative<Variant>([&]<class Law>() {
      SCOPED_TRACE(std::string(folder) + ' ' + std::string(Law::name));
      f.template operator()<Law>();
    });
  });
  f.template operator()<Heating>();
  f.template operator()<ArtificialViscosity>();
}

// Tables ---------------------------------------------------------------------------------------------------------------

/// Converts to any member of an aggregate.
struct Anything {
  template <class T>
  operator T() const;
};
template <class T, class... Members>
consteval std::size_t member_count() {
  if constexpr (requires { T{Members{}..., Anything{}}; })
    return member_count<T, Members..., Anything>();
  else
    return sizeof...(Members);
}

template <class Law>
std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for_each_parameter<Law>([&](const auto& row) { names.push_back(row.name); });
  return names;
}

template <class T>
std::vector<double> numbers_in(const T& value) {
  if constexpr (std::is_same_v<T, double>)
    return {value};
  else if constexpr (std::is_same_v<T, Table>)
    return {value.y.begin(), value.y.begin() + value.size};
  else if constexpr (requires { value.size(); })
    return {value.begin(), value.end()};
  else
    return {};
}

TEST(EveryLaw, HasASampleForTheTestsBelow) {
  for_each_list([]<class Variant>(const char* folder, const auto&) {
    std::set<std::size_t> sampled;
    for (const Variant& law : samples_of<Variant>()) sampled.insert(law.index());
    EXPECT_EQ(sampled.size(), std::variant_size_v<Variant>) << folder << ": an alternative has no sample parameters";
  });
}

TEST(EveryLaw, HasTheNameThatInputFilesUse) {
  for_each_list([]<class Variant>(const char* folder, const std::vector<std::string_view>& expected) {
    std::vector<std::string_view> names;
    for_each_alternative<Variant>([&]<class Law>() { names.push_back(Law::name); });
    EXPECT_EQ(names, expected) << folder;
    EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size()) << folder << ": a name occurs twice";
  });
}

TEST(EveryLaw, HasARowForEachOfItsMembers) {
  for_each_law_type([]<class Law>() {
    EXPECT_EQ(member_count<Law>(), std::tuple_size_v<decltype(Law::parameters)>);
    Law law{};
    std::set<const void*> members;
    for_each_parameter<Law>([&](const auto& row) { members.insert(&(law.*row.member)); });
    EXPECT_EQ(members.size(), std::tuple_size_v<decltype(Law::parameters)>) << "two rows of one member";
  });
}

TEST(EveryLaw, SaysWhatItIs) {
  for_each_law_type([]<class Law>() {
    EXPECT_FALSE(Law::name.empty());
    EXPECT_FALSE(Law::equation.empty());
    EXPECT_FALSE(Law::source.empty());
    for_each_parameter<Law>([](const auto& row) {
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_FALSE(row.unit.text.empty()) << row.name;
    });
  });
}

TEST(EveryLaw, HasParameterNamesThatAreUniqueAndFitForAnInputFile) {
  const std::set<std::string_view> taken{"law", "source", "sources"};  // keys of every component's table
  for_each_law_type([&]<class Law>() {
    const auto names = parameter_names<Law>();
    EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
    for (const std::string_view name : names) {
      EXPECT_FALSE(name.empty());
      EXPECT_FALSE(taken.contains(name)) << name;
      for (const char c : name) EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) || c == '_') << name;
    }
  });
}

TEST(EveryLaw, HasDefaultsThatItsIntervalsAllow) {
  for_each_law_type([]<class Law>() {
    for_each_parameter<Law>([](const auto& row) {
      if (!row.default_value) return;
      for (const double value : numbers_in(*row.default_value)) EXPECT_TRUE(row.interval.contains(value)) << row.name;
    });
  });
}

TEST(EveryLaw, HasIntervalsWithRoomForMoreThanOneValue) {
  for_each_law_type([]<class Law>() {
    for_each_parameter<Law>([](const auto& row) { EXPECT_LT(row.interval.lower, row.interval.upper) << row.name; });
  });
}

TEST(EveryLaw, HasSampleValuesThatItsIntervalsAllow) {
  for_each_list([]<class Variant>(const char* folder, const auto&) {
    for (const Variant& any_law : samples_of<Variant>())
      std::visit(
          [&]<class Law>(const Law& law) {
            for_each_parameter<Law>([&](const auto& row) {
              // The intrinsic part of a threshold stress may be absent, and with it the meaning of its exponents.
              for (const double value : numbers_in(law.*row.member))
                EXPECT_TRUE(row.interval.contains(value)) << folder << ' ' << Law::name << ' ' << row.name << " = " << value;
            });
          },
          any_law);
  });
}

// Values ---------------------------------------------------------------------------------------------------------------

/// An argument of a formula and where it may lie.
struct Range {
  double from, to;
  bool logarithmic = false;
  double at(double u) const {
    if (u <= 0.0) return from;
    if (u >= 1.0) return to;
    return logarithmic ? from * std::pow(to / from, u) : from + (to - from) * u;
  }
};

/// A formula of N numbers, with the ranges of its arguments.
template <int N, class F>
struct Formula {
  std::string name;
  std::array<Range, N> ranges;
  F value;                         // on an array of N Reals of any kind
  double jump = 0.0;               // a jump that the law declares
  bool for_any_arguments = false;  // finite for any finite arguments, not only within the ranges
};
template <std::size_t N, class F>
auto formula(std::string_view name, const std::array<Range, N>& ranges, const F& value, double jump = 0.0, bool any = false) {
  return Formula<static_cast<int>(N), F>{std::string(name), ranges, value, jump, any};
}

constexpr double round_rates[] = {1e-6, 1e9};

template <class Visitor>
void with_flow_stresses(const Visitor& visit) {
  for (const samples::Sample& sample : samples::flow_stresses())
    std::visit(
        [&](const auto& law) {
          const double melting = std::min(sample.melting_temperature, 2000.0);
          const std::array<Range, 7> ranges{Range{1e-8, 5.0, true},
                                            Range{round_rates[0], round_rates[1], true},
                                            Range{1.0, 0.999 * melting},
                                            Range{0.3 * sample.shear_modulus, 1.5 * sample.shear_modulus},
                                            Range{-5e9, 50e9},
                                            Range{0.9 * sample.density, 1.4 * sample.density},
                                            Range{0.0, 1e9}};
          visit(formula(
              law.name, ranges,
              [law, melting]<class Real>(const std::array<Real, 7>& x) {
                const flow_stress::Arguments<Real> at{x[0], x[1], x[2], Real(melting), x[3], x[4], x[5]};
                if constexpr (flow_stress::WithHistory<std::decay_t<decltype(law)>>)
                  return law(at, x[6]);
                else
                  return law(at);
              },
              0.0, true));
        },
        sample.law);
}

template <class Visitor>
void with_shear_moduli(const Visitor& visit) {
  for (const ShearModulus& any_law : samples::shear_moduli())
    std::visit(
        [&](const auto& law) {
          visit(formula(
              law.name, std::array{Range{0.0, 3000.0}, Range{-5e9, 50e9}, Range{0.8, 1.5}},
              [law]<class Real>(const std::array<Real, 3>& x) {
                return law(shear_modulus::Arguments<Real>{x[0], Real(1500.0), x[1], Real(8930.0), x[2]});
              },
              0.0, true));
        },
        any_law);
}

template <class Visitor>
void with_meltings(const Visitor& visit) {
  for (const Melting& any_law : samples::meltings())
    std::visit(
        [&](const auto& law) {
          visit(formula(
              law.name, std::array{Range{-50e9, 200e9}, Range{0.5, 2.0}},
              [law]<class Real>(const std::array<Real, 2>& x) {
                return law(melting::Arguments<Real>{x[0], x[1]});
              },
              0.0, true));
        },
        any_law);
}

template <class Visitor>
void with_specific_heats(const Visitor& visit) {
  for (const SpecificHeat& any_law : samples::specific_heats())
    std::visit(
        [&]<class Law>(const Law& law) {
          // Copper's two parts are fits of their own; the peak of iron is cut off at different heights from both sides.
          double jump = 0.0;
          if constexpr (std::is_same_v<Law, specific_heat::Copper>) jump = 1.1;
          if constexpr (std::is_same_v<Law, specific_heat::SteelLambda>) jump = 740.0;
          visit(formula(
              law.name, std::array{Range{0.0, 3000.0}}, [law]<class Real>(const std::array<Real, 1>& x) { return law(x[0]); },
              jump, true));
        },
        any_law);
}

/// Densities and temperatures where a law is used.
struct Domain {
  Range density, temperature;
};
template <class Law>
Domain domain(const Law& law) {
  const Range temperature{50.0, 5000.0};
  if constexpr (std::is_same_v<Law, equation_of_state::Tillotson>)
    return {{0.85 * law.reference_density, 2.0 * law.reference_density}, temperature};
  else if constexpr (std::is_same_v<Law, equation_of_state::JonesWilkinsLee>)
    return {{1e-3 * law.reference_density, 2.0 * law.reference_density, true}, temperature};
  else if constexpr (requires { law.reference_density; })
    return {{0.8 * law.reference_density, std::min(1.6 * law.reference_density, law.range().highest)}, temperature};
  else
    return {{0.01, std::min(law.range().highest, 1000.0), true}, temperature};
}

template <class Visitor>
void with_pressures(const Visitor& visit) {
  for (const EquationOfState& any_law : samples::equations_of_state())
    std::visit(
        [&](const auto& law) {
          const Domain d = domain(law);
          visit(formula(law.name, std::array{d.density, d.temperature}, [law]<class Real>(const std::array<Real, 2>& x) {
            return law.pressure(x[0], law.energy(x[0], x[1]));
          }));
        },
        any_law);
}

template <class Visitor>
void with_energies(const Visitor& visit) {
  for (const EquationOfState& any_law : samples::equations_of_state())
    std::visit(
        [&](const auto& law) {
          const Domain d = domain(law);
          visit(formula(law.name, std::array{d.density, d.temperature},
                        [law]<class Real>(const std::array<Real, 2>& x) { return law.energy(x[0], x[1]); }));
        },
        any_law);
}

template <class Visitor>
void with_yields(const Visitor& visit) {
  for (const Yield& any_law : samples::yields())
    std::visit(
        [&](const auto& law) {
          if constexpr (requires { law.effective_porosity(0.0); })
            visit(formula(
                law.name, std::array{Range{0.0, 2.0}, Range{-3.0, 3.0}, Range{0.0, 0.3}},
                [law]<class Real>(const std::array<Real, 3>& x) { return law(x[0], x[1], law.effective_porosity(x[2])); }));
        },
        any_law);
}

template <class Visitor>
void with_porosities(const Visitor& visit) {
  for (const Porosity& any_law : samples::porosities())
    std::visit(
        [&](const auto& law) {
          visit(formula(
              law.name, std::array{Range{0.0, 2.0}},
              [law]<class Real>(const std::array<Real, 1>& x) { return law.nucleated(x[0]); }, 0.0, true));
        },
        any_law);
}

template <class Visitor>
void with_damages(const Visitor& visit) {
  for (const Damage& any_law : samples::damages())
    std::visit(
        [&](const auto& law) {
          visit(formula(
              law.name, std::array{Range{-4.0, 4.0}, Range{1e-6, 1e9, true}, Range{0.0, 2500.0}},
              [law]<class Real>(const std::array<Real, 3>& x) {
                return law(damage::Arguments<Real>{x[0], x[1], x[2], Real(1793.0)});
              },
              0.0, true));
        },
        any_law);
}

template <class Visitor>
void with_stabilities(const Visitor& visit) {
  for (const Stability& any_law : samples::stabilities())
    std::visit(
        [&](const auto& law) {
          visit(formula(law.name,
                        std::array{Range{-1e9, 1e9}, Range{-1e9, 1e9}, Range{-1e9, 1e9}, Range{-1e9, 1e9}, Range{-1e9, 1e9},
                                   Range{-1.0, 1.0}, Range{-5e9, 5e9}},
                        [law]<class Real>(const std::array<Real, 7>& x) {
                          stability::Arguments<Real> at;
                          at.deviatoric_stress = {x[0], x[1], -x[0] - x[1], x[2], x[3], x[4]};
                          at.shear_modulus = Real(80e9), at.bulk_modulus = Real(160e9), at.yield_stress = Real(1e9);
                          at.normal_deviatoric =
                              1.5 / sqrt(1.5 * double_dot(at.deviatoric_stress, at.deviatoric_stress) + 1e-30);
                          at.normal_volumetric = x[5], at.plastic_modulus = x[6];
                          return law(at);
                        }));
        },
        any_law);
}

template <class Visitor>
void with_failures(const Visitor& visit) {
  for (const Failure& any_law : samples::failures())
    std::visit(
        [&]<class Law>(const Law& law) {
          // A point in compression is not judged at all: minus one.
          const double jump = std::is_same_v<Law, failure::Instability> ? 2.1 : 0.0;
          visit(formula(
              law.name,
              std::array{Range{100.0, 3000.0}, Range{0.0, 2.0}, Range{0.0, 1.0}, Range{0.0, 0.4}, Range{0.0, 1.0},
                         Range{-1.0, 1.0}, Range{-1e10, 1e10}},
              [law]<class Real>(const std::array<Real, 7>& x) {
                return law(failure::Arguments<Real>{x[0], Real(1793.0), x[1], x[2], x[3], x[4], x[5], x[6]});
              },
              jump));
        },
        any_law);
}

template <class Visitor>
void with_reactions(const Visitor& visit) {
  for (const Reaction& any_law : samples::reactions())
    std::visit(
        [&]<class Law>(const Law& law) {
          // Every one of them starts with a jump: at a threshold or at the arrival of the front.
          constexpr double starts = 1e300;
          visit(formula(
              law.name, std::array{Range{1e3, 40e9, true}, Range{290.0, 900.0}, Range{0.0, 1.0}, Range{0.0, 1e-5}},
              [law]<class Real>(const std::array<Real, 4>& x) {
                return law(reaction::Arguments<Real>{.pressure = x[0],
                                                     .temperature = x[1],
                                                     .density = Real(1840.0),
                                                     .burned_fraction = x[2],
                                                     .time = x[3],
                                                     .arrival_time = Real(5e-6),
                                                     .cell_size = Real(1e-3)});
              },
              starts));
        },
        any_law);
}

template <class Visitor>
void with_viscoelastic_stresses(const Visitor& visit) {
  for (const Viscoelastic& any_law : samples::viscoelastics())
    std::visit(
        [&](const auto& law) {
          visit(formula(law.name,
                        std::array{Range{1e-3, 1e6, true}, Range{-1e3, 1e3}, Range{-1e8, 1e7}, Range{1e-5, 1e-3, true}},
                        [law]<class Real>(const std::array<Real, 4>& x) {
                          using History = viscoelastic::ScramHistory<Real>;
                          History h;
                          h.crack_radius = x[3];
                          SymmetricTensor<Real> rate;
                          rate.xy = x[0], rate.xx = x[1], rate.yy = -x[1];
                          h = law.advance(h, rate, x[2], 1e-7);
                          return total(h).xy;
                        }));
        },
        any_law);
}

template <class Visitor>
void with_every_formula(const Visitor& visit) {
  with_flow_stresses(visit), with_shear_moduli(visit), with_meltings(visit), with_specific_heats(visit), with_pressures(visit);
  with_energies(visit), with_yields(visit), with_porosities(visit), with_damages(visit), with_stabilities(visit);
  with_failures(visit), with_reactions(visit), with_viscoelastic_stresses(visit);
}

template <std::size_t N>
std::array<double, N> random_arguments(const std::array<Range, N>& ranges, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<double, N> x;
  for (std::size_t j = 0; j < N; ++j) x[j] = ranges[j].at(unit(random));
  return x;
}

TEST(EveryLaw, HasOneValueOnDoublesLanesAndDuals) {
  with_every_formula([]<int N, class F>(const Formula<N, F>& law) {
    SCOPED_TRACE(law.name);
    std::mt19937_64 random(11);
    for (int i = 0; i < 50; ++i) {
      std::array<std::array<double, N>, Lanes::width> x;
      std::array<Lanes, N> lanes;
      for (int l = 0; l < Lanes::width; ++l) {
        x[l] = random_arguments(law.ranges, random);
        for (int j = 0; j < N; ++j) lanes[j].set(l, x[l][j]);
      }
      const Lanes on_lanes = law.value(lanes);
      for (int l = 0; l < Lanes::width; ++l) {
        const double exact = law.value(x[l]);
        std::array<Dual<double, N>, N> duals;
        for (int j = 0; j < N; ++j) duals[j] = Dual<double, N>::variable(x[l][j], j);
        const Dual<double, N> on_duals = law.value(duals);
        double tolerance = same_value * std::abs(exact);
        for (int j = 0; j < N; ++j) tolerance += argument_round_off * std::abs(on_duals.derivative[j] * x[l][j]);
        ASSERT_LE(std::abs(on_duals.value - exact), tolerance) << "on duals " << on_duals.value << ", on doubles " << exact;
        ASSERT_LE(std::abs(on_lanes[l] - exact), tolerance) << "on lanes " << on_lanes[l] << ", on doubles " << exact;
      }
    }
  });
}

TEST(EveryLaw, IsFiniteWithItsSlopesAtAllCornersOfItsRange) {
  with_every_formula([]<int N, class F>(const Formula<N, F>& law) {
    SCOPED_TRACE(law.name);
    for (int corner = 0; corner < (1 << N); ++corner) {
      std::array<Dual<double, N>, N> x;
      for (int j = 0; j < N; ++j)
        x[j] = Dual<double, N>::variable((corner >> j) & 1 ? law.ranges[j].to : law.ranges[j].from, j);
      const auto y = law.value(x);
      ASSERT_TRUE(std::isfinite(y.value)) << "corner " << corner;
      for (const double slope : y.derivative) ASSERT_TRUE(std::isfinite(slope)) << "corner " << corner;
    }
  });
}

TEST(EveryLaw, ThatPromisesItIsFiniteForAnyFiniteArguments) {
  const std::array any{-1e300, -1.0, -1e-300, 0.0, 1e-300, 1e-8, 1.0, 300.0, 1e12, 1e300};
  with_every_formula([&]<int N, class F>(const Formula<N, F>& law) {
    if (!law.for_any_arguments) return;
    SCOPED_TRACE(law.name);
    std::mt19937_64 random(13);
    for (int i = 0; i < 20'000; ++i) {
      std::array<double, N> x = random_arguments(law.ranges, random);
      for (int j = 0; j < N; ++j)
        if (random() % 2) x[j] = any[random() % any.size()];
      const double y = law.value(x);
      ASSERT_TRUE(std::isfinite(y) && y >= 0.0) << y << " at " << ::testing::PrintToString(x);
    }
  });
}

/// What a function of one number jumps by: halves the interval with the larger change until no number is left inside.
double jump_in(const std::function<double(double)>& f, double a, double b) {
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 2000; ++i) {
    const double middle = a + 0.5 * (b - a);
    if (!(a < middle && middle < b)) break;
    const double fm = f(middle);
    if (std::abs(fm - fa) >= std::abs(fb - fm))
      b = middle, fb = fm;
    else
      a = middle, fa = fm;
  }
  return std::abs(fb - fa);
}

TEST(EveryLaw, HasNoJumpsButThoseItDeclares) {
  constexpr int lines = 21, points = 200;
  with_every_formula([]<int N, class F>(const Formula<N, F>& law) {
    SCOPED_TRACE(law.name);
    std::mt19937_64 random(17);
    for (int line = 0; line < lines; ++line) {
      // Along one argument at a time, across the whole of its range, the others at random.
      auto x = random_arguments(law.ranges, random);
      const int j = line % N;
      const auto along = [&](double at) {
        x[j] = at;
        return law.value(x);
      };
      double lowest = 1e300, highest = -1e300, steepest = -1.0, from = 0.0, to = 0.0;
      for (int i = 0; i < points; ++i) {
        const double a = law.ranges[j].at(double(i) / points), b = law.ranges[j].at(double(i + 1) / points);
        const double fa = along(a), fb = along(b);
        lowest = std::min({lowest, fa, fb}), highest = std::max({highest, fa, fb});
        if (std::abs(fb - fa) > steepest) steepest = std::abs(fb - fa), from = a, to = b;
      }
      const double noise = largest_jump * (highest - lowest) + same_value * std::max(std::abs(highest), std::abs(lowest));
      ASSERT_LE(jump_in(along, from, to), law.jump + noise) << "argument " << j << " between " << from << " and " << to;
    }
  });
}

// Direction ------------------------------------------------------------------------------------------------------------

/// Checks that the value never falls (sign +1) or never rises (sign -1) as argument j runs through its range.
template <int N, class F>
void expect_monotone(const Formula<N, F>& law, int j, double sign) {
  std::mt19937_64 random(19);
  for (int line = 0; line < 40; ++line) {
    auto x = random_arguments(law.ranges, random);
    x[j] = law.ranges[j].from;
    double before = law.value(x), largest = std::abs(before);
    for (int i = 1; i <= 100; ++i) {
      x[j] = law.ranges[j].at(i / 100.0);
      const double now = law.value(x);
      largest = std::max(largest, std::abs(now));
      ASSERT_GE(sign * (now - before), -wobble * largest) << law.name << ", argument " << j << " = " << x[j];
      before = now;
    }
  }
}

TEST(EveryLaw, FlowStressNeverFallsWithTheRateNorWithStrainNorRisesWithTemperature) {
  with_flow_stresses([](const auto& law) {
    expect_monotone(law, 0, +1.0);
    expect_monotone(law, 1, +1.0);
    expect_monotone(law, 2, -1.0);
  });
}

TEST(EveryLaw, FlowStressOfAMeltIsZero) {
  for (const samples::Sample& sample : samples::flow_stresses())
    std::visit(
        [&](const auto& law) {
          if constexpr (requires { law.needs_melting_temperature; })
            for (const double above : {1.0, 1.0000001, 1.5, 1e3}) {
              const double melting = sample.melting_temperature;
              const flow_stress::Arguments<double> at{0.1, 1e3,           above * melting, melting, sample.shear_modulus,
                                                      0.0, sample.density};
              EXPECT_EQ(flow_stress::evaluate(law, at, 1e8, 0.01).flow_stress, 0.0) << law.name << " at " << above << " Tm";
            }
        },
        sample.law);
}

TEST(EveryLaw, ShearModulusNeverRisesWithTemperatureNorFallsWithPressure) {
  // Of a solid. The vibrations in Nadal and Le Poac's law, alone, rise with the temperature.
  with_shear_moduli([](auto law) {
    law.ranges[0].to = 1500.0;
    if (law.name != "nadal_le_poac") expect_monotone(law, 0, -1.0);
    expect_monotone(law, 1, +1.0);
  });
}

TEST(EveryLaw, PressureRisesWithDensityAndNeverFallsWithTemperature) {
  with_pressures([](const auto& law) {
    // Cold tensile and vaporising states of these two lose their stiffness; their own tests say where.
    if (law.name != "tillotson" && law.name != "twu_sim_tassone") expect_monotone(law, 0, +1.0);
    expect_monotone(law, 1, +1.0);
  });
}

TEST(EveryLaw, EnergyRisesWithTemperatureByAPositiveSpecificHeat) {
  with_energies([](const auto& law) { expect_monotone(law, 1, +1.0); });
}

TEST(EveryLaw, YieldFunctionRisesWithShearAndWithTheMagnitudeOfTheMeanStress) {
  with_yields([](auto law) {
    expect_monotone(law, 0, +1.0);
    law.ranges[1] = {0.0, 3.0};
    expect_monotone(law, 1, +1.0);
    law.ranges[1] = {-3.0, 0.0};
    expect_monotone(law, 1, -1.0);
  });
}

TEST(EveryLaw, NucleatedPorosityNeverFallsWithStrain) {
  with_porosities([](const auto& law) { expect_monotone(law, 0, +1.0); });
}

TEST(EveryLaw, FractureStrainNeverRisesWithTriaxiality) {
  with_damages([](const auto& law) { expect_monotone(law, 0, -1.0); });
}

TEST(EveryLaw, StabilityMarginRisesWithThePlasticModulus) {
  with_stabilities([](const auto& law) { expect_monotone(law, 6, +1.0); });
}

TEST(EveryLaw, FailureExcessRisesWithWhatTheCriterionLooksAtAndWithNothingElse) {
  with_failures([](const auto& law) {
    for (const int j : {0, 1, 2, 3, 4, 6}) expect_monotone(law, j, +1.0);
    expect_monotone(law, 5, -1.0);
  });
}

TEST(EveryLaw, BurnRateIsNotNegativeAndNeverFallsWithPressure) {
  with_reactions([](auto law) {
    expect_monotone(law, 0, +1.0);
    law.ranges[1] = {550.5, 560.0};  // just ignited, where the surface is far hotter than the solid
    expect_monotone(law, 0, +1.0);
    law.ranges[1] = {290.0, 900.0};
    std::mt19937_64 random(23);
    for (int i = 0; i < 1000; ++i) ASSERT_GE(law.value(random_arguments(law.ranges, random)), 0.0) << law.name;
  });
}

TEST(EveryLaw, InitialPorosityRisesWithTheUniformNumberWithinItsBounds) {
  for (const InitialPorosity& any_law : samples::initial_porosities())
    std::visit(
        [](const auto& law) {
          double before = 0.0;
          for (const double u : {1e-16, 1e-8, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999, 1.0 - 1e-8, 1.0 - 1e-16}) {
            const double f = law(u);
            EXPECT_GE(f, before) << law.name << ' ' << u;
            EXPECT_LT(f, 1.0) << law.name << ' ' << u;
            if constexpr (requires { law.upper; }) {
              EXPECT_LE(f, law.upper) << law.name << ' ' << u;
            }
            before = f;
          }
        },
        any_law);
}

// Thermodynamics -------------------------------------------------------------------------------------------------------

TEST(EveryLaw, EquationOfStateIsStiffEverywhere) {
  for (const EquationOfState& any_law : samples::equations_of_state())
    std::visit(
        [](const auto& law) {
          const Domain d = domain(law);
          std::mt19937_64 random(29);
          for (int i = 0; i < 1000; ++i) {
            const auto [rho, T] = random_arguments(std::array{d.density, d.temperature}, random);
            const double c2 = equation_of_state::sound_speed_squared(law, rho, law.energy(rho, T));
            ASSERT_TRUE(c2 > 0.0 && std::isfinite(c2)) << law.name << " at " << rho << ' ' << T;
          }
        },
        any_law);
}

/// Entropy exists: (de/drho)_T = (p - T (dp/dT)_rho)/rho^2, the relation of Maxwell for p and e of one potential. That the
/// thermal law of Zocher breaks it is what its documentation says; Tillotson gives no temperature, and the straight line
/// that stands for it has the slope of the isentrope alone.
TEST(EveryLaw, EquationOfStateHasAnEntropy) {
  constexpr double exact = 1e-11;    // derivatives are exact
  constexpr double no_pressure = 1;  // Pa; exponentially expanded states have less
  for (const EquationOfState& any_law : samples::equations_of_state())
    std::visit(
        [&]<class Law>(const Law& law) {
          if constexpr (Law::caloric != equation_of_state::Caloric::thermal &&
                        !std::is_same_v<Law, equation_of_state::Tillotson>) {
            const Domain d = domain(law);
            std::mt19937_64 random(31);
            for (int i = 0; i < 1000; ++i) {
              const auto [rho, T] = random_arguments(std::array{d.density, d.temperature}, random);
              using Number = Dual<double, 2>;
              const Number density = Number::variable(rho, 0), temperature = Number::variable(T, 1);
              const Number e = law.energy(density, temperature), p = law.pressure(density, e);
              const double left = e.derivative[0] * rho * rho, right = p.value - T * p.derivative[1];
              const double size = std::abs(p.value) + std::abs(T * p.derivative[1]) + no_pressure;
              ASSERT_LE(std::abs(left - right), exact * size) << Law::name << " at " << rho << ' ' << T;
            }
          }
        },
        any_law);
}

TEST(EveryLaw, EquationOfStateBringsBackTheTemperatureThatMadeItsEnergy) {
  constexpr double round_off = 1e-15;  // of the energy, of which the thermal part is a difference
  for (const EquationOfState& any_law : samples::equations_of_state())
    std::visit(
        [](const auto& law) {
          const Domain d = domain(law);
          std::mt19937_64 random(37);
          for (int i = 0; i < 300; ++i) {
            const auto [rho, T] = random_arguments(std::array{d.density, d.temperature}, random);
            const double e = law.energy(rho, T), cold = law.energy(rho, 0.0);
            const double cv = equation_of_state::specific_heat_at_constant_volume(law, rho);
            const double tolerance = round_off * (4.0 * T + (std::abs(e) + std::abs(cold)) / cv);
            ASSERT_NEAR(equation_of_state::temperature(law, rho, e), T, tolerance) << law.name;
          }
        },
        any_law);
}

// Parameters -----------------------------------------------------------------------------------------------------------

/// Every parameter in its turn at each closed end of its interval: the value stays finite. A number that the table admits
/// must not crash the formula.
template <class Variant, class Value>
void expect_finite_at_the_ends_of_intervals(const Value& value) {
  for (const Variant& any_law : samples_of<Variant>())
    std::visit(
        [&]<class Law>(const Law& sample) {
          for_each_parameter<Law>([&](const auto& row) {
            if constexpr (std::is_same_v<std::remove_reference_t<decltype(sample.*row.member)>, const double>)
              for (const bool upper : {false, true}) {
                const double end = upper ? row.interval.upper : row.interval.lower;
                if (!row.interval.contains(end)) continue;
                Law law = sample;
                law.*row.member = end;
                EXPECT_TRUE(std::isfinite(value(law))) << Law::name << ' ' << row.name << " = " << end;
              }
          });
        },
        any_law);
}

TEST(EveryLaw, IsFiniteAtTheEndsOfItsParametersIntervals) {
  expect_finite_at_the_ends_of_intervals<FlowStress>([](const auto& law) {
    const flow_stress::Arguments<double> at{0.1, 1e3, 600.0, 1500.0, 60e9, 1e9, 8000.0};
    return flow_stress::evaluate(law, at, 1e8, 0.01).flow_stress;
  });
  expect_finite_at_the_ends_of_intervals<ShearModulus>([](const auto& law) {
    return law(shear_modulus::Arguments<double>{600.0, 1500.0, 1e9, 8000.0, 1.02});
  });
  expect_finite_at_the_ends_of_intervals<Melting>([](const auto& law) { return law(melting::Arguments<double>{1e9, 1.02}); });
  expect_finite_at_the_ends_of_intervals<SpecificHeat>([](const auto& law) { return law(600.0); });
  expect_finite_at_the_ends_of_intervals<EquationOfState>([](const auto& law) {
    double rho = 2.0;
    if constexpr (requires { law.reference_density; }) rho = 1.02 * law.reference_density;
    const double e = law.energy(rho, 600.0);
    return e + law.pressure(rho, e) + equation_of_state::sound_speed_squared(law, rho, e);
  });
  expect_finite_at_the_ends_of_intervals<Damage>([](const auto& law) {
    return law(damage::Arguments<double>{0.4, 1e3, 600.0, 1500.0});
  });
  expect_finite_at_the_ends_of_intervals<Porosity>([](const auto& law) { return law.nucleated(0.2); });
  expect_finite_at_the_ends_of_intervals<InitialPorosity>([](const auto& law) { return law(0.4); });
  expect_finite_at_the_ends_of_intervals<Failure>([](const auto& law) {
    return law(failure::Arguments<double>{600.0, 1500.0});
  });
  expect_finite_at_the_ends_of_intervals<Yield>([](const auto& law) {
    if constexpr (requires { law.effective_porosity(0.0); })
      return law(0.5, 0.5, law.effective_porosity(0.1));
    else
      return 0.0;
  });
  expect_finite_at_the_ends_of_intervals<Reaction>([](const auto& law) {
    return law(reaction::Arguments<double>{1e9, 600.0, 1840.0, 0.2, 1e-5, 5e-6, 1e-3});
  });
  expect_finite_at_the_ends_of_intervals<Viscoelastic>([](const auto& law) {
    SymmetricTensor<double> rate;
    rate.xy = 1e3;
    return total(law.advance(law.initial_history(), rate, -1e6, 1e-7)).xy;
  });
}

}  // namespace
}  // namespace brisance
