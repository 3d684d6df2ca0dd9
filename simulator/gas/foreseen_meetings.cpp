#include "simulator/gas/foreseen_meetings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "simulator/gas/bodies.hpp"
#include "simulator/gas/bodies_setup.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();
constexpr std::size_t most_sides = 6;

/// How far the part of a body that lies beside each side of the box reaches outwards, in m beyond the side; `nowhere` if no
/// part of it does.
std::array<double, most_sides> reach_of(const Case& c, const MovingBody& body, double half_width) {
  std::array<double, most_sides> reach;
  reach.fill(nowhere);
  const auto D = static_cast<std::size_t>(c.dimensions());
  for (const Vector& x : points_of(body, c.geometry, body.state, body.state, 0.0).position) {
    std::array<bool, 3> within{};
    for (std::size_t a = 0; a < D; ++a) within[a] = x[a] > c.gas->lower[a] && x[a] < c.gas->upper[a];
    for (std::size_t a = 0; a < D; ++a) {
      bool beside = true;
      for (std::size_t b = 0; b < D; ++b) beside = beside && (b == a || within[b]);
      if (!beside) continue;
      reach[2 * a] = std::max(reach[2 * a], c.gas->lower[a] - x[a] + half_width);
      reach[2 * a + 1] = std::max(reach[2 * a + 1], x[a] + half_width - c.gas->upper[a]);
    }
  }
  return reach;
}

/// What a body does at one wall, from what it reaches there from time to time.
class Wall {
 public:
  Wall(double cell_size, double at_start) : cell_size_(cell_size), start_(at_start) {}

  void look(double before, double now, double time_before, double time) {
    if (before == nowhere || now == nowhere) return;  // it is not beside the wall, or leaves it sideways
    constexpr double rounding = 1e-6;
    const double half = 0.5 * cell_size_, least = rounding * cell_size_;
    using Kind = ForeseenMeeting::Kind;
    if (found_) {
      if (found_->kind == Kind::lets_go_of_wall) found_->missing = std::max(found_->missing, -now);
      return;
    }
    const bool moves = std::abs(now - before) > least;
    const auto note = [&](Kind what, double at) {
      const double part = now == before ? 0.0 : std::clamp((at - before) / (now - before), 0.0, 1.0);
      found_ = ForeseenMeeting{"", "", what, std::lerp(time_before, time, part), std::max(-now, 0.0)};
    };
    if (start_ > -half && now < before) {  // what lies at the wall, or too near to it for gas between
      if (moves && now < -least) note(Kind::lets_go_of_wall, std::min(start_, 0.0));
    } else if (start_ < -least && moves && now > -half) {
      note(Kind::runs_into_wall, -half);
    }
  }
  const std::optional<ForeseenMeeting>& found() const { return found_; }

 private:
  double cell_size_, start_;
  std::optional<ForeseenMeeting> found_;
};

}  // namespace

std::vector<ForeseenMeeting> foreseen_meetings(const Case& c) {
  std::vector<ForeseenMeeting> meetings;
  if (!c.gas) return meetings;
  for (const GasBodyConfig& config : c.gas->bodies) {
    MovingBody body = make_body(c, config);
    const BodyMotion& motion = body.motion;
    if (body.mass > 0.0 || (!motion.velocity && !motion.rotation && !motion.radial_velocity)) continue;
    constexpr double most_places = 5e6;  // a part of a second
    const int looks = static_cast<int>(std::clamp(most_places / static_cast<double>(body.places.size()), 50.0, 400.0));
    const double half_width = 0.5 * c.cell_size / config.particles_per_direction;
    std::array<double, most_sides> before = reach_of(c, body, half_width);
    std::vector<std::pair<std::size_t, Wall>> walls;
    for (std::size_t side = 0; side < static_cast<std::size_t>(2 * c.dimensions()); ++side) {
      const bool axis = is_round(c.geometry) && side == 0 && c.gas->lower[0] == 0.0;
      if (!axis && is_wall(c, side)) walls.emplace_back(side, Wall(c.cell_size, before[side]));
    }
    for (int n = 0; n < looks; ++n) {
      const double from = c.end_time * n / looks, to = c.end_time * (n + 1) / looks;
      body.state = moved(body, from, to - from);
      const std::array<double, most_sides> now = reach_of(c, body, half_width);
      for (auto& [side, watch] : walls) watch.look(before[side], now[side], from, to);
      before = now;
    }
    for (const auto& [side, watch] : walls)
      if (watch.found()) {
        meetings.push_back(*watch.found());
        meetings.back().body = config.name, meetings.back().side = choices<BoxSide>[side];
        meetings.back().missing += c.cell_size;
      }
  }
  return meetings;
}

std::string in_words(const ForeseenMeeting& m) {
  using Kind = ForeseenMeeting::Kind;
  switch (m.kind) {
    case Kind::runs_into_wall:
      return fmt::format(
          "{}: at {:.4g} s it is within half a cell of the wall {}, and the gas between them has nowhere to go: the run ends "
          "there; end it before that (end_time), or let the body stop (amplitude)",
          m.body, m.time, m.side);
    case Kind::lets_go_of_wall:
      return fmt::format(
          "{}: at {:.4g} s it lets go of the wall {}, and there is no gas that could fill the room behind it: the run ends "
          "soon after; let the body reach {:.4g} m farther beyond the wall at the start",
          m.body, m.time, m.side, m.missing);
  }
  return {};
}

}  // namespace brisance::simulator::gas
