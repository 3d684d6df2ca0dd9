#pragma once
// What must hold of the gas of a case file beyond the single value. Each check reports what is wrong to the table it stands in.
// `c` is the case as far as it has been read: its gas as far as it precedes what is checked. Each check is done if what it
// rests on is valid, whatever else is wrong.

#include <string>
#include <string_view>
#include <vector>

#include "models/input/table_reader.hpp"
#include "simulator/config.hpp"

namespace brisance::simulator::gas {

/// One of a list of tables; `others` stand before it. What can be taken for granted is filled in: the only fluid.
void check(TableReader& in, FluidConfig& fluid, const std::vector<FluidConfig>& others, const Case& c);
void check(TableReader& in, FillConfig& fill, const std::vector<FillConfig>& others, const Case& c);
void check(TableReader& in, EdgeConfig& edge, const std::vector<EdgeConfig>& others, const Case& c);
void check(TableReader& in, IgnitionConfig& ignition, const std::vector<IgnitionConfig>& others, const Case& c);
void check(TableReader& in, ReactionConfig& reaction, const std::vector<ReactionConfig>& others, const Case& c);
void check(TableReader& in, GasBodyConfig& body, const std::vector<GasBodyConfig>& others, const Case& c);

/// [gas] as a whole.
void check_gas(TableReader& in, const Case& c);

/// A gauge in gas: it stands still.
void check_gauge(TableReader& in, GaugeConfig& gauge, const Case& c);
void check_fields(TableReader& in, const std::vector<std::string>& fields, const Case& c, std::string_view key = "fields");
void check_in_box(TableReader& in, const Vector& from, const Vector& to, const Case& c);

}  // namespace brisance::simulator::gas
