#include <arcslip/laws/contact/slider_deflection.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr int batch = 8;  // panels in one product of matrices

double tangent(int i, double psi) {
  return i == 0 ? -std::sin(psi) : std::cos(psi);
}
double outward(int i, double psi) {
  return i == 0 ? std::cos(psi) : std::sin(psi);
}

}  // namespace

DiscStretch::DiscStretch(const Harmonics& h)
    : h_(h),
      c_(h.size()),
      phases_(h),
      stick_(h),
      slipping_{Moments(h), Moments(h)},
      S_(2 * c_),
      by_(2 * c_, 3 * c_ + 2),
      dw_(2, 3 * c_ + 2),
      kept_(2, 3 * c_ + 2),
      dpsi_(3 * c_ + 2),
      first_(2, 3 * c_ + 2),
      phi_(panel_nodes, c_),
      slope_(panel_nodes, c_),
      rows_(batch * panel_nodes, 3 * c_ + 2),
      weighted_(batch * panel_nodes, 2 * c_),
      g_(c_),
      basis_(c_),
      middle_(static_cast<std::size_t>(2 * h.order + 1)),
      half_(middle_.size()) {}

void DiscStretch::move_to(const Disc& disc, std::span<const std::pair<double, double>> closed, bool opens) {
  phases_.find(disc, closed, opens);
  disc_ = &disc;
  integrate();
}

// basis_: d/dtheta of what it is.
void DiscStretch::turn_basis() {
  basis_[0] = 0;
  for (int n = 1; n <= h_.order; ++n) {
    double &a = basis_[h_.cosine_index(n)], &b = basis_[h_.sine_index(n)];
    const double cosine = a;
    a = -n * b;
    b = n * cosine;
  }
}

void DiscStretch::integrate_basis(double begin, double end) {
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

void DiscStretch::set_bases(const SlipPanel& panel) {
  SlipPanel::Nodes cosine = panel.cosine, sine = panel.sine;
  phi_.col(0).setOnes();
  slope_.col(0).setZero();
  for (int n = 1; n <= h_.order; ++n) {
    phi_.col(n) = cosine;
    phi_.col(h_.order + n) = sine;
    slope_.col(n) = -n * sine;
    slope_.col(h_.order + n) = n * cosine;
    const SlipPanel::Nodes next = cosine.cwiseProduct(panel.cosine) - sine.cwiseProduct(panel.sine);
    sine = sine.cwiseProduct(panel.cosine) + cosine.cwiseProduct(panel.sine);
    cosine = next;
  }
}

void DiscStretch::integrate() {
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
      for (int i = 0; i < 2; ++i) S_.segment(i * c_, c_) -= fourier_factor * phase.w[i] * g_;
    }
    if (phase.state != DiscPhase::State::slip) continue;
    for (std::size_t k = phase.first_panel; k < phase.last_panel; ++k) {
      const SlipPanel& panel = phases_.panel(k);
      const SlipPanel::Nodes weights = fourier_factor * phases_.collocation().weights(panel);
      set_bases(panel);
      const SlipPanel::Nodes width = weights.cwiseProduct(panel.h);
      for (int i = 0; i < 2; ++i) {
        const SlipPanel::Nodes stretch = width.cwiseProduct(panel.outward[i]);
        for (Eigen::Index j = 0; j < c_; ++j) S_[i * c_ + j] += stretch.dot(phi_.col(j));
      }
    }
  }
  stick_.close();
  if (sticks)
    for (int i = 0; i < 2; ++i) stick_.times(disc_->coefficients(i), fourier_factor, S_.segment(i * c_, c_));
  S_[0] *= 0.5;
  S_[c_] *= 0.5;
}

void DiscStretch::differentiate_full_stick() {
  by_.setZero();
  dw_.setZero();
  phases_.centre().derivative(dw_.leftCols(3 * c_));
  for (int i = 0; i < 2; ++i) {
    by_.block(i * c_, i * c_, c_, c_).diagonal().setOnes();
    by_.row(i * c_) -= dw_.row(i);
  }
}

void DiscStretch::differentiate() {
  if (phases_.full_stick()) return differentiate_full_stick();
  by_.setZero();
  for (Moments& m : slipping_) m.clear();
  filled_ = 0;
  bool sticks = false;
  for (std::size_t k = 0; k < phases_.list().size(); ++k) {
    const DiscPhase& phase = phases_.list()[k];
    if (phase.state == DiscPhase::State::open) continue;
    begin(phase);
    if (k == keep_) kept_ = dw_;
    if (phase.state == DiscPhase::State::stick) {
      sticks = true;
      stick(phase);
    } else {
      slip(phase);
    }
  }
  add_nodes();
  for (int i = 0; i < 2; ++i) {
    if (sticks) stick_.add_to(by_.block(i * c_, i * c_, c_, c_), fourier_factor);
    slipping_[i].close();
    slipping_[i].add_to(by_.block(i * c_, 2 * c_, c_, c_), 1);
  }
  if (keep_ != nothing) first_.setZero();
  if (phases_.list().front().from != DiscPhase::Begin::closing &&
      phases_.list().front().state != DiscPhase::State::open)
    close_period();
  by_.row(0) *= 0.5;
  by_.row(c_) *= 0.5;
}

void DiscStretch::rest_derivative(std::size_t phase, Eigen::Ref<Eigen::MatrixXd> dw) {
  keep_ = phase;
  differentiate();
  keep_ = nothing;
  dw = phases_.full_stick() ? dw_.leftCols(3 * c_) : kept_.leftCols(3 * c_);
  if (!phases_.full_stick()) dw.noalias() += kept_.rightCols(2) * first_.leftCols(3 * c_);
}

// dw_ of a stick phase or dpsi_ of a slip phase, at its beginning.
void DiscStretch::begin(const DiscPhase& phase) {
  const bool first = &phase == &phases_.list().front();
  const DiscPoint at = disc_->at(phase.begin);
  if (phase.from == DiscPhase::Begin::closing) {
    series_basis(h_, phase.begin, basis_);
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
    series_basis(h_, phase.begin, basis_);
    for (int i = 0; i < 2; ++i) dpsi_.segment(i * c_, c_) += tangent(i, psi) * basis_.transpose();
    if (at.h > 0) dpsi_ /= at.h;
    return;
  }
  // stick from slip, whose dw_ is set at its end
}

void DiscStretch::stick(const DiscPhase& phase) {
  integrate_basis(phase.begin, phase.end);
  for (int i = 0; i < 2; ++i) by_.middleRows(i * c_, c_).noalias() -= fourier_factor * g_ * dw_.row(i);
}

void DiscStretch::slip(const DiscPhase& phase) {
  for (std::size_t k = phase.first_panel; k < phase.last_panel; ++k) {
    if (filled_ == rows_.rows()) add_nodes();
    const SlipPanel& panel = phases_.panel(k);
    const SlipPanel::Nodes weights = fourier_factor * phases_.collocation().weights(panel);
    set_bases(panel);
    auto rows = rows_.middleRows(filled_, panel_nodes);
    auto weighted = weighted_.middleRows(filled_, panel_nodes);
    filled_ += panel_nodes;
    for (int i = 0; i < 2; ++i) {
      const SlipPanel::Nodes share = weights.cwiseProduct(panel.h).cwiseProduct(panel.turn[i]);
      rows.middleCols(i * c_, c_) = panel.turn[i].asDiagonal() * slope_;
      weighted.middleCols(i * c_, c_) = share.asDiagonal() * phi_;
    }
    rows.middleCols(2 * c_, c_) = -(panel.rate.asDiagonal() * phi_);
    rows.rightCols(2).setZero();
    rows.noalias() -= phases_.collocation().column(panel) * dpsi_;
    SlipFactors factors;
    factors.factorize(phases_.collocation().matrix(panel));
    // The inverse pays off where it is used often.
    if (rows.cols() < 2 * panel_nodes) {
      for (Eigen::Index j = 0; j < rows.cols(); ++j) rows.col(j) = factors.solve(rows.col(j));
    } else {
      const SlipPanel::Square inverse = factors.inverse();
      for (Eigen::Index j = 0; j < rows.cols(); ++j) {
        const SlipPanel::Nodes right = rows.col(j);
        rows.col(j).noalias() = inverse.lazyProduct(right);
      }
    }
    dpsi_ = rows.row(panel_nodes - 1);
    add_moments(panel, weights);
  }
  const double psi = phase.last_panel > phase.first_panel ? phases_.panel(phase.last_panel - 1).to() : 0;
  const DiscPoint at = disc_->at(phase.end);
  series_basis(h_, phase.end, basis_);
  for (int i = 0; i < 2; ++i) {
    dw_.row(i) = -std::max(at.h, 0.0) * tangent(i, psi) * dpsi_;
    dw_.row(i).segment(i * c_, c_) += basis_.transpose();
    dw_.row(i).segment(2 * c_, c_) -= outward(i, psi) * basis_.transpose();
  }
}

// Of n.
void DiscStretch::add_moments(const SlipPanel& panel, const SlipPanel::Nodes& weights) {
  const SlipPanel::Nodes n[] = {weights.cwiseProduct(panel.outward[0]),
                                weights.cwiseProduct(panel.outward[1])};
  SlipPanel::Nodes cosine = SlipPanel::Nodes::Ones(), sine = SlipPanel::Nodes::Zero();
  for (int q = 0; q < slipping_[0].count(); ++q) {
    for (int i = 0; i < 2; ++i) slipping_[i].add(q, n[i].dot(cosine), n[i].dot(sine));
    const SlipPanel::Nodes next = cosine.cwiseProduct(panel.cosine) - sine.cwiseProduct(panel.sine);
    sine = sine.cwiseProduct(panel.cosine) + cosine.cwiseProduct(panel.sine);
    cosine = next;
  }
}

// The integrals over slip of h t dpsi, of the nodes whose dpsi is in rows_.
void DiscStretch::add_nodes() {
  by_.noalias() += weighted_.topRows(filled_).transpose() * rows_.topRows(filled_);
  filled_ = 0;
}

// What follows from the state at the beginning, which is that after the period.
void DiscStretch::close_period() {
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

}  // namespace arcslip::elements
