#include <arcslip/time/event_driven.hpp>

#include <arcslip/time/march.hpp>
#include <arcslip/time/polynomial.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

double elastic_and_kinetic(const EquationOfMotion& equation, const State& state) {
  double energy = 0.5 * state.v.dot(equation.M * state.v) + 0.5 * state.x.dot(equation.K * state.x);
  for (const Element& element : equation.elements)
    if (element.slider >= 0) {
      const double stretch = element.direction.dot(state.x) - state.z[element.slider];
      energy += 0.5 * element.stiffness * stretch * stretch;
    }
  return energy;
}

double sum(Coefficients c) {
  double sum = 0;
  for (double term : c) sum += std::abs(term);
  return sum;
}

// Visits the extremes of d . x on the piece, its ends included, unless none of them can leave [lower, upper].
class Extremes {
 public:
  template <class Visit>
  void visit(const LinearMotion& piece, const Vector& d, double s_end, double lower, double upper,
             Visit&& visit) {
    piece.displacement(d, series_);
    const double swing = sum(Coefficients(series_).subspan(1));
    if (series_[0] - swing > lower && series_[0] + swing < upper) return;
    visit(0.0, series_[0]);
    slope_.resize(series_.size() - 1);
    for (std::size_t k = 1; k < series_.size(); ++k) slope_[k - 1] = static_cast<double>(k) * series_[k];
    sign_changes(slope_, roots_);
    for (double s : roots_)
      if (s < s_end) visit(s, value(series_, s));
    visit(s_end, value(series_, s_end));
  }

 private:
  LinearMotion::Series series_{};
  std::vector<double> slope_, roots_;
};

// Motion of a slider's element over the period, and where the slider went.
struct Range {
  bool up = false, down = false;
  double high = -INFINITY, low = INFINITY;
  Eigen::RowVectorXd dhigh, dlow;

  // What slips must slip back, or is not periodic: a slider that does not rests, as far as shooting goes.
  bool resting() const { return !(up && down); }
};

class Recorder {
 public:
  Recorder(const EquationOfMotion& equation, const March& march, std::span<const double> instants)
      : equation_(equation), march_(march), instants_(instants) {
    for (const Friction& friction : march.frictions())
      motion_.friction.push_back({equation.elements[static_cast<std::size_t>(friction.element)].name});
    for (const Element& element : equation.elements)
      motion_.history.elements.push_back({element.name, {}, {}, {}});
    motion_.amplitude = -1;
    start_energy_ = elastic_and_kinetic(equation, march.state());
  }

  void piece() {
    const double s = march_.s(), h = march_.h();
    const LinearMotion& piece = march_.piece();
    while (next_ < instants_.size() && instants_[next_] <= march_.piece_end()) {
      at(std::clamp((instants_[next_] - march_.time()) / h, 0.0, s), instants_[next_]);
      ++next_;
    }
    if (const ContactEvent* event = march_.event()) motion_.events.push_back(*event);
    if (s == 0) return;
    const auto work = piece.work(s);
    motion_.energy.input += work.input;
    motion_.energy.viscous += work.viscous;
    for (std::size_t i = 0; i < motion_.friction.size(); ++i) {
      const Friction& friction = march_.frictions()[i];
      if (friction.stuck()) motion_.friction[i].stick_time += s * h;
      if (friction.slip == 0) continue;
      piece.displacement(friction.direction, series_);
      const double start = series_[0];
      series_[0] = 0;
      motion_.friction[i].energy += friction.slip * friction.limit * value(series_, s);
      series_[0] = start;
    }
    const double A = motion_.amplitude;
    extremes_.visit(piece, equation_.response, s, -A, A, [&](double at, double x) {
      if (std::abs(x) <= motion_.amplitude) return;
      motion_.amplitude = std::abs(x);
      motion_.amplitude_time = march_.time() + at * h;
    });
  }

  EventDrivenMotion finish() {
    motion_.reason = march_.reason();
    motion_.message = march_.message();
    motion_.time = march_.time();
    motion_.end = march_.state();
    for (const FrictionRecord& record : motion_.friction) motion_.energy.friction += record.energy;
    motion_.energy.stored = elastic_and_kinetic(equation_, motion_.end) - start_energy_;
    if (motion_.amplitude < 0) motion_.amplitude = std::abs(equation_.response.dot(motion_.end.x));
    return std::move(motion_);
  }

 private:
  void at(double s, double t) {
    const LinearMotion& piece = march_.piece();
    History& history = motion_.history;
    history.time.push_back(t);
    piece.displacement(equation_.response, series_);
    history.displacement.push_back(value(series_, s));
    piece.velocity(equation_.response, series_);
    history.velocity.push_back(value(series_, s));
    for (std::size_t e = 0; e < equation_.elements.size(); ++e) {
      piece.displacement(equation_.elements[e].direction, series_);
      history.elements[e].displacement.push_back(value(series_, s));
    }
    for (const Friction& friction : march_.frictions()) {
      ElementHistory& element = history.elements[static_cast<std::size_t>(friction.element)];
      element.force.push_back(march_.force(friction, element.displacement.back()));
      element.slider.push_back(march_.slider(friction, element.displacement.back()));
    }
    for (ElementHistory& element : history.elements)  // a cubic spring of stiffness 0
      element.force.resize(element.displacement.size());
  }

  const EquationOfMotion& equation_;
  const March& march_;
  std::span<const double> instants_;
  std::size_t next_ = 0;
  double start_energy_;
  Extremes extremes_;
  LinearMotion::Series series_{};
  EventDrivenMotion motion_;
};

}  // namespace

EventDriven::EventDriven(const EquationOfMotion& equation, const EventLimits& limits) : equation_(equation) {
  if (!equation.is_piecewise_linear())
    throw NotPiecewiseLinear(
        "an exact integration between events needs linear laws between them: this scene has a cubic spring");
  march_ = std::make_unique<March>(equation_, limits);
}

EventDriven::~EventDriven() = default;

EventDrivenMotion EventDriven::integrate(const State& start, double from, double to,
                                         std::span<const double> instants) {
  march_->begin(start, from, false);
  Recorder recorder(equation_, *march_, instants);
  while (march_->find(to)) {
    recorder.piece();
    march_->finish();
  }
  return recorder.finish();
}

PeriodMap EventDriven::map(const State& start, double to) {
  march_->begin(start, 0, true);
  const auto& frictions = march_->frictions();
  std::vector<Range> ranges(frictions.size());
  Extremes extremes;
  PeriodMap map;
  while (march_->find(to)) {
    map.size = std::max(map.size, march_->size());
    const LinearMotion& piece = march_->piece();
    for (std::size_t i = 0; i < frictions.size() && march_->s() > 0; ++i) {
      Range& range = ranges[i];
      if (frictions[i].free()) range.up = range.down = true;
      (frictions[i].slip > 0 ? range.up : range.down) |= frictions[i].slip != 0;
      if (!range.resting()) continue;
      const Vector& d = frictions[i].direction;
      extremes.visit(piece, d, march_->s(), range.low, range.high, [&](double s, double q) {
        if (q > range.high) range.high = q, range.dhigh = piece.along(d, s);
        if (q < range.low) range.low = q, range.dlow = piece.along(d, s);
      });
    }
    march_->finish();
  }
  map.done = march_->reason() == EndReason::reached;
  map.message = march_->message();
  map.end = march_->state();
  map.monodromy = march_->monodromy();
  for (std::size_t i = 0; i < frictions.size(); ++i)
    if (ranges[i].resting() && ranges[i].dhigh.size() > 0)
      map.resting.push_back({frictions[i].slider, 0.5 * (ranges[i].high + ranges[i].low),
                             0.5 * (ranges[i].dhigh + ranges[i].dlow).tail(map.monodromy.cols())});
  return map;
}

}  // namespace arcslip::time
