// The exponential, the polar decomposition of an increment and that of a whole deformation gradient, against Eigen and against
// closed forms.

#include "models/kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace brisance {
namespace {

// A few units of round-off: the 3x3 products behind each result have some ten roundings per component.
constexpr double round_off = 4e-15;
// The strain of a small increment is a difference of V^2 and I; that costs one round-off of I.
constexpr double strain_round_off = 2e-15;
// Eigen's singular values and eigenvectors are themselves good to some units of round-off.
constexpr double reference_round_off = 2e-14;
constexpr int cases = 2000;

Eigen::Matrix3d eigen(const Tensor<double>& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz;
  return m;
}
Tensor<double> tensor(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}
double distance(const Tensor<double>& a, const Eigen::Matrix3d& b) {
  return (eigen(a) - b).norm();
}
double distance(const Tensor<double>& a, const Tensor<double>& b) {
  return norm(a - b);
}

/// Of the whole increment; the function takes what it has beyond the identity.
PolarIncrement<double> polar_of(const Tensor<double>& dF) {
  return polar_increment(dF - Tensor<double>::identity());
}

class Random {
 public:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  /// |A| = size.
  Tensor<double> of_size(double size) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = uniform(-1.0, 1.0);
    return tensor(m * (size / m.norm()));
  }
  Eigen::Matrix3d rotation() {
    return Eigen::AngleAxisd(uniform(0.0, M_PI), Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized())
        .toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_{20260301};
};

/// The power series to 80 terms in long double.
Tensor<double> long_series(const Tensor<double>& A) {
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  const Matrix a = eigen(A).cast<long double>();
  Matrix sum = Matrix::Identity(), term = sum;
  for (int k = 1; k <= 80; ++k) {
    term = term * a / static_cast<long double>(k);
    sum += term;
  }
  return tensor(sum.cast<double>());
}

Eigen::Matrix3d exponential_of_symmetric(const Eigen::Matrix3d& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(A);
  return solver.eigenvectors() * solver.eigenvalues().array().exp().matrix().asDiagonal() * solver.eigenvectors().transpose();
}

TEST(Exponential, EqualsTheLongPowerSeriesUpToItsLimit) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Tensor<double> A = random.of_size(random.uniform(0.0, 0.5));
    ASSERT_LE(distance(exponential(A), long_series(A)), round_off) << "|A| = " << norm(A);
  }
}

TEST(Exponential, OfASymmetricTensorHasItsAxesAndTheExponentialsOfItsPrincipalValues) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Tensor<double> A = to_tensor(symmetric_part(random.of_size(random.uniform(0.0, 0.5))));
    ASSERT_LE(distance(exponential(A), exponential_of_symmetric(eigen(A))), reference_round_off);
  }
}

TEST(Exponential, LosesAccuracyBeyondItsLimitOnlyAsDocumented) {
  constexpr double documented = 1e-9, size = 1.2;
  Random random;
  double worst = 0.0;
  for (int i = 0; i < cases; ++i) {
    const Tensor<double> A = random.of_size(size);
    worst = std::max(worst, distance(exponential(A), long_series(A)));
  }
  EXPECT_LE(worst, documented);
  EXPECT_GT(worst, round_off) << "the limit could be raised";
}

TEST(Exponential, OfASmallTensorLessTheIdentityKeepsAllItsDigits) {
  Random random;
  for (const double size : {1e-12, 1e-8, 1e-4, 1e-2}) {
    const Tensor<double> A = random.of_size(size);
    const Tensor<double> A2 = A * A;
    const Tensor<double> expected = A + 0.5 * A2 + (1.0 / 6.0) * (A2 * A) + (1.0 / 24.0) * (A2 * A2) +
                                    (1.0 / 120.0) * (A2 * A2 * A) + (1.0 / 720.0) * (A2 * A2 * A2);
    EXPECT_LE(distance(exponential_minus_identity(A), expected), round_off * size);
  }
}

TEST(Exponential, IsAsGoodOnBothSidesOfTheSwitchToTheLongSum) {
  Random random;
  for (const double size : {0.0299, 0.0301}) {
    const Tensor<double> A = random.of_size(size);
    EXPECT_LE(distance(exponential(A), long_series(A)), round_off) << size;
  }
}

TEST(Exponential, KeepsVolumeAsTheTraceDemands) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Tensor<double> A = random.of_size(random.uniform(0.0, 0.5));
    ASSERT_NEAR(determinant(exponential(A)), std::exp(trace(A)), 2.0 * round_off);
    const Tensor<double> isochoric = A - (trace(A) / 3.0) * Tensor<double>::identity();
    ASSERT_NEAR(determinant(exponential(isochoric)), 1.0, 2.0 * round_off);
  }
}

TEST(Exponential, OfASpinIsARotationByItsAngle) {
  for (const double angle : {1e-8, 1e-3, 0.1, 0.35}) {
    Tensor<double> W;
    W.xy = -angle, W.yx = angle;
    const Tensor<double> R = exponential(W);
    EXPECT_NEAR(R.xx, std::cos(angle), round_off);
    EXPECT_NEAR(R.yx, std::sin(angle), round_off * angle + 1e-16);
    EXPECT_NEAR(R.zz, 1.0, round_off);
  }
}

TEST(PolarIncrement, EqualsTheSingularValueDecomposition) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    // V^2 - I up to the limit of the series; rotations of any angle.
    const Eigen::Matrix3d stretch = eigen(random.of_size(1.0));
    const Eigen::Matrix3d direction = (0.5 * (stretch + stretch.transpose())).normalized();
    const double size = random.uniform(0.0, 0.12);
    const Eigen::Matrix3d V = exponential_of_symmetric(size * direction), R = random.rotation();
    const PolarIncrement<double> polar = polar_of(tensor(V * R));
    ASSERT_LE(polar.size, 0.3);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(V * R, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d U = svd.matrixU();
    ASSERT_LE(distance(polar.rotation, U * svd.matrixV().transpose()), reference_round_off);
    const Eigen::Matrix3d log_V = U * svd.singularValues().array().log().matrix().asDiagonal() * U.transpose();
    ASSERT_LE(distance(to_tensor(polar.strain), log_V), reference_round_off);
    ASSERT_LE(distance(to_tensor(polar.strain), size * direction), reference_round_off);
  }
}

TEST(PolarIncrement, SizeIsTheNormOfVSquaredLessOne) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d F = eigen(exponential(random.of_size(0.4)));
    ASSERT_NEAR(polar_of(tensor(F)).size, (F * F.transpose() - Eigen::Matrix3d::Identity()).norm(), round_off);
  }
}

TEST(PolarIncrement, KeepsTheDigitsOfASmallStrain) {
  // ln V of exp(A) with A symmetric is A, however small: only that, and not I + A, is rounded.
  Random random;
  for (const double size : {1e-12, 1e-8, 1e-4, 3e-3, 5e-3, 0.05}) {
    const SymmetricTensor<double> A = symmetric_part(random.of_size(size));
    const PolarIncrement<double> polar = polar_increment(exponential_minus_identity(to_tensor(A)));
    EXPECT_LE(norm(polar.strain - A), round_off * size) << size;
  }
}

TEST(PolarIncrement, IsAsGoodOnBothSidesOfTheSwitchToTheLongSum) {
  constexpr double switch_size = 0.004;
  for (const double size : {0.999 * switch_size, 1.001 * switch_size, 0.299}) {
    Tensor<double> F = Tensor<double>::identity();
    F.xx = std::sqrt(1.0 + size);
    const PolarIncrement<double> polar = polar_of(F);
    EXPECT_NEAR(polar.strain.xx, 0.5 * std::log1p(size), strain_round_off) << size;
    EXPECT_NEAR(polar.rotation.xx, 1.0, round_off) << size;
    F.xx = std::sqrt(1.0 - size);
    EXPECT_NEAR(polar_of(F).strain.xx, 0.5 * std::log1p(-size), strain_round_off) << size;
  }
}

TEST(PolarIncrement, OfAPureRotationHasNoStrain) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Eigen::Matrix3d R = random.rotation();
    const PolarIncrement<double> polar = polar_of(tensor(R));
    ASSERT_LE(norm(polar.strain), strain_round_off);
    ASSERT_LE(distance(polar.rotation, R), round_off);
  }
}

TEST(PolarIncrement, TraceOfTheStrainIsTheLogarithmOfTheVolumeRatio) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Tensor<double> A = random.of_size(random.uniform(0.0, 0.13));
    const PolarIncrement<double> polar = polar_of(exponential(A));
    ASSERT_NEAR(trace(polar.strain), trace(A), round_off);
  }
}

TEST(PolarIncrement, RotatesWithTheFrame) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Eigen::Matrix3d Q = random.rotation(), F = eigen(exponential(random.of_size(0.1)));
    const PolarIncrement<double> at_rest = polar_of(tensor(F)), turned = polar_of(tensor(Q * F));
    ASSERT_LE(distance(turned.rotation, Q * eigen(at_rest.rotation)), round_off);
    ASSERT_LE(distance(to_tensor(turned.strain), to_tensor(rotate(tensor(Q), at_rest.strain))), round_off);
  }
}

TEST(PolarRotation, EqualsTheSingularValueDecompositionOfLargeDeformations) {
  Random random;
  for (int i = 0; i < cases; ++i) {
    const Eigen::Vector3d stretches(std::exp(random.uniform(-1.5, 1.5)), std::exp(random.uniform(-1.5, 1.5)),
                                    std::exp(random.uniform(-1.5, 1.5)));
    const Eigen::Matrix3d Q = random.rotation(), R = random.rotation();
    const Eigen::Matrix3d F = R * Q * stretches.asDiagonal() * Q.transpose();
    const Tensor<double> found = polar_rotation(tensor(F));
    // The decomposition is as ill-conditioned as the two least stretches are small.
    const double condition = stretches.maxCoeff() / stretches.minCoeff();
    ASSERT_LE(distance(found, R), reference_round_off * condition);
    ASSERT_LE((eigen(found) * eigen(found).transpose() - Eigen::Matrix3d::Identity()).norm(), reference_round_off);
  }
}

TEST(PolarRotation, OfEqualStretchesIsExact) {
  Random random;
  for (const double stretch : {0.2, 1.0, 5.0}) {
    const Eigen::Matrix3d R = random.rotation();
    EXPECT_LE(distance(polar_rotation(tensor(stretch * R)), R), round_off) << stretch;
  }
}

TEST(PolarRotation, OfSimpleShearTurnsByTheArcTangentOfHalfTheShear) {
  for (const double shear : {1e-6, 0.1, 1.0, 4.0, 20.0}) {
    Tensor<double> F = Tensor<double>::identity();
    F.xy = shear;
    const double angle = std::atan(0.5 * shear);
    const Tensor<double> R = polar_rotation(F);
    EXPECT_NEAR(R.xx, std::cos(angle), reference_round_off) << shear;
    EXPECT_NEAR(R.xy, std::sin(angle), reference_round_off) << shear;
    EXPECT_NEAR(R.yx, -std::sin(angle), reference_round_off) << shear;
  }
}

TEST(Kinematics, LanesGiveTheResultsOfDoubles) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    std::array<Tensor<double>, Lanes::width> A;
    Tensor<Lanes> packed;
    const auto components = [](auto& t) { return std::array{&t.xx, &t.xy, &t.xz, &t.yx, &t.yy, &t.yz, &t.zx, &t.zy, &t.zz}; };
    for (int l = 0; l < Lanes::width; ++l) {
      A[l] = random.of_size(random.uniform(0.0, 0.13));
      for (int c = 0; c < 9; ++c) components(packed)[c]->set(l, *components(A[l])[c]);
    }
    const Tensor<Lanes> B = exponential_minus_identity(packed);
    Tensor<Lanes> F = exponential(packed);
    PolarIncrement<Lanes> polar = polar_increment(B);
    Tensor<Lanes> whole = polar_rotation(F);
    for (int l = 0; l < Lanes::width; ++l) {
      const PolarIncrement<double> polar1 = polar_increment(exponential_minus_identity(A[l]));
      Tensor<double> F1 = exponential(A[l]), R1 = polar1.rotation, whole1 = polar_rotation(F1);
      const SymmetricTensor<double> strain1 = polar1.strain;
      for (int c = 0; c < 9; ++c) {
        // The same operations in the same order; nothing here calls the mathematics library but the square root.
        ASSERT_EQ((*components(F)[c])[l], *components(F1)[c]);
        ASSERT_EQ((*components(polar.rotation)[c])[l], *components(R1)[c]);
        ASSERT_EQ((*components(whole)[c])[l], *components(whole1)[c]);
      }
      ASSERT_EQ(polar.strain.xy[l], strain1.xy);
      ASSERT_EQ(polar.strain.zz[l], strain1.zz);
    }
  }
}

}  // namespace
}  // namespace brisance
