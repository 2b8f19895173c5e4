#include <arcslip/analyses/modes_and_time/time_study.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/analyses/modes_and_time/perturbed_transient.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/patch_totals.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/period_integrator.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr double largest_defect = 0.01;  // of the energies of a motion in steps

using time::EquationOfMotion;
using time::MotionState;
using time::PeriodMotion;

constexpr int longest_period = 8;  // of a motion that a transient comes to
constexpr int expected_maps = 20;  // of shooting, for progress

class InTime {
 public:
  InTime(const scene::Scene& scene, const TimeSettings& settings, const control::Control& control)
      : settings_(settings),
        model_(std::make_shared<const model::Model>(model::build(scene))),
        control_(control) {
    motion_.parameters = described(*model_).parameters;
    motion_.method = settings_.method;
    motion_.omega = settings_.frequency * scene::to_rad_per_s(scene.frequency_unit);
    motion_.steps = settings_.steps;
    p_.resize(static_cast<Eigen::Index>(model_->parameters.size()));
    for (std::size_t k = 0; k < model_->parameters.size(); ++k)
      p_[static_cast<Eigen::Index>(k)] = model_->parameters[k].value;
    p_[model::frequency] = motion_.omega;
    try {
      time::check_response(*model_);
      equation_ = time::equation_of_motion(*model_, p_);
    } catch (const time::NotInTime& error) {
      end(Status::failed, error.reason(), 0, 0, error.what());
    }
    if (motion_.stop.reason.code.empty()) start_ = time::at_rest(equation_);
    progress_.frequency = settings_.frequency;
    progress_.item = "motion";
    progress_.counted = "periods";
  }

  Motion run() {
    const auto began = std::chrono::steady_clock::now();
    if (motion_.stop.reason.code.empty()) integrate();
    motion_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return std::move(motion_);
  }

 private:
  void integrate() {
    if (settings_.start_amplitude > 0 && !begin_at_response()) return;
    Integrator integrator;
    if (!choose(integrator)) return;
    motion_.integrator = integrator.name;
    if (!integrator.failure.code.empty())
      end(Status::failed, integrator.failure, 0, 0, integrator.message);
    else if (settings_.method == TimeMethod::shooting || settings_.method == TimeMethod::newmark_shooting)
      shoot(integrator);
    else if (response_)
      depart(integrator);
    else
      march(integrator);
  }

  bool begin_at_response() {
    ResponseOfAmplitude found =
        response_of_amplitude(model_, motion_.omega, settings_.start_amplitude, control_);
    if (!control_.keep_going()) {
      end(Status::stopped, reasons::user, 0, 0, "stopped by the caller");
    } else if (!found.point) {
      end(Status::failed, reasons::start_failed, 0, 0,
          "no response was found to start from: " + found.failure);
    } else {
      start_ = time::state_of(*found.problem, found.u, hbm::parameters_at(*found.problem, motion_.omega));
      response_ = std::move(found.point);
    }
    return response_.has_value() && control_.keep_going();
  }

  bool choose(Integrator& integrator) {
    const bool may_differ = settings_.method == TimeMethod::shooting;
    results::Reason reason;
    std::string message;
    if (may_differ || settings_.method == TimeMethod::event_driven) {
      try {
        time::EventLimits limits;
        if (may_differ) limits = {affordable_events, affordable_pieces};
        limits.control = control_;
        integrator = between_events(equation_, start_, settings_.steps, limits);
        return true;
      } catch (const time::NotPiecewiseLinear& error) {
        reason = reasons::not_piecewise_linear;
        message = error.what();
      } catch (const time::SingularMass& error) {
        reason = reasons::massless;
        message = error.what();
      }
      if (!may_differ) {
        end(Status::failed, reason, 0, 0, message + "; use the method newmark");
        return false;
      }
    }
    integrator = newmark();
    return true;
  }

  Integrator newmark() { return in_steps(equation_, start_, settings_.steps, control_); }

  // False where the user stops.
  bool report(long periods, double change = 1) {
    progress_.points = periods;
    const bool shooting =
        settings_.method == TimeMethod::shooting || settings_.method == TimeMethod::newmark_shooting;
    const double of_limit = static_cast<double>(periods) / (shooting ? expected_maps : settings_.periods);
    const double of_decay = !shooting && settings_.tolerance > 0 && settings_.tolerance < 1 && change > 0
                                ? std::log(change) / std::log(settings_.tolerance)
                                : 0;
    progress_.share_done = std::clamp(std::max(of_limit, of_decay), 0.0, 1.0);
    control_.report(progress_);
    return control_.keep_going();
  }

  void shoot(const Integrator& integrator) {
    if (const auto growth = unbounded_resonance(model_, motion_.omega); growth.unbounded) {
      record(integrator.periods(integrator.start, settings_.recorded, true));
      return end(Status::failed, reasons::unbounded, 0, 0, growth.message);
    }
    const time::Flow flow = [&](const MotionState& start) {
      if (report(progress_.points + 1)) return integrator.flow(start);
      time::PeriodMap none;
      none.message = "stopped by the caller";
      return none;
    };
    time::ShootingOptions options;
    options.tolerance = settings_.tolerance;
    if (response_) options.transients = 0;
    time::ShootingResult found = time::shoot(flow, integrator.start, equation_.omega, options);
    const bool may_differ = settings_.method == TimeMethod::shooting && integrator.between_events;
    if (found.reason == time::ShootingEnd::flow_failed && may_differ && control_.keep_going()) {
      motion_.integrator = "newmark";
      return shoot(newmark());
    }
    if (!found.converged() && control_.keep_going()) {
      if (const auto start = from_harmonic_balance()) {
        options.transients = 0;
        time::ShootingResult again = time::shoot(flow, *start, equation_.omega, options);
        if (again.converged()) found = std::move(again);
      }
    }
    motion_.periods = progress_.points + settings_.recorded;
    motion_.change = found.correction;
    if (!control_.keep_going()) return end(Status::stopped, reasons::user, 0, 0, "stopped by the caller");
    record(integrator.periods(found.start, settings_.recorded, true));
    if (!control_.keep_going()) return end(Status::stopped, reasons::user, 0, 0, "stopped by the caller");
    if (!found.converged())
      return end(Status::failed, reasons::no_periodic_motion, found.correction, settings_.tolerance,
                 found.message);
    motion_.multipliers = found.multipliers;
    motion_.stable = found.stable;
    end_balanced(reasons::periodic, found.correction, found.message);
  }

  // A motion in steps that are too long may be periodic, and no motion of the structure.
  void end_balanced(const results::Reason& reason, double value, const std::string& message) {
    const time::EnergyBalance& energy = motion_.energy;
    const double dissipated = energy.friction + energy.viscous;
    const double most = largest_defect * std::max(std::abs(energy.input), std::abs(dissipated));
    if (!(std::abs(energy.defect()) > most))
      return end(Status::complete, reason, value, settings_.tolerance, message);
    std::ostringstream text;
    text.precision(4);
    text << "the energies of the periodic motion found do not balance: input " << energy.input
         << " J, dissipated " << dissipated << " J per period; use more steps per period";
    end(Status::stopped, reasons::energy_defect, energy.defect(), most, text.str());
  }

  std::optional<MotionState> from_harmonic_balance() {
    const FirstResponse first = first_response(model_, motion_.omega, motion_.omega, control_);
    if (!first.u) return std::nullopt;
    const auto p = hbm::parameters_at(*first.problem, motion_.omega);
    MotionState state = time::state_of(*first.problem, *first.u, p);
    const bool finite = state.x.allFinite() && state.v.allFinite() && state.z.allFinite();
    return finite ? std::optional(std::move(state)) : std::nullopt;
  }

  void depart(const Integrator& integrator) {
    const time::SettleOptions options{settings_.periods, longest_period, settings_.tolerance};
    Departure found =
        departure(integrator, integrator.start, equation_.omega, settings_.perturbation, options,
                  [&](long periods, double change) { return report(periods, change); });
    const time::Settled& reached = found.end;
    const bool is_known = found.failure.empty();
    const int repeats = std::max(settings_.recorded, reached.period);
    motion_.periods = reached.periods + repeats;
    motion_.change = reached.change;
    record(integrator.periods(is_known ? reached.state : integrator.start, repeats, true));
    if (!control_.keep_going()) return end(Status::stopped, reasons::user, 0, 0, "stopped by the caller");
    if (!is_known) return end(Status::failed, reasons::no_periodic_motion, 0, 0, found.failure);
    MotionDeparture& reported = motion_.departure.emplace();
    reported.response_amplitude = response_->amplitude;
    if (const auto& stability = response_->stability) {
      reported.unstable = stability->unstable;
      if (!stability->multipliers.empty())
        reported.largest_multiplier = std::abs(stability->multipliers.front());
      reported.multiplier_error = stability->error;
    }
    reported.growth = found.growth;
    reported.distance = found.distance;
    reported.returned = found.returned;
    reported.motion_period = reached.period;
    if (reached.reason == time::SettleEnd::failed)
      return end(Status::failed, reached.failure, 0, 0, reached.message);
    std::ostringstream text;
    text.precision(6);
    if (reached.reason != time::SettleEnd::settled) {
      text << "not settled after " << reached.periods << " periods (the limit), at a distance of "
           << found.distance << " of its size from the motion where it started";
      return end(Status::stopped, reasons::period_limit, reached.change, settings_.tolerance, text.str());
    }
    motion_.multipliers = reached.multipliers;
    if (!reached.multipliers.empty()) motion_.stable = std::abs(reached.multipliers.front()) < 1;
    if (found.returned)
      text << "back on the motion where it started, within " << found.distance << " of its size";
    else
      text << "came to another motion, of period " << reached.period << " and amplitude " << motion_.amplitude
           << " m, from that of amplitude " << found.amplitude << " m";
    end_balanced(reasons::steady, reached.change, text.str());
  }

  void march(const Integrator& integrator) {
    const time::TransientOptions options{settings_.periods, settings_.recorded, settings_.tolerance};
    time::Transient found =
        time::transient(integrator.periods, integrator.start, equation_.omega, options,
                        [&](long periods, double change) { return report(periods, change); });
    motion_.periods = found.periods + settings_.recorded;
    motion_.change = found.change;
    const results::Reason failure = found.motion.failure;
    const std::string message = found.motion.message;
    record(std::move(found.motion));
    std::ostringstream text;
    text.precision(3);
    if (!control_.keep_going()) return end(Status::stopped, reasons::user, 0, 0, "stopped by the caller");
    switch (found.reason) {
      case time::TransientEnd::steady:
        text << "steady after " << found.periods << " periods: relative change of the state per period "
             << found.change;
        return end_balanced(reasons::steady, found.change, text.str());
      case time::TransientEnd::failed:
        return end(Status::failed, failure, 0, 0, message);
      case time::TransientEnd::period_limit:
      case time::TransientEnd::user:
        break;
    }
    if (settings_.tolerance == 0)
      return end(Status::complete, reasons::periods, settings_.periods, settings_.periods,
                 "integrated over the requested number of periods");
    text << "after " << settings_.periods << " periods (the limit) the state still changes by "
         << found.change
         << " of its size per period: allow more periods, or find the periodic motion by shooting, which "
            "says whether "
            "it is stable";
    end(Status::stopped, reasons::period_limit, found.change, settings_.tolerance, text.str());
  }

  void record(PeriodMotion&& motion) {
    const double share = motion.time > 0 ? equation_.period() / motion.time : 0;
    motion_.amplitude = motion.amplitude;
    motion_.energy = {motion.energy.input * share, motion.energy.friction * share,
                      motion.energy.viscous * share, motion.energy.stored * share};
    const double per_second = 1 / equation_.period();
    std::vector<ElementMotion> all(equation_.elements.size());
    std::size_t k = 0;
    for (std::size_t e = 0; e < all.size(); ++e) {
      const time::TimeElement& element = equation_.elements[e];
      if (!element.law->has_contact() || k == motion.friction.size()) continue;
      const time::FrictionShare& friction = motion.friction[k++];
      const double energy = friction.energy * share, wear = model_->elements[e].wear_coefficient;
      all[e] = {element.name,
                100 * friction.stick_share,
                energy,
                element.law->has_normal_load(),
                100 * friction.open_share,
                friction.load_max,
                friction.load_min,
                wear > 0 ? wear * energy * per_second : no_value};
      motion_.elements.push_back(all[e]);
    }
    for (const model::Patch& patch : model_->patches)
      motion_.patches.push_back(
          total<ElementMotion>(patch, std::span(all).subspan(patch.first, patch.areas.size())));
    add_total_loads(motion.history);
    motion_.history = std::move(motion.history);
  }

  // Of the patches, at the instants of the history.
  void add_total_loads(const time::TimeHistory& history) {
    for (std::size_t k = 0; k < motion_.patches.size() && !history.time.empty(); ++k) {
      const model::Patch& patch = model_->patches[k];
      ElementMotion& sum = motion_.patches[k];
      if (!sum.has_normal_load) continue;
      const std::vector<double> load = total_load(history, patch.first, patch.areas.size());
      sum.normal_load_min = *std::min_element(load.begin(), load.end());
      sum.normal_load_max = *std::max_element(load.begin(), load.end());
    }
  }

  void end(Status status, const results::Reason& reason, double value, double limit,
           const std::string& message) {
    motion_.status = status;
    motion_.stop = {reason, value, limit, message};
  }

  TimeSettings settings_;
  std::shared_ptr<const model::Model> model_;
  const control::Control control_;
  control::Progress progress_;
  continuation::Vector p_;
  EquationOfMotion equation_;
  MotionState start_;                      // at rest, or of the response
  std::optional<ResponsePoint> response_;  // from which it starts
  Motion motion_;
};

}  // namespace

std::string_view name(TimeMethod method) {
  switch (method) {
    case TimeMethod::shooting:
      return "shooting";
    case TimeMethod::newmark_shooting:
      return "newmark-shooting";
    case TimeMethod::newmark:
      return "newmark";
    case TimeMethod::event_driven:
      break;
  }
  return "event-driven";
}

Motion motion_in_time(const scene::Scene& scene, const TimeSettings& settings,
                      const control::Control& control) {
  return InTime(scene, settings, control).run();
}

}  // namespace arcslip::observables
