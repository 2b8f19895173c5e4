#include <arcslip/observables/curves.hpp>

#include <arcslip/observables/special_curve.hpp>
#include <arcslip/observables/study_branches.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Crossing;
using continuation::Monitor;
using continuation::StopReason;
using continuation::Vector;

constexpr double same = 1e-6;  // special points that differ by less, relatively, are one

std::string text(double value) {
  std::ostringstream s;
  s.precision(8);
  s << value;
  return s.str();
}

// The curves of one kind over one parameter, for one setting.
class Curves {
 public:
  Curves(scene::StudyKind kind, const scene::Scene& scene, const scene::Study& study, const Setting& set,
         const ProgressCallback& report, const Progress& progress)
      : peaks_(kind == scene::StudyKind::peaks),
        what_(peaks_ ? "resonance peak" : "fold"),
        unit_(scene.frequency_unit),
        to_rad_per_s_(scene::to_rad_per_s(unit_)),
        window_{study.frequency_from * to_rad_per_s_, study.frequency_to * to_rad_per_s_},
        way_(over_parameter(scene, study.over, study.from, study.to)),
        backwards_(over_parameter(scene, study.over, study.to, study.from)),
        set_(set),
        report_(report),
        progress_(progress) {}

  std::vector<ResponseBranch> run() {
    SpecialPoints found = special_points(way_, window_, event());
    if (found.unbounded && found.points.empty()) {  // from where it is bounded, then
      const std::string why = found.failure;
      SpecialPoints other = special_points(backwards_, window_, event());
      if (!other.points.empty()) {
        std::swap(way_, backwards_);
        found = std::move(other);
      }
    }
    std::vector<ResponseBranch> branches;
    std::vector<Vector> ends;
    for (const SpecialPoint& start : found.points) {
      const auto is_start = [&](const Vector& end) { return (start.x - end).norm() <= same * end.norm(); };
      if (std::any_of(ends.begin(), ends.end(), is_start)) continue;
      const auto began = std::chrono::steady_clock::now();
      const SpecialCurve curve = trace(found.problem, start);
      auto parts = split(curve);
      SolverSummary& solver = parts.front().solver;
      solver.unknowns = found.problem->size() + 1;
      add(curve.counts, solver);
      solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      for (auto& part : parts) branches.push_back(std::move(part));
      if (curve.end.size() > 0) ends.push_back(curve.end);
      if (curve.stop.reason == StopReason::user && curve.unbounded.empty()) return branches;
    }
    if (branches.empty())
      branches.push_back(failed(StopReason::start_failed,
                                "no " + what_ + " was found at " + way_.name + " = " + text(way_.from) +
                                    " between " + frequency_text(window_.lower, unit_) + " and " +
                                    frequency_text(window_.upper, unit_) +
                                    (found.failure.empty() ? "" : ": " + found.failure)));
    return branches;
  }

 private:
  std::string event() const { return peaks_ ? "peak" : "fold"; }

  std::string place(const Vector& x) const {
    return way_.name + " = " + text(way_.from) + " and " + frequency_text(x[x.size() - 1], unit_);
  }

  ResponseBranch failed(StopReason reason, const std::string& message) const {
    ResponseBranch result = described(*way_.model, set_, way_.name);
    result.status = Status::failed;
    result.stop = {name(reason), way_.from, 0, message};
    return result;
  }

  SpecialCurve trace(const std::shared_ptr<const hbm::HbmProblem>& problem, const SpecialPoint& start) {
    const auto section = std::make_shared<CurveSection>(problem, way_.index);
    const Eigen::Index n = problem->size();
    long points = 0;
    double last = start.x[start.x.size() - 1];
    const auto progress = [&](double over, double omega) {
      progress_.points = ++points;
      progress_.frequency = omega / to_rad_per_s_;
      progress_.step = (omega - last) / to_rad_per_s_;
      progress_.share_done = way_.share(over);
      last = omega;
      return !report_ || report_(progress_);
    };
    return SpecialCurveTracer(problem, peaks_ ? peak_kind(problem) : fold_kind(), way_, window_,
                              with_folds(peaks_ ? peak_monitors(section) : fold_monitors(n)),
                              peaks_ ? peak_monitors(section) : turn_monitors(n), section, progress)
        .run(start);
  }

  static std::vector<Monitor> peak_monitors(const std::shared_ptr<CurveSection>& section) {
    const auto slope = [section](const Accepted& now) { return section->amplitude_slope(now); };
    const auto amplitude = [section](const Accepted&) { return section->last_amplitude(); };
    return {{"minimum", slope, Crossing::rising, amplitude},
            {"maximum", slope, Crossing::falling, amplitude}};
  }

  // n: where the frequency stands among the unknowns.
  static std::vector<Monitor> turn_monitors(Eigen::Index n) {
    const auto slope = [n](const Accepted& now) { return now.tangent[n]; };
    const auto frequency = [n](const Accepted& now) { return now.u[n]; };
    return {{"turn", slope, Crossing::any, frequency}};
  }

  static std::vector<Monitor> fold_monitors(Eigen::Index n) {
    auto monitors = turn_monitors(n);
    monitors.push_back(continuation::cusp_monitor());
    return monitors;
  }

  static std::vector<Monitor> with_folds(std::vector<Monitor> monitors) {
    monitors.push_back(continuation::fold_monitor());
    return monitors;
  }

  // At a cusp a curve of folds turns in everything, and where a curve of peaks turns, dA/ds = dA/dp dp/ds is
  // zero: neither is an event of its own.
  bool belongs_to_another(const SpecialCurve& curve, const SpecialCurve::EventAt& each) const {
    const char* first = peaks_ ? "fold" : "cusp";
    return each.event.kind != first && each.event.kind != "corner" &&
           std::any_of(curve.events.begin(), curve.events.end(), [&](const auto& other) {
             const auto &a = other.event.point, &b = each.event.point;
             return other.event.kind == first && std::abs(a.omega - b.omega) <= same * a.omega &&
                    std::abs(a.over - b.over) <= same * (way_.upper() - way_.lower());
           });
  }

  // A curve of peaks turns where a peak meets a minimum of the amplitude over the frequency, which the curve
  // follows from there to the next turn: that part is left out.
  std::vector<ResponseBranch> split(const SpecialCurve& curve) const {
    std::vector<ResponseBranch> parts;
    std::vector<double> turns;
    if (peaks_) {
      turns = curve.turns;
      for (const auto& each : curve.events)
        if (each.event.kind == "fold") turns.push_back(each.arclength);
      std::sort(turns.begin(), turns.end());
    }
    turns.push_back(HUGE_VAL);
    std::vector<std::pair<double, double>> course;
    for (const auto& at : curve.points) course.emplace_back(at.arclength, at.point.amplitude);
    double begin = -HUGE_VAL;
    for (std::size_t k = 0; k < turns.size(); begin = turns[k++]) {
      const double end = turns[k];
      double peaks = 0, others = 0;  // arclengths
      const SpecialCurve::At* before = nullptr;
      ResponseBranch part = described(*way_.model, set_, way_.name);
      for (const auto& at : curve.points) {
        if (!(at.arclength >= begin && at.arclength < end)) continue;
        const double length = before ? at.arclength - before->arclength : 0;
        (at.second <= 0 ? peaks : others) += length;
        before = &at;
        part.points.push_back(at.point);
      }
      if (part.points.empty() || (peaks_ && others > peaks)) continue;
      for (std::size_t i = 0; i < curve.events.size(); ++i) {
        const auto& each = curve.events[i];
        if (each.arclength < begin || each.arclength > end || belongs_to_another(curve, each)) continue;
        const bool extreme = each.event.kind == "minimum" || each.event.kind == "maximum";
        if (extreme && !departs(course, each.arclength, each.event.point.amplitude)) continue;
        part.events.push_back(each.event);
        if (peaks_ && each.arclength == begin) part.points.insert(part.points.begin(), each.event.point);
        if (peaks_ && each.arclength == end) part.points.push_back(each.event.point);
      }
      finish(part, curve, end);
      parts.push_back(std::move(part));
    }
    if (parts.empty()) {
      parts.push_back(described(*way_.model, set_, way_.name));
      finish(parts.back(), curve, HUGE_VAL);
    }
    return parts;
  }

  void finish(ResponseBranch& part, const SpecialCurve& curve, double end) const {
    const continuation::Stop& stop = curve.stop;
    part.status = status_of(stop.reason);
    part.stop = {name(stop.reason), stop.value, stop.limit, stop.message};
    if (!part.points.empty() && (end < HUGE_VAL || curve.vanishes)) {
      const ResponsePoint& last = part.points.back();
      part.status = Status::complete;
      part.stop = {
          "fold", last.over, last.over,
          (peaks_ ? "the peak meets a minimum of the amplitude over the frequency, and there is none beyond "
                  : "the fold meets another at a corner of the response, and there is none beyond ") +
              way_.name + " = " + text(last.over)};
    } else if (!curve.unbounded.empty()) {
      const ResponsePoint& last = part.points.back();
      part.status = Status::complete;
      part.stop = {"unbounded", last.over, last.over,
                   "the " + what_ + " grows without bound near " + way_.name + " = " + text(last.over) +
                       ", and beyond " + curve.unbounded};
    } else if (curve.left_window) {
      const ResponsePoint& last = part.points.back();
      part.status = Status::complete;
      part.stop = {name(StopReason::boundary), last.over, way_.to,
                   "the " + what_ + " leaves the window at " + frequency_text(last.omega, unit_) + ", at " +
                       way_.name + " = " + text(last.over)};
    } else if (stop.reason == StopReason::boundary) {
      part.stop.limit = way_.to;
      part.stop.message =
          stop.value == way_.to
              ? "reached the end of the range at " + way_.name + " = " + text(way_.to)
              : "came back to the beginning of the range at " + way_.name + " = " + text(way_.from);
    } else if (part.points.empty()) {
      part.stop.message = "no curve was begun from the " + what_ + " at " + way_.name + " = " +
                          text(way_.from) + ": " + stop.message;
    } else {
      const std::string where = way_.name + " = " + text(part.points.back().over);
      if (stop.reason == StopReason::step_too_small)
        part.stop.message =
            "the curve could not be followed beyond " + where + ": probably the " + what_ +
            " sits there at a corner of the response, where a phase of friction begins or ends";
      else
        part.stop.message += ", near " + where;
    }
  }

  bool peaks_;
  std::string what_;
  scene::FrequencyUnit unit_;
  double to_rad_per_s_;
  FrequencyWindow window_;
  OverParameter way_, backwards_;
  const Setting& set_;
  const ProgressCallback& report_;
  Progress progress_;
};

std::vector<ResponseBranch> all_curves(scene::StudyKind kind, const scene::Scene& scene,
                                       const scene::Study& study, const ProgressCallback& progress) {
  const auto all = combinations(study);
  std::vector<ResponseBranch> branches;
  for (std::size_t k = 0; k < all.size(); ++k) {
    scene::Scene with = scene;
    for (const auto& [name, value] : all[k]) scene::set(with, name, value);
    Progress of_branch;
    of_branch.branch = static_cast<int>(k);
    of_branch.branches = static_cast<int>(all.size());
    for (auto& branch : Curves(kind, with, study, all[k], progress, of_branch).run())
      branches.push_back(std::move(branch));
    if (branches.back().stop.reason == name(StopReason::user)) break;
  }
  return branches;
}

}  // namespace

std::vector<ResponseBranch> resonance_peaks(const scene::Scene& scene, const scene::Study& study,
                                            const ProgressCallback& progress) {
  return all_curves(scene::StudyKind::peaks, scene, study, progress);
}

std::vector<ResponseBranch> fold_curves(const scene::Scene& scene, const scene::Study& study,
                                        const ProgressCallback& progress) {
  return all_curves(scene::StudyKind::folds, scene, study, progress);
}

}  // namespace arcslip::observables
