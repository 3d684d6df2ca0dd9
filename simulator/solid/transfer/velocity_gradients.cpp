#include "simulator/parallel.hpp"
#include "simulator/solid/transfer.hpp"
#include "simulator/solid/transfer/cell_means.hpp"
#include "simulator/solid/transfer/referred.hpp"
#include "simulator/solid/transfer/tile.hpp"

namespace brisance::simulator {

namespace {

template <Geometry G, Basis basis>
double gradients(Simulation& s, const TileView& tile, double later) {
  constexpr int D = dimensions_of<G>;
  constexpr bool ring = G == Geometry::axisymmetric;
  constexpr int diagonal[] = {0, D == 3 ? 4 : 3, D == 3 ? 8 : 4};
  using L = Layout<D>;
  using Gradient = std::array<Lanes, L::tensor_components>;
  struct OfEight {
    Gradient gradient;
    std::array<int, 8> cells;
  };
  const auto trace_of = [&](const Gradient& l) { return l[diagonal[0]] + l[diagonal[1]] + l[diagonal[2]]; };
  const double h = s.grid.cell_size;
  std::vector<Lanes> motion = motion_of<D>(s, tile);
  std::vector<OfEight> found;
  Lanes largest_square(0.0);
  for_each_share(s, tile, [&](std::size_t, Body& body, const Bin& bin) {
    Particles& ps = body.particles;
    CellMeans<D> rates;
    found.clear(), found.reserve((bin.end - bin.begin + 7) / 8);
    for_each_eight(body.bins, bin, after_the_next_eight,
                   {{ps.motion, L::Motion::position, D},
                    {ps.load, L::Load::mass, 2},
                    {ps.load, L::Load::half_width, 1},
                    {ps.gradient, 0, L::tensor_components}},
                   [&](const Eight& eight, Requests& requests) {
                     const Columns load(ps.load, eight);
                     const auto x = on_grid(s.grid, read_vector<D>(Columns(ps.motion, eight), L::Motion::position));
                     const Weights<D> w = find_weights<G, basis>(x, load[L::Load::half_width], tile.position, h);
                     const auto grid =
                         VelocityGradients<D>::template gather<ring>(w, nodes_of<D>(body, eight, motion.data()), requests);
                     OfEight& of = found.emplace_back();
                     of.cells = CellMeans<D>::cells(w.nearest);
                     for (std::size_t a = 0; a < D; ++a)
                       for (std::size_t b = 0; b < D; ++b) of.gradient[D * a + b] = grid(a, b);
                     if constexpr (ring) of.gradient[4] = grid.hoop();
                     if (later != 0.0) of.gradient = referred<D>(of.gradient, later);
                     if (body.locking_cure)
                       rates.add(eight, of.cells, load[L::Load::mass] / load[L::Load::density], trace_of(of.gradient));
                   });
    const OfEight* of = found.data();
    for_each_eight(body.bins, bin, [&](const Eight& eight) {
      Gradient l = of->gradient;
      if (body.locking_cure) {
        const Lanes correction = (rates(of->cells) - trace_of(l)) / 3.0;
        for (const int k : diagonal) l[k] += correction;
      }
      Columns to(ps.gradient, eight);
      Lanes square(0.0);
      for (std::size_t k = 0; k < l.size(); ++k) square += l[k] * l[k], to.write(static_cast<int>(k), l[k]);
      constexpr double not_a_number = 1e300;  // is the largest of all
      largest_square = max(largest_square, select(square < not_a_number, square, Lanes(not_a_number)));
      ++of;
    });
  });
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) largest = std::max(largest, std::sqrt(largest_square[i]));
  return largest;
}

}  // namespace

double velocity_gradients(Simulation& s, double later) {
  const Timed timed(s.times, Phase::velocity_gradients);
  std::vector<double> largest(s.grid.my_tiles.size());
  with_kernel(s, [&]<Geometry G, Basis basis>() {
    parallel_for_blocks(largest.size(), [&](std::size_t i) { largest[i] = gradients<G, basis>(s, view(s.grid, i), later); });
  });
  return s.domain->maximum(largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end()));
}

}  // namespace brisance::simulator
