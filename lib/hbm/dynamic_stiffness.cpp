#include <arcslip/hbm/dynamic_stiffness.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::hbm {
namespace {

constexpr double pole =
    1e-14;  // pivot of the linear coordinates, relative to the largest entry of its column
constexpr double rounding = 1e-13;  // of a direction in y, relative to its largest entry
constexpr Eigen::Index few = 16;  // unknowns, up to which blocks of a factorization cost more than they save
constexpr double sparse_share = 0.1;  // of the multiplications of dense factors, each of which costs less

using Complex = std::complex<double>;
using Sparse = continuation::ComplexSparseLU::Matrix;

// a - b c, without the tests for infinity of operator*.
Complex less_product(Complex a, Complex b, Complex c) {
  return {a.real() - b.real() * c.real() + b.imag() * c.imag(),
          a.imag() - b.real() * c.imag() - b.imag() * c.real()};
}

// B := A^-1 B for a small A, which is overwritten, by elimination with row pivots. False: A is singular.
bool eliminate(Eigen::MatrixXcd& A, Eigen::MatrixXcd& B) {
  const Eigen::Index n = A.rows(), m = B.cols();
  std::array<double, few> least;
  for (Eigen::Index k = 0; k < n; ++k)
    least[static_cast<std::size_t>(k)] = pole * pole * A.col(k).cwiseAbs2().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = 0;
    const double square = A.col(k).tail(n - k).cwiseAbs2().maxCoeff(&pivot);
    if (!(square > least[static_cast<std::size_t>(k)])) return false;
    if (pivot > 0) {
      A.row(k).tail(n - k).swap(A.row(k + pivot).tail(n - k));
      B.row(k).swap(B.row(k + pivot));
    }
    const Complex inverse = std::conj(A(k, k)) / square;
    A(k, k) = inverse;
    for (Eigen::Index i = k + 1; i < n; ++i) A(i, k) *= inverse;
    for (Eigen::Index j = k + 1; j < n; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) A(i, j) = less_product(A(i, j), A(i, k), A(k, j));
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index i = k + 1; i < n; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
  }
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index k = n - 1; k >= 0; --k) {
      B(k, j) *= A(k, k);
      for (Eigen::Index i = 0; i < k; ++i) B(i, j) = less_product(B(i, j), A(i, k), B(k, j));
    }
  return true;
}

}  // namespace

DynamicStiffness::DynamicStiffness(const model::Model& model, const Coordinates& coordinates,
                                   const Harmonics& harmonics)
    : model_(model),
      harmonics_(harmonics),
      r_(coordinates.unknowns),
      l_(coordinates.linear()),
      P_(coordinates.P),
      response_(P_.transpose() * model.response),
      masses_(in_y(model.masses)),
      dampers_(in_y(model.dampers)),
      springs_(in_y(model.springs)),
      rhs_(l_, r_ + 2),
      q_(r_),
      y_(r_ + l_),
      v_(r_ + l_),
      full_f_(r_ + l_) {
  for (const auto* parts : {&model.masses, &model.dampers, &model.springs})
    for (const auto& part : *parts) structural_parameters_.push_back(part.parameter);
  for (const auto& force : model.forces) force_directions_.push_back(P_.transpose() * force.direction);
  structural_.assign(structural_parameters_.size(), std::nan(""));
  const auto H = static_cast<std::size_t>(harmonics.cosines());
  Z_.assign(H, Matrixc(r_, r_));
  f_.assign(H, Vectorc(r_));
  W_.assign(H, Matrixc(l_, r_ + 2));
  last_p_ = Vector::Constant(static_cast<Eigen::Index>(model.parameters.size()), std::nan(""));
  if (l_ > few) choose_sparse();
  if (!sparse_lu_) {
    lu_ = continuation::LU<Complex>(l_);
    Zll_.resize(l_, l_);
  }
}

// Each degree of freedom of a large structure is linked to few others, and so is each coordinate in y.
void DynamicStiffness::choose_sparse() {
  const double n = l_;
  Matrixc linked = Matrixc::Identity(l_, l_);
  for (const auto* parts : {&masses_, &dampers_, &springs_})
    for (const PartInY& part : *parts) {
      const auto links = static_cast<double>(part.direction.size());
      if (links * links > sparse_share * n * n) return;
      for (const auto& [j, at_j] : part.direction)
        for (const auto& [i, at_i] : part.direction)
          if (i >= r_ && j >= r_) linked(i - r_, j - r_) = 1;
    }
  sparse_Zll_ = linked.sparseView();
  if (static_cast<double>(sparse_Zll_.nonZeros()) > sparse_share * n * n) return;
  sparse_lu_.emplace(sparse_Zll_);
  if (sparse_lu_->multiplications() > sparse_share * n * n * n / 3) sparse_lu_.reset();
}

// A stiff part stands in its own row and column there; what rounding leaves of it in others is taken out:
// added to softer ones, it would leave nothing of them. Directions are mostly zeros.
std::vector<DynamicStiffness::PartInY> DynamicStiffness::in_y(
    const std::vector<model::LinearPart>& parts) const {
  std::vector<PartInY> all;
  for (const model::LinearPart& part : parts) {
    Vector d = Vector::Zero(P_.cols());
    for (Eigen::Index i = 0; i < part.direction.size(); ++i)
      if (part.direction[i] != 0) d += part.direction[i] * P_.row(i).transpose();
    const double least = rounding * d.cwiseAbs().maxCoeff();
    all.push_back({part.parameter, {}});
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (d[i] != 0 && std::abs(d[i]) >= least) all.back().direction.emplace_back(i, d[i]);
  }
  return all;
}

void DynamicStiffness::assemble(In p) {
  bool same = true;
  for (std::size_t k = 0; k < structural_.size(); ++k) {
    same = same && structural_[k] == p[structural_parameters_[k]];
    structural_[k] = p[structural_parameters_[k]];
  }
  if (same) return;
  const auto add_up = [&](const std::vector<PartInY>& parts, Eigen::MatrixXd& sum) {
    sum.setZero(P_.cols(), P_.cols());
    for (const PartInY& part : parts)
      for (const auto& [j, at_j] : part.direction)
        for (const auto& [i, at_i] : part.direction) sum(i, j) += p[part.parameter] * at_i * at_j;
  };
  add_up(masses_, M_);
  add_up(dampers_, C_);
  add_up(springs_, K_);
}

bool DynamicStiffness::move_to(In p) {
  if (p.head(last_p_.size()) == last_p_) return true;
  assemble(p);
  last_p_.setConstant(std::nan(""));
  omega_ = p[model::frequency];
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    const auto index = static_cast<std::size_t>(h);
    const double n = harmonics_.cosine_order(h), s = n * omega_;
    full_f_.setZero();
    for (std::size_t which = 0; which < model_.forces.size(); ++which) {
      const model::Force& force = model_.forces[which];
      if (force.harmonic != harmonics_.cosine_order(h)) continue;
      const Complex amplitude(p[force.cosine], n == 0 ? 0.0 : -p[force.sine]);
      full_f_ += amplitude * force_directions_[which];
    }
    const auto entry = [&](Eigen::Index i, Eigen::Index j) {
      return Complex(K_(i, j) - s * s * M_(i, j), s * C_(i, j));
    };
    Matrixc& Z = Z_[index];
    for (Eigen::Index j = 0; j < r_; ++j)
      for (Eigen::Index i = 0; i < r_; ++i) Z(i, j) = entry(i, j);
    f_[index] = full_f_.head(r_);
    if (l_ == 0) continue;

    for (Eigen::Index j = 0; j < l_; ++j) {
      for (Eigen::Index i = 0; i < r_; ++i) rhs_(j, i) = entry(r_ + j, i);
      rhs_(j, r_) = full_f_[r_ + j];
      rhs_(j, r_ + 1) = response_[r_ + j];
    }
    Matrixc& W = W_[index];
    if (sparse_lu_) {
      for (int j = 0; j < l_; ++j)
        for (Sparse::InnerIterator at(sparse_Zll_, j); at; ++at) at.valueRef() = entry(r_ + at.row(), r_ + j);
      if (!sparse_lu_->factorize(sparse_Zll_, pole)) return false;
      W = rhs_;
      sparse_lu_->solve_in_place(W);
    } else {
      for (Eigen::Index j = 0; j < l_; ++j)
        for (Eigen::Index i = 0; i < l_; ++i) Zll_(i, j) = entry(r_ + i, r_ + j);
      if (l_ <= few) {
        W = rhs_;
        if (!eliminate(Zll_, W)) return false;
      } else {
        lu_.factorize(Zll_);
        for (Eigen::Index k = 0; k < l_; ++k)
          if (!(std::abs(lu_.pivot(k)) > pole * Zll_.col(k).cwiseAbs().maxCoeff())) return false;
        lu_.solve_columns(rhs_, W);
      }
    }
    for (Eigen::Index j = 0; j < r_; ++j)
      for (Eigen::Index i = 0; i <= j; ++i) {  // Z is symmetric
        Complex sum = Z(i, j);
        for (Eigen::Index k = 0; k < l_; ++k) sum = less_product(sum, rhs_(k, i), W(k, j));
        Z(i, j) = Z(j, i) = sum;
      }
    for (Eigen::Index i = 0; i < r_; ++i)
      for (Eigen::Index k = 0; k < l_; ++k) f_[index][i] = less_product(f_[index][i], rhs_(k, i), W(k, r_));
  }
  last_p_ = p.head(last_p_.size());
  return true;
}

// X_n of coordinate i in u; X_0 is real.
DynamicStiffness::Complex DynamicStiffness::coefficient(In x, int h) const {
  const int n = harmonics_.cosine_order(h);
  return n == 0 ? Complex(x[h], 0) : Complex(x[h], -x[harmonics_.sine_index(n)]);
}

void DynamicStiffness::gather(In u, int h, Vectorc& q) const {
  const int c = harmonics_.size(), n = harmonics_.cosine_order(h);
  for (int i = 0; i < r_; ++i)
    q[i] = n == 0 ? Complex(u[i * c + h], 0) : Complex(u[i * c + h], -u[i * c + harmonics_.sine_index(n)]);
}

void DynamicStiffness::scatter_add(const Vectorc& v, int h, Out R) const {
  const int c = harmonics_.size(), n = harmonics_.cosine_order(h);
  for (int i = 0; i < r_; ++i) {
    R[i * c + h] += v[i].real();
    if (n > 0) R[i * c + harmonics_.sine_index(n)] -= v[i].imag();
  }
}

// y = (q, Z_ll^-1 (f_l - Z_lq q))
void DynamicStiffness::expand(const Vectorc& q, int h, double force_factor, Vectorc& y) const {
  y.head(r_) = q;
  if (l_ == 0) return;
  const Matrixc& W = W_[static_cast<std::size_t>(h)];
  y.tail(l_) = force_factor * W.col(r_);
  y.tail(l_).noalias() -= W.leftCols(r_) * q;
}

// v_q - Z_ql Z_ll^-1 v_l
void DynamicStiffness::project(const Vectorc& v, int h, Vectorc& q) const {
  q = v.head(r_);
  if (l_ == 0) return;
  q.noalias() -= W_[static_cast<std::size_t>(h)].leftCols(r_).transpose() * v.tail(l_);
}

void DynamicStiffness::residual(In u, double force_factor, Out R) const {
  const int c = harmonics_.size();
  if (r_ == 1) {
    for (int h = 0; h < harmonics_.cosines(); ++h) {
      const auto index = static_cast<std::size_t>(h);
      const Complex v = Z_[index](0, 0) * coefficient(u, h) - force_factor * f_[index][0];
      R[h] = v.real();
      const int n = harmonics_.cosine_order(h);
      if (n > 0) R[harmonics_.sine_index(n)] = -v.imag();
    }
    return;
  }
  R.head(r_ * c).setZero();
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    const auto index = static_cast<std::size_t>(h);
    gather(u, h, q_);
    auto v = v_.head(r_);
    v.noalias() = Z_[index] * q_;
    v -= force_factor * f_[index];
    const int n = harmonics_.cosine_order(h);
    for (int i = 0; i < r_; ++i) {
      R[i * c + h] += v[i].real();
      if (n > 0) R[i * c + harmonics_.sine_index(n)] -= v[i].imag();
    }
  }
}

void DynamicStiffness::add_to(Eigen::MatrixXd& J) const {
  const int c = harmonics_.size();
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    const Matrixc& Z = Z_[static_cast<std::size_t>(h)];
    const int n = harmonics_.cosine_order(h);
    for (int j = 0; j < r_; ++j)
      for (int i = 0; i < r_; ++i) {
        J(i * c + h, j * c + h) += Z(i, j).real();
        if (n == 0) continue;
        const int s = harmonics_.sine_index(n);
        J(i * c + s, j * c + s) += Z(i, j).real();
        J(i * c + h, j * c + s) += Z(i, j).imag();
        J(i * c + s, j * c + h) -= Z(i, j).imag();
      }
  }
}

void DynamicStiffness::force(Out f) const {
  f.setZero();
  for (int h = 0; h < harmonics_.cosines(); ++h) scatter_add(f_[static_cast<std::size_t>(h)], h, f);
}

void DynamicStiffness::solve(Out x) const {
  const int c = harmonics_.size();
  Matrixc Z(r_, r_);
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    gather(x, h, q_);
    Z = Z_[static_cast<std::size_t>(h)];
    const Matrixc solution = continuation::solve_complex(Z, q_);
    const int n = harmonics_.cosine_order(h);
    for (int i = 0; i < r_; ++i) {
      x[i * c + h] = solution(i, 0).real();
      if (n > 0) x[i * c + harmonics_.sine_index(n)] = -solution(i, 0).imag();
    }
  }
}

bool DynamicStiffness::depends_on(int k) const {
  const auto is = [k](int parameter) { return parameter == k; };
  return k == model::frequency ||
         std::any_of(structural_parameters_.begin(), structural_parameters_.end(), is) ||
         std::any_of(model_.forces.begin(), model_.forces.end(),
                     [&](const model::Force& force) { return is(force.cosine) || is(force.sine); });
}

// dZ/dp_k y - force_factor df/dp_k at the motion y of harmonic h.
void DynamicStiffness::differentiate(int k, In u, int h, double force_factor, Vectorc& v) const {
  const double n = harmonics_.cosine_order(h), s = n * omega_;
  gather(u, h, q_);
  expand(q_, h, force_factor, y_);
  if (k == model::frequency && sparse_lu_) {
    v.setZero();
    const auto add = [&](const std::vector<PartInY>& parts, Complex factor) {
      for (const PartInY& part : parts) {
        Complex along = 0;
        for (const auto& [i, at_i] : part.direction) along += at_i * y_[i];
        along *= factor * last_p_[part.parameter];
        for (const auto& [i, at_i] : part.direction) v[i] += at_i * along;
      }
    };
    add(masses_, -2 * n * s);
    add(dampers_, Complex(0, n));
    return;
  }
  if (k == model::frequency) {
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      Complex sum = 0;
      for (Eigen::Index j = 0; j < v.size(); ++j) sum += Complex(-2 * n * s * M_(i, j), n * C_(i, j)) * y_[j];
      v[i] = sum;
    }
    return;
  }
  v.setZero();
  const auto add = [&](const std::vector<model::LinearPart>& parts, Complex factor) {
    for (const auto& part : parts) {
      if (part.parameter != k) continue;
      Complex along = 0;
      for (Eigen::Index i = 0; i < v.size(); ++i) along += P_.col(i).dot(part.direction) * y_[i];
      for (Eigen::Index i = 0; i < v.size(); ++i) v[i] += factor * along * P_.col(i).dot(part.direction);
    }
  };
  add(model_.masses, -s * s);
  add(model_.dampers, Complex(0, s));
  add(model_.springs, 1);
  for (const auto& force : model_.forces) {
    if (force.harmonic != harmonics_.cosine_order(h)) continue;
    Complex amplitude = 0;
    if (force.cosine == k) amplitude += 1;
    if (force.sine == k && n > 0) amplitude += Complex(0, -1);
    for (Eigen::Index i = 0; i < v.size(); ++i)
      v[i] -= force_factor * amplitude * P_.col(i).dot(force.direction);
  }
}

void DynamicStiffness::parameter_derivative(int k, In u, double force_factor, Out dR) const {
  dR.setZero();
  if (!depends_on(k)) return;
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    differentiate(k, u, h, force_factor, v_);
    project(v_, h, q_);
    scatter_add(q_, h, dR);
  }
}

void DynamicStiffness::response(In u, double force_factor, Out x) const {
  x.setZero();
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    gather(u, h, q_);
    expand(q_, h, force_factor, y_);
    Complex sum = 0;
    for (Eigen::Index i = 0; i < y_.size(); ++i) sum += response_[i] * y_[i];
    x[h] = sum.real();
    const int n = harmonics_.cosine_order(h);
    if (n > 0) x[harmonics_.sine_index(n)] = -sum.imag();
  }
}

void DynamicStiffness::response_transposed(In a, Out g) const {
  g.setZero();
  const int c = harmonics_.size();
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    const int n = harmonics_.cosine_order(h);
    for (int i = 0; i < r_; ++i) {
      Complex L = response_[i];  // X = L q: with a real inner product the transpose is the conjugate
      if (l_ > 0) {
        const Matrixc& W = W_[static_cast<std::size_t>(h)];
        for (Eigen::Index k = 0; k < l_; ++k) L -= response_[r_ + k] * W(k, i);
      }
      const Complex v = std::conj(L) * coefficient(a, h);
      g[i * c + h] += v.real();
      if (n > 0) g[i * c + harmonics_.sine_index(n)] -= v.imag();
    }
  }
}

void DynamicStiffness::response_derivative(int k, In u, double force_factor, Out dx) const {
  dx.setZero();
  if (l_ == 0 || !depends_on(k)) return;
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    differentiate(k, u, h, force_factor, v_);
    const Matrixc& W = W_[static_cast<std::size_t>(h)];
    Complex sum = 0;
    for (Eigen::Index i = 0; i < l_; ++i) sum -= W(i, r_ + 1) * v_[r_ + i];
    dx[h] = sum.real();
    const int order = harmonics_.cosine_order(h);
    if (order > 0) dx[harmonics_.sine_index(order)] = -sum.imag();
  }
}

double DynamicStiffness::viscous_energy(In u, double force_factor) const {
  double energy = 0;
  for (int h = 0; h < harmonics_.cosines(); ++h) {
    const double n = harmonics_.cosine_order(h);
    gather(u, h, q_);
    expand(q_, h, force_factor, y_);
    double power = 0;
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      for (Eigen::Index j = 0; j < y_.size(); ++j) power += C_(i, j) * (std::conj(y_[i]) * y_[j]).real();
    energy += std::numbers::pi * omega_ * n * n * power;
  }
  return energy;
}

QuadraticForms DynamicStiffness::quadratic_forms(int n, In u, double force_factor) const {
  const int h = harmonics_.cosine_index(n);
  gather(u, h, q_);
  expand(q_, h, force_factor, y_);
  QuadraticForms forms;
  for (Eigen::Index i = 0; i < y_.size(); ++i)
    for (Eigen::Index j = 0; j < y_.size(); ++j) {
      const double product = (std::conj(y_[i]) * y_[j]).real();
      forms.mass += M_(i, j) * product;
      forms.damping += C_(i, j) * product;
      forms.stiffness += K_(i, j) * product;
    }
  for (std::size_t which = 0; which < model_.forces.size(); ++which) {
    const model::Force& force = model_.forces[which];
    if (force.harmonic != n) continue;
    const Complex amplitude(last_p_[force.cosine], n == 0 ? 0.0 : -last_p_[force.sine]);
    for (Eigen::Index i = 0; i < y_.size(); ++i)
      forms.force += force_factor * amplitude * std::conj(y_[i]) * force_directions_[which][i];
  }
  return forms;
}

}  // namespace arcslip::hbm
