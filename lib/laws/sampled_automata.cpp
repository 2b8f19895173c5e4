#include <arcslip/laws/sampled_automata.hpp>

#include <arcslip/fourier/samples.hpp>
#include <arcslip/laws/automata_rates.hpp>
#include <arcslip/laws/automaton_samples.hpp>
#include <arcslip/laws/piece_hash.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace arcslip::elements {
namespace {

constexpr double nudge = 1e-3, least_nudge = 1e-30;  // of a field at whose value an automaton has other modes
constexpr double same_rate = 1e-9;                   // of forces over two nudges: they are in proportion

class SampledAutomata final : public Element {
 public:
  SampledAutomata(const Law& law, const Harmonics& h, int samples)
      : law_(law),
        h_(h),
        d_(law.directions()),
        samples_(h, h.odd ? (samples + 1) / 2 : samples),
        moments_(h),
        q_(samples_.count(), d_),
        f_(samples_.count(), d_),
        f_q_(samples_.count(), d_ * d_),
        F_(d_ * h.size()),
        J_(F_.size(), F_.size()),
        integral_(h.size(), d_) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    take(fields);
    const Eigen::Index c = h_.size();
    for (Eigen::Index i = 0; i < d_; ++i) samples_.values(u.segment(i * c, c), q_.col(i));
    f_.setZero();
    for (AutomatonSamples& course : courses_) {
      course.follow(q_);
      add_force(course);
    }
    for (Eigen::Index i = 0; i < d_; ++i) samples_.coefficients(f_.col(i), F_.segment(i * c, c));
    if (jacobian) set_jacobian();
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }

  void field_derivative(int field, Out dF) const override {
    std::vector<double> along(fields_.size());
    along[static_cast<std::size_t>(field)] = 1;
    const auto rates = automata_rates(law_, fields_, along);
    if (!rates) return difference(field, dF);
    Eigen::MatrixXd by_field = Eigen::MatrixXd::Zero(f_.rows(), d_);
    for (std::size_t a = 0; a < courses_.size(); ++a) add_rates(courses_[a], (*rates)[a], by_field);
    for (Eigen::Index i = 0; i < d_; ++i)
      samples_.coefficients(by_field.col(i), dF.segment(i * h_.size(), h_.size()));
  }

  std::uint64_t piece() const override {
    std::uint64_t all = empty_hash;
    for (const AutomatonSamples& course : courses_) all = hashed(all, course.piece());
    return all;
  }

  bool friction(FrictionState& state) const override {
    if (!law_.has_contact()) return false;
    state = {};
    double weights = 0;
    int sliders = 0;
    for (const AutomatonSamples& course : courses_) {
      if (!course.slides()) continue;
      ++sliders;
      const double weight = course.automaton().weight;
      weights += weight;
      int stuck = 0, open = 0;
      for (int s = 0; s < samples_.count(); ++s) {
        const Mode& mode = course.mode(course.at(s).mode);
        (mode.open ? open : stuck) += mode.open || mode.rests;
      }
      state.stick_share += weight * stuck / samples_.count();
      state.open_share += weight * open / samples_.count();
    }
    if (weights > 0) {
      state.stick_share /= weights;
      state.open_share /= weights;
    }
    for (const AutomatonSamples& course : courses_)
      if (sliders == 1 && course.slides() && !course.sticks()) note_slip(course, state);
    std::sort(state.slip_onsets.begin(), state.slip_onsets.end());
    std::sort(state.slip_ends.begin(), state.slip_ends.end());
    if (law_.has_normal_load()) {
      state.load_max = law_.normal_load_at(fields_, q_.col(d_ - 1).maxCoeff());
      state.load_min = law_.normal_load_at(fields_, q_.col(d_ - 1).minCoeff());
    }
    return true;
  }

 private:
  void take(Fields fields) {
    if (!courses_.empty() && std::equal(fields.begin(), fields.end(), fields_.begin(), fields_.end())) return;
    fields_.assign(fields.begin(), fields.end());
    std::vector<Automaton> automata = automata_of(law_, fields);
    for (std::size_t a = 0; a < automata.size(); ++a)
      if (a < courses_.size())
        courses_[a].renew(std::move(automata[a]));
      else
        courses_.emplace_back(std::move(automata[a]), h_, samples_.count());
    courses_.erase(courses_.begin() + std::ssize(automata), courses_.end());
  }

  void add_force(const AutomatonSamples& course) {
    for (int s = 0; s < samples_.count(); ++s) {
      const AutomatonSamples::Sample& at = course.at(s);
      const Mode& mode = course.mode(at.mode);
      for (Eigen::Index i = 0; i < d_; ++i) {
        double f = mode.f_0[i] + (course.holds(mode) ? mode.f_z[i] * at.z : 0);
        for (Eigen::Index j = 0; j < d_; ++j) f += at.sign * mode.f_q(i, j) * q_(s, j);
        f_(s, i) += at.sign * f;
      }
    }
  }

  void set_jacobian() {
    const Eigen::Index c = h_.size();
    f_q_.setZero();
    for (const AutomatonSamples& course : courses_)
      for (int s = 0; s < samples_.count(); ++s)
        for (Eigen::Index k = 0; k < f_q_.cols(); ++k)
          f_q_(s, k) += course.mode(course.at(s).mode).f_q.data()[k];
    J_.setZero();
    for (Eigen::Index j = 0; j < d_; ++j)
      for (Eigen::Index i = 0; i < d_; ++i) {
        samples_.moments(f_q_.col(j * d_ + i), moments_);
        moments_.add_to(J_.block(i * c, j * c, c, c), samples_.factor());
      }
    for (const AutomatonSamples& course : courses_)
      if (course.slides()) add_anchors(course);
    if (h_.odd) return;
    for (Eigen::Index i = 0; i < d_; ++i) J_.row(i * c) *= 0.5;
  }

  // The forces of samples that stick, by the sample where their slider was at a bound last.
  void add_anchors(const AutomatonSamples& course) {
    integral_.setZero();
    if (course.sticks()) {
      for (int s = 0; s < samples_.count(); ++s) add_sample(course, s);
      const StuckSlider& stuck = course.stuck();
      if (stuck.lower != 0) add_anchor(course.mode(course.lower_mode()), course.highest(), stuck.lower);
      if (stuck.upper != 0) add_anchor(course.mode(course.upper_mode()), course.lowest(), stuck.upper);
      return;
    }
    bool any = false;
    const AutomatonSamples::Sample* last = nullptr;
    const auto close = [&] {
      if (any) add_anchor(course.mode(last->anchor_mode), last->anchor, last->anchor_sign);
      if (any) integral_.setZero();
      any = false;
    };
    for (int k = 0; k < samples_.count(); ++k) {
      const int s = (course.first() + k) % samples_.count();
      const AutomatonSamples::Sample& at = course.at(s);
      if (last != nullptr && at.anchor != last->anchor) close();
      last = &at;
      if (!course.mode(at.mode).rests) continue;
      add_sample(course, s);
      any = true;
    }
    close();
  }
  void add_sample(const AutomatonSamples& course, int s) {
    const AutomatonSamples::Sample& at = course.at(s);
    const Mode& mode = course.mode(at.mode);
    for (Eigen::Index i = 0; i < d_; ++i)
      if (mode.f_z[i] != 0) integral_.col(i) += at.sign * mode.f_z[i] * samples_.basis(s).transpose();
  }
  void add_anchor(const Mode& mode, int sample, double weight) {
    const Eigen::Index c = h_.size();
    for (Eigen::Index j = 0; j < d_; ++j)
      for (Eigen::Index i = 0; i < d_; ++i)
        if (mode.z_q[j] != 0 && !integral_.col(i).isZero(0))
          J_.block(i * c, j * c, c, c).noalias() +=
              (samples_.factor() * weight * mode.z_q[j] * integral_.col(i)) * samples_.basis(sample);
  }

  // f' = f_q' q + f_z' z + f_z z' + f_0', where the derivatives of the numbers are those of `rates`.
  void add_rates(const AutomatonSamples& course, const Automaton& rates, Eigen::MatrixXd& by_field) const {
    const auto of = [&](int m) -> const Mode& { return rates.modes[static_cast<std::size_t>(m)]; };
    const StuckSlider& stuck = course.stuck();
    const double z_of_stuck =
        !course.sticks() ? 0
                         : stuck.lower * course.bound(of(course.lower_mode()), q_, course.highest()) +
                               stuck.upper * course.bound(of(course.upper_mode()), q_, course.lowest());
    for (int s = 0; s < samples_.count(); ++s) {
      const AutomatonSamples::Sample& at = course.at(s);
      const Mode &mode = course.mode(at.mode), &rate = of(at.mode);
      const bool held = course.holds(mode);
      const double z = !held             ? 0
                       : course.sticks() ? z_of_stuck
                                         : course.bound(of(at.anchor_mode), q_, at.anchor, at.anchor_sign);
      for (Eigen::Index i = 0; i < d_; ++i) {
        double f = rate.f_0[i] + (held ? rate.f_z[i] * at.z + mode.f_z[i] * z : 0);
        for (Eigen::Index j = 0; j < d_; ++j) f += at.sign * rate.f_q(i, j) * q_(s, j);
        by_field(s, i) += at.sign * f;
      }
    }
  }

  // Where the automata have other modes next to these fields: over so small a change that twice as much has
  // twice the effect.
  void difference(int field, Out dF) const {
    double h = nudge * std::max(1.0, std::abs(fields_[static_cast<std::size_t>(field)]));
    Eigen::MatrixXd rate = rate_over(field, h);
    for (; h > least_nudge; h *= nudge) {
      const Eigen::MatrixXd next = rate_over(field, 0.5 * h);
      const bool same = (next - rate).norm() <= same_rate * next.norm();
      rate = same ? next : rate_over(field, nudge * h);
      if (same) break;
    }
    for (Eigen::Index i = 0; i < d_; ++i)
      samples_.coefficients(rate.col(i), dF.segment(i * h_.size(), h_.size()));
  }
  Eigen::MatrixXd rate_over(int field, double h) const {
    SampledAutomata there(*this);
    std::vector<double> moved = fields_;
    moved[static_cast<std::size_t>(field)] += h;
    there.take(moved);
    there.f_.setZero();
    for (AutomatonSamples& course : there.courses_) {
      course.follow(there.q_);
      there.add_force(course);
    }
    return (there.f_ - f_) / h;
  }

  void note(std::vector<double>& angles, double at) const {
    for (double shift = 0; shift < whole_turn - 1e-9; shift += h_.span())
      angles.push_back(std::fmod(at + shift, whole_turn));
  }
  // Onsets at the first samples that slip, or slip the other way, ends at the last ones.
  void note_slip(const AutomatonSamples& course, FrictionState& state) const {
    const auto slips = [&](const Mode& mode) { return !mode.rests && !mode.open; };
    const Mode* last = &course.mode(course.at(course.first()).mode);
    const int begin = last->way;
    for (int k = 1; k <= samples_.count(); ++k) {
      const int sample = course.first() + k;
      const Mode& mode = course.mode(course.at(sample % samples_.count()).mode);
      const int way = k < samples_.count() ? mode.way : h_.odd ? -begin : begin;
      const bool other = !slips(*last) || way != last->way;
      if (slips(*last) && (!slips(mode) || other)) note(state.slip_ends, samples_.angle(sample - 1));
      if (slips(mode) && other) note(state.slip_onsets, samples_.angle(sample));
      last = &mode;
    }
  }

  const Law& law_;
  Harmonics h_;
  Eigen::Index d_;
  Samples samples_;
  Moments moments_;
  std::vector<double> fields_;
  std::vector<AutomatonSamples> courses_;
  Eigen::MatrixXd q_, f_, f_q_;
  Eigen::VectorXd F_;
  Eigen::MatrixXd J_, integral_;
};

}  // namespace

std::unique_ptr<Element> sampled_automata(const Law& law, const Harmonics& harmonics, int samples) {
  return std::make_unique<SampledAutomata>(law, harmonics, samples);
}

}  // namespace arcslip::elements
