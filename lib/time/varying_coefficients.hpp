#pragma once
// What the laws that are not piecewise linear add to the variational equation along a motion (floquet.hpp).
// Private.
//
//   smooth, without memory   T = df/dq, B = df/dv
//   hysteretic               T = f_q + f_z r, and f_z phi y of the memory's own disturbance y
//                            (hysteresis_course.hpp)
//
// each replaced on a piece by the polynomial of degree 7 through its values at the eight nodes of Gauss and
// Legendre. What is left out is orthogonal to polynomials of degree 7: an error of order 16 in the length of
// a piece, where the coefficient is smooth.

#include <arcslip/elements/hysteresis.hpp>
#include <arcslip/time/hysteresis_course.hpp>
#include <arcslip/time/legendre_fit.hpp>
#include <arcslip/time/variation.hpp>

#include <vector>

namespace arcslip::time {

struct ElementCourse;

class VaryingCoefficients {
 public:
  VaryingCoefficients();

  /// Whether a law is one of these.
  static bool takes(const elements::Law& law);
  /// index: of the element in ElementCourses; over_mass: M^-1 D. The element must outlive this.
  void add(const TimeElement& element, int index, Matrix over_mass);

  /// Goes to a motion. omega: base frequency, rad/s. False: the motion is not finite.
  bool follow(double omega, const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements);
  /// The courses of the hysteretic laws along it.
  std::size_t hystereses() const { return hystereses_.size(); }
  const HysteresisCourse& course(std::size_t hysteresis) const { return hystereses_[hysteresis].course; }

  /// The disturbance of its memory, y at the last reversal: a number for each start.
  Vector& memory(std::size_t hysteresis) { return variables_[hystereses_[hysteresis].variable].memory; }
  /// Passes the reversal of a course with the variations W, starts x dofs.
  void pass(std::size_t hysteresis, std::size_t turn, const Matrix& W);

  /// Whether there are laws without memory, which may change fast anywhere.
  bool any_smooth() const { return !smooth_.empty(); }

  /// Bounds of what T and B add to the fastest motion, squared rate by T, and rate by B, in rad/rad.
  struct Rates {
    double stiffness = 0, damping = 0;
  };
  struct Piece {
    Rates largest;  // at the nodes
    Rates sizes;    // of the coefficients of s^j, all together
    double last;    // of the last two Legendre polynomials of hysteretic laws, squared rate
  };
  /// On the piece of length h from an angle theta, rad.
  Piece interpolate(double theta, double h);
  /// What the last interpolate() leaves out of hysteretic laws next to the ends of its piece, where a sharp
  /// yield may lie beyond the nodes: squared rate.
  double left_out(double theta, double h) const;
  const std::vector<Variable>& variables() const { return variables_; }

 private:
  static constexpr int nodes = 8;
  using Values = Eigen::Matrix<double, nodes, 1>;
  using Square = Eigen::Matrix<double, nodes, nodes>;
  struct Smooth {
    const TimeElement* element;
    int index;
    std::size_t variable;
    bool moving;  // its force depends on velocities
    elements::StepEnd at;
    Matrix T, B;  // side by side
  };
  struct Hysteretic {
    const TimeElement* element;
    int index;
    std::size_t variable;
    double f_q, f_z;
    HysteresisCourse course;
  };

  void set(Smooth& law, Piece& piece);
  void set(Hysteretic& law, double theta, double h, Piece& piece);
  void replace(const Matrix& at_nodes, double scale, Matrix& by_powers);
  Values coefficients(const Values& at_nodes, double& last) const;

  const LegendreFit fit_;
  const Square by_values_, powers_;
  Values cos_, sin_;  // of the angles of the nodes
  std::vector<Variable> variables_;
  std::vector<Matrix> directions_;  // of variables_
  std::vector<Smooth> smooth_;
  std::vector<Hysteretic> hystereses_;
  double omega_ = 1;
  elements::Harmonics harmonics_;
  const std::vector<ElementCourse>* elements_ = nullptr;
  Vector q_, none_;
  Matrix legendre_;
};

}  // namespace arcslip::time
