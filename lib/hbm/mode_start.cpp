#include <arcslip/hbm/mode_start.hpp>

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace arcslip::hbm {
namespace {

constexpr int decades = 9;                // of the amplitude, down to where contacts stick
constexpr double close_frequency = 0.02;  // of omega and v to the linear mode, relative
constexpr double close_shape = 0.1;
constexpr double at_a_node = 1e-9;  // the response over the largest coordinate
constexpr double same_frequency = 1e-9;
// Of several modes, from their frequency, at which the equations are singular: ln(omega/omega_0).
constexpr double off_resonance = 1e-5;
constexpr double isolated = 1e-10;  // a motion of modes of one frequency: the least pivot of J

// The static displacement: the means of the motion without excitation.
std::optional<Vector> rest_of(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                              const control::Control& control) {
  Vector rest = Vector::Zero(problem->size());
  if (problem->harmonics().odd) return rest;
  const auto at = problem->hbm_evaluator();
  if (at->move_to(rest, p, continuation::Needs::residual) != continuation::Evaluated::ok) return {};
  if (at->residual().isZero(0)) return rest;
  const auto found = steady_state(problem, p, control).u;
  if (!found) return {};
  for (int i = 0; i < problem->blocks(); ++i)
    rest[i * problem->harmonics().size()] = (*found)[i * problem->harmonics().size()];
  return rest;
}

std::string text(double value) {
  std::ostringstream s;
  s.precision(8);
  s << value;
  return s.str();
}

// Why the mode j, counted from 0, is none to start from.
std::string no_oscillation(const std::vector<LinearMode>& modes, std::size_t j) {
  using Kind = LinearMode::Kind;
  if (modes.empty())
    return "the structure at rest has no modes: no mass, or neither mass nor spring, holds a part of it";
  if (j >= modes.size())
    return "mode " + std::to_string(j + 1) + " does not exist: the structure has " +
           std::to_string(modes.size()) + (modes.size() == 1 ? " mode" : " modes");
  if (modes[j].kind == Kind::oscillation) return {};
  const auto first = std::find_if(modes.begin(), modes.end(),
                                  [](const LinearMode& mode) { return mode.kind == Kind::oscillation; });
  std::string why =
      "mode " + std::to_string(j + 1) +
      (modes[j].kind == Kind::rigid_body ? " is a motion that no spring resists, of frequency 0"
                                         : " does not oscillate: the structure at rest is unstable");
  if (first != modes.end())
    why += "; the first mode that oscillates is mode " + std::to_string(first - modes.begin() + 1);
  return why;
}

// The fundamental of the periodic forces of a model, in y.
ComplexVector driving_forces(const model::Model& excited, const Eigen::MatrixXd& P, double omega) {
  Vector p = model::defaults(excited);
  p[model::frequency] = omega;
  ComplexVector f = ComplexVector::Zero(P.cols());
  for (const model::Excitation& each : excited.excitation)
    if (each.harmonic == 1) f += each.amplitude(p) * (P.transpose() * model::shape(excited, each, p));
  return f;
}

// The modes of the frequency of mode j, itself among them.
std::vector<const LinearMode*> together(const std::vector<LinearMode>& modes, std::size_t j) {
  std::vector<const LinearMode*> all;
  for (const LinearMode& each : modes)
    if (std::abs(each.omega - modes[j].omega) <= same_frequency * modes[j].omega) all.push_back(&each);
  return all;
}

// The combination of modes that the forces f drive; none: they drive none.
std::optional<ComplexVector> driven_shape(const std::vector<const LinearMode*>& modes,
                                          const ComplexVector& f) {
  ComplexVector shape = ComplexVector::Zero(f.size());
  double driven = 0, drive = 0;
  for (const LinearMode* each : modes) {
    const Complex along = each->shape.cast<Complex>().dot(f);
    shape += along / each->mass * each->shape;
    driven = std::max(driven, std::abs(along));
    drive = std::max(drive, each->shape.cwiseAbs().dot(f.cwiseAbs()));
  }
  if (!(driven > at_a_node * drive)) return {};
  return shape / shape.norm();
}

// Why modes of one frequency have no shape to start from.
std::string not_driven(int mode, std::size_t count) {
  return "mode " + std::to_string(mode) + " is one of " + std::to_string(count) +
         " with its frequency, so that none has a shape of its own, and the excitation of harmonic 1, whose "
         "motion would be taken, drives none of them; excite them, or tell the modes apart by a small change "
         "of a mass or a spring";
}

std::string not_single(int mode, double amplitude) {
  return "mode " + std::to_string(mode) +
         " shares its frequency with others, and the combination that the excitation drives is no single "
         "motion at " +
         text(amplitude) +
         " m: while all contacts stick, every combination is one, and without symmetry none need be; "
         "begin at an amplitude at which contacts slip, or tell the modes apart by a small change of a mass "
         "or a spring";
}

// Why a mode of this shape is none to start from; unknowns: coordinates that elements move.
std::string no_shape(int mode, const LinearMode& linear, const ComplexVector& shape, Complex in_response,
                     Eigen::Index unknowns) {
  const double least = at_a_node * shape.cwiseAbs().maxCoeff();
  if (std::abs(in_response) <= least)
    return "mode " + std::to_string(mode) +
           " does not move the response, which is at one of its nodes; choose another response";
  if (shape.head(unknowns).cwiseAbs().maxCoeff() <= least)
    return "mode " + std::to_string(mode) + " moves no element: it is linear, of " + text(linear.omega) +
           " rad/s and the damping ratio " + text(linear.damping_ratio + 0.0) + " at every amplitude";
  return {};
}

// Sets the shape per unit of the response, and whether no other mode has its frequency. Returns why there is
// none.
std::string set_shape(const HbmProblem& motions, const model::Model& excited,
                      const std::vector<LinearMode>& modes, int mode, ComplexVector& shape, bool& alone) {
  const auto j = static_cast<std::size_t>(mode - 1);
  if (std::string why = no_oscillation(modes, j); !why.empty()) return why;
  const Eigen::MatrixXd& P = motions.coordinates().P;
  const auto same = together(modes, j);
  alone = same.size() == 1;
  shape = modes[j].shape.cast<Complex>();
  if (!alone) {
    const auto driven = driven_shape(same, driving_forces(excited, P, modes[j].omega));
    if (!driven) return not_driven(mode, same.size());
    shape = *driven;
  }
  const Vector response = P.transpose() * motions.model().response;
  const Complex in_response = response.cast<Complex>().dot(shape);
  std::string why = no_shape(mode, modes[j], shape, in_response, motions.coordinates().unknowns);
  if (why.empty()) shape /= in_response;
  return why;
}

// That of mode j; without one yet, as where the mean of a contact holds the structure, that of a neighbour.
double frequency_about(const std::vector<LinearMode>& modes, std::size_t j) {
  if (modes[j].omega != 0) return modes[j].omega;
  const auto other =
      std::find_if(modes.begin(), modes.end(), [](const auto& each) { return each.omega != 0; });
  return other == modes.end() ? 0 : other->omega;
}

// Whether the motion at a solution of the mode's equations has no neighbours of the same amplitude.
bool is_isolated(const ModeProblem& problem, const Vector& v) {
  const auto at = problem.evaluator();
  if (at->move_to(v.head(v.size() - 1), v.tail(1), continuation::Needs::jacobian) !=
      continuation::Evaluated::ok)
    return false;
  const auto& J = std::get<Eigen::MatrixXd>(at->jacobian());
  return continuation::orthogonal_complement(J, isolated).cols() == 0;
}

// Newton's method from a linear mode, at the amplitude or as far below as the mode is linear. shape: per unit
// of the response.
bool find_motion(const ComplexVector& shape, double omega, double damping_ratio, double amplitude, bool alone,
                 const control::Control& control, ModeStart& start) {
  const HbmProblem& motions = start.problem->motions();
  const int n = motions.size();
  const Vector per_response = unknowns_of(motions, shape);
  const double ratio = per_response.norm();
  Vector guess(n + 4);
  guess << per_response / ratio, std::log(omega / start.problem->omega_0()) + (alone ? 0 : off_resonance),
      damping_ratio, std::log(ratio), 0;
  continuation::NewtonOptions newton;
  newton.iterations = 30;
  bool found = false;
  for (int k = 0; k <= decades && control.keep_going(); ++k) {
    const double at_amplitude = std::pow(10, -k) * amplitude;
    guess[n + 3] = std::log(at_amplitude);
    continuation::Counts counts;
    continuation::Corrector corrector(*start.problem, guess.tail(1), 0, newton, counts);
    Vector v = guess;
    if (!corrector.correct(v, Vector::Unit(n + 4, n + 3), false).converged) continue;
    if (!alone && ((v - guess).head(n).norm() > close_shape || !is_isolated(*start.problem, v))) continue;
    found = true;
    start.u = v.head(n + 3);
    start.amplitude = at_amplitude;
    if (std::abs(v[n] - guess[n]) <= close_frequency && (v - guess).head(n).norm() <= close_shape) break;
  }
  return found;
}

}  // namespace

ModeStart mode_start(const std::shared_ptr<const model::Model>& model, const model::Model& excited, int mode,
                     double amplitude, const control::Control& control) {
  const auto j = static_cast<std::size_t>(mode - 1);
  ModeStart start;
  start.amplitude = amplitude;
  const HbmProblem plain(model, model->harmonics, amplitude, 1, 0.0);
  std::vector<LinearMode> modes = linear_modes(plain, parameters_at(plain, 1), nullptr, 1);
  if (start.no_mode = no_oscillation(modes, j); modes.size() <= j) return start;
  double omega = frequency_about(modes, j);
  if (omega == 0) return start;

  const auto motions = std::make_shared<const HbmProblem>(model, model->harmonics, amplitude, omega, omega);
  Vector p = parameters_at(*motions, omega);
  const auto rest = rest_of(motions, p, control);
  if (!rest) {
    start.failure = "no static displacement was found under the loads that do not change";
    return start;
  }
  const Vector response = motions->coordinates().P.transpose() * motions->model().response;
  const auto at = motions->hbm_evaluator();
  modes = linear_modes(*motions, p, nullptr, omega);
  ComplexVector shape;  // per unit of the response
  bool alone = true;    // no other mode has its frequency
  for (int pass = 0;; ++pass) {
    start.no_mode = set_shape(*motions, excited, modes, mode, shape, alone);
    if (!start.no_mode.empty()) return start;
    omega = p[model::frequency] = modes[j].omega;
    if (pass == 2) break;
    const double tiny = std::pow(10, -decades) * amplitude;
    if (at->move_to(*rest + tiny * unknowns_of(*motions, shape), p, continuation::Needs::jacobian) !=
        continuation::Evaluated::ok) {
      start.failure = "the equations could not be evaluated next to rest";
      return start;
    }
    modes = linear_modes(*motions, p, at.get(), omega);
  }
  const LinearMode& linear = modes[j];

  start.problem = std::make_shared<const ModeProblem>(motions, *rest, omega);
  if (find_motion(shape, omega, linear.damping_ratio, amplitude, alone, control, start)) return start;
  if (alone) {  // where damping changes the mode
    if (const auto damped = damped_mode(*motions, p, *at, linear, control)) {
      const Complex moved = response.cast<Complex>().dot(damped->shape);
      if (std::abs(moved) > at_a_node * damped->shape.cwiseAbs().maxCoeff() &&
          find_motion(damped->shape / moved, damped->omega, damped->damping_ratio, amplitude, alone, control,
                      start))
        return start;
    }
  }
  if (alone)
    start.failure = "Newton's method failed from the linear mode of " + text(omega) +
                    " rad/s, at amplitudes from " + text(amplitude) + " m down to " +
                    text(std::pow(10, -decades) * amplitude) + " m";
  else
    start.no_mode = not_single(mode, amplitude);
  return start;
}

}  // namespace arcslip::hbm
