#pragma once
// The number of modes of B = [J F_p; r^T] that cross zero between two points of a branch: the branch points
// in one step, each with its rank loss as multiplicity.
//
// det B yields only the parity. Along B(x) = (1 - x) B_0 + x B_1 the matrix is singular where B_1^-1 B_0 has
// the eigenvalue -x/(1 - x), so that its negative eigenvalues are counted, from the first point to the middle
// of the step and from there to the second point. Pairs of eigenvalues of J that cross the imaginary axis, as
// at Hopf points, leave B regular and are not counted. Only the few eigenvalues of modes near zero differ
// much from 1: for up to 24 equations all are computed, otherwise those in a block Krylov space of B_1^-1 B_m
// - 1, which terminates at once if no mode is near zero.
//
// A mode that crosses zero and returns within half a step is not counted, but detected by the curvature of
// the mode: between a at the first point, m in the middle and 1 at the second.

#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace arcslip::continuation {

/// Times the measured bend of a mode, or of the slope of a quantity.
inline constexpr double pair_safety = 8;

struct ModeCrossings {
  int count = 0;
  bool is_certain = true;  // false: a mode is curved enough to cross zero and return
  bool at_zero = false;    // a mode is zero to rounding at the second point, and has no sign there

  bool is_odd() const { return count % 2 == 1; }
};

class ModeCounter {
 public:
  /// All arguments must outlive this. p: all parameters.
  ModeCounter(const Problem& problem, const Vector& p, int free, Counts& counts);

  /// Between two points on one smooth piece, `length` apart. row: r of the factors at `to`. Returns nothing
  /// if J cannot be evaluated between them, or another piece of F lies between.
  std::optional<ModeCrossings> between(const CurvePoint& from, const CurvePoint& to, double length,
                                       const Vector& row, const LinearSolver& at_to);

  /// The problem's state, for the steps that follow.
  void set_state(const Vector& state) { at_->set_state(state); }

  /// Whether all modes are computed, so that none is missed.
  bool counts_all() const;

 private:
  bool evaluate(const Vector& v, std::uint64_t piece);
  bool multiply(const Matrix& Q, Matrix& Y);
  bool basis();

  const Problem& problem_;
  Vector p_;
  int free_;
  Counts& counts_;
  std::unique_ptr<Evaluator> at_;
  Vector scale_, F_p_, x_, y_, middle_;
  const Vector* row_ = nullptr;
  const LinearSolver* at_to_ = nullptr;
  Matrix Q_, Y_, block_, image_;  // Y = B_1^-1 B_m Q
};

}  // namespace arcslip::continuation
