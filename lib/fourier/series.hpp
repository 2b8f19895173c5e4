#pragma once
// Values of one coordinate's Fourier series.

#include <arcslip/fourier/harmonics.hpp>

#include <complex>
#include <vector>

namespace arcslip::elements {

using In = Eigen::Ref<const Eigen::VectorXd>;
using Out = Eigen::Ref<Eigen::VectorXd>;

/// x and its first three derivatives by theta at one angle.
struct Values {
  double x, d1, d2, d3;
};

Values series_values(const Harmonics& harmonics, In u, double theta);
Values series_values(const Harmonics& harmonics, In u, double cos_theta, double sin_theta);

/// Basis at one angle: phi . u = x(theta). phi: harmonics.size().
void series_basis(const Harmonics& harmonics, double theta, Out phi);

/// The coefficients of dx/dtheta.
void series_slope(const Harmonics& harmonics, In u, Out slope);

/// exp(i k theta) for k = 0 .. count - 1, by products of earlier ones (error grows with log k).
void powers(double theta, int count, std::complex<double>* z);
/// The same of a number on the unit circle.
void powers(std::complex<double> on_circle, int count, std::complex<double>* z);

/// sum over n of n^power |X_n|, without the mean: a bound of |d^power x / dtheta^power|.
double series_bound(const Harmonics& harmonics, In u, int power);

/// The root of the mean of x^2 over the period.
double root_mean_square(const Harmonics& harmonics, In u);

/// Whether x(theta + turn) = sign x(theta), to rounding: sign is 1 or -1.
bool is_image(const Harmonics& harmonics, In u, double turn, double sign);
/// Whether y(theta + turn) = sign x(theta), with the coefficients v of y.
bool is_image(const Harmonics& harmonics, In v, In u, double turn, double sign);

}  // namespace arcslip::elements
