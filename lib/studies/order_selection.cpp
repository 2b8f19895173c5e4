#include <arcslip/studies/order_selection.hpp>

#include <arcslip/results/reasons.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace arcslip::studies {
namespace {

using observables::no_value;

constexpr int lowest_order = 3;  // of the excitation's harmonics
constexpr int order_of_starts = 31;
constexpr double friction_rate = 3;  // p of error ~ N^-p
constexpr double slowest_rate = 1, fastest_rate = 20;
constexpr double rate_of_changes = 2;
constexpr double largest_growth = 3, growth_where_unknown = 2;  // of the order
constexpr double safety = 1.3;                                  // of the error expected of the next order
constexpr int fewest_samples = 512;
constexpr double least_damping_ratio = 1e-8;  // rounding is 1e-8 of it
constexpr double samples_rate = 1.5;
constexpr double largest_estimate = 1;  // of the largest amplitude

// Rounded up to an odd multiple of the period: with an antisymmetric motion an even one adds nothing.
int rounded_up(double order, int period) {
  const int n = static_cast<int>(std::ceil(order / period));
  return (n % 2 == 0 ? n + 1 : n) * period;
}

// By which changes of damping ratios are measured: that of a mode is 0 while all of its contacts stick, and
// of a conservative structure throughout, to rounding.
double largest_damping_ratio(std::span<const observables::ResponseBranch> branches) {
  double largest = least_damping_ratio;
  for (const observables::ResponseBranch& branch : branches)
    for (const observables::ResponsePoint& point : branch.points)
      largest = std::fmax(largest, std::abs(point.damping_ratio));
  return largest;
}

std::string to_two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

}  // namespace

void add(const observables::Solution& point, Truncation& to) {
  if (point.unbounded) return;
  to.amplitude = std::max(to.amplitude, point.amplitude);
  to.estimate = std::fmax(to.estimate, std::abs(point.truncation_estimate));
  to.flagged = to.flagged || point.truncation_flagged;
}

void add(const observables::LookedAt& responses, Truncation& to) {
  to.amplitude = std::max(to.amplitude, responses.amplitude);
  to.estimate = std::fmax(to.estimate, responses.estimate);
  to.flagged = to.flagged || responses.flagged;
}

void add(observables::Status status, const observables::Stop& stop, Truncation& to) {
  to.failed = to.failed || status == observables::Status::failed;
  to.ended = to.ended || stop.reason == observables::reasons::user;
}

Truncation truncation_of(std::span<const observables::ResponseBranch> branches, bool estimated) {
  Truncation found;
  for (const observables::ResponseBranch& branch : branches) {
    if (branch.found_none)
      add(*branch.found_none, found);
    else
      add(branch.status, branch.stop, found);
    for (const observables::ResponsePoint& point : branch.points) add(point, found);
    for (const observables::ResponseEvent& event : branch.events) add(event.point, found);
  }
  if (!estimated) found.estimate = no_value;
  const double damping = largest_damping_ratio(branches);
  const auto add_landmarks = [&](const observables::ResponsePoint& point) {
    if (!point.unbounded) found.landmarks.push_back({point.amplitude, found.amplitude});
    for (const double value : {point.omega, point.over})
      if (std::isfinite(value)) found.landmarks.push_back({value, std::abs(value)});
    if (std::isfinite(point.damping_ratio)) found.landmarks.push_back({point.damping_ratio, damping});
  };
  for (const observables::ResponseBranch& branch : branches) {
    if (branch.points.empty()) continue;
    add_landmarks(branch.points.front());
    add_landmarks(branch.points.back());
    for (const observables::ResponseEvent& event : branch.events)
      if (std::isnan(event.point.truncation_estimate)) add_landmarks(event.point);
    for (const observables::ResponsePoint& mark : branch.marks) add_landmarks(mark);
  }
  return found;
}

OrderSelection::OrderSelection(const scene::Scene& scene)
    : wanted_(scene.harmonics.accuracy),
      highest_(scene.harmonics.order),
      period_(scene.harmonics.period),
      samples_(scene.harmonics.samples) {
  int excited = lowest_order;
  for (const scene::Part& part : scene.excitation) excited = std::max(excited, part.harmonic);
  order_ = std::min(rounded_up(excited * period_, period_), highest_);
}

void set_order_of_starts(scene::Scene& scene) {
  scene.harmonics.accuracy = 0;
  scene.harmonics.order = std::min(scene.harmonics.order, order_of_starts * scene.harmonics.period);
}

void OrderSelection::set_order(scene::Scene& scene) const {
  scene.harmonics.accuracy = 0;
  scene.harmonics.chosen = true;
  scene.harmonics.order = order_;
  const double per_period = std::pow(static_cast<double>(order_) / (period_ * lowest_order), samples_rate);
  const double samples =
      std::max({static_cast<double>(samples_), fewest_samples * period_ * per_period, 4.0 * order_ + 4});
  const double whole = std::ceil(std::min(samples, static_cast<double>(scene::largest_samples)) / period_);
  scene.harmonics.samples = static_cast<int>(whole) * period_;
}

// no_value if there is nothing to compare with.
double OrderSelection::error_by_change(const Truncation& found) const {
  if (orders_.empty() || last_.failed || last_.landmarks.size() != found.landmarks.size()) return no_value;
  double change = std::fmax(std::abs(found.amplitude - last_.amplitude) / found.amplitude, found.change);
  for (std::size_t i = 0; i < found.landmarks.size(); ++i) {
    const double difference = std::abs(found.landmarks[i].value - last_.landmarks[i].value);
    if (difference > 0) change = std::max(change, difference / found.landmarks[i].size);
  }
  const double ratio = static_cast<double>(order_) / orders_.back();
  return change / std::max(std::pow(ratio, rate_of_changes) - 1, 1.0);
}

bool OrderSelection::is_confirmed(const Truncation& found) const {
  return found.responses == 0 || (!orders_.empty() && found.responses == last_.responses);
}

bool OrderSelection::rises(const Truncation& found) {
  const bool failed_twice = found.failed && last_.failed;
  error_ = found.estimate > 0 ? found.estimate / found.amplitude : found.estimate;
  if (found.flagged || std::isnan(found.estimate)) {
    const double by_change = error_by_change(found);
    error_ = std::isnan(found.estimate) || std::isnan(by_change) ? by_change : std::max(error_, by_change);
  }
  if (found.failed) error_ = no_value;
  confirmed_ = is_confirmed(found);
  orders_.push_back(order_);
  errors_.push_back(error_);
  last_ = found;
  ended_ = found.ended;
  if (ended_ || (is_reached() && confirmed_) || failed_twice || order_ >= highest_) return false;
  order_ = next();
  return true;
}

void OrderSelection::give_up() {
  order_ = orders_.back();
  given_up_ = true;
}

int OrderSelection::next() const {
  double growth = growth_where_unknown;
  if (std::isfinite(error_) && !(is_reached() && !confirmed_)) {
    double rate = friction_rate;
    if (const std::size_t n = errors_.size(); n > 1 && errors_[n - 2] > errors_[n - 1] && errors_[n - 1] > 0)
      rate = std::clamp(std::log(errors_[n - 2] / errors_[n - 1]) /
                            std::log(static_cast<double>(orders_[n - 1]) / orders_[n - 2]),
                        slowest_rate, fastest_rate);
    growth = std::min(std::pow(safety * error_ / wanted_, 1 / rate), largest_growth);
  }
  return std::min(rounded_up(std::max(growth * order_, order_ + 1.0 * period_), period_), highest_);
}

// Estimates are linear in what the harmonics left out change: larger ones than the response say nothing.
double OrderSelection::reported_error() const {
  return error_ > largest_estimate ? no_value : error_;
}

void OrderSelection::tell(results::End& end) const {
  results::Value::List orders(orders_.begin(), orders_.end());
  end.facts.push_back({"accuracy", results::Object{{"wanted", wanted_},
                                                   {"error", reported_error()},
                                                   {"order", orders_.empty() ? order_ : orders_.back()},
                                                   {"orders", std::move(orders)}}});
  const std::string with = " with harmonics up to " + std::to_string(order_);
  const auto append = [](std::string& text, const std::string& more) {
    text += (text.empty() ? "" : "; ") + more;
  };
  if (is_reached() && !confirmed_)
    append(end.doubt, (orders_.size() > 1 ? "the number of responses changes with the harmonics, to "
                                          : "no second order confirms the number of responses, ") +
                          std::to_string(last_.responses) + with);
  if (is_reached())
    append(end.remark, "accuracy " + to_two_digits(error_) + with);
  else if (!ended_ && (end.status == results::Status::complete || !last_.failed))
    append(end.doubt, "the accuracy " + results::shortest(wanted_) + " is not reached: " +
                          (std::isfinite(reported_error()) ? to_two_digits(reported_error())
                                                           : "the error is not known") +
                          with + (given_up_ ? ", since a higher order was interrupted" : ""));
}

}  // namespace arcslip::studies
