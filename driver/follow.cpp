#include "driver/follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/equation_of_state/thermodynamics.hpp"
#include "models/kinematics.hpp"
#include "models/update.hpp"

namespace brisance::driver {
namespace {

constexpr int fewest_steps = 50;         // of a segment of known duration
constexpr double smallest_step = 1e-9;   // of the first step of a segment: smaller ones do not lead anywhere
constexpr long most_steps = 20'000'000;  // of a segment: an `until` that is never reached ends here
constexpr double growth = 1.5;           // of the step after a success

/// ln A for A near the identity: 2 artanh((A - I)(A + I)^-1).
Tensor<double> logarithm(const Tensor<double>& A) {
  const Tensor<double> I = Tensor<double>::identity();
  const Tensor<double> X = (A - I) * inverse(A + I);
  const Tensor<double> X2 = X * X;
  Tensor<double> power = X, sum;
  for (int k = 1; k < 40; k += 2) {
    sum = sum + (2.0 / k) * power;
    power = power * X2;
  }
  return sum;
}

class Traveller {
 public:
  Traveller(const Material& material, const LoadingPath& path, History& history, const FollowOptions& options)
      : path_(path), material_(material), history_(history), options_(options), update_(material_, path.cell_size) {
    // The heat sources are switched off where the temperature is ruled from outside.
    if (path.heat != Heat::adiabatic) material_.heating.reset();
    heating_ = material.heating;
    state_ =
        path.density ? initial_state(material, path.temperature, *path.density) : stress_free_state(material, path.temperature);
    state_.plastic_strain = path.plastic_strain;
    state_.porosity = path.porosity;
    state_.damage = path.damage;
    if (path.stress) state_.stress = *path.stress;
    // A step of no deformation and almost no time fills the derived quantities of the first row.
    point_ = update_(state_, {}, 1e-12, 0.0);
    point_.state = state_;
  }

  Outcome run() {
    outcome_.start = state_;
    for (number_ = 1; number_ <= path_.segments.size() && outcome_.ending == Ending::completed; ++number_)
      follow_segment(path_.segments[number_ - 1]);
    outcome_.state = state_;
    outcome_.time = time_;
    outcome_.updates = update_.calls();
    return outcome_;
  }

 private:
  /// The segment at work: where it began and what its conditions started from.
  struct Start {
    double time;
    Tensor<double> F;
    std::vector<double> targets;
  };
  struct Step {
    double dt;
    ControlledStep result;
  };
  /// Where a step begins.
  struct Place {
    const State<double>& state;
    double time;
  };
  Place here() const { return {state_, time_}; }

  void follow_segment(const PathSegment& segment) {
    set_temperature(segment.temperature.value_or(state_.temperature) + segment.temperature_jump);
    start_ = {time_, state_.deformation_gradient, {}};
    for (const FreeDirection& f : segment.free) start_.targets.push_back(double_dot(f.stress_weight, state_.stress));
    require_reachable_targets(segment);
    warm_ = {};
    trusted_ = 0, wanted_ = 0.0;
    const Column* watched = nullptr;
    if (segment.until)
      watched = &*std::find_if(history_.columns().begin(), history_.columns().end(),
                               [&](const Column& c) { return c.name == segment.until->column; });
    point_.state = state_;
    record(true);

    const double end = segment.duration ? start_.time + *segment.duration : std::numeric_limits<double>::infinity();
    double dt = first_dt(segment);
    bool reached = false;
    for (long step = 0; !reached && time_ < end; ++step) {
      if (step == most_steps)
        throw RunError(fmt::format("{}: {} steps did not reach `until`; {}", segment.where, most_steps, facts(state_, time_)));
      // A last step as long as the others, instead of a sliver.
      const double left = end - time_;
      double tried = std::min(dt, left <= 1.0000001 * dt ? left : (left < 2.0 * dt ? 0.5 * left : dt));
      if (path_.tolerance > 0.0) tried = accurate_step(segment, tried, left);
      const Step taken = step_with_halving(segment, tried, left);
      tried = taken.dt;
      Step last = taken;
      if (watched) reached = shorten_to(segment, *watched, last);
      const bool at_end = !reached && left == last.dt;
      accept(segment, last, at_end ? end : time_ + last.dt);
      ++outcome_.steps;
      const bool failed_now = note_failure();
      const bool stop = failed_now && path_.on_failure == OnFailure::stop;
      const bool interrupted =
          options_.watcher && (outcome_.steps % 256 == 0) && !options_.watcher(number_, time_, outcome_.steps);
      if (stop) outcome_.ending = Ending::failure;
      if (interrupted) outcome_.ending = Ending::interrupted;
      record(reached || time_ >= end || stop || interrupted || failed_now);
      if (stop || interrupted) return;
      dt = next_dt(segment, tried, norm(taken.result.velocity_gradient) * tried);
    }
  }

  /// A jump of the temperature at constant stress: the point expands or shrinks freely and takes up the heat.
  void set_temperature(double temperature) {
    if (temperature == state_.temperature) return;
    const EquationOfState& law = material_.equation_of_state;
    const double pressure = -trace(state_.stress) / 3.0;
    const double before = equation_of_state::density_at(law, pressure, state_.temperature);
    const double after = equation_of_state::density_at(law, pressure, temperature);
    state_.density *= after / before;
    state_.deformation_gradient = std::cbrt(before / after) * state_.deformation_gradient;
    state_.energy +=
        equation_of_state::energy(law, after, temperature) - equation_of_state::energy(law, before, state_.temperature);
    state_.temperature = temperature;
  }

  double first_dt(const PathSegment& segment) const {
    const double strain_rate = norm(segment.velocity_gradient);
    double dt = std::numeric_limits<double>::infinity();
    if (strain_rate > 0.0) dt = path_.strain_increment / strain_rate;
    if (segment.duration) dt = std::min(dt, *segment.duration / fewest_steps);
    if (segment.deformation_gradient) {
      const double strain = norm(*segment.deformation_gradient * inverse(start_.F) - Tensor<double>::identity());
      dt = *segment.duration / std::max<double>(fewest_steps, std::ceil(strain / path_.strain_increment));
    }
    // Nothing is given but rates of conditions: begin with a step of the size that they suggest.
    if (!std::isfinite(dt)) {
      double rate = 0.0;
      for (const FreeDirection& f : segment.free)
        if (norm(f.rate_weight) > 0.0) rate = std::max(rate, std::abs(f.target) / norm(f.rate_weight));
      dt = path_.strain_increment / rate;
    }
    return dt;
  }

  double next_dt(const PathSegment& segment, double taken, double strain) const {
    const double longest = segment.duration ? *segment.duration / fewest_steps : std::numeric_limits<double>::infinity();
    const double by_strain = strain > 0.0 ? taken * path_.strain_increment / strain : std::numeric_limits<double>::infinity();
    return std::min({longest, by_strain, growth * taken});
  }

  /// A condition that starts away from its target needs a duration to get there.
  void require_reachable_targets(const PathSegment& segment) const {
    if (segment.duration) return;
    for (std::size_t k = 0; k < segment.free.size(); ++k) {
      const FreeDirection& f = segment.free[k];
      if (norm(f.stress_weight) == 0.0) continue;
      const double scale = std::max(norm(state_.stress), 1e-9 * point_.bulk_modulus) * norm(f.stress_weight);
      if (std::abs(start_.targets[k] - f.target) > 1e-6 * scale)
        throw RunError(
            fmt::format("{}: a prescribed stress is {:.5g} Pa at the start and must become {:.5g} Pa; give a duration, "
                        "over which it changes linearly",
                        segment.where, start_.targets[k], f.target));
    }
  }

  Control control(const PathSegment& segment, const Place& from, double dt) const {
    Control control;
    control.velocity_gradient = segment.velocity_gradient;
    const double progress = segment.duration ? std::min((from.time + dt - start_.time) / *segment.duration, 1.0) : 1.0;
    if (segment.deformation_gradient) {
      const Tensor<double> F = start_.F + progress * (*segment.deformation_gradient - start_.F);
      control.velocity_gradient = (1.0 / dt) * logarithm(F * inverse(from.state.deformation_gradient));
    }
    control.size = static_cast<int>(segment.free.size());
    for (int k = 0; k < control.size; ++k) {
      const FreeDirection& f = segment.free[k];
      const bool on_stress = norm(f.stress_weight) > 0.0;
      control.free[k] = f.direction;
      control.conditions[k] = {f.stress_weight, f.rate_weight,
                               on_stress ? start_.targets[k] + progress * (f.target - start_.targets[k]) : f.target};
    }
    return control;
  }

  /// One attempt; the state that it begins with stays as it is.
  ControlledStep attempt(const PathSegment& segment, const Place& from, double dt, WarmStart& warm) {
    State<double> before = from.state;
    if (path_.heat == Heat::prescribed) before.temperature += segment.temperature_rate * dt;
    return controlled_step(update_, before, control(segment, from, dt), dt, from.time + dt, warm);
  }

  /// The size of the next step such that two of them come out as one of twice the size would, to the tolerance; the next but
  /// one is then as large.
  double accurate_step(const PathSegment& segment, double longest, double left) {
    if (trusted_ == 0) {
      constexpr double safety = 0.9, least_shrink = 0.1, most_shrink = 0.5;
      const double smallest = smallest_step * first_dt(segment);
      double dt = std::min({longest, 0.5 * left, wanted_ > 0.0 ? wanted_ : longest}), factor = 0.0;
      for (;; ++outcome_.rejected, dt *= std::clamp(factor, least_shrink, most_shrink)) {
        const double error = difference_of_halves(segment, dt);
        // The update is of first order: what one step misses goes with the square of its size.
        factor = error > 0.0 ? safety * std::sqrt(path_.tolerance / error) : growth;
        if (error <= path_.tolerance || dt < smallest) break;
      }
      trusted_ = 2, trusted_dt_ = dt, wanted_ = std::min(factor, growth) * dt;
    }
    --trusted_;
    constexpr double rounding = 1e-7;  // no sliver is left over at the end
    return longest <= (1.0 + rounding) * trusted_dt_ ? longest : trusted_dt_;
  }

  /// Of two steps and one of twice the size; infinite if they cannot be taken.
  double difference_of_halves(const PathSegment& segment, double dt) {
    constexpr double cannot = std::numeric_limits<double>::infinity();
    WarmStart warm = warm_;
    const ControlledStep whole = attempt(segment, here(), 2.0 * dt, warm);
    warm = warm_;
    const ControlledStep first = attempt(segment, here(), dt, warm);
    if (!whole.converged || !first.converged) return cannot;
    const State<double> middle = accepted_point(first, segment, here(), dt).state;
    const ControlledStep second = attempt(segment, {middle, time_ + dt}, dt, warm);
    if (!second.converged) return cannot;
    const State<double> a = accepted_point(whole, segment, here(), 2.0 * dt).state,
                        b = accepted_point(second, segment, {middle, time_ + dt}, dt).state;
    const double stress_scale = std::max({norm(a.stress), norm(b.stress), 1e-9 * second.point.bulk_modulus});
    const double strain_scale = std::max(b.plastic_strain, path_.strain_increment);
    return std::max({norm(a.stress - b.stress) / stress_scale, std::abs(a.temperature - b.temperature) / b.temperature,
                     std::abs(a.plastic_strain - b.plastic_strain) / strain_scale});
  }

  Step step_with_halving(const PathSegment& segment, double dt, double left) {
    constexpr double slack = 1.5;  // free components may take a step a little over the limit
    const double asked = dt, smallest = std::min(smallest_step * first_dt(segment), left);
    ControlledStep result;
    for (; dt >= smallest; dt *= 0.5) {
      result = attempt(segment, here(), dt, warm_);
      if (result.converged && norm(result.velocity_gradient) * dt <= slack * path_.strain_increment) return {dt, result};
    }
    throw RunError(fmt::format("{}: no step from {:.3g} s down to {:.3g} s succeeds at {}: {}", segment.where, asked, smallest,
                               facts(state_, time_), reason(result)));
  }

  static std::string reason(const ControlledStep& result) {
    if (result.converged) return "however short the step, its deformation stays large; the material gives way";
    if (result.trouble != Trouble::none) return std::string(describe(result.trouble));
    return fmt::format(
        "a prescribed stress cannot be held: it is missed by {:.3g} of the stress scale; the material may not be "
        "able to carry it",
        result.residual);
  }

  double watched_value(const Column& column, const Point<double>& point, double time) const {
    return column.value({point, time, static_cast<double>(number_), accumulated_});
  }

  /// If the watched column crosses its value within the step, shortens the step to end there (regula falsi, Illinois).
  bool shorten_to(const PathSegment& segment, const Column& column, Step& step) {
    const double target = segment.until->value;
    const double before = watched_value(column, point_, time_) - target;
    const double after = watched_value(column, accepted_point(step.result, segment, here(), step.dt), time_ + step.dt) - target;
    if (after == 0.0) return true;
    if (before == 0.0 || (before > 0.0) == (after > 0.0)) return false;
    double low = 0.0, high = step.dt, f_low = before, f_high = after, f = after;
    const double tolerance = 1e-12 * std::max(std::abs(target), std::abs(after - before));
    for (int iteration = 0; iteration < 60 && std::abs(f) > tolerance && high - low > 1e-14 * high; ++iteration) {
      const double dt = high - f_high * (high - low) / (f_high - f_low);
      WarmStart warm = warm_;
      const ControlledStep trial = attempt(segment, here(), dt, warm);
      if (!trial.converged) break;
      step = {dt, trial};
      f = watched_value(column, accepted_point(trial, segment, here(), dt), time_ + dt) - target;
      if ((f > 0.0) == (f_low > 0.0)) {
        low = dt, f_low = f;
        f_high *= 0.5;  // Illinois: the end that stays loses weight
      } else {
        high = dt, f_high = f;
        f_low *= 0.5;
      }
    }
    return true;
  }

  /// The point as it will be kept after a step: with the temperature that is ruled from outside.
  Point<double> accepted_point(const ControlledStep& result, const PathSegment& segment, const Place& from, double dt) const {
    Point<double> point = result.point;
    if (path_.heat == Heat::adiabatic) return point;
    point.state.temperature = from.state.temperature + (path_.heat == Heat::prescribed ? segment.temperature_rate * dt : 0.0);
    // What would have heated the point leaves it.
    if (heating_)
      point.state.energy -= heating_->taylor_quinney(point.state.plastic_strain) * point.plastic_work / point.state.density;
    return point;
  }

  void accept(const PathSegment& segment, const Step& step, double time) {
    const SymmetricTensor<double> D = symmetric_part(step.result.velocity_gradient);
    accumulated_ += step.dt * std::sqrt(2.0 / 3.0) * norm(deviator(D));
    if (options_.keep_steps) outcome_.taken.push_back({step.dt, step.result.velocity_gradient});
    point_ = accepted_point(step.result, segment, here(), step.dt);
    state_ = point_.state;
    time_ = time;
  }

  bool note_failure() {
    if (outcome_.failure != FailureCause::none || state_.failure_cause == 0.0) return false;
    outcome_.failure = static_cast<FailureCause>(static_cast<int>(state_.failure_cause));
    outcome_.failure_time = state_.failure_time;
    return true;
  }

  void record(bool keep_always) { history_.record({point_, time_, static_cast<double>(number_), accumulated_}, keep_always); }

  const LoadingPath& path_;
  Material material_;  // a copy: its heating may be switched off
  History& history_;
  const FollowOptions& options_;
  PointUpdate update_;
  std::optional<Heating> heating_;

  State<double> state_;
  Point<double> point_;
  WarmStart warm_;
  Start start_{};
  int trusted_ = 0;                         // steps that are known to be accurate
  double trusted_dt_ = 0.0, wanted_ = 0.0;  // s, their size, and what the error suggests for the next ones
  std::size_t number_ = 1;
  double time_ = 0.0;
  double accumulated_ = 0.0;
  Outcome outcome_;
};

}  // namespace

Outcome follow(const Material& material, const LoadingPath& path, History& history, const FollowOptions& options) {
  return Traveller(material, path, history, options).run();
}

}  // namespace brisance::driver
