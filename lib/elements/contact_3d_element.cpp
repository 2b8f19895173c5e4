#include <arcslip/elements/contact_3d.hpp>

#include <arcslip/elements/disc_phases.hpp>
#include <arcslip/elements/normal_contact.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

enum { tangential_stiffness, normal_stiffness, friction_coefficient, normal_load, field_count };

constexpr double kappa = 1 / std::numbers::pi;
constexpr double frictionless = 1e-7;  // radius of the disc, of the motion, that stands for the limit 0

// The stretch x - w of the slider's spring, as coefficients S, and their derivatives by those of x and h.
class Stretch {
 public:
  explicit Stretch(const Harmonics& h)
      : h_(h),
        c_(h.size()),
        phases_(h),
        stick_(h),
        S_(2 * c_),
        by_(2 * c_, 3 * c_ + 2),
        dw_(2, 3 * c_ + 2),
        dpsi_(3 * c_ + 2),
        first_(2, 3 * c_ + 2),
        rows_(panel_nodes, 3 * c_ + 2),
        phi_(panel_nodes, c_),
        slope_(panel_nodes, c_),
        weighted_(panel_nodes, 2 * c_),
        g_(c_),
        basis_(c_),
        middle_(static_cast<std::size_t>(2 * h.order + 1)),
        half_(middle_.size()) {}

  void move_to(const Disc& disc, const NormalContact& normal) {
    phases_.find(disc, normal.closed(), normal.opens());
    disc_ = &disc;
    integrate();
  }
  const Eigen::VectorXd& coefficients() const { return S_; }
  const DiscPhases& phases() const { return phases_; }
  const std::vector<DiscPhase>& list() const { return phases_.list(); }

  /// dS by the coefficients of x_1, x_2 and h: 2 size x 3 size.
  auto derivative() { return by_.leftCols(3 * c_); }
  void differentiate();

 private:
  void integrate();
  void differentiate_full_stick();
  void begin(const DiscPhase& phase);
  void stick(const DiscPhase& phase);
  void slip(const DiscPhase& phase);
  void close_period();

  auto columns(int coordinate) { return by_.middleCols(coordinate * c_, c_); }
  void set_basis(double theta) { series_basis(h_, theta, basis_); }
  // basis_: d/dtheta of what it is.
  void turn_basis() {
    basis_[0] = 0;
    for (int n = 1; n <= h_.order; ++n) {
      double &a = basis_[h_.cosine_index(n)], &b = basis_[h_.sine_index(n)];
      const double cosine = a;
      a = -n * b;
      b = n * cosine;
    }
  }
  void integrate_basis(double begin, double end) {
    g_[0] = end - begin;
    powers(0.5 * (begin + end), h_.order + 1, middle_.data());
    powers(0.5 * (end - begin), h_.order + 1, half_.data());
    for (int n = 1; n <= h_.order; ++n) {
      const auto at = static_cast<std::size_t>(n);
      const double chord = 2 * half_[at].imag() / n;
      g_[h_.cosine_index(n)] = chord * middle_[at].real();
      g_[h_.sine_index(n)] = chord * middle_[at].imag();
    }
  }
  void set_bases(const SlipPanel& panel) {
    for (int j = 0; j < panel_nodes; ++j) {
      powers(panel.theta[j], h_.order + 1, middle_.data());
      phi_(j, 0) = 1;
      slope_(j, 0) = 0;
      for (int n = 1; n <= h_.order; ++n) {
        const std::complex<double> z = middle_[static_cast<std::size_t>(n)];
        phi_(j, n) = z.real();
        phi_(j, h_.order + n) = z.imag();
        slope_(j, n) = -n * z.imag();
        slope_(j, h_.order + n) = n * z.real();
      }
    }
  }
  double tangent(int i, double psi) const { return i == 0 ? -std::sin(psi) : std::cos(psi); }
  double outward(int i, double psi) const { return i == 0 ? std::cos(psi) : std::sin(psi); }

  Harmonics h_;
  Eigen::Index c_;
  DiscPhases phases_;
  const Disc* disc_ = nullptr;
  Moments stick_;
  Eigen::VectorXd S_;
  // By the coefficients, and by the two coordinates of w at the beginning.
  Eigen::MatrixXd by_, dw_;
  Eigen::RowVectorXd dpsi_;
  Eigen::MatrixXd first_, rows_, phi_, slope_, weighted_;
  Eigen::VectorXd g_, basis_;
  std::vector<std::complex<double>> middle_, half_;
};

void Stretch::integrate() {
  S_.setZero();
  stick_.clear();
  bool sticks = false;
  for (const DiscPhase& phase : phases_.list()) {
    if (phase.state == DiscPhase::State::stick) {
      sticks = true;
      integrate_basis(phase.begin, phase.end);
      powers(0.5 * (phase.begin + phase.end), static_cast<int>(middle_.size()), middle_.data());
      powers(0.5 * (phase.end - phase.begin), static_cast<int>(half_.size()), half_.data());
      stick_.add_interval(phase.end - phase.begin, middle_.data(), half_.data());
      for (int i = 0; i < 2; ++i) S_.segment(i * c_, c_) -= kappa * phase.w[i] * g_;
    }
    if (phase.state != DiscPhase::State::slip) continue;
    for (std::size_t k = phase.first_panel; k < phase.last_panel; ++k) {
      const SlipPanel& panel = phases_.panel(k);
      const SlipPanel::Nodes weights = kappa * phases_.collocation().weights(panel);
      set_bases(panel);
      for (int j = 0; j < panel_nodes; ++j) {
        const double factor = weights[j] * panel.h[j];
        for (int i = 0; i < 2; ++i)
          S_.segment(i * c_, c_) += factor * outward(i, panel.psi[j]) * phi_.row(j).transpose();
      }
    }
  }
  stick_.close();
  if (sticks)
    for (int i = 0; i < 2; ++i) stick_.times(disc_->coefficients(i), kappa, S_.segment(i * c_, c_));
  S_[0] *= 0.5;
  S_[c_] *= 0.5;
}

void Stretch::differentiate_full_stick() {
  by_.setZero();
  dw_.setZero();
  phases_.centre().derivative(*disc_, dw_.leftCols(3 * c_));
  for (int i = 0; i < 2; ++i) {
    by_.block(i * c_, i * c_, c_, c_).diagonal().setOnes();
    by_.row(i * c_) -= dw_.row(i);
  }
}

void Stretch::differentiate() {
  if (phases_.full_stick()) return differentiate_full_stick();
  by_.setZero();
  bool sticks = false;
  for (const DiscPhase& phase : phases_.list()) {
    if (phase.state == DiscPhase::State::open) continue;
    begin(phase);
    if (phase.state == DiscPhase::State::stick) {
      sticks = true;
      stick(phase);
    } else {
      slip(phase);
    }
  }
  if (sticks)
    for (int i = 0; i < 2; ++i) {
      auto block = by_.block(i * c_, i * c_, c_, c_);
      stick_.add_to(block, kappa);
    }
  if (phases_.list().front().from != DiscPhase::Begin::closing &&
      phases_.list().front().state != DiscPhase::State::open)
    close_period();
  by_.row(0) *= 0.5;
  by_.row(c_) *= 0.5;
}

// dw_ of a stick phase or dpsi_ of a slip phase, at its beginning.
void Stretch::begin(const DiscPhase& phase) {
  const bool first = &phase == &phases_.list().front();
  const DiscPoint at = disc_->at(phase.begin);
  if (phase.from == DiscPhase::Begin::closing) {
    set_basis(phase.begin);
    if (phase.state == DiscPhase::State::stick) {
      dw_.setZero();
      for (int i = 0; i < 2; ++i) {
        dw_.row(i).segment(i * c_, c_) = basis_.transpose();
        const double rate = at.dh > 0 ? std::clamp(at.v[i] / at.dh, -1.0, 1.0) : 0;
        dw_.row(i).segment(2 * c_, c_) = -rate * basis_.transpose();
      }
      return;
    }
    const double speed = at.v.norm(), psi = phases_.panel(phase.first_panel).from;
    dpsi_.setZero();
    if (!(speed > 0)) return;
    const double rate =
        (tangent(0, psi) * at.a[0] + tangent(1, psi) * at.a[1]) / (std::max(at.dh, 0.0) + speed);
    dpsi_.segment(2 * c_, c_) = -rate / speed * basis_.transpose();
    turn_basis();
    for (int i = 0; i < 2; ++i) dpsi_.segment(i * c_, c_) = tangent(i, psi) / speed * basis_.transpose();
    return;
  }
  if (first) {
    dw_.setZero();
    dpsi_.setZero();
    if (phase.state == DiscPhase::State::stick)
      dw_.rightCols(2).setIdentity();
    else
      dpsi_[3 * c_] = 1;
    return;
  }
  if (phase.state == DiscPhase::State::slip) {  // from stick
    const double psi = phases_.panel(phase.first_panel).from;
    dpsi_ = -tangent(0, psi) * dw_.row(0) - tangent(1, psi) * dw_.row(1);
    set_basis(phase.begin);
    for (int i = 0; i < 2; ++i) dpsi_.segment(i * c_, c_) += tangent(i, psi) * basis_.transpose();
    if (at.h > 0) dpsi_ /= at.h;
    return;
  }
  // stick from slip, whose dw_ is set at its end
}

void Stretch::stick(const DiscPhase& phase) {
  integrate_basis(phase.begin, phase.end);
  for (int i = 0; i < 2; ++i) by_.middleRows(i * c_, c_).noalias() -= kappa * g_ * dw_.row(i);
}

void Stretch::slip(const DiscPhase& phase) {
  for (std::size_t k = phase.first_panel; k < phase.last_panel; ++k) {
    const SlipPanel& panel = phases_.panel(k);
    const SlipPanel::Nodes weights = kappa * phases_.collocation().weights(panel);
    set_bases(panel);
    for (int j = 0; j < panel_nodes; ++j) {
      for (int i = 0; i < 2; ++i) rows_.row(j).segment(i * c_, c_) = tangent(i, panel.psi[j]) * slope_.row(j);
      rows_.row(j).segment(2 * c_, c_) = -panel.rate[j] * phi_.row(j);
    }
    rows_.rightCols(2).setZero();
    rows_.noalias() -= phases_.collocation().column(panel) * dpsi_;
    const auto lu = phases_.collocation().matrix(panel).partialPivLu();
    rows_ = lu.solve(rows_).eval();
    dpsi_ = rows_.row(panel_nodes - 1);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < panel_nodes; ++j)
        weighted_.row(j).segment(i * c_, c_) =
            weights[j] * panel.h[j] * tangent(i, panel.psi[j]) * phi_.row(j);
    by_.noalias() += weighted_.transpose() * rows_;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < panel_nodes; ++j)
        weighted_.row(j).segment(i * c_, c_) = weights[j] * outward(i, panel.psi[j]) * phi_.row(j);
    columns(2).noalias() += weighted_.transpose() * phi_;
  }
  const double psi = phase.last_panel > phase.first_panel ? phases_.panel(phase.last_panel - 1).to() : 0;
  const DiscPoint at = disc_->at(phase.end);
  set_basis(phase.end);
  for (int i = 0; i < 2; ++i) {
    dw_.row(i) = -std::max(at.h, 0.0) * tangent(i, psi) * dpsi_;
    dw_.row(i).segment(i * c_, c_) += basis_.transpose();
    dw_.row(i).segment(2 * c_, c_) -= outward(i, psi) * basis_.transpose();
  }
}

// What follows from the state at the beginning, which is that after the period.
void Stretch::close_period() {
  const auto start = by_.rightCols(2);
  if (phases_.list().front().state == DiscPhase::State::slip) {  // throughout: psi
    const double left = 1 - dpsi_[3 * c_];
    if (!(left > 0)) return;
    first_.row(0) = dpsi_ / left;
    by_.leftCols(3 * c_).noalias() += start.col(0) * first_.row(0).head(3 * c_);
    return;
  }
  const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - dw_.rightCols(2);
  first_ = left.inverse() * dw_;
  if (!first_.allFinite()) return;
  by_.leftCols(3 * c_).noalias() += start * first_.leftCols(3 * c_);
}

class Contact3dElement final : public Element {
 public:
  explicit Contact3dElement(const Harmonics& h)
      : h_(h),
        c_(h.size()),
        normal_(h),
        disc_(h),
        stretch_(h),
        u_n_(c_),
        radius_(c_),
        F_(3 * c_),
        J_(3 * c_, 3 * c_) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    std::copy(fields.begin(), fields.end(), fields_);
    const double k_t = fields[tangential_stiffness], mu = fields[friction_coefficient];
    u_n_ = u.tail(c_);
    normal_.move_to(u_n_, fields[normal_stiffness], fields[normal_load]);
    F_.tail(c_) = normal_.force();
    radius_ = mu / k_t * normal_.load();
    if (!(mu > 0)) {  // the limit: derivatives by mu need the direction of slip
      disc_.set(u.head(c_), u.segment(c_, c_), radius_);
      const double size = disc_.motion_bound(0), most = normal_.load().cwiseAbs().sum();
      radius_ = most > 0 ? Eigen::VectorXd(frictionless * size / most * normal_.load()) : radius_;
    }
    disc_.set(u.head(c_), u.segment(c_, c_), radius_);
    const bool finite = std::isfinite(disc_.motion_bound(3)) && std::isfinite(disc_.radius_bound(3)) &&
                        std::isfinite(disc_.largest());
    rigid_ = !finite || (!(mu > 0) && !(disc_.motion_bound(0) > 0));
    differentiated_ = false;
    F_.head(2 * c_).setConstant(finite ? 0 : std::numeric_limits<double>::quiet_NaN());
    if (!rigid_) {
      stretch_.move_to(disc_, normal_);
      if (mu > 0) F_.head(2 * c_) = k_t * stretch_.coefficients();
    }
    if (jacobian) set_jacobian();
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }

  void field_derivative(int field, Out dF) const override {
    dF.setZero();
    const double mu = fields_[friction_coefficient];
    if (field == normal_stiffness) dF.tail(c_) = normal_.by_stiffness();
    if (field == normal_load) dF.tail(c_) = normal_.by_load();
    if (rigid_ || (!(mu > 0) && field != friction_coefficient)) return;
    differentiate();
    const auto by_radius = stretch_.derivative().rightCols(c_);
    auto T = dF.head(2 * c_);
    if (field == tangential_stiffness)  // h is mu N/k_t
      T = stretch_.coefficients() - by_radius * radius_;
    else if (field == normal_stiffness)
      T = mu * (by_radius * u_n_);
    else if (field == friction_coefficient)
      T = by_radius * normal_.load();
    else
      T = mu * by_radius.col(0);
  }

  std::uint64_t piece() const override {
    const std::uint64_t side = fields_[normal_load] <= 0 ? ~std::uint64_t{0} : 0;
    if (!(fields_[friction_coefficient] > 0) || rigid_)
      return ((normal_.opens() ? 1 : 0) + 2 * normal_.closed().size()) ^ side;
    return stretch_.phases().sequence() ^ side;
  }

  bool friction(FrictionState& state) const override {
    if (rigid_ || !(fields_[friction_coefficient] > 0)) {
      state.slip_onsets.clear();
      state.slip_ends.clear();
      state.stick_share = 0;
      double closed = 0;
      for (const auto& [begin, end] : normal_.closed()) closed += end - begin;
      state.open_share = std::max(0.0, 1 - closed / (2 * std::numbers::pi));
    } else {
      stretch_.phases().tell(state);
    }
    normal_.tell(state);
    return true;
  }

  void contact(std::vector<ContactInterval>& intervals) const override {
    if (!rigid_ && fields_[friction_coefficient] > 0) return stretch_.phases().tell(intervals);
    intervals.clear();
    double before = 0;
    for (const auto& [begin, end] : normal_.closed()) {
      if (!intervals.empty()) intervals.push_back({"open", before, begin});
      intervals.push_back({"slip", begin, end});
      before = end;
    }
    constexpr double turn = 2 * std::numbers::pi;
    if (intervals.empty())
      intervals.push_back({"open", 0, turn});
    else
      intervals.push_back({"open", before, intervals.front().begin + turn});
  }

 private:
  void differentiate() const {
    if (!differentiated_) stretch_.differentiate();
    differentiated_ = true;
  }

  void set_jacobian() {
    const double k_t = fields_[tangential_stiffness], mu = fields_[friction_coefficient];
    J_.setZero();
    normal_.jacobian(J_.bottomRightCorner(c_, c_));
    if (rigid_ || !(mu > 0)) return;
    differentiate();
    J_.topLeftCorner(2 * c_, 2 * c_) = k_t * stretch_.derivative().leftCols(2 * c_);
    J_.topRightCorner(2 * c_, c_) = mu * fields_[normal_stiffness] * stretch_.derivative().rightCols(c_);
  }

  Harmonics h_;
  Eigen::Index c_;
  double fields_[field_count] = {};
  NormalContact normal_;
  Disc disc_;
  mutable Stretch stretch_;  // its derivatives are computed where they are asked for
  mutable bool differentiated_ = false;
  bool rigid_ = false;
  Eigen::VectorXd u_n_, radius_, F_;
  Eigen::MatrixXd J_;
};

}  // namespace

std::unique_ptr<Element> make_contact_3d(const Harmonics& harmonics) {
  return std::make_unique<Contact3dElement>(harmonics);
}

Eigen::MatrixXd contact_3d_force(const Harmonics& h, In u, Fields fields, Angles angles) {
  const Eigen::Index c = h.size();
  const double k_t = fields[tangential_stiffness], k_n = fields[normal_stiffness],
               mu = fields[friction_coefficient], N_0 = fields[normal_load];
  NormalContact normal(h);
  normal.move_to(u.tail(c), k_n, N_0);
  Disc disc(h);
  const Eigen::VectorXd radius = mu / k_t * normal.load();
  disc.set(u.head(c), u.segment(c, c), radius);
  DiscPhases phases(h);
  if (mu > 0) phases.find(disc, normal.closed(), normal.opens());
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(angles.size()), 3);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double N = std::max(N_0 + k_n * series_values(h, u.tail(c), angles[i]).x, 0.0);
    force(row, 2) = N - std::max(N_0, 0.0);
    if (mu > 0) force.row(row).head<2>() = k_t * phases.stretch(disc, angles[i]).transpose();
  }
  return force;
}

}  // namespace arcslip::elements
