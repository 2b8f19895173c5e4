#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <arcslip/fourier/moments.hpp>
#include <arcslip/laws/hysteresis/friction_phases.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

namespace arcslip::elements {
namespace {

double wrapped(double angle) {
  const double turn = 2 * std::numbers::pi;
  angle = std::fmod(angle, turn);
  return angle < 0 ? angle + turn : angle;
}

class ExactJenkins final : public Element {
 public:
  ExactJenkins(const Harmonics& h, Offset offset)
      : h_(h),
        offset_(offset),
        phases_(h),
        moments_(h),
        A_(h.size()),
        B_(h.size()),
        F_(h.size()),
        J_(h.size(), h.size()),
        integral_(h.size()),
        anchor_(h.size()),
        sum_(static_cast<std::size_t>(2 * h.order + 1)),
        half_(sum_.size()),
        inverse_(sum_.size()) {
    inverse_[0] = 0;
    for (std::size_t k = 1; k < inverse_.size(); ++k) inverse_[k] = 1.0 / static_cast<double>(k);
  }

  void move_to(In u, std::span<const double> fields, bool jacobian) override {
    fields_ = {fields[0], fields[1], fields[2]};
    const double kd = fields[jenkins_field::stiffness],
                 p = fields[jenkins_field::friction_coefficient] * fields[jenkins_field::normal_load];
    const double reach = series_bound(h_, u, 0);
    limit_ = p;
    u_0_ = u[0];
    sliding_ = nullptr;
    frictionless_ = p == 0 && reach == 0;
    if (frictionless_) {
      A_.setZero();
      B_.setZero();
      F_.setZero();
      if (jacobian) J_.setZero();
      return;
    }
    if (h_.odd && kd * reach <= p) {  // surely stuck: half the range of x is at most `reach`
      stick(u, kd, jacobian);
      return;
    }
    const auto& phases = phases_.find(u, p / kd);
    if (phases.empty()) {
      stick(u, kd, jacobian);
      return;
    }
    slide(u, phases, kd, p, jacobian);
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }

  void field_derivative(int field, Out dF) const override {
    switch (field) {
      case jenkins_field::stiffness:
        dF = A_;
        break;
      case jenkins_field::friction_coefficient:
        dF = fields_[jenkins_field::normal_load] * B_;
        break;
      default:
        dF = fields_[jenkins_field::friction_coefficient] * B_;
        break;
    }
  }

  std::uint64_t piece() const override {
    if (frictionless_ || limit_ == 0) return 0;  // no force, whatever the phases
    if (!sliding_) return h_.odd ? 1 : piece_of_stick();
    std::uint64_t hash = empty_hash;
    for (const FrictionPhase& phase : *sliding_) {
      hash = hashed(hash, static_cast<std::uint64_t>(2 + phase.sign));
      hash = hashed(hash, static_cast<std::uint64_t>(2 + phase.slip_sign));
    }
    return hash;
  }

  bool friction(FrictionState& state) const override {
    state.slip_onsets.clear();
    state.slip_ends.clear();
    state.stick_share = frictionless_ ? 0 : 1;
    state.mean_min = state.mean_max = h_.odd ? 0 : F_[0];
    if (!sliding_) {
      tell_mean(state);
      return true;
    }
    double stuck = 0;
    for (const FrictionPhase& phase : *sliding_) {
      stuck += phase.end - phase.begin;
      if (phase.slip_end == phase.end) continue;
      for (double shift = 0; shift < 2 * std::numbers::pi - 1e-9; shift += h_.span()) {
        state.slip_onsets.push_back(wrapped(phase.end + shift));
        state.slip_ends.push_back(wrapped(phase.slip_end + shift));
      }
    }
    std::sort(state.slip_onsets.begin(), state.slip_onsets.end());
    std::sort(state.slip_ends.begin(), state.slip_ends.end());
    state.stick_share = stuck / h_.span();
    return true;
  }

  bool place_slider(double share) override {
    offset_ = Offset::placed;
    share_ = share;
    return true;
  }

  void contact(std::vector<ContactInterval>& intervals) const override {
    intervals.clear();
    if (!sliding_) {
      intervals.push_back({frictionless_ ? "slip" : "stick", 0, 2 * std::numbers::pi});
      return;
    }
    const auto slip = [](double sign) { return sign > 0 ? "slip+" : "slip-"; };
    double mirror = 1;
    for (double shift = 0; shift < 2 * std::numbers::pi - 1e-9; shift += h_.span(), mirror = -mirror) {
      for (const FrictionPhase& phase : *sliding_) {
        intervals.push_back({"stick", phase.begin + shift, phase.end + shift});
        intervals.push_back({slip(mirror * phase.slip_sign), phase.end + shift, phase.slip_end + shift});
      }
    }
  }

 private:
  void stick(In u, double kd, bool jacobian) {
    A_ = u;
    B_.setZero();
    if (jacobian) {
      J_.setZero();
      J_.diagonal().setConstant(kd);
    }
    if (!h_.odd) {
      const Reversal high = phases_.highest(), low = phases_.lowest();
      held_ = stuck_slider(offset_, high.x - limit_ / kd, low.x + limit_ / kd, share_);
      A_[0] -= held_.lower * high.x + held_.upper * low.x;
      B_[0] = held_.lower - held_.upper;
      if (jacobian) {
        series_basis(h_, high.theta, anchor_);
        series_basis(h_, low.theta, integral_);
        J_.row(0) -= kd * (held_.lower * anchor_ + held_.upper * integral_).transpose();
      }
    }
    F_ = kd * A_;
    if (B_[0] != 0) F_[0] += limit_ * B_[0];
  }

  // Another number where w follows another extreme.
  std::uint64_t piece_of_stick() const {
    if (offset_ != Offset::static_loads) return 2 + phases_.extremes();
    if (held_.lower == 0 && held_.upper == 0) return 1;
    return 2 + 2 * phases_.extremes() + (held_.upper > 0 ? 1 : 0);
  }

  // k_d (u_0 - w) for w from a to b.
  void tell_mean(FrictionState& state) const {
    if (frictionless_) return;
    const double kd = fields_[jenkins_field::stiffness];
    if (h_.odd) phases_.find(A_, limit_ / kd);  // A is u here
    const double mean = h_.odd ? 0 : u_0_;
    state.mean_min = kd * (mean - phases_.lowest().x) - limit_;
    state.mean_max =
        std::max(kd * (mean - phases_.highest().x) + limit_, state.mean_min);  // but for rounding
  }

  // Integral of the basis over an interval from the powers at its middle (sum_) and its half length (half_).
  void integrate_basis(double length) {
    for (int i = 0; i < h_.cosines(); ++i) {
      const auto n = static_cast<std::size_t>(h_.cosine_order(i));
      integral_[i] = n == 0 ? length : 2 * half_[n].imag() * inverse_[n] * sum_[n].real();
    }
    for (int j = 0; j < h_.sines(); ++j) {
      const auto n = static_cast<std::size_t>(h_.sine_order(j));
      integral_[h_.cosines() + j] = 2 * half_[n].imag() * inverse_[n] * sum_[n].imag();
    }
  }

  void powers_of(double begin, double end, int count) {
    powers(0.5 * (begin + end), count, sum_.data());
    powers(0.5 * (end - begin), count, half_.data());
  }

  void slide(In u, const std::vector<FrictionPhase>& phases, double kd, double p, bool jacobian) {
    sliding_ = &phases;
    const double kappa = (h_.odd ? 2 : 1) / std::numbers::pi;
    A_.setZero();
    B_.setZero();
    if (jacobian) J_.setZero();
    moments_.clear();
    for (const FrictionPhase& phase : phases) {
      powers_of(phase.begin, phase.end, 2 * h_.order + 1);
      moments_.add_interval(phase.end - phase.begin, sum_.data(), half_.data());
      integrate_basis(phase.end - phase.begin);
      A_ -= kappa * phase.anchor_x * integral_;
      B_ += kappa * phase.sign * integral_;
      if (jacobian) {
        basis_at_begin();
        J_.noalias() -= (kappa * kd * integral_) * anchor_.transpose();
      }
      if (phase.slip_end > phase.end) {
        powers_of(phase.end, phase.slip_end, h_.order + 1);
        integrate_basis(phase.slip_end - phase.end);
        B_ += kappa * phase.slip_sign * integral_;
      }
    }
    moments_.close();
    moments_.times(u, kappa, A_);
    if (jacobian) moments_.add_to(J_, kappa * kd);
    if (!h_.odd) {
      A_[0] *= 0.5;
      B_[0] *= 0.5;
      if (jacobian) J_.row(0) *= 0.5;
    }
    F_ = kd * A_ + p * B_;
  }

  // phi at the beginning of the interval of the last powers_of(): exp(i n (s - d)).
  void basis_at_begin() {
    for (int i = 0; i < h_.cosines(); ++i) {
      const auto n = static_cast<std::size_t>(h_.cosine_order(i));
      anchor_[i] = sum_[n].real() * half_[n].real() + sum_[n].imag() * half_[n].imag();
    }
    for (int j = 0; j < h_.sines(); ++j) {
      const auto n = static_cast<std::size_t>(h_.sine_order(j));
      anchor_[h_.cosines() + j] = sum_[n].imag() * half_[n].real() - sum_[n].real() * half_[n].imag();
    }
  }

  Harmonics h_;
  Offset offset_;
  double share_ = 0.5;  // where it is placed
  mutable FrictionPhases phases_;
  Moments moments_;
  Eigen::VectorXd A_, B_, F_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd integral_, anchor_;
  std::vector<std::complex<double>> sum_, half_;
  std::vector<double> inverse_;
  std::array<double, 3> fields_{};
  const std::vector<FrictionPhase>* sliding_ = nullptr;
  StuckSlider held_;
  double limit_ = 0, u_0_ = 0;
  bool frictionless_ = false;
};

}  // namespace

std::unique_ptr<Element> make_jenkins(const Harmonics& harmonics, Offset offset) {
  return std::make_unique<ExactJenkins>(harmonics, offset);
}

}  // namespace arcslip::elements
