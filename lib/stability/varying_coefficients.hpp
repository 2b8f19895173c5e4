#pragma once
// What the laws that are not piecewise linear add to the variational equation along a motion (floquet.hpp).
// Private.
//
//   smooth, without memory   T = df/dq, B = df/dv
//   hysteretic               T = f_q + f_z r, and f_z phi y of the memory's own disturbance y
//                            (memory_along.hpp)
//   friction in a plane      T and f_y, and the equation of y (planar_slip_along.hpp)
//
// each replaced on a piece by the polynomial of degree 7 through its values at the eight nodes of Gauss and
// Legendre. What is left out is orthogonal to polynomials of degree 7: an error of order 16 in the length of
// a piece, where the coefficient is smooth.

#include <arcslip/laws/hysteresis.hpp>
#include <arcslip/stability/legendre_fit.hpp>
#include <arcslip/stability/memory_along.hpp>
#include <arcslip/stability/planar_slip_along.hpp>
#include <arcslip/stability/variational_integrator.hpp>

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

  /// Goes to a motion. omega: base frequency, rad/s; fastest: mode of the rest, rad/s. False: the motion is
  /// not finite.
  bool follow(double omega, double fastest, const elements::Harmonics& harmonics,
              const std::vector<ElementCourse>& elements);
  /// Where the disturbance of a memory changes at once, by a reversal or a change of phase.
  struct Change {
    double theta;  // rad, in [0, 2 pi)
    std::size_t variable, index;
  };
  /// In any order; and further angles at which coefficients are not smooth, in [0, span).
  const std::vector<Change>& changes() const { return changes_; }
  const std::vector<double>& breaks() const { return breaks_; }
  /// Passes a change with the variations W, starts x dofs.
  void pass(const Change& change, const Matrix& W);

  /// How many numbers of memories are free at an angle, as starts of their own, and how many follow at once.
  int free_at(double theta) const;
  int following_at(double theta) const;
  /// Begins there: the first free number has the start `first`, of so many.
  void begin(double theta, Eigen::Index starts, Eigen::Index first);
  /// The free numbers at the same angle, one or several periods later, in the rows of a map from `first` on.
  void end(double theta, Matrix& map, Eigen::Index first) const;

  /// Whether there are laws without memory, which may change fast anywhere.
  bool any_smooth() const { return !smooth_.empty(); }

  /// Bounds of what T and B add to the fastest motion, squared rate by T, and rate by B, in rad/rad.
  struct Rates {
    double stiffness = 0, damping = 0;
  };
  struct Piece {
    Rates largest;           // at the nodes
    Rates sizes;             // of the coefficients of s^j, all together
    double last = 0;         // of the last two Legendre polynomials of laws with a memory, squared rate
    double memory = 0;       // the rate of a memory, at the nodes
    double last_memory = 0;  // of its last two Legendre polynomials
  };
  /// On the piece of length h from an angle theta, rad.
  Piece interpolate(double theta, double h);
  /// What the last interpolate() leaves out of hysteretic laws next to the ends of its piece, where a sharp
  /// yield may lie beyond the nodes: squared rate.
  double left_out(double theta, double h) const;
  std::vector<Variable>& variables() { return variables_; }
  /// Whether slip is without memory on this piece; then the memory at its end, with W, W' and W'' there.
  bool any_relaxed() const;
  void relax(double theta, const Matrix& W, const Matrix& V, const Matrix& A);

 private:
  static constexpr int nodes = 8;
  using Values = Eigen::Matrix<double, nodes, 1>;
  using Square = Eigen::Matrix<double, nodes, nodes>;
  struct Smooth {
    const TimeElement* element;
    int index;
    std::size_t variable;
    bool moving;  // its force depends on velocities
    std::unique_ptr<elements::TimeLaw> in_time;
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

  struct Planar {
    int index;
    std::size_t variable;
    DiscCourse course;
    bool relaxed = false;  // on this piece
  };

  void set(Smooth& law, Piece& piece);
  void set(Hysteretic& law, double theta, double h, Piece& piece);
  void set(Planar& law, double theta, double h, Piece& piece);
  void replace(const Matrix& at_nodes, double scale, Matrix& by_powers);
  Values coefficients(const Values& at_nodes, double& last) const;

  const LegendreFit fit_;
  const Square by_values_, powers_;
  Values angle_, cos_, sin_;  // of the nodes, rad
  std::vector<Variable> variables_;
  std::vector<Matrix> directions_;  // of variables_
  std::vector<Smooth> smooth_;
  std::vector<Hysteretic> hystereses_;
  std::vector<Planar> planar_;
  std::vector<Change> changes_;
  std::vector<double> breaks_;
  double omega_ = 1;
  elements::Harmonics harmonics_;
  const std::vector<ElementCourse>* elements_ = nullptr;
  Vector q_, none_;
  Matrix legendre_;
};

}  // namespace arcslip::time
