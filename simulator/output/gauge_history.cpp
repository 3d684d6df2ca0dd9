#include "simulator/output/gauge_history.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>

#include "models/input/csv.hpp"
#include "simulator/output/line_out.hpp"

namespace brisance::simulator {
namespace {

/// What follows a field in the name of a column.
struct Suffix {
  std::string component, place;  // "_x"; "_00", of a line
};
std::optional<Suffix> suffix_of(const std::string& text) {
  const bool vector = text.size() >= 2 && text[0] == '_' && text[1] >= 'x' && text[1] <= 'z';
  Suffix suffix{text.substr(0, vector ? 2 : 0), text.substr(vector ? 2 : 0)};
  const bool number =
      suffix.place.size() > 1 && suffix.place[0] == '_' && suffix.place.find_first_not_of("0123456789", 1) == std::string::npos;
  return suffix.place.empty() || number ? std::optional(suffix) : std::nullopt;
}

}  // namespace

std::vector<GaugeSeries> read_gauges(const Case& c, const std::filesystem::path& directory) {
  std::vector<GaugeSeries> all;
  if (c.gauges.empty()) return all;
  const CsvFile history = CsvFile::load(directory / "history.csv");
  const std::vector<double> time = history.numbers("time", Unit::s);
  const std::string first_word = "gauge_";
  for (const GaugeConfig& gauge : c.gauges)
    for (const std::string& field : gauge.fields)
      for (const std::string& column : history.column_names()) {
        const std::string stem = first_word + gauge.name + '_' + field;
        const std::optional<Suffix> suffix = column.starts_with(stem) ? suffix_of(column.substr(stem.size())) : std::nullopt;
        if (!suffix) continue;
        GaugeSeries series{column.substr(first_word.size()),
                           gauge.name,
                           suffix->place.empty() ? std::nullopt : std::optional(std::stoul(suffix->place.substr(1))),
                           field + suffix->component,
                           unit_of_field(field),
                           {},
                           {}};
        const std::vector<std::string> texts = history.texts(column);
        for (std::size_t row = 0; row < texts.size(); ++row) {
          const double value = std::strtod(texts[row].c_str(), nullptr);
          if (!std::isfinite(value)) continue;
          series.time.push_back(time[row]), series.value.push_back(value);
        }
        all.push_back(std::move(series));
      }
  return all;
}

std::vector<GaugePeak> peaks_of(const std::vector<GaugeSeries>& series) {
  std::vector<GaugePeak> peaks;
  for (const GaugeSeries& s : series) {
    if (s.value.empty()) continue;
    std::size_t most = 0;
    for (std::size_t i = 1; i < s.value.size(); ++i)
      if (std::abs(s.value[i]) > std::abs(s.value[most])) most = i;
    peaks.push_back({s.name, s.unit, s.value[most], s.time[most]});
  }
  return peaks;
}

}  // namespace brisance::simulator
