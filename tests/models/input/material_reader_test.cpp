#include "models/input/material_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "models/input/material_folders.hpp"
#include "tests/scratch.hpp"

namespace brisance {
namespace {

const std::string steel = R"toml(
name = "steel"
notes = "a note"
density = "7.83 g/cm^3"
density_source = "a scale"
thermal_conductivity = "38 W/(m K)"
[equation_of_state]
law = "mie_gruneisen_temperature"
source = "book"
sources = {slope = "paper"}
sound_speed = "4578 m/s"
slope = 1.33
gruneisen = 1.67
specific_heat = "477 J/(kg K)"
reference_temperature = "25 degC"
[flow_stress]
law = "johnson_cook"
source = "s"
A = "792 MPa"
B = "510 MPa"
n = 0.26
C = 0.014
m = 1.03
reference_strain_rate = "1 1/s"
reference_temperature = 298
[shear_modulus]
law = "constant"
source = "s"
value = "77 GPa"
[melting]
law = "constant"
source = "s"
value = 1793
[specific_heat]
law = "constant"
source = "s"
value = 477
[yield]
law = "von_mises"
source = "s"
[[failure]]
law = "melting"
source = "s"
[heating]
source = "s"
taylor_quinney = {plastic_strain = [0, "10 %"], value = [0.6, 0.9]}
)toml";

MaterialFile read(const std::string& text) {
  InputFile input = InputFile::from_text(text, "steel.toml");
  TableReader top = input.top();
  MaterialFile file = read_material(top);
  input.finish();
  return file;
}

TEST(MaterialFile, GivesEveryComponentItsLawAndItsValuesInSI) {
  const MaterialFile file = read(steel);
  const Material& m = file.material;
  EXPECT_EQ(m.name, "steel");
  EXPECT_EQ(m.density, 7830.0);
  EXPECT_EQ(m.thermal_conductivity, 38.0);
  EXPECT_EQ(m.bulk_modulus, std::nullopt);
  EXPECT_EQ(m.objective_rate, ObjectiveRate::incremental_rotation);
  const auto& eos = std::get<equation_of_state::MieGruneisenTemperature>(m.equation_of_state);
  EXPECT_EQ(eos.sound_speed, 4578.0);
  EXPECT_EQ(eos.reference_temperature, 298.15);
  const auto& flow = std::get<flow_stress::JohnsonCook>(m.flow_stress.value());
  EXPECT_EQ(flow.A, 792e6);
  EXPECT_EQ(flow.n, 0.26);
  EXPECT_EQ(flow.reference_strain_rate, 1.0);
  ASSERT_EQ(m.failure.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<failure::Melting>(m.failure[0]));
  EXPECT_TRUE(m.stability.empty());
  EXPECT_FALSE(m.damage);
  const Table& chi = m.heating.value().taylor_quinney;
  EXPECT_EQ(chi.size, 2);
  EXPECT_EQ(chi.x[1], 0.1);
  EXPECT_EQ(chi.y[1], 0.9);
}

TEST(MaterialFile, DefaultsAreThoseOfTheParameterTables) {
  const Material m = read(steel).material;
  EXPECT_TRUE(m.heating.value().viscous);
  EXPECT_FALSE(m.heating.value().thermoelastic);
  EXPECT_EQ(m.artificial_viscosity.linear, ArtificialViscosity{}.linear);
  EXPECT_EQ(m.artificial_viscosity.quadratic, ArtificialViscosity{}.quadratic);
  // The one default that is another value of the file.
  EXPECT_EQ(std::get<equation_of_state::MieGruneisenTemperature>(m.equation_of_state).reference_density, 7830.0);
}

TEST(MaterialFile, KeepsTheSourceOfEveryValue) {
  const MaterialFile file = read(steel);
  EXPECT_EQ(file.notes, "a note");
  EXPECT_EQ(file.sources.at("density"), "a scale");
  EXPECT_EQ(file.sources.at("equation_of_state"), "book");
  EXPECT_EQ(file.sources.at("equation_of_state.slope"), "paper");
  EXPECT_EQ(file.sources.at("failure.0"), "s");
  EXPECT_FALSE(file.sources.contains("thermal_conductivity"));
}

// --- Round trip -------------------------------------------------------------------------------------------------------

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Table& a, const Table& b) {
  return a.size == b.size &&
         std::equal(a.x.begin(), a.x.end(), b.x.begin(), [](double x, double y) { return same_bits(x, y); }) &&
         std::equal(a.y.begin(), a.y.end(), b.y.begin(), [](double x, double y) { return same_bits(x, y); });
}
template <std::size_t N>
bool same_bits(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same_bits(x, y); });
}
template <class T>
requires(std::is_enum_v<T> || std::is_same_v<T, bool>) bool same_bits(T a, T b) {
  return a == b;
}
template <class Law>
requires requires {
  Law::parameters;
}
bool same_bits(const Law& a, const Law& b) {
  bool same = true;
  for_each_parameter<Law>([&](const auto& row) { same = same && same_bits(a.*row.member, b.*row.member); });
  return same;
}
template <class... Law>
bool same_bits(const std::variant<Law...>& a, const std::variant<Law...>& b) {
  return a.index() == b.index() &&
         std::visit([&](const auto& law) { return same_bits(law, std::get<std::decay_t<decltype(law)>>(b)); }, a);
}
template <class T>
bool same_bits(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same_bits(x, y); });
}
bool same_bits(const Material& a, const Material& b) {
  return a.name == b.name && same_bits(a.density, b.density) && same_bits(a.bulk_modulus, b.bulk_modulus) &&
         same_bits(a.thermal_conductivity, b.thermal_conductivity) && a.objective_rate == b.objective_rate &&
         same_bits(a.equation_of_state, b.equation_of_state) && same_bits(a.shear_modulus, b.shear_modulus) &&
         same_bits(a.melting, b.melting) && same_bits(a.specific_heat, b.specific_heat) &&
         same_bits(a.flow_stress, b.flow_stress) && same_bits(a.yield, b.yield) && same_bits(a.viscoelastic, b.viscoelastic) &&
         same_bits(a.porosity, b.porosity) && same_bits(a.initial_porosity, b.initial_porosity) &&
         same_bits(a.damage, b.damage) && same_bits(a.initial_damage, b.initial_damage) &&
         same_bits(a.stability, b.stability) && same_bits(a.failure, b.failure) && same_bits(a.heating, b.heating) &&
         same_bits(a.reaction, b.reaction) && same_bits(a.artificial_viscosity, b.artificial_viscosity);
}

void expect_round_trip(const MaterialFile& file, const std::string& what) {
  const std::string text = write_material(file);
  const MaterialFile again = read(text);
  EXPECT_TRUE(same_bits(file.material, again.material)) << what << '\n' << text;
  EXPECT_EQ(file.notes, again.notes) << what;
  EXPECT_EQ(file.sources, again.sources) << what;
}

TEST(WrittenMaterial, ReadsBackToTheSameBits) {
  expect_round_trip(read(steel), "steel");
  MaterialFile odd = read(steel);
  odd.material.name = "quotes \" and \\ and\nline\tbreaks \x01\x7F \u00E9";
  odd.notes = "\"\"\"";
  odd.material.density = 7830.0 + 1e-9 / 3.0;
  odd.material.thermal_conductivity = 0.0;
  auto& flow = std::get<flow_stress::JohnsonCook>(odd.material.flow_stress.value());
  flow.B = -0.0;
  flow.A = 1e300 / 3.0;
  flow.reference_strain_rate = 4.9406564584124654e-324;
  odd.material.heating.value().taylor_quinney.y[0] = 1.0 / 3.0;
  expect_round_trip(odd, "odd");
}

TEST(WrittenMaterial, EchoesEveryDefault) {
  const std::string text = write_material(read(steel));
  for (const char* line : {"\nviscous = true", "\nthermoelastic = false", "\nlinear = 0.06", "\nquadratic = 1.5",
                           "\nreference_density = 7830.0", "\nobjective_rate = \"incremental_rotation\""})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST(WrittenMaterial, WithoutSourcesSaysSo) {
  const Material m = read(steel).material;
  const MaterialFile again = read(write_material(m, "fit"));
  EXPECT_TRUE(same_bits(m, again.material));
  EXPECT_EQ(again.sources.at("flow_stress"), "fit");
}

TEST(MaterialsOfTheRepository, AreReadableAndReadBackToTheSameBits) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(BRISANCE_SOURCE_DIR) / "data/materials")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    try {
      expect_round_trip(read_material_file(entry.path()), entry.path().string());
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(files, 0);
}

// --- Every law --------------------------------------------------------------------------------------------------------

/// A law with every parameter at a value of its own somewhere in its interval.
template <class Law>
Law sample() {
  Law law{};
  double next = 0.37;
  const auto inside = [&](const Interval& interval) {
    next = next * 1.618 - static_cast<int>(next * 1.618);
    const double lower = std::isfinite(interval.lower) ? interval.lower : -1e6;
    const double upper = std::isfinite(interval.upper) ? interval.upper : lower + 1e9;
    return lower + (0.1 + 0.8 * next) * (upper - lower);
  };
  for_each_parameter<Law>([&](const auto& row) {
    auto& member = law.*row.member;
    using T = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<T, double>)
      member = inside(row.interval);
    else if constexpr (std::is_same_v<T, bool>)
      member = true;
    else if constexpr (std::is_same_v<T, Table>)
      member.size = 2, member.x = {0.0, 1.0}, member.y = {inside(row.interval), inside(row.interval)};
    else if constexpr (std::is_enum_v<T>)
      member = static_cast<T>(choices<T>.size() - 1);
    else
      for (double& x : member) x = inside(row.interval);
  });
  return law;
}

/// Reads the component alone: whether the rest of the material fits is not the question here.
template <class Component>
void expect_every_law_round_trips(Component Material::*component, const std::string& key) {
  using Value = std::decay_t<decltype(std::declval<Material>().*component)>;
  using Laws = typename Value::value_type;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto one = [&](const auto& law) {
      MaterialFile file = read(steel);
      file.material.*component = Value{Laws{law}};
      file.sources[key] = file.sources[key + ".0"] = "s";
      InputFile input = InputFile::from_text(write_material(file), "x.toml");
      TableReader top = input.top();
      const Material again = read_material(top).material;
      for (const Problem& problem : input.problems()) EXPECT_FALSE(problem.key.starts_with(key + '.')) << problem.text();
      EXPECT_TRUE(same_bits(file.material.*component, again.*component)) << key << ' ' << law.name;
    };
    (one(sample<std::variant_alternative_t<I, Laws>>()), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Laws>>());
}

TEST(EveryLaw, RoundTripsThroughAMaterialFile) {
  expect_every_law_round_trips(&Material::shear_modulus, "shear_modulus");
  expect_every_law_round_trips(&Material::melting, "melting");
  expect_every_law_round_trips(&Material::specific_heat, "specific_heat");
  expect_every_law_round_trips(&Material::flow_stress, "flow_stress");
  expect_every_law_round_trips(&Material::yield, "yield");
  expect_every_law_round_trips(&Material::viscoelastic, "viscoelastic");
  expect_every_law_round_trips(&Material::porosity, "porosity");
  expect_every_law_round_trips(&Material::initial_porosity, "initial_porosity");
  expect_every_law_round_trips(&Material::damage, "damage");
  expect_every_law_round_trips(&Material::initial_damage, "initial_damage");
  expect_every_law_round_trips(&Material::stability, "stability");
  expect_every_law_round_trips(&Material::failure, "failure");
  expect_every_law_round_trips(&Material::reaction, "reaction");
}

template <class... Law>
void expect_names_fit_the_file_format(std::type_identity<std::variant<Law...>>, const std::string& key) {
  const auto one = [&]<class Some>(std::type_identity<Some>) {
    std::set<std::string_view> names = {"law", "source", "sources"};
    for_each_parameter<Some>(
        [&](const auto& row) { EXPECT_TRUE(names.insert(row.name).second) << key << ' ' << Some::name << ' ' << row.name; });
  };
  (one(std::type_identity<Law>{}), ...);
  const std::set<std::string_view> laws = {Law::name...};
  EXPECT_EQ(laws.size(), sizeof...(Law)) << key;
}

TEST(EveryLaw, NamesAreUniqueAndLeaveLawAndSourceToTheFileFormat) {
  expect_names_fit_the_file_format(std::type_identity<EquationOfState>{}, "equation_of_state");
  expect_names_fit_the_file_format(std::type_identity<FlowStress>{}, "flow_stress");
  expect_names_fit_the_file_format(std::type_identity<ShearModulus>{}, "shear_modulus");
  expect_names_fit_the_file_format(std::type_identity<Melting>{}, "melting");
  expect_names_fit_the_file_format(std::type_identity<SpecificHeat>{}, "specific_heat");
  expect_names_fit_the_file_format(std::type_identity<Yield>{}, "yield");
  expect_names_fit_the_file_format(std::type_identity<Viscoelastic>{}, "viscoelastic");
  expect_names_fit_the_file_format(std::type_identity<Porosity>{}, "porosity");
  expect_names_fit_the_file_format(std::type_identity<InitialPorosity>{}, "initial_porosity");
  expect_names_fit_the_file_format(std::type_identity<Damage>{}, "damage");
  expect_names_fit_the_file_format(std::type_identity<Stability>{}, "stability");
  expect_names_fit_the_file_format(std::type_identity<Failure>{}, "failure");
  expect_names_fit_the_file_format(std::type_identity<Reaction>{}, "reaction");
}

// --- Materials that other files name ----------------------------------------------------------------------------------

class NamedMaterial : public testing::Test {
 protected:
  fs::path folder = scratch();
  void SetUp() override {
    std::ofstream(folder / "my_steel.toml") << steel;
    std::ofstream(folder / "broken.toml") << "name = [\n";
  }

  MaterialFile resolve(const std::string& case_text, const std::vector<std::string>& overrides = {}) {
    InputFile input = InputFile::from_text(case_text, folder / "case.toml");
    for (const std::string& assignment : overrides) input.set(assignment);
    TableReader top = input.top();
    MaterialFile file = resolve_material(top, "material");
    input.finish();
    return file;
  }
  std::string refusal(const std::string& case_text, const std::vector<std::string>& overrides = {}) {
    try {
      resolve(case_text, overrides);
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string prefix = folder.string() + '/';
      for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) message.erase(at, prefix.size());
      return message;
    }
    return "accepted";
  }
};

TEST_F(NamedMaterial, IsFoundBesideTheFileThatNamesIt) {
  const MaterialFile file = resolve("material = \"my_steel.toml\"\n");
  EXPECT_EQ(file.material.density, 7830.0);
  EXPECT_EQ(file.path, folder / "my_steel.toml");
}

TEST_F(NamedMaterial, IsFoundAmongTheMaterialsOfTheProgram) {
  EXPECT_GT(resolve("material = \"copper_etp.toml\"\n").material.density, 8000.0);
}

TEST_F(NamedMaterial, MayStandInTheFileItself) {
  std::string embedded = steel;
  for (const std::string table :
       {"equation_of_state", "flow_stress", "shear_modulus", "melting", "specific_heat", "yield", "failure", "heating"})
    embedded.replace(embedded.find('[' + table + ']') + 1, 0, "material.");
  EXPECT_EQ(resolve("[material]\n" + embedded).material.density, 7830.0);
}

TEST_F(NamedMaterial, ObeysOverridesThatLeadIntoIt) {
  EXPECT_EQ(resolve("material = \"my_steel.toml\"\n", {"material.density=9 g/cm^3"}).material.density, 9000.0);
  EXPECT_EQ(refusal("material = \"my_steel.toml\"\n", {"material.flow_stress.A=9 g"}),
            "--set flow_stress.A: \"9 g\" is not a pressure: \"g\" measures a mass; give a number in Pa or a text such as "
            "\"792 MPa\"");
}

TEST_F(NamedMaterial, ThatIsMissingOrWrongIsReported) {
  EXPECT_EQ(refusal("x = 1\n"),
            "case.toml: material: missing: the material, or the name of its file; give a table [material]\ncase.toml:1:1: x: "
            "unknown key; "
            "the keys known here are material");
  EXPECT_EQ(refusal("material = 3\n"), "case.toml:1:12: material: this is the number 3; a table [material] is required");
  EXPECT_EQ(refusal("material = \"my_stel.toml\"\n"),
            "case.toml:1:12: material: there is no material file \"my_stel.toml\" beside this file or in " BRISANCE_SOURCE_DIR
            "/data/materials; did you mean \"my_steel.toml\"?");
  EXPECT_EQ(refusal("material = \"broken.toml\"\n"),
            "broken.toml:1:10: not valid TOML: in this array: encountered end-of-file; the slip may stand before this place");
}

TEST(BundledMaterials, AreThoseOfTheFirstFolderThatHasAny) {
  const fs::path source = fs::path(BRISANCE_SOURCE_DIR) / "data/materials", none = "/there/is/no/such/folder";
  const std::vector<fs::path> files = bundled_materials(std::vector{none, source});
  EXPECT_TRUE(std::find(files.begin(), files.end(), source / "steel_4340.toml") != files.end());
  EXPECT_TRUE(std::is_sorted(files.begin(), files.end()));
  try {
    bundled_materials(std::vector{none});
    ADD_FAILURE() << "a program without its materials must say so";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(none.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace brisance
