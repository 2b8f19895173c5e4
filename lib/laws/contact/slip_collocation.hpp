#pragma once
// Slip of a slider that a disc carries along, by collocation.
//
// In slip w = x - h n, n = (cos psi, sin psi), and w' = (x'.n - h') n, so that
//
//   h psi' = x'.t,   t = (-sin psi, cos psi)
//
// Slip goes on while x'.n >= h'. psi is a polynomial on each panel that meets the equation at Radau's nodes,
// of which the last one is the end of the panel: there h may be 0, where the contact opens. At a closing,
// where h is 0 at the beginning, psi begins as the direction of x'.

#include <arcslip/laws/contact/planar_slider.hpp>

#include <array>
#include <vector>

namespace arcslip::elements {

constexpr int panel_nodes = 10;

struct SlipPanel : DiscNodes<panel_nodes> {  // x', x'', h, h', h'' at the nodes
  using Square = Eigen::Matrix<double, panel_nodes, panel_nodes>;

  double begin = 0, end = 0;
  double from = 0;            // psi at the beginning
  Nodes theta, psi;           // at the nodes
  Nodes cosine, sine;         // of theta
  Nodes outward[2], turn[2];  // n and t
  Nodes along, across;        // x'.n and x'.t
  Nodes rate;                 // psi'
  Nodes spare;                // x'.n - h', the speed of slip
  Nodes gain;                 // its derivative

  double length() const { return end - begin; }
  double to() const { return psi[panel_nodes - 1]; }
  /// The same in another period, where psi has made some turns.
  void shift(double angle, double turns) {
    begin += angle;
    end += angle;
    theta.array() += angle;
    from += turns;
    psi.array() += turns;
  }
  Eigen::Vector2d last_outward() const { return {outward[0][panel_nodes - 1], outward[1][panel_nodes - 1]}; }
};

/// The triangular factors of the equation's derivative by psi at the nodes, without a choice of pivots: those
/// of Radau's matrix are positive, and x'.n adds to them. Where it is negative, beyond the end of slip, what
/// comes out may be useless, which Newton's method notices.
class SlipFactors {
 public:
  void factorize(const SlipPanel::Square& matrix);
  SlipPanel::Nodes solve(SlipPanel::Nodes right) const;
  SlipPanel::Square inverse() const;

 private:
  SlipPanel::Square lu_;
  SlipPanel::Nodes inverse_;  // of the diagonal of U
};

/// Radau's nodes on [-1, 1], with what belongs to them.
class SlipCollocation {
 public:
  SlipCollocation();

  /// The size of the last two Legendre coefficients of h psi on the panel: what is not resolved is below it,
  /// and psi at the end is more exact by far. Infinite if Newton's method fails: the panel is too long. It
  /// ends early, with a larger number than the tolerance, where that can be seen.
  double solve(const Disc& disc, double begin, double end, double from, double tolerance,
               SlipPanel& panel) const;
  /// The same where the solution from another psi, or over almost the same angles, is known.
  double solve_near(const Disc& disc, const SlipPanel& known, double begin, double end, double from,
                    double tolerance, SlipPanel& panel) const;

  /// The panel with a constant psi, where no length resolves it.
  void hold(const Disc& disc, double begin, double end, double psi, SlipPanel& panel) const;

  /// The matrix of the equation's derivative by psi at the nodes, and its column by psi at the beginning.
  SlipPanel::Square matrix(const SlipPanel& panel) const;
  SlipPanel::Nodes column(const SlipPanel& panel) const;
  /// Weights of the integral over the panel.
  SlipPanel::Nodes weights(const SlipPanel& panel) const { return 0.5 * panel.length() * weights_; }
  /// psi at an angle within the panel.
  double psi(const SlipPanel& panel, double theta) const;

 private:
  void place(const Disc& disc, double begin, double end, SlipPanel& panel) const;
  void interpolate(const SlipPanel& panel, const SlipPanel::Nodes& theta, SlipPanel::Nodes& values) const;
  void guess(const Disc& disc, SlipPanel& panel) const;
  double newton(double tolerance, SlipPanel& panel) const;
  void set_rate(SlipPanel& panel) const;
  void finish(SlipPanel& panel) const;
  double tail(const SlipPanel& panel) const;

  SlipPanel::Nodes nodes_, weights_, by_first_;
  SlipPanel::Square derivative_;
  Eigen::Matrix<double, 2, panel_nodes + 1> tail_;  // the last two Legendre coefficients of psi
  Eigen::Matrix<double, panel_nodes + 1, 1> barycentric_;
};

}  // namespace arcslip::elements
