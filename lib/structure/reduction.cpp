#include <arcslip/structure/reduction.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/interruptible.hpp>
#include <arcslip/structure/products.hpp>
#include <arcslip/structure/static_condensation.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

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
// Errors of a given space, which are looked for: the first, each next to the one before, and the last.
constexpr double first_resolved = 1e-2, resolved_next = 1e-2, last_resolved = 1e-11;

// The largest eigenvalue of A v = mu B v.
double largest_next_to(const MatrixXd& A, const MatrixXd& B) {
  continuation::Cholesky of_B;
  if (!of_B.factorize(B)) return HUGE_VAL;
  const VectorXd values = large_symmetric_eigenvalues(of_B.reduced(A));
  return values.size() == 0 ? HUGE_VAL : values[values.size() - 1];
}

// Makes V grow until the error is small enough.
class KrylovGrowth {
 public:
  KrylovGrowth(StaticCondensation& of, const Purpose& purpose, Index most)
      : of_(of),
        space_(of.space()),
        P_(of.projected()),
        accuracy_(purpose.accuracy),
        most_(std::min(most, of.others())) {
    reached_.E.resize(0, 0);
  }

  // Makes V, and all that is projected onto it. The estimate of the error.
  double span() {
    append_block(true, 0);
    accuracy_ = std::max(accuracy_,
                         std::min(share_of_entries * of_.rounding_of_entries().of_stiffness, least_accuracy));
    reached_ = known_envelope();
    Estimates estimates;
    Index from = 0;  // vectors whose sources the space has
    while (!estimates.ended) {
      const Index old = space_.size();
      append_block(false, from);
      from = old;
      if (space_.size() > old && space_.size() < most_ &&
          static_cast<double>(old) < growth * static_cast<double>(estimates.vectors)) {
        reach_as_before(old - estimates.vectors);
        continue;
      }
      const Envelope before = std::exchange(reached_, known_envelope());
      estimate(old, before, estimates);
      if (!estimates.ended && space_.size() == old) {
        estimates.ended = !tighten();
        from = old;
      }
      if (space_.size() >= most_) estimates.ended = true;
    }
    if (estimates.settled) return estimates.error + leave_out_weak_modes();
    if (of_.others() <= most_) {
      of_.take_whole();
      return 0;
    }
    if (estimates.error > largest_error)
      refuse("the error of the dynamic stiffness is " + three_digits(estimates.error) + " with " +
             std::to_string(space_.size()) + " coordinates and does not fall any further, must be at most " +
             three_digits(largest_error) + "; lower \"highest_frequency\", or let the scene use fewer rows");
    return estimates.error;
  }

  // The estimate of the error of the space as it is, whose sources are found for that alone.
  double error_of_space() {
    const Index first = space_.size();
    for (accuracy_ = first_resolved;; accuracy_ *= resolved_next) {
      reached_ = known_envelope();
      append_block(true, 0);
      const ResidualBound found = bound(P_, first, {left(known_envelope()), theta_outside(first)}, HUGE_VAL);
      if (std::isnan(found.error)) refuse_overflow();
      of_.keep(first);
      blocks_.clear();
      if (found.error > accuracy_ || accuracy_ < last_resolved) return found.error;
    }
  }

 private:
  KrylovSources sources() const {
    std::vector<MatrixOfSources> matrices;
    for (std::size_t k = 0; k < of_.operators().size(); ++k)
      matrices.push_back({&of_.operators()[k].R, &of_.operators()[k].of.ii, largest_factor(P_, P_.parts[k])});
    return {std::move(matrices), of_.loads_of_others()};
  }

  // What the space lacks of sources of vectors, next to the root of their envelope.
  struct Block {
    double left;
    double of_first;  // by which sources of x_b are divided, so that they weigh as much; 0: there are none
    Index from;
    MatrixXd E;
  };

  // Of the coefficients of one x_b in the columns of each matrix.
  double groups() const { return std::sqrt(static_cast<double>(of_.operators().size())); }

  // Appends to the space what the sources of x_b, of the loads and of its vectors from `from` on lead to.
  void append_block(bool of_first, Index from) {
    KrylovSources X = sources();
    const Index old = space_.size(), count = old - from;
    const double of_vectors = count > 0 ? std::max(reached_.length, 1.0) : 0,
                 of_rows = of_first ? std::max(of_vectors, 1.0) : 0, length = std::hypot(of_rows, of_vectors);
    if (of_first) X.take_first(inverse_scale(P_) / of_rows);
    const double limit = std::sqrt(share_of_left * accuracy_ / (amplification_ * tightening_)) /
                         (usual_blocks * length * groups());
    MatrixXd E = reached_.E.bottomRightCorner(count, count);
    E.diagonal().array() += std::pow(limit / largest_coupling, 2);
    if (count > 0) {
      const continuation::SymmetricModes of = large_symmetric_modes(E);
      if (of.values.size() < count) refuse_overflow();
      const MatrixXd root = of.V * of.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
      X.take_vectors(product(space_.V().rightCols(count), root));
    }
    if (X.count() == 0) return;
    blocks_.push_back({append_sources(space_, of_.factor(), X, limit, most_, random_), of_rows, from, E});
    of_.project_from(old);
  }

  // Of all blocks, in what the space reached before the last one.
  double left(const Envelope& reached) const {
    double sum = 0;
    for (const Block& block : blocks_) {
      if (block.left == 0) continue;
      const Index count = block.E.rows();
      double of_vectors = 0;
      if (count > 0) {
        const double larger = largest_next_to(reached.E.block(block.from, block.from, count, count), block.E);
        of_vectors = std::max(reached.length, 1.0) * std::sqrt(std::max(larger, 1.0));
      }
      sum += block.left * std::hypot(block.of_first, of_vectors) * groups();
    }
    return sum;
  }

  Envelope known_envelope() const {
    Envelope of = envelope(P_);
    if (of.E.rows() < space_.size()) refuse_overflow();
    return of;
  }

  // The new vectors as far as the last ones before.
  void reach_as_before(Index last) {
    const Index old = reached_.E.rows(), count = space_.size();
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
    if (of_.operators().size() > 1) return HUGE_VAL;
    EnergyBasis of_first = space_;
    of_first.keep(first);
    return largest_theta_outside(of_first, of_.factor(), of_.operators().front().of.ii, random_);
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
    if (so_far.settled) of_.keep(first);  // what came since brings no more
  }

  // The sources of all vectors once more, with what is known of their sizes now, and where that brings
  // nothing those of x_b as well, more closely. False: nothing is new.
  bool tighten() {
    const Index old = space_.size();
    if (!std::exchange(refreshed_, true)) {
      std::erase_if(blocks_, [](const Block& block) { return block.of_first == 0; });
      append_block(false, 0);
    } else {
      tightening_ *= 4;
      blocks_.clear();
      append_block(true, 0);
      if (space_.size() == old) return false;
    }
    reached_ = known_envelope();
    return true;
  }

  // What they add.
  double leave_out_weak_modes() {
    if (of_.operators().size() > 1 || space_.size() == 0) return 0;
    const StrongModes strong = strong_modes(P_, share_of_weak * accuracy_);
    if (strong.Q.rows() < space_.size()) refuse_overflow();
    of_.turn(strong.Q);
    return strong.left_out;
  }

  StaticCondensation& of_;
  EnergyBasis& space_;
  const Projected& P_;
  double accuracy_;
  const Index most_;
  std::vector<Block> blocks_;
  Envelope reached_;          // of the space
  double amplification_ = 4;  // ResidualBound::amplification, about
  double tightening_ = 1;     // of what the space may lack
  bool refreshed_ = false;    // the sources of vectors
  std::mt19937_64 random_;
};

// Gives V its vectors. The estimate of the error.
double span(StaticCondensation& structure, const Purpose& purpose, Index most,
            const control::Control& control) {
  if (purpose.method == scene::ReductionMethod::krylov) return KrylovGrowth(structure, purpose, most).span();
  take_modes(structure, purpose, control);
  return KrylovGrowth(structure, purpose, structure.others()).error_of_space();
}

}  // namespace

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose,
               const control::Control& control, int most) {
  return control::interruptible(
      [=](const control::Control& given_up) {
        StaticCondensation structure(matrices, kept, purpose, given_up);
        structure.condense();
        return structure.reduced(structure.others() > 0 ? span(structure, purpose, most, given_up) : 0);
      },
      control, "interrupted while the structure was reduced");
}

Reduced reduce(const scene::Matrices& matrices, const std::vector<int>& kept, double highest,
               const control::Control& control, int most) {
  return reduce(matrices, kept, Purpose{highest, 0, {}}, control, most);
}

}  // namespace arcslip::structure
