#include <arcslip/hbm/linear/linear_operator.hpp>

#include <arcslip/hbm/linear/in_place_elimination.hpp>
#include <arcslip/hbm/linear/matrices_in_waves.hpp>
#include <arcslip/hbm/linear/sparsity_pattern.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::hbm {
namespace {

using model::LinearKind;

bool equal_near_frequency(const In& a, const Eigen::VectorXd& b) {
  static_assert(model::frequency == 0);
  const auto* begin = a.data() + 1;
  return std::equal(begin, a.data() + a.size(), b.data() + 1);
}

std::vector<Eigen::Index> coordinates_of(const DirectionInY& direction) {
  std::vector<Eigen::Index> all;
  for (const auto* entries : {&direction.entries(), &direction.next()})
    for (const auto& [i, at_i] : *entries) all.push_back(i);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

double entry_at(const DirectionInY::Entries& entries, Eigen::Index i) {
  const auto found = std::lower_bound(entries.begin(), entries.end(), i,
                                      [](const auto& entry, Eigen::Index at) { return entry.first < at; });
  return found != entries.end() && found->first == i ? found->second : 0;
}

}  // namespace

LinearParts::LinearParts(const model::Model& model, const Eigen::MatrixXd& P,
                         const elements::Harmonics& harmonics,
                         std::shared_ptr<const FixedInterfaceModes> modes)
    : linked_(model.linked),
      symmetric_(model::is_symmetric(model)),
      period_(harmonics.period),
      size_(P.cols()),
      modes_(std::move(modes)) {
  if (model.sector) sector_ = *model.sector;
  changes_.reserve(most_changes + 1);
  const auto add = [&](LinearKind kind, const std::vector<model::LinearPart>& parts) {
    for (const model::LinearPart& part : parts)
      parts_.push_back({kind, part.number, {P, part.direction, part.next}, std::nan("")});
  };
  add(LinearKind::mass, model.masses);
  add(LinearKind::damper, model.dampers);
  add(LinearKind::spring, model.springs);
  for (const model::MatrixPart& part : model.matrices) matrix_parts_.push_back({part});
  if (!matrix_parts_.empty()) P_ = P;
  if (modes_)
    products_.emplace(modes_);
  else
    set_waves(harmonics);
  if (!symmetric()) set_positions();
  damping_ = model.damping;
  for (const model::Excitation& excitation : model.excitation) {
    ForceInY force{excitation, harmonics.excited(excitation.harmonic), {}, 0, 0};
    if (!excitation.moves_base()) force.terms.push_back({{}, {P, excitation.direction}});
    if (excitation.load.size() > 0) force.terms.push_back({{}, {P, excitation.load}});
    for (const model::LinearPart& mass : model.masses) {
      if (!excitation.moves_base()) break;
      Complex along = mass.direction.dot(excitation.direction);
      if (mass.next.size() > 0) along += turn(force.harmonic) * mass.next.dot(excitation.direction);
      if (along != 0.0) force.terms.push_back({mass.number, {P, mass.direction, mass.next}, along});
    }
    forces_.push_back(std::move(force));
  }
}

void LinearParts::set_waves(const elements::Harmonics& harmonics) {
  std::vector<int> diameters;
  wave_of_diameter_.assign(static_cast<std::size_t>(sector_.count), -1);
  for (int h = 0; h < harmonics.cosines(); ++h) {
    const int diameter = sector_.diameter(harmonics.cosine_order(h));
    int& wave = wave_of_diameter_[static_cast<std::size_t>(diameter)];
    if (wave >= 0) continue;
    wave = static_cast<int>(diameters.size());
    diameters.push_back(diameter);
  }
  for (MatrixInY& part : matrix_parts_) part.waves = in_waves(part.of, P_, diameters);
}

ComplexSparse LinearParts::links() const {
  SparsityPattern links(size_);
  links.link_diagonal();
  for (const PartInY& part : parts_) links.link_all(coordinates_of(part.direction));
  for (const MatrixInY& part : matrix_parts_)
    for (Eigen::Index j = 0; j < size_; ++j)
      for (ComplexSparse::InnerIterator entry(part.waves.front(), j); entry; ++entry)
        links.link(entry.row(), j);
  return links.matrix();
}

void LinearParts::set_positions() {
  pattern_ = links();
  std::size_t most = 0;
  for (const PartInY& part : parts_) {
    PartInZ& in_Z = parts_in_Z_.emplace_back();
    const std::vector<Eigen::Index> all = coordinates_of(part.direction);
    for (const Eigen::Index j : all) {
      in_Z.direction.emplace_back(entry_at(part.direction.entries(), j), entry_at(part.direction.next(), j));
      for (const Eigen::Index i : all) in_Z.positions.push_back(position(pattern_, i, j));
    }
    most = std::max(most, in_Z.direction.size());
  }
  direction_.resize(static_cast<Eigen::Index>(most));
  for (MatrixInY& part : matrix_parts_)
    for (Eigen::Index j = 0; j < size_; ++j)
      for (ComplexSparse::InnerIterator entry(part.waves.front(), j); entry; ++entry)
        part.positions.push_back(position(pattern_, entry.row(), j));
}

double LinearParts::modal_value(const PartInY& part) const {
  const bool known =
      part.number.parameter() < modes_->p.size() && (part.kind != LinearKind::damper || modes_->damped);
  return known ? part.number.value(modes_->p) : 0;
}

void LinearParts::move_to(In p) {
  base_frequency_ = p[model::frequency] / period_;
  bool same = has_place_ && p.size() == p_.size() && equal_near_frequency(p, p_);
  has_place_ = true;
  p_ = p;
  force_changed_ = !same;
  for (ForceInY& force : forces_) {
    force.given = force.of.amplitude(p);
    const Complex amplitude = force.of.factor(p[model::frequency]) * force.given;
    force_changed_ = force_changed_ || amplitude != force.amplitude;
    force.amplitude = amplitude;
  }
  if (!same)
    for (PartInY& part : parts_) part.value = part.number.value(p);
  for (MatrixInY& part : matrix_parts_) {
    const double value = part.of.value(p);
    same = same && part.value == value;
    part.value = value;
  }
  if (!same) set_values();
}

void LinearParts::set_values() {
  ++changes_of_values_;
  changes_.clear();
  if (!symmetric()) return;
  modal_ = modes_ != nullptr;
  for (const PartInY& part : parts_) {
    if (!modal_) break;
    const double by = part.value - modal_value(part);
    if (by != 0) changes_.push_back({&part, by});
    modal_ = changes_.size() <= most_changes;
  }
  for (const MatrixInY& part : matrix_parts_)
    modal_ = modal_ && !part.of.number.depends_on(model::frequency) &&
             (!part.of.number.given() || part.value == part.of.value(modes_->p));
  if (modal_) return;
  for (Eigen::MatrixXd* matrix : {&matrices_.M, &matrices_.C, &matrices_.K}) matrix->setZero(size_, size_);
  for (const PartInY& part : parts_) {
    Eigen::MatrixXd& sum = matrices_.of(part.kind);
    for (const auto& [j, at_j] : part.direction.entries())
      for (const auto& [i, at_i] : part.direction.entries()) sum(i, j) += part.value * at_i * at_j;
  }
  for (MatrixInY& part : matrix_parts_) {
    if (part.waves.empty()) part.waves = in_waves(part.of, P_, {});
    matrices_.of(part.of.kind) += part.value * part.waves.front().real();
  }
}

ComplexSparse LinearParts::pattern() const {
  return symmetric() ? links() : pattern_;
}

void LinearParts::dynamic_stiffness(int n, ComplexSparse& Z) const {
  const Factors g = factors(n * base_frequency_);
  const Complex t = turn(n);
  Complex* const entries = Z.valuePtr();
  std::fill(entries, entries + Z.nonZeros(), Complex(0));
  const auto add = [entries](int at, Complex a, Complex b) {
    entries[at] = less_product(entries[at], a, -b);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Complex factor = g.of(parts_[k].kind) * parts_[k].value;
    if (factor == 0.0) continue;
    const auto& [direction, positions] = parts_in_Z_[k];
    const auto m = static_cast<Eigen::Index>(direction.size());
    Eigen::Index i = 0;
    for (const auto& [own, next] : direction) direction_[i++] = own + t * next;
    auto at = positions.begin();
    for (Eigen::Index j = 0; j < m; ++j) {
      const Complex of_column = factor * direction_[j];
      for (i = 0; i < m; ++i) add(*at++, std::conj(direction_[i]), of_column);
    }
  }
  for (const MatrixInY& part : matrix_parts_) {
    const Complex factor = g.of(part.of.kind) * part.value;
    if (factor == 0.0) continue;
    const Complex* value = in_wave(part, n).valuePtr();
    for (const int at : part.positions) add(at, factor, *value++);
  }
}

const Eigen::MatrixXd& LinearParts::in_y(const MatrixInY& part) const {
  if (part.A.size() == 0) part.A.noalias() = P_.transpose() * (*part.of.A * P_);
  return part.A;
}

const ComplexSparse& LinearParts::in_wave(const MatrixInY& part, int n) const {
  if (part.waves.size() == 1) return part.waves.front();
  const int wave = wave_of_diameter_[static_cast<std::size_t>(sector_.diameter(n))];
  return part.waves[static_cast<std::size_t>(wave)];
}

void LinearParts::add_matrix_product(const MatrixInY& part, int n, Complex factor, const ComplexVector& y,
                                     ComplexVector& v) const {
  if (modal_) {
    v.noalias() += factor * (in_y(part) * y);
    return;
  }
  const ComplexSparse& A = in_wave(part, n);
  for (Eigen::Index j = 0; j < size_; ++j) {
    const Complex of_column = -(factor * y[j]);
    for (ComplexSparse::InnerIterator entry(A, j); entry; ++entry)
      v[entry.row()] = less_product(v[entry.row()], entry.value(), of_column);
  }
}

// y^H A y
Complex LinearParts::matrix_form(const MatrixInY& part, int n, const ComplexVector& y) const {
  const ComplexSparse& A = in_wave(part, n);
  Complex sum = 0;
  for (Eigen::Index j = 0; j < size_; ++j) {
    Complex of_column = 0;
    for (ComplexSparse::InnerIterator entry(A, j); entry; ++entry)
      of_column = less_product(of_column, entry.value(), -std::conj(y[entry.row()]));
    sum += of_column * y[j];
  }
  return sum;
}

Factors LinearParts::factors(double s) const {
  Factors g{-s * s, Complex(0, s), 1, 1};
  if (!damping_ || s == 0) return g;
  g.mass += Complex(0, s * damping_->alpha_at(p_));
  g.spring += Complex(0, s * damping_->beta_at(p_) + damping_->loss_factor_at(p_));
  return g;
}

Factors LinearParts::factor_rates(int n) const {
  const double s = n * base_frequency_, ds = static_cast<double>(n) / period_;
  Factors rates{-2 * s * ds, Complex(0, ds), 0};
  if (!damping_) return rates;
  rates.mass += Complex(0, ds * damping_->alpha_at(p_));
  rates.spring += Complex(0, ds * damping_->beta_at(p_));
  return rates;
}

void LinearParts::add(const ForceInY& force, Complex amplitude, ComplexVector& f) const {
  for (const ForceInY::Term& term : force.terms)
    term.direction.add(amplitude * value(term) * term.along, turn(force.harmonic), f);
}

void LinearParts::force(int n, ComplexVector& f) const {
  f.setZero();
  for (const ForceInY& force : forces_)
    if (force.harmonic == n) add(force, force.amplitude, f);
}

bool LinearParts::force_rate(int n, ComplexVector& f) const {
  bool any = false;
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n) continue;
    const Complex rate =
        force.of.factor_rate(p_[model::frequency]) * force.given +
        force.of.factor(p_[model::frequency]) * force.of.amplitude_rate(p_, model::frequency);
    if (rate == 0.0) continue;
    if (!any) f.setZero();
    any = true;
    add(force, rate, f);
  }
  return any;
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
    Complex rate = force.of.displacement(w) * force.of.amplitude_rate(p_, k);
    if (k == model::frequency) rate += force.of.displacement_rate(w) * force.given;
    sum += direction.dot(force.of.direction) * rate;
  }
  return sum;
}

bool LinearParts::depend_on(int k) const {
  return k == model::frequency ||
         (damping_ && (damping_->alpha.depends_on(k) || damping_->beta.depends_on(k) ||
                       damping_->loss_factor.depends_on(k))) ||
         std::any_of(matrix_parts_.begin(), matrix_parts_.end(),
                     [k](const MatrixInY& part) { return part.of.number.depends_on(k); }) ||
         std::any_of(parts_.begin(), parts_.end(),
                     [k](const PartInY& part) { return part.number.depends_on(k); }) ||
         std::any_of(forces_.begin(), forces_.end(), [k](const ForceInY& force) {
           return force.of.cosine.depends_on(k) || force.of.sine.depends_on(k);
         });
}

void LinearParts::differentiate(int k, int n, const ComplexVector& y, double force_factor,
                                ComplexVector& v) const {
  const double s = n * base_frequency_;
  const Complex t = turn(n);
  v.setZero();
  const Factors g = factors(s);
  if (k == model::frequency) add_product(factor_rates(n), n, y, v);
  for (const PartInY& part : parts_)
    if (part.number.depends_on(k))
      part.direction.add(part.number.rate(p_, k) * g.of(part.kind) * part.direction.along(y, t), t, v);
  for (const MatrixInY& part : matrix_parts_)
    if (part.of.number.depends_on(k))
      add_matrix_product(part, n, part.of.rate(p_, k) * g.of(part.of.kind), y, v);
  if (damping_ && s > 0) {
    const double by_alpha = s * damping_->alpha.rate(p_, k);
    const double by_spring = s * damping_->beta.rate(p_, k) + damping_->loss_factor.rate(p_, k);
    if (by_alpha != 0 || by_spring != 0)
      add_product({Complex(0, by_alpha), 0, Complex(0, by_spring)}, n, y, v);
  }
  const double w = p_[model::frequency];
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n) continue;
    Complex rate = force.of.factor(w) * force.of.amplitude_rate(p_, k);
    if (k == model::frequency) rate += force.of.factor_rate(w) * force.given;
    if (rate != 0.0) add(force, -force_factor * rate, v);
    for (const ForceInY::Term& term : force.terms)
      if (term.mass.depends_on(k))
        term.direction.add(
            -force_factor * term.mass.rate(p_, k) * force.of.factor(w) * force.given * term.along, t, v);
  }
}

// v += (g_m M + g_c C + g_k K) y
void LinearParts::add_product(const Factors& g, int n, const ComplexVector& y, ComplexVector& v) const {
  const Complex t = turn(n);
  if (modal_) {
    products_->add(g, y, v);
    for (const ChangedPart& change : changes_)
      change.part->direction.add(g.of(change.part->kind) * change.by * change.part->direction.along(y, t), t,
                                 v);
  } else {
    for (const PartInY& part : parts_)
      if (const Complex factor = g.of(part.kind) * part.value; factor != 0.0)
        part.direction.add(factor * part.direction.along(y, t), t, v);
    for (const MatrixInY& part : matrix_parts_)
      if (const Complex factor = g.of(part.of.kind) * part.value; factor != 0.0)
        add_matrix_product(part, n, factor, y, v);
  }
}

double LinearParts::quadratic_form(LinearKind kind, int n, const ComplexVector& y) const {
  double sum = 0;
  const Complex t = turn(n);
  if (!modal_) {
    for (const PartInY& part : parts_)
      if (part.kind == kind) sum += part.value * std::norm(part.direction.along(y, t));
    for (const MatrixInY& part : matrix_parts_)
      if (part.of.kind == kind) sum += part.value * matrix_form(part, n, y).real();
    return sum;
  }
  const ModalMatrix& whole = kind == LinearKind::mass     ? modes_->M
                             : kind == LinearKind::damper ? modes_->C
                                                          : modes_->K;
  sum = whole.form(y);
  for (const ChangedPart& change : changes_)
    if (change.part->kind == kind) sum += change.by * std::norm(change.part->direction.along(y, t));
  return sum;
}

// The share of skew parts in y^H Z y: of A = S + N with S^H = S and N^H = -N, real or not, y^H S y is real
// and y^H N y imaginary.
Complex LinearParts::skew_form(int n, const ComplexVector& y) const {
  if (symmetric_) return 0;
  const Factors g = factors(n * base_frequency_);
  Complex sum = 0;
  for (const MatrixInY& part : matrix_parts_)
    if (!part.of.symmetric)
      sum += g.of(part.of.kind) * part.value * Complex(0, matrix_form(part, n, y).imag());
  return sum;
}

double LinearParts::damping_form(int n, const ComplexVector& y) const {
  const Factors g = factors(n * base_frequency_);
  double sum = 0;
  for (const LinearKind kind : {LinearKind::mass, LinearKind::damper, LinearKind::spring})
    if (const double loss = g.of(kind).imag(); loss != 0) sum += loss * quadratic_form(kind, n, y);
  return symmetric_ ? sum : sum + skew_form(n, y).imag();
}

QuadraticForms LinearParts::quadratic_forms(int n, const ComplexVector& y, double force_factor) const {
  QuadraticForms forms{quadratic_form(LinearKind::mass, n, y), quadratic_form(LinearKind::spring, n, y),
                       damping_form(n, y), skew_form(n, y).real(), 0};
  for (const ForceInY& force : forces_) {
    if (force.harmonic != n) continue;
    const Complex amplitude = force_factor * force.of.factor(p_[model::frequency]) * force.given;
    for (const ForceInY::Term& term : force.terms)
      forms.force += amplitude * value(term) * term.along * std::conj(term.direction.along(y, turn(n)));
  }
  return forms;
}

}  // namespace arcslip::hbm
