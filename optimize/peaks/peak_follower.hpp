#pragma once
// Tracking of one peak from design to design, by Newton's method on its equations. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <span>
#include <vector>

namespace arcslip::optimize {

using continuation::Vector;

/// All parameters; `over` are the design parameters.
struct DesignPoint {
  std::vector<int> over;
  Vector p;
};

/// Tracks the solution x(p) of equations E(x, p) = 0.
class PeakFollower {
 public:
  /// base: all parameters of the equations.
  PeakFollower(std::shared_ptr<const continuation::Problem> equations, std::vector<int> over,
               const Vector& base);

  /// Newton's method at a design, from x. False if it fails; x is then unchanged.
  bool correct(Vector& x, std::span<const double> design);

  /// Factors of E_x at a solution, for tangent(). False: singular.
  bool linearize(const Vector& x, std::span<const double> design);

  /// Whether the factors belong to this solution.
  bool is_at(const Vector& x, std::span<const double> design) const;

  /// dx/dp_k of design parameter k at the last correct() or linearize().
  Vector tangent(std::size_t k);

  /// The evaluator of the equations, at the start of the last correction.
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
