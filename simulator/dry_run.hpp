#pragma once
// What a run would take, and what looks wrong with it, before it is begun.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/gas/fill_reports.hpp"
#include "simulator/simulation.hpp"

namespace brisance::simulator {

struct DryRun {
  struct Points {
    std::string name;
    std::int64_t count;
    std::string_view kind;  // "particles" of a body, "cells" of the gas
  };
  std::vector<Points> points;
  std::vector<gas::FillReport> fills;
  double megabytes = 0.0;
  double first_step = 0.0;   // s
  std::string limit;         // what the first step is limited by
  double steps = 0.0;        // an estimate: of solids as if the steps stayed as those taken, of gas by step_estimate.hpp
  double nanoseconds = 0.0;  // per particle or cell and step, of a few steps taken; 0: the first was rejected
  double hours = 0.0;
  std::vector<std::string> warnings;
};

/// Takes a few steps with a simulation that has been set up from the case.
DryRun dry_run(const Case& c, Simulation& s);

}  // namespace brisance::simulator
