#include <arcslip/laws/contact/contact_2d.hpp>

#include <arcslip/fourier/moments.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

namespace arcslip::elements {
namespace {

// How a rest w changes: dw = phi . du_t + normal phi . du_n + by_field . dfields.
struct RestChange {
  double normal = 0;
  double by_field[contact_field::count] = {};
};

class Contact2dElement final : public Element {
 public:
  Contact2dElement(const Harmonics& h, Offset offset)
      : h_(h),
        phases_(h, offset),
        stick_(h),
        slip_(h),
        by_field_(2 * h.size(), contact_field::count),
        g_(h.size()),
        phi_(h.size()),
        at_lower_(h.size()),
        at_upper_(h.size()),
        F_(2 * h.size()),
        J_(Eigen::MatrixXd::Zero(2 * h.size(), 2 * h.size())),
        middle_(static_cast<std::size_t>(2 * h.order + 1)),
        half_(middle_.size()) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    const Eigen::Index c = h_.size();
    const auto u_t = u.head(c), u_n = u.tail(c);
    law_ = contact_law(fields);
    const auto& phases = phases_.find(u_t, u_n, law_);
    F_.setZero();
    by_field_.setZero();
    if (jacobian) J_.topRows(c).setZero();  // the normal force does not depend on x_t
    normal(jacobian);
    if (phases_.full_stick())
      full_stick(u_t, u_n, jacobian);
    else if (!phases_.normal().closed().empty())
      tangential(phases, u_t, u_n, jacobian);
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override { dF = by_field_.col(field); }
  std::uint64_t piece() const override { return phases_.sequence(); }

  bool friction(FrictionState& state) const override {
    phases_.tell(state);
    state.mean_min = state.mean_max = F_[0];
    if (phases_.full_stick()) {  // k_t (u_0 - w) for w from a to b
      const StuckSlider held = phases_.held();
      const double a = phases_.largest_lower().x, b = phases_.smallest_upper().x;
      state.mean_min -= law_.k_t * (1 - held.upper) * b - law_.k_t * held.lower * a;
      state.mean_max -= law_.k_t * (1 - held.lower) * a - law_.k_t * held.upper * b;
      state.mean_max = std::max(state.mean_max, state.mean_min);  // but for rounding
    }
    return true;
  }

  bool place_slider(double share) override {
    phases_.place(share);
    return true;
  }

  void contact(std::vector<ContactInterval>& intervals) const override { phases_.tell(intervals); }

 private:
  auto tangential_rows(int field) { return by_field_.col(field).head(h_.size()); }
  auto normal_rows(int field) { return by_field_.col(field).tail(h_.size()); }

  void normal(bool jacobian) {
    const Eigen::Index c = h_.size();
    const NormalContact& normal = phases_.normal();
    F_.tail(c) = normal.force();
    normal_rows(contact_field::normal_stiffness) = normal.by_stiffness();
    normal_rows(contact_field::normal_load) = normal.by_load();
    if (jacobian) normal.jacobian(J_.bottomRightCorner(c, c));
  }

  // phi_: at the rest.
  RestChange change(const SliderRest& rest, In u_t, In u_n) const {
    RestChange at;
    const double x_n = phi_.dot(u_n);
    if (rest.at == SliderRest::At::closing) {
      // It sticks, so that the rate is within these bounds; what N just touches has none.
      const double x_t_rate = series_values(h_, u_t, rest.theta).d1, most = law_.mu * law_.k_n / law_.k_t;
      const double x_n_rate = series_values(h_, u_n, rest.theta).d1;
      const double rate = x_n_rate > 0 ? std::clamp(x_t_rate / x_n_rate, -most, most) : 0;
      at.normal = -rate;
      at.by_field[contact_field::normal_stiffness] = -rate * x_n / law_.k_n;
      at.by_field[contact_field::normal_load] = -rate / law_.k_n;
      return at;
    }
    const double s = rest.sign(), N = law_.N_0 + law_.k_n * x_n;
    at.normal = s * law_.mu * law_.k_n / law_.k_t;
    at.by_field[contact_field::tangential_stiffness] = -s * law_.mu * N / (law_.k_t * law_.k_t);
    at.by_field[contact_field::normal_stiffness] = s * law_.mu * x_n / law_.k_t;
    at.by_field[contact_field::friction_coefficient] = s * N / law_.k_t;
    at.by_field[contact_field::normal_load] = s * law_.mu / law_.k_t;
    return at;
  }

  // u_0 - w. Where the shares of w add up to 1 neither the mean of x_t nor, in the middle, the load is in it,
  // nor their rounding: with a~, b~ the extremes of the bounds less their means x_t0 -+ d,
  //   u_0 - w = (lower - upper) d - lower a~ - upper b~,   d = mu (N_0 + k_n x_n0)/k_t
  double mean_elongation(In u_t, In u_n, const StuckSlider& held) const {
    const double a = phases_.largest_lower().x, b = phases_.smallest_upper().x;
    if (held.lower + held.upper != 1) return u_t[0] - held.lower * a - held.upper * b;
    const double ratio = law_.mu * law_.k_n / law_.k_t, d = ratio * u_n[0] + law_.mu * law_.N_0 / law_.k_t;
    const Eigen::Index rest = h_.size() - 1;
    const auto along = [&](const Eigen::VectorXd& phi, double normal) {
      return phi.tail(rest).dot(u_t.tail(rest)) + normal * phi.tail(rest).dot(u_n.tail(rest));
    };
    return (held.lower - held.upper) * d - held.lower * along(at_lower_, -ratio) -
           held.upper * along(at_upper_, ratio);
  }

  void full_stick(In u_t, In u_n, bool jacobian) {
    const Eigen::Index c = h_.size();
    const StuckSlider held = phases_.held();
    const double k = law_.k_t;
    series_basis(h_, phases_.largest_lower().theta, at_lower_);
    series_basis(h_, phases_.smallest_upper().theta, at_upper_);
    auto F = F_.head(c);
    F = u_t;
    F[0] = mean_elongation(u_t, u_n, held);
    tangential_rows(contact_field::tangential_stiffness) = F;
    F *= k;
    if (jacobian) J_.topLeftCorner(c, c).diagonal().setConstant(k);
    const SliderRest ends[] = {{SliderRest::At::lower_reversal, phases_.largest_lower().theta, 0},
                               {SliderRest::At::upper_reversal, phases_.smallest_upper().theta, 0}};
    for (const SliderRest& end : ends) {
      const double share = end.sign() < 0 ? held.lower : held.upper;
      if (share == 0) continue;
      phi_ = end.sign() < 0 ? at_lower_ : at_upper_;
      const RestChange dw = change(end, u_t, u_n);
      for (int field = 0; field < contact_field::count; ++field)
        tangential_rows(field)[0] -= share * k * dw.by_field[field];
      if (!jacobian) continue;
      J_.row(0).head(c) -= share * k * phi_.transpose();
      J_.row(0).tail(c) -= share * k * dw.normal * phi_.transpose();
    }
  }

  void tangential(const std::vector<ContactPhase>& phases, In u_t, In u_n, bool jacobian) {
    const Eigen::Index c = h_.size();
    const double k = law_.k_t;
    auto F = F_.head(c);
    auto by_stiffness = tangential_rows(contact_field::tangential_stiffness);
    auto J_t = J_.topLeftCorner(c, c), J_n = J_.topRightCorner(c, c);
    stick_.clear();
    slip_.clear();
    for (const ContactPhase& phase : phases) {
      if (phase.state == ContactPhase::State::open) continue;
      set_powers(phase.begin, phase.end);
      const double length = phase.end - phase.begin;
      if (phase.state == ContactPhase::State::slip) {
        slip_.add_interval(length, middle_.data(), half_.data(), phase.sign);
        continue;
      }
      stick_.add_interval(length, middle_.data(), half_.data());
      integrate_basis(length);
      set_basis_at_begin();
      const RestChange dw = change(phase.rest, u_t, u_n);
      F -= fourier_factor * phase.rest.w * g_;
      for (int field = 0; field < contact_field::count; ++field)
        tangential_rows(field) -= fourier_factor * k * dw.by_field[field] * g_;
      if (!jacobian) continue;
      g_ *= fourier_factor * k;
      J_t.noalias() -= g_ * phi_.transpose();
      phi_ *= dw.normal;
      J_n.noalias() -= g_ * phi_.transpose();
    }
    stick_.close();
    slip_.close();
    stick_.times(u_t, fourier_factor, F);
    by_stiffness += F;
    F *= k;
    phi_.setZero();
    slip_.times(u_n, fourier_factor, phi_);
    slip_.integral(g_);
    g_ *= fourier_factor;
    tangential_rows(contact_field::normal_stiffness) += law_.mu * phi_;
    tangential_rows(contact_field::normal_load) += law_.mu * g_;
    phi_ = law_.k_n * phi_ + law_.N_0 * g_;
    tangential_rows(contact_field::friction_coefficient) += phi_;
    F += law_.mu * phi_;
    if (jacobian) {
      stick_.add_to(J_t, fourier_factor * k);
      slip_.add_to(J_n, fourier_factor * law_.mu * law_.k_n);
      J_.row(0).head(2 * c) *= 0.5;
    }
    F[0] *= 0.5;
    for (int field = 0; field < contact_field::count; ++field) tangential_rows(field)[0] *= 0.5;
  }

  void set_powers(double begin, double end) {
    powers(0.5 * (begin + end), static_cast<int>(middle_.size()), middle_.data());
    powers(0.5 * (end - begin), static_cast<int>(half_.size()), half_.data());
  }
  // phi at the beginning of the interval of these powers, and over it.
  void set_basis_at_begin() {
    phi_[0] = 1;
    for (int n = 1; n <= h_.order; ++n) {
      const auto at = static_cast<std::size_t>(n);
      const std::complex<double> s = middle_[at], d = half_[at];
      phi_[h_.cosine_index(n)] = s.real() * d.real() + s.imag() * d.imag();
      phi_[h_.sine_index(n)] = s.imag() * d.real() - s.real() * d.imag();
    }
  }
  void integrate_basis(double length) {
    g_[0] = length;
    for (int n = 1; n <= h_.order; ++n) {
      const auto at = static_cast<std::size_t>(n);
      const double chord = 2 * half_[at].imag() / n;
      g_[h_.cosine_index(n)] = chord * middle_[at].real();
      g_[h_.sine_index(n)] = chord * middle_[at].imag();
    }
  }

  Harmonics h_;
  ContactLaw law_{};
  ContactPhases phases_;
  Moments stick_, slip_;
  Eigen::MatrixXd by_field_;
  Eigen::VectorXd g_, phi_;
  Eigen::VectorXd at_lower_, at_upper_;  // phi at the extremes of the bounds, in full stick
  Eigen::VectorXd F_;
  Eigen::MatrixXd J_;
  std::vector<std::complex<double>> middle_, half_;
};

}  // namespace

std::unique_ptr<Element> make_contact_2d(const Harmonics& harmonics, Offset offset) {
  return std::make_unique<Contact2dElement>(harmonics, offset);
}

}  // namespace arcslip::elements
