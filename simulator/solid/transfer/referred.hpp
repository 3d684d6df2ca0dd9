#pragma once
// Velocity gradients with respect to places at another time of the step.

#include "models/tensor.hpp"
#include "simulator/solid/packs.hpp"

namespace brisance::simulator {

/// A velocity gradient with respect to places x as one with respect to x + t v(x). Its components as the columns of tensors; an
/// affine field in the plane has none across it.
template <int D, std::size_t components>
[[gnu::flatten]] std::array<Lanes, components> referred(const std::array<Lanes, components>& l, double t) {
  Tensor<Lanes> L;
  if constexpr (D == 3) {
    L = {l[0], l[1], l[2], l[3], l[4], l[5], l[6], l[7], l[8]};
  } else {
    L.xx = l[0], L.xy = l[1], L.yx = l[2], L.yy = l[3];
    if constexpr (components == 5) L.zz = l[4];
  }
  L = L * inverse(Tensor<Lanes>::identity() + Lanes(t) * L);
  if constexpr (D == 3)
    return {L.xx, L.xy, L.xz, L.yx, L.yy, L.yz, L.zx, L.zy, L.zz};
  else if constexpr (components == 5)
    return {L.xx, L.xy, L.yx, L.yy, L.zz};
  else
    return {L.xx, L.xy, L.yx, L.yy};
}

}  // namespace brisance::simulator
