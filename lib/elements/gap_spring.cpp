#include <arcslip/elements/gap_spring.hpp>

#include <arcslip/elements/moments.hpp>
#include <arcslip/elements/reversal_angle.hpp>
#include <arcslip/elements/reversals.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double turn = 2 * std::numbers::pi;

enum { stiffness_field, gap_field };

constexpr scene::Field all_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "stiffness in contact"},
    {.name = "gap",
     .unit = "m",
     .lower = 0,
     .upper = infinity,
     .help = "displacement at the onset of contact; force = stiffness * (displacement - gap) beyond it"},
};

class GapElement final : public Element {
 public:
  explicit GapElement(const Harmonics& h)
      : h_(h),
        reversals_(h),
        moments_(h),
        A_(h.size()),
        l_(h.size()),
        F_(h.size()),
        J_(h.size(), h.size()),
        middle_(static_cast<std::size_t>(2 * h.order + 1)),
        half_(middle_.size()) {}

  void move_to(In u, Fields fields, bool jacobian) override {
    const double k = fields[stiffness_field], gap = fields[gap_field];
    const double kappa = 1 / std::numbers::pi;
    stiffness_ = k;
    l_.setZero();
    A_.setZero();
    if (jacobian) J_.setZero();
    moments_.clear();
    contacts_ = 0;
    always_ = false;
    find_contacts(u, gap);
    moments_.close();
    moments_.times(u, kappa, A_);
    A_ -= gap * kappa * l_;
    if (jacobian) moments_.add_to(J_, kappa * k);
    l_ *= kappa;
    if (!h_.odd) {
      A_[0] *= 0.5;
      l_[0] *= 0.5;
      if (jacobian) J_.row(0) *= 0.5;
    }
    F_ = k * A_;
  }

  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    if (field == stiffness_field)
      dF = A_;
    else
      dF = -stiffness_ * l_;
  }
  std::uint64_t piece() const override { return always_ ? 1 : 2 * contacts_; }

 private:
  // The contacts of a period, between the reversals that enclose their ends. A motion of odd harmonics alone
  // has reversals in half of it, and the others mirrored.
  void find_contacts(In u, double gap) {
    const auto& turns = reversals_.find(u);
    if (turns.empty()) {
      if (!h_.odd && u[0] > gap) add(0, turn);
      return;
    }
    path_.clear();
    for (const Reversal& at : turns) path_.push_back(at);
    if (h_.odd)
      for (const Reversal& at : turns) path_.push_back({at.theta + std::numbers::pi, -at.x});
    path_.push_back({path_.front().theta + turn, path_.front().x});
    const bool begins_closed = path_.front().x > gap;
    double begin = path_.front().theta, first_end = -1;
    bool closed = begins_closed;
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      const Reversal &from = path_[i], &to = path_[i + 1];
      if ((from.x > gap) == (to.x > gap)) continue;
      const double at = reversals_.crossing(u, from, to, gap);
      if (closed && begins_closed && first_end < 0)
        first_end = at;
      else if (closed)
        add(begin, at);
      begin = at;
      closed = !closed;
    }
    if (!begins_closed) return;
    if (first_end < 0)
      add(path_.front().theta, path_.back().theta);
    else
      add(begin, first_end + turn);
  }

  void add(double begin, double end) {
    ++contacts_;
    always_ = end - begin >= turn;
    powers(0.5 * (begin + end), static_cast<int>(middle_.size()), middle_.data());
    powers(0.5 * (end - begin), static_cast<int>(half_.size()), half_.data());
    moments_.add_interval(end - begin, middle_.data(), half_.data());
    for (int i = 0; i < h_.cosines(); ++i) {
      const auto n = static_cast<std::size_t>(h_.cosine_order(i));
      l_[i] += n == 0 ? end - begin : 2 * half_[n].imag() / static_cast<double>(n) * middle_[n].real();
    }
    for (int j = 0; j < h_.sines(); ++j) {
      const auto n = static_cast<std::size_t>(h_.sine_order(j));
      l_[h_.cosines() + j] += 2 * half_[n].imag() / static_cast<double>(n) * middle_[n].imag();
    }
  }

  Harmonics h_;
  Reversals reversals_;
  Moments moments_;
  std::vector<Reversal> path_;
  Eigen::VectorXd A_, l_, F_;
  Eigen::MatrixXd J_;
  std::vector<std::complex<double>> middle_, half_;
  double stiffness_ = 0;
  std::uint64_t contacts_ = 0;
  bool always_ = false;
};

// A maximum touches the stop (guard 1), or a minimum leaves it (guard 0). One angle, that of the reversal;
// h = +-k (w - g).
class GapCorners final : public Corners {
 public:
  explicit GapCorners(const Harmonics& h) : h_(h), reversals_(h), phi_(h.size()) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    const double k = sign(corner) * fields[stiffness_field];
    const Values values = series_values(h_, w, corner.angles[0]);
    set_reversal_row(h_, corner, w, 1, at);
    at.values[0] = k * (values.x - fields[gap_field]);
    series_basis(h_, corner.angles[0], phi_);
    at.by_motion.row(0) = k * phi_.transpose();
    at.by_angle(0, 0) = k * values.d1;
    at.by_field(0, stiffness_field) = sign(corner) * (values.x - fields[gap_field]);
    at.by_field(0, gap_field) = -k;
  }
  double size(const Corner&, In w, Fields fields) override {
    const double mean = h_.odd ? 0 : std::abs(w[0]);
    return fields[stiffness_field] * (series_bound(h_, w, 0) + mean);
  }
  bool polish(Corner& corner, In w, Fields) override {
    return polish_reversal(h_, w, sign(corner), corner.angles[0]);
  }
  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    std::vector<Corner> found;
    for (const Reversal& at : reversals_.find(w))
      for (const double side : {1.0, -1.0}) {
        const double x = side * at.x, theta = side > 0 ? at.theta : at.theta + std::numbers::pi;
        if (side < 0 && !h_.odd) break;
        const Corner corner{series_values(h_, w, theta).d2 < 0 ? 1 : 0, {theta}};
        const bool is_near =
            fields[stiffness_field] * std::abs(x - fields[gap_field]) <= tolerance * size(corner, w, fields);
        if (is_near && !is_listed(found, corner, w)) found.push_back(corner);
      }
    return found;
  }

 private:
  static double sign(const Corner& corner) { return corner.guard == 1 ? 1 : -1; }
  // An image of one that is there, in a motion of a shorter period.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner, In w) const {
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      return other.guard == corner.guard && is_image(h_, w, corner.angles[0] - other.angles[0], 1);
    });
  }

  Harmonics h_;
  Reversals reversals_;
  Eigen::VectorXd phi_;
};

class GapSpring final : public PlainLaw {
 public:
  std::string_view name() const override { return "gap_spring"; }
  std::string_view help() const override { return "a unilateral spring with a gap"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return all_fields; }

  bool antisymmetric() const override { return false; }
  Traits traits(Fields fields, int) const override {
    return {.stiffness = fields[stiffness_field],
            .stiffness_field = stiffness_field,
            .several_responses = true,
            .far_power = 1};
  }
  double stiffness(Fields fields, int, double reach) const override {
    return reach > fields[gap_field] ? fields[stiffness_field] : 0;
  }

  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling&) const override {
    return std::make_unique<GapElement>(harmonics);
  }
  std::unique_ptr<Corners> corners(const Harmonics& harmonics) const override {
    return std::make_unique<GapCorners>(harmonics);
  }
  Eigen::MatrixXd force_at(const Harmonics& h, In u, Fields fields, Angles angles) const override {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(angles.size()), 1);
    for (std::size_t i = 0; i < angles.size(); ++i)
      f(static_cast<Eigen::Index>(i), 0) = force(fields, series_values(h, u, angles[i]).x);
    return f;
  }

  void begin(Fields fields, In q, Out, StepEnd& at) const override { set(fields, q[0], at); }
  void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const override {
    set(fields, start.q[0] + dq[0], end);
  }
  double stored(Fields fields, In q, In) const override {
    return 0.5 * force(fields, q[0]) * std::max(q[0] - fields[gap_field], 0.0);
  }
  std::optional<std::vector<Automaton>> automata(Fields fields) const override {
    const double k = fields[stiffness_field], gap = fields[gap_field];
    Automaton contact(-1);
    contact.add("open", 0, 0, 0).leaves_where(-1, 0, 0, gap, 1);
    contact.add("closed", k, 0, -k * gap).leaves_where(1, 0, 0, -gap, 0);
    return std::vector{contact};
  }

 private:
  static double force(Fields fields, double q) {
    return fields[stiffness_field] * std::max(q - fields[gap_field], 0.0);
  }
  static void set(Fields fields, double q, StepEnd& at) {
    at.f[0] = force(fields, q);
    at.f_q(0, 0) = q > fields[gap_field] ? fields[stiffness_field] : 0;
  }
};

}  // namespace

const PlainLaw& gap_spring() {
  static const GapSpring law;
  return law;
}

}  // namespace arcslip::elements
