#pragma once
// The corrector: Newton's method for F(u, p) = 0 in the plane r . (v - v_predicted) = 0, v = (u, p).
//
// The factors of a nearby point are used first, in chord steps, as long as these contract. Then F and J are
// evaluated and factorized at the result: if the correction dv = -B^-1 F with the new factors is below the
// tolerance, v + dv is the solution, with an error of order |dv|^2 (|dv| next to a kink), and the factors are
// those of the branch there. If not, Newton's method continues from there. So a well predicted point costs
// one factorization.
//
// A point of a branch needs no more than its tolerance. Where F is smooth, the contraction c of the
// corrections with factors at a distance D from the solution grows as D, so that after a correction d with
// new factors an error of c d^2 / D remains: Accept::expected_error takes v + dv where that is far below the
// tolerance. The corrections that it saves are the last chord steps, whose error the new factors remove.
//
// Where that last correction leaves the smooth piece of F, the equations beyond are others: Newton's method
// continues once more, and v + dv stays the solution if that leads nowhere. This is tested where residuals
// are cheap and corrections above 1e-13.
//
// Large corrections are damped by the natural test of Deuflhard (Newton Methods for Nonlinear Problems, 2004,
// chapter 3): |B^-1 F(v + lambda dv)| must fall below (1 - lambda/4) |dv|. It is invariant under scaling of
// the equations and never compares Jacobians across a kink, so that for piecewise smooth F the method is a
// safeguarded semismooth Newton method. The former is relative to the larger |u| of the two
// points, so that a solution u = 0 can be reached.

#include <arcslip/continuation/events/scratch.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace arcslip::continuation {

/// Result of a correction. Corrections are relative to |u| in scales (and to |p|).
struct Correction {
  bool converged = false;
  bool evaluated = true;  // false: the problem could not be evaluated; see failure()
  bool singular = false;  // singular matrix, or derivatives that cannot be evaluated
  int iterations = 0;
  double first = 0, last = 0;   // size of the first and of the last correction
  double contraction = 0;       // ratio of the second to the first
  double last_contraction = 0;  // of the last to the one before
  bool expected = false;        // complete by the error that is expected to remain: Accept::expected_error
  /// Newton's method converged linearly only: a small correction was followed by one not much smaller, or by
  /// too many.
  bool linear = false;
};

/// The point and border row of a factorized matrix; empty if none.
struct Linearization {
  Vector v, row;   // n + 1
  Vector state{};  // of the problem, which it was made from
};

/// State that a corrector carries from one correction to the next: the point of its factors, the point of the
/// earlier factors whose pivots they keep, and the contraction of the chord steps.
struct FactorMemory {
  Linearization factors, pivots;
  bool pivots_kept = false;
  double contraction = 1;
};

/// Of large corrections: the natural test, or none.
enum class Damping { natural, none };

/// When a correction is complete: with the last one within the tolerance, or, of smooth problems, also with
/// the error that is expected to remain far below it.
enum class Accept { last_correction, expected_error };

/// Corrector with its evaluator, factors and buffers. correct() and linearize() do not allocate.
class Corrector {
 public:
  /// counts: work counters, which must outlive the corrector. make_solver: if none, the problem's own, or the
  /// default for the kind of Jacobian. Throws std::invalid_argument if the Jacobian is an operator and no
  /// solver is given.
  Corrector(const Problem& problem, Vector p, int free, const NewtonOptions& options, Counts& counts,
            const MakeLinearSolver& make_solver = {});

  /// v: n + 1, the prediction, becomes the solution; the factors become those there. row: n + 1.
  /// keep_factors: the present factors are those of a nearby point with a similar row, and are tried first.
  Correction correct(Vector& v, const Vector& row, bool keep_factors,
                     Accept accept = Accept::last_correction);

  /// Newton's method alone, without chord steps, with at most so many iterations. It ends after
  /// NewtonOptions::iterations of them where it converges linearly only.
  Correction newton(Vector& v, const Vector& row, int iterations, Damping damping);

  /// -B^-1 F(v) with the present factors, to the branch to first order, until the next correction. NaN if F
  /// cannot be evaluated.
  const Vector& correction_at(const Vector& v);

  /// Evaluates F and J at v and factorizes with the given border row. False: singular or not evaluated.
  bool linearize(const Vector& v, const Vector& row);

  /// Moves the evaluator (not the factors) to v.
  bool move_to(const Vector& v, Needs needs = Needs::residual) { return evaluate(v, needs); }

  /// The problem's state, for what follows; the factors stay.
  void set_state(const Vector& state);

  /// The state that v leaves if it is accepted. False if the problem cannot be evaluated there, or the state
  /// is not finite: see failure().
  bool next_state(const Vector& v, Vector& state);

  /// The smooth piece of the evaluator's last point. False if the problem throws: see failure().
  bool piece(std::uint64_t& piece);

  /// Whether v is in this piece: Evaluator::test_piece().
  bool is_in_piece(const Vector& v, std::uint64_t piece, PieceTest test);

  /// The unit tangent at the last solution or linearize(): B t = e_{n+1}, so that row . t > 0; |t| = 1 in
  /// scales. False if it is not finite.
  bool tangent(Vector& t) const;

  /// x = B^-1 x with the present factors. False if it is not finite.
  bool apply_inverse(Vector& x) const;
  /// y = ([J F_p] x, 0) at the last linearization, n + 1; before the evaluator moves on.
  void apply(const Vector& x, Vector& y) const;
  /// The k-th of several vectors of n + 1, of about 1 in scales in each entry, orthogonal to no symmetry or
  /// mode of vibration.
  Vector generic_direction(int k) const;

  double size(const Vector& dv, const Vector& v) const;  // of a correction, relative; NaN if dv is
  double norm_u(const Vector& v) const;                  // |u| in scales
  /// <a, b> of vectors of n + 1, in the problem's metric and the scale of the free parameter.
  double dot(const Vector& a, const Vector& b) const;
  /// row . x = <t, x> for all x.
  void border_row(const Vector& t, Vector& row) const;
  Vector border_row(const Vector& t) const;
  double parameter_scale() const { return parameter_scale_; }
  int free() const { return free_; }
  const Problem& problem() const { return problem_; }
  const Vector& parameters() const { return p_; }
  /// Why the last evaluation failed: the exception of the problem, or the misuse. Empty: the problem returned
  /// the failure itself.
  const std::string& failure() const { return failure_; }
  Evaluator& evaluator() { return *evaluator_; }
  const LinearSolver& factors() const { return *solver_; }  // valid after a linearization
  Scratch& scratch() { return scratch_; }

  /// The state with which another corrector continues bit for bit.
  const FactorMemory& memory() const { return memory_; }
  /// Recomputes the factors of another corrector, without counting the work.
  void restore(const FactorMemory& memory);
  /// Resets all history, so that later results do not depend on earlier corrections.
  void forget();

 private:
  bool evaluate(const Vector& v, Needs needs);
  bool factorize(const Vector& v, const Vector& row);
  void solve(Vector& dv) const;           // dv = -B^-1 (F, 0)
  void back_substitute(Vector& x) const;  // x = B^-1 x; not finite where the linear solver throws
  bool chord(Vector& v, Correction& result);
  bool leaves_little(double error, double contraction, double now) const;
  // What Newton's method carries from one iteration to the next.
  struct NewtonRun {
    Vector& v;
    const Vector& row;
    bool is_damped;
    Correction result;
    double before;  // size of the correction that led to v; 0: it was damped, or none
    std::optional<std::uint64_t> piece_before{};  // of F, where that began, if it was small
    bool crossed = false;  // a kink, by a correction within the tolerance: across_ is the point beyond
  };
  enum class Newton { goes_on, converged, failed };

  Correction newton(NewtonRun& run, int iterations);
  Newton newton_step(NewtonRun& run, int k);
  bool is_complete(NewtonRun& run) const;
  void note_size(NewtonRun& run, double now, int k);
  bool cycles(NewtonRun& run);
  Newton take_last(NewtonRun& run, bool may_cross);
  Newton take_damped(NewtonRun& run);
  Correction fall_back(NewtonRun& run);
  bool damp(const Vector& v, double now);
  std::optional<std::uint64_t> piece_of_residual() const;

  const Problem& problem_;
  NewtonOptions options_;
  Counts& counts_;
  std::unique_ptr<Evaluator> evaluator_;
  std::unique_ptr<LinearSolver> solver_;
  Borders borders_;
  Vector state_;  // of the problem; empty: none
  Vector p_, weights_, F_p_, dv_, next_, trial_, across_;
  Vector from_factors_;    // to the solution, of the factors of the correction before; 0: not known
  mutable Vector metric_;  // M x of the last product
  bool has_metric_;
  mutable std::string failure_;
  int free_;
  Accept accept_ = Accept::last_correction;
  double chord_safety_ = 1;
  double parameter_scale_;
  FactorMemory memory_;
  Scratch scratch_;
};

}  // namespace arcslip::continuation
