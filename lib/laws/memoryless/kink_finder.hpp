#pragma once
// Where formulas along a motion change between smooth pieces. Private.

#include <arcslip/formula/evaluator.hpp>
#include <arcslip/fourier/samples.hpp>
#include <arcslip/laws/memoryless/formula_law.hpp>

#include <vector>

namespace arcslip::elements {

/// One switch (formula::switches()) is 0 at theta.
struct Kink {
  double theta;  // rad, in one span of the harmonics
  std::size_t of;
};

/// Finds them by their signs at equal intervals, 16 for each harmonic: two within one of these are not seen,
/// between which the motion passes a kink by little.
class KinkFinder {
 public:
  KinkFinder(const FormulaLaw& law, const Harmonics& harmonics);

  /// In the order of theta. The reference holds until the next call; allocates nothing but where there are
  /// more kinks than ever before.
  const std::vector<Kink>& find(In u, double base_frequency, Fields fields);
  const std::vector<Kink>& kinks() const { return kinks_; }

  /// How the angle of a kink of the last search moves: by the coefficients of all displacements, by the base
  /// frequency, or by a field.
  void rate(const Kink& kink, Out by_u);
  double rate_by_frequency(const Kink& kink);
  double rate_by_field(const Kink& kink, int field);

 private:
  void set_motion(double theta);
  double value(std::size_t of, double theta);
  double root(std::size_t of, double from, double to, double f_from, double f_to);
  // The derivatives of a switch by displacements, velocities, phase and fields at its kink; by theta.
  double differentiate(const Kink& kink);

  const FormulaLaw& law_;
  Harmonics harmonics_;
  int directions_;
  Samples samples_;
  formula::Evaluator evaluator_;
  std::vector<formula::InputValues> inputs_, one_;
  std::vector<double*> grid_to_, one_to_;
  std::vector<formula::Derivative> derivatives_;
  Eigen::MatrixXd q_, v_, grid_;  // samples x displacements, switches
  Eigen::VectorXd phase_, slope_, u_, phi_;
  std::vector<double> motion_, by_input_, fields_;
  std::vector<Values> values_;
  double base_frequency_ = 0, one_value_ = 0;
  std::vector<Kink> kinks_;
};

}  // namespace arcslip::elements
