#include <arcslip/continuation/diagrams/deflation.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

constexpr double shortest_step = 1.0 / 1024;   // of a step, if the problem cannot be evaluated further out
constexpr double start_displacement = 1e-2;    // from a known solution, relative to 1 + |u|
constexpr double golden = 0.6180339887498949;  // the limit of the steps varies, so that they do not cycle
constexpr double limit_range = 0.5;            // of itself
constexpr double limits[] = {1, 0.25, 4};      // of the steps, times largest_step: one attempt with each

class Deflation {
 public:
  Deflation(const Problem& problem, const Vector& p, const std::vector<Vector>& known,
            const DeflationOptions& options)
      : problem_(problem),
        p_(p),
        known_(known),
        options_(options),
        evaluator_(problem.evaluator()),
        solver_(options.linear_solver ? options.linear_solver() : problem.linear_solver()),
        none_(problem.size(), 0),
        weights_(problem.scales().cwiseAbs2().cwiseInverse()),
        s_(problem.size()),
        step_(problem.size()),
        trial_(problem.size()),
        h_(problem.size()),
        from_(problem.size()),
        metric_(problem.size()) {}

  std::optional<Vector> solve(Vector u, double limit);
  void add(const Vector& u) { known_.push_back(u); }
  bool is_known(const Vector& u) { return nearest(u) <= options_.apart * (1 + norm(u)); }
  double norm(const Vector& v) {
    weigh(v);
    return std::sqrt(std::max(v.dot(metric_), 0.0));
  }

 private:
  void weigh(const Vector& v) {
    if (!problem_.metric(v, metric_)) metric_ = v.cwiseProduct(weights_);
  }
  bool evaluate(const Vector& u, Needs needs);
  double nearest(const Vector& u);
  void log_gradient(const Vector& u);
  bool go(Vector& u);

  const Problem& problem_;
  Vector p_;
  std::vector<Vector> known_;
  const DeflationOptions& options_;
  std::unique_ptr<Evaluator> evaluator_;
  std::unique_ptr<LinearSolver> solver_;
  Borders none_;
  Vector weights_, s_, step_, trial_, h_, from_, metric_;
};

bool Deflation::evaluate(const Vector& u, Needs needs) {
  try {
    return evaluator_->move_to(u, p_, needs) == Evaluated::ok && evaluator_->residual().allFinite();
  } catch (const std::exception&) {
    return false;
  }
}

double Deflation::nearest(const Vector& u) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector& other : known_) {
    from_ = u - other;
    least = std::min(least, norm(from_));
  }
  return least;
}

// h = grad m / m: of each factor, -2 M d / (|d|^2 (1 + |d|^2)).
void Deflation::log_gradient(const Vector& u) {
  h_.setZero();
  for (const Vector& other : known_) {
    from_ = u - other;
    weigh(from_);
    const double square = from_.dot(metric_);
    h_ -= 2 / (square * (1 + square)) * metric_;
  }
}

// Moves by step_, or by the part of it at which the problem can be evaluated.
bool Deflation::go(Vector& u) {
  for (double share = 1; share >= shortest_step; share /= 2) {
    trial_ = u + share * step_;
    if (!evaluate(trial_, Needs::jacobian)) continue;
    u = trial_;
    return true;
  }
  return false;
}

std::optional<Vector> Deflation::solve(Vector u, double limit) {
  if (!evaluate(u, Needs::jacobian)) return {};
  double before = 0;
  for (int k = 0; k < options_.iterations; ++k) {
    if (!options_.control.keep_going()) return {};
    if (!solver_) solver_ = suitable_solver(evaluator_->jacobian());
    if (!solver_->factorize(evaluator_->jacobian(), none_)) return {};
    s_ = -evaluator_->residual();
    solver_->solve(s_);
    const double size = 1 + norm(u), now = norm(s_) / size;
    if (!std::isfinite(now)) return {};
    const bool stagnates = k > 0 && now > 0.5 * before && now <= options_.rounding_level;
    if (now <= options_.tolerance || stagnates) {
      u += s_;
      if (is_known(u)) return {};
      return u;
    }
    before = now;
    log_gradient(u);
    const double scaling = 1 / (1 - h_.dot(s_));
    if (!std::isfinite(scaling)) return {};
    step_ = scaling * s_;
    double whole = 0;
    const double largest = limit * (1 - limit_range * std::modf(golden * k, &whole)) * size;
    const double length = norm(step_);
    if (length > largest) step_ *= largest / length;
    if (!go(u)) return {};
  }
  return {};
}

// A generic direction of norm 1.
Vector aside(Deflation& in, Eigen::Index n, const Vector& scales) {
  Vector v(n);
  for (Eigen::Index i = 0; i < n; ++i)
    v[i] = scales[i] * (0.6 + std::sin(1.3 * static_cast<double>(i + 1) + 0.4));
  return v / in.norm(v);
}

void check_input(const Problem& problem, const Vector& p, const std::vector<Vector>& known,
                 const std::vector<Vector>& guesses, const DeflationOptions& options) {
  const auto n = problem.size();
  if (p.size() != static_cast<Eigen::Index>(problem.parameters().size()))
    throw std::invalid_argument(std::to_string(p.size()) + " parameters are given, the problem has " +
                                std::to_string(problem.parameters().size()));
  const auto fits = [&](const std::vector<Vector>& all, const std::string& what) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].size() != n || !all[i].allFinite())
        throw std::invalid_argument(what + " " + std::to_string(i) + " needs " + std::to_string(n) +
                                    " finite unknowns; it has " + std::to_string(all[i].size()));
  };
  fits(known, "known solution");
  fits(guesses, "guess");
  const auto positive = [](double value, const char* what) {
    if (!(value > 0)) throw std::invalid_argument(std::string(what) + " must be larger than 0");
  };
  positive(options.tolerance, "tolerance");
  positive(options.iterations, "iterations");
  positive(options.largest_step, "largest_step");
  positive(options.apart, "apart");
  positive(options.solutions, "solutions");
  if (!(options.rounding_level >= options.tolerance))
    throw std::invalid_argument("rounding_level must not be smaller than tolerance");
}

}  // namespace

std::vector<Vector> deflate(const Problem& problem, const Vector& p, const std::vector<Vector>& known,
                            const std::vector<Vector>& guesses, const DeflationOptions& options) {
  check_input(problem, p, known, guesses, options);
  Deflation deflation(problem, p, known, options);
  const Vector way = aside(deflation, problem.size(), problem.scales());
  std::vector<Vector> found;
  for (const Vector& guess : guesses)
    for (const double side : {1.0, -1.0}) {
      for (;;) {
        if (static_cast<int>(found.size()) >= options.solutions) return found;
        const bool moved = deflation.is_known(guess);
        if (!moved && side < 0) break;
        const double distance = moved ? side * start_displacement * (1 + deflation.norm(guess)) : 0;
        std::optional<Vector> solution;
        for (const double limit : limits)
          if (!solution) solution = deflation.solve(guess + distance * way, limit * options.largest_step);
        if (!solution) break;
        deflation.add(*solution);
        found.push_back(*solution);
      }
    }
  return found;
}

}  // namespace arcslip::continuation
