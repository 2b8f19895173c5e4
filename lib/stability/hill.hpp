#pragma once
// Floquet multipliers by Hill's method: a second opinion on floquet.hpp for laws without memory.
//
// A variation of a periodic motion is a sum w = sum_k z_k(theta) e^(i k theta) with slow z_k that obey
//
//   z' = (J_0 - i k) z_k + sum_l J_(k-l) z_l,     |k|, |l| <= H,     z_k(0) = 0 for k != 0
//
// J_m: the Fourier coefficients of the variational equation's matrix over (w, dw/dtheta), whose part by
// elements is -M^-1 D T_m D^T/omega^2 and -M^-1 D B_m D^T/omega. The matrix of this system is Hill's. The map
// over the period is the sum of z_k(2 pi) (Koopman-Hill projection): no eigenvalue of the truncated matrix
// has to be reported from its copies, shifted by i k. Over half a period of an antisymmetric motion it is
// -sum
// (-1)^k z_k(pi).
//
// T_m, B_m: of 4 H + 4 samples of smooth laws, exact where a law without memory is piecewise linear. H is
// 2 N + 10, and doubled for smooth laws until the last z are below 1e-11 of the largest: their error falls
// faster than any power of H, that of laws with kinks as a power. A slider's
// memory makes the spectrum fragment (Schuetz, Bayer & Leine 2026): such laws are refused. Source: Bayer &
// Leine (2023), Nonlinear Dynamics 111.

#include <arcslip/control/run_control.hpp>
#include <arcslip/stability/floquet.hpp>

namespace arcslip::time {

class Hill {
 public:
  /// Throws NoVariation for laws with memory, SingularMass.
  explicit Hill(const EquationOfMotion& equation);
  ~Hill();
  Hill(Hill&&) noexcept;
  Hill& operator=(Hill&&) noexcept;

  /// As of Floquet.
  bool compute(double omega, const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements,
               const control::Control& control = {});
  const std::vector<std::complex<double>>& multipliers() const;
  const std::vector<std::complex<double>>& half_multipliers() const;
  /// Of (w, dw/dtheta), from theta = 0.
  const Matrix& map() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arcslip::time
