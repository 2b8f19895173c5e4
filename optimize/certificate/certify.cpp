#include <arcslip/optimize/certificate/certify.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/optimize/certificate/design_estimate.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double same_amplitude = 1e-7;  // relative
constexpr int most_steps = 60;           // to an end of a tolerance range
constexpr double range_accuracy = 1e-6;  // of the share
constexpr int most_rounds_of_range = 4;  // each nearer to the optimum
constexpr int most_parts = 8;            // of the way to an end of a range
constexpr double seen_again = 1e-4;      // of the share: a level that a new response shows as well
constexpr double narrow = 1e-9;  // relative: a bracket of the place where a limit is reached, or V jumps

class Certifier {
 public:
  Certifier(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
            std::vector<ActiveLimit> limits, const std::function<double()>& margin)
      : cases_(cases),
        margin_(margin),
        lower_(lower),
        upper_(upper),
        design_(cases.state(0).design),
        value_(cases.value()),
        gradient_(cases.gradient()) {
    result_.limits = std::move(limits);
    for (std::size_t c = 0; c < cases.size(); ++c) optimum_.push_back(cases.state(c));
    for (std::size_t g = 0; g < cases.groups(); ++g) levels_.push_back(cases.height(cases.highest_of(g)));
  }

  Certificate run(const std::function<bool()>& go_on) {
    go_on_ = go_on;
    const auto more = [&] { return !go_on || go_on(); };
    stationarity();
    for (std::size_t c = 0; c < cases_.size() && more(); ++c) other_branches(c);
    if (more()) curvature();
    if (more()) move_by_harmonics();
    for (std::size_t k = 0; k < design_.size() && more(); ++k) ranges(k);
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
    DesignEstimate estimate = design_estimate(cases_, balance_, go_on_);
    result_.design_estimate = std::move(estimate.change);
    result_.design_flagged = estimate.flagged;
  }

  enum class End { level, limit, bound };

  // The way from the optimum to an end of a tolerance range.
  struct Way {
    std::size_t k;  // of the parameter
    int side;
    double share;
    double bound() const { return side < 0 ? lower : upper; }
    double lower, upper;  // bounds of the parameter
  };

  // What holds at a value of the parameter.
  struct Seen {
    double level = 0;   // ln(V / V_opt); infinite or NaN without a finite V
    double margin = 0;  // the largest c(p) of all limits
    double slope = 0;   // d ln V / dp
    bool kept() const { return margin <= limit_tolerance; }
  };

  Seen see(const Way& way, double value, bool traced) {
    auto design = design_;
    design[way.k] = value;
    if (traced)
      cases_.trace(design, observables::Steps::curve);
    else
      cases_.at(design);
    const double now = cases_.value();
    Seen seen{std::log(now / value_), margin_ ? margin_() : -1};
    if (std::isfinite(now)) seen.slope = cases_.gradient()[static_cast<Eigen::Index>(way.k)] / now;
    if (seen.kept() && now < lowest_) {
      lowest_ = now;
      result_.lower_design = std::move(design);
    }
    return seen;
  }

  static double target(const Way& way) { return std::log1p(way.share); }
  bool is_within(const Way& way, const Seen& seen) const {
    return seen.kept() && seen.level <= target(way) + range_accuracy * way.share;
  }

  // Where V is (1 + share) V_opt, from a guess, or the limit or bound that comes first. outer: the range ends
  // before it; the bound, or where V was seen to be higher, and then `beyond` is what holds there.
  double search_end(const Way& way, double guess, double outer, std::optional<Seen> beyond, bool traced,
                    End& end) {
    double inner = design_[way.k], inner_margin = margin_at_optimum_;  // within the range
    double value = guess;
    end = beyond && !beyond->kept() ? End::limit : End::level;
    const bool stays = static_cast<bool>(beyond);
    for (int step = 0; step < most_steps && (!go_on_ || go_on_()); ++step) {
      if (!(way.side * (value - inner) > 0) || way.side * (value - outer) > 0) value = 0.5 * (inner + outer);
      const Seen seen = see(way, value, traced);
      if (seen.kept() && std::abs(seen.level - target(way)) <= range_accuracy * way.share) {
        end = End::level;
        return value;
      }
      if (seen.kept() && seen.level < target(way)) {
        if (value == way.bound() && !stays) {
          end = End::bound;
          return value;
        }
        inner = value;
        inner_margin = seen.margin;
      } else {
        end = seen.kept() ? End::level : End::limit;
        outer = value;
        beyond = seen;
      }
      if (beyond && std::abs(outer - inner) <= narrow * std::max(std::abs(outer), std::abs(design_[way.k])))
        return inner;  // a limit, or a jump of V
      double next = beyond ? 0.5 * (inner + outer) : way.bound();
      const bool bisects = step % 3 == 2;  // limits are nearly linear and V nearly a power of the distance
      if (beyond && !bisects && !beyond->kept()) {
        const double share_of_way =
            std::max(0.0, -inner_margin) / (beyond->margin - std::min(0.0, inner_margin));
        next = inner + share_of_way * (outer - inner);
        if (std::abs(next - inner) <= narrow * std::max(std::abs(outer), std::abs(design_[way.k])))
          return inner;
      } else if (!(beyond && bisects) && std::isfinite(seen.level)) {
        const double distance = value - design_[way.k], power = seen.slope * distance;
        const double newton =
            power > 0 && seen.level > 0
                ? design_[way.k] + distance * std::pow(target(way) / seen.level, seen.level / power)
                : next;
        if (way.side * (newton - inner) > 0 && way.side * (outer - newton) >= 0) next = newton;
      }
      value = next;
    }
    return inner;
  }

  // On the way from the optimum to the end of a range: half way, and in a range over more than a factor of
  // two in equal ratios as well, of about four.
  static std::vector<double> places_between(double at, double end) {
    std::vector<double> places{0.5 * (at + end)};
    const double ratio = end / at;
    if (std::isfinite(ratio) && ratio > 0 && std::abs(std::log(ratio)) > std::log(2)) {
      const int parts =
          std::clamp(static_cast<int>(std::abs(std::log(ratio)) / std::log(4)) + 2, 2, most_parts);
      for (int i = 1; i < parts; ++i) places.push_back(at * std::pow(ratio, static_cast<double>(i) / parts));
    }
    std::sort(places.begin(), places.end(),
              [&](double a, double b) { return std::abs(a - at) < std::abs(b - at); });
    return places;
  }

  // The first of these places that is not within the range, by new responses, and what holds there. inner:
  // the one before.
  struct Gap {
    double inner, place;
    Seen seen;
  };
  std::optional<Gap> gap_on_the_way(const Way& way, double end) {
    double inner = design_[way.k];
    for (const double place : places_between(inner, end)) {
      if (const Seen seen = see(way, place, true); !is_within(way, seen)) return Gap{inner, place, seen};
      inner = place;
    }
    return {};
  }

  // The same by peaks that are tracked, and where new responses at the end or on the way show that one was
  // lost, by new responses alone, which are checked on the way as well.
  double range_end(const Way& way, double guess, End& end) {
    const double at = design_[way.k];
    double found = search_end(way, guess, way.bound(), {}, false, end);
    for (int round = 0; round < most_rounds_of_range && (!go_on_ || go_on_()); ++round) {
      if (const auto gap = gap_on_the_way(way, found)) {
        found = search_end(way, 0.5 * (gap->inner + gap->place), gap->place, gap->seen, true, end);
        continue;
      }
      if (round > 0) break;
      const Seen seen = see(way, found, true);
      if (!is_within(way, seen))
        found = search_end(way, 0.5 * (at + found), found, seen, true, end);
      else if (end == End::level && seen.level < target(way) - seen_again * way.share)
        found = search_end(way, found, way.bound(), {}, true, end);
      else
        break;
    }
    return found;
  }

  void ranges(std::size_t k) {
    const double at = design_[k];
    std::vector<ToleranceRange> of;
    for (const double share : {0.01, 0.05}) {
      ToleranceRange range{share, at, at};
      for (const int side : {-1, 1}) {
        double& end = side < 0 ? range.lower : range.upper;
        const double bound = side < 0 ? lower_[k] : upper_[k];
        double guess = at + side * 0.1 * std::abs(at);
        if (!of.empty())
          guess = at + ((side < 0 ? of[0].lower : of[0].upper) - at) * std::sqrt(share / of[0].share);
        else if (result_.curvature.size() > 0) {
          const auto i = static_cast<Eigen::Index>(k);
          guess = at + side * std::sqrt(2 * share * value_ / std::max(result_.curvature(i, i), 1e-300));
        }
        if (side * (guess - bound) > 0) guess = bound;
        End by = End::bound;
        if (side * (bound - at) > 0) end = range_end({k, side, share, lower_[k], upper_[k]}, guess, by);
        (side < 0 ? range.lower_is_bound : range.upper_is_bound) = by == End::bound;
        (side < 0 ? range.lower_is_limit : range.upper_is_limit) = by == End::limit;
      }
      of.push_back(range);
    }
    result_.ranges.push_back(std::move(of));
  }

  void other_branches(std::size_t c) {
    const double highest = levels_[cases_.group(c)] / cases_.weight(c);
    for (OtherResponse& each : other_responses(cases_.peaks(c), design_, optimum_[c], go_on_)) {
      each.in_case = c;
      if (each.amplitude > (1 + same_amplitude) * highest) result_.others_lower = false;
      result_.others.push_back(std::move(each));
    }
  }

  LoadCases& cases_;
  const std::function<double()>& margin_;
  std::function<bool()> go_on_{};
  std::span<const double> lower_, upper_;
  const std::vector<double> design_;
  const double value_;
  const double margin_at_optimum_ = margin_ ? margin_() : -1;
  double lowest_ = (1 - same_amplitude) * value_;
  const Vector gradient_;
  std::vector<PeakState> optimum_;  // of each case
  std::vector<double> levels_;      // of each group
  Balance balance_;
  Certificate result_;
};

}  // namespace

Certificate certify(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                    std::vector<ActiveLimit> limits, const std::function<double()>& margin,
                    const std::function<bool()>& go_on) {
  return Certifier(cases, lower, upper, std::move(limits), margin).run(go_on);
}

}  // namespace arcslip::optimize
