#include <arcslip/laws/memoryless/kinked_element.hpp>

#include <arcslip/laws/memoryless/kink_finder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace arcslip::elements {
namespace {

constexpr int nodes = 12;
constexpr std::array<double, nodes / 2> gauss_nodes = {0.1252334085114689, 0.3678314989981802,
                                                       0.5873179542866175, 0.7699026741943047,
                                                       0.9041172563704749, 0.9815606342467193};
constexpr std::array<double, nodes / 2> gauss_weights = {0.2491470458134028, 0.2334925365383548,
                                                         0.2031674267230659, 0.1600783285433462,
                                                         0.1069393259953184, 0.0471753363865118};
constexpr double resolved_angle = 11;     // rad of the highest harmonic of the integrand, in one panel
constexpr double shortest_piece = 1e-14;  // rad
constexpr double next_to_kink = 1e-10;    // rad: of a kink, on either side of it
constexpr double least_jump = 1e-7;       // over the largest force
constexpr double at_rest = 1e-9;          // a velocity over its bound

// A quarter wave of the highest harmonic, or what the rule integrates exactly of polynomials of a high
// degree. Of other pieces half of that.
double longest_panel(const FormulaLaw& law, const Harmonics& h) {
  const double quarter_wave = 0.5 * std::numbers::pi / (h.order + 1);
  const auto& degree = law.degree_of_pieces();
  if (!degree) return 0.5 * quarter_wave;
  return std::min(quarter_wave,
                  resolved_angle / ((degree->motion + 1.0) * h.order + degree->orders * h.period));
}

struct Panel {
  double middle, half;
};

/// The integrals at one place after another.
class KinkedIntegrals {
 public:
  KinkedIntegrals(const FormulaLaw& law, const Harmonics& h)
      : law_(law),
        h_(h),
        directions_(law.directions()),
        finder_(law, h),
        q_(nodes, directions_),
        v_(nodes, directions_),
        phase_(nodes),
        at_(nodes, directions_, law.inputs().fields),
        q_kink_(2, directions_),
        v_kink_(2, directions_),
        phase_kink_(2),
        at_kink_(2, directions_, law.inputs().fields),
        powers_(2 * h.order + 1, nodes + 2),
        fields_(static_cast<std::size_t>(law.inputs().fields)),
        u_(directions_ * h.size()),
        F_(u_.size()),
        by_frequency_(u_.size()),
        kink_rate_(u_.size()),
        phi_(h.size()),
        by_field_(u_.size(), law.inputs().fields),
        J_(u_.size(), u_.size()),
        block_(h.size(), h.size()),
        longest_(longest_panel(law, h)) {
    by_q_.assign(static_cast<std::size_t>(directions_ * directions_), Moments(h));
    if (law.rate_dependent()) by_v_ = by_q_;
  }

  void set_frequency(double base_frequency) { frequency_ = base_frequency; }
  void move_to(In u, Fields fields, bool jacobian) {
    u_ = u;
    std::copy(fields.begin(), fields.end(), fields_.begin());
    has_field_derivatives_ = false;
    has_tangent_ = jacobian;
    set_panels();
    integrate(jacobian ? Wanted::tangent : Wanted::force);
    set_jumps();
    if (jacobian) assemble();
  }

  const Eigen::VectorXd& force() const { return F_; }
  const Eigen::MatrixXd& jacobian() const { return J_; }
  std::uint64_t piece() const { return piece_; }
  double jump_over_bend() const { return jump_over_bend_; }

  void frequency_derivative(Out dF) {
    dF.setZero();
    if (by_v_.empty()) return;
    if (!has_tangent_) integrate(Wanted::tangent);
    has_tangent_ = true;
    dF = by_frequency_;
    add_jumps([&](const Kink& kink) { return finder_.rate_by_frequency(kink); }, dF);
  }

  void field_derivative(int field, Out dF) {
    if (!has_field_derivatives_) integrate(Wanted::by_fields);
    has_field_derivatives_ = true;
    dF = by_field_.col(field);
    add_jumps([&](const Kink& kink) { return finder_.rate_by_field(kink, field); }, dF);
  }

 private:
  double factor() const { return (h_.odd ? 2 : 1) * fourier_factor; }

  // Between the kinks, and within a piece a quarter wave at most.
  void set_panels() {
    const auto& kinks = finder_.find(u_, frequency_, fields_);
    panels_.clear();
    piece_ = 0;
    double from = 0;
    const auto add = [&](double to) {
      if (to - from < shortest_piece) return;
      const int count = static_cast<int>(std::ceil((to - from) / longest_));
      const double half = 0.5 * (to - from) / count;
      for (int k = 0; k < count; ++k) panels_.push_back({from + (2 * k + 1) * half, half});
      from = to;
    };
    for (const Kink& kink : kinks) {
      add(kink.theta);
      piece_ += mixed_bits(kink.of + 1);
    }
    add(h_.span());
  }

  void clear(Wanted wanted) {
    if (wanted == Wanted::by_fields) {
      by_field_.setZero();
      return;
    }
    F_.setZero();
    largest_ = 0;
    if (wanted == Wanted::force) return;
    by_frequency_.setZero();
    for (auto* all : {&by_q_, &by_v_})
      for (Moments& each : *all) each.clear();
  }

  using Complex = std::complex<double>;

  // Those of exp(i theta), kept in a column.
  const Complex* set_powers(Eigen::Index column, Complex z) {
    powers(z, static_cast<int>(powers_.rows()), powers_.col(column).data());
    return powers_.col(column).data();
  }
  static Complex product(Complex a, Complex b) {  // without the checks for infinities
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  // q and v in row s, from the powers there.
  void set_motion(Eigen::Index s, double theta, const Complex* z_n, Eigen::MatrixXd& q, Eigen::MatrixXd& v,
                  Eigen::VectorXd& phase) {
    const Eigen::Index c = h_.size();
    for (int i = 0; i < directions_; ++i) {
      const double* const a = u_.data() + i * c;
      double x = 0, rate = 0;
      for (int k = 0; k < h_.cosines(); ++k) x += a[k] * z_n[h_.cosine_order(k)].real();
      for (int j = 0; j < h_.sines(); ++j) {
        const int n = h_.sine_order(j);
        const Complex z = z_n[n];
        const double cosine = a[h_.cosine_index(n)], sine = a[h_.sine_index(n)];
        x += sine * z.imag();
        rate += n * (sine * z.real() - cosine * z.imag());
      }
      q(s, i) = x;
      v(s, i) = frequency_ * rate;
    }
    phase[s] = h_.period * theta;
  }

  void set_basis(const Complex* z_n) {
    for (int k = 0; k < h_.cosines(); ++k) phi_[k] = z_n[h_.cosine_order(k)].real();
    for (int j = 0; j < h_.sines(); ++j) phi_[h_.cosines() + j] = z_n[h_.sine_order(j)].imag();
  }

  void integrate(Wanted wanted) {
    clear(wanted);
    for (const Panel& panel : panels_) {
      const Complex middle = std::polar(1.0, panel.middle);
      for (int s = 0; s < nodes; s += 2) {
        const Complex off = std::polar(1.0, panel.half * gauss_nodes[static_cast<std::size_t>(s / 2)]);
        for (int side = 0; side < 2; ++side) {
          const Complex* const z_n = set_powers(s + side, product(middle, side == 0 ? std::conj(off) : off));
          set_motion(s + side, angle(panel, s + side), z_n, q_, v_, phase_);
        }
      }
      law_.sample_motion(fields_, {q_, v_, phase_}, wanted, at_);
      for (int s = 0; s < nodes; ++s)
        add_node(s, gauss_weights[static_cast<std::size_t>(s / 2)] * panel.half * factor(), wanted);
    }
    const auto half_mean = [&](auto&& columns) {
      for (int i = 0; i < directions_ && !h_.odd; ++i) columns.row(i * h_.size()) *= 0.5;
    };
    if (wanted == Wanted::by_fields) return half_mean(by_field_);
    half_mean(F_);
    if (wanted == Wanted::tangent) half_mean(by_frequency_);
  }

  static double angle(const Panel& panel, int s) {
    return panel.middle + (s % 2 == 0 ? -1 : 1) * panel.half * gauss_nodes[static_cast<std::size_t>(s / 2)];
  }

  void add_node(int s, double weight, Wanted wanted) {
    const Eigen::Index c = h_.size();
    const Complex* const z_n = powers_.col(s).data();
    set_basis(z_n);
    for (int i = 0; i < directions_; ++i) {
      if (wanted == Wanted::by_fields) {
        for (Eigen::Index k = 0; k < by_field_.cols(); ++k)
          by_field_.col(k).segment(i * c, c) += weight * at_.f_field(s, k * directions_ + i) * phi_;
        continue;
      }
      F_.segment(i * c, c) += weight * at_.f(s, i) * phi_;
      largest_ = std::max(largest_, std::abs(at_.f(s, i)));
      if (wanted != Wanted::tangent) continue;
      for (int j = 0; j < directions_; ++j) {
        const Eigen::Index column = j * directions_ + i;
        add_moments(weight * at_.f_q(s, column), z_n, by_q_[static_cast<std::size_t>(column)]);
        if (by_v_.empty()) continue;
        add_moments(weight * at_.f_v(s, column), z_n, by_v_[static_cast<std::size_t>(column)]);
        by_frequency_.segment(i * c, c) += weight * at_.f_v(s, column) * v_(s, j) / frequency_ * phi_;
      }
    }
  }

  void add_moments(double weight, const Complex* z_n, Moments& to) const {
    for (int q = 0; q < to.count(); ++q) {
      const Complex z = z_n[q * h_.stride()];
      to.add(q, weight * z.real(), weight * z.imag());
    }
  }

  // What the force loses at each kink: f_- - f_+, 0 where it is continuous.
  void set_jumps() {
    jumps_.clear();
    jump_over_bend_ = 0;
    if (!law_.may_jump()) return;
    const auto& kinks = finder_.kinks();
    for (std::size_t k = 0; k < kinks.size(); ++k) {
      for (int side = 0; side < 2; ++side) {
        const double theta = kinks[k].theta + (side == 0 ? -next_to_kink : next_to_kink);
        set_motion(side, theta, set_powers(nodes + side, std::polar(1.0, theta)), q_kink_, v_kink_,
                   phase_kink_);
      }
      law_.sample_motion(fields_, {q_kink_, v_kink_, phase_kink_}, Wanted::force, at_kink_);
      for (int i = 0; i < directions_; ++i) {
        const double jump = at_kink_.f(0, i) - at_kink_.f(1, i);
        if (std::abs(jump) > least_jump * largest_) jumps_.push_back({k, i, jump});
        if (std::abs(jump) > least_jump * largest_ && directions_ == 1) add_stop(kinks[k].theta, jump);
      }
    }
  }

  // Friction holds a motion that reverses where its force jumps.
  void add_stop(double theta, double jump) {
    const Values at = series_values(h_, u_, theta);
    if (std::abs(at.d1) < at_rest * series_bound(h_, u_, 1) && at.d2 != 0)
      jump_over_bend_ = std::max(jump_over_bend_, 0.5 * std::abs(jump / at.d2));
  }

  void assemble() {
    const Eigen::Index c = h_.size();
    J_.setZero();
    for (int j = 0; j < directions_; ++j)
      for (int i = 0; i < directions_; ++i) {
        const auto column = static_cast<std::size_t>(j * directions_ + i);
        auto block = J_.block(i * c, j * c, c, c);
        by_q_[column].close();
        by_q_[column].add_to(block, 1);
        if (by_v_.empty()) continue;
        by_v_[column].close();
        add_rate(by_v_[column], block);
      }
    for (const Jump& jump : jumps_) {
      finder_.rate(finder_.kinks()[jump.kink], kink_rate_);
      set_basis(set_powers(nodes, std::polar(1.0, finder_.kinks()[jump.kink].theta)));
      J_.middleRows(jump.direction * c, c).noalias() +=
          (factor() * jump.size) * phi_ * kink_rate_.transpose();
    }
    for (int i = 0; i < directions_ && !h_.odd; ++i) J_.row(i * c) *= 0.5;
  }

  // Adds G times the matrix that makes coefficients of v of those of q.
  void add_rate(const Moments& G, Eigen::Ref<Eigen::MatrixXd> block) {
    block_.setZero();
    G.add_to(block_, frequency_);
    for (int j = 0; j < h_.sines(); ++j) {
      const int n = h_.sine_order(j), a = h_.cosine_index(n), b = h_.sine_index(n);
      block.col(a) -= n * block_.col(b);
      block.col(b) += n * block_.col(a);
    }
  }

  // Adds jumps that move by a rate.
  template <class Rate>
  void add_jumps(Rate rate, Out dF) {
    const Eigen::Index c = h_.size();
    for (const Jump& jump : jumps_) {
      const Kink& kink = finder_.kinks()[jump.kink];
      const double moved = rate(kink);
      set_basis(set_powers(nodes, std::polar(1.0, kink.theta)));
      auto own = dF.segment(jump.direction * c, c);
      phi_ *= factor() * jump.size * moved;
      if (!h_.odd) phi_[0] *= 0.5;
      own += phi_;
    }
  }

  struct Jump {
    std::size_t kink;
    int direction;
    double size;
  };

  const FormulaLaw& law_;
  Harmonics h_;
  int directions_;
  KinkFinder finder_;
  double frequency_ = 1, largest_ = 0, jump_over_bend_ = 0;
  std::uint64_t piece_ = 0;
  std::vector<Panel> panels_;
  std::vector<Jump> jumps_;
  Eigen::MatrixXd q_, v_;
  Eigen::VectorXd phase_;
  SampledForce at_;
  Eigen::MatrixXd q_kink_, v_kink_;
  Eigen::VectorXd phase_kink_;
  SampledForce at_kink_;
  Eigen::MatrixXcd powers_;  // a column for each node of a panel, and two at kinks
  std::vector<double> fields_;
  std::vector<Moments> by_q_, by_v_;
  Eigen::VectorXd u_, F_, by_frequency_, kink_rate_, phi_;
  Eigen::MatrixXd by_field_, J_, block_;
  double longest_;
  bool has_tangent_ = false, has_field_derivatives_ = false;
};

class KinkedElement final : public Element {
 public:
  KinkedElement(const FormulaLaw& law, const Harmonics& h) : at_(std::make_unique<KinkedIntegrals>(law, h)) {}

  void set_frequency(double base_frequency) override { at_->set_frequency(base_frequency); }
  void move_to(In u, Fields fields, bool jacobian) override { at_->move_to(u, fields, jacobian); }
  const Eigen::VectorXd& force() const override { return at_->force(); }
  const Eigen::MatrixXd& jacobian() const override { return at_->jacobian(); }
  std::uint64_t piece() const override { return at_->piece(); }
  double jump_over_bend() const override { return at_->jump_over_bend(); }
  void frequency_derivative(Out dF) const override { at_->frequency_derivative(dF); }
  void field_derivative(int field, Out dF) const override { at_->field_derivative(field, dF); }

 private:
  std::unique_ptr<KinkedIntegrals> at_;
};

}  // namespace

std::unique_ptr<Element> kinked_element(const FormulaLaw& law, const Harmonics& harmonics) {
  return std::make_unique<KinkedElement>(law, harmonics);
}

}  // namespace arcslip::elements
