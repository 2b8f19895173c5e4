#pragma once
// A distribution of sliders in parallel, each behind a spring, in the frequency domain: the force on each
// branch of the motion follows from the backbone (hysteresis_loops.hpp)
//
//   F(s) = P g(y),   y = K s/P,   g(0) = 0,   g'(0) = 1,   g(infinity) = 1
//
// with the stiffness K of small motions, N/m, and the force P of macroslip, N. F is homogeneous: with
//
//   f = K A + P B,   A: of the sliders that stick, g' (x - x_a)/2 on a backbone; B: of the others, g - y g'
//
// dF/dK = A and dF/dP = B. With the anchors a and the integrals over their branches l_a of phi, m_a of g' phi
// and G of g' phi phi^T:
//
//   A = kappa (G u + sum_a (A_a l_a - x_a m_a)),   dF/du = kappa K (G + sum_a (l_a dA_a^T - m_a phi_a^T))
//   dA_a = dA_p + g'_a (phi_a - phi_p) from the parent p;   g'/2 (phi_max - phi_min) at the largest x
//
// kappa = 1/pi (mean row 1/(2 pi)), or 2/pi over half a period for antisymmetric motion. The ends of parts
// and the angles of anchors do not enter, since f is continuous there and x' = 0 here. The mean is the limit
// from macroslip: sliders that stick for the whole period are centred.
//
// A law defines the backbone and the integrals over a part of a branch. See
// docs/theory/03-friction-integrals.md.

#include <arcslip/fourier/moments.hpp>
#include <arcslip/laws/element.hpp>
#include <arcslip/laws/hysteresis/hysteresis_loops.hpp>

#include <array>

namespace arcslip::elements {

class MasingElement : public Element {
 public:
  explicit MasingElement(const Harmonics& harmonics);

  void move_to(In u, std::span<const double> fields, bool jacobian) final;
  const Eigen::VectorXd& force() const final { return F_; }
  const Eigen::MatrixXd& jacobian() const final { return J_; }
  void field_derivative(int field, Out dF) const final;
  std::uint64_t piece() const final { return piece_; }
  bool friction(FrictionState& state) const final;

  /// The force at some angles of the motion u, N.
  void force_at(In u, std::span<const double> fields, std::span<const double> angles, Out f);

 protected:
  static constexpr int most_shapes = 2;  // fields behind stiffness and slip force, the shape of g
  using Shapes = std::array<double, most_shapes>;

  /// K and P, and how they grow with the first two fields.
  struct Scales {
    double stiffness, slip_force;
    double by_first = 1, by_second = 1;
  };
  /// At one y: g', g - y g' and dg/d(shape).
  struct Backbone {
    double slope, rest;
    Shapes by_shape;
  };
  /// exp(i k t) - 1 or integrals of exp(i k t), k = 0 .. 2N.
  struct Powers {
    explicit Powers(int order)
        : re(Eigen::ArrayXd::Zero(2 * order + 1)), im(Eigen::ArrayXd::Zero(2 * order + 1)) {}
    void clear() { re.setZero(), im.setZero(); }
    Eigen::ArrayXd re, im;
  };
  /// Over a part that begins at t = 0: of g' exp(i k t) up to 2N, and, up to N, of 2 s (g - y g') exp(i k t)
  /// and of 2 s dg/d(shape) exp(i k t).
  struct Integrals {
    explicit Integrals(int order) : slope(order), rest(order), shapes{Powers(order), Powers(order)} {}
    Powers slope, rest;
    std::array<Powers, most_shapes> shapes;
  };

  virtual Scales set(std::span<const double> fields) = 0;
  virtual int shapes() const { return 0; }
  virtual Backbone at(double y) const = 0;
  /// The y up to which g = y.
  virtual double first_slip() const { return 0; }
  /// Another number on the other side of each kink of g'; 0 where g = y.
  virtual std::uint64_t level(double y) const = 0;
  virtual void integrate(In u, const BranchPart& part, Integrals& over) = 0;

  const Harmonics& harmonics() const { return h_; }
  const Anchor& anchor(const BranchPart& part) const {
    return loops_.anchors()[static_cast<std::size_t>(part.anchor)];
  }
  const HysteresisLoops& loops() const { return loops_; }
  /// s at y = 1.
  double unit() const { return scales_.slip_force / scales_.stiffness; }

  /// exp(i k t) - 1 for k = 0 .. count - 1, without loss of digits at small t.
  static void powers_less_one(double t, int count, Powers& w);
  /// sum += factor * the integral of exp(i k t) from 0 to where w is, k = 1 .. N.
  void add_interval(double length, double factor, const Powers& w, Powers& sum) const;

 private:
  struct State {  // of the force at an anchor
    double a, b;  // A and B there
    double slope;
    Shapes shapes;
  };

  double y_of(double s) const { return s == 0 ? 0 : s / unit(); }
  void stick(In u, bool jacobian);
  void slide(In u, bool jacobian);
  void find_states();
  void find_piece();
  void add(In u, const BranchPart& part, bool jacobian);
  void add_anchors();
  void turn(const Powers& relative, Eigen::VectorXd& along) const;
  void fill_basis(double theta, Out phi);

  Harmonics h_;
  HysteresisLoops loops_;
  Moments moments_;
  Scales scales_{};
  std::vector<State> states_;
  Integrals over_;
  Powers end_, length_;
  Eigen::VectorXd A_, B_, F_, l_, m_, b_;
  std::array<Eigen::VectorXd, most_shapes> by_shape_;
  Eigen::MatrixXd J_, L_, V_;  // L_, V_: a column for each anchor
  std::vector<std::complex<double>> turned_;
  Eigen::ArrayXd inverse_;
  double stuck_ = 0;
  std::uint64_t piece_ = 0;
};

}  // namespace arcslip::elements
