#include <arcslip/structure/reduction.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/interruptible.hpp>
#include <arcslip/structure/blocks.hpp>
#include <arcslip/structure/digit_loss.hpp>
#include <arcslip/structure/interior_factor.hpp>
#include <arcslip/structure/krylov_space.hpp>
#include <arcslip/structure/products.hpp>
#include <arcslip/structure/projected.hpp>
#include <arcslip/structure/symmetry.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <sstream>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using Kind = PartOfZ::Kind;

constexpr double shift_at = 0.3;     // sqrt(sigma) over the highest frequency
constexpr double converging = 1e-6;  // of the error: from here on rounding ends its fall
constexpr double settling = 1e-2;    // the same: from here on some of the next few are
constexpr int next_few = 6;          // estimates
constexpr int few_of_rounding = 3;   // estimates, where rounding ends the fall
constexpr double much_less = 0.3;    // an error over the one before
constexpr double largest_error = 1e-3;
constexpr double growth = 1.1;             // of V from one estimate to the next
constexpr double share_of_entries = 0.5;   // the error next to what the last digits of the entries change
constexpr double least_accuracy = 1e-8;    // then
constexpr double share_of_weak = 1e-3;     // of the error: modes that are left out
constexpr double share_of_left = 0.25;     // of the error: what the space lacks of its own sources
constexpr double usual_blocks = 3;         // of sources that are cut, between which that share is parted
constexpr double largest_coupling = 0.03;  // of what is left of p M v for vectors v, next to A

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

// The largest eigenvalue of A v = mu B v.
double largest_next_to(const MatrixXd& A, const MatrixXd& B) {
  continuation::Cholesky of_B;
  if (!of_B.factorize(B)) return HUGE_VAL;
  const VectorXd values = large_symmetric_eigenvalues(of_B.reduced(A));
  return values.size() == 0 ? HUGE_VAL : values[values.size() - 1];
}

// A matrix next to A, and its columns for x_b among the others: R = A_ii Psi + A_ib.
struct Operator {
  Blocks of;
  MatrixXd R;
};

class Reduction {
 public:
  Reduction(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose, Index most,
            const control::Control& control)
      : square_(0.5 * purpose.highest_speed * purpose.highest_speed),
        matrices_(at_speed(symmetric_parts(matrices), square_)),
        skew_(skew_parts(matrices)),
        accuracy_(purpose.accuracy),
        most_(most),
        sigma_(std::pow(shift_at * purpose.highest, 2)),
        parts_(partition_of(matrices_, skew_, kept)),
        K_(blocks(*matrices_.stiffness.matrix, parts_)),
        factor_(control) {
    P_.sigma = sigma_;
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

  Reduced run() {
    Reduced result;
    if (parts_.others > 0) {
      factorize();
      condense_statically();
      result.error = span();
    } else {
      P_.A_c = K_.bb + sigma_ * operators_.front().of.bb;
      for (std::size_t k = 0; k < operators_.size(); ++k) P_.parts[k].c = operators_[k].of.bb;
      P_.f_c = f_b_;
    }
    const Rounding of_entries = rounding_of_entries();
    if (!(of_entries.change <= largest_error))
      refuse("the last digits of their entries change the square of the lowest natural frequency by " +
             text(of_entries.change) + " of it, must be at most " + text(largest_error) +
             "; replace very stiff links by rigid ones, and very short elements by longer ones");
    result.error += of_entries.change;
    result.free_below = of_entries.free_below;
    project(result);
    return result;
  }

 private:
  void add_operator(PartOfZ part, const scene::SparseMatrix& A) {
    operators_.push_back({blocks(A, parts_), {}});
    P_.parts.push_back(std::move(part));
  }
  const Operator& M() const { return operators_.front(); }

  void factorize() {
    A_ii_ = K_.ii + sigma_ * M().of.ii;
    // Not every LAPACK finds a NaN.
    if (!Eigen::Map<const VectorXd>(A_ii_.valuePtr(), A_ii_.nonZeros()).allFinite()) refuse_overflow();
    if (factor_.factorize(A_ii_)) return;
    std::string where;
    if (const auto column = factor_.failed_at())
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
    const Sparse A_ib = K_.ib + sigma_ * M().of.ib;
    Psi_ = -factor_.solve(A_ib);
    P_.A_c = K_.bb + sigma_ * M().of.bb + A_ib.transpose() * Psi_;
    P_.A_c = 0.5 * (P_.A_c + P_.A_c.transpose()).eval();
    for (std::size_t k = 0; k < operators_.size(); ++k) {
      Operator& A = operators_[k];
      const double sign = P_.parts[k].sign();
      A.R = A.of.ii * Psi_ + MatrixXd(A.of.ib);
      const MatrixXd sum = A.of.bb + transposed_product(Psi_, A.R) + sign * (A.of.ib.transpose() * Psi_);
      P_.parts[k].c = 0.5 * (sum + sign * sum.transpose());
    }
    condense_loads();
  }

  void condense_loads() {
    P_.f_c = f_b_ + Psi_.transpose() * f_i_;
    P_.load_size.setZero(f_i_.cols());
    if (f_i_.cols() == 0) return;
    const MatrixXd of_b = continuation::solve(P_.A_c, P_.f_c), of_i = factor_.solve(f_i_);
    P_.load_size =
        ((of_b.array() * P_.f_c.array()).colwise().sum() + (of_i.array() * f_i_.array()).colwise().sum())
            .max(0.0)
            .sqrt()
            .matrix()
            .transpose();
  }

  void begin_space() {
    space_.emplace(factor_, parts_.others);
    reached_.E.resize(0, 0);
    for (PartOfZ& part : P_.parts) {
      part.zb.resize(0, parts_.kept);
      part.zz.resize(0, 0);
    }
    P_.f_z.resize(0, f_i_.cols());
  }

  KrylovSources sources() const {
    std::vector<MatrixOfSources> matrices;
    for (std::size_t k = 0; k < operators_.size(); ++k)
      matrices.push_back({&operators_[k].R, &operators_[k].of.ii, largest_factor(P_, P_.parts[k])});
    return {std::move(matrices), f_i_};
  }

  // What the space lacks of sources of vectors, next to the root of their envelope.
  struct Block {
    double left;
    bool of_first;
    Index from;
    MatrixXd E;
  };

  // Of the coefficients of the sources of vectors, and of those of x_b if they are among them.
  static double length_of(bool of_first, const Envelope& reached) {
    const double length = std::max(reached.length, 1.0);
    return of_first ? std::hypot(length, 1.0) : length;
  }
  // Of the coefficients of one x_b in the columns of each matrix.
  double groups() const { return std::sqrt(static_cast<double>(operators_.size())); }

  // Appends to the space what the sources of x_b, of the loads and of its vectors from `from` on lead to.
  void append_block(bool of_first, Index from, Index most) {
    KrylovSources X = sources();
    if (of_first) X.take_first(inverse_scale(P_));
    const Index old = space_->size(), count = old - from;
    const double length = count > 0 ? length_of(of_first, reached_) : 1;
    const double limit = std::sqrt(share_of_left * accuracy_ / (amplification_ * tightening_)) /
                         (usual_blocks * length * groups());
    MatrixXd E = reached_.E.bottomRightCorner(count, count);
    E.diagonal().array() += std::pow(limit / largest_coupling, 2);
    if (count > 0) {
      const continuation::SymmetricModes of = large_symmetric_modes(E);
      if (of.values.size() < count) refuse_overflow();
      const MatrixXd root = of.V * of.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
      X.take_vectors(product(space_->V().rightCols(count), root));
    }
    if (X.count() == 0) return;
    blocks_.push_back({append_sources(*space_, factor_, X, limit, most, random_), of_first, from, E});
    project_from(old);
  }

  // Of all blocks, in what the space reached before the last one.
  double left(const Envelope& reached) const {
    double sum = 0;
    for (const Block& block : blocks_) {
      if (block.left == 0) continue;
      const Index count = block.E.rows();
      double length = 1;
      if (count > 0) {
        const double larger = largest_next_to(reached.E.block(block.from, block.from, count, count), block.E);
        length = length_of(block.of_first, reached) * std::sqrt(std::max(larger, 1.0));
      }
      sum += block.left * length * groups();
    }
    return sum;
  }

  // Makes V, and all that is projected onto it. The estimate of the error.
  double span() {
    const Index most = std::min(most_, parts_.others);
    begin_space();
    append_block(true, 0, most);
    accuracy_ =
        std::max(accuracy_, std::min(share_of_entries * rounding_of_entries().of_stiffness, least_accuracy));
    reached_ = known_envelope();
    Estimates estimates;
    Index from = 0;  // vectors whose sources the space has
    while (!estimates.ended) {
      const Index old = space_->size();
      append_block(false, from, most);
      from = old;
      if (space_->size() > old && space_->size() < most &&
          static_cast<double>(old) < growth * static_cast<double>(estimates.vectors)) {
        reach_as_before(old - estimates.vectors);
        continue;
      }
      const Envelope before = std::exchange(reached_, known_envelope());
      estimate(old, before, estimates);
      if (!estimates.ended && space_->size() == old) {
        estimates.ended = !tighten(most);
        from = old;
      }
      if (space_->size() >= most) estimates.ended = true;
    }
    if (estimates.settled) return estimates.error + leave_out_weak_modes();
    if (parts_.others <= most_) return span_whole();
    if (estimates.error > largest_error)
      refuse("the error of the dynamic stiffness is " + text(estimates.error) + " with " +
             std::to_string(space_->size()) + " coordinates and does not fall any further, must be at most " +
             text(largest_error) + "; lower \"highest_frequency\", or let the scene use fewer rows");
    return estimates.error;
  }

  Envelope known_envelope() const {
    Envelope of = envelope(P_);
    if (of.E.rows() < space_->size()) refuse_overflow();
    return of;
  }

  // The new vectors as far as the last ones before.
  void reach_as_before(Index last) {
    const Index old = reached_.E.rows(), count = space_->size();
    const double largest = reached_.E.diagonal().tail(last).maxCoeff();
    reached_.E.conservativeResize(count, count);
    reached_.E.rightCols(count - old).setZero();
    reached_.E.bottomRows(count - old).setZero();
    reached_.E.diagonal().tail(count - old).setConstant(largest);
  }

  struct Estimates {
    double error = HUGE_VAL, least = HUGE_VAL;
    Index vectors = 0;    // at the last one
    int since_least = 0;  // estimates
    bool settled = false, ended = false;
  };

  // Of vectors orthogonal to the first ones.
  double theta_outside(Index first) {
    if (operators_.size() > 1) return HUGE_VAL;
    EnergyBasis of_first = *space_;
    of_first.keep(first);
    return largest_theta_outside(of_first, factor_, M().of.ii, random_);
  }

  // Of the first vectors, of whose sources the others are.
  void estimate(Index first, const Envelope& reached, Estimates& so_far) {
    const double lacking = left(reached);
    const ResidualBound found = bound(P_, first, {lacking, theta_outside(first)}, accuracy_);
    so_far.error = found.error;
    so_far.vectors = first;
    if (std::isnan(found.error)) refuse_overflow();
    amplification_ = found.amplification;
    const bool falls = found.error < much_less * so_far.least;
    so_far.since_least = so_far.least < settling && !falls ? so_far.since_least + 1 : 0;
    so_far.least = std::min(so_far.least, found.error);
    const bool to_rounding = found.error < converging && so_far.since_least >= few_of_rounding;
    so_far.settled = found.error <= accuracy_ || to_rounding;
    so_far.ended = so_far.settled || so_far.since_least >= next_few;
    if (so_far.settled) keep(first);  // what came since brings no more
  }

  // The sources of all vectors once more, with what is known of their sizes now. False: nothing is new.
  bool tighten(Index most) {
    const Index old = space_->size();
    tightening_ *= 4;
    blocks_.clear();
    append_block(true, 0, most);
    if (space_->size() == old) return false;
    reached_ = known_envelope();
    return true;
  }

  // What they add.
  double leave_out_weak_modes() {
    if (operators_.size() > 1 || space_->size() == 0) return 0;
    const StrongModes strong = strong_modes(P_, share_of_weak * accuracy_);
    if (strong.Q.rows() < space_->size()) refuse_overflow();
    P_.turn(strong.Q);
    space_->replace(product(space_->V(), strong.Q));
    return strong.left_out;
  }

  // All of the others, where the space has grown to most of them without an end.
  double span_whole() {
    keep(0);
    const MatrixXd dense_M = M().of.ii, A = A_ii_;
    MatrixXd V = continuation::symmetric_modes(dense_M, A).V;
    if (V.size() == 0) refuse_indefinite("");
    space_->replace(std::move(V));
    project_from(0);
    return 0;
  }

  // What the last digits of the entries change, as far as the rows that are kept see it.
  Rounding rounding_of_entries() const {
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
    const auto modes = large_symmetric_modes(M, A);
    if (modes.values.size() != b + z) refuse_indefinite("; it is not in the rows that the scene uses");
    const auto mode = [&](Index j) {
      const VectorXd v = modes.V.col(b + z - 1 - j);
      VectorXd x(b + parts_.others);
      x.head(b) = v.head(b);
      if (parts_.others > 0) x.tail(parts_.others) = Psi_ * v.head(b) + space_->V() * v.tail(z);
      return x;
    };
    const Rounding found = rounding(matrices_, parts_, sigma_, b + z, mode);
    return found;
  }

  // Onto the vectors of V from `old` on.
  void project_from(Index old) {
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

  // The first vectors alone.
  void keep(Index count) {
    space_->keep(count);
    P_.keep(count);
  }

  // In the eigenvectors of M_zz.
  void project(Reduced& into) const {
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

  static MatrixXd& of_part(Reduced& of, const PartOfZ& part) {
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

  const double square_;             // of the speed of the expansion
  const scene::Matrices matrices_;  // symmetric parts
  const std::vector<Skew> skew_;
  double accuracy_;
  const Index most_;
  const double sigma_;
  const Partition parts_;
  const Blocks K_;
  std::vector<Operator> operators_;  // M, C, K2 and skew_, as the parts of P_
  MatrixXd f_b_, f_i_;               // loads
  Sparse A_ii_;
  InteriorFactor factor_;
  MatrixXd Psi_;
  std::optional<EnergyBasis> space_;
  std::vector<Block> blocks_;
  Envelope reached_;          // of the space
  double amplification_ = 4;  // ResidualBound::amplification, about
  double tightening_ = 1;     // of what the space may lack
  std::mt19937_64 random_;
  Projected P_;
};

}  // namespace

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose,
               const control::Control& control, int most) {
  return control::interruptible(
      [=](const control::Control& given_up) {
        return Reduction(matrices, kept, purpose, most, given_up).run();
      },
      control, "interrupted while the structure was reduced");
}

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
               const control::Control& control, int most) {
  return reduce(matrices, kept, Purpose{highest, 0, {}}, control, most);
}

}  // namespace arcslip::structure
