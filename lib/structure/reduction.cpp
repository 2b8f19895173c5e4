#include <arcslip/structure/reduction.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/interruptible.hpp>
#include <arcslip/structure/blocks.hpp>
#include <arcslip/structure/digit_loss.hpp>
#include <arcslip/structure/projected.hpp>
#include <arcslip/structure/symmetry.hpp>

#include <Eigen/CholmodSupport>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <random>
#include <sstream>
#include <utility>

#include <sys/mman.h>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr double shift_at = 0.3;     // sqrt(sigma) over the highest frequency
constexpr double tolerance = 1e-11;  // of the error
constexpr double converging = 1e-6;  // the same: from here on each estimate is much less
constexpr double settling = 1e-2;    // the same: from here on some of the next few are
constexpr int next_few = 6;          // estimates
constexpr double much_less = 0.3;    // an error over the one before
constexpr double largest_error = 1e-3;
constexpr double growth = 1.1;       // of V from one estimate to the next
constexpr double dependent = 1e-12;  // what remains of a vector after taking out those before
constexpr double almost = 0.1;       // the same: from here on rounding counts

constexpr const char* interrupted = "interrupted while the structure was reduced";

void listen(const control::Control& control) {
  if (!control.keep_going()) throw control::Interrupted(interrupted);
}

// OpenBLAS takes 128 MB at its first use, and asks for them without an end where there are none.
constexpr std::size_t memory_of_blas = std::size_t{168} << 20;  // bytes

void require_memory_of_blas() {
  static std::once_flag known;
  std::call_once(known, [] {
    void* const memory = ::mmap(nullptr, memory_of_blas, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ::munmap(memory, memory_of_blas);
  });
}

class Cholesky : public Eigen::CholmodSupernodalLLT<Sparse> {
 public:
  using CholmodSupernodalLLT::CholmodSupernodalLLT;
  // The column where it failed, in the order of the matrix.
  std::optional<Index> failed_at() const {
    if (m_cholmodFactor == nullptr || m_cholmodFactor->minor >= m_cholmodFactor->n) return {};
    return static_cast<const int*>(m_cholmodFactor->Perm)[m_cholmodFactor->minor];
  }
};

Partition partition_of(const scene::Matrices& matrices, const std::vector<Skew>& skew,
                       const std::vector<int>& kept) {
  std::vector<const scene::SparseMatrix*> all{matrices.stiffness.matrix.get(), matrices.mass.matrix.get(),
                                              matrices.damping.matrix.get()};
  for (const Skew& each : skew) all.push_back(&each.A);
  return partition(matrices.size(), all, kept);
}

// With the stiffness at the speed of the expansion.
scene::Matrices at_speed(scene::Matrices matrices, double square) {
  if (!matrices.stiffness_speed_squared.matrix) return matrices;
  std::vector<scene::MatrixEntry> entries;
  const auto add = [&](const scene::SparseMatrix& A, double factor) {
    for (int j = 0; j < A.columns; ++j)
      for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
           k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k)
        entries.push_back({A.row_of[k], j, factor * A.values[k]});
  };
  add(*matrices.stiffness.matrix, 1);
  add(*matrices.stiffness_speed_squared.matrix, square);
  matrices.stiffness.matrix = std::make_shared<const scene::SparseMatrix>(
      scene::sparse_matrix(matrices.size(), matrices.size(), entries));
  return matrices;
}

class Reduction {
 public:
  Reduction(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose, Index most,
            const control::Control& control)
      : square_(0.5 * purpose.highest_speed * purpose.highest_speed),
        matrices_(at_speed(symmetric_parts(matrices), square_)),
        skew_(skew_parts(matrices)),
        highest_(purpose.highest),
        most_(most),
        sigma_(std::pow(shift_at * highest_, 2)),
        control_(control),
        parts_(partition_of(matrices_, skew_, kept)),
        M_(blocks(*matrices_.mass.matrix, parts_)),
        K_(blocks(*matrices_.stiffness.matrix, parts_)) {
    if (matrices_.damping.matrix) C_ = blocks(*matrices_.damping.matrix, parts_);
    if (matrices.stiffness_speed_squared.matrix) {
      K2_ = blocks(*matrices.stiffness_speed_squared.matrix, parts_);
    }
    bool by_speed = K2_.has_value();
    for (const Skew& each : skew_) {
      S_.push_back(blocks(each.A, parts_));
      P_.skew.push_back({each.of_velocity, each.by_speed, {}, {}, {}});
      by_speed = by_speed || each.by_speed;
    }
    if (by_speed && square_ > 0) {
      P_.stiffening = {-square_, -0.5 * square_, 0, 0.5 * square_, square_};
      P_.square = square_;
    }
    const Index loads = purpose.loads.cols();
    f_b_.setZero(parts_.kept, loads);
    f_i_.setZero(parts_.others, loads);
    for (std::size_t row = 0; row < parts_.place.size(); ++row)
      if (const Index at = parts_.place[row]; at >= parts_.kept && loads > 0)
        f_i_.row(at - parts_.kept) = purpose.loads.row(static_cast<Index>(row));
      else if (at >= 0 && loads > 0)
        f_b_.row(at) = purpose.loads.row(static_cast<Index>(row));
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
      if (K2_) P_.K2_c = K2_->bb;
      for (std::size_t k = 0; k < S_.size(); ++k) P_.skew[k].c = S_[k].bb;
      P_.f_c = f_b_;
    }
    for (const MatrixXd* of : {&P_.M_c, &P_.A_c, &P_.C_c, &P_.K2_c, &P_.f_c, &P_.M_zz, &P_.C_zz, &P_.K2_zz,
                               &P_.M_zb, &P_.C_zb, &P_.K2_zb, &P_.f_z})
      if (!of->allFinite()) refuse_overflow();
    for (const ProjectedSkew& skew : P_.skew)
      if (!skew.c.allFinite() || !skew.zz.allFinite() || !skew.zb.allFinite()) refuse_overflow();
    add_rounding(result);
    project(result);
    return result;
  }

 private:
  void factorize() {
    listen(control_);
    A_.cholmod().print = 0;
    // Minimum degree alone: METIS, which CHOLMOD also tries, takes SIGTERM for itself meanwhile.
    A_.cholmod().nmethods = 1;
    A_.cholmod().method[0].ordering = CHOLMOD_AMD;
    const Sparse A = K_.ii + sigma_ * M_.ii;
    // Not every LAPACK finds a NaN.
    if (!Eigen::Map<const VectorXd>(A.valuePtr(), A.nonZeros()).allFinite()) refuse_overflow();
    require_memory_of_blas();
    A_.compute(A);
    listen(control_);
    if (A_.info() == Eigen::Success) return;
    std::string where;
    if (const auto column = A_.failed_at())
      for (std::size_t row = 0; row < parts_.place.size(); ++row)
        if (parts_.place[row] == *column + parts_.kept)
          where = "; the elimination stops at row " + std::to_string(row + 1);
    refuse_indefinite(where);
  }

  [[noreturn]] static void refuse(const std::string& cause) {
    throw ReductionError("the matrices cannot be reduced: " + cause);
  }
  [[noreturn]] static void refuse_overflow() {
    refuse("their entries are too large, too small or too far apart for double precision");
  }
  [[noreturn]] void refuse_indefinite(const std::string& where) const {
    refuse("K + s M with s = " + text(sigma_) +
           " 1/s^2 is not positive definite, as it is where mass and stiffness are positive semidefinite and "
           "no part without mass floats" +
           where);
  }
  static std::string text(double value) {
    std::ostringstream out;
    out.precision(3);
    out << value;
    return out.str();
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
    if (C_) {
      R_C_ = C_->ii * Psi_ + C_->ib;
      P_.C_c = projected(*C_, R_C_);
    }
    if (K2_) {
      R_2_ = K2_->ii * Psi_ + K2_->ib;
      P_.K2_c = projected(*K2_, R_2_);
    }
    for (std::size_t k = 0; k < S_.size(); ++k) {
      R_S_.push_back(S_[k].ii * Psi_ + S_[k].ib);
      const MatrixXd sum = S_[k].bb + Psi_.transpose() * R_S_[k] - S_[k].ib.transpose() * Psi_;
      P_.skew[k].c = 0.5 * (sum - sum.transpose());
    }
    condense_loads();
  }

  void condense_loads() {
    P_.f_c = f_b_ + Psi_.transpose() * f_i_;
    P_.load_size.setZero(f_i_.cols());
    if (f_i_.cols() == 0) return;
    const MatrixXd of_b = continuation::solve(P_.A_c, P_.f_c), of_i = A_.solve(f_i_);
    P_.load_size =
        ((of_b.array() * P_.f_c.array()).colwise().sum() + (of_i.array() * f_i_.array()).colwise().sum())
            .max(0.0)
            .sqrt()
            .matrix()
            .transpose();
  }

  // Empties V; A^-1 times each of these is the beginning of the space.
  MatrixXd first() {
    V_.resize(parts_.others, 0);
    AV_.resize(parts_.others, 0);
    for (MatrixXd* of : {&P_.M_zb, &P_.C_zb, &P_.K2_zb}) of->resize(0, parts_.kept);
    for (ProjectedSkew& skew : P_.skew) skew.zb.resize(0, parts_.kept);
    P_.f_z.resize(0, f_i_.cols());
    MatrixXd right = nearby(R_, f_i_);
    if (C_) right = nearby(right, R_C_);
    if (K2_) right = nearby(right, R_2_);
    for (const MatrixXd& R : R_S_) right = nearby(right, R);
    return right;
  }

  // A vector of the space leads to A^-1 times each of these.
  MatrixXd next(const MatrixXd& added) const {
    MatrixXd right = M_.ii * added;
    if (C_) right = nearby(right, C_->ii * added);
    if (K2_) right = nearby(right, K2_->ii * added);
    for (const Blocks& S : S_) right = nearby(right, S.ii * added);
    return right;
  }

  // Makes V, and all that is projected onto it. The estimate of the error.
  double span() {
    const Index most = std::min(most_, parts_.others);
    MatrixXd right = first();
    double error = HUGE_VAL, least = HUGE_VAL;
    Index estimated = 0;  // vectors at the last estimate
    int since_least = 0;  // estimates
    while (V_.cols() < most && since_least < next_few && !std::isnan(error)) {
      const Index old = V_.cols();
      append(std::move(right), most);
      if (V_.cols() == old) {  // all that b can excite, to rounding: then any others add nothing
        append(noise(), most);
        if (V_.cols() == old) break;
        const double missed = change(P_, sigma_, highest_, old);
        if (missed <= tolerance) {
          keep(old);
          return missed;
        }
      }
      right = next(V_.rightCols(V_.cols() - old));
      if (static_cast<double>(V_.cols()) < growth * static_cast<double>(estimated) && V_.cols() < most)
        continue;
      const double last = std::exchange(error, change(P_, sigma_, highest_, estimated));
      if (error <= tolerance) return error;
      if (std::max(error, last) < converging && error > much_less * last) {
        keep(estimated);  // to rounding: what came since brings no more
        return std::max(error, last);
      }
      since_least = least < settling && !(error < much_less * least) ? since_least + 1 : 0;
      least = std::min(least, error);
      estimated = V_.cols();
    }
    if (std::isnan(error)) refuse_overflow();
    if (parts_.others <= most_) return span_whole();
    if (error > largest_error)
      refuse("the error of the dynamic stiffness is " + text(error) + " with " + std::to_string(V_.cols()) +
             " coordinates and does not fall any further, must be at most " + text(largest_error) +
             "; lower \"highest_frequency\", or let the scene use fewer rows");
    return error;
  }

  // All of the others, where the space has grown to most of them without an end.
  double span_whole() {
    keep(0);
    const MatrixXd M = M_.ii, A = K_.ii + sigma_ * M_.ii;
    V_ = continuation::symmetric_modes(M, A).V;
    if (V_.size() == 0) refuse_indefinite("");
    P_.M_zz = V_.transpose() * (M_.ii * V_);
    P_.M_zb = V_.transpose() * R_;
    P_.f_z = V_.transpose() * f_i_;
    if (C_) {
      P_.C_zz = V_.transpose() * (C_->ii * V_);
      P_.C_zb = V_.transpose() * R_C_;
    }
    if (K2_) {
      P_.K2_zz = V_.transpose() * (K2_->ii * V_);
      P_.K2_zb = V_.transpose() * R_2_;
    }
    for (std::size_t k = 0; k < S_.size(); ++k) {
      const MatrixXd zz = V_.transpose() * (S_[k].ii * V_);
      P_.skew[k].zz = 0.5 * (zz - zz.transpose());
      P_.skew[k].zb = V_.transpose() * R_S_[k];
    }
    return 0;
  }

  // Forces that excite everything.
  MatrixXd noise() const {
    std::minstd_rand random;
    const auto any = [&] { return static_cast<double>(random()) / std::minstd_rand::max() - 0.5; };
    const VectorXd scale = (K_.ii.diagonal() + sigma_ * M_.ii.diagonal()).cwiseAbs().cwiseSqrt();
    return scale.asDiagonal() * MatrixXd::NullaryExpr(parts_.others, parts_.kept, any);
  }

  // What the last digits of the entries change, as far as the rows that are kept see it.
  void add_rounding(Reduced& result) const {
    const Index b = parts_.kept, z = P_.M_zz.rows();
    MatrixXd M = MatrixXd::Zero(b + z, b + z), A = MatrixXd::Identity(b + z, b + z);
    A.topLeftCorner(b, b) = P_.A_c;
    M.topLeftCorner(b, b) = P_.M_c;
    if (z > 0) {
      M.bottomRightCorner(z, z) = P_.M_zz;
      M.bottomLeftCorner(z, b) = P_.M_zb;
      M.topRightCorner(b, z) = P_.M_zb.transpose();
    }
    const auto modes = continuation::symmetric_modes(M, A);
    if (modes.values.size() != b + z) refuse_indefinite("; it is not in the rows that the scene uses");
    const auto mode = [&](Index j) {
      const VectorXd v = modes.V.col(b + z - 1 - j);
      VectorXd x(b + parts_.others);
      x.head(b) = v.head(b);
      if (parts_.others > 0) x.tail(parts_.others) = Psi_ * v.head(b) + V_ * v.tail(z);
      return x;
    };
    const Rounding found = rounding(matrices_, parts_, sigma_, b + z, mode);
    if (!(found.change <= largest_error))
      refuse("the last digits of their entries change the square of the lowest natural frequency by " +
             text(found.change) + " of it, must be at most " + text(largest_error) +
             "; replace very stiff links by rigid ones, and very short elements by longer ones");
    result.error += found.change;
    result.free_below = found.free_below;
  }

  static MatrixXd nearby(const MatrixXd& a, const MatrixXd& b) {
    MatrixXd both(a.rows(), a.cols() + b.cols());
    both << a, b;
    return both;
  }

  // Appends to V what A^-1 right has next to it, in the norm of A. A V is kept: A times what is solved for is
  // right itself, so that nothing cancels.
  void append(MatrixXd right, Index most) {
    listen(control_);
    MatrixXd W = A_.solve(right);
    listen(control_);
    if (!W.allFinite()) refuse_overflow();
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
    project_from(old);
  }

  // Onto the vectors of V from `old` on.
  void project_from(Index old) {
    const Index count = V_.cols();
    const auto added = V_.rightCols(count - old);
    const auto extend = [&](MatrixXd& square, const MatrixXd& product, double sign = 1) {
      const MatrixXd columns = V_.transpose() * product;
      square.conservativeResize(count, count);
      square.rightCols(count - old) = columns;
      square.bottomRows(count - old) = sign * columns.transpose();
      const MatrixXd corner = columns.bottomRows(count - old);
      square.bottomRightCorner(count - old, count - old) = 0.5 * (corner + sign * corner.transpose());
    };
    const auto extend_rows = [&](MatrixXd& rows, const MatrixXd& R) {
      rows.conservativeResize(count, Eigen::NoChange);
      rows.bottomRows(count - old) = added.transpose() * R;
    };
    extend(P_.M_zz, M_.ii * added);
    extend_rows(P_.M_zb, R_);
    extend_rows(P_.f_z, f_i_);
    if (C_) {
      extend(P_.C_zz, C_->ii * added);
      extend_rows(P_.C_zb, R_C_);
    }
    if (K2_) {
      extend(P_.K2_zz, K2_->ii * added);
      extend_rows(P_.K2_zb, R_2_);
    }
    for (std::size_t k = 0; k < S_.size(); ++k) {
      extend(P_.skew[k].zz, S_[k].ii * added, -1);
      extend_rows(P_.skew[k].zb, R_S_[k]);
    }
  }

  // The first vectors alone.
  void keep(Index count) {
    V_.conservativeResize(Eigen::NoChange, count);
    AV_.conservativeResize(Eigen::NoChange, count);
    if (P_.M_zz.rows() <= count) return;
    for (MatrixXd* square : {&P_.M_zz, &P_.C_zz, &P_.K2_zz})
      if (square->rows() > count) square->conservativeResize(count, count);
    for (MatrixXd* rows : {&P_.M_zb, &P_.C_zb, &P_.K2_zb, &P_.f_z})
      if (rows->rows() > count) rows->conservativeResize(count, Eigen::NoChange);
    for (ProjectedSkew& skew : P_.skew) {
      if (skew.zz.rows() > count) skew.zz.conservativeResize(count, count);
      if (skew.zb.rows() > count) skew.zb.conservativeResize(count, Eigen::NoChange);
    }
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
    into.loads = P_.f_c;
    MatrixXd Q;  // eigenvectors of M_zz
    if (z == 0) {
      into.M = P_.M_c;
      into.K = P_.A_c - sigma_ * P_.M_c;
      if (C_) into.C = P_.C_c;
      if (K2_) into.K2 = P_.K2_c;
    } else {
      continuation::SymmetricModes modes = continuation::symmetric_modes(P_.M_zz);
      if (modes.values.size() != P_.M_zz.rows()) refuse_overflow();
      const VectorXd& theta = modes.values;
      Q = std::move(modes.V);
      const MatrixXd mu = Q.transpose() * P_.M_zb;
      put(into.M, P_.M_c, mu);
      put(into.K, P_.A_c - sigma_ * P_.M_c, -sigma_ * mu);
      into.M.diagonal().tail(z) = theta.cwiseMax(0.0);
      into.K.diagonal().tail(z) = 1 - sigma_ * theta.cwiseMax(0.0).array();
      const auto put_full = [&](MatrixXd& whole, const MatrixXd& c, const MatrixXd& zb, const MatrixXd& zz) {
        put(whole, c, Q.transpose() * zb);
        const MatrixXd in_modes = Q.transpose() * zz * Q;
        whole.bottomRightCorner(z, z) = 0.5 * (in_modes + in_modes.transpose());
      };
      if (C_) put_full(into.C, P_.C_c, P_.C_zb, P_.C_zz);
      if (K2_) put_full(into.K2, P_.K2_c, P_.K2_zb, P_.K2_zz);
      into.loads.conservativeResize(b + z, Eigen::NoChange);
      into.loads.bottomRows(z) = Q.transpose() * P_.f_z;
    }
    if (K2_) into.K -= square_ * into.K2;
    for (const ProjectedSkew& skew : P_.skew) {
      MatrixXd& to =
          skew.by_speed ? (skew.of_velocity ? into.G : into.N) : (skew.of_velocity ? into.C : into.K);
      if (to.size() == 0) to.setZero(b + z, b + z);
      to.topLeftCorner(b, b) += skew.c;
      if (z == 0) continue;
      const MatrixXd zb = Q.transpose() * skew.zb, zz = Q.transpose() * skew.zz * Q;
      to.bottomLeftCorner(z, b) += zb;
      to.topRightCorner(b, z) -= zb.transpose();
      to.bottomRightCorner(z, z) += 0.5 * (zz - zz.transpose());
    }
  }

  const double square_;             // of the speed of the expansion
  const scene::Matrices matrices_;  // symmetric parts
  const std::vector<Skew> skew_;
  const double highest_;
  const Index most_;
  const double sigma_;
  const control::Control& control_;
  const Partition parts_;
  const Blocks M_, K_;
  std::optional<Blocks> C_, K2_;
  std::vector<Blocks> S_;  // of skew_
  MatrixXd f_b_, f_i_;     // loads
  Cholesky A_;
  MatrixXd Psi_, R_, R_C_, R_2_;  // R_C: C_ii Psi + C_ib; R_2: the same of K2
  std::vector<MatrixXd> R_S_;     // of skew_
  MatrixXd V_, AV_;
  Projected P_;
};

}  // namespace

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose,
               const control::Control& control, int most) {
  return control::interruptible(
      [=](const control::Control& given_up) {
        return Reduction(matrices, kept, purpose, most, given_up).run();
      },
      control, interrupted);
}

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
               const control::Control& control, int most) {
  return reduce(matrices, kept, Purpose{highest, 0, {}}, control, most);
}

}  // namespace arcslip::structure
