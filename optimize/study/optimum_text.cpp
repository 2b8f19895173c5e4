#include <arcslip/optimize/study/optimum_text.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>

namespace arcslip::optimize {
namespace {

constexpr std::size_t most_cases = 24;  // lines of a table for people

std::string number(double value, double error, const char* format) {
  return std::isnan(value) ? "unknown" : results::with_error(value, error, format);
}

std::string number(double value, const char* format = "%.8g") {
  return number(value, 0, format);
}

// An amplitude in m, mm or so.
std::string metres(double value, double error = 0) {
  const results::PrefixedUnit in = results::prefixed("m", value);
  return number(in.factor * value, in.factor * error, "%.6f") + " " + in.unit;
}

std::string with_unit(const scene::Scene& scene, const std::string& parameter, double value,
                      double error = 0) {
  const std::string unit = studies::parameter_unit(scene, parameter);
  return number(value, error, "%.8g") + (unit.empty() || unit == "-" ? "" : " " + unit);
}

double error_of(double value, double estimate, const observables::Solution& at) {
  return at.truncation_flagged ? results::doubtful_error(value, estimate) : estimate;
}

// Of an amplitude at a point, without the digits that the neglected harmonics move.
std::string at_point(double amplitude, const observables::Solution& point) {
  return metres(amplitude, error_of(amplitude, point.truncation_estimate, point));
}

// Of a parameter at the optimum.
double design_error(const Optimum& found, std::size_t k) {
  if (!found.certificate || found.certificate->design_estimate.empty()) return 0;
  const double estimate = found.certificate->design_estimate[k];
  return found.certificate->design_flagged ? results::doubtful_error(found.design[k], estimate) : estimate;
}

// Of the worst case or of their mean: the largest of all.
double estimate_of(const std::vector<LoadCaseResult>& cases) {
  double largest = 0;
  for (const auto& each : cases)
    largest =
        std::max(largest, each.weight * error_of(each.amplitude, each.point.truncation_estimate, each.point));
  return largest;
}

std::string frequency(const scene::Scene& scene, const observables::Solution& point) {
  const double error = error_of(point.omega, point.location_estimate, point);
  return number(studies::in_scene_unit(scene, point.omega), studies::in_scene_unit(scene, error), "%.8f") +
         " " + std::string(scene::unit_name(scene.frequency_unit));
}

// Of a parameter at the optimum, relative; the largest.
double relative_design_error(const Optimum& found) {
  double largest = 0;
  for (std::size_t k = 0; k < found.design.size(); ++k)
    if (found.design[k] != 0) largest = std::max(largest, std::abs(design_error(found, k) / found.design[k]));
  return largest;
}

// With several friction elements their stick shares are written once, not for every case. moved: how far the
// design is off, relative, with which shares of stick change as if they were in proportion to it.
std::string place(const scene::Scene& scene, const observables::ResponsePoint& point, std::size_t most,
                  double moved) {
  std::string text = frequency(scene, point);
  std::vector<observables::ElementResponse> contacts;  // and patches
  for (const auto* list : {&point.elements, &point.patches})
    for (const auto& element : *list)
      if (element.has_stick && !element.of_patch) contacts.push_back(element);
  for (const auto& element : contacts)
    if (contacts.size() <= most)
      text += ", " + element.name + " sticks " +
              number(element.stick_percent,
                     error_of(element.stick_percent, element.stick_estimate + moved * element.stick_percent,
                              point),
                     "%.4f") +
              " %";
  return text;
}

void print_cases(std::ostream& out, const scene::Scene& scene, const OptimumResult& result) {
  const bool mean = result.problem.criterion == Criterion::mean;
  const auto& cases = result.optimum.cases;
  for (std::size_t c = 0; c < std::min(cases.size(), most_cases); ++c)
    out << "    " << case_text(scene, result.problem, cases[c]) << ": "
        << at_point(cases[c].amplitude, cases[c].point) << " at "
        << place(scene, cases[c].point, 1, relative_design_error(result.optimum))
        << (cases[c].weight == 1 ? "" : ", weight " + number(cases[c].weight, "%.4g"))
        << (cases[c].active && !mean ? ", active" : "") << '\n';
  if (cases.size() > most_cases)
    out << "    and " << cases.size() - most_cases << " more cases, listed by --json and --csv\n";
}

// The ends of a curve and its events.
void write_curve(std::ostream& out, const scene::Scene& scene, const OptimumCurveResult& result) {
  const OptimumCurve& curve = result.curve;
  for (const std::string& note : curve.notes) out << "  " << note << '\n';
  const auto line = [&](const std::string& what, const OptimumPoint& point) {
    out << "  " << curve.along << " = " << with_unit(scene, curve.along, point.along) << ": ";
    for (std::size_t k = 0; k < point.design.size(); ++k)
      out << result.problem.over[k].name << " = "
          << with_unit(scene, result.problem.over[k].name, point.design[k]) << ", ";
    out << "A_max = " << at_point(point.amplitude, point.response) << " at "
        << frequency(scene, point.response) << what << (point.minimum ? "" : ", a saddle") << '\n';
  };
  std::size_t event = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || i + 1 == curve.points.size()) line("", curve.points[i]);
    for (; event < curve.events.size() && curve.events[event].after == i; ++event) {
      std::string what = curve.events[event].kind;
      std::replace(what.begin(), what.end(), '_', ' ');
      if (!curve.events[event].parameter.empty()) what += " by " + curve.events[event].parameter;
      line(", " + what, curve.events[event].point);
    }
  }
  out << "  " << curve.points.size() << " points, " << curve.work.peaks.responses << " responses traced, "
      << number(curve.work.seconds, "%.3f") << " s: " << curve.stop.message << '\n';
}

// "d1.normal_load + 2 d2.normal_load = 6, at most 6"
void write_sums(std::ostream& out, const OptimumResult& result) {
  for (const LinearLimit& limit : result.problem.linear_limits) {
    double sum = 0;
    std::string text;
    for (const auto& [name, weight] : limit.weights) {
      text += text.empty() ? (weight < 0 ? "-" : "") : weight < 0 ? " - " : " + ";
      text += (std::abs(weight) == 1 ? "" : number(std::abs(weight)) + " ") + name;
      for (std::size_t k = 0; k < result.problem.over.size(); ++k)
        if (result.problem.over[k].name == name) sum += weight * result.optimum.design[k];
    }
    out << "  " << text << " = " << number(sum);
    if (std::isfinite(limit.at_least)) out << ", at least " << number(limit.at_least);
    if (std::isfinite(limit.at_most)) out << ", at most " << number(limit.at_most);
    out << '\n';
  }
}

const char* cut_by(bool bound, bool limit) {
  return bound ? " (a bound)" : limit ? " (a limit)" : "";
}

void write_certificate(std::ostream& out, const scene::Scene& scene, const OptimumResult& result) {
  const Certificate& certificate = *result.optimum.certificate;
  const auto& over = result.problem.over;
  for (std::size_t k = 0; k < certificate.ranges.size(); ++k) {
    const double error = design_error(result.optimum, k);  // about that of the ends
    for (const ToleranceRange& range : certificate.ranges[k])
      out << "  within " << number(100 * range.share, "%.0f") << " % for " << over[k].name << " from "
          << with_unit(scene, over[k].name, range.lower, range.lower_is_bound ? 0 : error)
          << cut_by(range.lower_is_bound, range.lower_is_limit) << " to "
          << with_unit(scene, over[k].name, range.upper, range.upper_is_bound ? 0 : error)
          << cut_by(range.upper_is_bound, range.upper_is_limit) << '\n';
  }
  for (std::size_t k = 0; k < certificate.at_bound.size(); ++k)
    if (certificate.at_bound[k] != 0)
      out << "  " << over[k].name << " is at its " << (certificate.at_bound[k] < 0 ? "lower" : "upper")
          << " bound\n";
  for (const ActiveLimit& limit : certificate.limits)
    if (limit.by_height)
      out << "  the limit on " << limit.limit << " is exceeded at a peak that is "
          << number(100 * watched_share) << " % of the highest: it applies to peaks above that share\n";
    else
      out << "  "
          << (limit.limit.starts_with("a linear") ? "the limit on a sum" : "the limit on " + limit.limit)
          << " is active: relaxing it by 1 % lowers the amplitude by about "
          << number(limit.multiplier, "%.2g") << " %\n";
  int active = 0;
  for (const auto& peak : certificate.peaks) active += peak.active;
  const bool mean = result.problem.criterion == Criterion::mean && result.optimum.cases.size() > 1;
  out << "  " << active << (active == 1 ? " active peak" : " active peaks") << (mean ? " of the cases" : "")
      << ", residual gradient " << number(certificate.stationarity, "%.1e") << '\n';
  for (const auto& other : certificate.others) {
    out << "  another response, found by " << other.found_by << ": " << metres(other.amplitude) << " at "
        << number(studies::in_scene_unit(scene, other.omega)) << ' '
        << scene::unit_name(scene.frequency_unit);
    if (result.has_cases())
      out << " with " << case_text(scene, result.problem, result.optimum.cases[other.in_case]);
    out << '\n';
  }
  if (!certificate.others_lower) out << "  it is higher than the highest peak of the branch\n";
}

void write_starts(std::ostream& out, const Optimum& found) {
  const Starts& starts = *found.starts;
  out << "  " << starts.to_optimum << " of " << starts.count << " starts led to it, within "
      << number(same_minimum) << " of the amplitude";
  if (starts.to_optimum + starts.to_none < starts.count)
    out << ", the others to minima of up to " << metres(starts.highest);
  if (starts.to_none > 0) out << "; " << starts.to_none << " ended at no minimum";
  out << '\n';
}

}  // namespace

std::string text_of(const scene::Scene& scene, const OptimumResult& result) {
  std::ostringstream out;
  const Optimum& found = result.optimum;
  if (!result.set.empty()) out << studies::assignment(scene, result.set) << '\n';
  for (const std::string& note : found.notes) out << "  " << note << '\n';
  if (found.design.empty() || !std::isfinite(found.amplitude)) {
    out << "  no optimum: " << result.stop.message << '\n';
    return out.str();
  }
  for (std::size_t k = 0; k < found.design.size(); ++k)
    out << "  " << result.problem.over[k].name << " = "
        << with_unit(scene, result.problem.over[k].name, found.design[k], design_error(found, k)) << '\n';
  if (result.has_cases()) {
    out << "  " << name(result.problem.criterion) << " of " << found.cases.size()
        << (found.cases.size() == 1 ? " case = " : " cases = ")
        << metres(found.amplitude, estimate_of(found.cases)) << '\n';
    print_cases(out, scene, result);
  } else {
    out << "  A_max = " << at_point(found.amplitude, found.point) << " at "
        << place(scene, found.point, std::numeric_limits<std::size_t>::max(), relative_design_error(found))
        << '\n';
  }
  write_sums(out, result);
  if (!found.feasible) out << "  a constraint is violated there\n";
  out << "  " << found.algorithm << ", " << found.evaluations.size() << " evaluations, "
      << found.work.responses << " responses traced, " << number(found.seconds, "%.3f")
      << " s: " << result.stop.message << '\n';
  if (found.starts) write_starts(out, found);
  if (found.certificate) write_certificate(out, scene, result);
  if (result.direct.found)
    out << "  the curve of peaks has its minimum at " << result.problem.over[0].name << " = "
        << with_unit(scene, result.problem.over[0].name, result.direct.point.over, design_error(found, 0))
        << ": relative differences " << number(result.difference_of_design(), "%.1e") << " and "
        << number(result.difference_of_amplitude(), "%.1e") << " in amplitude\n";
  else if (!result.direct.message.empty())
    out << "  " << result.direct.message << '\n';
  return out.str();
}

std::string text_of(const scene::Scene& scene, const OptimumCurveResult& result) {
  std::ostringstream out;
  if (!result.set.empty()) out << studies::assignment(scene, result.set) << '\n';
  write_curve(out, scene, result);
  return out.str();
}

namespace {

void append(std::string& text, const std::string& more) {
  if (!more.empty()) text.append(text.empty() ? "" : ", ").append(more);
}

const scene::Direction* response(const OptimumProblem& problem, const LoadCaseResult& of) {
  const bool has = of.of < problem.cases.size() && problem.cases[of.of].response;
  return has ? &*problem.cases[of.of].response : nullptr;
}

}  // namespace

std::string direction_text(const scene::Scene& scene, const scene::Direction& direction) {
  std::string text;
  for (const scene::Term& term : direction) {
    text.append(term.weight < 0 ? (text.empty() ? "-" : " - ") : text.empty() ? "" : " + ");
    if (std::abs(term.weight) != 1) text.append(results::shortest(std::abs(term.weight))).append(" ");
    text.append(scene.dofs[static_cast<std::size_t>(term.dof)]);
  }
  return text;
}

std::string case_text(const scene::Scene& scene, const OptimumProblem& problem, const LoadCaseResult& of) {
  std::string text = studies::assignment(scene, of.set);
  append(text, studies::assignment(scene, of.scatter));
  if (const auto* direction = response(problem, of))
    append(text, "response at " + direction_text(scene, *direction));
  return text.empty() ? "the scene as it is" : text;
}

std::string case_label(const scene::Scene& scene, const OptimumProblem& problem, const LoadCaseResult& of) {
  std::string text = studies::set_label(scene, of.set);
  append(text, studies::set_label(scene, of.scatter));
  if (const auto* direction = response(problem, of)) append(text, direction_text(scene, *direction));
  return text.empty() ? "as it is" : text;
}

}  // namespace arcslip::optimize
