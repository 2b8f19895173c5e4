#include "lib/analyses/branches/returned_points.hpp"

#include "lib/analyses/branches/extended_precision.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <sstream>
#include <utility>
#include <variant>

namespace returned_points {

using namespace arcslip;
using continuation::Matrix;
using continuation::Vector;
using observables::ResponseBranch;
using observables::ResponsePoint;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double roundings = 64;           // of a sum, per term, of which there are up to some hundred
constexpr double corrector = 1e-9;         // continuation::NewtonOptions::tolerance
constexpr double few_digits = 1e-6;        // a distance from the branch beyond which a point needs a flag
constexpr double smallest_row = 1e-30;     // of terms, over the Jacobian: where all terms are nearly 0
constexpr double smallest_force = 1e-290;  // N, and of energies J: below, doubles lose digits
constexpr double unit_invariance = 1e-12;  // relative, times the condition
constexpr double largest_value = 1e-12;    // of an amplitude over its series: reversals are found to 1e-6

std::vector<ResponseBranch> traced(const scene::Scene& s, bool* cut, double* seconds) {
  long steps = 0;
  const std::clock_t began = std::clock();
  const auto taken = [&] { return static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC; };
  const auto of_work = controls::polled([&] {
    *cut = *cut || ++steps > most_steps || taken() > most_seconds;
    return !*cut;
  });
  const auto of_points = [&](const control::Progress& now) {
    *cut = *cut || now.points > most_points;
    return !*cut;
  };
  auto branches =
      observables::frequency_response(s, scenes::window(s), controls::reporting(of_points, of_work));
  *seconds = taken();
  return branches;
}

class Check {
 public:
  Check(const std::string& name, const scene::Scene& s, Tally& tally, const Some& points = {})
      : name_(name),
        tally_(tally),
        points_(points),
        held_(std::all_of(s.springs.begin(), s.springs.end(),
                          [](const scene::Part& spring) { return spring.values[0] > 0; })),
        range_(scenes::window(s)),
        unit_(scene::to_rad_per_s(s.frequency_unit)),
        model_(std::make_shared<const model::Model>(model::build(s))),
        problem_(model_, model_->harmonics, 1, width(), range_.from * unit_),
        evaluator_(problem_.hbm_evaluator()),
        equations_(s, problem_) {}

  void branch(const ResponseBranch& each) {
    ++tally_.branches;
    const std::string reason(each.stop.reason.code);
    ++tally_.reasons[reason];
    tally_.first_messages.emplace(reason, name_ + ": " + each.stop.message);
    if (each.stop.message.empty()) fault("no message for its end");
    const auto known = observables::reasons::of_branches;
    if (std::find(known.begin(), known.end(), each.stop.reason) == known.end())
      fault("the unknown reason " + reason);
    if (each.stop.reason == observables::reasons::start_failed) no_first_response(each.stop.message);
    for (std::size_t i = points_.first; i < each.points.size(); i += points_.every)
      point(each, each.points[i]);
    for (const auto& event : each.events)
      if (!event.point.unbounded && event.located) point(each, event.point);
  }

  void fault(const std::string& what) { tally_.faults.push_back(name_ + ": " + what); }

  /// How much the unknowns change, over |u|, where each term of the equations changes by its own size.
  double condition(const ResponsePoint& at) {
    const Vector u =
        Eigen::Map<const Vector>(at.unknowns.data(), static_cast<Eigen::Index>(at.unknowns.size()));
    evaluator_->move_to(u, hbm::parameters_at(problem_, at.omega), continuation::Needs::jacobian);
    const Matrix A = system(u, equations_.at(u, at.omega)).first.leftCols(u.size());
    const Vector values = continuation::singular_values(A).values;
    return std::sqrt(static_cast<double>(u.size())) / values[u.size() - 1];
  }

 private:
  // (A, R) at the place of the evaluator: A = dR/d(u, frequency) in units of |u| and of the window, and in
  // each row of its terms.
  std::pair<Matrix, Vector> system(const Vector& u, const extended::Evaluation& exact) const {
    const Eigen::Index n = u.size();
    Vector by_frequency(n), r(n);
    evaluator_->parameter_derivative(model::frequency, by_frequency);
    Matrix A(n, n + 1);
    A << u.stableNorm() * std::get<Matrix>(evaluator_->jacobian()), width() * by_frequency;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double row = std::max(exact.rounding[i], smallest_row * A.row(i).stableNorm());
      A.row(i) /= row;
      r[i] = exact.residual[i] / row;
    }
    return {A, r};
  }

  // That there is none is known where nothing holds a mean position, and may be where a spring pushes or only
  // a contact holds: a force beyond it, or the mean of a large motion, has no equilibrium there.
  void no_first_response(const std::string& message) {
    const bool drifts = message.find("no spring holds the mean position") != std::string::npos;
    const bool beyond_digits = message.find("too large a ratio") != std::string::npos;
    ++(drifts ? tally_.drifting : held_ ? tally_.held : tally_.pushed);
    if (held_ && !drifts && !beyond_digits) fault("no first response of springs that hold");
  }

  double width() const { return (range_.to - range_.from) * unit_; }

  void point(const ResponseBranch& branch, const ResponsePoint& at) {
    ++tally_.points;
    tally_.flagged += at.truncation_flagged;
    std::ostringstream place;
    place.precision(17);
    place << " at " << at.omega << " rad/s";
    const auto wrong = [&](const char* what, double ratio) {
      std::ostringstream text;
      text << what << place.str() << ", " << ratio << " times what is allowed";
      fault(text.str());
    };
    const bool finite = std::isfinite(at.amplitude) && std::isfinite(at.energy_friction) &&
                        std::isfinite(at.energy_viscous) && std::isfinite(at.energy_input) &&
                        std::all_of(at.unknowns.begin(), at.unknowns.end(),
                                    [](double value) { return std::isfinite(value); });
    if (!finite) return fault("not finite" + place.str());
    if (!std::isfinite(at.truncation_estimate) && !at.truncation_flagged)
      fault("an estimate that is not finite, without a flag" + place.str());
    if (!(at.omega >= range_.from * unit_ * (1 - epsilon) && at.omega <= range_.to * unit_ * (1 + epsilon)))
      fault("outside of the window" + place.str());
    const Vector u =
        Eigen::Map<const Vector>(at.unknowns.data(), static_cast<Eigen::Index>(at.unknowns.size()));
    const extended::Evaluation exact = equations_.at(u, at.omega);
    const auto judge = [&](const char* what, double ratio, double& worst) {
      if (!(ratio <= 1)) wrong(what, ratio);
      worst = std::max(worst, ratio);
    };
    const auto over = [](extended::Real error, extended::Real allowed) {
      return error == 0 ? 0.0 : static_cast<double>(std::abs(error) / allowed);
    };
    judge("another amplitude", over(at.amplitude - exact.amplitude, largest_value * exact.amplitude_rounding),
          tally_.worst.amplitude);
    const extended::Real energy = smallest_force + roundings * epsilon * exact.energy_rounding;
    judge("another energy",
          std::max({over(at.energy_friction - exact.friction, energy),
                    over(at.energy_viscous - exact.viscous, energy),
                    over(at.energy_input - exact.input, energy)}),
          tally_.worst.energy);
    for (const extended::State each : exact.states) ++tally_.states[extended::name(each)];
    if (residual(branch, at, u, exact, judge)) linear(at, exact, judge);
  }

  // Whether the mean force has its digits.
  template <class Judge>
  bool residual(const ResponseBranch& branch, const ResponsePoint& at, const Vector& u,
                const extended::Evaluation& exact, const Judge& judge) {
    const Vector p = hbm::parameters_at(problem_, at.omega);
    if (evaluator_->move_to(u, p, continuation::Needs::jacobian) != continuation::Evaluated::ok)
      return fault("a point that cannot be evaluated"), true;
    const Vector& R = evaluator_->residual();
    double worst = 0, with_preload = 0;
    for (Eigen::Index i = 0; i < R.size(); ++i) {
      const double error = std::abs(R[i] - exact.residual[i]),
                   allowed = roundings * epsilon * exact.rounding[i];
      if (error < smallest_force) continue;
      worst = std::max(worst, error / allowed);
      with_preload = std::max(with_preload, error / (allowed + roundings * epsilon * exact.preload[i]));
    }
    if (worst > 1 && with_preload <= 1) {
      ++tally_.preloaded;
      return false;
    }
    judge("another residual", worst, tally_.worst.residual);
    if (u.norm() == 0) {
      if (exact.residual.norm() > 0) fault("rest, but not in equilibrium");
      return true;
    }
    // The nearest point of the branch: v of least norm with A v = R.
    const auto [A, r] = system(u, exact);
    if (!A.allFinite() || !r.allFinite()) return fault("a distance that overflows"), true;
    const double distance = continuation::shortest_least_squares(A, r).X.norm();
    if (distance <= corrector) {
      judge("off the branch", distance / corrector, tally_.worst.distance);
      return true;
    }
    ++tally_.rounded;
    const double smallest = continuation::singular_values(A).values[R.size() - 1];
    const double rounding = roundings * epsilon * std::sqrt(static_cast<double>(R.size())) / smallest;
    if (branch.status == observables::Status::failed || !branch.doubt.empty()) return true;  // it says so
    judge("off the branch", distance / (corrector + rounding), tally_.worst.distance);
    if (distance > few_digits && !at.truncation_flagged) {
      std::ostringstream text;
      text.precision(17);
      text << "few digits without a flag at " << at.omega << " rad/s, distance " << distance;
      fault(text.str());
    }
    return true;
  }

  template <class Judge>
  void linear(const ResponsePoint& at, const extended::Evaluation& exact, const Judge& judge) {
    const auto& states = exact.states;
    if (std::count(states.begin(), states.end(), extended::State::several) > 0) return;
    ++tally_.linear;
    const extended::Linear closed_form = equations_.linear(exact, at.omega);
    const double allowed = static_cast<double>((corrector + largest_value) * closed_form.amplitude +
                                               roundings * epsilon * closed_form.rounding);
    const double error = std::abs(static_cast<double>(at.amplitude - closed_form.amplitude));
    if (error > allowed &&
        error <= allowed + roundings * epsilon * static_cast<double>(closed_form.preload)) {
      ++tally_.preloaded;
      return;
    }
    judge("another amplitude than the closed form", error == 0 ? 0 : error / allowed, tally_.worst.linear);
  }

  std::string name_;
  Tally& tally_;
  Some points_;
  bool held_;  // by springs that all hold
  observables::FrequencyRange range_;
  double unit_;
  std::shared_ptr<const model::Model> model_;
  hbm::HbmProblem problem_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  extended::Equations equations_;
};

}  // namespace

void check(const std::string& name, const scene::Scene& s, Tally& tally, const Some& points) {
  ++tally.scenes;
  bool cut = false;
  double seconds = 0;
  try {
    const auto branches = traced(s, &cut, &seconds);
    tally.seconds += seconds;
    Check check(name, s, tally, points);
    for (const auto& branch : branches) check.branch(branch);
    if (branches.empty()) check.fault("no branch");
    if (seconds > 2 * most_seconds) check.fault("not to be stopped for " + std::to_string(seconds) + " s");
  } catch (const std::exception& error) {
    tally.faults.push_back(name + ": throws " + error.what());
  }
}

std::string differ_in_bits(const scene::Scene& one, const scene::Scene& other, double length, double time) {
  bool cut_one = false, cut_other = false;  // at the same point
  double seconds = 0;
  const auto a = traced(one, &cut_one, &seconds), b = traced(other, &cut_other, &seconds);
  std::ostringstream text;
  text.precision(17);
  const auto same = [&](const char* what, std::size_t i, double x, double y) {
    if (x == y || (std::isnan(x) && std::isnan(y))) return true;
    if (text.str().empty()) text << what << " " << i << ": " << x << " and " << y;
    return false;
  };
  if (a.size() != b.size()) return "another number of branches";
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].stop.reason != b[k].stop.reason)
      return "ends with " + std::string(a[k].stop.reason.code) + " and " + std::string(b[k].stop.reason.code);
    if (a[k].points.size() != b[k].points.size()) text << "another number of points; ";
    if (a[k].events.size() != b[k].events.size()) return "another number of events";
    const auto compare = [&](const char* what, std::size_t i, const ResponsePoint& x,
                             const ResponsePoint& y) {
      return same(what, i, x.omega, y.omega * time) && same(what, i, x.amplitude, y.amplitude / length) &&
             same(what, i, x.truncation_estimate, y.truncation_estimate / length);
    };
    for (std::size_t i = 0; i < std::min(a[k].points.size(), b[k].points.size()); ++i)
      if (!compare("point", i, a[k].points[i], b[k].points[i])) return text.str();
    for (std::size_t i = 0; i < a[k].events.size(); ++i)
      if (!compare("event", i, a[k].events[i].point, b[k].events[i].point)) return text.str();
  }
  return text.str();
}

double change_of_first(const scene::Scene& one, const scene::Scene& other, double length) {
  const auto first = [](const scene::Scene& s) {
    return observables::frequency_response(
        s, scenes::window(s),
        controls::reporting([](const control::Progress& now) { return now.points < 1; }));
  };
  const auto a = first(one), b = first(other);
  if (a.front().points.empty() != b.front().points.empty()) return std::numeric_limits<double>::infinity();
  if (a.front().points.empty() || a.front().points[0].amplitude == 0) return 0;
  Tally tally;
  const ResponsePoint &x = a.front().points[0], &y = b.front().points[0];
  const double change = std::abs(y.amplitude / length / x.amplitude - 1);
  const double size =
      Eigen::Map<const Vector>(x.unknowns.data(), static_cast<Eigen::Index>(x.unknowns.size())).norm();
  return change / (unit_invariance * std::max(1.0, Check("", one, tally).condition(x) * size / x.amplitude));
}

}  // namespace returned_points
