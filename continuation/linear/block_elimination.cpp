// Block elimination around a solver of J (Govaerts, Pryce: Block elimination with one refinement solves
// bordered linear systems accurately, BIT 30, 1990). With V = J^-1 C and S = D - R V,
//
//   [J C; R D] (x, y) = (f, g):        w = J^-1 f,  y = S^-1 (g - R w),  x = w - V y
//   its transpose (x, y) = (f, g):     y = S^-T (g - V^T f),  x = J^-T (f - R^T y)
//   det [J C; R D] = det J det S
//
// Why one refinement suffices for a numerically singular J. Let s be the smallest singular value of the
// matrix that the solver of J effectively solves with, J + E, |E| of the order e of rounding, and phi its
// singular vector; all else is of size 1. w and V are large only along phi, of order 1/s, and so is S. y is a
// quotient of two such numbers: its relative error is e. In x = w - V y the large parts cancel and leave an
// error d = e/s along phi, to which J + E is insensitive: the residual is e d in f and d in g. The refinement
// step eliminates these: w is e d/s, for s >= e no larger than d, so that no large parts cancel any more, and
// y = O(s d) removes d from g with a relative error e. In general each sweep reduces the error by e (1 +
// e/s), down to the effect of rounding of size e in f: e (1 + e/s), times the condition number of the
// bordered matrix if s < e. The residual is computed with J itself, so that E has no effect on the result.
// Iterative solvers, with e their tolerance, take a few more sweeps.
//
// For the same reason a J that is singular to the last bit, or which its solver refuses, throws at or does
// not really solve with, is replaced by one next to it (near_singular.hpp): E is then larger than rounding,
// and refinement, which goes by J, reduces the error by |E| in each sweep.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/linear/near_singular.hpp>
#include <arcslip/continuation/linear/refinement.hpp>

#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>

namespace arcslip::continuation {
namespace {

// Of a generic right-hand side, left by a solution: more, and the bordered matrix is singular itself.
constexpr double largest_residual_nearby = 1e-5;

class BlockElimination final : public LinearSolver {
 public:
  explicit BlockElimination(std::unique_ptr<PlainSolver> plain)
      : plain_(std::move(plain)), name_("block elimination around ") {
    if (!plain_) throw std::invalid_argument("block elimination needs a solver of J");
    name_ += plain_->name();
  }

  const char* name() const override { return name_.c_str(); }

  bool factorize(const Jacobian& J, const Borders& borders) override {
    ready_ = near_tried_ = false;
    J_ = J;  // a copy: refinement needs it after the evaluator has moved
    borders_ = borders;
    const Eigen::Index n = borders.columns.rows(), m = borders.width();
    resize(n, m);
    if (!borders.columns.allFinite() || !borders.rows.allFinite() || !borders.corner.allFinite())
      return false;
    if (!measure_rows()) return false;
    std::exception_ptr thrown;
    try {
      ready_ = takes(J_) && eliminate_columns();
      if (ready_) return true;
    } catch (const std::exception&) {
      thrown = std::current_exception();
    }
    if (works_nearby()) return true;
    if (thrown) std::rethrow_exception(thrown);
    return false;
  }

  void solve(Out x) const override {
    std::exception_ptr thrown;
    try {
      if (ready_ && refine(x, false)) return;
    } catch (const std::exception&) {
      thrown = std::current_exception();
    }
    if (ready_ && !near_tried_) {
      if (works_nearby() && refine(x, false)) return;
      if (!ready_) returns_to_J();
    }
    if (thrown) std::rethrow_exception(thrown);
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  bool solve_transposed(Out x) const override {
    if (!ready_) return false;
    return refine(x, true);
  }

  std::optional<int> determinant_sign() const override {
    const auto of_J = plain_->determinant_sign();
    return of_J ? std::optional(*of_J * sign_of_S_) : std::nullopt;
  }

 private:
  void resize(Eigen::Index n, Eigen::Index m) {
    if (V_.rows() == n && V_.cols() == m) return;
    V_.resize(n, m);
    S_.resize(m, m);
    lu_ = LU<double>(m);
    refinement_.resize(n + m);
    row_sums_.resize(n + m);
    column_sums_.resize(n + m);
    for (Vector* v : {&generic_, &solution_, &image_}) v->resize(n + m);
    w_.resize(n);
    y_.resize(m);
  }

  // Whether the solver solves with this J for all columns C.
  bool takes(const Jacobian& J) const {
    if (!plain_->prepare(J)) return false;
    for (Eigen::Index i = 0; i < V_.cols(); ++i)
      if (!plain_->solve(borders_.columns.col(i), V_.col(i)) || !V_.col(i).allFinite()) return false;
    return true;
  }

  bool eliminate_columns() const {
    S_.noalias() = borders_.corner - borders_.rows.transpose() * V_;
    if (V_.cols() > 0) lu_.factorize(S_);
    return S_.allFinite() && take_sign();
  }

  // The same with a J next to that which the solver refuses. Of an operator there is none: the factors stay.
  bool works_nearby() const {
    near_tried_ = true;
    for (const Nudge& nudge : nudges) {
      try {
        if (!nudged(J_, nudge, nearby_)) return false;
        ready_ = takes(nearby_) && eliminate_columns();
        if (ready_ && is_regular()) return true;
      } catch (const std::exception&) {  // it throws here as well
      }
      ready_ = false;
    }
    return false;
  }

  // After a solve that failed next to J, too.
  void returns_to_J() const {
    try {
      ready_ = takes(J_) && eliminate_columns();
    } catch (const std::exception&) {
    }
  }

  // Whether M x = b has a solution for a generic b: next to a singular J anything can be eliminated.
  bool is_regular() const {
    for (Eigen::Index i = 0; i < generic_.size(); ++i) {
      const double factor = 1 + 0.5 * std::sin(1 + 0.7 * static_cast<double>(i) * static_cast<double>(i));
      generic_[i] = generic_sign(i) * factor * (row_sums_[i] > 0 ? row_sums_[i] : 1);
    }
    solution_ = generic_;
    if (!refine(solution_, false)) return false;
    const Eigen::Index n = w_.size();
    apply(J_, solution_.head(n), image_.head(n));
    add_borders(solution_, false, image_);
    image_ = (image_ - generic_).cwiseQuotient(generic_);
    return image_.lpNorm<Eigen::Infinity>() <= largest_residual_nearby;
  }

  static double generic_sign(Eigen::Index i) {
    return (static_cast<std::uint32_t>(i) * 2654435769u) >> 31 ? 1 : -1;
  }

  bool take_sign() const {
    sign_of_S_ = 1;
    if (borders_.width() == 0) return true;
    bool odd = lu_.permutation_sign() < 0;
    for (Eigen::Index i = 0; i < S_.rows(); ++i) {
      const double pivot = lu_.pivot(i);
      if (pivot == 0 || !std::isfinite(pivot)) return false;
      odd ^= pivot < 0;
    }
    sign_of_S_ = odd ? -1 : 1;
    return true;
  }

  // One solve without refinement: z = M^-1 b approximately. b and z must not alias.
  bool eliminate(const Vector& b, Vector& z) const {
    const Eigen::Index n = w_.size(), m = y_.size();
    if (!plain_->solve(b.head(n), w_)) return false;
    if (m > 0) {
      y_.noalias() = b.tail(m) - borders_.rows.transpose() * w_;
      lu_.solve(y_, z.tail(m));
    }
    z.head(n).noalias() = w_ - V_ * z.tail(m);
    return true;
  }

  bool eliminate_transposed(const Vector& b, Vector& z) const {
    const Eigen::Index n = w_.size(), m = y_.size();
    if (m > 0) {
      y_.noalias() = b.tail(m) - V_.transpose() * b.head(n);
      lu_.solve_transposed(y_, z.tail(m));
    }
    w_.noalias() = b.head(n) - borders_.rows * z.tail(m);
    return plain_->solve_transposed(w_, z.head(n));
  }

  // y, whose head is J z or J^T z, becomes M z or M^T z.
  void add_borders(const Vector& z, bool transposed, Vector& y) const {
    const Eigen::Index n = w_.size(), m = y_.size();
    if (m == 0) return;
    const Eigen::MatrixXd& right = transposed ? borders_.rows : borders_.columns;
    const Eigen::MatrixXd& below = transposed ? borders_.columns : borders_.rows;
    y.head(n).noalias() += right * z.tail(m);
    y.tail(m).noalias() = below.transpose() * z.head(n);
    if (transposed)
      y.tail(m).noalias() += borders_.corner.transpose() * z.tail(m);
    else
      y.tail(m).noalias() += borders_.corner * z.tail(m);
  }

  // False: x is unchanged.
  bool refine(Out x, bool transposed) const {
    const Vector& sums = transposed ? column_sums_ : row_sums_;
    const auto eliminate = [&](const Vector& b, Vector& z) {
      return transposed ? this->eliminate_transposed(b, z) : this->eliminate(b, z);
    };
    const auto product = [&](const Vector& z, Vector& y) {
      const Eigen::Index n = w_.size();
      if (!transposed)
        apply(J_, z.head(n), y.head(n));
      else if (!apply_transposed(J_, z.head(n), y.head(n)))
        return false;
      add_borders(z, transposed, y);
      return true;
    };
    return refinement_.solve(x, sums, eliminate, product);
  }

  // Sums of the magnitudes in the rows and columns of M, False: not finite.
  bool measure_rows() {
    const Eigen::Index n = V_.rows(), m = V_.cols();
    row_sums_.setZero();
    column_sums_.setZero();
    if (const auto* dense = std::get_if<Matrix>(&J_)) {
      row_sums_.head(n) = dense->cwiseAbs().rowwise().sum();
      column_sums_.head(n) = dense->cwiseAbs().colwise().sum().transpose();
    } else if (const auto* sparse = std::get_if<SparseMatrix>(&J_)) {
      for (Eigen::Index j = 0; j < n; ++j)
        for (SparseMatrix::InnerIterator entry(*sparse, j); entry; ++entry) {
          row_sums_[entry.row()] += std::abs(entry.value());
          column_sums_[j] += std::abs(entry.value());
        }
    } else {
      // For an operator, from its product with a generic vector.
      for (Eigen::Index i = 0; i < n; ++i) w_[i] = generic_sign(i);
      std::get<const Operator*>(J_)->apply(w_, row_sums_.head(n));
      row_sums_.head(n).setConstant(row_sums_.head(n).lpNorm<Eigen::Infinity>());
      column_sums_.head(n) = row_sums_.head(n);
    }
    for (Eigen::Index i = 0; i < m; ++i) {
      row_sums_.head(n) += borders_.columns.col(i).cwiseAbs();
      column_sums_.head(n) += borders_.rows.col(i).cwiseAbs();
      row_sums_[n + i] = borders_.rows.col(i).cwiseAbs().sum() + borders_.corner.row(i).cwiseAbs().sum();
      column_sums_[n + i] =
          borders_.columns.col(i).cwiseAbs().sum() + borders_.corner.col(i).cwiseAbs().sum();
    }
    row_sums_.tail(m) *= Refinement::of_full_row(n);
    column_sums_.tail(m) *= Refinement::of_full_row(n);
    return row_sums_.allFinite() && column_sums_.allFinite();
  }

  std::unique_ptr<PlainSolver> plain_;
  std::string name_;
  Jacobian J_;
  Borders borders_{0, 0};
  Vector row_sums_, column_sums_;
  // Of J, or of what is next to it, where a solve is the first to tell that J is singular.
  mutable Jacobian nearby_;
  mutable Matrix V_, S_;
  mutable LU<double> lu_;
  mutable bool ready_ = false, near_tried_ = false;
  mutable int sign_of_S_ = 1;
  mutable Refinement refinement_;
  mutable Vector w_, y_, generic_, solution_, image_;
};

}  // namespace

std::unique_ptr<LinearSolver> block_elimination(std::unique_ptr<PlainSolver> plain) {
  return std::make_unique<BlockElimination>(std::move(plain));
}

}  // namespace arcslip::continuation
