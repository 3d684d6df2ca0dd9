#include "models/input/csv.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "models/input/diagnostics.hpp"

namespace brisance {
namespace {

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string refusal_of(const std::string& text) {
  return refusal([&] { CsvFile::from_text(text, "data.csv"); });
}

const std::string melting =
    "# Melting\n# second comment\npressure [GPa], temperature "
    "[K],author,ratio\n0.024895,934.807,Boehler,1\n\n27.103,2281.04,Ross,2\r\n";

TEST(Csv, ColumnsAreConvertedToTheUnitAskedFor) {
  const CsvFile file = CsvFile::from_text(melting, "data.csv");
  EXPECT_EQ(file.rows(), 2u);
  EXPECT_EQ(file.comments(), (std::vector<std::string>{"Melting", "second comment"}));
  EXPECT_EQ(file.numbers("pressure", Unit::Pa), (std::vector<double>{24895000.0, 27103000000.0}));
  EXPECT_EQ(file.numbers("temperature", Unit::K), (std::vector<double>{934.807, 2281.04}));
  EXPECT_EQ(file.numbers("ratio", Unit::one), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(file.texts("author"), (std::vector<std::string>{"Boehler", "Ross"}));
  EXPECT_TRUE(file.has("author"));
  EXPECT_FALSE(file.has("year"));
}

TEST(Csv, ColumnsThatAreNotWhatWasAskedForAreRefused) {
  const CsvFile file = CsvFile::from_text(melting, "data.csv");
  EXPECT_EQ(refusal([&] { file.numbers("presure", Unit::Pa); }),
            "data.csv:3:1: there is no column \"presure\"; there are pressure, temperature, author, ratio; did you mean "
            "\"pressure\"?");
  EXPECT_EQ(
      refusal([&] { file.numbers("temperature", Unit::Pa); }),
      "data.csv:3:17: column temperature: \"K\" measures a temperature; a pressure is required, as in \"temperature [Pa]\"");
  EXPECT_EQ(refusal([&] { file.numbers("ratio", Unit::Pa); }),
            "data.csv:3:40: column ratio: no unit is given; a pressure is required, as in \"ratio [Pa]\"");
  EXPECT_EQ(refusal([&] { file.numbers("author", Unit::one); }),
            "data.csv:4:1: column author: \"Boehler\" is not a decimal number\n"
            "data.csv:6:1: column author: \"Ross\" is not a decimal number");
}

TEST(Csv, FilesThatAreNoTablesAreRefused) {
  EXPECT_EQ(refusal_of("# only a comment\n"), "data.csv: there is no line of column names");
  EXPECT_EQ(refusal_of("a,b\n"), "data.csv: there are no rows below the header");
  EXPECT_EQ(refusal_of("a,b\n1,2\n1\n1,2,3\n"),
            "data.csv:3:1: this row has 1 cells; the header in line 1 has 2\ndata.csv:4:1: this row has 3 cells; the header in "
            "line 1 has 2");
  EXPECT_EQ(refusal_of("a,a,\n1,2,3\n"), "data.csv:1:3: column \"a\" is given twice\ndata.csv:1:5: a column has no name");
  EXPECT_EQ(refusal_of("a [GPa,b []\n1,2\n"),
            "data.csv:1:1: column \"a [GPa\": the unit must stand in brackets, as in \"pressure [GPa]\"\n"
            "data.csv:1:8: column \"b []\": the unit must stand in brackets, as in \"pressure [GPa]\"");
  EXPECT_EQ(refusal([] { CsvFile::load("no/such.csv"); }), "no/such.csv: there is no such file");
  const CsvFile nan = CsvFile::from_text("a\nnan\n1e999\n", "data.csv");
  EXPECT_THROW(nan.numbers("a", Unit::one), InputError);
}

TEST(Csv, EveryExperimentInTheRepositoryIsReadable) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(BRISANCE_SOURCE_DIR) / "data/experiments"))
    if (entry.path().extension() == ".csv") {
      EXPECT_NO_THROW(CsvFile::load(entry.path())) << entry.path();
      ++files;
    }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace brisance
