// The closed form of the loss of ellipticity against a search over all directions with the tensors written out, and against
// the published results for special stress states.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "models/stability/stability.hpp"

namespace brisance::stability {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Arguments = stability::Arguments<double>;

// Tensors in components ------------------------------------------------------------------------------------------------

Matrix3d matrix(const SymmetricTensor<double>& s) {
  return (Matrix3d() << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz).finished();
}
SymmetricTensor<double> tensor(const Matrix3d& s) {
  return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1)};
}

Matrix3d normal(const Arguments& at) {
  return at.normal_deviatoric * matrix(at.deviatoric_stress) + at.normal_volumetric * Matrix3d::Identity();
}
Matrix3d elastic(const Arguments& at, const Matrix3d& e) {
  return 2.0 * at.shear_modulus * e + (at.bulk_modulus - 2.0 / 3.0 * at.shear_modulus) * e.trace() * Matrix3d::Identity();
}
double normal_stiffness(const Arguments& at) {
  return normal(at).cwiseProduct(elastic(at, normal(at))).sum();
}

/// Q_ik = m_j C_ijkl m_l, column by column: the traction on m of a displacement gradient e_k m.
template <class Stiffness>
Matrix3d acoustic_tensor(const Vector3d& m, Stiffness&& stiffness) {
  Matrix3d Q;
  for (int k = 0; k < 3; ++k) {
    const Matrix3d gradient = Vector3d::Unit(k) * m.transpose();
    Q.col(k) = stiffness(Matrix3d(0.5 * (gradient + gradient.transpose()))) * m;
  }
  return Q;
}
Matrix3d elastic_acoustic_tensor(const Arguments& at, const Vector3d& m) {
  return acoustic_tensor(m, [&](const Matrix3d& e) { return elastic(at, e); });
}
Matrix3d plastic_acoustic_tensor(const Arguments& at, double Hd, const Vector3d& m) {
  const Matrix3d CN = elastic(at, normal(at));
  const double denominator = normal_stiffness(at) + Hd;
  return acoustic_tensor(
      m, [&](const Matrix3d& e) { return Matrix3d(elastic(at, e) - CN.cwiseProduct(e).sum() / denominator * CN); });
}

/// The modulus at which a band normal to m forms.
double critical_modulus(const Arguments& at, const Vector3d& m) {
  const Vector3d b = elastic(at, normal(at)) * m;
  return b.dot(elastic_acoustic_tensor(at, m).ldlt().solve(b)) - normal_stiffness(at);
}

struct Found {
  double critical_modulus;
  Vector3d normal;
};

/// The largest value over all directions: every two degrees over the hemisphere, then a compass search from the best four.
template <class Modulus>
Found search_all_directions(Modulus&& modulus) {
  static const std::vector<Vector3d> grid = [] {
    std::vector<Vector3d> directions;
    constexpr double step = 2.0 * std::numbers::pi / 180.0;
    for (int i = 0; i <= 45; ++i) {
      const double polar = i * step;
      const int around = std::max(1, static_cast<int>(std::lround(180.0 * std::sin(polar))));
      for (int j = 0; j < around; ++j) {
        const double azimuth = 2.0 * std::numbers::pi * j / around;
        directions.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      }
    }
    return directions;
  }();
  std::vector<Found> found;
  for (const Vector3d& m : grid) found.push_back({modulus(m), m});
  std::partial_sort(found.begin(), found.begin() + 4, found.end(),
                    [](const Found& a, const Found& b) { return a.critical_modulus > b.critical_modulus; });
  found.resize(4);
  for (Found& best : found) {
    for (double step = 0.02; step > 1e-8;) {
      const Vector3d u = best.normal.unitOrthogonal(), v = best.normal.cross(u);
      bool better = false;
      for (int k = 0; k < 8; ++k) {
        const double angle = k * std::numbers::pi / 4.0;
        const Vector3d m = (best.normal + step * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
        if (const double H = modulus(m); H > best.critical_modulus) best = {H, m}, better = true;
      }
      if (!better) step *= 0.5;
    }
  }
  return *std::max_element(found.begin(), found.end(),
                           [](const Found& a, const Found& b) { return a.critical_modulus < b.critical_modulus; });
}

Found search(const Arguments& at) {
  // The same quantity as critical_modulus, with the elastic acoustic tensor inverted once and for all: Qe = G I + (K + G/3) m
  // m.
  const Matrix3d P = elastic(at, normal(at));
  const double G = at.shear_modulus, L = at.bulk_modulus + G / 3.0, stiffness = normal_stiffness(at);
  return search_all_directions([&](const Vector3d& m) {
    const Vector3d b = P * m;
    const double along = m.dot(b);
    return (b.squaredNorm() - along * along * L / (G + L)) / G - stiffness;
  });
}

// Stress states --------------------------------------------------------------------------------------------------------

class RandomStates {
 public:
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  Matrix3d rotation() {
    std::normal_distribution<double> z;
    return Eigen::Quaterniond(z(random_), z(random_), z(random_), z(random_)).normalized().toRotationMatrix();
  }

  /// A deviator with J2 = 1 of any Lode angle; one in five has two equal principal values.
  SymmetricTensor<double> deviator() {
    const double kind = uniform(0.0, 1.0);
    const double lode = kind < 0.1 ? 0.0 : kind < 0.2 ? std::numbers::pi / 3.0 : uniform(0.0, std::numbers::pi / 3.0);
    Vector3d principal;
    for (int i = 0; i < 3; ++i) principal[i] = 2.0 / std::sqrt(3.0) * std::cos(lode - i * 2.0 * std::numbers::pi / 3.0);
    const Matrix3d R = rotation();
    return tensor(R * principal.asDiagonal() * R.transpose());
  }

  Arguments von_mises() {
    const double G = uniform(20e9, 90e9), nu = uniform(0.0, 0.49), q = uniform(0.1e9, 2e9);
    Arguments at;
    at.shear_modulus = G;
    at.bulk_modulus = 2.0 * G * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
    at.deviatoric_stress = (q / std::sqrt(3.0)) * deviator();
    at.yield_stress = q;
    at.normal_deviatoric = 1.5 / q;  // the gradient of q - Y
    return at;
  }

  Arguments gurson() {
    Arguments at = von_mises();
    const double Y = at.yield_stress, q1 = uniform(1.0, 1.6), q2 = uniform(0.9, 1.1), f = uniform(1e-4, 0.9 / q1);
    const double limit = std::acosh((1.0 + q1 * q1 * f * f) / (2.0 * q1 * f)), z = uniform(-0.999, 0.999) * limit;
    const double q = Y * std::sqrt(1.0 + q1 * q1 * f * f - 2.0 * q1 * f * std::cosh(z));
    at.deviatoric_stress = (q / Y) * at.deviatoric_stress;
    at.normal_deviatoric = 3.0 / (Y * Y);  // the gradient of Phi
    at.normal_volumetric = q1 * q2 * f / Y * std::sinh(z);
    return at;
  }

 private:
  std::mt19937_64 random_{20250101};
};

Arguments von_mises(const SymmetricTensor<double>& deviator) {
  Arguments at;
  at.shear_modulus = 77e9, at.bulk_modulus = 140e9;
  at.deviatoric_stress = deviator;
  at.yield_stress = equivalent_stress(deviator);
  at.normal_deviatoric = 1.5 / at.yield_stress;
  return at;
}

constexpr double round_off = 1e-14;  // relative to N:Ce:N; some fifty operations

// Principal values ------------------------------------------------------------------------------------------------------

TEST(PrincipalValues, AreExactUpToRoundOffHoweverCloseTwoOfThemAre) {
  RandomStates random;
  constexpr double tolerance = 3e-15;  // the rotation of the test itself leaves 1e-15
  for (int i = 0; i < 4000; ++i) {
    const double gap = i % 10 == 0 ? 0.0 : std::pow(10.0, random.uniform(-17.0, 0.0)), side = i % 2 == 0 ? 1.0 : -1.0;
    Vector3d expected(2.0 * side, side * (-1.0 + 1.5 * gap), side * (-1.0 - 1.5 * gap));
    const Matrix3d R = i % 3 == 0 ? Matrix3d(Matrix3d::Identity()) : random.rotation();
    const double scale = std::pow(10.0, random.uniform(-10.0, 10.0));
    const auto found = principal_values(tensor(scale * R * expected.asDiagonal() * R.transpose()));
    std::sort(expected.data(), expected.data() + 3);
    EXPECT_NEAR(found.major / scale, expected[2], tolerance);
    EXPECT_NEAR(found.middle / scale, expected[1], tolerance);
    EXPECT_NEAR(found.minor / scale, expected[0], tolerance);
  }
}

TEST(PrincipalValues, OfNoStressAreZero) {
  const auto found = principal_values(SymmetricTensor<double>{});
  EXPECT_NEAR(found.major, 0.0, 1e-90);
  EXPECT_NEAR(found.middle, 0.0, 1e-90);
  EXPECT_NEAR(found.minor, 0.0, 1e-90);
}

// Loss of ellipticity ---------------------------------------------------------------------------------------------------

TEST(AcousticTensor, ElasticWavesTravelWithTheirThreeModuli) {
  RandomStates random;
  const Arguments at = random.von_mises();
  const Vector3d m = random.rotation().col(0);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> waves(elastic_acoustic_tensor(at, m));
  const double G = at.shear_modulus, longitudinal = at.bulk_modulus + 4.0 / 3.0 * G;
  EXPECT_NEAR(waves.eigenvalues()[0] / G, 1.0, round_off);
  EXPECT_NEAR(waves.eigenvalues()[1] / G, 1.0, round_off);
  EXPECT_NEAR(waves.eigenvalues()[2] / longitudinal, 1.0, round_off);
}

TEST(AcousticTensor, SearchFindsTheModulusAtWhichTheDeterminantVanishes) {
  // Ties the scalar that the search maximises to the determinant of the full tensor.
  RandomStates random;
  for (int i = 0; i < 20; ++i) {
    const Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    const Vector3d m = random.rotation().col(0);
    const double Hd = critical_modulus(at, m), stiffness = normal_stiffness(at);
    const double elastic_determinant = elastic_acoustic_tensor(at, m).determinant();
    EXPECT_NEAR(plastic_acoustic_tensor(at, Hd, m).determinant() / elastic_determinant, 0.0, 1e-12);
    const double slope = (plastic_acoustic_tensor(at, Hd + 1e-3 * stiffness, m).determinant()) / elastic_determinant;
    EXPECT_GT(slope, 0.0);
  }
}

template <class Draw>
void expect_closed_form_equals_search(Draw&& draw, int states, int& oblique, int& aligned) {
  constexpr double tolerance = 1e-8;  // of N:Ce:N; the search stops at 1e-8 of a radian, where the maximum is flat
  for (int i = 0; i < states; ++i) {
    const Arguments at = draw();
    const double stiffness = normal_stiffness(at);
    const Found found = search(at);
    const Localisation<double> closed = localisation(at);
    ASSERT_NEAR(closed.critical_modulus / stiffness, found.critical_modulus / stiffness, tolerance) << "state " << i;
    // The search uses the inverse written out; the elimination agrees at the normal found.
    ASSERT_NEAR(critical_modulus(at, found.normal) / stiffness, found.critical_modulus / stiffness, 1e-11) << "state " << i;
    ++(closed.major_part > 0.0 && closed.major_part < 1.0 ? oblique : aligned);
  }
}

TEST(AcousticTensor, EqualsTheSearchForVonMises) {
  RandomStates random;
  int oblique = 0, aligned = 0;
  expect_closed_form_equals_search([&] { return random.von_mises(); }, 1000, oblique, aligned);
  EXPECT_GT(oblique, 100);
}

TEST(AcousticTensor, EqualsTheSearchForGursonTvergaardNeedleman) {
  RandomStates random;
  int oblique = 0, aligned = 0;
  expect_closed_form_equals_search([&] { return random.gurson(); }, 1000, oblique, aligned);
  EXPECT_GT(oblique, 100);
  EXPECT_GT(aligned, 100);  // high triaxiality: the band opens across the largest stress
}

TEST(AcousticTensor, EqualsRudnickiAndRiceWhereTheNormalIsOblique) {
  // h/G = -(1 + nu)/2 [N + 2 beta/3]^2 for beta = mu, with h = Hd/(2 a tau)^2 for a normal a s + b I, beta = 3 b/(2 a tau).
  RandomStates random;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    const Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    const Localisation<double> closed = localisation(at);
    if (!(closed.major_part > 1e-6 && closed.major_part < 1.0 - 1e-6)) continue;
    ++compared;
    const double G = at.shear_modulus, K = at.bulk_modulus, nu = (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(matrix(at.deviatoric_stress));
    const double tau = std::sqrt(0.5 * double_dot(at.deviatoric_stress, at.deviatoric_stress));
    const double scale = 2.0 * at.normal_deviatoric * tau, beta = 3.0 * at.normal_volumetric / scale;
    const double sum = principal.eigenvalues()[1] / tau + 2.0 * beta / 3.0;
    const double expected = -0.5 * G * (1.0 + nu) * sum * sum * scale * scale;
    ASSERT_NEAR(closed.critical_modulus / normal_stiffness(at), expected / normal_stiffness(at), 1e-13) << "state " << i;
  }
  EXPECT_GT(compared, 300);
}

TEST(AcousticTensor, UniaxialTensionLocalisesAtMinusAQuarterOfYoungsModulus) {
  const Arguments at = von_mises({2e8, -1e8, -1e8, 0.0, 0.0, 0.0});
  const double E = 9.0 * at.bulk_modulus * at.shear_modulus / (3.0 * at.bulk_modulus + at.shear_modulus);
  EXPECT_NEAR(localisation(at).critical_modulus / E, -0.25, round_off);
}

TEST(AcousticTensor, PureShearLocalisesAtThePeakOnPlanesAt45Degrees) {
  const Localisation<double> shear = localisation(von_mises({0.0, 0.0, 0.0, 0.0, 0.0, 3e8}));
  EXPECT_NEAR(shear.critical_modulus / 77e9, 0.0, round_off);
  EXPECT_NEAR(shear.major_part, 0.5, round_off);  // cos^2 45 degrees
}

TEST(AcousticTensor, TheNormalOfTheClosedFormIsThatOfTheSearch) {
  RandomStates random;
  for (int i = 0; i < 100; ++i) {
    const Arguments at = random.gurson();
    const Localisation<double> closed = localisation(at);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(matrix(at.deviatoric_stress));
    const Vector3d values = principal.eigenvalues();
    if (std::min(values[2] - values[1], values[1] - values[0]) < 0.05 * (values[2] - values[0])) continue;  // axis not unique
    const double cosine = search(at).normal.dot(principal.eigenvectors().col(2));
    EXPECT_NEAR(cosine * cosine, closed.major_part, 1e-5) << i;  // the maximum is flat: the root of 1e-8 and less
  }
}

TEST(AcousticTensor, HydrostaticTensionLosesEllipticityInAllDirectionsAtOnce) {
  Arguments at;
  at.shear_modulus = 80e9, at.bulk_modulus = 160e9, at.yield_stress = 1e9;
  at.normal_deviatoric = 3e-18, at.normal_volumetric = 1e-10;
  // b.Qe^-1.b = (3 K b)^2/(K + 4G/3)
  const double K = 160e9, b = 1e-10, L = K + 4.0 / 3.0 * 80e9;
  EXPECT_NEAR(localisation(at).critical_modulus / (9.0 * K * b * b), K / L - 1.0, round_off);
  EXPECT_NEAR(search(at).critical_modulus / (9.0 * K * b * b), K / L - 1.0, round_off);
}

// Finite stress ----------------------------------------------------------------------------------------------------------

/// Column by column the rate of the traction on m, from the rate of the first Piola-Kirchhoff stress P' = tau' - sig L^T, where
/// Jaumann's rate of the Kirchhoff stress is elastic, tau' = Ce:D + W sig - sig W, in the motion L = e_k m.
Matrix3d acoustic_tensor_under_stress(const Arguments& at, const Vector3d& m) {
  const Matrix3d sig = matrix(at.deviatoric_stress) + at.mean_stress * Matrix3d::Identity();
  Matrix3d Q;
  for (int k = 0; k < 3; ++k) {
    const Matrix3d L = Vector3d::Unit(k) * m.transpose(), D = 0.5 * (L + L.transpose()), W = L - D;
    Q.col(k) = (elastic(at, D) + W * sig - sig * W - sig * L.transpose()) * m;
  }
  return Q;
}

TEST(AcousticTensorUnderStress, EqualsTheSearchOverAllDirections) {
  RandomStates random;
  for (int i = 0; i < 200; ++i) {
    Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    at.mean_stress = random.uniform(-2.0, 2.0) * at.yield_stress;
    const Matrix3d P = elastic(at, normal(at));
    const double stiffness = normal_stiffness(at);
    const Found found = search_all_directions([&](const Vector3d& m) {
      const Vector3d b = P * m;
      return b.dot(acoustic_tensor_under_stress(at, m).inverse() * b) - stiffness;
    });
    const double closed = localisation_under_finite_stress(at).critical_modulus;
    constexpr double tolerance = 1e-8;  // of N:Ce:N, as without stress
    EXPECT_NEAR(closed / stiffness, found.critical_modulus / stiffness, tolerance) << "state " << i;
    EXPECT_NEAR(AcousticTensor{true}(at), (at.plastic_modulus - closed) / stiffness, round_off);
  }
}

/// Hill & Hutchinson, J. Mech. Phys. Solids 23 (1975) 239-264: an incompressible body in plane strain, sheared with the modulus
/// G across and G* along the axes of stress, has no bands as long as 2 G* > G - sqrt(G^2 - (sig/2)^2), sig the difference of
/// the principal stresses. With the normal to the surface of von Mises G* = G H/(3 G + H): bands form before the peak.
TEST(AcousticTensorUnderStress, FormsBandsInPlaneStrainWhereHillAndHutchinsonSay) {
  for (const double shear : {0.01, 0.1, 0.3}) {  // sig/2 over G
    for (const double mean : {-0.2, 0.0, 0.2}) {
      const double G = 77e9, tau = shear * G;
      Arguments at = von_mises({tau, -tau, 0.0, 0.0, 0.0, 0.0});
      constexpr double incompressible = 1e7;  // K over G: compressibility changes the result by about the inverse
      at.bulk_modulus = incompressible * G, at.mean_stress = mean * G;
      const double x = 0.5 * (1.0 - std::sqrt(1.0 - shear * shear)), H = 3.0 * G * x / (1.0 - x);
      constexpr double tolerance = 1e-6;  // of G; what K leaves, and round-off that K has multiplied
      EXPECT_NEAR(localisation_under_finite_stress(at).critical_modulus / G, H / G, tolerance) << shear << ' ' << mean;
    }
  }
}

TEST(AcousticTensorUnderStress, IsTheSmallStrainFormWithoutStress) {
  RandomStates random;
  for (int i = 0; i < 200; ++i) {
    Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    const double expected = AcousticTensor{}(at);
    // The same normal, of a stress a billion times smaller.
    at.deviatoric_stress = 1e-9 * at.deviatoric_stress, at.normal_deviatoric *= 1e9;
    EXPECT_NEAR(AcousticTensor{true}(at), expected, 1e-9) << i;
  }
}

TEST(AcousticTensor, MarginChangesSignWhereTheDeterminantDoes) {
  RandomStates random;
  for (int i = 0; i < 200; ++i) {
    Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    const Found found = search(at);
    const double stiffness = normal_stiffness(at);
    for (double excess : {1e-6, 1e-3, -1e-3, -1e-6}) {
      at.plastic_modulus = found.critical_modulus + excess * stiffness;
      const double determinant = plastic_acoustic_tensor(at, at.plastic_modulus, found.normal).determinant();
      EXPECT_EQ(AcousticTensor{}(at) > 0.0, excess > 0.0);
      EXPECT_EQ(determinant > 0.0, excess > 0.0);
    }
  }
}

TEST(AcousticTensor, MarginDoesNotDependOnTheScaleOfTheNormal) {
  RandomStates random;
  Arguments at = random.gurson();
  at.plastic_modulus = 0.1 * normal_stiffness(at);
  const double margin = AcousticTensor{}(at);
  at.normal_deviatoric *= 1e9, at.normal_volumetric *= 1e9, at.plastic_modulus *= 1e18;
  EXPECT_NEAR(AcousticTensor{}(at), margin, round_off);
}

TEST(AcousticTensor, IsTheSameInLanes) {
  RandomStates random;
  std::array<Arguments, 8> points;
  stability::Arguments<Lanes> at;
  for (int i = 0; i < 8; ++i) {
    points[i] = i % 2 == 0 ? random.von_mises() : random.gurson();
    points[i].mean_stress = 0.1 * i * points[i].yield_stress;
    at.mean_stress.set(i, points[i].mean_stress);
    at.shear_modulus.set(i, points[i].shear_modulus), at.bulk_modulus.set(i, points[i].bulk_modulus);
    at.normal_deviatoric.set(i, points[i].normal_deviatoric), at.normal_volumetric.set(i, points[i].normal_volumetric);
    for_each_component([i](Lanes& lane, double s) { lane.set(i, s); }, at.deviatoric_stress, points[i].deviatoric_stress);
  }
  for (const bool finite_stress : {false, true}) {
    const AcousticTensor law{finite_stress};
    const Lanes margin = law(at);
    for (int i = 0; i < 8; ++i) EXPECT_NEAR(margin[i], law(points[i]), round_off);
  }
}

// Drucker ----------------------------------------------------------------------------------------------------------------

TEST(Drucker, FiresExactlyAtThePeakOfTheAdiabaticCurve) {
  Arguments at = von_mises({2e8, -1e8, -1e8, 0.0, 0.0, 0.0});
  at.plastic_modulus = 0.0;
  EXPECT_EQ(Drucker{.tolerance = 0.0}(at), 0.0);
  at.plastic_modulus = 1.0;  // Pa
  EXPECT_GT(Drucker{.tolerance = 0.0}(at), 0.0);
  at.plastic_modulus = -1.0;
  EXPECT_LT(Drucker{.tolerance = 0.0}(at), 0.0);
}

TEST(Drucker, ToleranceIsAPartOfThreeShearModuliForVonMises) {
  Arguments at = von_mises({2e8, -1e8, -1e8, 0.0, 0.0, 0.0});
  at.plastic_modulus = 3.0 * at.shear_modulus * 0.01;
  EXPECT_NEAR(Drucker{.tolerance = 0.01}(at), 0.0, round_off);
}

TEST(Drucker, NeverFiresAfterTheAcousticTensor) {
  RandomStates random;
  for (int i = 0; i < 2000; ++i) {
    Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    at.plastic_modulus = random.uniform(-0.5, 0.5) * normal_stiffness(at);
    EXPECT_GE(AcousticTensor{}(at), Drucker{.tolerance = 0.0}(at)-round_off);
  }
}

TEST(Stability, AnElasticPointIsStable) {
  Arguments at = von_mises({2e8, -1e8, -1e8, 0.0, 0.0, 0.0});
  at.normal_deviatoric = 0.0, at.plastic_modulus = -1e9;
  EXPECT_GT(AcousticTensor{}(at), 0.0);
  EXPECT_GT(Drucker{.tolerance = 0.0}(at), 0.0);
}

// Plane strain -----------------------------------------------------------------------------------------------------------

/// det Q/cos^4 of in-plane normals (cos, sin) as a polynomial in the tangent, of a stiffness in the order 11, 22, 12.
std::array<double, 5> quartic(const Matrix3d& D) {
  return {D(0, 0) * D(2, 2) - D(0, 2) * D(2, 0), D(0, 0) * (D(1, 2) + D(2, 1)) - D(0, 2) * D(1, 0) - D(2, 0) * D(0, 1),
          D(0, 0) * D(1, 1) + D(0, 2) * D(2, 1) + D(2, 0) * D(1, 2) - D(0, 1) * D(2, 2) - D(1, 0) * D(2, 2) - D(0, 1) * D(1, 0),
          D(1, 1) * (D(0, 2) + D(2, 0)) - D(0, 1) * D(1, 2) - D(2, 1) * D(1, 0), D(1, 1) * D(2, 2) - D(1, 2) * D(2, 1)};
}
double evaluate(const std::array<double, 5>& a, double t) {
  return a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * a[4])));
}

TEST(PlaneStrain, DeterminantOfAnInPlaneNormalIsAQuarticInItsTangent) {
  RandomStates random;
  for (int i = 0; i < 1000; ++i) {
    Matrix3d D;
    for (double& entry : D.reshaped()) entry = random.uniform(-1.0, 1.0);
    const double angle = random.uniform(-1.5, 1.5), c = std::cos(angle), s = std::sin(angle);
    const Eigen::Matrix<double, 3, 2> m{{c, 0.0}, {0.0, s}, {s, c}};
    const double determinant = Eigen::Matrix2d(m.transpose() * D * m).determinant();
    EXPECT_NEAR(evaluate(quartic(D), s / c) * c * c * c * c, determinant, 1e-12);
  }
}

TEST(PlaneStrain, QuarticHasItsDoubleRootAtTheClosedForm) {
  // Where the out-of-plane axis carries the middle stress the worst normal lies in the plane, and the quartic just touches
  // zero.
  RandomStates random;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    Arguments at = i % 2 == 0 ? random.von_mises() : random.gurson();
    const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(matrix(at.deviatoric_stress));
    const Vector3d s = principal.eigenvalues();
    at.deviatoric_stress = {s[2], s[0], s[1], 0.0, 0.0, 0.0};
    const Localisation<double> closed = localisation(at);
    if (!(closed.major_part > 0.01 && closed.major_part < 0.99)) continue;
    ++compared;
    const auto stiffness = [&](double Hd) {
      const Matrix3d CN = elastic(at, normal(at));
      const double G = at.shear_modulus, lambda = at.bulk_modulus - 2.0 / 3.0 * G, denominator = normal_stiffness(at) + Hd;
      const Matrix3d Ce{{lambda + 2.0 * G, lambda, 0.0}, {lambda, lambda + 2.0 * G, 0.0}, {0.0, 0.0, G}};
      const Vector3d c(CN(0, 0), CN(1, 1), CN(0, 1));
      return Matrix3d(Ce - c * c.transpose() / denominator);
    };
    const double t = std::sqrt((1.0 - closed.major_part) / closed.major_part);
    const auto a = quartic(stiffness(closed.critical_modulus));
    const double G = at.shear_modulus, size = G * (at.bulk_modulus + 4.0 / 3.0 * G) * std::pow(1.0 + t * t, 2);  // det Qe/cos^4
    EXPECT_NEAR(evaluate(a, t) / size, 0.0, 1e-12) << i;
    EXPECT_NEAR(evaluate(a, -t) / size, 0.0, 1e-12) << i;
    const auto harder = quartic(stiffness(closed.critical_modulus + 1e-3 * normal_stiffness(at)));
    for (int k = -89; k < 90; ++k) ASSERT_GT(evaluate(harder, std::tan(k * std::numbers::pi / 180.0)), 0.0);
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace brisance::stability
