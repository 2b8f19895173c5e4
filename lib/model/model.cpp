#include <arcslip/model/model.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace arcslip::model {

namespace {

constexpr double unnamed = 1e-6;  // of what a row or coordinate without a name counts as drifting
constexpr double held = 1e-12;    // a mean position: its stiffness relative to that of its springs

}  // namespace

int parameter_index(const Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    if (model.parameters[k].name == name) return static_cast<int>(k);
    known.push_back(model.parameters[k].name);
  }
  const std::string close = scene::nearest(name, known);
  throw scene::ParameterError("no parameter \"" + name + "\"" + (close.empty() ? "" : "; nearest: " + close));
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
    fields[static_cast<std::size_t>(share.field)] += share.factor * p[share.parameter];
}

// Of the mean, the amplitude is a.
std::complex<double> Excitation::amplitude(continuation::In p) const {
  const std::complex<double> given(p[cosine], harmonic == 0 ? 0.0 : -p[sine]);
  return imaginary ? given * std::complex<double>(0, 1) : given;
}

std::complex<double> Excitation::amplitude_rate(int k) const {
  const std::complex<double> rate(cosine == k, harmonic == 0 || sine != k ? 0.0 : -1.0);
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
      g += p[mass.parameter] * mass.direction.dot(excitation.direction) * mass.direction;
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
    for (const LinearPart& part : parts) add_outer(p[part.parameter], part.direction, sum);
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

namespace {

// A contact that opens, along its normal, or a stop. Of a ring: where all sectors move alike.
struct OpeningContact {
  const NonlinearPart& element;
  Direction normal;
  std::vector<double> fields;
  double stiffness;  // N/m: the largest

  // N, where it is held at x.
  double force(const elements::Harmonics& h, const Eigen::VectorXd& x) const {
    const double displacement = normal.dot(x);
    if (element.law->has_normal_load()) return element.law->normal_load_at(fields, displacement);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(h.size());
    u[h.cosine_index(0)] = displacement;
    return element.law->force_at(h, u, fields, std::array{0.0})(0, 0);
  }
};

Direction in_phase_along(const NonlinearPart& element, std::size_t i) {
  return in_phase(element.directions[i], element.next.empty() ? Direction() : element.next[i]);
}

// Those that are open at rest, or just touch.
std::vector<OpeningContact> contacts_open_at_rest(const Model& model, const continuation::Vector& p) {
  std::vector<OpeningContact> found;
  for (const NonlinearPart& element : model.elements) {
    const bool is_stop = element.directions.size() == 1 && !element.law->dissipative();
    if (!element.law->has_normal_load() && !is_stop) continue;
    const std::size_t normal = element.directions.size() - 1;
    const std::vector<double> fields = element.fields(p);
    const auto traits = element.law->traits(fields, static_cast<int>(normal));
    if (!traits.holds_mean && traits.stiffness > 0 && std::isfinite(traits.stiffness))
      found.push_back({element, in_phase_along(element, normal), fields, traits.stiffness});
  }
  return found;
}

Eigen::VectorXd constant_force(const Model& model, const continuation::Vector& p) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(model.dofs);
  for (const Excitation& excitation : model.excitation)
    if (excitation.harmonic == 0) f += excitation.amplitude(p).real() * shape(model, excitation, p);
  return f;
}

// The stiffness of the springs and of the laws that hold a mean position.
Eigen::MatrixXd stiffness_at_rest(const Model& model, const continuation::Vector& p) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    add_outer(p[spring.parameter], in_phase(spring.direction, spring.next), K);
  for (const MatrixPart& part : model.matrices)
    if (part.kind == LinearKind::spring || part.kind == LinearKind::circulatory) K += part.value(p) * *part.A;
  for (const NonlinearPart& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const auto traits = element.law->traits(element.fields(p), static_cast<int>(i));
      if (traits.holds_mean && std::isfinite(traits.stiffness))
        add_outer(traits.stiffness, in_phase_along(element, i), K);
    }
  return K;
}

constexpr double soft = 1e-9;     // of the stiffness of a row: springs that hold all of it meanwhile
constexpr double carries = 1e-6;  // of the constant force: less does not close a contact
constexpr int static_steps = 50;

// Of contacts that are open at rest, those that the constant forces close: in the static equilibrium of the
// structure on them and on very soft springs, by Newton's method.
std::vector<Direction> closed_by_constant_force(const Model& model, const continuation::Vector& p) {
  const auto contacts = contacts_open_at_rest(model, p);
  const Eigen::VectorXd f = constant_force(model, p);
  if (contacts.empty() || !(f.cwiseAbs().maxCoeff() > 0)) return {};
  Eigen::MatrixXd K = stiffness_at_rest(model, p), resting = K;
  for (const OpeningContact& contact : contacts) add_outer(contact.stiffness, contact.normal, resting);
  K.diagonal() += soft * resting.cwiseAbs().rowwise().maxCoeff();
  if (!K.allFinite() || K.diagonal().cwiseAbs().minCoeff() == 0) return {};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.dofs);
  continuation::LU<double> lu(model.dofs);
  Eigen::VectorXd correction(model.dofs);
  std::vector<bool> closed(contacts.size()), last;
  for (int step = 0; step < static_steps && closed != last; ++step) {
    Eigen::MatrixXd tangent = K;
    Eigen::VectorXd residual = K * x - f;
    last = closed;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const double force = contacts[c].force(model.harmonics, x);
      closed[c] = force != 0;
      residual += force * contacts[c].normal;
      if (closed[c]) add_outer(contacts[c].stiffness, contacts[c].normal, tangent);
    }
    lu.factorize(tangent);
    lu.solve(residual, correction);
    x -= correction;
    if (step == 0) last.clear();
  }
  std::vector<Direction> found;
  for (const OpeningContact& contact : contacts)
    if (std::abs(contact.force(model.harmonics, x)) * contact.normal.norm() > carries * f.norm())
      found.push_back(contact.normal);
  return found;
}

}  // namespace

std::optional<int> drifting_dof(const Model& model, const continuation::Vector& p, bool in_stick) {
  if (model.harmonics.odd) return {};
  // Springs of any stiffness hold what they are between: a stiff link takes nothing from the softer ones.
  // Only where some are negative, or beside matrices, it takes their values to tell.
  const bool by_value = !model.matrices.empty() ||
                        std::any_of(model.springs.begin(), model.springs.end(),
                                    [&](const LinearPart& spring) { return p[spring.parameter] < 0; });
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(model.dofs, model.dofs);
  for (const LinearPart& spring : model.springs)
    if (const double k = p[spring.parameter]; k != 0)
      if (const Direction d = in_phase(spring.direction, spring.next); d.squaredNorm() > 0)
        add_outer(by_value ? k : 1 / d.squaredNorm(), d, K);
  for (const MatrixPart& part : model.matrices)
    if (part.kind == LinearKind::spring || part.kind == LinearKind::circulatory) K += part.value(p) * *part.A;
  const double largest = K.cwiseAbs().maxCoeff(), typical = largest > 0 ? largest : 1;
  for (const NonlinearPart& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i)
      if (const auto traits = element.law->traits(element.fields(p), static_cast<int>(i));
          traits.holds_mean || (in_stick && traits.holds_in_stick))
        add_outer(typical, in_phase_along(element, i), K);
  for (const Direction& normal : closed_by_constant_force(model, p)) add_outer(typical, normal, K);
  if (!K.allFinite()) return {};  // overflow: nothing is known
  const Eigen::VectorXd size = K.cwiseAbs().rowwise().maxCoeff();
  for (int i = 0; i < model.dofs; ++i)
    if (size[i] == 0) return i;
  const Eigen::VectorXd scale = size.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * K * scale.asDiagonal();
  const auto modes = [&]() -> continuation::SymmetricModes {
    if (is_symmetric(model)) return continuation::symmetric_modes(scaled);
    auto [values, V] = continuation::singular_values(scaled);
    return {std::move(values), std::move(V)};
  }();
  Eigen::Index softest = 0, dof = 0;
  if (modes.values.cwiseAbs().minCoeff(&softest) > held) return {};
  Eigen::VectorXd share = (scale.asDiagonal() * modes.V.col(softest)).cwiseAbs();
  share.segment(model.unnamed_from, model.unnamed_to - model.unnamed_from) *= unnamed;
  share.maxCoeff(&dof);
  return static_cast<int>(dof);
}

std::string told(const Model& model, int dof) {
  if (dof >= model.unnamed_from && dof < model.unnamed_to) return "the structure";
  return '"' + model.dof_names[static_cast<std::size_t>(dof)] + '"';
}

}  // namespace arcslip::model
