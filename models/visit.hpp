#pragma once
// A component of a material may be chosen at run time (a variant), absent (an empty optional), or fixed when the program is
// compiled (the law itself). Kernels are written once for all three.

#include <optional>
#include <variant>
#include <vector>

namespace brisance {

template <class Law>
constexpr bool is_present(const Law&) {
  return true;
}
template <class Law>
bool is_present(const std::optional<Law>& law) {
  return law.has_value();
}

/// Calls f(law) with the concrete law, once; not at all when the component is absent.
template <class Law, class F>
void visit_law(const Law& law, F&& f) {
  f(law);
}
template <class... Laws, class F>
void visit_law(const std::variant<Laws...>& law, F&& f) {
  std::visit(f, law);
}
template <class Law, class F>
void visit_law(const std::optional<Law>& law, F&& f) {
  if (law) visit_law(*law, f);
}

}  // namespace brisance
