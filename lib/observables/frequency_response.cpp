#include <arcslip/observables/frequency_response.hpp>

#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/unbounded.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace arcslip::observables {
namespace {

using continuation::StopReason;
using continuation::Vector;

constexpr double beyond_display =
    1e6;  // |u| in scales: where it is asked whether the response is bounded at all
constexpr double next_to_pole = 100;  // |u| in scales: where the far side of an unbounded peak is taken up

Status status_of(StopReason reason) {
  switch (reason) {
    case StopReason::boundary:
      return Status::complete;
    case StopReason::user:
    case StopReason::point_limit:
      return Status::stopped;
    default:
      return Status::failed;
  }
}

// All combinations of the for_each lists, the last one fastest.
std::vector<std::vector<std::pair<std::string, double>>> combinations(const scene::Study& study) {
  std::vector<std::vector<std::pair<std::string, double>>> all{{}};
  for (const auto& [name, values] : study.for_each) {
    decltype(all) longer;
    for (const auto& begun : all)
      for (double value : values) {
        longer.push_back(begun);
        longer.back().emplace_back(name, value);
      }
    all = std::move(longer);
  }
  return all;
}

// One branch over the window [from, to], and what has to be known to go on beyond an unbounded peak.
class Sweep {
 public:
  Sweep(const scene::Scene& scene, const scene::Study& study, const ProgressCallback& progress, int index,
        int count)
      : unit_(scene::to_rad_per_s(scene.frequency_unit)),
        unit_name_(scene::unit_name(scene.frequency_unit)),
        lower_(study.from * unit_),
        upper_(study.to * unit_),
        progress_(progress),
        index_(index),
        count_(count),
        model_(std::make_shared<const model::Model>(model::build(scene))) {}

  std::vector<ResponseBranch> run(const std::vector<std::pair<std::string, double>>& set, bool& stopped) {
    std::vector<ResponseBranch> branches;
    double from = lower_;
    for (int piece = 0; piece <= 2 * model_->dofs; ++piece) {
      branches.push_back(trace_from(from, set));
      stopped = branches.back().stop.reason == name(StopReason::user);
      if (branches.back().stop.reason != "unbounded" || !(far_side_ < upper_)) break;
      from = far_side_;
    }
    return branches;
  }

 private:
  ResponseBranch trace_from(double from, const std::vector<std::pair<std::string, double>>& set) {
    const auto began = std::chrono::steady_clock::now();
    ResponseBranch result;
    describe(result, set);

    std::vector<std::pair<double, double>> course;  // frequency, |u| in scales
    double last = from;
    Unboundedness growth;
    const auto record = [&](Observer& observer, const continuation::Accepted& now,
                            const continuation::Event* event) {
      if (event) {
        result.events.push_back({event->monitor, event->nonsmooth, event->located, observer.observe(now)});
        return true;
      }
      const double omega = now.p[model::frequency];
      course.emplace_back(omega, now.u.norm() / observer.problem().displacement());
      if (course.back().second > beyond_display && course[course.size() - 2].second <= beyond_display) {
        growth = unboundedness(observer.problem(), now.p, now.u);
        if (growth.unbounded) return false;
      }
      result.points.push_back(observer.observe(now));
      if (!progress_) return true;
      const Progress progress{index_,
                              count_,
                              static_cast<long>(course.size()),
                              omega / unit_,
                              (omega - last) / unit_,
                              std::clamp((omega - lower_) / (upper_ - lower_), 0.0, 1.0)};
      last = omega;
      return progress_(progress);
    };
    const auto traced = frequency_branch(model_, {lower_, upper_}, from, record);
    result.solver.unknowns = traced.problem->size();
    finish(result, traced, growth, course);
    result.solver.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result;
  }

  void describe(ResponseBranch& result, const std::vector<std::pair<std::string, double>>& set) const {
    result.set = set;
    for (const auto& parameter : model_->parameters) {
      const bool is_set =
          std::any_of(set.begin(), set.end(), [&](const auto& s) { return s.first == parameter.name; });
      if (parameter.name != "frequency" && !is_set)
        result.parameters.emplace_back(parameter.name, parameter.value);
    }
    const auto& h = model_->harmonics;
    for (int i = 0; i < h.cosines(); ++i) result.harmonics.push_back(h.cosine_order(i));
    result.solver.linear_solver = "dense LU";
  }

  void finish(ResponseBranch& result, const FrequencyBranch& traced, const Unboundedness& growth,
              const std::vector<std::pair<double, double>>& course) {
    const continuation::Branch& branch = traced.branch;
    const auto& counts = branch.counts;
    result.solver.points = counts.points;
    result.solver.rejected_steps = counts.rejected_steps;
    result.solver.residuals = counts.residuals;
    result.solver.jacobians = counts.jacobians;
    result.solver.factorizations = counts.factorizations;
    result.solver.solves = counts.solves;
    if (growth.unbounded) {
      end_unbounded(result, growth, course);
      return;
    }
    result.status = status_of(branch.stop.reason);
    result.stop = {name(branch.stop.reason), branch.stop.value, branch.stop.limit, branch.stop.message};
    if (branch.stop.reason == StopReason::start_failed) {
      result.stop.value = branch.stop.value / unit_;
      result.stop.message =
          "no periodic response was found at " + text(result.stop.value) + " " + unit_name_ +
          ": Newton's method failed from rest, from the response without elements, and along a "
          "growing excitation";
    } else if (branch.stop.reason == StopReason::boundary) {
      result.stop.value = result.stop.limit = branch.stop.value / unit_;
      result.stop.message = "reached the end of the window at " + text(result.stop.value) + " " + unit_name_;
    } else if (!growth.message.empty()) {
      result.stop.message += "; " + growth.message;
    }
  }

  // The peak at infinity, and where the branch is to be taken up on the other side of the pole: as far beyond
  // it as it was before.
  void end_unbounded(ResponseBranch& result, const Unboundedness& growth,
                     const std::vector<std::pair<double, double>>& course) {
    const double omega = course.back().first;
    result.status = Status::complete;
    result.stop = {"unbounded", growth.dissipation, growth.input,
                   growth.message + ", near " + text(omega / unit_) + " " + unit_name_};
    ResponseEvent peak;
    peak.kind = "peak";
    peak.point.omega = omega;
    peak.point.unbounded = true;
    result.events.push_back(std::move(peak));
    far_side_ = upper_;
    for (auto it = course.rbegin(); it != course.rend(); ++it) {
      if (it->second > next_to_pole) continue;
      far_side_ = 2 * omega - it->first;
      break;
    }
  }

  static std::string text(double x) {
    std::ostringstream s;
    s.precision(8);
    s << x;
    return s.str();
  }

  double unit_;
  std::string unit_name_;
  double lower_, upper_;
  const ProgressCallback& progress_;
  int index_, count_;
  std::shared_ptr<const model::Model> model_;
  double far_side_ = 0;
};

}  // namespace

std::vector<ResponseBranch> frequency_response(const scene::Scene& scene, const scene::Study& study,
                                               const ProgressCallback& progress) {
  const auto all = combinations(study);
  std::vector<ResponseBranch> branches;
  bool stopped = false;
  for (std::size_t k = 0; k < all.size() && !stopped; ++k) {
    scene::Scene with = scene;
    for (const auto& [name, value] : all[k]) scene::set(with, name, value);
    Sweep sweep(with, study, progress, static_cast<int>(k), static_cast<int>(all.size()));
    for (auto& branch : sweep.run(all[k], stopped)) branches.push_back(std::move(branch));
  }
  return branches;
}

}  // namespace arcslip::observables
