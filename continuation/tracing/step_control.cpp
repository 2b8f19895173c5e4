#include <arcslip/continuation/tracing/step_control.hpp>

#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr double growth = 2.0, shrinkage = 0.3;  // of the step, limits
constexpr double largest_extrapolation = 2.5;    // in last steps, for the cubic predictor
constexpr double unresolved_rejection = 0.5;     // of the step if the slopes do not determine a quantity
constexpr double curve_safety = 0.9;             // of the step allowed by the curve's error
constexpr double order_across_kinks = 1.5;       // of the curve's error
constexpr double least_order = 0.5;              // of the curve's error, as rejections show it
constexpr double least_share = 1e-2;             // of a rejected step, where its curve has a large error

// Factor of the step for a curve error of `error` times the tolerance: the error is of fourth order.
double curve_factor(double error) {
  return std::clamp(curve_safety / std::sqrt(std::sqrt(error)), shrinkage, growth);
}

// That by which the error has fallen since the rejection before. Where the branch turns at once just ahead it
// does not fall.
double observed_order(const TrialStep& trial) {
  if (!(trial.refused_error > 1 && trial.refused_length > trial.length)) return 4;
  const double order =
      std::log(trial.refused_error / trial.curve_error) / std::log(trial.refused_length / trial.length);
  return std::max(order, least_order);
}

}  // namespace

double StepControl::smallest() const {
  return options_.step.smallest * (1 + in_.norm_u(s_.here.v));
}

std::string StepControl::option_below_smallest() const {
  const double least = smallest(), longest = limited(least);
  if (!(longest < least)) return {};
  const double p = s_.here.v[s_.here.v.size() - 1];
  const double along = std::abs(s_.here.tangent[s_.here.tangent.size() - 1]);
  const double slack = 1 + 1e-9;
  const bool by_parameter = along * longest * slack >= largest_parameter_step();
  const bool relative = options_.step.relative_parameter * std::abs(p) <= options_.step.largest_parameter;
  const char* option = !by_parameter ? (options_.step.largest > 0 && longest * slack >= options_.step.largest
                                            ? "step.largest"
                                            : "step.relative_state")
                       : options_.step.relative_parameter > 0 && relative ? "step.relative_parameter"
                                                                          : "step.largest_parameter";
  std::string sentence = text("the step that `", option, "` allows at ", p, ", ", longest,
                              " in scaled arclength, is below the smallest one, ", least);
  if (by_parameter)
    sentence += text(": the parameter's scale, ", in_.parameter_scale(),
                     ", is far above its value; give it a smaller `scale`, or a narrower window");
  return sentence;
}

double StepControl::largest_parameter_step() const {
  const double p = s_.here.v[s_.here.v.size() - 1];
  const double relative = options_.step.relative_parameter * std::abs(p);
  const double limit = options_.step.largest_parameter;
  return relative > 0 ? std::min(limit, relative) : limit;  // at p = 0 there is no relative limit
}

double StepControl::limited(double ds) const {
  const double largest_change = options_.step.relative_state * (1 + in_.norm_u(s_.here.v));
  const double change = in_.norm_u(s_.here.tangent);  // |du/ds|
  if (change * ds > largest_change) ds = largest_change / change;
  if (options_.step.largest > 0) ds = std::min(ds, options_.step.largest);
  const double along = std::abs(s_.here.tangent[s_.here.tangent.size() - 1]);
  const double limit = largest_parameter_step();
  return along * ds > limit ? limit / along : ds;
}

void StepControl::predict(Vector& v) const {
  if (s_.has_before && s_.step <= largest_extrapolation * s_.last_step)
    hermite(s_.before.v, s_.before.tangent, s_.here.v, s_.here.tangent, s_.last_step,
            1 + s_.step / s_.last_step, v);
  else
    v = s_.here.v + s_.step * s_.here.tangent;
}

// Growth of the curve's error at equal step length, from the last step to this one: growth, as towards a
// resonance, is expected to continue (Gustafsson, ACM Trans. Math. Softw. 20, 1994).
double StepControl::error_growth(const TrialStep& trial) const {
  if (!(s_.curve_error > 0) || !trial.corners.empty()) return 1;
  const double length = (trial.end.arclength - s_.here.arclength) / s_.last_step;
  const double order = trial.worst_has_kinks ? order_across_kinks : 4;
  return std::max(1.0, trial.curve_error / (s_.curve_error * std::pow(length, order)));
}

double StepControl::after(const TrialStep& trial) const {
  double factor = trial.turn > 0 ? options_.step.angle / trial.turn : growth;
  const Correction& correction = trial.correction;
  const bool contraction_counts = correction.first > std::sqrt(options_.newton.tolerance);
  if (contraction_counts && correction.contraction > 0)
    factor = std::min(factor, std::sqrt(options_.step.contraction / correction.contraction));
  if (trial.chord_error > 0) factor = std::min(factor, curve_safety / std::sqrt(trial.chord_error));
  if (trial.curve_error > 0) factor = std::min(factor, curve_factor(trial.curve_error * error_growth(trial)));
  return s_.step * std::clamp(factor, shrinkage, growth);
}

// A step over kinks has a cubic on each section. The next one reaches as far into that of the largest error
// as this allows: a section that ends at a kink has the same error in all steps that reach the kink, and
// beyond a kink, as in a step that passes kinks, the branch may bend like the power 3/2 of the distance, as
// where contact begins.
double StepControl::share_after_unresolved(const TrialStep& trial) const {
  if (!(trial.curve_error > 1)) return unresolved_rejection;
  const double before = trial.worst_begin - s_.here.arclength, within = trial.worst_end - trial.worst_begin;
  const double order =
      std::min(before > 0 || trial.worst_has_kinks ? order_across_kinks : 4.0, observed_order(trial));
  const double factor =
      order < 4 ? curve_safety / std::pow(trial.curve_error, 1 / order) : curve_factor(trial.curve_error);
  return std::clamp((before + factor * within) / trial.length, least_share, curve_safety);
}

}  // namespace arcslip::continuation
