#include <arcslip/observables/mechanical_energy.hpp>

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr int instants_per_order = 8;  // looked at, for each order of the energy
constexpr int interval_halvings = 52;  // of the time between two of them
constexpr int laps = 2;                // after which the memory no longer knows where it began

// The displacements of an element at one instant.
Vector displacements(const elements::Law& law, const elements::Harmonics& h, elements::In motion,
                     const Vector& phi) {
  Vector q(law.directions());
  for (int i = 0; i < law.directions(); ++i) q[i] = motion.segment(i * h.size(), h.size()).dot(phi);
  return q;
}

// The memory of a law of one direction at an angle, marched there from the middle of the motion.
Vector marched(elements::TimeLaw& law, int memory, const elements::Harmonics& h, elements::In motion,
               double theta) {
  elements::Reversals reversals(h);
  std::vector<elements::Reversal> turns = reversals.find(motion.head(h.size()));
  const std::size_t found = turns.size();
  for (std::size_t i = 0; h.odd && i < found; ++i)
    turns.push_back({turns[i].theta + std::numbers::pi, -turns[i].x});
  Vector z = Vector::Zero(memory);
  if (turns.empty()) return z;
  const auto [low, high] =
      std::minmax_element(turns.begin(), turns.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  z.setConstant(0.5 * (low->x + high->x));
  Vector q = Vector::Constant(1, turns.front().x), f(1), dq(1);
  elements::StepEnd end(1, memory);
  law.begin(q, z, end);
  f = end.f;
  const auto go_to = [&](double x) {
    dq[0] = x - q[0];
    law.step({q, z, f}, dq, end);
    q[0] = x;
    z += end.dz;
    f = end.f;
  };
  for (int lap = 0; lap < laps; ++lap)
    for (std::size_t i = 1; i <= turns.size(); ++i) go_to(turns[i % turns.size()].x);
  const double from = turns.front().theta,
               ahead = theta - from - turn_angle * std::floor((theta - from) / turn_angle);
  for (std::size_t i = 1; i < turns.size() && turns[i].theta - from < ahead; ++i) go_to(turns[i].x);
  go_to(elements::series_values(h, motion.head(h.size()), theta).x);
  return z;
}

// The elastic energy of an element at one angle (rad) of the motion, J: law.stored() with the memory that the
// law has there. motion: its coefficients as for Element::move_to(). One force determines as many memories as
// it has directions; more, as those of many sliders, come from a march between the reversals of the motion,
// after two periods. 0 of laws whose force depends on the velocity.
double stored_energy(const elements::Law& law, elements::Fields fields, const elements::Harmonics& h,
                     elements::In motion, double theta) {
  Vector q(law.directions()), z = Vector::Zero(law.memory());
  for (int i = 0; i < law.directions(); ++i)
    q[i] = elements::series_values(h, motion.segment(i * h.size(), h.size()), theta).x;
  const auto in_time = law.in_time(fields);
  if (law.memory() > law.directions())
    z = marched(*in_time, law.memory(), h, motion, theta);
  else if (law.memory() > 0)
    in_time->memory_at(q, law.force_at(h, motion, fields, {&theta, 1}).row(0).transpose(), z);
  return in_time->stored(q, z);
}

}  // namespace

MechanicalEnergy::MechanicalEnergy(std::shared_ptr<const hbm::HbmProblem> problem, const Vector& rest,
                                   const Vector& p)
    : problem_(std::move(problem)), rest_(rest) {
  const model::Model& model = problem_->model();
  const Vector own = model::defaults(model);
  M_ = model::mass_matrix(model, own);
  K_ = model::stiffness_matrix(model, own);
  const elements::Harmonics& h = problem_->harmonics();
  const int count = instants_per_order * (h.order + 1) * (h.odd ? 1 : 2);
  basis_.resize(h.size(), count);
  for (int k = 0; k < count; ++k) elements::series_basis(h, h.span() * k / count, basis_.col(k));
  phi_.resize(h.size());
  elements::series_basis(h, 0, phi_);
  const auto at = problem_->hbm_evaluator();
  const bool known = at->move_to(rest, p, continuation::Needs::residual) == continuation::Evaluated::ok;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const elements::Law& law = *model.elements[e].law;
    Element element{model.elements[e].fields(own), Vector::Zero(law.directions()),
                    Vector::Zero(law.directions())};
    if (known) {
      element.q = displacements(law, h, at->element_motion(e), phi_);
      element.f = displacements(law, h, at->element(e).force(), phi_);
      element.stored = stored_energy(law, element.fields, h, at->element_motion(e), 0);
    }
    elements_.push_back(std::move(element));
  }
}

void MechanicalEnergy::move_to(const hbm::HbmEvaluator& at, continuation::In u) {
  const elements::Harmonics& h = problem_->harmonics();
  const Eigen::MatrixXd& P = problem_->coordinates().P;
  x_ = at.stiffness().motion(P, u, at.force_factor());
  velocity_.resize(x_.rows(), x_.cols());
  acceleration_.resize(x_.rows(), x_.cols());
  for (Eigen::Index i = 0; i < x_.cols(); ++i) {
    elements::series_slope(h, x_.col(i), velocity_.col(i));
    elements::series_slope(h, velocity_.col(i), acceleration_.col(i));
  }
  velocity_ *= at.stiffness().base_frequency();
  x_ -= at.stiffness().motion(P, rest_, at.force_factor());
}

double MechanicalEnergy::kinetic(double theta) {
  elements::series_basis(problem_->harmonics(), theta, phi_);
  now_.noalias() = velocity_.transpose() * phi_;
  return 0.5 * now_.dot(M_ * now_);
}

double MechanicalEnergy::potential(const hbm::HbmEvaluator& at, double theta) {
  const elements::Harmonics& h = problem_->harmonics();
  elements::series_basis(h, theta, phi_);
  now_.noalias() = x_.transpose() * phi_;
  double sum = 0.5 * now_.dot(K_ * now_);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const elements::Law& law = *problem_->model().elements[e].law;
    const Element& rest = elements_[e];
    const elements::In motion = at.element_motion(e);
    sum += stored_energy(law, rest.fields, h, motion, theta) - rest.stored -
           rest.f.dot(displacements(law, h, motion, phi_) - rest.q);
  }
  return sum;
}

double MechanicalEnergy::at_angle(const hbm::HbmEvaluator& at, continuation::In u, double theta) {
  move_to(at, u);
  return kinetic(theta) + potential(at, theta);
}

double MechanicalEnergy::of(const hbm::HbmEvaluator& at, continuation::In u) {
  const elements::Harmonics& h = problem_->harmonics();
  move_to(at, u);
  // The largest kinetic energy: of the instants, then where its power is zero next to that.
  Eigen::Index best = 0;
  const Eigen::MatrixXd v = velocity_.transpose() * basis_;
  v.cwiseProduct(M_ * v).colwise().sum().maxCoeff(&best);
  const double step = h.span() / static_cast<double>(basis_.cols());
  double from = step * static_cast<double>(best - 1), to = step * static_cast<double>(best + 1);
  for (int k = 0; k < interval_halvings; ++k) {
    const double middle = 0.5 * (from + to);
    elements::series_basis(h, middle, phi_);
    now_.noalias() = velocity_.transpose() * phi_;
    (now_.dot(M_ * (acceleration_.transpose() * phi_)) > 0 ? from : to) = middle;
  }
  const double theta = 0.5 * (from + to);
  return kinetic(theta) + potential(at, theta);
}

}  // namespace arcslip::observables
