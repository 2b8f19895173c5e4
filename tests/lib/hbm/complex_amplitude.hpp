#pragma once
// Fourier coefficients as complex amplitudes.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/fourier/harmonics.hpp>

#include <complex>

namespace scenes {

/// X of harmonic n, whose part of the motion is Re(X e^(i n theta)).
inline std::complex<double> complex_amplitude(const arcslip::elements::Harmonics& h,
                                              const arcslip::continuation::Vector& x, int n) {
  return {x[h.cosine_index(n)], n > 0 ? -x[h.sine_index(n)] : 0.0};
}

}  // namespace scenes
