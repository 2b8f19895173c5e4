#include <arcslip/hbm/linear_parts.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::hbm {
namespace {

using Kind = PartInY::Kind;

constexpr double rounding = 1e-13;  // of a direction in y, relative to its largest entry

// g(s) and dg/ds.
Complex factor(Kind kind, double s) {
  if (kind == Kind::mass) return -s * s;
  return kind == Kind::damper ? Complex(0, s) : 1;
}
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
                         const elements::Harmonics& harmonics)
    : period_(harmonics.period) {
  const auto add = [&](Kind kind, const std::vector<model::LinearPart>& parts) {
    for (const model::LinearPart& part : parts)
      parts_.push_back({kind, part.parameter, {P, part.direction}, std::nan("")});
  };
  add(Kind::mass, model.masses);
  add(Kind::damper, model.dampers);
  add(Kind::spring, model.springs);
  for (const model::Force& force : model.forces)
    forces_.push_back({harmonics.excited(force.harmonic), force.cosine, force.sine, {P, force.direction}, 0});
  for (Eigen::MatrixXd* sum : {&matrices_.M, &matrices_.C, &matrices_.K}) sum->setZero(P.cols(), P.cols());
}

void LinearParts::move_to(In p) {
  base_frequency_ = p[model::frequency] / period_;
  for (ForceInY& force : forces_) force.amplitude = amplitude(force.harmonic, p[force.cosine], p[force.sine]);
  bool same = true;
  for (PartInY& part : parts_) {
    same = same && part.value == p[part.parameter];
    part.value = p[part.parameter];
  }
  if (same) return;
  const auto matrix_of = [&](Kind kind) -> Eigen::MatrixXd& {
    if (kind == Kind::mass) return matrices_.M;
    return kind == Kind::damper ? matrices_.C : matrices_.K;
  };
  for (const Kind kind : {Kind::mass, Kind::damper, Kind::spring}) matrix_of(kind).setZero();
  for (const PartInY& part : parts_) {
    Eigen::MatrixXd& sum = matrix_of(part.kind);
    for (const auto& [j, at_j] : part.direction.entries())
      for (const auto& [i, at_i] : part.direction.entries()) sum(i, j) += part.value * at_i * at_j;
  }
}

void LinearParts::force(int n, ComplexVector& f) const {
  f.setZero();
  for (const ForceInY& force : forces_)
    if (force.harmonic == n) force.direction.add(force.amplitude, f);
}

bool LinearParts::depend_on(int k) const {
  return k == model::frequency ||
         std::any_of(parts_.begin(), parts_.end(),
                     [k](const PartInY& part) { return part.parameter == k; }) ||
         std::any_of(forces_.begin(), forces_.end(),
                     [k](const ForceInY& force) { return force.cosine == k || force.sine == k; });
}

void LinearParts::differentiate(int k, int n, const ComplexVector& y, double force_factor,
                                ComplexVector& v) const {
  const double s = n * base_frequency_;
  v.setZero();
  for (const PartInY& part : parts_) {
    Complex rate = 0;  // of value * g
    if (k == model::frequency)
      rate = static_cast<double>(n) * factor_rate(part.kind, s) / static_cast<double>(period_) * part.value;
    if (k == part.parameter) rate += factor(part.kind, s);
    if (rate != 0.0) part.direction.add(rate * part.direction.along(y), v);
  }
  for (const ForceInY& force : forces_)
    if (force.harmonic == n && (force.cosine == k || force.sine == k))
      force.direction.add(-force_factor * amplitude(n, force.cosine == k, force.sine == k), v);
}

double LinearParts::quadratic_form(Kind kind, const ComplexVector& y) const {
  double sum = 0;
  for (const PartInY& part : parts_)
    if (part.kind == kind) sum += part.value * std::norm(part.direction.along(y));
  return sum;
}

QuadraticForms LinearParts::quadratic_forms(int n, const ComplexVector& y, double force_factor) const {
  QuadraticForms forms{quadratic_form(Kind::mass, y), quadratic_form(Kind::damper, y),
                       quadratic_form(Kind::spring, y), 0};
  for (const ForceInY& force : forces_)
    if (force.harmonic == n)
      forms.force += force_factor * force.amplitude * std::conj(force.direction.along(y));
  return forms;
}

}  // namespace arcslip::hbm
