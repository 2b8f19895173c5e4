#pragma once
// What the monitors of curves of folds and of stationary points ask of the evaluators of these curves. Not
// installed.

#include <arcslip/continuation/problem/problem.hpp>

namespace arcslip::continuation {

class OnCurveOfStationaryPoints {
 public:
  virtual ~OnCurveOfStationaryPoints() = default;
  /// Zero at cusps. tangent: of the curve.
  virtual double cusp_function(In tangent) const = 0;
  /// Whether a zero of it is a cusp.
  virtual bool is_cusp(In tangent) const {
    static_cast<void>(tangent);
    return true;
  }
  /// The null vectors of J at a point of a curve of folds. False: not known, or another curve.
  virtual bool null_vectors(Vector& right, Vector& left) const {
    static_cast<void>(right), static_cast<void>(left);
    return false;
  }
  /// w . v of the null vectors: zero at Bogdanov-Takens points.
  virtual double left_times_right() const = 0;
};

}  // namespace arcslip::continuation
