#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::specific_heat {

struct SteelGoto {
  static constexpr std::string_view name = "steel_goto";
  static constexpr std::string_view equation = "cp = 92.78 + 0.7454 T + 1.2404e7/T^2,  T >= 200 K, cp in J/(kg K)";
  static constexpr std::string_view source =
      "HY-100 steel of Goto, Garrett, Bingert, Chen & Gray, Metall. Mater. Trans. A 31 (2000) 1985-1996, from about 250 K to "
      "the Curie point, whose peak it leaves out. It stays constant below 200 K, where the last term would diverge.";

  static constexpr auto parameters = std::tuple{};

  template <class Real>
  Real operator()(const Real& temperature) const {
    const Real T = clamp(temperature, 200.0, 1e5);
    return 92.78 + 0.7454 * T + 1.2404e7 / (T * T);
  }
};

}  // namespace brisance::specific_heat
