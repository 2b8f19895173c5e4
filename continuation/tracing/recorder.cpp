#include <arcslip/continuation/tracing/recorder.hpp>

#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace arcslip::continuation {
namespace {

// The events of a section in order of arclength, with its branch point: the first terminal one ends the
// branch.
std::vector<LocatedEvent> with_crossing(std::vector<LocatedEvent>&& found,
                                        std::optional<LocatedEvent>& crossing) {
  if (crossing && !crossing->event.monitor.empty()) {
    const auto place =
        std::upper_bound(found.begin(), found.end(), crossing->place.arclength,
                         [](double s, const LocatedEvent& each) { return s < each.event.point.arclength; });
    found.insert(place, std::move(*crossing));
  }
  crossing.reset();
  return std::move(found);
}

}  // namespace

void Recorder::keep(const CurvePoint& place, const Correction& correction) {
  Point kept = point(place, correction);
  if (!options_.keep_points) kept.u = kept.tangent = {};
  if (options_.keep_states) kept.state = s_.accepted;
  s_.branch.points.push_back(std::move(kept));
  ++s_.branch.counts.points;
}

bool Recorder::wants_spectrum() const {
  if (!spectra_) return false;
  const StabilityOptions& of = *options_.stability;
  const bool everywhere = of.at == SpectrumAt::every_point ||
                          (of.at == SpectrumAt::automatic && s_.here.v.size() - 1 <= of.every_point);
  return everywhere || s_.branch.points.size() <= 1 || s_.branch.events.size() != events_before_;
}

void Recorder::add_spectrum(bool is_event) {
  if (!wants_spectrum() && !(spectra_ && is_event)) return;
  events_before_ = s_.branch.events.size();
  take_spectrum(main_.evaluator());
}

void Recorder::take_spectrum(const Evaluator& at) try {
  s_.branch.points.back().spectrum = spectra_->at(at.jacobian());
} catch (const std::exception& fault) {
  warn_once("no stability at ", text(s_.branch.points.back().parameter) + because(fault.what()));
}

void Recorder::warn_once(const std::string& start, const std::string& rest) {
  auto& all = s_.branch.warnings;
  if (std::none_of(all.begin(), all.end(), [&](const std::string& w) { return w.starts_with(start); }))
    all.push_back(start + rest);
}

void Recorder::warn_of_undefined(const CurvePoint& place) {
  for (std::size_t m = 0; m < monitors_.size(); ++m)
    if (std::isnan(place.monitors[m]) || std::isnan(place.quantities[m]))
      warn_once("the monitor \"" + monitors_[m].name + "\" is not a number at ",
                text(place.v[place.v.size() - 1]) + ": zeros near such points are missed");
}

// A point of the branch stands for it, whose numbers are not those of the event: once for each monitor.
void Recorder::warn_of_unlocated(const Event& event) {
  if (!event.located)
    warn_once("the event \"" + event.monitor + "\" is not located near ",
              text(event.point.parameter) +
                  ": the nearest point of the branch that was computed stands for it (Event::located)");
}

bool Recorder::events_of(TrialStep& trial) {
  bool keep_going = true;
  const CurvePoint* from = &s_.here;
  for (const PassedKink& corner : trial.corners) {
    if (!keep_going || terminal_) break;
    keep_going = pass(*from, corner);
    from = &corner.beyond;
  }
  if (!keep_going || terminal_) return keep_going;
  const auto& crossing = trial.crossing;
  const bool crossed = crossing && crossing->event.located && !crossing->event.nonsmooth &&
                       crossing->place.arclength > from->arclength;
  return report(with_crossing(
      crossed ? events_.past(*from, crossing->place, trial.end) : events_.between(*from, trial.end),
      trial.crossing));
}

// Moves to a kink, from the start of a section, and across it. A visible corner becomes a point of
// the branch.
bool Recorder::pass(const CurvePoint& from, const PassedKink& corner) {
  const CurvePoint& kink = corner.before;
  bool keep_going = report(events_.between(from, kink));
  if (!keep_going || terminal_) return keep_going;
  keep_going = report(events_.across(corner));
  if (terminal_ || angle_between(main_.dot(kink.tangent, corner.beyond.tangent)) < visible_corner)
    return keep_going;
  keep(kink, {});
  if (!spectra_ && (!keep_going || !observer_)) return keep_going;
  const auto now = events_.look_at(kink);
  if (now && wants_spectrum()) take_spectrum(now->at);  // of the piece before it
  return keep_going && (!observer_ || !now || observer_(*now, nullptr));
}

bool Recorder::report(std::vector<LocatedEvent>&& all) {
  bool keep_going = true;
  for (LocatedEvent& found : all) {
    warn_of_unlocated(found.event);
    const Event* event = add(std::move(found.event));
    if (observer_ && keep_going) {
      const auto now = events_.look_at(found.place);
      if (!now) main_.move_to(found.place.v);  // at a branch point B may be singular to the last bit
      keep_going = observer_(now ? *now : accepted(main_, found.place), event);
    }
    const bool terminal = std::any_of(monitors_.begin(), monitors_.end(), [&](const Monitor& m) {
      return m.terminal && m.name == event->monitor;
    });
    if (terminal && !terminal_) terminal_ = std::move(found);
  }
  return keep_going;
}

// In order of arclength: an event may have been pending for a few points.
const Event* Recorder::add(Event&& event) {
  const double s = event.point.arclength;
  const auto after = std::upper_bound(s_.branch.points.begin(), s_.branch.points.end(), s,
                                      [](double x, const Point& y) { return x < y.arclength; });
  event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - s_.branch.points.begin(), 1) - 1);
  const auto place = std::upper_bound(s_.branch.events.begin(), s_.branch.events.end(), s,
                                      [](double x, const Event& y) { return x < y.point.arclength; });
  return &*s_.branch.events.insert(place, std::move(event));
}

// For the observer, the evaluator moves by the last correction onto the point itself.
bool Recorder::show_last_point(bool is_there) {
  if (!observer_) return true;
  if (!is_there) main_.move_to(s_.here.v);
  return observer_(accepted(main_, s_.here), nullptr);
}

}  // namespace arcslip::continuation
