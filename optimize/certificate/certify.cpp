#include <arcslip/optimize/certificate/certify.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double same_amplitude = 1e-7;  // relative

class Certifier {
 public:
  Certifier(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
            std::vector<ActiveLimit> limits, const std::function<double()>& margin,
            const control::Control& control)
      : cases_(cases),
        margin_(margin),
        control_(control),
        lower_(lower),
        upper_(upper),
        design_(cases.state(0).design),
        gradient_(cases.gradient()) {
    result_.limits = std::move(limits);
    for (std::size_t c = 0; c < cases.size(); ++c) optimum_.push_back(cases.state(c));
    for (std::size_t g = 0; g < cases.groups(); ++g) levels_.push_back(cases.height(cases.highest_of(g)));
  }

  Certificate run() {
    const auto more = [&] { return control_.keep_going(); };
    stationarity();
    for (std::size_t c = 0; c < cases_.size() && more(); ++c) other_branches(c);
    if (more()) curvature();
    if (more()) move_by_harmonics();
    add_ranges(cases_, lower_, upper_, margin_, control_, result_);
    return std::move(result_);
  }

 private:
  void stationarity() {
    balance_ = balance(cases_, lower_, upper_, std::move(result_.limits));
    const Balance& found = balance_;
    result_.gradient.assign(gradient_.begin(), gradient_.end());
    result_.stationarity = found.stationarity;
    result_.complementarity = found.complementarity;
    result_.at_bound = found.at_bound;
    result_.limits = found.limits;
    auto active = found.active.begin();
    for (std::size_t c = 0; c < optimum_.size(); ++c)
      for (std::size_t i = 0; i < optimum_[c].peaks.size(); ++i) {
        const Peak& peak = optimum_[c].peaks[i];
        CertifiedPeak each{peak.kind, peak.omega(), peak.amplitude};
        each.in_case = c;
        each.active = active != found.active.end() && active->in_case == c && active->peak == i;
        if (each.active) each.weight = (active++)->multiplier;
        result_.peaks.push_back(each);
      }
  }

  void curvature() {
    if (!balance_.smooth) return;
    const auto n = static_cast<Eigen::Index>(design_.size());
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t g = 0; g < cases_.groups(); ++g) {
      const std::size_t c = cases_.highest_of(g);
      const continuation::Matrix of_peak = cases_.peaks(c).hessian(cases_.state(c).highest);
      if (of_peak.size() == 0) return;
      H += cases_.weight(c) * of_peak;
    }
    result_.curvature = H;
    const bool inside =
        std::all_of(result_.at_bound.begin(), result_.at_bound.end(), [](int bound) { return bound == 0; });
    continuation::Cholesky cholesky;
    if (!inside || !result_.limits.empty() || !cholesky.factorize(result_.curvature)) return;
    const Vector step = -cholesky.solve(gradient_);
    result_.to_minimum.assign(step.begin(), step.end());
  }

  void move_by_harmonics() {
    DesignEstimate estimate = design_estimate(cases_, balance_, control_);
    result_.design_estimate = std::move(estimate.change);
    result_.design_flagged = estimate.flagged;
  }

  void other_branches(std::size_t c) {
    const double highest = levels_[cases_.group(c)] / cases_.weight(c);
    for (OtherResponse& each : other_responses(cases_.peaks(c), design_, optimum_[c], control_)) {
      each.in_case = c;
      if (each.amplitude > (1 + same_amplitude) * highest) result_.others_lower = false;
      result_.others.push_back(std::move(each));
    }
  }

  LoadCases& cases_;
  const std::function<double()>& margin_;
  const control::Control& control_;
  std::span<const double> lower_, upper_;
  const std::vector<double> design_;
  const Vector gradient_;
  std::vector<PeakState> optimum_;  // of each case
  std::vector<double> levels_;      // of each group
  Balance balance_;
  Certificate result_;
};

}  // namespace

Certificate certify(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                    std::vector<ActiveLimit> limits, const std::function<double()>& margin,
                    const control::Control& control) {
  return Certifier(cases, lower, upper, std::move(limits), margin, control).run();
}

}  // namespace arcslip::optimize
