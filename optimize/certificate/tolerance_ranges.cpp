// The tolerance ranges of an optimum.
//
// Each end is where V is (1 + share) V_opt, or the limit or bound that comes first, by peaks that are
// tracked. Where new responses at the end or on the way to it show that one was lost, by new responses alone.

#include <arcslip/optimize/certificate/certify.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace arcslip::optimize {
namespace {

constexpr double shares[] = {0.01, 0.05};
constexpr int most_steps = 60;           // to an end of a tolerance range
constexpr double range_accuracy = 1e-6;  // of the share
constexpr int most_rounds_of_range = 4;  // each nearer to the optimum
constexpr int most_parts = 8;            // of the way to an end of a range
constexpr double seen_again = 1e-4;      // of the share: a level that a new response shows as well
constexpr double narrow = 1e-9;    // relative: a bracket of the place where a limit is reached, or V jumps
constexpr double lower_by = 1e-7;  // relative: V of a lower design

// On the way from the optimum to the end of a range: half way, and in a range over more than a factor of two
// in equal ratios as well, of about four.
std::vector<double> places_between(double at, double end) {
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

double target_level(double share) {
  return std::log1p(share);
}

class RangeSearch {
 public:
  RangeSearch(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
              const std::function<double()>& margin, const control::Control& control, Certificate& result)
      : cases_(cases),
        lower_(lower),
        upper_(upper),
        margin_(margin),
        control_(control),
        design_(cases.state(0).design),
        value_(cases.value()),
        margin_at_optimum_(margin ? margin() : -1),
        lowest_((1 - lower_by) * value_),
        result_(result) {}

  void run() {
    for (std::size_t k = 0; k < design_.size() && keeps_on(); ++k) result_.ranges.push_back(ranges(k));
  }

 private:
  enum class End { level, limit, bound };

  // The way from the optimum to an end of a range.
  struct Way {
    std::size_t k;  // of the parameter
    int side;
    double share, bound;
  };

  // What holds at a value of the parameter.
  struct Seen {
    double level = 0;   // ln(V / V_opt); infinite or NaN without a finite V
    double margin = 0;  // the largest c(p) of all limits
    double slope = 0;   // d ln V / dp
    bool is_within_limits() const { return margin <= limit_tolerance; }
  };

  // The values between which a range ends.
  struct Bracket {
    double inner, inner_margin;  // within the range
    double outer;                // the bound, or a value beyond the range
    std::optional<Seen> beyond;  // what holds at that value
  };

  // The first place on the way that is not within the range, what holds there, and the place before it.
  struct Gap {
    double inner, place;
    Seen seen;
  };

  bool keeps_on() const { return control_.keep_going(); }

  std::vector<ToleranceRange> ranges(std::size_t parameter) {
    const double at = design_[parameter];
    std::vector<ToleranceRange> all;
    for (const double share : shares) {
      ToleranceRange range{share, at, at};
      for (const int side : {-1, 1}) {
        const Way way{parameter, side, share, side < 0 ? lower_[parameter] : upper_[parameter]};
        End by = End::bound;
        if (side * (way.bound - at) > 0)
          (side < 0 ? range.lower : range.upper) = checked_end(way, guess(way, all), by);
        (side < 0 ? range.lower_is_bound : range.upper_is_bound) = by == End::bound;
        (side < 0 ? range.lower_is_limit : range.upper_is_limit) = by == End::limit;
      }
      all.push_back(range);
    }
    return all;
  }

  double guess(const Way& way, const std::vector<ToleranceRange>& before) const {
    const double at = design_[way.k];
    double guess = at + way.side * 0.1 * std::abs(at);
    if (!before.empty()) {
      const ToleranceRange& first = before.front();
      guess = at + ((way.side < 0 ? first.lower : first.upper) - at) * std::sqrt(way.share / first.share);
    } else if (result_.curvature.size() > 0) {
      const auto k = static_cast<Eigen::Index>(way.k);
      guess = at + way.side * std::sqrt(2 * way.share * value_ / std::max(result_.curvature(k, k), 1e-300));
    }
    return way.side * (guess - way.bound) > 0 ? way.bound : guess;
  }

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
    if (seen.is_within_limits() && now < lowest_) {
      lowest_ = now;
      result_.lower_design = std::move(design);
    }
    return seen;
  }

  bool is_within(const Way& way, const Seen& seen) const {
    return seen.is_within_limits() && seen.level <= target_level(way.share) + range_accuracy * way.share;
  }

  bool is_narrow(const Bracket& bracket, double value, const Way& way) const {
    return std::abs(value - bracket.inner) <=
           narrow * std::max(std::abs(bracket.outer), std::abs(design_[way.k]));
  }

  // From a guess. outer: the range ends before it; the bound, or where V was seen to be higher, and then
  // `beyond` is what holds there.
  double find_end(const Way& way, double guess, double outer, const std::optional<Seen>& beyond, bool traced,
                  End& end) {
    const double target = target_level(way.share);
    Bracket bracket{design_[way.k], margin_at_optimum_, outer, beyond};
    double value = guess;
    end = beyond && !beyond->is_within_limits() ? End::limit : End::level;
    for (int step = 0; step < most_steps && keeps_on(); ++step) {
      if (!(way.side * (value - bracket.inner) > 0) || way.side * (value - bracket.outer) > 0)
        value = 0.5 * (bracket.inner + bracket.outer);
      const Seen seen = see(way, value, traced);
      const bool is_kept = seen.is_within_limits();
      if (is_kept && std::abs(seen.level - target) <= range_accuracy * way.share) {
        end = End::level;
        return value;
      }
      if (is_kept && seen.level < target) {
        if (value == way.bound && !beyond) {
          end = End::bound;
          return value;
        }
        bracket.inner = value;
        bracket.inner_margin = seen.margin;
      } else {
        end = is_kept ? End::level : End::limit;
        bracket.outer = value;
        bracket.beyond = seen;
      }
      if (bracket.beyond && is_narrow(bracket, bracket.outer, way)) break;  // a limit, or a jump of V
      const auto next = next_value(way, bracket, value, seen, step % 3 == 2);
      if (!next) break;
      value = *next;
    }
    return bracket.inner;
  }

  // Limits are nearly linear and V nearly a power of the distance. Nothing: the limit is at the inner end.
  std::optional<double> next_value(const Way& way, const Bracket& bracket, double value, const Seen& seen,
                                   bool bisects) const {
    const auto& beyond = bracket.beyond;
    const double next = beyond ? 0.5 * (bracket.inner + bracket.outer) : way.bound;
    if (beyond && bisects) return next;
    if (beyond && !beyond->is_within_limits()) {
      const double share =
          std::max(0.0, -bracket.inner_margin) / (beyond->margin - std::min(0.0, bracket.inner_margin));
      const double next_to_limit = bracket.inner + share * (bracket.outer - bracket.inner);
      if (is_narrow(bracket, next_to_limit, way)) return {};
      return next_to_limit;
    }
    if (!std::isfinite(seen.level)) return next;
    const double distance = value - design_[way.k], power = seen.slope * distance;
    if (!(power > 0 && seen.level > 0)) return next;
    const double newton =
        design_[way.k] + distance * std::pow(target_level(way.share) / seen.level, seen.level / power);
    return way.side * (newton - bracket.inner) > 0 && way.side * (bracket.outer - newton) >= 0 ? newton
                                                                                               : next;
  }

  // By new responses.
  std::optional<Gap> gap_on_the_way(const Way& way, double end) {
    double inner = design_[way.k];
    for (const double place : places_between(inner, end)) {
      if (const Seen seen = see(way, place, true); !is_within(way, seen)) return Gap{inner, place, seen};
      inner = place;
    }
    return {};
  }

  double checked_end(const Way& way, double guess, End& end) {
    const double at = design_[way.k];
    double found = find_end(way, guess, way.bound, {}, false, end);
    for (int round = 0; round < most_rounds_of_range && keeps_on(); ++round) {
      if (const auto gap = gap_on_the_way(way, found)) {
        found = find_end(way, 0.5 * (gap->inner + gap->place), gap->place, gap->seen, true, end);
        continue;
      }
      if (round > 0) break;
      const Seen seen = see(way, found, true);
      if (!is_within(way, seen))
        found = find_end(way, 0.5 * (at + found), found, seen, true, end);
      else if (end == End::level && seen.level < target_level(way.share) - seen_again * way.share)
        found = find_end(way, found, way.bound, {}, true, end);
      else
        break;
    }
    return found;
  }

  LoadCases& cases_;
  std::span<const double> lower_, upper_;
  const std::function<double()>& margin_;
  const control::Control& control_;
  const std::vector<double> design_;  // of the optimum
  const double value_, margin_at_optimum_;
  double lowest_;
  Certificate& result_;
};

}  // namespace

void add_ranges(LoadCases& cases, std::span<const double> lower, std::span<const double> upper,
                const std::function<double()>& margin, const control::Control& control,
                Certificate& certificate) {
  RangeSearch(cases, lower, upper, margin, control, certificate).run();
}

}  // namespace arcslip::optimize
