#include <arcslip/hbm/linear/dynamic_stiffness.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::hbm {
namespace {

// Linear coordinates of which the factors of a dense matrix take some tenths of a millisecond.
constexpr Eigen::Index quick_factors = 100;

// Up to here matrices cost no more than products with two or three motions.
constexpr int most_as_matrices = 8;

Eigen::MatrixXd observed(const model::Model& model, const Eigen::MatrixXd& P) {
  Eigen::MatrixXd responses(P.cols(), 1 + static_cast<Eigen::Index>(model.others.size()));
  responses.col(0) = P.transpose() * model.response;
  for (Eigen::Index k = 1; k < responses.cols(); ++k)
    responses.col(k) = P.transpose() * model.others[static_cast<std::size_t>(k - 1)];
  return responses;
}

}  // namespace

DynamicStiffness::DynamicStiffness(const model::Model& model, const Coordinates& coordinates,
                                   const Harmonics& harmonics)
    : r_(coordinates.unknowns),
      l_(coordinates.linear()),
      layout_(harmonics),
      size_(harmonics.size()),
      responses_(observed(model, coordinates.P)),
      ground_(1 + model.others.size(), model::Direction(model.dofs)),
      takes_long_(!coordinates.modes && coordinates.linear() > quick_factors),
      control_(model.control),
      parts_(model, coordinates.P, harmonics, coordinates.modes),
      last_p_(Vector::Constant(static_cast<Eigen::Index>(model.parameters.size()), std::nan(""))),
      y_(r_ + l_),
      v_(r_ + l_) {
  if (coordinates.modes) modal_.emplace(*coordinates.modes, responses_);
  if (coordinates.modes && r_ > most_as_matrices) operator_.emplace(parts_.products(), responses_);
  if (model.absolute) {
    ground_.front() = model.response.sparseView();
    std::copy(model.others.begin(), model.others.end(), ground_.begin() + 1);
  }
  for (int h = 0; h < harmonics.cosines(); ++h) {
    const int n = harmonics.cosine_order(h);
    const bool driven = std::any_of(model.excitation.begin(), model.excitation.end(),
                                    [&](const auto& each) { return harmonics.excited(each.harmonic) == n; });
    harmonics_.push_back({n, h, n > 0 ? harmonics.sine_index(n) : 0, driven, {}, ComplexVector(r_ + l_)});
  }
}

bool DynamicStiffness::move_to(In p) {
  if (is_at(p)) return true;
  last_p_.setConstant(std::nan(""));
  parts_.move_to(p);
  const bool used_operator = std::exchange(uses_operator_, operator_ && parts_.purely_modal());
  const bool same = uses_operator_ == used_operator && !parts_.force_changed() &&
                    std::exchange(values_, -1) == parts_.changes_of_values();
  for (Harmonic& at : harmonics_) {
    if (!parts_.force_changed()) break;
    parts_.force(at.order, at.force);
    at.condensed.forced = (at.force.array() != 0.0).any();
  }
  for (Harmonic& at : harmonics_) {
    if (takes_long_ && !control_.keep_going()) return false;
    const bool is_same = uses_operator_ && same && at.order == 0;  // the mean, at each frequency
    if (!is_same && !prepare(at)) return false;
  }
  values_ = parts_.changes_of_values();
  last_p_ = p.head(last_p_.size());
  return true;
}

bool DynamicStiffness::prepare(Harmonic& at) {
  if (!uses_operator_) return condense(at);
  at.is_formed = false;
  const double s = at.order * base_frequency();
  return operator_->move_to(parts_.factors(s), s, at.modal);
}

const ComplexMatrix& DynamicStiffness::formed(Harmonic& at) const {
  if (uses_operator_ && !at.is_formed) {
    operator_->form(at.modal, at.condensed.Z);
    at.is_formed = true;
  }
  return at.condensed.Z;
}

bool DynamicStiffness::condense(Harmonic& at) {
  const double s = at.order * base_frequency();
  if (!parts_.symmetric()) {
    if (!unsymmetric_) {
      Z_ = parts_.pattern();
      unsymmetric_.emplace(Z_, r_, responses_);
    }
    parts_.dynamic_stiffness(at.order, Z_);
    return unsymmetric_->condense(Z_, at.force, at.condensed);
  }
  if (parts_.modes()) return modal_->condense(parts_, s, at.force, at.condensed);
  if (!direct_) direct_.emplace(parts_, r_, responses_);
  return direct_->condense(parts_.matrices(), parts_.factors(s), at.force, at.condensed);
}

void DynamicStiffness::gather(const In& u, const Harmonic& at) const {
  for (int i = 0; i < r_; ++i) y_[i] = at.amplitude(u, i * size_);
}

bool DynamicStiffness::is_at_rest(const In& u, const Harmonic& at) const {
  gather(u, at);
  return !at.driven && (y_.head(r_).array() == 0.0).all();
}

void DynamicStiffness::expand(const In& u, const Harmonic& at, double force_factor) const {
  gather(u, at);
  if (uses_operator_)
    operator_->expand(at.modal, at.force, force_factor, y_);
  else
    at.condensed.expand(force_factor, y_);
}

void DynamicStiffness::project(const Harmonic& at) const {
  if (uses_operator_)
    operator_->project(at.modal, v_);
  else
    at.condensed.project(v_);
}

const ComplexMatrix& DynamicStiffness::observations(Harmonic& at) const {
  return uses_operator_ ? operator_->observations(at.modal, at.force)
                        : at.condensed.of_observations(responses_);
}

Complex DynamicStiffness::observed_change(const Harmonic& at, int place) const {
  return uses_operator_ ? operator_->observed_change(at.modal, v_, place)
                        : at.condensed.observed_change(v_, place);
}

// dZ/dp_k y - force_factor df/dp_k, before condensation.
void DynamicStiffness::differentiate(int k, const In& u, const Harmonic& at, double force_factor) const {
  expand(u, at, force_factor);
  parts_.differentiate(k, at.order, y_, force_factor, v_);
}

const ComplexMatrix* DynamicStiffness::rates(int k, Harmonic& at) const {
  if (k != model::frequency || r_ > most_as_matrices || !parts_.modes() || !parts_.symmetric()) return nullptr;
  if (!at.condensed.has_rates) modal_->differentiate(parts_, at.order, at.condensed);
  return &at.condensed.rates;
}

void DynamicStiffness::scatter(const ComplexVector& q, const Harmonic& at, Out& x) const {
  for (int i = 0; i < r_; ++i) at.put(q[i], i * size_, x);
}

void DynamicStiffness::residual(In u, double force_factor, Out R) const {
  for (const Harmonic& at : harmonics_) {
    if (uses_operator_) {
      if (is_at_rest(u, at)) {
        v_.head(r_).setZero();
      } else {
        expand(u, at, force_factor);
        operator_->residual(at.modal, at.force, force_factor, y_, v_);
      }
      scatter(v_, at, R);
      continue;
    }
    gather(u, at);
    if ((y_.head(r_).array() == 0.0).all())
      v_.head(r_).setZero();
    else if (r_ <= most_as_matrices)
      v_.head(r_).noalias() = at.condensed.Z.lazyProduct(y_.head(r_));
    else
      v_.head(r_).noalias() = at.condensed.Z * y_.head(r_);
    for (int i = 0; i < r_; ++i) at.put(v_[i] - force_factor * at.condensed.f[i], i * size_, R);
  }
}

void DynamicStiffness::add_to(Eigen::MatrixXd& J) const {
  for (Harmonic& at : harmonics_) {
    const int size = size_, a = at.cosine, b = at.sine;
    const ComplexMatrix& matrix = formed(at);
    for (int j = 0; j < r_; ++j)
      for (int i = 0; i < r_; ++i) {
        const Complex Z = matrix(i, j);
        J(i * size + a, j * size + a) += Z.real();
        if (at.order == 0) continue;
        J(i * size + b, j * size + b) += Z.real();
        J(i * size + a, j * size + b) += Z.imag();
        J(i * size + b, j * size + a) -= Z.imag();
      }
  }
}

void DynamicStiffness::add_order(int n, Eigen::MatrixXd& J_n) const {
  const ComplexMatrix& Z = formed(harmonics_[static_cast<std::size_t>(layout_.cosine_index(n))]);
  for (int j = 0; j < r_; ++j)
    for (int i = 0; i < r_; ++i) {
      J_n(2 * i, 2 * j) += Z(i, j).real();
      J_n(2 * i + 1, 2 * j + 1) += Z(i, j).real();
      J_n(2 * i, 2 * j + 1) += Z(i, j).imag();
      J_n(2 * i + 1, 2 * j) -= Z(i, j).imag();
    }
}

void DynamicStiffness::force(Out f) const {
  for (const Harmonic& at : harmonics_) {
    if (uses_operator_) {
      v_ = at.force;
      project(at);
      scatter(v_, at, f);
    } else {
      scatter(at.condensed.f, at, f);
    }
  }
}

void DynamicStiffness::solve(Out x) const {
  for (Harmonic& at : harmonics_) {
    gather(x, at);
    scatter(continuation::solve_complex(formed(at), y_.head(r_)).col(0), at, x);
  }
}

void DynamicStiffness::parameter_derivative(int k, In u, double force_factor, Out dR) const {
  if (!parts_.depend_on(k)) {
    dR.setZero();
    return;
  }
  for (Harmonic& at : harmonics_) {
    if (is_at_rest(u, at)) {
      v_.head(r_).setZero();
    } else if (const ComplexMatrix* by = rates(k, at)) {
      v_.head(r_) = force_factor * by->col(r_).head(r_);
      v_.head(r_).noalias() += by->topLeftCorner(r_, r_).lazyProduct(y_.head(r_));
    } else {
      differentiate(k, u, at, force_factor);
      project(at);
    }
    scatter(v_, at, dR);
  }
}

void DynamicStiffness::add_base(const model::Direction& d, double force_factor, Out x) const {
  for (const Harmonic& at : harmonics_) {
    const Complex base = force_factor * parts_.base_displacement(at.order, d);
    x[at.cosine] += base.real();
    if (at.order > 0) x[at.sine] -= base.imag();
  }
}

void DynamicStiffness::response(In u, double force_factor, Out x, int place) const {
  for (Harmonic& at : harmonics_) {
    const auto by = observations(at).row(place);
    Complex sum = force_factor *
                  (by[r_] + parts_.base_displacement(at.order, ground_[static_cast<std::size_t>(place)]));
    for (int i = 0; i < r_; ++i) sum += by[i] * at.amplitude(u, i * size_);
    at.put(sum, 0, x);
  }
}

Eigen::MatrixXd DynamicStiffness::motion(const Eigen::MatrixXd& P, In u, double force_factor) const {
  Eigen::MatrixXd x(size_, P.rows());
  for (const Harmonic& at : harmonics_) {
    expand(u, at, force_factor);
    const ComplexVector of_dofs = P * y_;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      auto column = x.col(i);
      column[at.cosine] = of_dofs[i].real();
      if (at.order > 0) column[at.sine] = -of_dofs[i].imag();
    }
  }
  return x;
}

void DynamicStiffness::response_transposed(In a, Out g, int place) const {
  g.tail(g.size() - r_ * size_).setZero();  // further unknowns, of elements, do not move the response
  for (Harmonic& at : harmonics_) {         // L^T; with a real inner product the transpose is the conjugate
    const auto by = observations(at).row(place);
    for (int i = 0; i < r_; ++i) at.put(std::conj(by[i]) * at.amplitude(a, 0), i * size_, g);
  }
}

void DynamicStiffness::response_derivative(int k, In u, double force_factor, Out dx, int place) const {
  const model::Direction& ground = ground_[static_cast<std::size_t>(place)];
  const bool moves = ground.nonZeros() > 0;
  if ((l_ == 0 && !moves) || !parts_.depend_on(k)) {
    dx.setZero();
    return;
  }
  for (Harmonic& at : harmonics_) {
    if (is_at_rest(u, at)) {
      at.put(0, 0, dx);
      continue;
    }
    Complex change = force_factor * parts_.base_derivative(k, at.order, ground);
    if (const ComplexMatrix* by = rates(k, at)) {
      change += force_factor * (*by)(r_ + place, r_);
      for (Eigen::Index i = 0; i < r_; ++i)
        change += (*by)(r_ + place, i) * at.amplitude(u, static_cast<int>(i) * size_);
    } else {
      differentiate(k, u, at, force_factor);
      change += observed_change(at, place);
    }
    at.put(change, 0, dx);
  }
}

double DynamicStiffness::viscous_energy(In u, double force_factor) const {
  double energy = 0;
  for (const Harmonic& at : harmonics_) {
    expand(u, at, force_factor);
    energy += std::numbers::pi * at.order * parts_.damping_form(at.order, y_);
  }
  return energy;
}

QuadraticForms DynamicStiffness::quadratic_forms(int n, In u, double force_factor) const {
  expand(u, harmonics_[static_cast<std::size_t>(layout_.cosine_index(n))], force_factor);
  return parts_.quadratic_forms(n, y_, force_factor);
}

}  // namespace arcslip::hbm
