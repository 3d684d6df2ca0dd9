#pragma once

#include <string_view>
#include <tuple>

#include "models/dual.hpp"
#include "models/parameters.hpp"

namespace brisance::yield {

struct VonMises {
  static constexpr std::string_view name = "von_mises";
  static constexpr std::string_view equation = "q = Y";
  static constexpr std::string_view source = "von Mises, Goettinger Nachrichten (1913) 582-592";

  static constexpr auto parameters = std::tuple{};
};

}  // namespace brisance::yield
