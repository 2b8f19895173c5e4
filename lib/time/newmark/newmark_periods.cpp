#include <arcslip/time/newmark/newmark_periods.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/time/newmark/resting_slider.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace arcslip::time {
namespace {

constexpr long steps_per_question = 4096;  // whether to go on

// The extremes of a displacement over steps, with those within a step at which its velocity turns.
class DisplacementRange {
 public:
  DisplacementRange(double x, double v) : lowest(x), highest(x), x_(x), v_(v) {}
  void step(double x, double v, double h) {
    include(x);
    if (v_ * v < 0) include(x_ + 0.5 * v_ * h * v_ / (v_ - v));
    x_ = x;
    v_ = v;
  }
  double lowest, highest;

 private:
  void include(double x) {
    lowest = std::min(lowest, x);
    highest = std::max(highest, x);
  }
  double x_, v_;
};

auto normal_of(const TimeElement& element) {
  return element.directions.col(element.directions.cols() - 1);
}

DisplacementRange response_range(const Newmark& newmark) {
  const auto at = newmark.equation().observed(newmark.time(), newmark.state().x, newmark.state().v);
  return {at.x, at.v};
}

// Observes the steps of an integration.
class Observation {
 public:
  Observation(const Newmark& newmark, bool with_history, long steps)
      : newmark_(newmark), with_history_(with_history), response_(response_range(newmark)) {
    const auto& equation = newmark.equation();
    for (const TimeElement& element : equation.elements) {
      if (element.law->has_contact()) result_.friction.emplace_back();
      if (!with_history) continue;
      result_.history.elements.push_back({element.name, {}, {}, {}, {}});
      sliders_.push_back(-1);
      for (const elements::Slider& slider : element.law->sliders(element.fields))
        if (slider.direction == 0 && sliders_.back() < 0) sliders_.back() = slider.memory;
    }
    if (with_history) reserve(static_cast<std::size_t>(steps) + 1);
    for (const TimeElement& element : equation.elements)
      if (element.law->has_normal_load())
        normal_.emplace_back(normal_of(element).dot(newmark.state().x),
                             normal_of(element).dot(newmark.state().v));
    record();
  }

  void after_step() {
    const auto& equation = newmark_.equation();
    const double h = equation.period() / static_cast<double>(newmark_.steps_per_period());
    const auto [x, v] = equation.observed(newmark_.time(), newmark_.state().x, newmark_.state().v);
    response_.step(x, v, h);
    const auto step = [&](DisplacementRange& range, const auto& d) {
      range.step(d.dot(newmark_.state().x), d.dot(newmark_.state().v), h);
    };
    std::size_t k = 0;
    for (const TimeElement& element : equation.elements)
      if (element.law->has_normal_load()) step(normal_[k++], normal_of(element));
    friction();
    record();
  }

  PeriodMotion end() {
    result_.time = newmark_.time();
    result_.end = newmark_.state();
    result_.energy = newmark_.energy();
    const auto steps = static_cast<double>(std::max(newmark_.step_number(), 1L));
    for (FrictionShare& share : result_.friction) {
      share.stick_share /= steps;
      share.open_share /= steps;
    }
    result_.amplitude = std::max(-response_.lowest, response_.highest);
    std::size_t k = 0, load = 0;
    for (const TimeElement& element : newmark_.equation().elements) {
      if (!element.law->has_contact()) continue;
      FrictionShare& share = result_.friction[k++];
      if (!element.law->has_normal_load()) continue;
      const DisplacementRange& range = normal_[load++];
      std::tie(share.load_min, share.load_max) =
          std::minmax({element.law->normal_load_at(element.fields, range.lowest),
                       element.law->normal_load_at(element.fields, range.highest)});
    }
    return std::move(result_);
  }

 private:
  void reserve(std::size_t count) {
    TimeHistory& history = result_.history;
    for (auto* list : {&history.time, &history.displacement, &history.velocity}) list->reserve(count);
    for (ElementTimeHistory& element : history.elements)
      for (auto* list : {&element.displacement, &element.force, &element.slider, &element.normal_load})
        list->reserve(count);
  }

  void friction() {
    const ImplicitElements& elements = newmark_.elements();
    std::size_t k = 0;
    for (std::size_t e = 0; e < elements.elements().size(); ++e) {
      if (!elements.elements()[e].law->has_contact()) continue;
      FrictionShare& share = result_.friction[k++];
      share.energy += elements.end(e).dissipated;
      share.stick_share += elements.end(e).stick_share;
      share.open_share += elements.end(e).open_share;
    }
  }

  void record() {
    if (!with_history_) return;
    TimeHistory& history = result_.history;
    history.time.push_back(newmark_.time());
    history.displacement.push_back(newmark_.equation().response.dot(newmark_.state().x));
    history.velocity.push_back(newmark_.equation().response.dot(newmark_.state().v));
    const ImplicitElements& elements = newmark_.elements();
    for (std::size_t e = 0; e < history.elements.size(); ++e) {
      const TimeElement& element = elements.elements()[e];
      ElementTimeHistory& of = history.elements[e];
      of.displacement.push_back(element.directions.col(0).dot(newmark_.state().x));
      of.force.push_back(elements.force()[elements.first_direction(e)]);
      if (element.law->has_normal_load())
        of.normal_load.push_back(
            element.law->normal_load_at(element.fields, normal_of(element).dot(newmark_.state().x)));
      if (sliders_[e] >= 0) of.slider.push_back(newmark_.state().z[element.memory + sliders_[e]]);
    }
  }

  const Newmark& newmark_;
  bool with_history_;
  DisplacementRange response_;
  std::vector<int> sliders_;               // of the elements: the memory that the history has, or -1
  std::vector<DisplacementRange> normal_;  // of each contact whose normal load varies
  PeriodMotion result_;
};

// Between which bounds a slider of one displacement may rest over a period.
class SliderReach {
 public:
  /// change: of the displacements by the state at the start.
  SliderReach(const TimeElement& element, const elements::Slider& slider, const MotionState& start,
              const Eigen::Ref<const Matrix>& change)
      : slider_(element.memory + slider.memory),
        room_(slider.room),
        centre_(slider.centre),
        lower_(element.directions * slider.lower.transpose()),
        upper_(element.directions * slider.upper.transpose()),
        high_(lower_.dot(start.x)),
        low_(upper_.dot(start.x)),
        d_high_(lower_.transpose() * change),
        d_low_(upper_.transpose() * change) {
    up_ = down_ = element.law->traits(element.fields, slider.direction).limit == 0;
  }

  // A slider that slips in one direction only does not return, and counts as sticking for periodic motions.
  bool rests() const { return !(up_ && down_); }

  void step(const Vector& x, const Vector& memory_change, const Eigen::Ref<const Matrix>& change) {
    const double slip = memory_change[slider_];
    up_ = up_ || slip > 0;
    down_ = down_ || slip < 0;
    if (!rests()) return;
    if (const double bound = lower_.dot(x); bound > high_) {
      high_ = bound;
      d_high_ = lower_.transpose() * change;
    }
    if (const double bound = upper_.dot(x); bound < low_) {
      low_ = bound;
      d_low_ = upper_.transpose() * change;
    }
  }

  void add_to(std::vector<RestingSlider>& resting) const {
    resting.push_back(resting_slider(slider_, room_, centre_, high_, d_high_, low_, d_low_));
  }

 private:
  int slider_;
  std::optional<double> room_;  // between its bounds: elements::Slider::room
  double centre_;
  Vector lower_, upper_;  // its bounds move with lower . x and upper . x
  double high_, low_;     // of the lower and of the upper one
  Eigen::RowVectorXd d_high_, d_low_;
  bool up_, down_;  // slips that way
};

}  // namespace

std::pair<results::Reason, std::string> failure_of(Solved solved, double time) {
  std::ostringstream at;
  at << " in the step after t = " << time << " s";
  switch (solved) {
    case Solved::yes:
      break;
    case Solved::no:
      return {reasons::no_convergence,
              "Newton's method did not converge" + at.str() + ": use more steps per period"};
    case Solved::singular:
      return {
          reasons::singular,
          "the equations are singular" + at.str() +
              ": a degree of freedom without mass needs a spring or damper in addition to slipping elements"};
    case Solved::not_finite:
      return {reasons::not_finite, "the motion overflowed" + at.str()};
  }
  return {};
}

PeriodMotion newmark_periods(Newmark& newmark, const MotionState& start, long count, bool with_history,
                             bool first, const control::Control& control) {
  Solved solved = Solved::yes;
  if (first)
    solved = newmark.begin(start);
  else
    newmark.resume(start);
  const long steps = count * newmark.steps_per_period();
  Observation observation(newmark, with_history, steps);
  bool stopped = false;
  while (solved == Solved::yes && newmark.step_number() < steps && !stopped) {
    solved = newmark.step();
    if (solved == Solved::yes) observation.after_step();
    stopped = newmark.step_number() % steps_per_question == 0 && !control.keep_going();
  }
  PeriodMotion result = observation.end();
  std::tie(result.failure, result.message) = failure_of(solved, newmark.time());
  if (stopped) {
    result.failure = reasons::user;
    result.message = "stopped by the caller";
  }
  return result;
}

PeriodMap newmark_map(Newmark& newmark, const MotionState& start) {
  const EquationOfMotion& equation = newmark.equation();
  const Eigen::Index n = equation.dofs(), size = 2 * n + equation.memory;
  PeriodMap map;
  map.monodromy = Matrix::Identity(size, size);
  newmark.resume(start);
  std::vector<SliderReach> reaches;
  std::vector<PlaneSlider> planes;
  for (const TimeElement& element : equation.elements) {
    const auto sliders = element.law->sliders(element.fields);
    if (PlaneSlider::among(sliders)) {
      planes.emplace_back(element, newmark.steps_per_period(), size);
      continue;
    }
    for (const elements::Slider& slider : sliders)
      reaches.emplace_back(element, slider, start, map.monodromy.topRows(n));
  }
  for (long k = 0; k < newmark.steps_per_period(); ++k) {
    const Solved solved = newmark.step();
    if (solved != Solved::yes) {
      map.message = failure_of(solved, newmark.time()).second;
      return map;
    }
    newmark.differentiate(map.monodromy);
    const MotionState& state = newmark.state();
    map.size = std::max(map.size, std::hypot(state.x.norm(), state.v.norm() / equation.omega));
    const auto change = map.monodromy.topRows(n);
    for (PlaneSlider& plane : planes) plane.step(state.x, newmark.elements().memory_change(), change);
    for (SliderReach& reach : reaches) reach.step(state.x, newmark.elements().memory_change(), change);
  }
  for (const SliderReach& reach : reaches)
    if (reach.rests()) reach.add_to(map.resting);
  for (const PlaneSlider& plane : planes)
    if (plane.rests()) plane.add_to(map.resting);
  map.end = newmark.state();
  map.done = true;
  return map;
}

}  // namespace arcslip::time
