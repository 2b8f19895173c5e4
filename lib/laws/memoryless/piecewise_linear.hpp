#pragma once
// Springs without memory whose force f(q) is piecewise linear and continuous. With corners at c_1 L <= c_2 L
// <= ..., the force on line j, which is left of corner j, is
//
//   f(q) = sum_a p_a (s_aj q + o_aj L)                                                            (N)
//
// p_a: the first fields of the law, stiffnesses or factors. L: a length, the size of its last field, or 1.
//
// Exact in harmonics: the angles are found where q(theta) reaches a corner and, with the integrals G_j of
// phi phi^T and l_j of phi over the angles where q is on line j (fourier/moments.hpp),
//
//   F = sum_a p_a A_a,   A_a = kappa sum_j (s_aj G_j u + o_aj L l_j),   dF/du = kappa sum_aj p_a s_aj G_j
//   dF/dp_a = A_a,       dF/dL = kappa sum_aj p_a o_aj l_j
//
// kappa = 1/pi (mean row 1/(2 pi)). The motion of the ends of the intervals does not enter, since f is
// continuous there. Each line has integrals of its own, so that a soft one loses no digits next to a stiff
// one. Where q just touches a corner, an interval of length s appears or vanishes: J is continuous and varies
// with s, the square root of what lies beyond.

#include <arcslip/laws/law.hpp>

#include <string_view>
#include <vector>

namespace arcslip::elements {

/// The numbers c, s and o.
struct PiecewiseLinearShape {
  struct Line {
    double slope = 0, offset = 0;
    friend bool operator==(const Line&, const Line&) = default;
  };
  std::vector<double> corners;           // c, ascending
  std::vector<std::vector<Line>> terms;  // for each p_a, corners.size() + 1 lines, from the left
  std::vector<std::string_view> names;   // of the lines, as modes in time: literals
  bool contact = false;                  // the lines are states of a contact

  std::size_t lines() const { return corners.size() + 1; }
};

class PiecewiseLinearLaw final : public Law {
 public:
  /// L = 1.
  explicit PiecewiseLinearLaw(PiecewiseLinearShape shape);
  /// L is the size of the last field; the second shape is that of its negative values.
  PiecewiseLinearLaw(PiecewiseLinearShape positive, PiecewiseLinearShape negative);

  Facts facts() const override {
    return {.antisymmetric = antisymmetric_, .reports_contact = shapes_.front().contact};
  }
  Traits traits(Fields fields, int direction) const override;
  double stiffness(Fields fields, int direction, double reach) const override;

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override;
  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override;
  Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const override;

  std::optional<std::vector<Automaton>> automata(Fields fields) const override;

 private:
  std::vector<PiecewiseLinearShape> shapes_;  // one, or one for each sign of the last field
  bool antisymmetric_;
};

}  // namespace arcslip::elements
