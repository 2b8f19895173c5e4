#include <arcslip/fourier/samples.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr double same_sample_height = 1e-12;  // of the range of the motion

// The first of several samples that are equally high to rounding, as in a motion with a shorter period than
// the force.
int first_of(In x, double height, double same) {
  Eigen::Index s = 0;
  while (std::abs(x[s] - height) > same) ++s;
  return static_cast<int>(s);
}

std::uint64_t with_sample(std::uint64_t piece, int sample) {
  return hashed(piece, static_cast<std::uint64_t>(sample) << 2);
}

// One march over the span from the sample of largest x, where f = +p, is periodic by construction. The
// samples that stick depend on their anchor, the last sample that slipped. The indices of the highest and the
// lowest sample are part of the piece, like the slipping samples: anchors and centre depend on them.
class SampledJenkins final : public Element {
 public:
  SampledJenkins(const Harmonics& h, int samples, Offset offset)
      : h_(h),
        offset_(offset),
        samples_(h, h.odd ? (samples + 1) / 2 : samples),
        moments_(h),
        x_(samples_.count()),
        stick_(samples_.count()),
        A_(h.size()),
        B_(h.size()),
        F_(h.size()),
        J_(h.size(), h.size()),
        integral_(h.size()),
        weights_A_(samples_.count()),
        weights_B_(samples_.count()) {
    onsets_.reserve(static_cast<std::size_t>(samples_.count()));
    ends_.reserve(onsets_.capacity());
  }

  void move_to(In u, std::span<const double> fields, bool jacobian) override {
    fields_ = {fields[0], fields[1], fields[2]};
    const double kd = fields[0], p = fields[1] * fields[2], x_s = p / kd;
    samples_.values(u, x_);
    onsets_.clear();
    ends_.clear();
    A_.setZero();
    B_.setZero();
    if (jacobian) J_.setZero();
    const double high = x_.maxCoeff(), low = x_.minCoeff();
    const double range = h_.odd ? 2 * std::max(high, -low) : high - low;
    const int highest = first_of(x_, high, same_sample_height * range);
    const int lowest = first_of(x_, low, same_sample_height * range);
    if (p == 0 && range == 0) {
      stick_share_ = 0;
      piece_ = 0;
      F_.setZero();
    } else if (range <= 2 * x_s) {
      stick(u, kd, x_s, highest, lowest, jacobian);
    } else {
      // Where the motion is odd it may begin at the lowest sample, seen with the other sign.
      const bool mirrored = h_.odd && -low > high;
      march(u, mirrored ? lowest : highest, mirrored ? -1 : 1, kd, x_s, jacobian);
      F_ = kd * A_ + p * B_;
      if (p == 0) piece_ = 0;  // no force, whatever slips
    }
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }

  void field_derivative(int field, Out dF) const override {
    if (field == 0)
      dF = A_;
    else
      dF = (field == 1 ? fields_[2] : fields_[1]) * B_;
  }

  std::uint64_t piece() const override { return piece_; }

  bool friction(FrictionState& state) const override {
    state.stick_share = stick_share_;
    state.slip_onsets = onsets_;
    state.slip_ends = ends_;
    std::sort(state.slip_onsets.begin(), state.slip_onsets.end());
    std::sort(state.slip_ends.begin(), state.slip_ends.end());
    return true;
  }

 private:
  void note(std::vector<double>& angles, double at) const {
    for (double shift = 0; shift < 2 * std::numbers::pi - 1e-9; shift += h_.span())
      angles.push_back(std::fmod(at + shift, 2 * std::numbers::pi));
  }

  // A sample that slips in the direction `sign`, after one that slipped or stuck with the force `before`.
  void note_slip(int sample, double sign, bool slipped, double before) {
    if (slipped && sign == before) return;
    if (slipped) note(ends_, samples_.angle(sample - 1));  // it turned, and sticks at no sample
    note(onsets_, samples_.angle(sample));
  }

  void stick(In u, double kd, double x_s, int highest, int lowest, bool jacobian) {
    stick_share_ = 1;
    piece_ = 1;
    A_ = u;
    if (jacobian) J_.diagonal().setConstant(kd);
    if (!h_.odd) {
      const StuckSlider at = stuck_slider(offset_, x_[highest] - x_s, x_[lowest] + x_s);
      if (at.lower > 0) piece_ = with_sample(piece_, highest);
      if (at.upper > 0) piece_ = with_sample(piece_ + 1, lowest);
      A_[0] -= at.lower * x_[highest] + at.upper * x_[lowest];
      B_[0] = at.lower - at.upper;
      if (jacobian)
        J_.row(0) -= kd * (at.lower * samples_.basis(highest) + at.upper * samples_.basis(lowest));
    }
    F_ = kd * A_;
    if (B_[0] != 0) F_[0] += kd * x_s * B_[0];
  }

  // The sample that lies `offset` after the top, and the sign with which it appears there.
  struct Seen {
    int sample;
    double sign;
  };
  Seen seen(int top, int offset, double turned) const {
    const int at = top + offset;
    const bool wrapped = at >= samples_.count();
    return {wrapped ? at - samples_.count() : at, wrapped && h_.odd ? -turned : turned};
  }

  void march(In u, int top, double turned, double kd, double x_s, bool jacobian) {
    const double kappa = (h_.odd ? 2 : 1) / std::numbers::pi * samples_.weight();
    stick_.setZero();
    weights_A_.setZero();
    weights_B_.setZero();
    integral_.setZero();
    int anchor = 0, stuck = 0;
    double anchor_x = turned * x_[top], anchored = 1;
    bool slipping = true;
    piece_ = with_sample(2, 2 * top + (turned < 0));
    const auto close_anchor = [&] {
      if (!jacobian) return;
      const Seen a = seen(top, anchor, turned);
      J_.noalias() -= (kappa * kd * a.sign * integral_) * samples_.basis(a.sample);
      integral_.setZero();
    };
    for (int k = 0; k < samples_.count(); ++k) {
      const Seen s = seen(top, k, turned);
      const double x = s.sign * x_[s.sample];
      const double elastic = anchored * x_s + (x - anchor_x);  // f/k_d if it sticks; the top slips
      const bool slips = std::abs(elastic) >= x_s;
      piece_ = hashed(piece_, slips ? 1u : 2u);
      if (slips) {
        const double sign = elastic > 0 ? 1 : -1;
        note_slip(top + k, sign, slipping, anchored);
        close_anchor();
        anchor = k;
        anchor_x = x;
        anchored = sign;
      } else {
        if (slipping) note(ends_, samples_.angle(top + k - 1));
        ++stuck;
        stick_[s.sample] = kappa;
        weights_A_[s.sample] = -s.sign * kappa * anchor_x;
        if (jacobian) integral_ += s.sign * samples_.basis(s.sample).transpose();
      }
      weights_B_[s.sample] = s.sign * kappa * anchored;
      slipping = slips;
    }
    note_slip(top + samples_.count(), h_.odd ? -1 : 1, slipping, anchored);  // the top again
    close_anchor();
    stick_share_ = static_cast<double>(stuck) / samples_.count();
    samples_.moments(stick_, moments_);
    samples_.project(weights_A_, A_);
    samples_.project(weights_B_, B_);
    moments_.times(u, 1, A_);
    if (jacobian) moments_.add_to(J_, kd);
    if (!h_.odd) {
      A_[0] *= 0.5;
      B_[0] *= 0.5;
      if (jacobian) J_.row(0) *= 0.5;
    }
  }

  Harmonics h_;
  Offset offset_;
  Samples samples_;
  Moments moments_;
  Eigen::VectorXd x_, stick_, A_, B_, F_;
  Eigen::MatrixXd J_;
  Eigen::VectorXd integral_, weights_A_, weights_B_;
  std::vector<double> onsets_, ends_;
  std::array<double, 3> fields_{};
  double stick_share_ = 1;
  std::uint64_t piece_ = 0;
};

}  // namespace

std::unique_ptr<Element> make_sampled_jenkins(const Harmonics& harmonics, int samples, Offset offset) {
  return std::make_unique<SampledJenkins>(harmonics, samples, offset);
}

}  // namespace arcslip::elements
