// How the amplitude of harmonic balance converges for each law, as CSV: example, samples (0: exact
// integrals), order N, error relative to the reference, and amplitude. The reference is the periodic motion
// of the exact march from event to event; of a law that has none, harmonic balance with N = 401.
//
//   build/release/bench/arcslip_error_over_order > error_over_order.csv
//   gnuplot -c bench/error_over_order.gp error_over_order.csv docs/figures/error_over_order.png

#include "sampled.hpp"
#include "scenes.hpp"

#include <arcslip/fourier/series_maximum.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <Eigen/LU>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace {

using namespace arcslip;
using continuation::Vector;

// The force sampled in time, with the Jacobian of the exact one.
class SampledElement final : public elements::Element {
 public:
  SampledElement(std::shared_ptr<const elements::Law> law, const elements::Harmonics& h, int samples)
      : law_(std::move(law)), h_(h), samples_(samples), exact_(law_->element(h, {})) {}

  void move_to(elements::In u, std::span<const double> fields, bool jacobian) override {
    exact_->move_to(u, fields, jacobian);
    bench::Sampled sampled(*law_, {fields.begin(), fields.end()}, h_, samples_);
    force_ = sampled.coefficients(u).reshaped();
  }
  const Eigen::VectorXd& force() const override { return force_; }
  const Eigen::MatrixXd& jacobian() const override { return exact_->jacobian(); }
  void field_derivative(int field, elements::Out dF) const override { exact_->field_derivative(field, dF); }

 private:
  std::shared_ptr<const elements::Law> law_;
  elements::Harmonics h_;
  int samples_;
  std::unique_ptr<elements::Element> exact_;
  Eigen::VectorXd force_;
};

class SampledLaw final : public elements::Law {
 public:
  SampledLaw(std::shared_ptr<const elements::Law> law, int samples)
      : law_(std::move(law)), samples_(samples) {}

  int directions() const override { return law_->directions(); }
  elements::Facts facts() const override { return {.antisymmetric = law_->antisymmetric()}; }
  elements::Traits traits(elements::Fields fields, int direction) const override {
    return law_->traits(fields, direction);
  }
  double stiffness(elements::Fields fields, int direction, double reach) const override {
    return law_->stiffness(fields, direction, reach);
  }
  std::unique_ptr<elements::Element> element(const elements::Harmonics& h,
                                             const elements::Sampling&) const override {
    return std::make_unique<SampledElement>(law_, h, samples_);
  }
  Eigen::MatrixXd force_at(const elements::Harmonics& h, elements::In u, elements::Fields fields,
                           elements::Angles angles) const override {
    return law_->force_at(h, u, fields, angles);
  }
  std::unique_ptr<elements::TimeLaw> in_time(elements::Fields fields) const override {
    return law_->in_time(fields);
  }

 private:
  std::shared_ptr<const elements::Law> law_;
  int samples_;
};

struct Balanced {
  std::shared_ptr<const hbm::HbmProblem> problem;
  Vector p, u;

  double amplitude() const {
    const auto at = problem->hbm_evaluator();
    at->move_to(u, p, continuation::Needs::residual);
    Vector x(problem->harmonics().size());
    at->stiffness().response(u, at->force_factor(), x);
    return elements::LargestValue(problem->harmonics()).of(x);
  }
};

std::shared_ptr<const hbm::HbmProblem> problem_of(scene::Scene scene, int order, int samples) {
  scene.harmonics.order = order;
  auto model = std::make_shared<model::Model>(model::build(scene));
  for (auto& element : model->elements)
    if (samples > 0) element.law = std::make_shared<SampledLaw>(element.law, samples);
  return std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-4, 25);
}

Balanced exact(const scene::Scene& scene, double frequency, int order) {
  Balanced result{problem_of(scene, order, 0), {}, {}};
  result.p = hbm::parameters_at(*result.problem, frequency * scene::to_rad_per_s(scene.frequency_unit));
  const auto u = hbm::steady_state(result.problem, result.p).u;
  if (!u) throw std::runtime_error("no response");
  result.u = *u;
  return result;
}

// Newton's method with the Jacobian of the exact law, which is nearly that of the samples.
Balanced sampled(const scene::Scene& scene, Balanced from, int order, int samples) {
  from.problem = problem_of(scene, order, samples);
  const auto at = from.problem->hbm_evaluator();
  for (int k = 0; k < 60; ++k) {
    at->move_to(from.u, from.p, continuation::Needs::jacobian);
    const Vector step = std::get<Eigen::MatrixXd>(at->jacobian()).partialPivLu().solve(at->residual());
    from.u -= step;
    if (step.norm() < 1e-12 * from.u.norm()) break;
  }
  return from;
}

double reference(const scene::Scene& scene, double frequency) {
  const Balanced near = exact(scene, frequency, 55);
  const auto equation = time::equation_of_motion(near.problem->model(), near.p);
  time::EventDriven integrator(equation);
  const auto found = time::periodic_motion(integrator, time::state_of(*near.problem, near.u, near.p), {}, {});
  if (!found.converged()) throw std::runtime_error("no periodic motion");
  return found.period.amplitude;
}

enum class Comparison { march, order_401 };
enum class Steps { sampled, none };  // none: in time it is many sliders

void table(const char* name, const scene::Scene& scene, double frequency,
           Comparison nearby = Comparison::march, Steps steps = Steps::sampled) {
  const double amplitude =
      nearby == Comparison::march ? reference(scene, frequency) : exact(scene, frequency, 401).amplitude();
  for (const int order : {1, 3, 5, 7, 11, 15, 21, 27, 39, 55, 77, 101, 143, 201}) {
    const Balanced balanced = exact(scene, frequency, order);
    const auto row = [&](int samples, double found) {
      std::printf("%s,%d,%d,%.3e,%.12e\n", name, samples, order, std::abs(found / amplitude - 1), found);
      std::fflush(stdout);
    };
    row(0, balanced.amplitude());
    for (const int samples : {512, 4096}) {
      if (steps == Steps::none) break;
      row(samples, sampled(scene, balanced, order, samples).amplitude());
    }
  }
}

scene::Scene joint(const char* fields, double force) {
  std::ostringstream text;
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "x", "value": 1}],
    "dampers": [{"name": "c", "at": "x", "value": 0.02}]},
    "elements": [{"name": "joint", "at": "x", "type": "iwan", )"
       << fields << R"(}], "excitation": [{"name": "f", "at": "x", "cosine": )" << force << "}]}";
  std::istringstream in(text.str());
  return scene::read(in, studies::catalogue());
}

}  // namespace

int main() {
  std::puts("example,samples,order,error,amplitude");
  scene::Scene blade = bench::example("al_sayed_2011");
  scene::set(blade, "damper.normal_load", 3);
  table("jenkins", blade, 20);
  scene::Scene stop = bench::example("unilateral_oscillator");
  scene::set(stop, "stop.stiffness", 5);
  table("gap_spring", stop, 0.65);
  scene::Scene pad = bench::example("rubbing_pad");
  table("contact_2d closed", pad, 95);
  scene::set(pad, "force.cosine", 20);
  table("contact_2d", pad, 95);
  scene::Scene orbit = bench::example("orbiting_pad");
  scene::set(orbit, "lift.cosine", 15);
  table("contact_3d closed", orbit, 34, Comparison::order_401);
  scene::set(orbit, "lift.cosine", 60);
  table("contact_3d", orbit, 34, Comparison::order_401);
  table("iwan table",
        joint(R"("distribution": "table", "table": [[0.5, 0.05], [0.4, 0.1], [0.5, 0.2], [0.6, 0.4]])", 0.3),
        1.2);
  table("iwan", joint(R"("stiffness": 2, "slip_force": 1.5)", 0.3), 1.2, Comparison::order_401, Steps::none);
}
