#include <arcslip/observables/truncation.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/hbm/grazing_problem.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr int least_tail = 9;  // orders of the excitation above N looked at: N + 9 at least, 2 N + 9 in all
constexpr double linear_motion = 1e-13;  // forces left out, relative: below, nothing is neglected
constexpr double rounded_off = 1e-13;    // of a second correction, over the amplitude
constexpr double near_a_fold = 1e-4;     // a step along the branch, relative to |u|: beyond, its bend matters
constexpr double within_corner = 1e-6;   // |h| over its size
constexpr double kept_change = 0.02;     // change of the harmonics kept with samples, over those left out
constexpr double converging = 0.3;       // second sweep over the first
constexpr double cancelled = 0.02;       // |dA| over the change of the response
constexpr double uncancelled_of_internal = 0.2;  // of laws with unknowns of their own
constexpr double small_change = 0.1;             // of the response, over its amplitude
constexpr double tolerance = 1e-6;  // of the response, over its amplitude: below, what cancels is 5e-8 of it

elements::Harmonics widened(const elements::Harmonics& h) {
  return {2 * h.order + least_tail * h.period, h.odd, h.period};
}

// Whether the natural modes, with their damping, are the same at two places of a branch.
bool have_same_modes(const model::Model& model, const Vector& p, const Vector& q) {
  const Eigen::Index others = p.size() - model::frequency - 1;
  if (p.tail(others) == q.tail(others)) return true;
  const auto same = [&](const model::Number& number) {
    return number.value_or(p, 0) == number.value_or(q, 0);
  };
  for (const auto* parts : {&model.masses, &model.dampers, &model.springs})
    if (!std::all_of(parts->begin(), parts->end(), [&](const auto& part) { return same(part.number); }))
      return false;
  if (!std::all_of(model.matrices.begin(), model.matrices.end(),
                   [&](const auto& part) { return part.value(p) == part.value(q); }))
    return false;
  if (const auto& damping = model.damping;
      damping && !(same(damping->alpha) && same(damping->beta) && same(damping->loss_factor)))
    return false;
  return std::all_of(model.elements.begin(), model.elements.end(), [&](const auto& element) {
    const std::vector<double> at_p = element.fields(p), at_q = element.fields(q);
    for (int i = 0; i < element.law->directions(); ++i)
      if (element.law->stiffness(at_p, i, 0) != element.law->stiffness(at_q, i, 0)) return false;
    return true;
  });
}

// Whether some element is stiffer in large motions than at rest.
bool stiffen(const model::Model& model, const Vector& p) {
  return std::any_of(model.elements.begin(), model.elements.end(), [&](const auto& element) {
    const std::vector<double> fields = element.fields(p);
    for (int i = 0; i < element.law->directions(); ++i)
      if (element.law->traits(fields, i).stiffness != element.law->stiffness(fields, i, 0)) return true;
    return false;
  });
}

}  // namespace

PointCondition held_by(const continuation::Event& event) {
  if (event.nonsmooth) return PointCondition::corner;
  if (event.monitor == event_kinds::fold) return PointCondition::fold;
  if (event.monitor == event_kinds::branch_point) return PointCondition::branch_point;
  return event_kinds::contains(event_kinds::of_stability, event.monitor) ? PointCondition::parameter
                                                                         : PointCondition::extremum;
}

Truncation::Truncation(const hbm::HbmProblem& problem, int free, const Vector& p)
    : problem_(problem),
      free_(free),
      wide_(problem, widened(problem.harmonics())),
      narrow_(problem, problem.harmonics()),
      p_(p),
      bound_of_highest_(bound_of_highest_natural_frequency(problem.model(), p)),
      stiffens_(stiffen(problem.model(), p)),
      base_(wide_.problem().size()),
      residual_(base_.size()),
      response_(wide_.problem().harmonics().size()),
      by_parameter_(response_.size()) {}

TruncationEstimate Truncation::estimate(const continuation::Accepted& now, const Extreme& extreme,
                                        PointCondition held) {
  exact_ = false;
  change_.u.resize(0);
  if (!wide_.move_to(now.u, now.p)) return {.flagged = true};
  residual_ = wide_.at().residual();
  exact_ = neglects_nothing();
  if (exact_ && held == PointCondition::parameter) return {};
  if (exact_) return {.location = 0, .location_change = 0};
  if (held == PointCondition::branch_point) return {.amplitude = no_value, .change = no_value};

  const auto [location, is_at_corner, is_known] = correct(now, extreme, held);
  const double change = change_of_amplitude(change_, now, extreme, held);
  const double size = response_.norm();
  if (!std::isfinite(change)) return {.flagged = true};
  double estimate = not_cancelled(change, size, extreme.amplitude);
  const elements::Harmonics& all = wide_.problem().harmonics();
  const double base = all.base_frequency(now.p[model::frequency]);
  const double highest = highest_natural_frequency_above(all.order * base, now);
  if (has_internal() || problem_.harmonics().order * base < highest)
    estimate += further_change(now, extreme, held, is_at_corner);
  const double beyond = all.order * base < highest ? response_beyond(now) : 0;
  const double most = small_change * extreme.amplitude;  // also of the second correction
  const bool small = size + beyond <= most && estimate <= most;
  if (small) estimate = std::max(estimate, beyond);
  return {.amplitude = std::isfinite(estimate) ? estimate : std::abs(change),
          .change = change,
          .flagged = samples_too_few() || !is_known || !small,
          .location = std::max(std::abs(location.change), uncancelled * location.parts),
          .location_change = location.change};
}

// Whether the motion has no forces beyond the harmonics kept.
bool Truncation::neglects_nothing() const {
  double force = 0;
  for (std::size_t e = 0; e < wide_.at().element_count(); ++e)
    force = std::max(force, wide_.at().element(e).force().cwiseAbs().maxCoeff());
  return residual_.cwiseAbs().maxCoeff() <= linear_motion * force;
}

// Makes change_ that to the point of more harmonics which satisfies the same condition.
Truncation::Correction Truncation::correct(const continuation::Accepted& now, const Extreme& extreme,
                                           PointCondition held) {
  const Eigen::Index n = problem_.size();
  wide_.factorize(free_);
  if (held == PointCondition::corner && to_corner(now)) return {{change_.parameter}, true, true};
  const double enough = tolerance * now.u.norm();
  const bool converges = wide_.solve(now.bordered, residual_, {}, change_, enough) <= converging;
  wide_.embed(now.tangent.head(n), tangent_.u);
  tangent_.parameter = now.tangent[n];
  const Step step = step_along(now, held);
  Shift location;
  if (held == PointCondition::extremum) location = shift_of_extremum(now, extreme);
  change_.u += step.length * tangent_.u;
  change_.parameter += step.length * tangent_.parameter;
  if (held == PointCondition::fold && step.known) location.change = change_.parameter;
  return {location, false, converges && step.known};
}

// The estimate for a change of the amplitude, and the size of that of the response.
double Truncation::not_cancelled(double change, double size, double amplitude) const {
  if (size <= tolerance * amplitude) return std::abs(change);
  const double estimate = std::abs(change) < cancelled * size ? uncancelled * size : std::abs(change);
  return has_internal() ? std::max(estimate, uncancelled_of_internal * size) : estimate;
}

bool Truncation::has_internal() const {
  return problem_.blocks() > problem_.coordinates().unknowns;
}

// Of the solution's change x; response_: that of the response.
double Truncation::change_of_amplitude(const Change& x, const continuation::Accepted& now,
                                       const Extreme& extreme, PointCondition held) {
  wide_.at().stiffness().response(x.u, 0, response_, extreme.place);
  if (held != PointCondition::parameter) {
    wide_.embed(now.u, base_);
    wide_.at().stiffness().response_derivative(free_, base_, wide_.at().force_factor(), by_parameter_,
                                               extreme.place);
    response_ += x.parameter * by_parameter_;
  }
  return amplitude_change(wide_.problem().harmonics(), extreme, response_);
}

// By a second correction, with the factors of the first: next to a resonance of a neglected harmonic the
// first order is not all. NaN: not known.
double Truncation::further_change(const continuation::Accepted& now, const Extreme& extreme,
                                  PointCondition held, bool is_at_corner) {
  wide_.embed(now.u, base_);
  Vector p = now.p;
  p[free_] += change_.parameter;
  const hbm::HbmEvaluator* at = wide_.look_at(base_ + change_.u, p);
  if (!at) return no_value;
  Change further;
  wide_.solve(is_at_corner ? *solver_ : now.bordered, at->residual(),
              is_at_corner ? border_ : WideEquations::Border(), further);
  if (held == PointCondition::parameter) {
    const double step = -further.parameter / tangent_.parameter;
    further.u += step * tangent_.u;
    further.parameter = 0;
  }
  const double change = std::abs(change_of_amplitude(further, now, extreme, held));
  return change <= rounded_off * extreme.amplitude ? 0 : change;
}

std::optional<Truncation::Refined> Truncation::refined(const continuation::Accepted& now, Reach reach,
                                                       bool evaluated) {
  if (change_.u.size() == 0 || !change_.u.allFinite() || !std::isfinite(change_.parameter)) return {};
  wide_.embed(now.u, base_);
  base_ += change_.u;
  if (reach == Reach::half) {
    const elements::Harmonics& all = wide_.problem().harmonics();
    const int highest = (problem_.harmonics().order + all.order) / 2;
    for (Eigen::Index block = 0; block < base_.size(); block += all.size())
      for (int j = 0; j < all.cosines(); ++j) {
        const int n = all.cosine_order(j);
        if (n <= highest) continue;
        base_[block + all.cosine_index(n)] = base_[block + all.sine_index(n)] = 0;
      }
  }
  Vector p = now.p;
  p[free_] += change_.parameter;
  const hbm::HbmEvaluator* at = evaluated ? wide_.look_at(base_, p) : nullptr;
  if (evaluated ? !at : !base_.allFinite() || !(p[model::frequency] > 0)) return {};
  return Refined{wide_.problem(), base_, at, std::move(p)};
}

// Smooth laws that are sampled have an error below any power of the samples, once these resolve their forces:
// in the harmonics kept, twice as many then change next to nothing.
bool Truncation::samples_too_few() const {
  const auto& model = problem_.model();
  if (!problem_.sampling().exact || std::none_of(model.elements.begin(), model.elements.end(),
                                                 [](const auto& e) { return e.law->approximates(); }))
    return false;
  const elements::Harmonics &kept = problem_.harmonics(), &all = wide_.problem().harmonics();
  double change = 0, largest = 0;
  for (Eigen::Index block = 0; block < residual_.size(); block += all.size())
    for (int j = 0; j < all.cosines(); ++j) {
      const int n = all.cosine_order(j);
      double size = std::abs(residual_[block + all.cosine_index(n)]);
      if (n > 0) size = std::hypot(size, residual_[block + all.sine_index(n)]);
      (n <= kept.order ? change : largest) = std::max(n <= kept.order ? change : largest, size);
    }
  return change > kept_change * largest;
}

// The highest natural frequency; of a large structure it may be a lower one above `reach`.
double Truncation::highest_natural_frequency_above(double reach, const continuation::Accepted& now) {
  const model::Model& model = problem_.model();
  if (stiffens_) return highest_natural_frequency(model, now.p, largest_motions());
  if (!have_same_modes(model, p_, now.p)) {
    p_ = now.p;
    high_modes_.reset();
    bound_of_highest_ = bound_of_highest_natural_frequency(model, p_);
  }
  if (!high_modes_) {
    auto modes = resonant_modes(model, p_);
    if (!modes && reach < bound_of_highest_) return bound_of_highest_;
    if (!modes) modes = {{highest_natural_frequency(model, p_), HUGE_VAL}};
    double most = 0;
    for (auto mode = modes->rbegin(); mode != modes->rend(); ++mode)
      mode->gain = most = std::max(most, mode->omega > 0 ? mode->gain / (mode->omega * mode->omega) : 0);
    high_modes_ = std::move(modes);
  }
  return high_modes_->empty() ? 0 : high_modes_->back().omega;
}

// The largest at the resonance of a mode beyond the harmonics of the wide equations. Forces of contacts fall
// as n^-2: the one left out that is largest by this law says what is beyond.
double Truncation::response_beyond(const continuation::Accepted& now) const {
  if (stiffens_ || !high_modes_) return HUGE_VAL;
  const elements::Harmonics& all = wide_.problem().harmonics();
  const double base = all.base_frequency(now.p[model::frequency]), reach = all.order * base;
  const auto above = std::upper_bound(high_modes_->begin(), high_modes_->end(), reach,
                                      [](double r, const ResonantMode& mode) { return r < mode.omega; });
  if (above == high_modes_->end() || above->gain == 0) return 0;
  const int kept = problem_.harmonics().order;
  double force = 0;  // times n^2
  for (std::size_t e = 0; e < wide_.at().element_count(); ++e) {
    const auto F = wide_.at().element(e).force();
    for (Eigen::Index block = 0; block < F.size(); block += all.size())
      for (int j = 0; j < all.cosines(); ++j)
        if (const int n = all.cosine_order(j); n > kept)
          force = std::max(force,
                           n * n * std::hypot(F[block + all.cosine_index(n)], F[block + all.sine_index(n)]));
  }
  return above->gain * force * base * base;
}

// Of |d_e . x| of each element.
std::vector<double> Truncation::largest_motions() const {
  std::vector<double> motions;
  for (std::size_t e = 0; e < wide_.at().element_count(); ++e) {
    const auto& h = wide_.problem().harmonics();
    const int directions = problem_.model().elements[e].law->directions();
    double largest = 0;
    for (int i = 0; i < directions; ++i) {
      const auto motion = wide_.at().element_motion(e).segment(i * h.size(), h.size());
      largest = std::max(largest, elements::series_bound(h, motion, 0) + (h.odd ? 0 : std::abs(motion[0])));
    }
    motions.push_back(largest);
  }
  return motions;
}

// The step along the tangent from the condition of the point.
Truncation::Step Truncation::step_along(const continuation::Accepted& now, PointCondition held) {
  const double t = tangent_.parameter, d = change_.parameter;
  const double size = std::max(1.0, now.u.norm() / problem_.displacement());
  if (held == PointCondition::extremum) return {0, true};
  if (held == PointCondition::corner) return {0, false};
  if (held == PointCondition::parameter && std::abs(d) <= near_a_fold * size * std::abs(t))
    return {-d / t, true};
  if (held == PointCondition::fold) {
    const auto slope = slope_along(wide_, change_, true, now);
    const auto bend = slope_along(wide_, tangent_, false, now);
    return slope && bend ? Step{-slope->parameter / bend->parameter, true} : Step{0, false};
  }
  const auto bend = bend_of_branch(now);
  if (!bend) return {0, false};
  const double root = t * t - 2 * bend->parameter * d;  // on the parabola of the branch
  if (root < 0) return {-t / bend->parameter, false};   // which ends before: its fold is next
  return {-2 * d / (t + std::copysign(std::sqrt(root), t)), true};
}

// u'' and q'', from the equations of order N: what the harmonics above add to them is of higher order.
std::optional<Truncation::Change> Truncation::bend_of_branch(const continuation::Accepted& now) {
  const Eigen::Index n = problem_.size();
  if (!narrow_.move_to(now.u, now.p)) return {};
  narrow_.factorize(free_);
  return slope_along(narrow_, {now.tangent.head(n), now.tangent[n]}, false, now);
}

// x', of the solution x of J x = -r or of the tangent, J x = 0, along t: J x' = -(J x + r)' or -(J x)' at
// fixed x.
std::optional<Truncation::Change> Truncation::slope_along(WideEquations& in, const Change& x,
                                                          bool with_residual,
                                                          const continuation::Accepted& now) {
  in.embed(now.u, base_);
  in.embed(now.tangent.head(now.u.size()), along_);
  const double size = std::max(1.0, now.u.norm() / problem_.displacement());
  Vector place, p = now.p, middle;
  std::array<Vector, 2> nearby;
  in.apply(x, free_, middle);
  if (with_residual) middle += in.at().residual();
  const auto quotient = continuation::difference_within_piece(continuation::difference_step * size,
                                                              [&](std::size_t i, double h) {
                                                                place = base_ + h * along_;
                                                                p = now.p;
                                                                p[free_] += h * now.tangent[now.u.size()];
                                                                if (!in.look_nearby(place, p)) return false;
                                                                in.apply_nearby(x, free_, nearby[i]);
                                                                if (with_residual)
                                                                  nearby[i] += in.residual_nearby();
                                                                return true;
                                                              });
  if (!quotient) return {};
  const Vector slope =
      quotient->here * middle + quotient->weight[0] * nearby[0] + quotient->weight[1] * nearby[1];
  WideEquations::Change change;
  in.solve(now.bordered, slope, {}, change);
  return change;
}

// The response to a change of (u, q) at the instant of the extremum, with derivatives by the angle.
elements::Values Truncation::response_to(WideEquations& in, const Change& x,
                                         const continuation::Accepted& now, const Extreme& extreme) {
  const hbm::DynamicStiffness& stiffness = in.at().stiffness();
  const auto& h = in.problem().harmonics();
  Vector response(h.size()), by_parameter(h.size());
  in.embed(now.u, base_);
  stiffness.response(x.u, 0, response, extreme.place);
  stiffness.response_derivative(free_, base_, in.at().force_factor(), by_parameter, extreme.place);
  response += x.parameter * by_parameter;
  return elements::series_values(h, response, extreme.theta);
}

// Of an extremum in q. Its instant theta moves along the branch by theta' = -x_st/x_tt (t: by theta), so that
//
//   A'' = x_ss + x_st theta',   (dA)' = d(x)' + d(x)_t theta'
Truncation::Shift Truncation::shift_of_extremum(const continuation::Accepted& now, const Extreme& extreme) {
  const auto bend = bend_of_branch(now);
  const auto rate = slope_along(wide_, change_, true, now);
  if (!bend || !rate) return {};
  const Eigen::Index n = now.u.size();
  const auto& narrow = narrow_.at().stiffness();
  Vector motion(narrow_.problem().harmonics().size());
  narrow.response(now.u, narrow_.at().force_factor(), motion, extreme.place);
  const double bent = elements::series_values(narrow_.problem().harmonics(), motion, extreme.theta).d2;
  const elements::Values by_s = response_to(narrow_, {now.tangent.head(n), now.tangent[n]}, now, extreme);
  const double turning = -by_s.d1 / bent;
  const double curvature = response_to(narrow_, *bend, now, extreme).x + turning * by_s.d1;
  const double along = now.tangent[n] / curvature;
  const double by_rate = -along * response_to(wide_, *rate, now, extreme).x;
  const double by_turning = -along * turning * response_to(wide_, change_, now, extreme).d1;
  const double change = change_.parameter + by_rate + by_turning;
  if (!std::isfinite(change)) return {};
  return {change, std::abs(change_.parameter) + std::abs(by_rate) + std::abs(by_turning)};
}

// The change at which the slip corner next to the point remains one.
bool Truncation::to_corner(const continuation::Accepted& now) {
  std::optional<hbm::Corner> corner;
  double least = 0;
  for (hbm::Corner& each : hbm::corners_near(problem_, now.u, now.p, within_corner)) {
    const auto excess = hbm::corner_excess(problem_, each, now.u, now.p);
    if (!excess || (corner && !(std::abs(*excess) < least))) continue;
    corner = each;
    least = std::abs(*excess);
  }
  if (!corner) return false;
  wide_.embed(now.u, base_);
  border_.row.resize(base_.size());
  hbm::corner_gradient(wide_.problem(), *corner, base_, now.p, border_.row);
  border_.parameter = hbm::corner_derivative(wide_.problem(), *corner, base_, now.p, free_);
  if (!solver_) solver_ = continuation::suitable_solver(wide_.at().jacobian());
  if (!wide_.factorize_kept(border_, free_, *solver_)) return false;
  return wide_.solve(*solver_, residual_, border_, change_) <= converging;
}

}  // namespace arcslip::observables
