// Lyapunov inverse iteration: K. Meerbergen, A. Spence, SIAM J. Matrix Anal. Appl. 31 (2010) 1982-1999;
// H. C. Elman, M. Wu, SIAM J. Matrix Anal. Appl. 34 (2013) 1685-1707.
//
// The least shift lambda of the spectrum that brings a pair to the axis, J + lambda M, is an eigenvalue of
//
//   S Z + Z S^T + 2 lambda S Z S^T = 0,   S = J^-1 M,
//
// with lambda = -Re mu and Z = Re(v v^H) of the eigenvector v of mu. The frequency does not appear. A step of
// inverse iteration solves S Y + Y S^T = -S Z S^T in a rational Krylov space, orthonormal V: T Y' + Y' T^T +
// C C^T = 0 with T = V^T S V, whose residual is sqrt(2) |(S V - V T) Y'|. The next Z has the Ritz vector
// whose Ritz value 1 / theta is next to the axis, theta of T. Poles are chosen one by one among the Ritz
// values mirrored at the axis, where the space is worst (V. Druskin, V. Simoncini, Systems & Control Letters
// 60 (2011) 546-560).

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/stability/shifted_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace arcslip::continuation {
namespace {

using Complex = std::complex<double>;

constexpr int most_iterations = 6, most_without_growth = 3;
constexpr double lyapunov_tolerance = 1e-5;  // of the residual, relative to C C^T
constexpr double no_new_direction = 1e-12;   // what is left of a vector of the space: rounding
constexpr double infinite_mu = 1e-14;        // of 1 / mu, relative to the largest: below, M is singular
constexpr double real_pole = 1e-3;           // imaginary part of a pole that is taken as real, relative

// A rational Krylov space of S, begun with the real and imaginary part of S x.
class RationalKrylov {
 public:
  // most: vectors.
  RationalKrylov(ShiftedInverse& shifted, const ShiftedInverse& S, const Eigen::VectorXcd& x,
                 Eigen::Index most)
      : shifted_(shifted), S_(S), V_(x.size(), most), SV_(x.size(), most) {
    Eigen::MatrixXcd first = x;
    S_.apply(first);
    add(first);
    block_ = size_;
    C_ = V_.leftCols(size_).transpose() * split(first);
  }

  bool is_full() const { return size_ + 2 * block_ > V_.cols(); }
  Matrix projected() const { return V_.leftCols(size_).transpose() * SV_.leftCols(size_); }
  Eigen::VectorXcd vector(const Eigen::VectorXcd& y) const { return V_.leftCols(size_) * y; }

  // Of the Lyapunov equation, T projected().
  double residual(const Matrix& T) const {
    Matrix C = Matrix::Zero(size_, C_.cols());
    C.topRows(C_.rows()) = C_;
    const Matrix rest = SV_.leftCols(size_) - V_.leftCols(size_) * T;
    return std::numbers::sqrt2 * (rest * lyapunov_solution(T, C)).norm() / (C * C.transpose()).norm();
  }

  // By the pole that helps most for these Ritz values. False: the space does not grow.
  bool extend(const std::vector<Complex>& ritz) {
    const Complex pole = next_pole(ritz);
    poles_.push_back(pole);
    shifted_.set_shift(pole.real(), pole.imag());
    const Eigen::Index before = size_;
    Eigen::MatrixXcd last = V_.middleCols(size_ - block_, block_).cast<Complex>();
    shifted_.apply(last);
    add(last);
    return size_ > before;
  }

 private:
  static Matrix split(const Eigen::MatrixXcd& x) {
    Matrix parts(x.rows(), 2 * x.cols());
    parts << x.real(), x.imag();
    return parts;
  }

  void add(const Eigen::MatrixXcd& x) {
    const Matrix parts = split(x);
    const double length = parts.norm();
    for (Eigen::Index i = 0; i < parts.cols() && size_ < V_.cols(); ++i) {
      Vector next = parts.col(i);
      for (int twice = 0; twice < 2; ++twice)
        next -= V_.leftCols(size_) * (V_.leftCols(size_).transpose() * next);
      if (!(next.norm() > no_new_direction * length)) continue;
      V_.col(size_) = next.normalized();
      S_.perform_op(V_.col(size_).data(), SV_.col(size_).data());
      ++size_;
    }
  }

  // log of |prod (s - pole)^block / prod (s - ritz)|, with unstable Ritz values mirrored as well.
  double gain(Complex s, const std::vector<Complex>& ritz) const {
    double sum = 0;
    for (const Complex& mu : ritz) sum -= std::log(std::abs(s - Complex(-std::abs(mu.real()), mu.imag())));
    for (const Complex& pole : poles_) {
      sum += static_cast<double>(block_) * std::log(std::abs(s - pole));
      if (pole.imag() != 0) sum += static_cast<double>(block_) * std::log(std::abs(s - std::conj(pole)));
    }
    return sum;
  }

  Complex next_pole(const std::vector<Complex>& ritz) const {
    std::vector<Complex> candidates;
    for (const Complex& mu : ritz)  // an unstable one may be an eigenvalue
      if (mu.real() < 0) candidates.emplace_back(-mu.real(), std::abs(mu.imag()));
    if (candidates.empty()) candidates.emplace_back(2 * std::abs(ritz.front()));
    std::sort(candidates.begin(), candidates.end(),
              [](const Complex& a, const Complex& b) { return std::abs(a) < std::abs(b); });
    for (std::size_t i = 1, ends = candidates.size(); i < ends; ++i) {
      const Complex a = candidates[i - 1], b = candidates[i];
      candidates.push_back((a + b) / 2.0);
      candidates.emplace_back(std::sqrt(std::abs(a) * std::abs(b)));
    }
    Complex best = *std::max_element(candidates.begin(), candidates.end(),
                                     [&](Complex a, Complex b) { return gain(a, ritz) < gain(b, ritz); });
    return std::abs(best.imag()) < real_pole * std::abs(best) ? Complex(best.real()) : best;
  }

  ShiftedInverse& shifted_;
  const ShiftedInverse& S_;
  Matrix V_, SV_, C_;
  Eigen::Index size_ = 0, block_ = 0;
  std::vector<Complex> poles_;
};

Eigen::VectorXcd random_start(Eigen::Index n) {
  std::mt19937_64 generator;  // the same one each time
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXcd x(n);
  for (Complex& each : x) each = uniform(generator);
  return x;
}

struct Ritz {
  Complex value;
  Eigen::VectorXcd vector;
};

// Next to the axis, of the space in which the Lyapunov equation for x is solved. Nothing: it could not be.
std::optional<Ritz> ritz_next_to_axis(ShiftedInverse& shifted, const ShiftedInverse& S,
                                      const Eigen::VectorXcd& x, Eigen::Index most) {
  RationalKrylov space(shifted, S, x, most);
  int without_growth = 0;
  for (;;) {
    const Matrix T = space.projected();
    const Modes of_T = modes(T);
    if (of_T.values.size() == 0) return {};
    std::vector<Complex> ritz;
    Ritz nearest{{std::numeric_limits<double>::infinity(), 0}, {}};
    for (Eigen::Index i = 0; i < of_T.values.size(); ++i) {
      const Complex mu = 1.0 / of_T.values[i];
      if (!(std::abs(of_T.values[i]) > infinite_mu * of_T.values.cwiseAbs().maxCoeff())) continue;
      ritz.push_back(mu);
      if (std::abs(mu.real()) < std::abs(nearest.value.real())) nearest = {mu, of_T.V.col(i)};
    }
    if (ritz.empty()) return {};
    if (space.residual(T) <= lyapunov_tolerance) {
      nearest.vector = space.vector(nearest.vector);
      return nearest;
    }
    if (space.is_full()) return {};
    if (!space.extend(ritz) && ++without_growth > most_without_growth) return {};
  }
}

}  // namespace

std::optional<AxisEigenvalue> nearest_to_axis(const SparseMatrix& J, const SparseMatrix* M,
                                              const StabilityOptions& options,
                                              const Eigen::VectorXcd& start) try {
  ShiftedInverse S(J, M), shifted(J, M);
  S.set_shift(0, 0);
  // Begun with an eigenvector alone, the iteration would stay there when others have come nearer to the axis.
  Eigen::VectorXcd x = random_start(J.rows()).normalized();
  if (start.size() == J.rows() && start.norm() > 0) x += start.normalized();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto ritz =
        ritz_next_to_axis(shifted, S, x, std::min<Eigen::Index>(options.lyapunov_space, J.rows()));
    if (!ritz) return {};
    const Complex mu = S.better(ritz->value, ritz->vector);
    x = ritz->vector;
    if (const double residual = S.residual(mu, x);
        residual <= options.tolerance ||
        (iteration + 1 == most_iterations && residual <= std::sqrt(options.tolerance)))
      return AxisEigenvalue{{mu.real(), std::abs(mu.imag())}, mu.imag() < 0 ? x.conjugate().eval() : x};
  }
  return {};
} catch (const std::exception&) {  // a singular J, or a pole that is an eigenvalue
  return {};
}

}  // namespace arcslip::continuation
