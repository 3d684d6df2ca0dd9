#include "simulator/output/extensive.hpp"

#include <array>

namespace brisance::simulator {

Unit unit_of(Extensive quantity, Geometry geometry) {
  using Units = std::array<Unit, 6>;  // of mass, energy, momentum, angular momentum, force, volume
  constexpr Units whole = {Unit::kg, Unit::J, Unit{"N s"}, Unit{"N m s"}, Unit{"N"}, Unit{"m^3"}};
  constexpr Units per_length = {Unit{"kg/m"}, Unit{"J/m"}, Unit{"N s/m"}, Unit{"N m s/m"}, Unit{"N/m"}, Unit{"m^3/m"}};
  constexpr Units per_area = {Unit{"kg/m^2"},    Unit{"J/m^2"}, Unit{"N s/m^2"},
                              Unit{"N m s/m^2"}, Unit{"N/m^2"}, Unit{"m^3/m^2"}};
  const auto number = static_cast<std::size_t>(quantity);
  switch (geometry) {
    case Geometry::plane:
    case Geometry::cylindrical_1d:
      return per_length[number];
    case Geometry::planar_1d:
      return per_area[number];
    default:
      return whole[number];
  }
}

}  // namespace brisance::simulator
