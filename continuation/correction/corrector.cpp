#include <arcslip/continuation/correction/corrector.hpp>

#include <arcslip/continuation/linear/finite.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

namespace arcslip::continuation {
namespace {

// Limit of the contraction expected of the next chord step: new factors of a dense matrix cost more the
// larger it is. Those of a sparse matrix with little fill cost a few solves.
double chord_safety(const Jacobian& J) {
  return std::holds_alternative<Matrix>(J)
             ? std::clamp(static_cast<double>(std::get<Matrix>(J).rows()) / 8, 1.0, 5.0)
             : 1.0;
}

// Chord steps before new factors. Factors of a sparse matrix may cost many solves, as on grids.
int longest_chord(const Jacobian& J) {
  return std::holds_alternative<SparseMatrix>(J) ? 8 : 5;
}

constexpr double smallest_damping = 1.0 / 256;
constexpr double undamped = 1e-2;          // smaller corrections are not damped, and tested at the next point
constexpr double undamped_divergence = 2;  // of such corrections, from one to the next
constexpr double linear_share = 1e-2;      // of a small Newton correction in the next one: not quadratic
constexpr double surely_within = 1e-13;    // smaller corrections are not looked at for kinks
constexpr double expected_share = 1e-3;    // of the tolerance: an error that may be expected to remain
constexpr double largest_accepted = 1e-7;  // correction beyond which no error is expected to remain
constexpr double smallest_relevant_state = 1e-6;      // in scales: below this, corrections are absolute
constexpr double smallest_relevant_parameter = 1e-3;  // of its scale: below, corrections of p are absolute
}  // namespace

Corrector::Corrector(const Problem& problem, Vector p, int free, const NewtonOptions& options, Counts& counts,
                     const MakeLinearSolver& make_solver)
    : problem_(problem),
      options_(options),
      counts_(counts),
      evaluator_(problem.evaluator()),
      solver_(make_solver ? make_solver() : problem.linear_solver()),
      borders_(problem.size(), 1),
      state_(problem.initial_state()),
      p_(std::move(p)),
      weights_(problem.size() + 1),
      F_p_(problem.size()),
      dv_(problem.size() + 1),
      next_(problem.size() + 1),
      trial_(problem.size() + 1),
      across_(problem.size() + 1),
      from_factors_(Vector::Zero(problem.size() + 1)),
      metric_(problem.size()),
      free_(free),
      parameter_scale_(problem.parameters()[static_cast<std::size_t>(free)].change()) {
  weights_.head(problem.size()) = problem.scales().cwiseAbs2().cwiseInverse();
  weights_[problem.size()] = 1 / (parameter_scale_ * parameter_scale_);
  has_metric_ = problem.metric(dv_.head(problem.size()).setZero(), metric_);
}

double Corrector::dot(const Vector& a, const Vector& b) const {
  if (!has_metric_) return (a.array() * b.array() * weights_.array()).sum();
  const Eigen::Index n = metric_.size();
  problem_.metric(b.head(n), metric_);
  return a.head(n).dot(metric_) + a[n] * b[n] * weights_[n];
}

void Corrector::border_row(const Vector& t, Vector& row) const {
  row = t.cwiseProduct(weights_);
  if (has_metric_) problem_.metric(t.head(metric_.size()), row.head(metric_.size()));
}

Vector Corrector::border_row(const Vector& t) const {
  Vector row(t.size());
  border_row(t, row);
  return row;
}

double Corrector::norm_u(const Vector& v) const {
  const Eigen::Index n = v.size() - 1;
  if (!has_metric_) return std::sqrt((v.head(n).array().square() * weights_.head(n).array()).sum());
  problem_.metric(v.head(n), metric_);
  return std::sqrt(std::max(v.head(n).dot(metric_), 0.0));
}

double Corrector::size(const Vector& dv, const Vector& v) const {
  const Eigen::Index n = v.size() - 1;
  const double u = norm_u(dv) / std::max(norm_u(v), smallest_relevant_state);
  const double p = std::abs(dv[n]) / std::max(std::abs(v[n]), smallest_relevant_parameter * parameter_scale_);
  return std::max(u, p);
}

bool Corrector::evaluate(const Vector& v, Needs needs) {
  const Eigen::Index n = v.size() - 1;
  p_[free_] = v[n];
  ++counts_.residuals;
  if (needs == Needs::jacobian) ++counts_.jacobians;
  failure_.clear();
  try {
    if (evaluator_->move_to(v.head(n), p_, needs) != Evaluated::ok) return false;
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
  if (evaluator_->residual().size() != n) {
    failure_ = "the residual has " + std::to_string(evaluator_->residual().size()) + " entries for " +
               std::to_string(n) + " unknowns";
    return false;
  }
  return all_finite(evaluator_->residual());
}

bool Corrector::factorize(const Vector& v, const Vector& row) {
  failure_.clear();
  const Eigen::Index n = F_p_.size();
  try {
    evaluator_->parameter_derivative(free_, F_p_);
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
  if (!all_finite(F_p_)) {
    failure_ = "dF/dp is not finite";
    return false;
  }
  if (!solver_) solver_ = suitable_solver(evaluator_->jacobian());
  chord_safety_ = chord_safety(evaluator_->jacobian());
  borders_.columns.col(0) = F_p_;
  borders_.rows.col(0) = row.head(n);
  borders_.corner(0, 0) = row[n];
  ++counts_.factorizations;
  try {
    const bool regular = solver_->factorize(evaluator_->jacobian(), borders_);
    if (!solver_->keeps_pivots())
      memory_.pivots_kept = false;
    else if (!memory_.pivots_kept) {
      std::swap(memory_.pivots, memory_.factors);
      memory_.pivots_kept = true;
    }
    memory_.factors.v = v;
    memory_.factors.row = row;
    memory_.factors.state = state_;
    return regular;
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
}

void Corrector::solve(Vector& dv) const {
  const Eigen::Index n = dv.size() - 1;
  dv.head(n) = -evaluator_->residual();
  dv[n] = 0;
  back_substitute(dv);
}

void Corrector::back_substitute(Vector& x) const {
  ++counts_.solves;
  try {
    solver_->solve(x);
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

void Corrector::set_state(const Vector& state) {
  state_ = state;
  evaluator_->set_state(state);
}

bool Corrector::next_state(const Vector& v, Vector& state) {
  if (!evaluate(v, Needs::residual)) return false;
  try {
    evaluator_->next_state(state);
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
  if (!all_finite(state)) failure_ = "the state is not finite";
  return failure_.empty();
}

bool Corrector::piece(std::uint64_t& piece) {
  try {
    piece = evaluator_->piece();
    return true;
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
}

bool Corrector::is_in_piece(const Vector& v, std::uint64_t piece, PieceTest test) {
  p_[free_] = v[v.size() - 1];
  ++counts_.residuals;
  failure_.clear();
  bool inside = false;
  try {
    return evaluator_->test_piece(v.head(v.size() - 1), p_, piece, test, inside) == Evaluated::ok && inside;
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return false;
  }
}

std::optional<std::uint64_t> Corrector::piece_of_residual() const {
  try {
    return evaluator_->piece();
  } catch (const std::exception& thrown) {
    failure_ = thrown.what();
    return {};
  }
}

bool Corrector::linearize(const Vector& v, const Vector& row) {
  return evaluate(v, Needs::jacobian) && factorize(v, row);
}

void Corrector::restore(const FactorMemory& memory) {
  const Counts before = counts_;
  const Vector now = state_;
  const auto repeat = [this](const Linearization& made) {
    if (made.state.size() != 0) set_state(made.state);
    linearize(made.v, made.row);
  };
  if (memory.pivots_kept) repeat(memory.pivots);
  if (memory.factors.v.size() != 0) repeat(memory.factors);
  if (now.size() != 0) set_state(now);
  counts_ = before;
  memory_ = memory;
}

void Corrector::forget() {
  memory_ = {};
  if (solver_) solver_->forget_pivots();
}

bool Corrector::tangent(Vector& t) const {
  t.setZero();
  t[t.size() - 1] = 1;
  back_substitute(t);
  const double length = std::sqrt(dot(t, t));
  if (!std::isfinite(length) || length == 0) return false;
  t /= length;
  return true;
}

bool Corrector::apply_inverse(Vector& x) const {
  back_substitute(x);
  return all_finite(x);
}

void Corrector::apply(const Vector& x, Vector& y) const {
  const Eigen::Index n = F_p_.size();
  continuation::apply(evaluator_->jacobian(), x.head(n), y.head(n));
  y.head(n) += x[n] * F_p_;
  y[n] = 0;
}

Vector Corrector::generic_direction(int k) const {
  Vector x(weights_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto j = static_cast<double>(i);
    x[i] = (std::sin((0.7 + 0.1 * k) * j * j + 0.5 + k) + (i == k ? 0.1 : 0)) / std::sqrt(weights_[i]);
  }
  return x;
}

// Whether Newton's method leaves an error far below the tolerance from a point with this one, by the
// contraction of the corrections with factors at from_factors_. Where a small unknown bends F and a large one
// makes the distance, only that of the unknowns that are corrected counts. dv_: a correction of the size
// `now`.
bool Corrector::leaves_little(double error, double contraction, double now) const {
  if (accept_ != Accept::expected_error || !(error <= largest_accepted)) return false;
  const double square = (dv_.array().square() * weights_.array()).sum();
  const double away = (dv_.array() * from_factors_.array()).abs().matrix().dot(weights_);
  return contraction * error * (error / now) * square <= expected_share * options_.tolerance * away;
}

// Chord steps with the present factors, until one linearization is expected to complete the correction. False
// if they do not contract; v is then unchanged.
bool Corrector::chord(Vector& v, Correction& result) {
  if (memory_.factors.v.size() == v.size()) from_factors_ = v - memory_.factors.v;
  if (!evaluate(v, Needs::residual)) {
    result.evaluated = false;
    return false;
  }
  solve(dv_);
  double now = size(dv_, v);
  result.first = now;
  if (!(now < 1)) return false;
  v += dv_;
  ++result.iterations;
  const int longest = longest_chord(evaluator_->jacobian());
  for (int k = 1; k < longest; ++k) {
    const double expected = now * chord_safety_ * memory_.contraction;
    if (expected <= options_.tolerance || leaves_little(expected, memory_.contraction, now)) break;
    if (!evaluate(v, Needs::residual)) {
      result.evaluated = false;
      return false;
    }
    solve(next_);
    const double next = size(next_, v);
    const double ratio = next / now;
    if (k == 1) result.contraction = ratio;
    if (!(ratio <= options_.chord_contraction)) {
      if (!(ratio <= 1)) {
        v -= dv_;
        from_factors_.setZero();  // that contraction says nothing
      }
      break;
    }
    v += next_;
    std::swap(dv_, next_);
    now = next;
    memory_.contraction = ratio;
    ++result.iterations;
  }
  result.last = now;
  return true;
}

// A correction that is not finite has no size.
const Vector& Corrector::correction_at(const Vector& v) {
  if (evaluate(v, Needs::residual))
    solve(dv_);
  else
    dv_.setConstant(std::numeric_limits<double>::quiet_NaN());
  return dv_;
}

// The first of the points v + dv, v + dv / 2, ... that passes the natural test becomes trial_. False: none.
bool Corrector::damp(const Vector& v, double now) {
  for (double damping = 1; damping >= smallest_damping; damping /= 2) {
    trial_ = v + damping * dv_;
    if (!evaluate(trial_, Needs::residual)) continue;
    solve(next_);
    const Vector& larger = norm_u(trial_) > norm_u(v) ? trial_ : v;
    if (size(next_, larger) <= (1 - damping / 4) * now) return true;
  }
  return false;
}

Correction Corrector::correct(Vector& v, const Vector& row, bool keep_factors, Accept accept) {
  const bool is_relative = std::abs(v[v.size() - 1]) >= smallest_relevant_parameter * parameter_scale_;
  accept_ = problem_.smooth() && is_relative ? accept : Accept::last_correction;
  NewtonRun run{v, row, true, {}, 0};
  from_factors_.setZero();
  if (keep_factors && options_.chord && problem_.chord_pays() && !chord(v, run.result) &&
      !run.result.evaluated)
    return run.result;
  run.before = run.result.last;
  return newton(run, options_.iterations);
}

Correction Corrector::newton(Vector& v, const Vector& row, int iterations, Damping damping) {
  accept_ = Accept::last_correction;
  NewtonRun run{v, row, damping == Damping::natural, {}, 0};
  return newton(run, iterations);
}

Correction Corrector::newton(NewtonRun& run, int iterations) {
  for (int k = 0; k < iterations; ++k, ++run.result.iterations) {
    const Newton state = newton_step(run, k);
    if (state == Newton::converged) return run.result;
    if (state == Newton::failed) return fall_back(run);
  }
  run.result.linear = true;  // it converged in all iterations, but too slowly
  return fall_back(run);
}

Corrector::Newton Corrector::newton_step(NewtonRun& run, int k) {
  Correction& result = run.result;
  if (run.is_damped && result.linear && k >= options_.iterations) return Newton::failed;
  if (!evaluate(run.v, Needs::jacobian)) {
    result.evaluated = false;
    return Newton::failed;
  }
  if (!factorize(run.v, run.row)) {
    result.singular = true;
    return Newton::failed;
  }
  solve(dv_);
  const double now = size(dv_, run.v), before = run.before;
  note_size(run, now, k);
  const bool cycles = this->cycles(run);
  if (now <= linear_share * before) result.linear = false;
  if (is_complete(run) || cycles) return take_last(run, !cycles);
  if (!std::isfinite(now)) return Newton::failed;
  const bool was_small = k > 0 && before > 0 && before < undamped;
  result.linear = was_small && now > linear_share * before;
  if (run.is_damped && now >= undamped) return take_damped(run);
  if (run.is_damped && was_small && now > undamped_divergence * before) return Newton::failed;
  run.v += dv_;
  run.before = now;
  from_factors_ = dv_;
  return Newton::goes_on;
}

// By the last correction, or by the error that is expected to remain.
bool Corrector::is_complete(NewtonRun& run) const {
  const double now = run.result.last, before = run.before;
  run.result.expected = now > options_.tolerance && before > 0 && leaves_little(now, now / before, now);
  if (before > 0) run.result.last_contraction = now / before;
  return now <= options_.tolerance || run.result.expected;
}

void Corrector::note_size(NewtonRun& run, double now, int k) {
  Correction& result = run.result;
  result.last = now;
  if (result.first == 0) result.first = now;
  if (!(run.before > 0)) return;
  if (result.contraction == 0) result.contraction = now / run.before;
  if (k == 0) memory_.contraction = std::max(now / run.before, 1e-4);
}

// Whether small corrections do not decrease at a kink: they cycle between two pieces, if there is no
// solution.
bool Corrector::cycles(NewtonRun& run) {
  const double now = run.result.last;
  std::optional<std::uint64_t> piece;
  if (now > options_.tolerance && now <= options_.rounding_level) piece = piece_of_residual();
  const bool same = piece && piece == run.piece_before && now > 0.5 * run.before;
  run.piece_before = piece;
  return same;
}

// Takes a correction within the tolerance: the last one, unless it crosses a kink, beyond which the equations
// are others and the branch may be far from a solution of these.
Corrector::Newton Corrector::take_last(NewtonRun& run, bool may_cross) {
  may_cross = may_cross && run.result.last > surely_within && !run.crossed && !problem_.smooth() &&
              problem_.cheap_residual();
  const std::optional<std::uint64_t> piece = may_cross ? piece_of_residual() : std::nullopt;
  run.v += dv_;
  p_[free_] = run.v[run.v.size() - 1];
  if (piece && !is_in_piece(run.v, *piece, PieceTest::whole)) {
    across_ = run.v;
    run.crossed = true;
    run.before = run.result.last;
    return Newton::goes_on;
  }
  run.result.converged = true;
  return Newton::converged;
}

Corrector::Newton Corrector::take_damped(NewtonRun& run) {
  if (!damp(run.v, run.result.last)) return Newton::failed;
  run.v = trial_;
  run.before = 0;
  return Newton::goes_on;
}

// Beyond a kink that was crossed there was no better solution than the one that crossed it.
Correction Corrector::fall_back(NewtonRun& run) {
  Correction& result = run.result;
  if (!run.crossed) return result;
  run.v = across_;
  p_[free_] = run.v[run.v.size() - 1];
  result.evaluated = result.converged = true;
  result.singular = result.linear = false;
  return result;
}

}  // namespace arcslip::continuation
