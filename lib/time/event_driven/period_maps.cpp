// Maps over a period, with derivatives (event_driven.hpp).
#include <arcslip/time/event_driven/event_driven.hpp>
#include <arcslip/time/event_driven/march.hpp>
#include <arcslip/time/event_driven/piece_extremes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::time {
namespace {

// The bounds of a slider over the period, and where it went.
struct SliderRange {
  bool up = false, down = false;
  double high = -INFINITY, low = INFINITY;  // of the lower and of the upper bound
  Eigen::RowVectorXd dhigh, dlow;

  // A slipping slider must slip back in a periodic motion: one that does not counts as sticking for shooting.
  bool resting() const { return !(up && down); }
};

class SliderRanges {
 public:
  explicit SliderRanges(const March& march) : march_(march), ranges_(march.contacts().size()) {}

  void piece() {
    const auto& contacts = march_.contacts();
    const LinearMotion& piece = march_.piece();
    for (std::size_t i = 0; i < contacts.size() && march_.s() > 0; ++i) {
      if (contacts[i].slider < 0) continue;
      SliderRange& range = ranges_[i];
      if (contacts[i].follows()) {
        range.up = range.up || contacts[i].mode().way >= 0;
        range.down = range.down || contacts[i].mode().way <= 0;
      }
      if (!range.resting()) continue;
      const Vector &lower = contacts[i].lower, &upper = contacts[i].upper;
      const ElementRates::Slider* rates = contacts[i].slider_rates;
      extremes_.visit(piece, lower, march_.s(), -INFINITY, range.high, [&](double s, double bound) {
        if (!(bound > range.high)) return;
        range.high = bound;
        range.dhigh = piece.along(lower, s);
        if (rates) range.dhigh.tail<1>()[0] += piece.along(rates->lower, s)[0] + rates->centre - rates->room;
      });
      extremes_.visit(piece, upper, march_.s(), range.low, INFINITY, [&](double s, double bound) {
        if (!(bound < range.low)) return;
        range.low = bound;
        range.dlow = piece.along(upper, s);
        if (rates) range.dlow.tail<1>()[0] += piece.along(rates->upper, s)[0] + rates->centre + rates->room;
      });
    }
  }

  // Derivatives without that of the motion itself: by the start, and by a parameter if that is carried.
  std::vector<RestingSlider> resting() const {
    std::vector<RestingSlider> all;
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      const SliderRange& range = ranges_[i];
      if (!range.resting() || range.dhigh.size() == 0) continue;
      const Contact& contact = march_.contacts()[i];
      const Eigen::Index rest = range.dhigh.size() - 1;
      all.push_back(resting_slider(contact.memory, contact.room, contact.centre, range.high,
                                   range.dhigh.tail(rest), range.low, range.dlow.tail(rest)));
    }
    return all;
  }

 private:
  const March& march_;
  std::vector<SliderRange> ranges_;
  Extremes extremes_;
};

// The phases that each contact goes through, as one number. A slider that slips where the period begins is at
// its limit only to rounding there, and may stick until it slips: that phase counts as slip.
class Phases {
 public:
  explicit Phases(const March& march) : march_(march), courses_(march.contacts().size()) {}

  void piece() {
    if (!march_.event()) return;
    Course& course = courses_[march_.switching()];
    const int mode = march_.next_mode();
    course.whole = joined(course.whole, mode);
    if (course.first < 0)
      course.first = mode;
    else
      course.rest = joined(course.rest, mode);
  }

  std::uint64_t number(const std::vector<RestingSlider>& resting) const {
    std::uint64_t all = basis;
    for (std::size_t i = 0; i < courses_.size(); ++i) {
      const Course& course = courses_[i];
      const int last = march_.contacts()[i].now;
      all = joined(all, last);
      all = joined(all, course.first == last ? course.rest : course.whole);
    }
    for (const RestingSlider& slider : resting) all = joined(joined(all, slider.slider), way(slider));
    return all;
  }

 private:
  static constexpr std::uint64_t basis = 14695981039346656037ull;
  template <class T>
  static std::uint64_t joined(std::uint64_t all, T next) {
    return (all ^ static_cast<std::uint64_t>(next)) * 1099511628211ull;
  }

  // Which of the choices its offset is, where there is one.
  int way(const RestingSlider& slider) const {
    for (const Contact& contact : march_.contacts())
      if (contact.memory == slider.slider && contact.room)
        return slider.offset > 0 ? 1 : slider.offset < 0 ? 2 : 3;
    return 0;
  }

  struct Course {
    int first = -1;               // mode after the first event; -1: none
    std::uint64_t whole = basis;  // of all of them
    std::uint64_t rest = basis;   // those without it
  };
  const March& march_;
  std::vector<Course> courses_;
};

}  // namespace

PeriodMap EventDriven::map(const MotionState& start, double to) {
  march_->begin(start, 0, Columns::start);
  SliderRanges ranges(*march_);
  PeriodMap map;
  while (march_->find(to)) {
    map.size = std::max(map.size, march_->size());
    ranges.piece();
    march_->finish();
  }
  map.done = march_->reason() == EndReason::reached;
  if (!map.done) map.message = march_->message();
  map.end = march_->state();
  map.monodromy = march_->monodromy();
  map.resting = ranges.resting();
  return map;
}

Orbit EventDriven::orbit(const MotionState& start, const EquationRates* by) {
  const double period = equation_.period();
  march_->begin(start, 0, by ? Columns::start : Columns::motion, by);
  SliderRanges ranges(*march_);
  Phases phases(*march_);
  Extremes extremes;
  Orbit orbit;
  PeriodMap& map = orbit.map;
  orbit.amplitude = -1;
  while (march_->find(period)) {
    map.size = std::max(map.size, march_->size());
    ranges.piece();
    phases.piece();
    const double s_end = march_->s(), A = orbit.amplitude;
    if (s_end > 0)
      extremes.visit_observed(march_->piece(), s_end, -A, A, [&](double s, double x) {
        if (std::abs(x) <= orbit.amplitude) return;
        orbit.amplitude = std::abs(x);
        if (!by) return;
        Eigen::RowVectorXd x_by = march_->piece().along(equation_.response, s);
        x_by.tail<1>()[0] += by->base_at(equation_, march_->time() + s * march_->h());
        orbit.amplitude_by = (x < 0 ? -1 : 1) * x_by.tail(x_by.size() - 1);
      });
    march_->finish();
  }
  map.done = march_->reason() == EndReason::reached;
  if (!map.done) map.message = march_->message();
  map.end = march_->state();
  map.resting = ranges.resting();
  orbit.phases = phases.number(map.resting);
  if (!by || !map.done) return orbit;
  map.monodromy = march_->monodromy();
  orbit.by_parameter = march_->by_parameter(-period / equation_.omega * by->omega);
  for (RestingSlider& slider : map.resting) {
    const Eigen::Index size = map.monodromy.cols();
    orbit.by_parameter[2 * equation_.dofs() + slider.slider] = slider.derivative[size];
    slider.derivative.conservativeResize(size);
  }
  return orbit;
}

}  // namespace arcslip::time
