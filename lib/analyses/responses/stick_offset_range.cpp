#include <arcslip/analyses/responses/stick_offset_range.hpp>

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using continuation::In;
using continuation::Vector;

constexpr double same_amplitude = 1e-10;  // relative: amplitudes that are one
constexpr double least_slope = 1e-9;      // of the amplitude, over the whole way of a slider
constexpr double least_way = 1.0 / 64;    // of a segment: a shorter step is not tried
constexpr int rounds = 40;                // of a search
constexpr int line_steps = 40;            // of golden sections

/// The shares s of the elements, -1 where a slider cannot be placed.
using Shares = Eigen::ArrayXd;

/// Harmonic balance with sliders at given shares.
class Placed final : public continuation::Problem {
 public:
  Placed(const hbm::HbmProblem& problem, Shares shares) : problem_(problem), shares_(std::move(shares)) {}
  int size() const override { return problem_.size(); }
  std::span<const continuation::Parameter> parameters() const override { return problem_.parameters(); }
  Vector scales() const override { return problem_.scales(); }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    auto at = problem_.hbm_evaluator();
    for (Eigen::Index e = 0; e < shares_.size(); ++e)
      if (shares_[e] >= 0) at->place_slider(static_cast<std::size_t>(e), shares_[e]);
    return at;
  }

 private:
  const hbm::HbmProblem& problem_;
  Shares shares_;
};

/// A response with sliders at these shares.
struct Place {
  Shares shares;
  Vector u;
  double amplitude = 0;
  Eigen::ArrayXd slope, mean_slope;  // of the amplitude and of the mean of the response, by the shares
};

class Search {
 public:
  Search(const hbm::HbmProblem& problem, const Vector& p)
      : problem_(problem), p_(p), amplitude_(problem.harmonics()) {}

  /// Newton's method from a guess.
  std::optional<Place> at(const Shares& shares, const Vector& guess) {
    const Placed placed(problem_, shares);
    const Eigen::Index n = problem_.size();
    continuation::Counts counts;
    continuation::NewtonOptions newton;
    newton.iterations = 30;
    continuation::Corrector corrector(placed, p_, model::frequency, newton, counts);
    Vector v(n + 1);
    v << guess, p_[model::frequency];
    const Vector row = Vector::Unit(n + 1, n);
    if (!corrector.correct(v, row, false).converged || !corrector.linearize(v, row)) return {};
    const auto& now = static_cast<const hbm::HbmEvaluator&>(corrector.evaluator());
    const auto& h = problem_.harmonics();
    Vector x(h.size()), phi(h.size());
    const Extreme extreme = amplitude_.of(now, v.head(n), x);
    elements::series_basis(h, extreme.theta, phi);
    Place place{shares, v.head(n), extreme.amplitude, {}, {}};
    place.slope = slopes(corrector.factors(), now, extreme.sign * phi, extreme.place);
    const Vector mean = Vector::Unit(h.size(), h.cosine_index(0));
    place.mean_slope = slopes(corrector.factors(), now, mean, extreme.place);
    return place;
  }

  /// The response at other shares, by as few steps as converge.
  std::optional<Place> go(const Place& from, const Shares& to) {
    Place now = from;
    double way = 0, step = 1;
    while (way < 1) {
      const double next = std::min(1.0, way + step);
      auto found = at(from.shares + next * (to - from.shares), now.u);
      if (found) {
        now = std::move(*found);
        way = next;
      } else if ((step /= 2) < least_way) {
        return {};
      }
    }
    return now;
  }

  /// The corner that a slope points to; where it moves nothing the shares stay.
  static Shares corner(const Place& from, const Eigen::ArrayXd& slope) {
    Shares to = from.shares;
    for (Eigen::Index e = 0; e < to.size(); ++e)
      if (to[e] >= 0 && std::abs(slope[e]) > least_slope * from.amplitude) to[e] = slope[e] > 0 ? 1 : 0;
    return to;
  }

  /// From corner to corner as long as the amplitude grows.
  Place highest_from(Place now) {
    for (int i = 0; i < rounds; ++i) {
      const auto next = go(now, corner(now, now.slope));
      if (!next || !(next->amplitude > now.amplitude * (1 + same_amplitude))) break;
      now = *next;
    }
    return now;
  }

  /// The least amplitude along lines to the corners that the slopes point away from.
  Place lowest_from(Place now) {
    for (int i = 0; i < rounds; ++i) {
      const Place next = lowest_between(now, corner(now, -now.slope));
      if (!(next.amplitude < now.amplitude * (1 - same_amplitude))) break;
      now = next;
    }
    return now;
  }

  /// By golden sections.
  Place lowest_between(const Place& from, const Shares& to) {
    Place best = from;
    if ((to == from.shares).all()) return best;
    const auto value = [&](double t) {
      const auto found = go(best, from.shares + t * (to - from.shares));
      if (!found) return std::numeric_limits<double>::infinity();
      if (found->amplitude < best.amplitude) best = *found;
      return found->amplitude;
    };
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    value(1);
    double a = 0, b = 1, c = b - golden, d = a + golden;
    double at_c = value(c), at_d = value(d);
    for (int i = 0; i < line_steps; ++i) {
      if (at_c < at_d) {
        b = d, d = c, at_d = at_c;
        c = b - golden * (b - a);
        at_c = value(c);
      } else {
        a = c, c = d, at_c = at_d;
        d = a + golden * (b - a);
        at_d = value(d);
      }
    }
    return best;
  }

 private:
  // Of a . x by the shares, x at one place of the response.
  Eigen::ArrayXd slopes(const continuation::LinearSolver& factors, const hbm::HbmEvaluator& now,
                        const Vector& a, int place) const {
    const Eigen::Index n = problem_.size();
    Vector l = Vector::Zero(n + 1);
    now.stiffness().response_transposed(a, l.head(n), place);
    Eigen::ArrayXd slope = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(now.element_count()));
    if (!factors.solve_transposed(l)) return slope;
    for (Eigen::Index e = 0; e < slope.size(); ++e) {
      elements::FrictionState state;
      const auto index = static_cast<std::size_t>(e);
      if (!now.element(index).friction(state) || !(state.mean_max > state.mean_min)) continue;
      const hbm::ElementMap map = problem_.map_of(index);
      Vector w(map.size());
      map.gather(l.head(n), w);
      slope[e] = (state.mean_max - state.mean_min) * w[0];
    }
    return slope;
  }

  const hbm::HbmProblem& problem_;
  const Vector& p_;
  Amplitude amplitude_;
};

}  // namespace

OffsetRange offset_range(const hbm::HbmProblem& of, In u, const Vector& p) {
  OffsetRange range;
  // Antisymmetric motions have no mean, but others next to them have.
  elements::Harmonics all = of.harmonics();
  all.odd = false;
  const hbm::HbmProblem problem(of, all, of.sampling());
  Vector guess(problem.size());
  elements::transfer(of.harmonics(), u, all, guess);
  const auto evaluator = problem.hbm_evaluator();
  if (evaluator->move_to(guess, p, continuation::Needs::residual) != continuation::Evaluated::ok) {
    range.failure = "the response cannot be evaluated";
    return range;
  }
  Shares shares = Shares::Constant(static_cast<Eigen::Index>(evaluator->element_count()), -1);
  for (std::size_t e = 0; e < evaluator->element_count(); ++e) {
    elements::FrictionState state;
    const bool sticks = evaluator->element(e).friction(state) && state.mean_max > state.mean_min;
    if (!evaluator->place_slider(e, 0.5)) continue;
    const double mean = evaluator->element(e).force()[0];
    shares[static_cast<Eigen::Index>(e)] =
        sticks ? std::clamp((state.mean_max - mean) / (state.mean_max - state.mean_min), 0.0, 1.0) : 0.5;
    range.sliders += sticks ? 1 : 0;
  }
  Search search(problem, p);
  const auto start = search.at(shares, guess);
  if (!start) {
    range.failure = "nothing but friction holds the mean position, which may then be any";
    return range;
  }
  range.amplitude_min = range.amplitude_max = start->amplitude;
  if (range.sliders == 0) return range;
  Place least = *start;
  for (const double sign : {1.0, -1.0}) {
    const auto end = search.go(*start, Search::corner(*start, sign * start->mean_slope));
    if (!end) {
      range.failure = "the responses at the bounds of the sliders were not all found";
      continue;
    }
    range.amplitude_max = std::max(range.amplitude_max, search.highest_from(*end).amplitude);
    const Place between = search.lowest_between(*start, end->shares);
    if (between.amplitude < least.amplitude) least = between;
  }
  range.amplitude_max = std::max(range.amplitude_max, search.highest_from(*start).amplitude);
  range.amplitude_min = search.lowest_from(least).amplitude;
  return range;
}

}  // namespace arcslip::observables
