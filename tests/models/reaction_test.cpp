#include <gtest/gtest.h>

#include <cmath>

#include "models/reaction/reaction.hpp"

namespace brisance::reaction {
namespace {

const PressurePower strand{75.3, 0.778, 101325.0, 5e4, 450.0, 2e6};
// HMX; R as in the published fit.
const WardSonBrewster hmx{1.637e15, 1.76e5, 1.6e-3, 4e5, 3.018e6, 0.2, 0.07, 1400.0, 0.0342, 5e4, 550.0, 8.314};
const JwlPlusPlus anfo{3.5083e-7, 1.3, 1.0, 2e8, 5.558e6};
const ProgramBurn cylinder{8800.0, 1e-6, 3.0, 5.5e6, {0.0, 0.0, 0.01}};
constexpr double round_off = 1e-12;

TEST(PressurePower, BurnsByThePowerOfThePressure) {
  EXPECT_NEAR(strand(Arguments<double>{101325.0, 600.0, 1840.0}), 75.3, round_off * 75.3);
  EXPECT_NEAR(strand(Arguments<double>{1e7, 600.0, 1840.0}), 2681.3126167957594, round_off * 2681.0);  // separate arithmetic
}

TEST(PressurePower, NothingBurnsColdOrWithoutPressure) {
  EXPECT_EQ(strand(Arguments<double>{1e7, 450.0, 1840.0}), 0.0);
  EXPECT_EQ(strand(Arguments<double>{5e4, 600.0, 1840.0}), 0.0);
  EXPECT_EQ(strand(Arguments<double>{-1e9, 600.0, 1840.0}), 0.0);
  EXPECT_GT(strand(Arguments<double>{5.1e4, 451.0, 1840.0}), 0.0);
}

struct SteadyBurn {
  double solid_temperature, pressure, surface_temperature, rate;
};
// Bisection by a separate program, density 1832 kg/m^3.
const SteadyBurn steady_burns[] = {{298.0, 0.101325e6, 655.826, 0.62301}, {298.0, 1e6, 743.101, 3.96251},
                                   {298.0, 1e7, 862.924, 28.14165},       {298.0, 1e8, 1027.882, 203.5075},
                                   {450.0, 1e7, 877.036, 42.4624},        {600.0, 1e6, 886.335, 68.5449},
                                   {600.0, 1e7, 916.698, 95.6538},        {600.0, 1e8, 1057.013, 379.9456}};

TEST(WardSonBrewster, GivesTheSteadyBurnOfHmx) {
  constexpr double printed = 1e-5;  // digits of the reference
  WardSonBrewster always = hmx;
  always.ignition_temperature = 0.0;
  for (const SteadyBurn& s : steady_burns) {
    const Arguments<double> at{s.pressure, s.solid_temperature, 1832.0};
    EXPECT_NEAR(always.surface_temperature(at), s.surface_temperature, 0.6e-3);
    EXPECT_NEAR(always(at), s.rate, printed * s.rate);
  }
}

TEST(WardSonBrewster, ThePressureExponentIsThatOfHmx) {
  const auto exponent = [](double T, double p) {
    WardSonBrewster always = hmx;
    always.ignition_temperature = 0.0;
    const Dual<double> m = always(Arguments<Dual<double>>{Dual<double>::variable(p), T, 1832.0});
    return p * m.derivative[0] / m.value;
  };
  // Published with three decimals.
  EXPECT_NEAR(exponent(298.0, 0.101325e6), 0.763, 0.6e-3);
  EXPECT_NEAR(exponent(298.0, 1e6), 0.838, 0.6e-3);
  EXPECT_NEAR(exponent(298.0, 1e7), 0.859, 0.6e-3);
  EXPECT_NEAR(exponent(450.0, 1e7), 0.765, 0.6e-3);
  EXPECT_NEAR(exponent(600.0, 1e6), 0.014, 0.6e-3);
  EXPECT_NEAR(exponent(600.0, 1e8), 0.721, 0.6e-3);
}

TEST(WardSonBrewster, IgnitionNeedsHeatAndPressure) {
  EXPECT_EQ(hmx(Arguments<double>{1e7, 549.0, 1832.0}), 0.0);
  EXPECT_EQ(hmx(Arguments<double>{4e4, 600.0, 1832.0}), 0.0);
  EXPECT_GT(hmx(Arguments<double>{1e7, 551.0, 1832.0}), 0.0);
}

TEST(WardSonBrewster, SurfaceTemperatureHeatsBetweenItsTwoReactions) {
  for (double T : {300.0, 600.0, 900.0})
    for (double p : {0.0, 1.0, 1e5, 1e8, 1e11}) {
      const double Ts = hmx.surface_temperature(Arguments<double>{p, T, 1832.0});
      EXPECT_GE(Ts, T + 4e5 / 1400.0) << T << " " << p;
      EXPECT_LE(Ts, T + 3.418e6 / 1400.0) << T << " " << p;
    }
}

TEST(JwlPlusPlus, RateIsProportionalToWhatIsUnburned) {
  // Separate arithmetic: G p^1.3 (1 - F) at 5 GPa and F = 1/4.
  Arguments<double> at{5e9, 300.0, 1160.0, 0.25};
  EXPECT_NEAR(anfo(at), 1068609.405801219, round_off * 1.1e6);
  at.burned_fraction = 1.0;
  EXPECT_EQ(anfo(at), 0.0);
  at.burned_fraction = 0.25;
  at.pressure = 1.9e8;
  EXPECT_EQ(anfo(at), 0.0);
}

TEST(JwlPlusPlus, ReferencePressureOnlyNamesTheUnitOfTheRate) {
  JwlPlusPlus per_gigapascal = anfo;
  per_gigapascal.reference_pressure = 1e9;
  per_gigapascal.G = anfo.G * std::pow(1e9, 1.3);
  const Arguments<double> at{7e9, 300.0, 1160.0, 0.5};
  EXPECT_NEAR(per_gigapascal(at), anfo(at), round_off * anfo(at));
}

TEST(JwlPlusPlus, BurnsExponentiallyAtConstantPressure) {
  Arguments<double> at{5e9, 300.0, 1160.0};
  const double k = anfo(at), dt = 1e-4 / k;
  for (int i = 0; i < 20000; ++i) {  // midpoint rule up to k t = 2
    Arguments<double> middle = at;
    middle.burned_fraction += 0.5 * dt * anfo(at);
    at.burned_fraction += dt * anfo(middle);
  }
  EXPECT_NEAR(at.burned_fraction, 1.0 - std::exp(-2.0), 1e-8);  // midpoint rule: (k dt)^2/6
}

TEST(ProgramBurn, TheFrontTravelsAtTheDetonationVelocity) {
  EXPECT_DOUBLE_EQ(cylinder.arrival_time({0.0, 0.0, 0.01}), 1e-6);
  EXPECT_DOUBLE_EQ(cylinder.arrival_time({0.03, 0.04, 0.01}), 1e-6 + 0.05 / 8800.0);
}

TEST(ProgramBurn, TheFrontIsThreeCellsWide) {
  Arguments<double> at{0.0, 300.0, 1840.0};
  at.arrival_time = 2e-6;
  at.cell_size = 1e-3;
  const double duration = 3e-3 / 8800.0;
  at.time = 1.9e-6;
  EXPECT_EQ(cylinder(at), 0.0);
  EXPECT_EQ(cylinder.prescribed_fraction(at), 0.0);
  at.time = 2e-6 + 0.5 * duration;
  EXPECT_NEAR(cylinder(at), 1.0 / duration, round_off / duration);
  EXPECT_NEAR(cylinder.prescribed_fraction(at), 0.5, round_off);
  at.time = 2e-6 + 1.1 * duration;
  EXPECT_EQ(cylinder.prescribed_fraction(at), 1.0);
  at.burned_fraction = 1.0;
  EXPECT_EQ(cylinder(at), 0.0);
}

/// Rates of every law at states where it burns.
template <class F>
void for_each_law(const F& f) {
  const auto named = [&](const auto& law) {
    SCOPED_TRACE(law.name);
    f(law);
  };
  std::apply([&](const auto&... law) { (named(law), ...); }, std::tuple{strand, hmx, anfo, cylinder});
}
template <class Real>
Arguments<Real> burning(double pressure, double temperature) {
  return {.pressure = pressure,
          .temperature = temperature,
          .density = 1832.0,
          .burned_fraction = 0.3,
          .time = 3e-6,
          .arrival_time = 2.9e-6,
          .cell_size = 1e-3};
}

TEST(Reaction, TheExamplesCoverTheWholeList) {
  int laws = 0;
  for_each_law([&](const auto&) { ++laws; });
  EXPECT_EQ(laws, int(std::variant_size_v<Reaction>));
}

TEST(Reaction, DerivativesAreThoseOfCentralDifferences) {
  constexpr double truncation = 1e-7;  // of central differences with a relative step of 1e-5
  for_each_law([](const auto& law) {
    for (double p : {3e8, 2e9})
      for (double T : {560.0, 700.0}) {
        using Derived = Dual<double, 2>;
        auto at = burning<Derived>(p, T);
        at.pressure = Derived::variable(p, 0);
        at.temperature = Derived::variable(T, 1);
        const Derived rate = law(at);
        const auto value = [&](double pressure, double temperature) { return law(burning<double>(pressure, temperature)); };
        EXPECT_GT(rate.value, 0.0);
        EXPECT_NEAR(rate.derivative[0] * p, (value(p * 1.00001, T) - value(p * 0.99999, T)) / 2e-5, truncation * rate.value);
        EXPECT_NEAR(rate.derivative[1] * T, (value(p, T * 1.00001) - value(p, T * 0.99999)) / 2e-5, truncation * rate.value);
      }
  });
}

TEST(Reaction, LanesGiveWhatDoublesGive) {
  constexpr double library = 1e-11;  // exp and pow of the lanes against those of the C library, through the root of the surface
  for_each_law([](const auto& law) {
    auto at = burning<Lanes>(3e8, 560.0);
    for (int i = 0; i < Lanes::width; ++i) {
      at.pressure.set(i, 3e8 * (1 + i * i));
      at.temperature.set(i, 500.0 + 40.0 * i);
    }
    const Lanes rate = law(at);
    for (int i = 0; i < Lanes::width; ++i) {
      const double expected = law(burning<double>(at.pressure[i], at.temperature[i]));
      EXPECT_NEAR(rate[i], expected, library * expected);
      EXPECT_EQ(law(burning<Lanes>(at.pressure[i], at.temperature[i]))[0], rate[i]);  // neighbours have no say
    }
  });
}

TEST(Reaction, SurfaceLawsReleaseTheirHeat) {
  EXPECT_EQ(hmx.heat(), 3.418e6);
  EXPECT_EQ(strand.heat(), 2e6);
  EXPECT_EQ(PressurePower::kind, Kind::surface);
  EXPECT_EQ(WardSonBrewster::kind, Kind::surface);
  EXPECT_EQ(JwlPlusPlus::kind, Kind::bulk);
  EXPECT_EQ(ProgramBurn::kind, Kind::bulk);
}

}  // namespace
}  // namespace brisance::reaction
