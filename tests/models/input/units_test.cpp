#include "models/input/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace brisance {
namespace {

// Values are rounded once, so texts whose factor is a power of ten give the very number that would be written in SI.
TEST(Units, AreConvertedWithoutRoundOffWhereTheFactorIsAPowerOfTen) {
  EXPECT_EQ(to_si("7.83 g/cm^3", Unit::kg_per_m3), 7830.0);
  EXPECT_EQ(to_si("25.4 mm", Unit::m), 0.0254);
  EXPECT_EQ(to_si("77 GPa", Unit::Pa), 77e9);
  EXPECT_EQ(to_si("0.1 MPa", Unit::Pa), 1e5);
  EXPECT_EQ(to_si("4.35 cm", Unit::m), 0.0435);
  EXPECT_EQ(to_si("1e-3 s^-1", Unit::per_s), 1e-3);
  EXPECT_EQ(to_si("3.3e+2 us", Unit::s), 3.3e-4);
  EXPECT_EQ(to_si("1.5 Mbar", Unit::Pa), 1.5e11);
  EXPECT_EQ(to_si("21.98 1/TPa", Unit::per_Pa), 21.98e-12);
  EXPECT_EQ(to_si("1.67 erg/(g K)", Unit::J_per_kg_K), 1.67e-4);
  EXPECT_EQ(to_si("90 %", Unit::one), 0.9);
  EXPECT_EQ(to_si("50 MPa m^0.5", Unit::Pa_sqrt_m), 50e6);
  EXPECT_EQ(to_si("0 K", Unit::K), 0.0);
}

TEST(Units, WithOtherFactorsAreRoundedToTheNearestNumber) {
  EXPECT_EQ(to_si("1 in", Unit::m), 0.0254);
  EXPECT_EQ(to_si("3 ft", Unit::m), 0.9144);
  EXPECT_EQ(to_si("60 min", Unit::s), 3600.0);
  EXPECT_EQ(to_si("1 atm", Unit::Pa), 101325.0);
  EXPECT_EQ(to_si("1 eV", Unit::J), 1.602176634e-19);  // exact since 2019; udunits has the value of 1986
  constexpr double pascals_per_psi = 4.4482216152605 / (0.0254 * 0.0254), one_ulp = 2.3e-16;
  EXPECT_NEAR(to_si("1 psi", Unit::Pa) / pascals_per_psi, 1.0, one_ulp * 2.0);
}

TEST(Units, OfTemperatureMayHaveTheirOwnZero) {
  EXPECT_EQ(to_si("25 degC", Unit::K), 298.15);
  EXPECT_EQ(to_si("-273.15 degC", Unit::K), 0.0);
  EXPECT_NEAR(to_si("32 degF", Unit::K), 273.15, 1e-12);  // the factor 5/9 is no decimal
  EXPECT_THROW(to_si("1 J/(kg degC)", Unit::J_per_kg_K), UnitError);
  EXPECT_THROW(to_si("1 degC^-1", Unit::per_K), UnitError);
}

TEST(Units, ReadTheSameInEveryCustomaryNotation) {
  for (const char* text : {"477 J/(kg K)", "477 J/kg/K", "477 J kg^-1 K^-1", "477 J*kg**-1*K**-1", "477 J kg-1 K-1",
                           "477 J.kg^-1.K^-1", "477J/(kg K)", "+477 J/(kg K)", "  477  J/(kg\tK) ",
                           "477 J\u00B7kg^-1\u00B7K^-1", "477 m\u00B2/(s\u00B2 K)", "0.477 kJ/(kg K)", "4770000 erg/(g K)"})
    EXPECT_EQ(to_si(text, Unit::J_per_kg_K), 477.0) << text;
  for (const char* text : {"2 1/s", "2 /s", "2 s^-1", "2 Hz"}) EXPECT_EQ(to_si(text, Unit::per_s), 2.0) << text;
  for (const char* text : {"3 MPa m^0.5", "3 MPa m^(1/2)", "3 MPa sqrt(m)", "3 MN m^-1.5", "3 MPa \u221A(m)"})
    EXPECT_EQ(to_si(text, Unit::Pa_sqrt_m), 3e6) << text;
  EXPECT_EQ(to_si("7 \u00B5m", Unit::m), 7e-6);
  EXPECT_EQ(to_si("7 \u03BCs", Unit::s), 7e-6);
  EXPECT_EQ(to_si("20 \u00B0C", Unit::K), 293.15);
}

TEST(Units, EachOfTheProgramMeasuresItself) {
  for (const Unit unit : {Unit::Pa,        Unit::K,          Unit::kg_per_m3,   Unit::m,          Unit::s,
                          Unit::per_s,     Unit::per_K,      Unit::per_Pa,      Unit::K_per_Pa,   Unit::m_per_s,
                          Unit::J_per_kg,  Unit::J_per_kg_K, Unit::m3_per_kg,   Unit::Pa_s,       Unit::Pa_per_K,
                          Unit::J,         Unit::kg,         Unit::Pa_sqrt_m,   Unit::W_per_m_K,  Unit::J_per_m3,
                          Unit::J_per_mol, Unit::m2,         Unit::kg_per_m2_s, Unit::kg_per_mol, Unit::J_per_mol_K}) {
    EXPECT_EQ(to_si("1.7 " + std::string(unit.text), unit), 1.7) << unit.text;
    EXPECT_THROW(to_si("1.7 cd", unit), UnitError) << unit.text;
    // The reciprocal measures something else, although udunits converts it.
    EXPECT_THROW(to_si("1.7 1/(" + std::string(unit.text) + ')', unit), UnitError) << unit.text;
    // What messages give as an example is accepted.
    const std::string allowed = allowed_texts(unit);
    const auto begin = allowed.find('"') + 1;
    EXPECT_NO_THROW(to_si(allowed.substr(begin, allowed.rfind('"') - begin), unit)) << allowed;
  }
}

TEST(Units, AreRefusedWhenTheyAreNotExactlyOneNumberAndOneUnit) {
  for (const char* text : {"",
                           " ",
                           "MPa",
                           "7830",
                           "-",
                           "+-1 MPa",
                           "1e MPa",
                           "e5 MPa",
                           ". MPa",
                           "1..0 MPa",
                           "1,5 MPa",
                           "1 2 MPa",
                           "1 MPa 2",
                           "1 MPa MPa",
                           "1 MPa;",
                           "1 (MPa",
                           "1 MPa)",
                           "1 MPa^",
                           "1 MPa^x",
                           "1 MPa^1e9",
                           "1 MPa^nan",
                           "1 MPa^(1/0)",
                           "1 MPa/",
                           "1 MPa**",
                           "1 *MPa",
                           "nan MPa",
                           "inf MPa",
                           "0x1 MPa",
                           "1e999 MPa",
                           "1e308 MPa",
                           "1e-999999999999 MPa",
                           "1 per s",
                           "1 Pa since 1970-01-01",
                           "1 lg(re 1 Pa)",
                           "1 Pa @ 3",
                           "1 MPA",
                           "1 mmPa",
                           "1 \xFF",
                           "1 Pa\n",
                           "1 ((((((((Pa"})
    EXPECT_THROW(to_si(text, Unit::Pa), UnitError) << text;
  EXPECT_THROW(to_si(std::string("1 Pa\0", 5), Unit::Pa), UnitError);
  EXPECT_THROW(to_si("1 " + std::string(100'000, '('), Unit::Pa), UnitError);
  EXPECT_THROW(to_si(std::string(100'000, '1') + " Pa", Unit::Pa), UnitError);
}

std::string message(const std::string& text, Unit unit) {
  try {
    to_si(text, unit);
  } catch (const UnitError& error) {
    return error.what() + error.hint;
  }
  return "accepted";
}

TEST(Units, RefusedSayWhatTheyMeasureAndWhatIsAllowed) {
  EXPECT_EQ(message("4.5e-12 s", Unit::per_s),
            "\"4.5e-12 s\" is not a rate: \"s\" measures a time; give a number in 1/s or a text such as \"1000 1/s\"");
  EXPECT_EQ(message("792 MPA", Unit::Pa),
            "\"792 MPA\" is not a pressure: unknown unit \"MPA\"; give a number in Pa or a text such as \"792 MPa\"; did you "
            "mean \"MPa\"?");
  EXPECT_TRUE(message("0.4 mn", Unit::m).ends_with("did you mean \"mm\"?")) << message("0.4 mn", Unit::m);
}

TEST(Conversion, AppliesToManyNumbersOfOneColumn) {
  const UnitConversion from_gigapascal("GPa", Unit::Pa);
  EXPECT_EQ(from_gigapascal("0.024895"), 24895000.0);
  EXPECT_EQ(from_gigapascal(" 27.103 "), 27103000000.0);
  EXPECT_THROW(from_gigapascal("27.1 GPa"), UnitError);
  EXPECT_THROW(from_gigapascal(""), UnitError);
  EXPECT_EQ(UnitConversion("1", Unit::one)("0.5"), 0.5);
  EXPECT_EQ(UnitConversion("%", Unit::one)("50"), 0.5);
}

TEST(NumberWithUnit, IsToldFromAFormulaByHowItIsWritten) {
  for (const char* text : {"1.2 kg/m^3", "-3e5 Pa", ".5m", "20 µs", "1e5", " 7 K ", "1 MPaa", ""})
    EXPECT_TRUE(is_number_with_unit(text)) << text;
  for (const char* text : {"(1 + t/r)^2", "-x/r", "1 + t", "2*x", "1e-6*(1 + t)", "r", "sqrt(2)"})
    EXPECT_FALSE(is_number_with_unit(text)) << text;
}

TEST(Interval, IsDescribedInWords) {
  EXPECT_EQ(describe(positive), "> 0");
  EXPECT_EQ(describe(non_negative), ">= 0");
  EXPECT_EQ(describe(negative), "< 0");
  EXPECT_EQ(describe(fraction), "between 0 and 1");
  EXPECT_EQ(describe(Interval{0.0, 10.0, true}), "> 0 and <= 10");
  EXPECT_EQ(describe(any_value), "any finite number");
}

}  // namespace
}  // namespace brisance
