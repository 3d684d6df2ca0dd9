#include "simulator/gas/hottest.hpp"

#include <algorithm>

namespace brisance::simulator::gas {

Hottest hottest(const Gas& gas) {
  constexpr double least_part = 1e-3;  // of a cell's volume; what takes less has no weight
  const std::vector<Field> known = fields_of(gas);
  const auto temperature =
      std::find_if(known.begin(), known.end(), [](const Field& field) { return field.name == "temperature"; });
  Hottest found;
  for_each_cell(gas, [&](const CellPlace& at) {
    const HotCell here{temperature->read(gas, at, 0), gas.cells.centre(at.block, at.cell), most_of(gas, at)};
    if (here.temperature > found.of_all.temperature) found.of_all = here;
    if (here.fluid.part >= 1.0 - least_part && !(found.of_one_fluid && here.temperature <= found.of_one_fluid->temperature))
      found.of_one_fluid = here;
  });
  return found;
}

bool is_doubtful(const Hottest& hottest) {
  constexpr double far_hotter = 1.5;
  return hottest.of_one_fluid && hottest.of_all.temperature > far_hotter * hottest.of_one_fluid->temperature;
}

}  // namespace brisance::simulator::gas
