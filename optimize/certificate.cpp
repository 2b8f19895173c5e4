#include <arcslip/optimize/certificate.hpp>

#include <arcslip/continuation/deflation.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double as_high = 1e-6;         // relative: a peak nearer to the highest is active
constexpr double on_bound = 1e-9;        // relative
constexpr double difference = 1e-4;      // of the parameters, relative: curvature from gradients
constexpr double same_amplitude = 1e-7;  // relative
constexpr double same_response = 1e-6;   // relative
constexpr int most_steps = 20;           // to an end of a tolerance range
constexpr double range_accuracy = 1e-6;  // of the share
constexpr int deflation_iterations = 40;

// The least combination of the columns of G with weights that are >= 0 and add up to 1: the weights.
Eigen::VectorXd least_combination(const Eigen::MatrixXd& G) {
  const Eigen::Index m = G.cols();
  std::vector<Eigen::Index> used;
  for (Eigen::Index i = 0; i < m; ++i) used.push_back(i);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(m);
  while (true) {
    const auto k = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(k + 1, k + 1);
    for (Eigen::Index i = 0; i < k; ++i) {
      for (Eigen::Index j = 0; j < k; ++j)
        A(i, j) = G.col(used[static_cast<std::size_t>(i)]).dot(G.col(used[static_cast<std::size_t>(j)]));
      A(i, k) = A(k, i) = 1;
    }
    const Eigen::VectorXd x = A.fullPivLu().solve(Eigen::VectorXd::Unit(k + 1, k));
    Eigen::Index least = 0;
    if (k == 1 || x.head(k).minCoeff(&least) >= 0) {
      weights.setZero();
      for (Eigen::Index i = 0; i < k; ++i) weights[used[static_cast<std::size_t>(i)]] = x[i];
      return weights;
    }
    used.erase(used.begin() + least);
  }
}

class Certifier {
 public:
  Certifier(PeakAmplitude& peaks, std::span<const double> lower, std::span<const double> upper)
      : peaks_(peaks), lower_(lower), upper_(upper), optimum_(peaks.state()) {}

  Certificate run(const std::function<bool()>& go_on) {
    const auto more = [&] { return !go_on || go_on(); };
    stationarity();
    if (more()) other_branches();
    if (more()) curvature();
    for (std::size_t k = 0; k < optimum_.design.size() && more(); ++k) ranges(k);
    return std::move(result_);
  }

 private:
  const Peak& highest() const { return optimum_.peaks[optimum_.highest]; }
  double amplitude() const { return highest().amplitude; }

  // d ln A / d ln p, without the components that a bound holds against the descent.
  void stationarity() {
    const auto& design = optimum_.design;
    const auto n = static_cast<Eigen::Index>(design.size());
    std::vector<const Peak*> active;
    for (const Peak& peak : optimum_.peaks) {
      CertifiedPeak each{peak.kind, peak.omega(), peak.amplitude};
      each.active = peak.amplitude >= (1 - as_high) * amplitude();
      if (each.active) active.push_back(&peak);
      result_.peaks.push_back(each);
    }
    const Vector& gradient = highest().gradient;
    result_.gradient.assign(gradient.begin(), gradient.end());
    for (std::size_t k = 0; k < design.size(); ++k) {
      const double width = on_bound * (upper_[k] - lower_[k]);
      result_.at_bound.push_back(design[k] <= lower_[k] + width   ? -1
                                 : design[k] >= upper_[k] - width ? 1
                                                                  : 0);
    }
    Eigen::MatrixXd G(n, static_cast<Eigen::Index>(active.size()));
    for (std::size_t i = 0; i < active.size(); ++i)
      for (Eigen::Index k = 0; k < n; ++k)
        G(k, static_cast<Eigen::Index>(i)) =
            active[i]->gradient[k] * design[static_cast<std::size_t>(k)] / active[i]->amplitude;
    Eigen::VectorXd weights = least_combination(G), sum = G * weights;
    for (Eigen::Index k = 0; k < n; ++k)
      if (result_.at_bound[static_cast<std::size_t>(k)] * sum[k] < 0) G.row(k).setZero();
    weights = least_combination(G);
    sum = G * weights;
    result_.stationarity = sum.norm();
    Eigen::Index i = 0;
    for (CertifiedPeak& peak : result_.peaks)
      if (peak.active) peak.weight = weights[i++];
    kinked_ = active.size() > 1 || highest().kind == PeakKind::kink;
  }

  void curvature() {
    if (kinked_) return;
    const auto n = static_cast<Eigen::Index>(optimum_.design.size());
    Eigen::MatrixXd H(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      auto design = optimum_.design;
      double& value = design[static_cast<std::size_t>(k)];
      const double h = difference * std::max(std::abs(value), difference), at = value;
      Vector side[2];
      for (const int s : {0, 1}) {
        value = at + (s == 0 ? -h : h);
        const PeakState& state = peaks_.at(design);
        if (state.unbounded || state.peaks.empty()) return;
        side[s] = state.peaks[state.highest].gradient;
      }
      H.col(k) = (side[1] - side[0]) / (2 * h);
    }
    result_.curvature = 0.5 * (H + H.transpose());
    const bool inside =
        std::all_of(result_.at_bound.begin(), result_.at_bound.end(), [](int bound) { return bound == 0; });
    if (!inside || result_.curvature.llt().info() != Eigen::Success) return;
    const Vector step = -result_.curvature.llt().solve(highest().gradient);
    result_.to_minimum.assign(step.begin(), step.end());
  }

  // The place beyond the optimum where A = (1 + share) A_opt, from a guess; the bound where it comes first.
  double range_end(std::size_t k, int side, double share, double guess, bool& is_bound) {
    auto design = optimum_.design;
    const double target = std::log1p(share), bound = side < 0 ? lower_[k] : upper_[k];
    double inner = design[k], outer = bound;  // A <= target at inner; not yet known at the bound
    double value = guess;
    bool bracketed = false;
    is_bound = false;
    for (int step = 0; step < most_steps; ++step) {
      if (!(side * (value - inner) > 0) || side * (value - outer) > 0) value = 0.5 * (inner + outer);
      design[k] = value;
      const PeakState& state = peaks_.at(design);
      const double level = std::log(state.amplitude() / amplitude());
      if (std::abs(level - target) <= range_accuracy * share) return value;
      if (level < target) {
        if (value == bound) {
          is_bound = true;
          return value;
        }
        inner = value;
      } else {
        outer = value;
        bracketed = true;
      }
      double next = bracketed ? 0.5 * (inner + outer) : bound;
      if (!state.unbounded && !state.peaks.empty()) {
        const Peak& peak = state.peaks[state.highest];
        const double slope = peak.gradient[static_cast<Eigen::Index>(k)] / peak.amplitude;
        // A is nearly a parabola over the distance from the optimum: so is Newton's method exact at once.
        const double distance = value - optimum_.design[k];
        const double newton =
            slope * distance > 0 && level > 0
                ? optimum_.design[k] + distance * std::pow(target / level, level / (slope * distance))
                : next;
        if (side * (newton - inner) > 0 && side * (outer - newton) >= 0) next = newton;
      }
      value = next;
    }
    return value;
  }

  void ranges(std::size_t k) {
    const double at = optimum_.design[k];
    std::vector<ToleranceRange> of;
    for (const double share : {0.01, 0.05}) {
      ToleranceRange range{share, at, at};
      for (const int side : {-1, 1}) {
        double& end = side < 0 ? range.lower : range.upper;
        bool& is_bound = side < 0 ? range.lower_is_bound : range.upper_is_bound;
        const double bound = side < 0 ? lower_[k] : upper_[k];
        double guess = at + side * 0.1 * std::abs(at);
        if (!of.empty())
          guess = at + ((side < 0 ? of[0].lower : of[0].upper) - at) * std::sqrt(share / of[0].share);
        else if (result_.curvature.size() > 0) {
          const auto i = static_cast<Eigen::Index>(k);
          guess = at + side * std::sqrt(2 * share * amplitude() / std::max(result_.curvature(i, i), 1e-300));
        }
        if (side * (guess - bound) > 0) guess = bound;
        if (side * (bound - at) <= 0) {
          end = at;
          is_bound = true;
        } else {
          end = range_end(k, side, share, guess, is_bound);
        }
      }
      of.push_back(range);
    }
    result_.ranges.push_back(std::move(of));
  }

  // The response at the upper end of the window from nothing, if the traced branch does not end in it, and
  // other solutions at the highest peak.
  void other_branches() {
    const auto problem = peaks_.problem();
    Vector p = peaks_.parameters(optimum_.design);
    observables::Sensitivity sensitivity(problem);
    Vector none(0);
    const auto add = [&](const char* by, const Vector& u, double omega) {
      Vector x(u.size() + 1);
      x << u, omega;
      if (!sensitivity.at_frequency(x, p, {}, none) && !std::isfinite(sensitivity.amplitude())) return;
      result_.others.push_back({by, omega, sensitivity.amplitude()});
      if (sensitivity.amplitude() > (1 + same_amplitude) * amplitude()) result_.others_lower = false;
    };
    const auto model = peaks_.model_at(optimum_.design);
    const auto& window = peaks_.window();
    const auto end = observables::first_response(model, window.upper, window.upper - window.lower);
    const bool same = end.u && optimum_.upper_end.size() == end.u->size() &&
                      (*end.u - optimum_.upper_end).norm() <= same_response * end.u->norm();
    if (end.u && !same) {
      double most = -1, omega = 0;
      Vector u;
      const auto record = [&](observables::Observer& observer, const continuation::Accepted& now,
                              const continuation::Event*) {
        const auto& at = static_cast<const hbm::HbmEvaluator&>(now.at);
        const double here = observer.extreme(at, now.u).amplitude;
        if (here > most) most = here, omega = now.parameter, u = now.u;
        return true;
      };
      observables::frequency_branch(model, window, window.upper, record, -1);
      if (most > 0) add("sweep downwards", u, omega);
    }
    const Peak& peak = highest();
    p[model::frequency] = peak.omega();
    const Vector known = peak.x.head(problem->size());
    continuation::DeflationOptions options;
    options.iterations = deflation_iterations;
    for (const Vector& u : continuation::deflate(*problem, p, {known}, {known}, options))
      add("deflation", u, peak.omega());
  }

  PeakAmplitude& peaks_;
  std::span<const double> lower_, upper_;
  const PeakState optimum_;
  bool kinked_ = false;
  Certificate result_;
};

}  // namespace

Certificate certify(PeakAmplitude& peaks, std::span<const double> lower, std::span<const double> upper,
                    const std::function<bool()>& go_on) {
  return Certifier(peaks, lower, upper).run(go_on);
}

}  // namespace arcslip::optimize
