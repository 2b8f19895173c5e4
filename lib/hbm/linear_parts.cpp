#include <arcslip/hbm/linear_parts.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::hbm {
namespace {

using Kind = PartInY::Kind;

constexpr double rounding = 1e-13;  // of a direction in y, relative to its largest entry

Complex factor_rate(Kind kind, double s) {
  if (kind == Kind::mass) return -2 * s;
  return kind == Kind::damper ? Complex(0, 1) : 0;
}

// The complex amplitude a - i b of a force; of the mean, it is a.
Complex amplitude(int harmonic, double cosine, double sine) {
  return {cosine, harmonic == 0 ? 0.0 : -sine};
}

}  // namespace

DirectionInY::DirectionInY(const Eigen::MatrixXd& P, const model::Direction& in_x) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(P.cols());
  for (model::Direction::InnerIterator x(in_x); x; ++x) d += x.value() * P.row(x.index()).transpose();
  const double least = rounding * d.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (d[i] != 0 && std::abs(d[i]) >= least) entries_.emplace_back(i, d[i]);
}

LinearParts::LinearParts(const model::Model& model, const Eigen::MatrixXd& P,
                         const elements::Harmonics& harmonics,
                         std::shared_ptr<const FixedInterfaceModes> modes)
    : period_(harmonics.period), size_(P.cols()), modes_(std::move(modes)) {
  changes_.reserve(most_changes + 1);
  const auto add = [&](Kind kind, const std::vector<model::LinearPart>& parts) {
    for (const model::LinearPart& part : parts)
      parts_.push_back({kind, part.parameter, {P, part.direction}, std::nan("")});
  };
  add(Kind::mass, model.masses);
  add(Kind::damper, model.dampers);
  add(Kind::spring, model.springs);
  for (const model::Excitation& excitation : model.excitation) {
    ForceInY force{excitation, harmonics.excited(excitation.harmonic), {}, 0};
    if (!excitation.moves_base()) force.terms.push_back({-1, {P, excitation.direction}});
    for (const model::LinearPart& mass : model.masses) {
      const double along = excitation.moves_base() ? mass.direction.dot(excitation.direction) : 0;
      if (along != 0) force.terms.push_back({mass.parameter, {P, model::Direction(along * mass.direction)}});
    }
    forces_.push_back(std::move(force));
  }
  if (modes_) return;
  for (Eigen::MatrixXd* sum : {&matrices_.M, &matrices_.C, &matrices_.K}) sum->setZero(size_, size_);
}

double LinearParts::modal_value(const PartInY& part) const {
  const bool known = part.parameter < modes_->p.size() && (part.kind != Kind::damper || modes_->damped);
  return known ? modes_->p[part.parameter] : 0;
}

void LinearParts::move_to(In p) {
  base_frequency_ = p[model::frequency] / period_;
  p_ = p;
  for (ForceInY& force : forces_)
    force.given = amplitude(force.harmonic, p[force.of.cosine], p[force.of.sine]);
  bool same = true;
  for (PartInY& part : parts_) {
    same = same && part.value == p[part.parameter];
    part.value = p[part.parameter];
  }
  if (!same) set_values();
}

void LinearParts::set_values() {
  changes_.clear();
  modal_ = modes_ != nullptr;
  for (const PartInY& part : parts_) {
    if (!modal_) break;
    const double by = part.value - modal_value(part);
    if (by != 0) changes_.push_back({&part, by});
    modal_ = changes_.size() <= most_changes;
  }
  if (modal_) return;
  const auto matrix_of = [&](Kind kind) -> Eigen::MatrixXd& {
    if (kind == Kind::mass) return matrices_.M;
    return kind == Kind::damper ? matrices_.C : matrices_.K;
  };
  for (const Kind kind : {Kind::mass, Kind::damper, Kind::spring}) matrix_of(kind).setZero(size_, size_);
  for (const PartInY& part : parts_) {
    Eigen::MatrixXd& sum = matrix_of(part.kind);
    for (const auto& [j, at_j] : part.direction.entries())
      for (const auto& [i, at_i] : part.direction.entries()) sum(i, j) += part.value * at_i * at_j;
  }
}

void LinearParts::add(const ForceInY& force, Complex amplitude, ComplexVector& f) const {
  for (const ForceInY::Term& term : force.terms) term.direction.add(amplitude * value(term), f);
}

void LinearParts::force(int n, ComplexVector& f) const {
  f.setZero();
  for (const ForceInY& force : forces_)
    if (force.harmonic == n) add(force, force.of.factor(p_[model::frequency]) * force.given, f);
}

Complex LinearParts::base_displacement(int n, const model::Direction& direction) const {
  Complex sum = 0;
  for (const ForceInY& force : forces_)
    if (force.harmonic == n && force.of.moves_base())
      sum += force.of.displacement(p_[model::frequency]) * direction.dot(force.of.direction) * force.given;
  return sum;
}

Complex LinearParts::base_derivative(int k, int n, const model::Direction& direction) const {
  const double w = p_[model::frequency];
  Complex sum = 0;
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n || !force.of.moves_base()) continue;
    Complex rate = force.of.displacement(w) * amplitude(n, force.of.cosine == k, force.of.sine == k);
    if (k == model::frequency) rate += force.of.displacement_rate(w) * force.given;
    sum += direction.dot(force.of.direction) * rate;
  }
  return sum;
}

bool LinearParts::depend_on(int k) const {
  return k == model::frequency ||
         std::any_of(parts_.begin(), parts_.end(),
                     [k](const PartInY& part) { return part.parameter == k; }) ||
         std::any_of(forces_.begin(), forces_.end(),
                     [k](const ForceInY& force) { return force.of.cosine == k || force.of.sine == k; });
}

void LinearParts::differentiate(int k, int n, const ComplexVector& y, double force_factor,
                                ComplexVector& v) const {
  const double s = n * base_frequency_;
  v.setZero();
  const auto by_frequency = [&](Kind kind) {
    return static_cast<double>(n) * factor_rate(kind, s) / static_cast<double>(period_);
  };
  const auto add_part = [&](const PartInY& part, Complex rate) {  // of value * g
    if (rate != 0.0) part.direction.add(rate * part.direction.along(y), v);
  };
  if (k != model::frequency) {
    for (const PartInY& part : parts_)
      if (part.parameter == k) add_part(part, stiffness_factor(part.kind, s));
  } else if (modal_) {
    modes_->M.add_product(by_frequency(Kind::mass), y, v);
    modes_->C.add_product(by_frequency(Kind::damper), y, v);
    for (const ChangedPart& change : changes_)
      add_part(*change.part, by_frequency(change.part->kind) * change.by);
  } else {
    for (const PartInY& part : parts_) add_part(part, by_frequency(part.kind) * part.value);
  }
  const double w = p_[model::frequency];
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n) continue;
    Complex rate = force.of.factor(w) * amplitude(n, force.of.cosine == k, force.of.sine == k);
    if (k == model::frequency) rate += force.of.factor_rate(w) * force.given;
    if (rate != 0.0) add(force, -force_factor * rate, v);
    for (const ForceInY::Term& term : force.terms)
      if (term.mass == k) term.direction.add(-force_factor * force.of.factor(w) * force.given, v);
  }
}

double LinearParts::quadratic_form(Kind kind, const ComplexVector& y) const {
  double sum = 0;
  if (!modal_) {
    for (const PartInY& part : parts_)
      if (part.kind == kind) sum += part.value * std::norm(part.direction.along(y));
    return sum;
  }
  const ModalMatrix& whole = kind == Kind::mass ? modes_->M : kind == Kind::damper ? modes_->C : modes_->K;
  sum = whole.form(y);
  for (const ChangedPart& change : changes_)
    if (change.part->kind == kind) sum += change.by * std::norm(change.part->direction.along(y));
  return sum;
}

QuadraticForms LinearParts::quadratic_forms(int n, const ComplexVector& y, double force_factor) const {
  QuadraticForms forms{quadratic_form(Kind::mass, y), quadratic_form(Kind::damper, y),
                       quadratic_form(Kind::spring, y), 0};
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n) continue;
    const Complex amplitude = force_factor * force.of.factor(p_[model::frequency]) * force.given;
    for (const ForceInY::Term& term : force.terms)
      forms.force += amplitude * value(term) * std::conj(term.direction.along(y));
  }
  return forms;
}

}  // namespace arcslip::hbm
