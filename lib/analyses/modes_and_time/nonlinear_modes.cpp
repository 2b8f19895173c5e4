#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/analyses/modes_and_time/one_mode_synthesis.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/mode_start.hpp>
#include <arcslip/observables/mechanical_energy.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Crossing;
using continuation::StopReason;
using continuation::Vector;

constexpr double alone = 3e-2;                // of a harmonic and its multiples: what the others have
constexpr double largest_ratio = 1e8;         // the motion over that of the response
constexpr const char* outgrown = "outgrown";  // the monitor of that
constexpr double within_ends = 1e-9;          // the ends of the range: of its logarithm, where a peak may be
constexpr const char* mark = "mark";          // the monitor of an amplitude that all orders have
constexpr int marks = 15;                     // between the ends of the range, in equal ratios

std::string metres(double amplitude) {
  return to_digits(amplitude, 8) + " m";
}

// An extremum of the damping ratio, unknown zeta: of 1 + zeta, next to which rounding counts for nothing.
continuation::Monitor extremum(const results::EventKind& kind, Crossing crossing, bool divides, int zeta) {
  continuation::Monitor monitor{kind, [zeta](const Accepted& now) { return now.tangent[zeta]; }, crossing,
                                [zeta](const Accepted& now) { return 1 + now.u[zeta]; }};
  monitor.divides_at_kinks = divides;
  return monitor;
}

continuation::Monitor amplitude_monitor(std::string name, double log_amplitude) {
  continuation::Monitor monitor;
  monitor.name = std::move(name);
  monitor.value = [=](const Accepted& now) { return now.parameter - log_amplitude; };
  return monitor;
}

class ModeStudy {
 public:
  ModeStudy(const scene::Scene& scene, const ModeRange& range, const control::Control& control)
      : unit_(scene.frequency_unit),
        range_(range),
        control_(control),
        model_(model_of(scene, control)),
        free_(std::make_shared<const model::Model>(hbm::without_excitation(*model_))) {
    if (range.mode < 1 || !(range.from > 0) || !(range.from < range.to))
      throw std::invalid_argument("a mode needs a number from 1 on and amplitudes 0 < from < to");
  }

  ResponseBranch run() {
    control_.report(reported_);
    const auto began = std::chrono::steady_clock::now();
    result_ = described(*model_);
    trace();
    result_.solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return std::move(result_);
  }

 private:
  void trace() {
    if (const std::string why = refusal(); !why.empty()) return fail(reasons::no_mode, why);
    const Vector p = model::defaults(*free_);
    if (const auto dof = model::drifting_dof(*free_, p))
      return fail(reasons::start_failed, "no spring holds the mean position of \"" +
                                             free_->dof_names[static_cast<std::size_t>(*dof)] +
                                             "\", which is free to drift");
    hbm::ModeStart start = hbm::mode_start(free_, *model_, range_.mode, range_.from, control_);
    if (!control_.keep_going()) return stop();
    if (!start.no_mode.empty()) return fail(reasons::no_mode, start.no_mode);
    if (!start.failure.empty()) return fail(reasons::start_failed, start.failure);
    const auto problem = start.problem;
    result_.solver.unknowns = problem->size();
    Vector u = start.u;
    if (start.amplitude < range_.from) {
      const auto ahead = branch(problem, u, start.amplitude, range_.from, {});
      add(ahead, result_.solver);
      if (!control_.keep_going()) return stop();
      if (ahead.stop.reason != StopReason::boundary || ahead.stop.value < std::log(range_.from))
        return fail(reasons::start_failed, "mode " + std::to_string(range_.mode) + " was not found at " +
                                               metres(range_.from) + ": followed from " +
                                               metres(start.amplitude) + ", " + ahead.stop.message);
      u = ahead.points.back().u;
    }
    observer_ = std::make_unique<Observer>(problem->shared_motions());
    energy_ = std::make_unique<MechanicalEnergy>(problem->shared_motions(), problem->rest(),
                                                 hbm::parameters_at(problem->motions(), problem->omega_0()));
    synthesis_ = std::make_unique<OneModeSynthesis>(problem->motions(), model_);
    const auto traced = branch(
        problem, u, range_.from, range_.to,
        [&](const Accepted& now, const continuation::Event* event) { return record(*problem, now, event); });
    add(traced, result_.solver);
    finish(traced);
    drop_rounding();
    add_ends();
  }

  // Why there is no mode to look for.
  std::string refusal() const {
    if (free_->sector)
      return "modes of one sector alone are not those of the ring; give \"cyclic\" the key \"full\": true";
    if (!model::is_symmetric(*free_))
      return "modes of gyroscopic, circulatory and other unsymmetric matrices are complex, and are not "
             "followed; a study of kind \"frf\" has their resonances";
    for (const auto& element : free_->elements)
      if (element.law->set_valued())
        return "the friction of \"" + element.name +
               "\" has no stiffness, and stops motions of small amplitudes; give the contact a stiffness";
    for (const auto& element : free_->elements)
      if (element.law->phase_dependent())
        return "the force of \"" + element.name +
               "\" depends on the phase of the excitation, and free vibration has none";
    if (!free_->others.empty())
      return "a mode is followed over the amplitude at one place, and the response is the largest of "
             "several; "
             "name one of them";
    if (!free_->harmonics.has(free_->harmonics.excited(1)))
      return "the fundamental is not among the harmonics: raise their order to their period at least";
    return {};
  }

  continuation::Branch branch(const std::shared_ptr<const hbm::ModeProblem>& problem, const Vector& u,
                              double from, double to, const continuation::Observer& record) {
    continuation::Options options;
    options.lower = std::log(from);
    options.upper = std::log(to);
    options.check_jacobian = false;
    options.step.largest_parameter = (options.upper - options.lower) / points_in_range;
    options.step.curve_tolerance = curve_tolerance;
    if (record) pass_kinks(*free_, {}, options);
    options.control = control_;
    const bool divides = free_->settings.friction == scene::Friction::exact;
    std::vector<continuation::Monitor> monitors;
    if (record) {
      const int zeta = problem->damping_ratio();
      monitors = {extremum(event_kinds::maximum, Crossing::falling, divides, zeta),
                  extremum(event_kinds::minimum, Crossing::rising, divides, zeta),
                  continuation::fold_monitor()};
      monitors.back().divides_at_kinks = false;
      const double width = options.upper - options.lower;
      for (int k = 0; k < range_.true_peaks; ++k) {
        const double share = range_.true_peaks > 1 ? static_cast<double>(k) / (range_.true_peaks - 1) : 0.5;
        monitors.push_back(amplitude_monitor(
            event_kinds::peak, options.lower + std::clamp(share, within_ends, 1 - within_ends) * width));
      }
      for (int k = 1; k <= marks; ++k)
        monitors.push_back(amplitude_monitor(mark, options.lower + width * k / (marks + 1)));
    }
    monitors.push_back(continuation::bound_monitor(outgrown, problem->log_ratio(), std::log(largest_ratio)));
    auto traced = continuation::trace(problem, {u, Vector::Constant(1, options.lower), 0, 1}, options,
                                      monitors, record);
    add_scene_hint(*model_, model::defaults(*model_), traced);
    return traced;
  }

  bool record(const hbm::ModeProblem& problem, const Accepted& now, const continuation::Event* event) {
    if (event && event->monitor == outgrown) return true;
    if (event && event->monitor == mark) {
      const auto& at = static_cast<const hbm::ModeEvaluator&>(now.at);
      ResponsePoint& point = result_.marks.emplace_back();
      point.amplitude = at.amplitude();
      point.omega = at.omega();
      point.damping_ratio = at.damping_ratio();
      return true;
    }
    ResponsePoint point = observe(problem, static_cast<const hbm::ModeEvaluator&>(now.at));
    if (event) {
      if (event->monitor == event_kinds::peak) {
        if (!(point.synthesis.level > 0)) return true;
        add_true_peak(static_cast<const hbm::ModeEvaluator&>(now.at), point);
      }
      at_.push_back(now.arclength);
      result_.events.push_back(event_of(*event, std::move(point)));
      return true;
    }
    course_.emplace_back(now.arclength, 1 + point.damping_ratio);
    reported_.points = static_cast<long>(result_.points.size()) + 1;
    reported_.step = (point.omega - last_) / scene::to_rad_per_s(unit_);
    last_ = point.omega;
    reported_.frequency = last_ / scene::to_rad_per_s(unit_);
    reported_.share_done =
        std::clamp(std::log(point.amplitude / range_.from) / std::log(range_.to / range_.from), 0.0, 1.0);
    result_.points.push_back(std::move(point));
    control_.report(reported_);
    return control_.keep_going();
  }

  ResponsePoint observe(const hbm::ModeProblem& problem, const hbm::ModeEvaluator& at) {
    ResponsePoint point = observer_->motion(at.motion(), at.unknowns(), at.parameters());
    point.amplitude = at.amplitude();
    point.damping_ratio = at.damping_ratio();
    point.energy = energy_->of(at.motion(), at.unknowns());
    // The work of 2 zeta omega M x' in a period, which the damping of the motion has as a loss.
    const auto& h = problem.motions().harmonics();
    const auto& Z = at.motion().stiffness();
    double work = 0;
    for (int j = 0; j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      work += n * n * Z.quadratic_forms(n, at.unknowns(), 0).mass;
    }
    point.energy_input = 2 * std::numbers::pi * at.damping_ratio() * at.omega() * Z.base_frequency() * work;
    point.energy_viscous += point.energy_input;
    const double ratio = at.damping_ratio();
    const double hysteretic =
        hysteretic_loss(problem, at, point) / (2 * std::numbers::pi * at.omega() * Z.base_frequency() * work);
    point.synthesis = synthesis_->of(at.motion(), at.unknowns(), at.omega(), ratio - hysteretic, hysteretic);
    return point;
  }

  // Of a period, by what does not depend on the frequency: J.
  double hysteretic_loss(const hbm::ModeProblem& problem, const hbm::ModeEvaluator& at,
                         const ResponsePoint& point) const {
    double loss = 0;
    for (std::size_t e = 0; e < point.elements.size(); ++e)
      if (!free_->elements[e].law->rate_dependent()) loss += point.elements[e].energy;
    const double factor = free_->damping->loss_factor_at(at.parameters());
    const auto& h = problem.motions().harmonics();
    for (int j = 0; factor > 0 && j < h.sines(); ++j) {
      const int n = h.sine_order(j);
      loss += std::numbers::pi * n * factor *
              at.motion().stiffness().quadratic_forms(n, at.unknowns(), 0).stiffness;
    }
    return loss;
  }

  void add_true_peak(const hbm::ModeEvaluator& at, ResponsePoint& point) {
    const auto peak =
        synthesis_->true_peak(at.motion(), at.unknowns(), at.damping_ratio(), point.synthesis, control_);
    if (!peak) return;
    point.synthesis.true_omega = peak->omega;
    point.synthesis.true_amplitude = peak->amplitude;
  }

  void stop() {
    result_.status = Status::stopped;
    result_.stop = {reasons::user, range_.from, range_.to, "stopped by the caller"};
  }

  void fail(const results::Reason& reason, const std::string& why) {
    result_.status = Status::failed;
    result_.stop = {reason, range_.from, 0, why};
  }

  void finish(const continuation::Branch& traced) {
    result_.status = status_of(traced.stop.reason);
    result_.stop = {reason_of(traced.stop.reason), traced.stop.value, traced.stop.limit, traced.stop.message};
    if (const int n = harmonic_left(); result_.status == Status::failed && n > 1)
      result_.stop.message += "; the motion came to be one of " + std::to_string(n) +
                              " times the frequency, of another mode, where its own fundamental vanishes";
    if (traced.stop.reason == StopReason::event) {
      result_.status = Status::failed;
      result_.stop.reason = reasons::state_too_large;
      result_.stop.message =
          "the motion of the structure grew more than 1e8 times over that of the response, near " +
          metres(result_.points.empty() ? range_.from : result_.points.back().amplitude) +
          "; choose another response";
    }
    if (traced.stop.reason != StopReason::boundary) return;
    const ResponsePoint& last = result_.points.back();
    result_.stop.value = last.amplitude;
    result_.stop.limit = range_.to;
    if (traced.stop.value == std::log(range_.to)) {
      result_.stop.message = "reached the end of the range at " + metres(range_.to) + ": " +
                             frequency_text(last.omega, unit_) + ", damping ratio " +
                             to_digits(last.damping_ratio, 6);
      return;
    }
    result_.status = Status::stopped;
    double highest = range_.from;
    for (const auto& event : result_.events) highest = std::max(highest, event.point.amplitude);
    result_.stop.message =
        "turned back at " + metres(highest) + " and left the range at its start, " + metres(range_.from);
  }

  // The harmonic, in fundamentals, of whose multiples nearly all of the response at the last point consists;
  // 0: none.
  int harmonic_left() const {
    if (result_.points.empty()) return 0;
    const std::vector<double>& c = result_.points.back().coefficients;
    const auto size = [&](std::size_t i) {
      return result_.harmonics[i] == 0 ? 0 : std::hypot(c[2 * i], c[2 * i + 1]);
    };
    std::size_t largest = 0;
    for (std::size_t i = 0; i < result_.harmonics.size(); ++i)
      if (size(i) > size(largest)) largest = i;
    const int period = free_->harmonics.excited(1), n = result_.harmonics[largest];
    if (n == 0 || n % period != 0) return 0;
    double all = 0, multiples = 0;
    for (std::size_t i = 0; i < result_.harmonics.size(); ++i) {
      all += size(i);
      if (result_.harmonics[i] % n == 0) multiples += size(i);
    }
    return multiples > (1 - alone) * all ? n / period : 0;
  }

  // Extrema of a damping ratio that changes by its rounding only, as while all contacts stick, are none.
  void drop_rounding() {
    for (std::size_t i = at_.size(); i-- > 0;)
      if (result_.events[i].kind != event_kinds::fold && result_.events[i].kind != event_kinds::peak &&
          !departs(course_, at_[i], 1 + result_.events[i].point.damping_ratio))
        result_.events.erase(result_.events.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // The first and the last point are events too: of a mode without others, all that is reported of it in
  // short.
  void add_ends() {
    if (result_.points.empty()) return;
    const auto end = [](const results::EventKind& kind, const ResponsePoint& point, std::size_t after) {
      return ResponseEvent{kind, false, true, point, after};
    };
    result_.events.insert(result_.events.begin(), end(event_kinds::start, result_.points.front(), 0));
    result_.events.push_back(end(event_kinds::end, result_.points.back(), result_.points.size() - 1));
  }

  scene::FrequencyUnit unit_;
  ModeRange range_;
  const control::Control control_;
  std::shared_ptr<const model::Model> model_, free_;
  std::unique_ptr<Observer> observer_;
  std::unique_ptr<MechanicalEnergy> energy_;
  std::unique_ptr<OneModeSynthesis> synthesis_;
  ResponseBranch result_;
  std::vector<std::pair<double, double>> course_;  // arclength, 1 + zeta
  std::vector<double> at_;                         // arclength of the events
  control::Progress reported_{};
  double last_ = 0;  // rad/s
};

}  // namespace

std::vector<ResponseBranch> nonlinear_modes(const scene::Scene& scene, const ModeRange& range,
                                            const control::Control& control) {
  return {ModeStudy(scene, range, control).run()};
}

}  // namespace arcslip::observables
