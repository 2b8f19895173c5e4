#include <arcslip/hbm/problem.hpp>

#include <arcslip/continuation/linear/finite.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace arcslip::hbm {

using continuation::Evaluated;
using continuation::Needs;

namespace {

// From so many linear coordinates, and up to so many unknowns, Newton's method alone takes 1 to 15 % fewer
// instructions than with chord steps; with 40 unknowns it takes up to 11 % more.
constexpr int many_linear = 20, few_unknowns = 24;
constexpr double worth_sharing = 250e-6;  // s, of all elements; waking the threads takes some 10 us

}  // namespace

HbmEvaluator::~HbmEvaluator() = default;

HbmEvaluator::HbmEvaluator(const HbmProblem& problem)
    : model_(problem.shared_model()),
      displacements_(problem.coordinates().unknowns * problem.harmonics().size()),
      stiffness_(*model_, problem.coordinates(), problem.harmonics()),
      workers_(problem.workers()),
      u_(problem.size()),
      R_(u_.size()),
      jacobian_(Eigen::MatrixXd()) {
  for (std::size_t e = 0; e < model_->elements.size(); ++e) {
    const auto& element = model_->elements[e];
    Part part{element.law->element(problem.harmonics(), problem.sampling()),
              problem.map_of(e),
              element.law->rate_dependent(),
              &element,
              {},
              {}};
    part.fields.resize(element.field_count);
    part.motion.resize(part.map.size());
    derivative_.resize(std::max(derivative_.size(), part.motion.size()));
    product_.resize(derivative_.size());
    parts_.push_back(std::move(part));
    latest_to_leave_.push_back(e);
  }
}

Evaluated HbmEvaluator::move_to(continuation::In u, continuation::In p, Needs needs) {
  return move(u, p, needs, nullptr);
}

Evaluated HbmEvaluator::move_next_to(const HbmEvaluator& other, continuation::In u, continuation::In p,
                                     Needs needs) {
  return move(u, p, needs, other.stiffness().is_at(p) ? &other.stiffness() : nullptr);
}

Evaluated HbmEvaluator::move(continuation::In u, continuation::In p, Needs needs,
                             const DynamicStiffness* lent) {
  const bool jacobian = needs == Needs::jacobian;
  if (!jacobian && !assembled_) assemble();
  if (!(p[model::frequency] > 0) || !model::within_bounds(*model_, p)) return Evaluated::outside_domain;
  if (!continuation::all_finite(u) || !continuation::all_finite(p)) return Evaluated::failed;
  u_ = u;
  p_ = p;
  force_factor_ = p[p.size() - 1];
  lent_ = lent;
  if (!lent_ && !stiffness_.move_to(p)) return Evaluated::outside_domain;
  assembled_ = !jacobian;
  R_.tail(R_.size() - displacements_).setZero();
  stiffness().residual(u_, force_factor_, R_);
  move_all(u_, p, jacobian);
  for (const Part& part : parts_) part.map.add(part.element->force(), R_);
  return continuation::all_finite(R_) ? Evaluated::ok : Evaluated::failed;
}

void HbmEvaluator::move_all(const continuation::In& u, const continuation::In& p, bool jacobian) {
  using Clock = std::chrono::steady_clock;
  double& seconds = seconds_[jacobian];
  if (workers_ && seconds > worth_sharing)
    return workers_->run(parts_.size(), [&](std::size_t e) { move(parts_[e], u, p, jacobian); });
  const auto begin = workers_ ? Clock::now() : Clock::time_point();
  for (Part& part : parts_) move(part, u, p, jacobian);
  if (workers_) seconds = std::chrono::duration<double>(Clock::now() - begin).count();
}

void HbmEvaluator::move(Part& part, const continuation::In& u, const continuation::In& p, bool jacobian) {
  part.of->set_fields(p, part.fields);
  part.map.gather(u, part.motion);
  if (part.rate_dependent) part.element->set_frequency(model_->harmonics.base_frequency(p[model::frequency]));
  part.element->move_to(part.motion, part.fields, jacobian);
}

Evaluated HbmEvaluator::test_piece(continuation::In u, continuation::In p, std::uint64_t piece,
                                   continuation::PieceTest test, bool& inside) {
  if (!assembled_) assemble();
  if (!(p[model::frequency] > 0) || !model::within_bounds(*model_, p)) return Evaluated::outside_domain;
  if (!continuation::all_finite(u) || !continuation::all_finite(p)) return Evaluated::failed;
  inside = true;
  if (piece != tested_piece_) {  // not known which of its parts are in it
    move_all(u, p, false);
    inside = this->piece() == piece;
    if (!inside) return Evaluated::ok;
    for (Part& part : parts_) part.tested = part.element->piece();
    tested_piece_ = piece;
    return Evaluated::ok;
  }
  for (auto at = latest_to_leave_.begin(); at != latest_to_leave_.end(); ++at) {
    Part& part = parts_[*at];
    move(part, u, p, false);
    inside = part.element->piece() == part.tested;
    if (!inside) {
      std::rotate(latest_to_leave_.begin(), at, at + 1);
      return Evaluated::ok;
    }
    if (test == continuation::PieceTest::part) return Evaluated::ok;
  }
  return Evaluated::ok;
}

const continuation::Jacobian& HbmEvaluator::jacobian() const {
  if (!assembled_) assemble();
  return jacobian_;
}

void HbmEvaluator::assemble() const {
  auto& J = std::get<Eigen::MatrixXd>(jacobian_);
  J.setZero(R_.size(), R_.size());
  for (const Part& part : parts_) part.map.add(part.element->jacobian(), J);
  stiffness().add_to(J);
  assembled_ = true;
}

void HbmEvaluator::jacobian_of_order(int n, Eigen::MatrixXd& J_n) const {
  J_n.setZero();
  for (const Part& part : parts_) part.map.add_order(n, part.element->jacobian(), J_n);
  stiffness().add_order(n, J_n);
}

void HbmEvaluator::apply_jacobian(In x, continuation::Out y) const {
  y.tail(y.size() - displacements_).setZero();
  stiffness().residual(x, 0, y);
  for (const Part& part : parts_) {
    auto w = derivative_.head(part.map.size()), product = product_.head(part.map.size());
    part.map.gather(x, w);
    product.noalias() = part.element->jacobian() * w;
    part.map.add(product, y);
  }
}

void HbmEvaluator::parameter_derivative(int k, continuation::Out dR) const {
  dR.tail(dR.size() - displacements_).setZero();
  if (k == static_cast<int>(model_->parameters.size())) {  // the excitation factor
    stiffness().force(dR);
    dR = -dR;
    return;
  }
  stiffness().parameter_derivative(k, u_, force_factor_, dR);
  for (const Part& part : parts_) {
    auto dF = derivative_.head(part.map.size());
    if (k == model::frequency && part.rate_dependent) {
      part.element->frequency_derivative(dF);
      dF *= model_->harmonics.base_frequency(1);
      part.map.add(dF, dR);
    }
    for (const model::Share& share : part.of->shares) {
      if (!share.number.depends_on(k)) continue;
      part.element->field_derivative(share.field, dF);
      if (const double rate = share.factor * share.number.rate(p_, k); rate != 1) dF *= rate;
      part.map.add(dF, dR);
    }
  }
}

std::uint64_t HbmEvaluator::piece() const {
  std::uint64_t hash = elements::empty_hash;
  for (const Part& part : parts_) hash = elements::hashed(hash, part.element->piece());
  return hash;
}

HbmProblem::HbmProblem(std::shared_ptr<const model::Model> model, const Harmonics& harmonics,
                       double displacement, double frequency, std::optional<double> about)
    : model_(std::move(model)),
      harmonics_(harmonics),
      sampling_{model_->settings.friction == scene::Friction::exact, model_->settings.samples},
      coordinates_(hbm::coordinates(*model_, about.value_or(frequency))),
      blocks_(coordinates_.unknowns),
      parameters_(model_->parameters),
      displacement_(displacement) {
  parameters_[model::frequency].scale = frequency;
  parameters_.push_back({"excitation_factor", "-", 1, 1, 0, 1e300});
  for (const auto& element : model_->elements) blocks_ += element.law->auxiliary();
  if (model_->threads > 1 && model_->elements.size() > 1)
    workers_ = std::make_shared<control::Workers>(
        std::min(model_->threads, static_cast<int>(model_->elements.size())));
}

HbmProblem::HbmProblem(const HbmProblem& other, double displacement) : HbmProblem(other) {
  displacement_ = displacement;
}

HbmProblem::HbmProblem(const HbmProblem& other, const Harmonics& harmonics,
                       const elements::Sampling& sampling)
    : HbmProblem(other) {
  harmonics_ = harmonics;
  sampling_ = sampling;
}

std::unique_ptr<HbmEvaluator> HbmProblem::hbm_evaluator() const {
  return std::make_unique<HbmEvaluator>(*this);
}

std::unique_ptr<continuation::Evaluator> HbmProblem::evaluator() const {
  return hbm_evaluator();
}

std::unique_ptr<continuation::LinearSolver> HbmProblem::linear_solver() const {
  std::vector<int> groups;
  for (int i = 0; i < blocks_; ++i) {
    for (int k = 0; k < harmonics_.cosines(); ++k) groups.push_back(k);
    for (int k = 0; k < harmonics_.sines(); ++k)
      groups.push_back(harmonics_.cosine_index(harmonics_.sine_order(k)));
  }
  return continuation::dense_lu_by_groups(groups);
}

bool HbmProblem::chord_pays() const {
  return coordinates_.linear() < many_linear || size() > few_unknowns;
}

Vector HbmProblem::scales() const {
  Vector scales = Vector::Constant(size(), displacement_);
  const Vector p = continuation::parameter_values(*this);
  Eigen::Index at = coordinates_.unknowns * harmonics_.size();
  for (const auto& element : model_->elements) {
    const Eigen::Index size = element.law->auxiliary() * harmonics_.size();
    if (size > 0) scales.segment(at, size).setConstant(element.law->auxiliary_scale(element.fields(p)));
    at += size;
  }
  return scales;
}

ElementMap HbmProblem::map_of(std::size_t e) const {
  const auto& element = model_->elements[e];
  std::vector<ElementMap::Share> shares;
  int block = 0;
  const auto add = [&](const model::Direction& direction, double phase) {
    const Vector d = coordinates_.P.leftCols(coordinates_.unknowns).transpose() * direction;
    for (int i = 0; i < coordinates_.unknowns; ++i)
      if (std::abs(d[i]) > 1e-12 * d.norm()) shares.push_back({block, i, d[i], phase});
  };
  for (std::size_t i = 0; i < element.directions.size(); ++i, ++block) {
    add(element.directions[i], 0);
    if (!element.next.empty() && element.next[i].size() > 0) add(element.next[i], -model_->sector->phase());
  }
  int own = coordinates_.unknowns;
  for (std::size_t before = 0; before < e; ++before) own += model_->elements[before].law->auxiliary();
  for (int k = 0; k < element.law->auxiliary(); ++k) shares.push_back({block++, own++, 1});
  return {std::move(shares), block, harmonics_};
}

Vector parameters_at(const HbmProblem& problem, double omega) {
  Vector p = continuation::parameter_values(problem);
  p[model::frequency] = omega;
  return p;
}

}  // namespace arcslip::hbm
