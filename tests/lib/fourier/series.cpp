#include "catch.hpp"

#include <arcslip/fourier/moments.hpp>
#include <arcslip/fourier/series.hpp>

#include <cmath>
#include <numbers>

using namespace arcslip::elements;

TEST_CASE("value and derivatives of a series are those of its sum of cosines and sines") {
  for (bool odd : {false, true})
    for (int order : {1, 2, 3, 8, 55}) {
      const Harmonics h{order, odd};
      const Eigen::VectorXd u = Eigen::VectorXd::Random(h.size());
      Eigen::VectorXd phi(h.size());
      for (double theta : {-3.0, 0.0, 0.7, 2.9, 11.0}) {
        double x = 0, d1 = 0, d2 = 0;
        for (int i = 0; i < h.cosines(); ++i) {
          const int n = h.cosine_order(i);
          CHECK(h.cosine_index(n) == i);
          x += u[i] * std::cos(n * theta);
          d1 -= n * u[i] * std::sin(n * theta);
          d2 -= n * n * u[i] * std::cos(n * theta);
        }
        for (int j = 0; j < h.sines(); ++j) {
          const int n = h.sine_order(j), at = h.cosines() + j;
          CHECK(h.sine_index(n) == at);
          x += u[at] * std::sin(n * theta);
          d1 += n * u[at] * std::cos(n * theta);
          d2 -= n * n * u[at] * std::sin(n * theta);
        }
        const Values v = series_values(h, u, theta);
        const double size = u.cwiseAbs().sum();
        CHECK(std::abs(v.x - x) < 1e-13 * size);
        CHECK(std::abs(v.d1 - d1) < 1e-13 * order * size);
        CHECK(std::abs(v.d2 - d2) < 1e-13 * order * order * size);
        series_basis(h, theta, phi);
        CHECK(std::abs(phi.dot(u) - x) < 1e-13 * size);
      }
    }
}

TEST_CASE("the powers of exp(i theta) keep their digits up to the 2000th") {
  std::vector<std::complex<double>> z(2001);
  for (double theta : {0.001, 1.0, 3.1, -2.0}) {
    powers(theta, 2001, z.data());
    for (int k : {0, 1, 2, 3, 64, 65, 1023, 2000})
      CHECK(std::abs(z[static_cast<std::size_t>(k)] - std::polar(1.0, k * theta)) < 1e-12);
  }
}

TEST_CASE("the Gram matrix from moments is the integral of products of the basis") {
  // Gauss-Legendre with 5 nodes on short pieces, exact to rounding.
  const double nodes[] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                          -0.9061798459386640};
  const double weights[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                            0.2369268850561891};
  for (bool odd : {false, true})
    for (int order : {1, 4, 7}) {
      const Harmonics h{order, odd};
      const double begin = 0.4, end = 2.3;
      Eigen::MatrixXd G = Eigen::MatrixXd::Zero(h.size(), h.size());
      Eigen::VectorXd phi(h.size());
      const int pieces = 200;
      for (int k = 0; k < pieces; ++k)
        for (int g = 0; g < 5; ++g) {
          const double width = (end - begin) / pieces;
          series_basis(h, begin + width * (k + 0.5 + 0.5 * nodes[g]), phi);
          G += 0.5 * width * weights[g] * phi * phi.transpose();
        }
      Moments moments(h);
      std::vector<std::complex<double>> sum(static_cast<std::size_t>(2 * order + 1)), half(sum.size());
      powers(0.5 * (begin + end), 2 * order + 1, sum.data());
      powers(0.5 * (end - begin), 2 * order + 1, half.data());
      moments.clear();
      moments.add_interval(end - begin, sum.data(), half.data());
      moments.close();
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(h.size(), h.size());
      moments.add_to(J, 2.5);
      CHECK((J - 2.5 * G).norm() < 1e-12);
      const Eigen::VectorXd u = Eigen::VectorXd::Random(h.size());
      Eigen::VectorXd y = Eigen::VectorXd::Zero(h.size());
      moments.times(u, -0.5, y);
      CHECK((y + 0.5 * G * u).norm() < 1e-12);
    }
}
