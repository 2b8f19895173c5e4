#include <arcslip/structure/projected.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/products.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::MatrixXcd, Eigen::VectorXd;
using Complex = std::complex<double>;
using Kind = PartOfZ::Kind;

constexpr int samples = 24;  // of the frequency
constexpr int samples_with_damping = 8;
constexpr Index poles_with_damping = 24;
constexpr double loss_factor = 0.01;
constexpr double least_stiffness = 0.05;  // of A + stiffening K2, next to A
constexpr double margin = 2;              // of what is known about
constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool has_damping(const Projected& P) {
  return std::any_of(P.parts.begin(), P.parts.end(), [](const PartOfZ& part) {
    return part.kind == Kind::damping || part.kind == Kind::skew;
  });
}
bool has_skew(const Projected& P) {
  return std::any_of(P.parts.begin(), P.parts.end(),
                     [](const PartOfZ& part) { return part.kind == Kind::skew; });
}
const PartOfZ* stiffening_part(const Projected& P) {
  for (const PartOfZ& part : P.parts)
    if (part.kind == Kind::stiffening) return &part;
  return nullptr;
}

// A frequency and a speed. Losses have the sign of those of C.
struct PointOfZ {
  Complex p, s;
  double speed, stiffening;

  PointOfZ(const Projected& P, double square, double of_K2)
      : p(square * Complex(1, -loss_factor) + P.sigma),
        s(0, std::sqrt(square)),
        speed(std::sqrt(std::max(P.square + of_K2, 0.0))),
        stiffening(of_K2) {}

  Complex factor(const PartOfZ& part) const {
    switch (part.kind) {
      case Kind::mass:
        return -p;
      case Kind::damping:
        return s;
      case Kind::stiffening:
        return stiffening;
      case Kind::skew:
        break;
    }
    return (part.of_velocity ? s : 1.0) * (part.by_speed ? speed : 1.0);
  }
};

// Inverse scales of x_b and of the loads.
VectorXd inverse_scale_at(const Projected& P, double size_of_p, double stiffening) {
  VectorXd A = P.A_c.diagonal();
  if (const PartOfZ* K2 = stiffening_part(P)) A += stiffening * K2->c.diagonal();
  VectorXd scale(A.size() + P.load_size.size());
  scale << (A.cwiseAbs() + (size_of_p + 2 * P.shift) * P.parts.front().c.diagonal().cwiseAbs()).cwiseSqrt(),
      P.load_size;
  return scale.unaryExpr([](double of) { return of == 0 ? 0 : 1 / of; });
}

MatrixXcd real_times(const MatrixXd& A, const MatrixXcd& B) {
  MatrixXcd C(A.rows(), B.cols());
  C.real() = product(A, MatrixXd(B.real()));
  C.imag() = product(A, MatrixXd(B.imag()));
  return C;
}

// r_U, for one x_b or load each, and S.
struct Residual {
  MatrixXcd r, S;
  double inverse = 0;  // with skew-symmetric matrices: the norm of Z_zz^-1 of the first coordinates, or more
};

// Z of all coordinates z, and what drives them, at one point: transposed, with skew-symmetric parts the other
// way round.
struct DampedInterior {
  MatrixXcd Z, B;

  DampedInterior(const Projected& P, const PointOfZ& at, const VectorXd& inverse_scale, bool transposed) {
    const Index n = P.coordinates(), b = P.A_c.rows();
    Z = MatrixXcd::Identity(n, n);
    B.setZero(n, b + P.f_z.cols());
    for (const PartOfZ& part : P.parts) {
      const Complex factor = at.factor(part) * (transposed ? part.sign() : 1);
      Z += factor * part.zz;
      B.leftCols(b) -= factor * part.zb;
    }
    B.rightCols(P.f_z.cols()) = P.f_z.cast<Complex>();
    B = B * inverse_scale.asDiagonal();
  }

  Residual residual(Index first, bool with_inverse) const {
    const Index next = Z.rows() - first;
    if (first == 0) return {B, Z, 0};
    MatrixXcd right(first, B.cols() + next + (with_inverse ? first : 0));
    right.leftCols(B.cols() + next) << B.topRows(first), Z.topRightCorner(first, next);
    if (with_inverse) right.rightCols(first).setIdentity();
    const MatrixXcd y = continuation::solve_complex(Z.topLeftCorner(first, first), right);
    const auto coupling = Z.bottomLeftCorner(next, first);
    return {B.bottomRows(next) - coupling * y.leftCols(B.cols()),
            Z.bottomRightCorner(next, next) - coupling * y.middleCols(B.cols(), next),
            with_inverse ? y.rightCols(first).norm() : 0};
  }
};

// Without damping, at one stiffening: the first coordinates in their modes, where A + stiffening K2 is 1 and
// M is theta; all else real.
class UndampedInterior {
 public:
  UndampedInterior(const Projected& P, double stiffening, Index first)
      : P_(P), stiffening_(stiffening), first_(first), K2_(stiffening_part(P)) {
    const MatrixXd M = P.parts.front().zz.topLeftCorner(first, first);
    MatrixXd A = MatrixXd::Identity(first, first);
    if (K2_ != nullptr) A += stiffening * K2_->zz.topLeftCorner(first, first);
    continuation::SymmetricModes found{VectorXd(0), MatrixXd(0, 0)};
    if (first > 0) found = K2_ == nullptr ? large_symmetric_modes(M) : continuation::symmetric_modes(M, A);
    converged_ = found.values.size() == first;
    if (!converged_) return;
    theta_ = std::move(found.values);
    Q_ = std::move(found.V);
    M_b_ = transposed_product(Q_, P.parts.front().zb.topRows(first));
    f_ = transposed_product(Q_, P.f_z.topRows(first));
    if (K2_ != nullptr) K2_b_ = transposed_product(Q_, K2_->zb.topRows(first));
  }

  bool converged() const { return converged_; }
  const VectorXd& theta() const { return theta_; }
  const MatrixXd& modes() const { return Q_; }

  // Of coordinates their modes.
  MatrixXcd in_modes(const MatrixXcd& y) const {
    if (K2_ == nullptr) return Q_.transpose() * y;
    return Q_.transpose() * (y + stiffening_ * (K2_->zz.topLeftCorner(first_, first_) * y));
  }

  void couple() {
    const Index next = P_.coordinates() - first_;
    M_next_ = product(P_.parts.front().zz.bottomLeftCorner(next, first_), Q_);
    if (K2_ != nullptr) K2_next_ = product(K2_->zz.bottomLeftCorner(next, first_), Q_);
  }

  // The modes, for one x_b or load each.
  MatrixXcd motion(const PointOfZ& at, const VectorXd& inverse_scale) const {
    const Eigen::VectorXcd inverse = (1.0 - at.p * theta_.array()).inverse().matrix();
    return inverse.asDiagonal() * driven(at, M_b_, K2_b_, f_, inverse_scale);
  }

  Residual residual(const PointOfZ& at, const VectorXd& inverse_scale) const {
    const Index next = P_.coordinates() - first_;
    const MatrixXcd y = motion(at, inverse_scale);
    Residual of;
    of.r = driven(at, P_.parts.front().zb.bottomRows(next),
                  K2_ != nullptr ? MatrixXd(K2_->zb.bottomRows(next)) : MatrixXd(), P_.f_z.bottomRows(next),
                  inverse_scale) +
           at.p * real_times(M_next_, y);
    if (K2_ != nullptr) of.r -= stiffening_ * real_times(K2_next_, y);
    return of;
  }

  MatrixXcd schur(const PointOfZ& at) const {
    const Index next = P_.coordinates() - first_;
    MatrixXcd coupling = -at.p * M_next_;
    MatrixXcd S = MatrixXcd::Identity(next, next) - at.p * P_.parts.front().zz.bottomRightCorner(next, next);
    if (K2_ != nullptr) {
      coupling += stiffening_ * K2_next_;
      S += stiffening_ * K2_->zz.bottomRightCorner(next, next);
    }
    S -= coupling * (1.0 - at.p * theta_.array()).inverse().matrix().asDiagonal() * coupling.transpose();
    return S;
  }

 private:
  MatrixXcd driven(const PointOfZ& at, const MatrixXd& M_b, const MatrixXd& K2_b, const MatrixXd& f,
                   const VectorXd& inverse_scale) const {
    MatrixXcd B(M_b.rows(), M_b.cols() + f.cols());
    B << at.p * M_b, f.cast<Complex>();
    if (K2_ != nullptr) B.leftCols(M_b.cols()) -= stiffening_ * K2_b;
    return B * inverse_scale.asDiagonal();
  }

  const Projected& P_;
  const double stiffening_;
  const Index first_;
  const PartOfZ* const K2_;
  bool converged_ = false;
  VectorXd theta_;
  MatrixXd Q_, M_b_, K2_b_, f_, M_next_, K2_next_;
};

// omega^2 of the poles below the highest frequency.
std::vector<double> poles(const Projected& P, const VectorXd& theta) {
  std::vector<double> squares;
  for (const double of : theta)
    if (const double square = 1 / of - P.sigma; of > 0 && square > 0 && square < P.highest * P.highest)
      squares.push_back(square);
  return squares;
}

std::vector<double> sampled_squares(const Projected& P, const VectorXd& theta, bool damped) {
  std::vector<double> squares;
  const int steps = damped ? samples_with_damping : samples;
  for (int k = 0; k <= steps; ++k) squares.push_back(std::pow(P.highest * k / steps, 2));
  const std::vector<double> at_poles = poles(P, theta);
  const auto count = static_cast<Index>(at_poles.size());
  const Index step = damped ? count / poles_with_damping + 1 : 1;
  for (Index k = 0; k < count; k += step) squares.push_back(at_poles[static_cast<std::size_t>(k)]);
  return squares;
}

// The least of A + stiffening K2 in the norm of A.
double softened(const Projected& P, double stiffening) {
  const PartOfZ* K2 = stiffening_part(P);
  if (K2 == nullptr || K2->zz.size() == 0 || stiffening == 0) return 1;
  const VectorXd of = large_symmetric_eigenvalues(K2->zz);
  if (of.size() == 0) return none;
  return std::max(1 + std::min(stiffening * of[0], stiffening * of[of.size() - 1]), least_stiffness);
}

// 1/min |1 - p m| over 0 <= m <= largest. At rest an interior that floats counts as at the first sample.
double amplification(const Projected& P, Complex p, double largest) {
  const double nearest = p.real() / std::norm(p), losses = loss_factor * std::pow(P.highest / samples, 2);
  return nearest <= largest ? std::abs(p) / std::max(std::abs(p.imag()), losses)
                            : 1 / std::abs(1.0 - p * largest);
}

// The largest theta of all coordinates, where A + stiffening K2 is 1.
double largest_theta(const Projected& P, double stiffening) {
  const MatrixXd& M = P.parts.front().zz;
  if (M.rows() == 0) return 0;
  const PartOfZ* K2 = stiffening_part(P);
  const VectorXd of = K2 == nullptr ? large_symmetric_eigenvalues(M)
                                    : continuation::symmetric_eigenvalues(
                                          M, MatrixXd::Identity(M.rows(), M.rows()) + stiffening * K2->zz);
  return of.size() == 0 ? none : std::max(of[of.size() - 1], 0.0);
}

// No less than the norm of the inverse.
double bound_of_inverse(const MatrixXcd& S) {
  if (S.rows() == 0) return 0;
  const MatrixXd sizes = continuation::solve_complex(S, MatrixXcd::Identity(S.rows(), S.rows())).cwiseAbs();
  return std::sqrt(sizes.rowwise().sum().maxCoeff() * sizes.colwise().sum().maxCoeff());
}

double largest_column(const MatrixXcd& r, Index columns) {
  if (r.rows() == 0 || columns == 0) return 0;
  const VectorXd norms = r.leftCols(columns).colwise().norm().transpose();
  return norms.allFinite() ? norms.maxCoeff() : none;
}

// With one stiffening.
class BoundOfStiffened {
 public:
  BoundOfStiffened(const Projected& P, double stiffening, Index first, const Remainder& left, double enough)
      : P_(P),
        stiffening_(stiffening),
        first_(first),
        left_(left),
        enough_(enough),
        damped_(has_damping(P)),
        skew_(has_skew(P)),
        softened_(softened(P, stiffening)) {}

  ResidualBound run() {
    UndampedInterior modes(P_, stiffening_, first_);
    if (!modes.converged()) return {none, 1};
    if (!damped_) modes.couple();
    largest_theta_ = largest_theta(P_, stiffening_);
    ResidualBound largest;
    for (const double square : sampled_squares(P_, modes.theta(), damped_)) {
      const PointOfZ at(P_, square, stiffening_);
      const ResidualBound of = at_point(at, modes);
      largest.amplification = std::max(largest.amplification, of.amplification);
      if (!(of.error <= largest.error)) largest.error = of.error;
      if (std::isnan(largest.error)) break;
    }
    return largest;
  }

 private:
  ResidualBound at_point(const PointOfZ& at, const UndampedInterior& modes) const {
    const VectorXd inverse_scale = inverse_scale_at(P_, std::abs(at.p), stiffening_);
    const Index b = P_.A_c.rows();
    Residual of;
    double of_rows = 0;  // |r_U| of the transposed Z
    if (damped_) {
      of = DampedInterior(P_, at, inverse_scale, false).residual(first_, skew_);
      of_rows = skew_
                    ? largest_column(DampedInterior(P_, at, inverse_scale, true).residual(first_, false).r, b)
                    : largest_column(of.r, b);
    } else {
      of = modes.residual(at, inverse_scale);
      of_rows = largest_column(of.r, b);
    }
    const double of_columns = largest_column(of.r, of.r.cols()), product = of_rows * of_columns;
    const double a = std::max(amplification(P_, at.p, largest_theta_) / softened_, of.inverse);
    double of_rest = a;
    if (product <= enough_) {
      const double inverse = bound_of_inverse(damped_ ? of.S : modes.schur(at));
      const double least = margin * amplification(P_, at.p, margin * left_.theta) / softened_;
      of_rest = std::min(a, std::max(least, inverse));
    }
    const double l = left_.norm;
    return {of_rest * (product + (of_rows + of_columns) * l + l * l), of_rest};
  }

  const Projected& P_;
  const double stiffening_;
  const Index first_;
  const Remainder& left_;
  const double enough_;
  const bool damped_, skew_;
  const double softened_;
  double largest_theta_ = 0;
};

// With one stiffening, in its modes.
class EnvelopeOfStiffened {
 public:
  EnvelopeOfStiffened(const Projected& P, double stiffening)
      : P_(P), stiffening_(stiffening), damped_(has_damping(P)), modes_(P, stiffening, P.coordinates()) {}

  Envelope run() const {
    if (!modes_.converged()) return {};
    const std::vector<double> squares = sampled_squares(P_, modes_.theta(), damped_);
    VectorXd largest = VectorXd::Zero(P_.coordinates());
    for (const double square : squares) largest = largest.cwiseMax(sizes(square).rowwise().maxCoeff());
    const VectorXd inverse = largest.unaryExpr([](double of) { return of == 0 ? 0 : 1 / of; });
    double length = 0;
    for (const double square : squares)
      length = std::max(length, (inverse.asDiagonal() * sizes(square)).colwise().norm().maxCoeff());
    const MatrixXd root = modes_.modes() * largest.asDiagonal();
    return {product(root, root.transpose()), length};
  }

 private:
  MatrixXd sizes(double square) const {
    const PointOfZ at(P_, square, stiffening_);
    const VectorXd inverse_scale = inverse_scale_at(P_, std::abs(at.p), stiffening_);
    if (!damped_) return modes_.motion(at, inverse_scale).cwiseAbs2().cwiseSqrt();
    const DampedInterior in(P_, at, inverse_scale, false);
    return modes_.in_modes(continuation::solve_complex(in.Z, in.B)).cwiseAbs();
  }

  const Projected& P_;
  const double stiffening_;
  const bool damped_;
  const UndampedInterior modes_;
};

}  // namespace

bool Projected::is_finite() const {
  return A_c.allFinite() && f_c.allFinite() && f_z.allFinite() &&
         std::all_of(parts.begin(), parts.end(), [](const PartOfZ& part) {
           return part.c.allFinite() && part.zz.allFinite() && part.zb.allFinite();
         });
}

void Projected::keep(Index count) {
  if (coordinates() <= count) return;
  f_z.conservativeResize(count, Eigen::NoChange);
  for (PartOfZ& part : parts) {
    part.zz.conservativeResize(count, count);
    part.zb.conservativeResize(count, Eigen::NoChange);
  }
}

void Projected::turn(const MatrixXd& T) {
  f_z = transposed_product(T, f_z);
  for (PartOfZ& part : parts) {
    const MatrixXd zz = transposed_product(T, product(part.zz, T));
    part.zz = 0.5 * (zz + part.sign() * zz.transpose());
    part.zb = transposed_product(T, part.zb);
  }
}

double largest_factor(const Projected& P, const PartOfZ& part) {
  double largest = 0;
  for (const double stiffening : P.stiffening)
    largest = std::max(largest, std::abs(PointOfZ(P, P.highest * P.highest, stiffening).factor(part)));
  return largest;
}

Envelope envelope(const Projected& P) {
  Envelope whole{MatrixXd::Zero(P.coordinates(), P.coordinates()), 0};
  if (P.coordinates() == 0 || P.A_c.rows() + P.f_z.cols() == 0) return whole;
  for (const double stiffening : P.stiffening) {
    const Envelope of = EnvelopeOfStiffened(P, stiffening).run();
    if (of.E.size() == 0 || !of.E.allFinite() || !std::isfinite(of.length)) return {};
    whole.E += of.E;
    whole.length = std::max(whole.length, of.length);
  }
  return whole;
}

VectorXd inverse_scale(const Projected& P) {
  VectorXd largest = VectorXd::Zero(P.A_c.rows() + P.load_size.size());
  for (const double stiffening : P.stiffening)
    largest = largest.cwiseMax(inverse_scale_at(P, P.sigma, stiffening));
  return largest;
}

ResidualBound bound(const Projected& P, Index first, const Remainder& left, double enough) {
  ResidualBound largest;
  for (const double stiffening : P.stiffening) {
    const ResidualBound found = BoundOfStiffened(P, stiffening, first, left, enough).run();
    largest.amplification = std::max(largest.amplification, found.amplification);
    if (!(found.error <= largest.error)) largest.error = found.error;
    if (std::isnan(largest.error)) break;
  }
  return largest;
}

StrongModes strong_modes(const Projected& P, double most) {
  const UndampedInterior modes(P, 0, P.coordinates());
  if (!modes.converged()) return {};
  VectorXd adds = VectorXd::Zero(P.coordinates());
  for (const double square : sampled_squares(P, modes.theta(), false)) {
    const PointOfZ at(P, square, 0);
    const MatrixXcd y = modes.motion(at, inverse_scale_at(P, std::abs(at.p), 0));
    const Eigen::ArrayXd lengths = (1.0 - at.p * modes.theta().array()).abs();
    adds = adds.cwiseMax((y.cwiseAbs2().rowwise().maxCoeff().array() * lengths).matrix());
  }
  std::vector<Index> order(static_cast<std::size_t>(adds.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return adds[a] < adds[b]; });
  StrongModes strong;
  auto first = order.begin();
  for (; first != order.end() && strong.left_out + adds[*first] <= most; ++first)
    strong.left_out += adds[*first];
  const std::vector<Index> kept(first, order.end());
  strong.Q = modes.modes()(Eigen::all, kept);
  return strong;
}

}  // namespace arcslip::structure
