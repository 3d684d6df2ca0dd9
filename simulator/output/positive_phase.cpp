#include "simulator/output/positive_phase.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace brisance::simulator {

void PositivePhase::add(double time, double overpressure) {
  const Sample next{time, overpressure}, before = std::exchange(last_, next);
  const bool first = !std::exchange(begun_, true);
  const bool rose = overpressure > 0.0, was_above = !first && before.overpressure > 0.0;
  const auto crossing = [&] {
    return before.time + (time - before.time) * (before.overpressure / (before.overpressure - overpressure));
  };
  if (rose) {
    const Sample from = first ? next : was_above ? before : Sample{crossing(), 0.0};
    if (!was_above) now_.rise = {from};
    now_.impulse += 0.5 * (from.overpressure + overpressure) * (time - from.time);
    if (overpressure <= now_.peak) return;
    now_.peak = overpressure;
    now_.rise.push_back(next);
    while (now_.rise.size() > 1 && now_.rise[1].overpressure <= 0.5 * now_.peak) now_.rise.erase(now_.rise.begin());
  } else if (was_above) {
    now_.end = crossing();
    now_.impulse += 0.5 * before.overpressure * (now_.end - before.time);
    if (now_.peak > highest_.peak) highest_ = std::move(now_);
    now_ = {};
  }
}

PositivePhase::Result PositivePhase::result() const {
  const bool goes_on = now_.peak > highest_.peak;
  const Phase& phase = goes_on ? now_ : highest_;
  Result result{phase.peak, 0.0, phase.end, phase.impulse, !goes_on};
  if (phase.rise.empty()) return result;
  const Sample& low = phase.rise[0];
  result.arrival = low.time;
  const double half = 0.5 * phase.peak;
  if (low.overpressure < half)
    result.arrival =
        std::lerp(low.time, phase.rise[1].time, (half - low.overpressure) / (phase.rise[1].overpressure - low.overpressure));
  return result;
}

void PositivePhase::append_to(std::vector<double>& numbers) const {
  numbers.insert(numbers.end(), {begun_ ? 1.0 : 0.0, last_.time, last_.overpressure});
  for (const Phase* phase : {&now_, &highest_}) {
    numbers.insert(numbers.end(), {phase->peak, phase->end, phase->impulse, static_cast<double>(phase->rise.size())});
    for (const Sample& sample : phase->rise) numbers.insert(numbers.end(), {sample.time, sample.overpressure});
  }
}

void PositivePhase::take_from(std::span<const double>& numbers) {
  const auto take = [&] {
    if (numbers.empty()) throw std::runtime_error("its measures are of another case");
    const double number = numbers.front();
    numbers = numbers.subspan(1);
    return number;
  };
  begun_ = take() != 0.0;
  last_.time = take(), last_.overpressure = take();
  for (Phase* phase : {&now_, &highest_}) {
    phase->peak = take(), phase->end = take(), phase->impulse = take();
    phase->rise.clear();
    for (auto left = static_cast<std::size_t>(take()); left > 0; --left) {
      const double time = take();
      phase->rise.push_back({time, take()});
    }
  }
}

}  // namespace brisance::simulator
