#pragma once
// Newton's method on the equations of one peak, from design to design. Not installed.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/tracing/corrector.hpp>

#include <memory>
#include <span>
#include <vector>

namespace arcslip::optimize {

using continuation::Vector;

/// All parameters, of which those in `over` are the design's.
struct DesignPoint {
  std::vector<int> over;
  Vector p;
};

/// Follows the solution x(p) of equations E(x, p) = 0.
class Follower {
 public:
  /// base: all parameters of the equations.
  Follower(std::shared_ptr<const continuation::Problem> equations, std::vector<int> over, const Vector& base);

  /// Newton's method at a design, from x. False where it fails; x is then as it was.
  bool correct(Vector& x, std::span<const double> design);

  /// Factors of E_x at a solution, for tangent(). False: singular.
  bool linearize(const Vector& x, std::span<const double> design);

  /// Whether the factors are those of this solution.
  bool is_at(const Vector& x, std::span<const double> design) const;

  /// dx/dp_k of design parameter k where correct() or linearize() was last.
  Vector tangent(std::size_t k);

  /// The evaluator of the equations, where the last correction began.
  continuation::Evaluator& at();
  const continuation::LinearSolver& factors() const { return corrector_.factors(); }
  const Vector& parameters() const { return point_->p; }
  long factorizations() const { return counts_.factorizations; }

 private:
  void move(std::span<const double> design);

  std::shared_ptr<DesignPoint> point_;
  std::shared_ptr<const continuation::Problem> problem_;
  continuation::Counts counts_;
  continuation::Corrector corrector_;
  Vector v_, row_;
  bool factorized_ = false;  // at v_
};

}  // namespace arcslip::optimize
