#include <arcslip/model/model.hpp>

#include <arcslip/scene/faults.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace arcslip::model {

int parameter_index(const Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    if (model.parameters[k].name == name) return static_cast<int>(k);
    known.push_back(model.parameters[k].name);
  }
  const std::string close = scene::nearest(name, known);
  throw scene::ParameterError("no parameter \"" + name + "\"" + (close.empty() ? "" : "; nearest: " + close));
}

std::vector<Number*> numbers(Model& model) {
  std::vector<Number*> all;
  for (auto* parts : {&model.masses, &model.dampers, &model.springs})
    for (LinearPart& part : *parts) all.push_back(&part.number);
  for (MatrixPart& part : model.matrices) all.push_back(&part.number);
  if (model.damping)
    all.insert(all.end(), {&model.damping->alpha, &model.damping->beta, &model.damping->loss_factor});
  for (NonlinearPart& element : model.elements)
    for (Share& share : element.shares) all.push_back(&share.number);
  for (Excitation& excitation : model.excitation)
    all.insert(all.end(), {&excitation.cosine, &excitation.sine});
  return all;
}

bool within_bounds(const Model& model, continuation::In p) {
  return std::all_of(model.formulas.begin(), model.formulas.end(), [&](const auto& number) {
    return scene::file::within(number->bounds, number->value(p));
  });
}

continuation::Vector defaults(const Model& model) {
  continuation::Vector p(static_cast<Eigen::Index>(model.parameters.size()));
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    p[static_cast<Eigen::Index>(k)] = model.parameters[k].value;
  return p;
}

std::vector<double> NonlinearPart::fields(const continuation::Vector& p) const {
  std::vector<double> values(field_count);
  set_fields(p, values);
  return values;
}

void NonlinearPart::set_fields(continuation::In p, std::span<double> fields) const {
  std::fill(fields.begin(), fields.end(), 0.0);
  for (const Share& share : shares)
    fields[static_cast<std::size_t>(share.field)] += share.factor * share.number.value(p);
}

// Of the mean, the amplitude is a.
std::complex<double> Excitation::amplitude(continuation::In p) const {
  const std::complex<double> given(cosine.value(p), harmonic == 0 ? 0.0 : -sine.value(p));
  return imaginary ? given * std::complex<double>(0, 1) : given;
}

std::complex<double> Excitation::amplitude_rate(continuation::In p, int k) const {
  const std::complex<double> rate(cosine.rate(p, k), harmonic == 0 ? 0.0 : -sine.rate(p, k));
  return imaginary ? rate * std::complex<double>(0, 1) : rate;
}

double Excitation::factor(double w) const {
  if (kind == Kind::base_displacement) return harmonic * w * (harmonic * w);
  return kind == Kind::force ? 1 : -1;
}

double Excitation::factor_rate(double w) const {
  return kind == Kind::base_displacement ? 2.0 * harmonic * harmonic * w : 0;
}

double Excitation::displacement(double w) const {
  if (kind == Kind::base_acceleration) return harmonic == 0 ? 0 : -1 / (harmonic * w * (harmonic * w));
  return kind == Kind::force ? 0 : 1;
}

double Excitation::displacement_rate(double w) const {
  return kind == Kind::base_acceleration ? -2 / w * displacement(w) : 0;
}

std::complex<double> Sector::turn(int n) const {
  const auto part = static_cast<int>(static_cast<long long>(n) * engine_order % count);
  const double angle = 2 * std::numbers::pi * part / count;
  const bool quarter = 4LL * part % count == 0;  // of which cosine and sine are whole numbers
  return {quarter ? std::round(std::cos(angle)) : std::cos(angle),
          quarter ? -std::round(std::sin(angle)) : -std::sin(angle)};
}

Direction in_phase(const Direction& d, const Direction& next) {
  return next.size() > 0 ? Direction(d + next) : d;
}

Eigen::VectorXd shape(const Model& model, const Excitation& excitation, const continuation::Vector& p) {
  Eigen::VectorXd g = Eigen::VectorXd::Zero(model.dofs);
  if (!excitation.moves_base()) {
    g = excitation.direction;
  } else {
    for (const LinearPart& mass : model.masses)
      g += mass.number.value(p) * mass.direction.dot(excitation.direction) * mass.direction;
  }
  if (excitation.load.size() > 0) g += excitation.load;
  return excitation.factor(p[frequency]) * g;
}

void add_outer(double factor, const Direction& d, Eigen::MatrixXd& sum) {
  for (Direction::InnerIterator j(d); j; ++j)
    for (Direction::InnerIterator i(d); i; ++i) sum(i.index(), j.index()) += factor * i.value() * j.value();
}

void add_outer(double factor, const Direction& d, const Direction& next, std::complex<double> turn,
               Eigen::MatrixXd& sum) {
  const Eigen::Index n = d.size();
  Direction real(2 * n), imaginary(2 * n);  // of (d + turn next) . x
  const auto add = [&](const Direction& part, std::complex<double> by) {
    for (Direction::InnerIterator i(part); i; ++i) {
      real.coeffRef(i.index()) += by.real() * i.value();
      real.coeffRef(n + i.index()) -= by.imag() * i.value();
      imaginary.coeffRef(i.index()) += by.imag() * i.value();
      imaginary.coeffRef(n + i.index()) += by.real() * i.value();
    }
  };
  add(d, 1);
  if (next.size() > 0) add(next, turn);
  add_outer(factor, real, sum);
  add_outer(factor, imaginary, sum);
}

bool is_symmetric(const Model& model) {
  return std::all_of(model.matrices.begin(), model.matrices.end(),
                     [](const MatrixPart& part) { return part.symmetric; });
}

Eigen::MatrixXd sum_of(const Model& model, LinearKind kind, const continuation::Vector& p) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  const auto& parts = kind == LinearKind::mass     ? model.masses
                      : kind == LinearKind::damper ? model.dampers
                                                   : model.springs;
  if (kind != LinearKind::circulatory)
    for (const LinearPart& part : parts) add_outer(part.number.value(p), part.direction, sum);
  for (const MatrixPart& part : model.matrices)
    if (part.kind == kind) sum += part.value(p) * *part.A;
  return sum;
}

Eigen::MatrixXd mass_matrix(const Model& model, const continuation::Vector& p) {
  return sum_of(model, LinearKind::mass, p);
}

Eigen::MatrixXd damping_matrix(const Model& model, const continuation::Vector& p) {
  Eigen::MatrixXd C = sum_of(model, LinearKind::damper, p);
  if (!model.damping) return C;
  const double alpha = model.damping->alpha_at(p), beta = model.damping->beta_at(p);
  if (alpha != 0) C += alpha * sum_of(model, LinearKind::mass, p);
  if (beta != 0) C += beta * sum_of(model, LinearKind::spring, p);
  return C;
}

Eigen::MatrixXd stiffness_matrix(const Model& model, const continuation::Vector& p) {
  return sum_of(model, LinearKind::spring, p) + sum_of(model, LinearKind::circulatory, p);
}

std::string coordinate_name(const Model& model, int dof) {
  if (dof >= model.unnamed_from && dof < model.unnamed_to) return "the structure";
  return '"' + model.dof_names[static_cast<std::size_t>(dof)] + '"';
}

}  // namespace arcslip::model
