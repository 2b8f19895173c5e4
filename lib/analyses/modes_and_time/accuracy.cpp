#include <arcslip/analyses/modes_and_time/accuracy.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>

namespace arcslip::observables {
namespace {

// In periods of the motion to one of the excitation.
constexpr std::array orders{1,  2,  3,   5,   7,   9,   11,  15,  21,  27, 39,
                            55, 79, 111, 157, 221, 313, 443, 627, 887, 999};
constexpr std::array samples_per_order{8, 64};                      // of sampled friction, at least
constexpr std::array steps_of_period{50, 200, 800, 3200};           // of a period
constexpr int runs = 3;                                             // at most
constexpr double long_enough = 0.1;                                 // s: no further run
constexpr double decades[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8};  // that the sentence reports

class Trials {
 public:
  Trials(const scene::Scene& scene, const AccuracySettings& settings, const control::Control& control)
      : scene_(scene), settings_(settings), control_(control) {
    const model::Model model = model::build(scene);
    result_.parameters = described(model).parameters;
    const int period = scene.harmonics.period;
    int lowest = period;
    for (const auto& each : model.excitation)
      lowest = std::max(lowest, model.harmonics.excited(each.harmonic));
    for (const int order : orders)
      if (order * period >= lowest && (order * period <= settings.order || orders_.empty()))
        orders_.push_back(order * period);
  }

  Accuracy run() {
    refer();
    const int first = orders_.front();
    for (const int order : orders_) balance(Way::exact, order, 0);
    // A scene whose laws are not sampled has the same response.
    if (balance(Way::sampled, first, samples_of(first, samples_per_order[0])) && is_sampled())
      for (const int per_order : samples_per_order)
        for (const int order : orders_)
          if (order != first || per_order != samples_per_order[0])
            balance(Way::sampled, order, samples_of(order, per_order));
    for (const int each : steps_of_period) in_time(Way::newmark, TimeMethod::newmark_shooting, each);
    in_time(Way::shooting, TimeMethod::shooting, steps_of_period[0]);
    finish();
    return std::move(result_);
  }

 private:
  struct Peak {
    ResponsePoint point;
    long points = 0;
  };

  bool keep_going() {
    reported_.points = static_cast<long>(result_.trials.size());
    control_.report(reported_);
    return control_.keep_going() && failure_.empty();
  }

  int samples_of(int order, int per_order) const {
    int samples = scene_.harmonics.period;
    while (samples < per_order * order) samples *= 2;
    return samples;
  }

  scene::Scene with(int order, scene::Friction friction, int samples) const {
    scene::Scene scene = scene_;
    scene.harmonics.order = order;
    scene.harmonics.friction = friction;
    if (samples > 0) scene.harmonics.samples = samples;
    return scene;
  }

  // The highest peak of a frequency response; none: why, in failure.
  std::optional<Peak> highest_peak(const scene::Scene& scene, std::string& failure) {
    Peak found;
    FrequencyRange range{settings_.from, settings_.to};
    range.points = range.events = {.motion = false};
    for (const auto& branch : frequency_response(scene, range, control_.quiet())) {
      found.points += static_cast<long>(branch.points.size());
      if (branch.status != Status::complete) failure = branch.stop.message;
      for (const auto& event : branch.events) {
        if (event.kind != event_kinds::peak) continue;
        if (event.point.unbounded) failure = "its peak is unbounded";
        if (event.point.amplitude > found.point.amplitude) found.point = event.point;
      }
    }
    if (failure.empty() && !(found.point.amplitude > 0)) failure = "it has no peak in the window";
    if (!failure.empty()) return {};
    return found;
  }

  // Twice the highest order, and the difference from that order.
  void refer() {
    std::array<ResponsePoint, 2> peaks;
    for (std::size_t i = 0; i < 2 && keep_going(); ++i) {
      const int order = orders_.back() * (i == 0 ? 1 : 2) + (i == 0 ? 0 : scene_.harmonics.period);
      result_.reference_order = std::min(order, scene::largest_order);
      std::string failure;
      const auto peak = highest_peak(with(result_.reference_order, scene::Friction::exact, 0), failure);
      if (!peak) {
        if (control_.keep_going())
          failure_ = "no reference at order " + std::to_string(order) + ": " + failure;
        return;
      }
      peaks[i] = peak->point;
    }
    result_.reference_amplitude = peaks[1].amplitude;
    result_.reference_omega = peaks[1].omega;
    result_.reference_error = std::abs(peaks[0].amplitude / peaks[1].amplitude - 1);
  }

  // The least time of a few runs. f: false if there was no result.
  template <class F>
  bool timed(double& seconds, const F& f) {
    double all = 0;
    seconds = HUGE_VAL;
    for (int run = 0; run < runs && all < long_enough; ++run) {
      const auto began = std::chrono::steady_clock::now();
      if (!f()) return false;
      const double one = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      seconds = std::min(seconds, one);
      all += one;
    }
    return true;
  }

  void add(Trial trial) {
    trial.error = std::abs(trial.amplitude / result_.reference_amplitude - 1);
    result_.trials.push_back(trial);
  }

  void leave_out(Way way, const std::string& what, const std::string& why) {
    if (control_.keep_going()) result_.left_out.push_back(std::string(name(way)) + ", " + what + ": " + why);
  }

  bool balance(Way way, int order, int samples) {
    if (!keep_going()) return false;
    Trial trial{.way = way, .order = order, .samples = samples};
    const auto scene =
        with(order, way == Way::sampled ? scene::Friction::sampled : scene::Friction::exact, samples);
    std::optional<Peak> peak;
    std::string failure;
    if (!timed(trial.seconds, [&] { return (peak = highest_peak(scene, failure)).has_value(); })) {
      leave_out(way, "order " + std::to_string(order), failure);
      return false;
    }
    trial.amplitude = peak->point.amplitude;
    trial.omega = peak->point.omega;
    trial.estimate = peak->point.truncation_estimate / peak->point.amplitude;
    trial.flagged = peak->point.truncation_flagged;
    trial.points = peak->points;
    add(trial);
    return true;
  }

  // The last trial, of sampled friction, is not the one with exact integrals.
  bool is_sampled() {
    const Trial& last = result_.trials.back();
    const auto same = std::find_if(result_.trials.begin(), result_.trials.end(), [&](const Trial& other) {
      return other.way == Way::exact && other.order == last.order;
    });
    if (same == result_.trials.end() || same->amplitude != last.amplitude) return true;
    result_.trials.pop_back();
    return false;
  }

  void in_time(Way way, TimeMethod method, int count) {
    if (!keep_going()) return;
    Trial trial{.way = way, .samples = count};
    trial.omega = result_.reference_omega;
    trial.points = 1;
    Motion motion;
    const TimeSettings settings{.frequency = trial.omega / scene::to_rad_per_s(scene_.frequency_unit),
                                .method = method,
                                .steps = count};
    const bool done = timed(trial.seconds, [&] {
      motion = motion_in_time(scene_, settings, control_.quiet());
      return motion.status == Status::complete;
    });
    if (!done) return leave_out(way, std::to_string(count) + " steps", motion.stop.message);
    if (way == Way::shooting && motion.integrator == "newmark") return;  // not piecewise linear
    if (way == Way::shooting) trial.samples = 0;
    trial.amplitude = motion.amplitude;
    add(trial);
  }

  void finish() {
    auto& trials = result_.trials;
    for (Trial& trial : trials)
      trial.best = std::none_of(trials.begin(), trials.end(), [&](const Trial& other) {
        return other.error <= trial.error && other.seconds_per_point() < trial.seconds_per_point();
      });
    if (!control_.keep_going()) {
      result_.status = Status::stopped;
      result_.stop = {reasons::user, static_cast<double>(trials.size()), 0, "stopped by the caller"};
    } else if (!failure_.empty()) {
      result_.status = Status::failed;
      result_.stop = {reasons::start_failed, 0, 0, failure_};
    } else {
      result_.stop = {reasons::compared, static_cast<double>(trials.size()), 0, advice()};
    }
  }

  // "within 0.001: exact, order 5, 4.1 us a point; within 1e-06: ..."
  std::string advice() const {
    std::ostringstream text;
    text.precision(2);
    const Trial* last = nullptr;
    for (const double error : decades) {
      const Trial* trial = fastest(result_, error);
      if (!trial) {
        text << (last ? "; " : "") << "none within " << error;
        break;
      }
      if (trial == last) continue;
      text << (last ? "; " : "") << "within " << error << ": " << name(trial->way);
      if (trial->order > 0) text << ", order " << trial->order;
      if (trial->samples > 0) text << ", " << trial->samples << (trial->order > 0 ? " samples" : " steps");
      text << ", " << 1e6 * trial->seconds_per_point() << " us a point";
      last = trial;
    }
    return text.str();
  }

  const scene::Scene& scene_;
  AccuracySettings settings_;
  const control::Control control_;
  std::vector<int> orders_;
  Accuracy result_;
  control::Progress reported_{};
  std::string failure_;
};

}  // namespace

std::string_view name(Way way) {
  switch (way) {
    case Way::exact:
      return "exact";
    case Way::sampled:
      return "sampled";
    case Way::newmark:
      return "newmark";
    default:
      return "event-driven";
  }
}

Accuracy accuracy(const scene::Scene& scene, const AccuracySettings& settings,
                  const control::Control& control) {
  return Trials(scene, settings, control).run();
}

const Trial* fastest(const Accuracy& accuracy, double error) {
  const Trial* found = nullptr;
  for (const Trial& trial : accuracy.trials)
    if (trial.error <= error && (!found || trial.seconds_per_point() < found->seconds_per_point()))
      found = &trial;
  return found;
}

}  // namespace arcslip::observables
