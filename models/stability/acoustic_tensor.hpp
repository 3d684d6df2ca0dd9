#pragma once

#include "models/stability/arguments.hpp"

namespace brisance::stability {

/// Principal values of a deviator, largest first.
template <class Real>
struct PrincipalDeviator {
  Real major{0.0}, middle{0.0}, minor{0.0};
};

/// Accurate to a few units of round-off of |s| also where two values meet: the value that stands alone is a well-conditioned
/// root of the characteristic cubic, and half the distance of the other two is a norm, that of s without the part of the
/// first. (The usual cosines lose half the digits there.) No branches.
template <class Real>
PrincipalDeviator<Real> principal_values(const SymmetricTensor<Real>& deviator) {
  const Real scale = sqrt(max(0.5 * double_dot(deviator, deviator), Real(1e-200)));
  const SymmetricTensor<Real> s = Real(1.0 / scale) * deviator;
  // s has J2 = 1 and y^3 - y - J3 = 0. If J3 >= 0 the lone value is the largest, in [1, 2/sqrt 3]; otherwise mirror.
  const Real J3 = determinant(s);
  const Real sign = select(J3 >= 0.0, Real(1.0), Real(-1.0));
  const Real j = min(sign * J3, Real(0.3849001794597505));
  Real lone = 1.0 + j * (0.5 - 0.2548 * j);  // within 2e-3, so that three Newton steps reach round-off
  for (int i = 0; i < 3; ++i) lone = lone - (lone * (lone * lone - 1.0) - j) / (3.0 * lone * lone - 1.0);

  // Projector on its axis by Cayley-Hamilton, (s - y2)(s - y3) normalised, with y2 + y3 = -y and y2 y3 = y^2 - 1.
  const SymmetricTensor<Real> product = add_to_diagonal(square(s) + (sign * lone) * s, Real(lone * lone - 1.0));
  const SymmetricTensor<Real> axis = Real(1.0 / (3.0 * lone * lone - 1.0)) * product;
  const SymmetricTensor<Real> rest = s - (1.5 * sign * lone) * add_to_diagonal(axis, Real(-1.0 / 3.0));
  const Real half_gap = sqrt(max(0.5 * double_dot(rest, rest), Real(1e-60)));

  const Real mirrored_middle = half_gap - 0.5 * lone;
  const mask_of<Real> upright = sign > 0.0;
  return {scale * select(upright, lone, 0.5 * lone + half_gap), scale * sign * mirrored_middle,
          scale * select(upright, -0.5 * lone - half_gap, -lone)};
}

/// The plane in which a band forms first, and the plastic modulus at which it does.
template <class Real>
struct Localisation {
  Real critical_modulus{0.0};  // in the units of Hd
  Real major_part{0.0};        // square of the cosine between the band normal and the axis of the largest principal stress; the
                               // normal lies in the plane of the largest and the smallest
};

/// With the band normal m, det Q(m) = det Qe(m) [1 - b.Qe^-1.b/(N:Ce:N + Hd)], b = (Ce:N).m. In principal axes, with the
/// squares w of the components of m as unknowns, b.Qe^-1.b = (<P^2> - k <P>^2)/G: mean values under the weights w of the
/// principal values P of Ce:N. Of all weights with the same <P> those on the outer two axes have the largest <P^2>, so what
/// remains is a parabola in A = <P> on [P3, P1], which covers normals along a principal axis too.
template <class Real>
Localisation<Real> localisation(const Arguments<Real>& at) {
  const PrincipalDeviator<Real> s = principal_values(at.deviatoric_stress);
  const Real G = at.shear_modulus, K = at.bulk_modulus;
  const Real volumetric = 3.0 * K * at.normal_volumetric, deviatoric = 2.0 * G * at.normal_deviatoric;
  const Real P1 = volumetric + deviatoric * s.major, P3 = volumetric + deviatoric * s.minor;
  const Real k = (K + (1.0 / 3.0) * G) / (K + (4.0 / 3.0) * G);
  const Real A = min(max((P1 + P3) / (2.0 * k), P3), P1);
  const Real gap = P1 - P3;
  const mask_of<Real> distinct = gap > 0.0;
  return {((P1 + P3 - k * A) * A - P1 * P3) / G - elastic_stiffness_along_normal(at),
          select(distinct, (A - P3) / select(distinct, gap, Real(1.0)), Real(1.0))};
}

/// The same where stress is not small beside the shear modulus: Jaumann's rate of the Kirchhoff stress adds
/// [(m.sig.m) I - m (sig.m) - sig - (sig.m) m]/2 to Qe. With the normal in the plane of the largest and the smallest principal
/// stress, b.Qe^-1.b is the ratio of two quadratic polynomials in w, the square of the cosine to the axis of the largest, and
/// where its slope vanishes w solves a third.
template <class Real>
Localisation<Real> localisation_under_finite_stress(const Arguments<Real>& at) {
  struct Quadratic {  // c0 + c1 w + c2 w^2
    Real c0, c1, c2;
    Real operator()(const Real& w) const { return c0 + w * (c1 + w * c2); }
  };
  const PrincipalDeviator<Real> s = principal_values(at.deviatoric_stress);
  const Real G = at.shear_modulus, L = at.bulk_modulus + (1.0 / 3.0) * G;
  const Real volumetric = 3.0 * at.bulk_modulus * at.normal_volumetric, deviatoric = 2.0 * G * at.normal_deviatoric;
  const Real P1 = volumetric + deviatoric * s.major, P3 = volumetric + deviatoric * s.minor;
  const Real sig1 = s.major + at.mean_stress, sig3 = s.minor + at.mean_stress, mean = 0.5 * (sig1 + sig3);
  // Q11 and Q33 are linear in w: here they are at w = 0 and w = 1. Q13^2 = w (1 - w) M^2.
  const Real Q11_0 = G + 0.5 * (sig3 - sig1), Q11_1 = G + L - sig1;
  const Real Q33_0 = G + L - sig3, Q33_1 = G + 0.5 * (sig1 - sig3), M = L - mean;
  const Real Q11 = Q11_1 - Q11_0, Q33 = Q33_1 - Q33_0;  // slopes
  const Quadratic work{P3 * P3 * Q11_0, P1 * P1 * Q33_0 - 2.0 * P1 * P3 * M + P3 * P3 * (Q11 - Q11_0),
                       P1 * P1 * Q33 + 2.0 * P1 * P3 * M - P3 * P3 * Q11};
  const Quadratic determinant{Q11_0 * Q33_0, Q11_0 * Q33 + Q11 * Q33_0 - M * M, Q11 * Q33 + M * M};
  // (work/determinant)' = 0
  const Real alpha = work.c1 * determinant.c0 - work.c0 * determinant.c1,
             beta = 2.0 * (work.c2 * determinant.c0 - work.c0 * determinant.c2),
             gamma = work.c2 * determinant.c1 - work.c1 * determinant.c2;
  const Real root = sqrt(max(beta * beta - 4.0 * alpha * gamma, Real(0.0)));
  const Real q = -0.5 * (beta + select(beta >= 0.0, root, -root));
  const auto ratio = [](const Real& a, const Real& b) { return a / select(abs(b) > 1e-200, b, Real(1e-200)); };
  Localisation<Real> most{Real(-1e300), Real(0.0)};
  for (const Real& stationary : {Real(0.0), Real(1.0), ratio(q, gamma), ratio(alpha, q)}) {
    const Real w = min(max(stationary, Real(0.0)), Real(1.0));
    const Real stiffness = determinant(w);
    // Without elastic stiffness against a band nothing holds it.
    const Real value = select(stiffness > 0.0, ratio(work(w), stiffness), Real(1e300));
    const mask_of<Real> more = value > most.critical_modulus;
    most = {select(more, value, most.critical_modulus), select(more, w, most.major_part)};
  }
  most.critical_modulus = most.critical_modulus - elastic_stiffness_along_normal(at);
  return most;
}

struct AcousticTensor {
  static constexpr std::string_view name = "acoustic_tensor";
  static constexpr std::string_view equation =
      "unstable when min over |m| = 1 of det(m.Cep.m) <= 0:  Hd <= max_m [m.(N:Ce).Qe^-1.(Ce:N).m] - N:Ce:N,  "
      "Qe^-1 = (I - m m (K + G/3)/(K + 4G/3))/G;  finite_stress: Qe + [(m.sig.m) I - m (sig.m) - sig - (sig.m) m]/2";
  static constexpr std::string_view source =
      "Rudnicki & Rice, J. Mech. Phys. Solids 23 (1975) 371-394; closed form for normals N = a s + b I, band normals along a "
      "principal axis included. Without finite_stress terms of the order of stress over shear modulus are left out; with it "
      "they are those of Jaumann's rate of the Kirchhoff stress.";

  bool finite_stress = false;

  static constexpr auto parameters =
      std::tuple{Parameter{"finite_stress", &AcousticTensor::finite_stress, Unit::one,
                           "include the terms of the order of stress over shear modulus", any_value, false}};

  template <class Real>
  Real operator()(const Arguments<Real>& at) const {
    const Localisation<Real> band = finite_stress ? localisation_under_finite_stress(at) : localisation(at);
    return margin(at, band.critical_modulus);
  }
};

}  // namespace brisance::stability
