#pragma once
// What the figures of a run have in common: numbers with units of a sensible size, panels against time, pictures in metres.

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/input/units.hpp"
#include "models/programs/figure.hpp"
#include "simulator/config.hpp"

namespace brisance::simulator::figures {

/// A unit in which numbers are neither very large nor very small.
struct Scale {
  double per_si = 1.0;
  std::string unit;  // "" of a number without one
};
Scale scale_for(std::string_view unit, double largest);
double largest(const std::vector<double>& values);
std::vector<double> scaled(std::vector<double> values, double factor);

/// "time (µs)"
std::string label(std::string_view what, const Scale& scale);
/// "80 µs"
std::string in_words(double x, std::string_view unit, int digits = 4);
/// "plastic strain"
std::string in_words(std::string_view field);
/// What a coordinate of the case file, x or y, is in the round geometries: "x, the radius".
std::string coordinate_label(Geometry geometry, std::string_view coordinate);

/// What a picture shows of the values of a run that failed, if a few of them would leave no room for the others.
struct MostOf {
  std::array<double, 2> range;
  std::string words;  // what lies beyond the range
};
/// All but the outermost hundredth at either end; nothing if the rest does not reach ten times as far as these do.
std::optional<MostOf> most_of(const std::vector<double>& all, std::string_view unit);

void legend_beside(Panel& panel);
/// Colours in the order of the curves; where there are more, the others are dashed.
void colour_in_order(Panel& panel);
/// Curves that lie on each other take turns along the line: each later one leaves a part of it to those below.
void let_all_be_seen(std::vector<Curve>& curves);

/// From 0 to the last time, s; of a run that has not begun some time after.
std::array<double, 2> from_the_start(double last, const Scale& times);
/// Curves of a quantity against time, s. Those that would lie on the axis, and what is below `noise`, are not drawn; the title
/// tells the largest values of the largest of them, unless they are zero all the time.
Panel against_time(const std::string& title, std::string_view quantity, const std::vector<double>& time,
                   std::vector<Curve> curves, Unit unit, double noise = 0.0);

/// The part of a plane that a picture shows, m.
struct Window {
  double lower[2] = {1e300, 1e300}, upper[2] = {-1e300, -1e300};
  void add(double x, double y) {
    lower[0] = std::min(lower[0], x), upper[0] = std::max(upper[0], x);
    lower[1] = std::min(lower[1], y), upper[1] = std::max(upper[1], y);
  }
  double width() const { return upper[0] - lower[0]; }
  double height() const { return upper[1] - lower[1]; }
};
/// How many pixels the sides of a picture that shows so many metres have: equal axes, unless one would be too short to see.
struct Pixels {
  double width, height;
};
Pixels pixels_of(double width, double height);
inline constexpr int beside_window = 190, below_window = 90;  // pixels that a panel has for colours and labels
/// A panel that shows the window on a figure of a sensible shape: with equal axes, unless one direction would be too thin to
/// see. Returns how many units of the axes make a metre.
Scale fit(Figure& figure, const Window& w, double margin);

/// Every figure says what its case is.
void draw(const Case& c, Figure figure, const std::filesystem::path& path);

}  // namespace brisance::simulator::figures
