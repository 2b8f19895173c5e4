#include <arcslip/structure/reduction.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

namespace arcslip::structure {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double shift_at = 0.3;       // sqrt(sigma) over the highest frequency
constexpr double tolerance = 1e-11;    // of Reduced::error
constexpr double converging = 1e-6;    // the same: from here on each block makes it much less
constexpr double dependent = 1e-12;    // what remains of a vector after taking out those before
constexpr double almost = 0.1;         // the same: from here on rounding counts
constexpr Index largest_whole = 1000;  // rows of which the space may have all
constexpr Index most_vectors = 1500;   // of V
constexpr int samples = 24;            // of the frequency
constexpr int samples_with_damping = 8;
constexpr double loss_factor = 0.01;

void listen(const scene::StopRequest& stop) {
  if (scene::is_asked(stop)) throw scene::Interrupted("interrupted while the structure was reduced");
}

// Rows that are linked to those kept, as places in (b, i); -1: not linked.
struct Partition {
  std::vector<int> place;
  Index kept = 0, others = 0;
};

Partition partition(const scene::Matrices& matrices, const std::vector<int>& kept) {
  Partition parts;
  parts.kept = static_cast<Index>(kept.size());
  parts.place.assign(static_cast<std::size_t>(matrices.size()), -1);
  std::vector<int> reached = kept;
  for (std::size_t i = 0; i < kept.size(); ++i)
    parts.place[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (const auto* file : {&matrices.stiffness, &matrices.mass, &matrices.damping}) {
      if (!file->matrix) continue;
      const scene::SparseMatrix& A = *file->matrix;
      const auto j = static_cast<std::size_t>(reached[next]);
      for (auto k = static_cast<std::size_t>(A.starts[j]); k < static_cast<std::size_t>(A.starts[j + 1]);
           ++k) {
        const auto row = static_cast<std::size_t>(A.row_of[k]);
        if (parts.place[row] >= 0 || A.values[k] == 0) continue;
        parts.place[row] = static_cast<int>(reached.size());
        reached.push_back(A.row_of[k]);
      }
    }
  parts.others = static_cast<Index>(reached.size()) - parts.kept;
  return parts;
}

// The blocks of a symmetric matrix in (b, i).
struct Blocks {
  MatrixXd bb;
  Sparse ib, ii;
};

Blocks blocks(const scene::SparseMatrix& A, const Partition& parts) {
  Blocks of{MatrixXd::Zero(parts.kept, parts.kept), Sparse(parts.others, parts.kept),
            Sparse(parts.others, parts.others)};
  std::vector<Eigen::Triplet<double>> ib, ii;
  ii.reserve(A.entries());
  const auto kept = static_cast<int>(parts.kept);
  for (std::size_t c = 0; c < parts.place.size(); ++c) {
    const int j = parts.place[c];
    if (j < 0) continue;
    for (auto k = static_cast<std::size_t>(A.starts[c]); k < static_cast<std::size_t>(A.starts[c + 1]); ++k) {
      const int i = parts.place[static_cast<std::size_t>(A.row_of[k])];
      if (i < 0) continue;
      if (i < kept && j < kept)
        of.bb(i, j) = A.values[k];
      else if (i >= kept && j < kept)
        ib.emplace_back(i - kept, j, A.values[k]);
      else if (i >= kept && j >= kept)
        ii.emplace_back(i - kept, j - kept, A.values[k]);
    }
  }
  of.ib.setFromTriplets(ib.begin(), ib.end());
  of.ii.setFromTriplets(ii.begin(), ii.end());
  return of;
}

// Z of the coordinates (b, z), V^T A_ii V = 1: M_zz, and C_zz where there is damping.
struct Projected {
  MatrixXd M_c, A_c, C_c;
  MatrixXd M_zz, C_zz, M_zb, C_zb;
};

class Cholesky : public Eigen::CholmodSupernodalLLT<Sparse> {
 public:
  using CholmodSupernodalLLT::CholmodSupernodalLLT;
  // The column where it failed, in the order of the matrix.
  std::optional<Index> failed_at() const {
    if (m_cholmodFactor == nullptr || m_cholmodFactor->minor >= m_cholmodFactor->n) return {};
    return static_cast<const int*>(m_cholmodFactor->Perm)[m_cholmodFactor->minor];
  }
};

class Reduction {
 public:
  Reduction(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
            const scene::StopRequest& stop)
      : matrices_(matrices),
        highest_(highest),
        sigma_(std::pow(shift_at * highest, 2)),
        stop_(stop),
        parts_(partition(matrices, kept)),
        M_(blocks(*matrices.mass.matrix, parts_)),
        K_(blocks(*matrices.stiffness.matrix, parts_)) {
    if (matrices.damping.matrix) C_ = blocks(*matrices.damping.matrix, parts_);
  }

  Reduced run() {
    Reduced result;
    if (parts_.others > 0) {
      factorize();
      condense_statically();
      result.error = span();
    } else {
      P_.A_c = K_.bb + sigma_ * M_.bb;
      P_.M_c = M_.bb;
      if (C_) P_.C_c = C_->bb;
    }
    project(result);
    return result;
  }

 private:
  void factorize() {
    listen(stop_);
    A_.cholmod().print = 0;
    // Minimum degree alone: METIS, which CHOLMOD also tries, takes SIGTERM for itself meanwhile.
    A_.cholmod().nmethods = 1;
    A_.cholmod().method[0].ordering = CHOLMOD_AMD;
    A_.compute(K_.ii + sigma_ * M_.ii);
    listen(stop_);
    if (A_.info() == Eigen::Success) return;
    std::string message =
        "the matrices cannot be reduced: K + s M with s = " + std::to_string(sigma_) +
        " 1/s^2 is not positive definite, as it is where mass and stiffness are positive semidefinite";
    if (const auto column = A_.failed_at())
      for (std::size_t row = 0; row < parts_.place.size(); ++row)
        if (parts_.place[row] == *column + parts_.kept)
          message += "; the elimination stops at row " + std::to_string(row + 1);
    throw ReductionError(message);
  }

  void condense_statically() {
    const MatrixXd A_ib = K_.ib + sigma_ * M_.ib;
    Psi_ = -A_.solve(A_ib);
    const auto projected = [&](const Blocks& of, const MatrixXd& R) {
      const MatrixXd sum = of.bb + Psi_.transpose() * R + of.ib.transpose() * Psi_;
      return MatrixXd(0.5 * (sum + sum.transpose()));
    };
    R_ = M_.ii * Psi_ + M_.ib;
    P_.M_c = projected(M_, R_);
    P_.A_c = K_.bb + sigma_ * M_.bb + A_ib.transpose() * Psi_;
    P_.A_c = 0.5 * (P_.A_c + P_.A_c.transpose()).eval();
    if (!C_) return;
    R_C_ = C_->ii * Psi_ + C_->ib;
    P_.C_c = projected(*C_, R_C_);
  }

  // Makes V, and all that is projected onto it. The estimate of the error.
  double span() {
    const Index most = std::min(most_vectors, parts_.others);
    V_.resize(parts_.others, 0);
    AV_.resize(parts_.others, 0);
    P_.M_zb.resize(0, parts_.kept);
    P_.C_zb.resize(0, parts_.kept);
    MatrixXd right = R_;
    if (C_) right = beside(R_, R_C_);
    double error = HUGE_VAL;
    while (V_.cols() < most) {
      const Index old = V_.cols();
      append(std::move(right), most);
      if (V_.cols() == old) return span_whole(error);  // all that b can excite, to rounding
      const double last = std::exchange(error, change(old));
      if (error <= tolerance) return error;
      if (last < converging && error > 0.3 * last) {  // to rounding: this block brings no more
        keep(old);
        return std::max(error, last);
      }
      const MatrixXd added = V_.rightCols(V_.cols() - old);
      right = M_.ii * added;
      if (C_) right = beside(right, C_->ii * added);
    }
    return span_whole(error);
  }

  // All of the others, if the space has grown to most of them without an end.
  double span_whole(double error) {
    if (error <= converging || parts_.others > largest_whole) return error;
    keep(0);
    const MatrixXd M = M_.ii, A = K_.ii + sigma_ * M_.ii;
    V_ = continuation::symmetric_modes(M, A).V;
    P_.M_zz = V_.transpose() * (M_.ii * V_);
    P_.M_zb = V_.transpose() * R_;
    if (!C_) return 0;
    P_.C_zz = V_.transpose() * (C_->ii * V_);
    P_.C_zb = V_.transpose() * R_C_;
    return 0;
  }

  static MatrixXd beside(const MatrixXd& a, const MatrixXd& b) {
    MatrixXd both(a.rows(), a.cols() + b.cols());
    both << a, b;
    return both;
  }

  // Appends to V what A^-1 right has beside it, in the norm of A. A V is kept: A times what is solved for is
  // right itself, so that nothing cancels.
  void append(MatrixXd right, Index most) {
    listen(stop_);
    MatrixXd W = A_.solve(right);
    listen(stop_);
    const VectorXd size = (W.array() * right.array()).colwise().sum().max(0.0).sqrt();
    const auto take_out = [](const auto& V, const auto& AV, auto&& w, auto&& Aw) {
      for (int pass = 0; pass < 2; ++pass) {
        const MatrixXd shares = V.transpose() * Aw;
        w -= V * shares;
        Aw -= AV * shares;
      }
    };
    take_out(V_, AV_, W, right);
    const Index old = V_.cols();
    V_.conservativeResize(Eigen::NoChange, old + W.cols());
    AV_.conservativeResize(Eigen::NoChange, old + W.cols());
    Index count = old;
    for (Index j = 0; j < W.cols() && count < most; ++j) {
      take_out(V_.middleCols(old, count - old), AV_.middleCols(old, count - old), W.col(j), right.col(j));
      const auto length = [&] { return std::sqrt(std::max(W.col(j).dot(right.col(j)), 0.0)); };
      double norm = length(), before = size[j];
      while (norm < almost * before && norm > dependent * size[j]) {
        // What remains of A w is rounding of what was taken out.
        before = norm;
        right.col(j) = K_.ii * W.col(j) + sigma_ * (M_.ii * W.col(j));
        take_out(V_.leftCols(count), AV_.leftCols(count), W.col(j), right.col(j));
        norm = length();
      }
      if (!(norm > dependent * size[j])) continue;
      V_.col(count) = W.col(j) / norm;
      AV_.col(count++) = right.col(j) / norm;
    }
    keep(count);
    const auto added = V_.rightCols(count - old);
    const auto extend = [&](MatrixXd& square, const MatrixXd& product) {
      const MatrixXd columns = V_.transpose() * product;
      square.conservativeResize(count, count);
      square.rightCols(count - old) = columns;
      square.bottomRows(count - old) = columns.transpose();
      const MatrixXd corner = columns.bottomRows(count - old);
      square.bottomRightCorner(count - old, count - old) = 0.5 * (corner + corner.transpose());
    };
    extend(P_.M_zz, M_.ii * added);
    P_.M_zb.conservativeResize(count, Eigen::NoChange);
    P_.M_zb.bottomRows(count - old) = added.transpose() * R_;
    if (!C_) return;
    extend(P_.C_zz, C_->ii * added);
    P_.C_zb.conservativeResize(count, Eigen::NoChange);
    P_.C_zb.bottomRows(count - old) = added.transpose() * R_C_;
  }

  // The first vectors alone.
  void keep(Index count) {
    V_.conservativeResize(Eigen::NoChange, count);
    AV_.conservativeResize(Eigen::NoChange, count);
    if (P_.M_zz.rows() <= count) return;
    P_.M_zz.conservativeResize(count, count);
    P_.M_zb.conservativeResize(count, Eigen::NoChange);
    if (!C_) return;
    P_.C_zz.conservativeResize(count, count);
    P_.C_zb.conservativeResize(count, Eigen::NoChange);
  }

  // The largest difference that the vectors after the first ones make, at frequencies all over the range and,
  // without C, at the poles. What they add to Z is a Schur complement.
  double change(Index first) const {
    const Modes before = modes(first), now = modes(P_.M_zz.rows());
    std::vector<double> squares;  // s^2
    const int all = C_ ? samples_with_damping : samples;
    for (int k = 0; k <= all; ++k) squares.push_back(std::pow(highest_ * k / all, 2));
    if (!C_)
      for (const double theta : now.theta)
        if (const double square = 1 / theta - sigma_; theta > 0 && square > 0 && square < highest_ * highest_)
          squares.push_back(square);
    double largest = 0;
    for (const double square : squares) {
      const Complex p = square * Complex(1, loss_factor) + sigma_;
      const VectorXd scale =
          (P_.A_c.diagonal().cwiseAbs() + std::abs(p) * P_.M_c.diagonal().cwiseAbs()).cwiseSqrt();
      const Eigen::MatrixXcd added =
          C_ ? Eigen::MatrixXcd(interior(P_.M_zz.rows(), square) - interior(first, square))
             : Eigen::MatrixXcd(now.interior(p) - before.interior(p));
      for (Index j = 0; j < added.cols(); ++j)
        for (Index i = 0; i < added.rows(); ++i)
          if (scale[i] * scale[j] > 0)
            largest = std::max(largest, std::abs(added(i, j)) / (scale[i] * scale[j]));
    }
    return largest;
  }

  // Eigenvalues of M_zz, and M_zb in its eigenvectors.
  struct Modes {
    VectorXd theta;
    MatrixXd mu;

    // Z_bz Z_zz^-1 Z_zb
    Eigen::MatrixXcd interior(Complex p) const {
      const Eigen::VectorXcd factors = p * p / (1.0 - p * theta.array().cast<Complex>());
      return mu.transpose() * factors.asDiagonal() * mu;
    }
  };
  Modes modes(Index count) const {
    if (C_ || count == 0) return {VectorXd(0), MatrixXd(0, parts_.kept)};
    const auto found = continuation::symmetric_modes(P_.M_zz.topLeftCorner(count, count));
    return {found.values, found.V.transpose() * P_.M_zb.topRows(count)};
  }
  // The same with C.
  Eigen::MatrixXcd interior(Index count, double square) const {
    if (count == 0) return Eigen::MatrixXcd::Zero(parts_.kept, parts_.kept);
    const Complex p = square * Complex(1, loss_factor) + sigma_, is(0, std::sqrt(square));
    const Eigen::MatrixXcd Z_zz = MatrixXd::Identity(count, count).cast<Complex>() -
                                  p * P_.M_zz.topLeftCorner(count, count) +
                                  is * P_.C_zz.topLeftCorner(count, count),
                           Z_zb = -p * P_.M_zb.topRows(count) + is * P_.C_zb.topRows(count);
    return Z_zb.transpose() * continuation::solve_complex(Z_zz, Z_zb);
  }

  // In the eigenvectors of M_zz.
  void project(Reduced& into) const {
    const Index b = parts_.kept, z = P_.M_zz.rows();
    const auto put = [&](MatrixXd& whole, const MatrixXd& bb, const MatrixXd& zb) {
      whole.setZero(b + z, b + z);
      whole.topLeftCorner(b, b) = bb;
      whole.bottomLeftCorner(z, b) = zb;
      whole.topRightCorner(b, z) = zb.transpose();
    };
    if (z == 0) {
      into.M = P_.M_c;
      into.K = P_.A_c - sigma_ * P_.M_c;
      if (C_) into.C = P_.C_c;
      return;
    }
    const auto [theta, Q] = continuation::symmetric_modes(P_.M_zz);
    const MatrixXd mu = Q.transpose() * P_.M_zb;
    put(into.M, P_.M_c, mu);
    put(into.K, P_.A_c - sigma_ * P_.M_c, -sigma_ * mu);
    into.M.diagonal().tail(z) = theta.cwiseMax(0.0);
    into.K.diagonal().tail(z) = 1 - sigma_ * theta.cwiseMax(0.0).array();
    if (!C_) return;
    put(into.C, P_.C_c, Q.transpose() * P_.C_zb);
    const MatrixXd C_zz = Q.transpose() * P_.C_zz * Q;
    into.C.bottomRightCorner(z, z) = 0.5 * (C_zz + C_zz.transpose());
  }

  const scene::Matrices& matrices_;
  const double highest_, sigma_;
  const scene::StopRequest& stop_;
  const Partition parts_;
  const Blocks M_, K_;
  std::optional<Blocks> C_;
  Cholesky A_;
  MatrixXd Psi_, R_, R_C_;  // R_C: C_ii Psi + C_ib
  MatrixXd V_, AV_;
  Projected P_;
};

}  // namespace

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
               const scene::StopRequest& stop) {
  return Reduction(matrices, kept, highest, stop).run();
}

}  // namespace arcslip::structure
