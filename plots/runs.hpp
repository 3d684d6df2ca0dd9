#pragma once
// What the figures share: materials, loading paths, and the columns of a run.

#include <filesystem>
#include <numbers>
#include <string_view>
#include <vector>

#include "driver/follow.hpp"
#include "driver/plot.hpp"
#include "models/interpolate.hpp"

namespace brisance::plots {

/// The folder with materials, cases and experiments.
std::filesystem::path data_folder();

/// A material of the data folder, without its failure criteria: a figure shows the whole curve.
Material read(std::string_view name);

/// Axial strain rate (1/s, negative in compression) with free sides, until a plastic strain.
driver::LoadingPath uniaxial_stress(double strain_rate, double temperature, double plastic_strain);

/// Extension along x at a strain rate (1/s) with the volume kept, until a plastic strain.
driver::LoadingPath constant_volume(double strain_rate, double temperature, double plastic_strain);

/// Mean stress over equivalent stress kept, and the Lode angle (degrees: 0 in axial tension, 30 in shear), until a plastic
/// strain; the rate is the one conjugate to the equivalent stress.
driver::LoadingPath constant_triaxiality(double triaxiality, double lode_angle, double strain_rate, double temperature,
                                         double plastic_strain);

struct Run {
  driver::Record record;
  driver::Outcome outcome;

  const std::vector<double>& operator[](std::string_view column) const;
};

/// Every step of the point's way along the path.
Run follow(const Material& material, const driver::LoadingPath& path);

/// A curve of at most `most` of these points, times factors.
Curve curve(std::string title, const std::vector<double>& x, const std::vector<double>& y, double x_factor, double y_factor,
            Mark mark, int colour, std::size_t most = 300);

/// n + 1 numbers from first to last.
std::vector<double> evenly(double first, double last, int n);

inline constexpr double mega = 1e6, giga = 1e9, degrees = 180.0 / std::numbers::pi;

}  // namespace brisance::plots
