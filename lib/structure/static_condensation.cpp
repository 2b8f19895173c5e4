#include <arcslip/structure/static_condensation.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/structure/products.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using Kind = PartOfZ::Kind;

constexpr double largest_change = 1e-3;  // by the last digits of the entries

Partition partition_of(const scene::Matrices& matrices, const std::vector<Skew>& skew,
                       const std::vector<int>& kept) {
  std::vector<const scene::SparseMatrix*> all{matrices.stiffness.matrix.get(), matrices.mass.matrix.get(),
                                              matrices.damping.matrix.get()};
  for (const Skew& each : skew) all.push_back(&each.A);
  return partition(matrices.size(), all, kept);
}

double shift_of(double highest) {
  constexpr double shift_at = 0.3;  // its root over the highest frequency
  return std::pow(shift_at * highest, 2);
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

MatrixXd& of_part(Reduced& of, const PartOfZ& part) {
  switch (part.kind) {
    case Kind::mass:
      return of.M;
    case Kind::damping:
      return of.C;
    case Kind::stiffening:
      return of.K2;
    case Kind::skew:
      break;
  }
  if (part.by_speed) return part.of_velocity ? of.G : of.N;
  return part.of_velocity ? of.C : of.K;
}

}  // namespace

void refuse(const std::string& cause) {
  throw ReductionError("the matrices cannot be reduced: " + cause);
}
void refuse_overflow() {
  refuse("their entries are too large, too small or too far apart for double precision");
}
void refuse_floating() {
  refuse(
      "a part of the structure floats, or nearly so, where the rows that the scene uses are held, so that "
      "these have "
      "no statics; let the scene use more rows of this part, or reduce by the \"method\" \"krylov\"");
}
std::string three_digits(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

StaticCondensation::StaticCondensation(const scene::Matrices& matrices, const std::vector<int>& kept,
                                       const Purpose& purpose, const control::Control& control)
    : square_(0.5 * purpose.highest_speed * purpose.highest_speed),
      matrices_(at_speed(symmetric_parts(matrices), square_)),
      skew_(skew_parts(matrices)),
      accuracy_(purpose.method == scene::ReductionMethod::krylov ? purpose.accuracy : 0),
      sigma_(purpose.method == scene::ReductionMethod::krylov ? shift_of(purpose.highest) : 0),
      parts_(partition_of(matrices_, skew_, kept)),
      K_(blocks(*matrices_.stiffness.matrix, parts_)),
      factor_(control) {
  P_.sigma = sigma_;
  P_.shift = shift_of(purpose.highest) - sigma_;
  P_.highest = purpose.highest;
  add_operator({Kind::mass, false, false, {}, {}, {}}, *matrices_.mass.matrix);
  if (matrices_.damping.matrix)
    add_operator({Kind::damping, false, false, {}, {}, {}}, *matrices_.damping.matrix);
  if (matrices.stiffness_speed_squared.matrix)
    add_operator({Kind::stiffening, false, false, {}, {}, {}}, *matrices.stiffness_speed_squared.matrix);
  bool by_speed = matrices.stiffness_speed_squared.matrix != nullptr;
  for (const Skew& each : skew_) {
    add_operator({Kind::skew, each.of_velocity, each.by_speed, {}, {}, {}}, each.A);
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

void StaticCondensation::add_operator(PartOfZ part, const scene::SparseMatrix& A) {
  operators_.push_back({blocks(A, parts_), {}});
  P_.parts.push_back(std::move(part));
}

void StaticCondensation::factorize() {
  A_ii_ = K_.ii + sigma_ * operators_.front().of.ii;
  // Not every LAPACK finds a NaN.
  if (!Eigen::Map<const VectorXd>(A_ii_.valuePtr(), A_ii_.nonZeros()).allFinite()) refuse_overflow();
  if (factor_.factorize(A_ii_)) return;
  if (sigma_ == 0) refuse_floating();
  std::string where;
  if (const auto column = factor_.failed_at())
    for (std::size_t row = 0; row < parts_.place.size(); ++row)
      if (parts_.place[row] == *column + parts_.kept)
        where = "; the elimination stops at row " + std::to_string(row + 1);
  refuse_indefinite(where);
}

void StaticCondensation::refuse_indefinite(const std::string& where) const {
  refuse("K + s M with s = " + three_digits(sigma_ + P_.shift) +
         " 1/s^2 is not positive definite, as it is where mass and stiffness are positive semidefinite and "
         "no part without mass floats" +
         where);
}

void StaticCondensation::condense() {
  if (parts_.others == 0) {
    P_.A_c = K_.bb + sigma_ * operators_.front().of.bb;
    for (std::size_t k = 0; k < operators_.size(); ++k) P_.parts[k].c = operators_[k].of.bb;
    P_.f_c = f_b_;
    return;
  }
  factorize();
  const Sparse A_ib = K_.ib + sigma_ * operators_.front().of.ib;
  Psi_ = -factor_.solve(A_ib);
  P_.A_c = K_.bb + sigma_ * operators_.front().of.bb + A_ib.transpose() * Psi_;
  P_.A_c = 0.5 * (P_.A_c + P_.A_c.transpose()).eval();
  for (std::size_t k = 0; k < operators_.size(); ++k) {
    Operator& A = operators_[k];
    const double sign = P_.parts[k].sign();
    A.R = A.of.ii * Psi_ + MatrixXd(A.of.ib);
    const MatrixXd sum = A.of.bb + transposed_product(Psi_, A.R) + sign * (A.of.ib.transpose() * Psi_);
    P_.parts[k].c = 0.5 * (sum + sign * sum.transpose());
  }
  condense_loads();
  space_.emplace(factor_, parts_.others);
  for (PartOfZ& part : P_.parts) {
    part.zb.resize(0, parts_.kept);
    part.zz.resize(0, 0);
  }
  P_.f_z.resize(0, f_i_.cols());
}

void StaticCondensation::condense_loads() {
  P_.f_c = f_b_ + Psi_.transpose() * f_i_;
  P_.load_size.setZero(f_i_.cols());
  if (f_i_.cols() == 0) return;
  const MatrixXd of_b = continuation::solve(P_.A_c + P_.shift * P_.parts.front().c, P_.f_c),
                 of_i = factor_.solve(f_i_);
  P_.load_size =
      ((of_b.array() * P_.f_c.array()).colwise().sum() + (of_i.array() * f_i_.array()).colwise().sum())
          .max(0.0)
          .sqrt()
          .matrix()
          .transpose();
}

Sparse StaticCondensation::whole_stiffness(double sigma) const {
  return whole(*matrices_.stiffness.matrix, parts_) + sigma * whole_mass();
}

void StaticCondensation::turn(const MatrixXd& Q) {
  P_.turn(Q);
  space_->replace(product(space_->V(), Q));
}

void StaticCondensation::take_whole() {
  keep(0);
  const MatrixXd dense_M = operators_.front().of.ii, A = A_ii_;
  MatrixXd V = continuation::symmetric_modes(dense_M, A).V;
  if (V.size() == 0) refuse_indefinite("");
  space_->replace(std::move(V));
  project_from(0);
}

Rounding StaticCondensation::rounding_of_entries() const {
  if (!P_.is_finite()) refuse_overflow();
  const Index b = parts_.kept, z = P_.coordinates();
  MatrixXd M = MatrixXd::Zero(b + z, b + z), A = MatrixXd::Identity(b + z, b + z);
  A.topLeftCorner(b, b) = P_.A_c;
  M.topLeftCorner(b, b) = P_.parts.front().c;
  if (z > 0) {
    M.bottomRightCorner(z, z) = P_.parts.front().zz;
    M.bottomLeftCorner(z, b) = P_.parts.front().zb;
    M.topRightCorner(b, z) = P_.parts.front().zb.transpose();
  }
  A += P_.shift * M;
  const auto modes = large_symmetric_modes(M, A);
  if (modes.values.size() != b + z) refuse_indefinite("; it is not in the rows that the scene uses");
  const auto mode = [&](Index j) {
    const VectorXd v = modes.V.col(b + z - 1 - j);
    VectorXd x(b + parts_.others);
    x.head(b) = v.head(b);
    if (parts_.others > 0) x.tail(parts_.others) = Psi_ * v.head(b) + space_->V() * v.tail(z);
    return x;
  };
  const Rounding found = rounding(matrices_, parts_, sigma_ + P_.shift, accuracy_, b + z, mode);
  return found;
}

void StaticCondensation::project_from(Index old) {
  const Index count = space_->size();
  const MatrixXd added = space_->V().rightCols(count - old);
  for (std::size_t k = 0; k < operators_.size(); ++k) {
    PartOfZ& to = P_.parts[k];
    const double sign = to.sign();
    const MatrixXd columns = transposed_product(space_->V(), MatrixXd(operators_[k].of.ii * added));
    const MatrixXd corner = columns.bottomRows(count - old);
    to.zz.conservativeResize(count, count);
    to.zz.rightCols(count - old) = columns;
    to.zz.bottomRows(count - old) = sign * columns.transpose();
    to.zz.bottomRightCorner(count - old, count - old) = 0.5 * (corner + sign * corner.transpose());
    to.zb.conservativeResize(count, Eigen::NoChange);
    to.zb.bottomRows(count - old) = transposed_product(added, operators_[k].R);
  }
  P_.f_z.conservativeResize(count, Eigen::NoChange);
  P_.f_z.bottomRows(count - old) = transposed_product(added, f_i_);
}

void StaticCondensation::keep(Index count) {
  space_->keep(count);
  P_.keep(count);
}

Reduced StaticCondensation::reduced(double error) const {
  Reduced result;
  const Rounding of_entries = rounding_of_entries();
  if (!(of_entries.change <= largest_change))
    refuse("the last digits of their entries change the square of the lowest natural frequency by " +
           three_digits(of_entries.change) + " of it, must be at most " + three_digits(largest_change) +
           "; replace very stiff links by rigid ones, and very short elements by longer ones");
  result.error = error + of_entries.change;
  result.free_below = of_entries.free_below;
  project(result);
  return result;
}

// In the eigenvectors of M_zz.
void StaticCondensation::project(Reduced& into) const {
  const Index b = parts_.kept, z = P_.coordinates();
  const PartOfZ& mass = P_.parts.front();
  VectorXd theta(z);
  MatrixXd Q(z, z);
  if (z > 0) {
    continuation::SymmetricModes modes = large_symmetric_modes(mass.zz);
    if (modes.values.size() != z) refuse_overflow();
    theta = modes.values.cwiseMax(0.0);
    Q = std::move(modes.V);
  }
  const auto add = [&](MatrixXd& whole, double factor, const PartOfZ& part) {
    if (whole.size() == 0) whole.setZero(b + z, b + z);
    whole.topLeftCorner(b, b) += factor * part.c;
    if (z == 0) return;
    const MatrixXd zb = factor * transposed_product(Q, part.zb);
    whole.bottomLeftCorner(z, b) += zb;
    whole.topRightCorner(b, z) += part.sign() * zb.transpose();
    if (part.kind == Kind::mass) {
      whole.diagonal().tail(z) += factor * theta;
      return;
    }
    const MatrixXd zz = factor * transposed_product(Q, product(part.zz, Q));
    whole.bottomRightCorner(z, z) += 0.5 * (zz + part.sign() * zz.transpose());
  };
  into.K.setZero(b + z, b + z);
  into.K.topLeftCorner(b, b) = P_.A_c;
  into.K.diagonal().tail(z).setOnes();
  add(into.K, -sigma_, mass);
  for (const PartOfZ& part : P_.parts) add(of_part(into, part), 1, part);
  if (into.K2.size() > 0) into.K -= square_ * into.K2;
  into.loads = P_.f_c;
  into.loads.conservativeResize(b + z, Eigen::NoChange);
  if (z > 0) into.loads.bottomRows(z) = transposed_product(Q, P_.f_z);
}

}  // namespace arcslip::structure
