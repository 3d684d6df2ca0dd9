#include "simulator/gas/foreseen_meetings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "simulator/gas/bodies.hpp"
#include "simulator/gas/bodies_setup.hpp"
#include "simulator/solid/shapes.hpp"

namespace brisance::simulator::gas {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();
constexpr std::size_t most_sides = 6;

/// The box of the gas: what leaves it through a periodic side comes in at the opposite one.
class Box {
 public:
  explicit Box(const Case& c)
      : dimensions_(static_cast<std::size_t>(c.dimensions())), lower_(c.gas->lower), upper_(c.gas->upper) {
    for (const EdgeConfig& edge : c.gas->edges)
      if (edge.kind == EdgeKind::periodic) periodic_[static_cast<std::size_t>(edge.side) / 2] = true;
  }
  Vector wrapped(Vector x) const {
    for (std::size_t a = 0; a < dimensions_; ++a)
      if (periodic_[a]) x[a] -= length(a) * std::floor((x[a] - lower_[a]) / length(a));
    return x;
  }
  bool contains(const Vector& x) const {
    for (std::size_t a = 0; a < dimensions_; ++a)
      if (x[a] < lower_[a] || x[a] > upper_[a]) return false;
    return true;
  }
  /// Points within the box, and those that they repeat within `reach` (m) beyond its periodic sides.
  std::vector<Vector> with_images(std::vector<Vector> points, double reach) const {
    for (std::size_t a = 0; a < dimensions_; ++a)
      for (std::size_t p = 0, count = periodic_[a] ? points.size() : 0; p < count; ++p)
        for (const double turns : {-1.0, 1.0}) {
          Vector image = points[p];
          image[a] += turns * length(a);
          if (image[a] > lower_[a] - reach && image[a] < upper_[a] + reach) points.push_back(image);
        }
    return points;
  }

 private:
  double length(std::size_t axis) const { return upper_[axis] - lower_[axis]; }

  std::size_t dimensions_;
  Vector lower_, upper_;
  std::array<bool, 3> periodic_{};
};

/// How far the part of a body that lies beside each side of the box reaches outwards, in m beyond the side; `nowhere` if no
/// part of it does.
std::array<double, most_sides> reach_of(const Case& c, const MovingBody& body, double half_width) {
  std::array<double, most_sides> reach;
  reach.fill(nowhere);
  const auto D = static_cast<std::size_t>(c.dimensions());
  const Box box(c);
  for (const Vector& place : points_of(body, c.geometry, body.state, body.state, 0.0).position) {
    const Vector x = box.wrapped(place);
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

bool has_motion(const BodyMotion& motion) {
  return motion.velocity || motion.rotation || motion.radial_velocity;
}

/// Points in the squares or cubes of a lattice, to find those near a place.
class Neighbours {
 public:
  Neighbours(const std::vector<Vector>& points, double width) : points_(points), width_(width) {
    for (std::size_t p = 0; p < points.size(); ++p) places_.emplace_back(place_of(points[p]), p);
    std::sort(places_.begin(), places_.end());
  }
  /// Distance to the nearest point; infinite where none is within the width of the lattice.
  double nearest(const Vector& x) const {
    const auto [kz, ky, kx] = place_of(x);
    double least = width_ * width_;
    bool found = false;
    for (std::int64_t k = kz - 1; k <= kz + 1; ++k)
      for (std::int64_t j = ky - 1; j <= ky + 1; ++j)
        for (auto at = std::lower_bound(places_.begin(), places_.end(), std::pair{Place{k, j, kx - 1}, std::size_t{0}});
             at != places_.end() && at->first <= Place{k, j, kx + 1}; ++at) {
          const Vector apart = points_[at->second] - x;
          if (dot(apart, apart) <= least) least = dot(apart, apart), found = true;
        }
    return found ? std::sqrt(least) : std::numeric_limits<double>::infinity();
  }

 private:
  using Place = std::array<std::int64_t, 3>;  // z, y, x
  Place place_of(const Vector& x) const {
    const auto index = [&](double at) { return static_cast<std::int64_t>(std::floor(at / width_)); };
    return {index(x[2]), index(x[1]), index(x[0])};
  }
  const std::vector<Vector>& points_;
  double width_;
  std::vector<std::pair<Place, std::size_t>> places_;
};

/// A body with the particles alone that lie at its surface: those that lack a neighbour.
MovingBody surface_of(const Case& c, const GasBodyConfig& config) {
  MovingBody body = make_body(c, config);
  const double width = c.cell_size / config.particles_per_direction;
  std::vector<Vector> surface;
  {
    const Neighbours all(body.places, width);
    constexpr double close = 0.25;  // of the width: of the place where a neighbour would be
    const auto lacks = [&](const Vector& x) {
      for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimensions()); ++a)
        for (const double side : {-1.0, 1.0}) {
          Vector there = x;
          there[a] += side * width;
          if (all.nearest(there) > close * width) return true;
        }
      return false;
    };
    std::copy_if(body.places.begin(), body.places.end(), std::back_inserter(surface), lacks);
  }
  body.places = std::move(surface);
  return body;
}

/// Two bodies, of which one at least moves, seen from time to time.
class Approach {
 public:
  Approach(std::size_t first, std::size_t second, double width, bool both_prescribed)
      : bodies(first, second), known(both_prescribed), width_(width) {}

  /// Where they are at first: what cell the gas between them pushes is not resolved if it is thinner than half a cell.
  void start(const std::vector<Vector>& one, const std::vector<Vector>& other, double cell_size) {
    const double least = width_ + 0.5 * cell_size;
    side_by_side_ = distance_of(one, other, least) < least;
  }
  void look(const std::vector<Vector>& one, const std::vector<Vector>& other, double time) {
    if (touches_ || touched_at_start_) return;
    const double distance = distance_of(one, other, width_);
    // Particles of bodies that lie flush are a width apart (half of that of each); those of bodies that overlap come closer,
    // wherever they lie.
    constexpr double flush = 1.0 - 1e-6, overlapping = 0.75;
    if (distance >= flush * width_) {
      apart_ = time;
      return;
    }
    if (!apart_)
      touched_at_start_ = true;  // bodies that are built into each other may slide
    else if (distance < overlapping * width_)
      touches_ = true;
  }
  /// s, when they were apart for the last time; nothing if they never met.
  std::optional<double> time() const { return touches_ ? apart_ : std::nullopt; }
  bool side_by_side() const { return side_by_side_; }

  std::pair<std::size_t, std::size_t> bodies;
  bool known;  // where both go is prescribed

 private:
  /// Infinite beyond `reach`.
  static double distance_of(const std::vector<Vector>& one, const std::vector<Vector>& other, double reach) {
    const auto box_of = [](const std::vector<Vector>& points) {
      Bounds box{points.front(), points.front()};
      for (const Vector& x : points)
        for (std::size_t a = 0; a < 3; ++a)
          box.lower[a] = std::min(box.lower[a], x[a]), box.upper[a] = std::max(box.upper[a], x[a]);
      return box;
    };
    const auto near = [&](const std::vector<Vector>& points, const Bounds& box) {
      std::vector<Vector> kept;
      std::copy_if(points.begin(), points.end(), std::back_inserter(kept), [&](const Vector& x) {
        for (std::size_t a = 0; a < 3; ++a)
          if (x[a] < box.lower[a] - reach || x[a] > box.upper[a] + reach) return false;
        return true;
      });
      return kept;
    };
    double least = std::numeric_limits<double>::infinity();
    if (one.empty() || other.empty()) return least;
    const std::vector<Vector> of_one = near(one, box_of(other)), of_other = near(other, box_of(one));
    const Neighbours neighbours(of_one, reach);
    for (const Vector& x : of_other) least = std::min(least, neighbours.nearest(x));
    return least;
  }

  double width_;  // m, of the particles
  bool touches_ = false, touched_at_start_ = false, side_by_side_ = false;
  std::optional<double> apart_;
};

/// The bodies that meet each other within the box, and those that touch from the start.
void foresee_bodies_that_meet(const Case& c, std::vector<ForeseenMeeting>& meetings) {
  const std::vector<GasBodyConfig>& configs = c.gas->bodies;
  if (configs.size() < 2) return;
  std::vector<MovingBody> bodies;
  std::size_t particles = 1;
  for (const GasBodyConfig& config : configs) {
    bodies.push_back(surface_of(c, config));
    particles += bodies.back().places.size();
  }
  std::vector<Approach> approaches;
  for (std::size_t n = 0; n < bodies.size(); ++n)
    for (std::size_t m = 0; m < n; ++m) {
      const bool known = bodies[n].mass == 0.0 && bodies[m].mass == 0.0;
      const double width =
          0.5 * c.cell_size * (1.0 / configs[n].particles_per_direction + 1.0 / configs[m].particles_per_direction);
      if (!known || has_motion(bodies[n].motion) || has_motion(bodies[m].motion)) approaches.emplace_back(m, n, width, known);
    }
  if (approaches.empty()) return;
  const Box box(c);
  constexpr double most_particles = 2e6;  // a part of a second
  const int looks = static_cast<int>(std::clamp(most_particles / static_cast<double>(particles), 50.0, 400.0));
  for (int n = 0; n <= looks; ++n) {
    std::vector<std::vector<Vector>> points;
    for (MovingBody& body : bodies) {
      const double step = c.end_time / looks;
      if (n > 0 && body.mass == 0.0) body.state = moved(body, (n - 1) * step, step);
      points.push_back(points_of(body, c.geometry, body.state, body.state, 0.0).position);
      for (Vector& x : points.back()) x = box.wrapped(x);
      std::erase_if(points.back(), [&](const Vector& x) { return !box.contains(x); });
    }
    for (Approach& approach : approaches) {
      const double farthest = 2.0 * c.cell_size;  // that it looks
      const std::vector<Vector> one = box.with_images(points[approach.bodies.first], farthest);
      const std::vector<Vector>& other = points[approach.bodies.second];
      if (n == 0) approach.start(one, other, c.cell_size);
      if (approach.known) approach.look(one, other, c.end_time * n / looks);
    }
  }
  using Kind = ForeseenMeeting::Kind;
  for (const Approach& approach : approaches) {
    const std::string &one = configs[approach.bodies.first].name, &other = configs[approach.bodies.second].name;
    if (approach.side_by_side()) meetings.push_back({one, other, Kind::slides_along_body, 0.0, 0.0});
    if (const auto time = approach.time()) meetings.push_back({one, other, Kind::runs_into_body, *time, 0.0});
  }
}

}  // namespace

std::vector<ForeseenMeeting> foreseen_meetings(const Case& c) {
  std::vector<ForeseenMeeting> meetings;
  if (!c.gas) return meetings;
  for (const GasBodyConfig& config : c.gas->bodies) {
    MovingBody body = make_body(c, config);
    const BodyMotion& motion = body.motion;
    if (body.mass > 0.0 || !has_motion(motion)) continue;
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
  foresee_bodies_that_meet(c, meetings);
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
    case Kind::runs_into_body:
      return fmt::format(
          "{} and {}: from {:.4g} s on they run into each other, and the gas between them has nowhere to go: the run ends "
          "about there; end it before that (end_time), or let one of them stop (amplitude)",
          m.body, m.side, m.time);
    case Kind::slides_along_body:
      return fmt::format(
          "{} and {}: there is less than half a cell between them at the start, and one of them moves: what the gas does to "
          "each of them where they touch is not resolved, and velocity, force and work can be wrong by several percent; let a "
          "wall of the box take the place of the one at rest, or leave two cells between them",
          m.body, m.side);
  }
  return {};
}

}  // namespace brisance::simulator::gas
