#include <arcslip/optimize/certificate/certify.hpp>

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/curves/sensitivity.hpp>
#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/observe.hpp>

#include <cmath>
#include <optional>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double same_response = 1e-6;  // relative
constexpr int deflation_iterations = 40;

class OtherResponses {
 public:
  OtherResponses(const PeakAmplitude& peaks, std::span<const double> design, const PeakState& optimum,
                 const control::Control& control)
      : peaks_(peaks),
        problem_(peaks.problem()),
        model_(peaks.model_at(design)),
        window_(peaks.window()),
        optimum_(optimum),
        control_(control),
        p_(peaks.parameters(design)),
        sensitivity_(problem_) {}

  std::vector<OtherResponse> run() {
    const auto upper =
        observables::first_response(model_, window_.upper, window_.upper - window_.lower, control_);
    if (upper.u && !is_upper_end(*upper.u)) {
      at_end_ = {};
      observables::frequency_branch(model_, window_, window_.upper, recording(), -1,
                                    observables::Steps::curve, control_);
      add_highest("sweep downwards");
    }
    if (observables::may_have_several_responses(*model_)) {
      nearby(window_.upper, upper, -1);
      const auto lower =
          observables::first_response(model_, window_.lower, window_.upper - window_.lower, control_);
      nearby(window_.lower, lower, 1);
    }
    by_deflation();
    return std::move(found_);
  }

 private:
  struct Highest {
    double amplitude = -1, omega = 0;
    Vector u{};
  };

  bool is_upper_end(const Vector& u) const {
    return optimum_.upper_end.size() == u.size() &&
           (u - optimum_.upper_end).norm() <= same_response * u.norm();
  }

  // From further responses at an end of the window, next to the one that a branch begins or ends with.
  void nearby(double end, const observables::FirstResponse& first, int direction) {
    if (!first.u) return;
    const Vector p = hbm::parameters_at(*first.problem, end);
    for (const Vector& u : observables::further_responses(first.problem, p, {*first.u}, control_)) {
      const bool is_known = observables::index_of(*first.problem, u, ends_) < ends_.size();
      if (is_known || (end == window_.upper && is_upper_end(u))) continue;
      at_end_ = {};
      const auto traced = observables::frequency_branch_part(
          first.problem, window_, end, direction > 0 ? window_.upper : window_.lower, u, recording(),
          direction, observables::Steps::curve, control_, {});
      if (!control_.keep_going()) return;
      if (!traced.branch.points.empty()) ends_.push_back(traced.branch.points.back().u);
      add_highest("search at the ends");
    }
  }

  void by_deflation() {
    const Peak& peak = optimum_.peaks[optimum_.highest];
    p_[model::frequency] = peak.omega();
    const Vector known = peak.x.head(problem_->size());
    continuation::DeflationOptions options;
    options.iterations = deflation_iterations;
    options.control = control_;
    for (const Vector& u : continuation::deflate(*problem_, p_, {known}, {known}, options))
      add("deflation", u, peak.omega());
  }

  observables::Record recording() {
    return [this](observables::Observer& observer, const continuation::Accepted& now,
                  const continuation::Event*) {
      const auto& at = static_cast<const hbm::HbmEvaluator&>(now.at);
      const double here = observer.extreme(at, now.u).amplitude;
      if (here > at_end_.amplitude) at_end_ = {here, now.parameter, now.u};
      return true;
    };
  }

  void add_highest(const char* by) {
    if (at_end_.amplitude > 0) add(by, at_end_.u, at_end_.omega);
  }

  void add(const char* by, const Vector& u, double omega) {
    Vector x(u.size() + 1), none(0);
    x << u, omega;
    if (!sensitivity_.at_frequency(x, p_, {}, none) && !std::isfinite(sensitivity_.amplitude())) return;
    found_.push_back({by, omega, sensitivity_.amplitude()});
  }

  const PeakAmplitude& peaks_;
  const std::shared_ptr<const hbm::HbmProblem> problem_;
  const std::shared_ptr<const model::Model> model_;
  const observables::FrequencyWindow window_;
  const PeakState& optimum_;
  control::Control control_;
  Vector p_;
  observables::Sensitivity sensitivity_;
  Highest at_end_{};
  std::vector<Vector> ends_{};  // of the branches traced
  std::vector<OtherResponse> found_{};
};

}  // namespace

std::vector<OtherResponse> other_responses(const PeakAmplitude& peaks, std::span<const double> design,
                                           const PeakState& optimum, const control::Control& control) {
  return OtherResponses(peaks, design, optimum, control).run();
}

}  // namespace arcslip::optimize
