#include <arcslip/laws/hysteresis/iwan.hpp>

#include <arcslip/laws/hysteresis/iwan_power_law.hpp>
#include <arcslip/laws/hysteresis/masing_element.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

constexpr double settled_crossing = 1e-5;  // rad, and of the distance to a reversal: the cube is rounding

struct Nodes {
  std::vector<double> t, weight;  // of the integral from 0 to 1
};

// Gauss-Legendre, the nodes by Newton's method from the usual guess.
Nodes gauss(int count) {
  Nodes nodes;
  for (int i = count - 1; i >= 0; --i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int k = 0; k < 10; ++k) {
      double before = 1, here = x;
      for (int n = 2; n <= count; ++n)
        before = std::exchange(here, ((2 * n - 1) * x * here - (n - 1) * before) / n);
      slope = count * (x * here - before) / (x * x - 1);
      x -= here / slope;
    }
    nodes.t.push_back(0.5 * (1 + x));
    nodes.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return nodes;
}

// t = tau^6 makes t^(2 chi + 2) smooth enough at 0.
Nodes graded(int count) {
  Nodes nodes = gauss(count);
  for (std::size_t i = 0; i < nodes.t.size(); ++i) {
    const double tau = nodes.t[i];
    nodes.t[i] = std::pow(tau, 6);
    nodes.weight[i] *= 6 * std::pow(tau, 5);
  }
  return nodes;
}

class PowerLawElement final : public MasingElement {
 public:
  PowerLawElement(const Harmonics& h, bool uniform)
      : MasingElement(h),
        uniform_(uniform),
        inner_(gauss(16)),
        first_(graded(24)),
        longest_(std::min(1.0, 7.0 / h.order)),
        longest_first_(std::min(0.5, 3.0 / h.order)),
        w_(h.order),
        y_(static_cast<std::size_t>(h.order + 1)) {}

 private:
  Scales set(std::span<const double> fields) override {
    law_ = uniform_ ? PowerLaw(0, 0) : PowerLaw(fields[2], fields[3]);
    jumps_ = !uniform_ && fields[3] > 0;
    return {fields[0], fields[1]};
  }
  int shapes() const override { return uniform_ ? 0 : 2; }
  Backbone at(double y) const override {
    const PowerLaw::Values values = law_.at(y);
    return {values.slope, values.rest, {values.by_chi, values.by_beta}};
  }
  std::uint64_t level(double y) const override { return jumps_ && y >= law_.largest() ? 2 : 1; }

  void integrate(In u, const BranchPart& part, Integrals& over) override {
    over.slope.clear();
    over.rest.clear();
    for (int k = 0; k < shapes(); ++k) over.shapes[static_cast<std::size_t>(k)].clear();
    const Anchor& from = anchor(part);
    const double limit = unit() * law_.largest(), length = part.end.theta - part.begin.theta;
    const double moved = from.way * (part.begin.x - from.x), end = from.way * (part.end.x - from.x);
    double slips = 0;  // from here on all sliders slip
    if (moved < 2 * limit) {
      slips = length;
      if (end > 2 * limit)
        slips = loops().crossing(u, part.begin, part.end, from.x + 2 * from.way * limit) - part.begin.theta;
      find_series(u, part.begin.theta);
      integrate_smooth(part, from, moved, slips, over);
    }
    if (slips >= length) return;
    const int count = harmonics().order + 1;
    powers_less_one(length, count, w_);
    add_interval(length, 2 * from.way, w_, over.rest);
    powers_less_one(slips, count, w_);
    add_interval(slips, -2 * from.way, w_, over.rest);
  }

  // Coefficients of x(theta + t) - x(theta) = Re sum Y_n (exp(i n t) - 1).
  void find_series(In u, double theta) {
    const Harmonics& h = harmonics();
    powers(theta, h.order + 1, y_.data());
    for (int n = 0; n <= h.order; ++n) {
      auto& y = y_[static_cast<std::size_t>(n)];
      if (n > 0 && h.has(n))
        y *= std::complex<double>(u[h.cosine_index(n)], -u[h.sine_index(n)]);
      else
        y = 0;
    }
  }

  void integrate_smooth(const BranchPart& part, const Anchor& from, double moved, double end,
                        Integrals& over) {
    const double since = part.begin.theta - from.theta;  // t = -since is singular, except if uniform
    double t = 0;
    if (!uniform_ && since <= 0) {
      t = std::min(end, longest_first_);
      add(first_, 0, t, from.way, moved, over);
    }
    while (t < end) {
      double step = std::min(longest_, end - t);
      if (!uniform_) step = std::min(step, 2 * (t + since));
      if (end - t < 1.5 * step) step = end - t;
      if (!(t + step > t)) return;
      add(inner_, t, step, from.way, moved, over);
      t += step;
    }
  }

  void add(const Nodes& nodes, double begin, double length, double way, double moved, Integrals& over) {
    const int order = harmonics().order;
    for (std::size_t i = 0; i < nodes.t.size(); ++i) {
      powers_less_one(begin + length * nodes.t[i], 2 * order + 1, w_);
      double x = 0;
      for (int n = 1; n <= order; ++n) {
        const auto& y = y_[static_cast<std::size_t>(n)];
        x += y.real() * w_.re[n] - y.imag() * w_.im[n];
      }
      const double s = std::max(0.5 * (moved + way * x), 0.0), weight = length * nodes.weight[i];
      const PowerLaw::Values values = law_.at(s / unit());
      add(weight * values.slope, 2 * order, over.slope);
      add(2 * way * weight * values.rest, order, over.rest);
      if (uniform_) continue;
      add(2 * way * weight * values.by_chi, order, over.shapes[0]);
      add(2 * way * weight * values.by_beta, order, over.shapes[1]);
    }
  }
  void add(double factor, int highest, Powers& sum) const {
    sum.re.head(highest + 1) += factor * (1 + w_.re.head(highest + 1));
    sum.im.head(highest + 1) += factor * w_.im.head(highest + 1);
  }

  bool uniform_, jumps_ = false;
  PowerLaw law_{0, 0};
  Nodes inner_, first_;
  double longest_, longest_first_;  // parts of quadrature, rad
  Powers w_;
  std::vector<std::complex<double>> y_;
};

// With the shares k_j of the stiffness and the slip displacements y_j: g = sum_j k_j min(y, y_j). On a part
// of a branch slider j sticks up to the angle theta_j, so that sums of exp(i k theta_j) hold all integrals.
class TableElement final : public MasingElement {
 public:
  TableElement(const Harmonics& h, const std::vector<IwanSlider>& sliders)
      : MasingElement(h),
        length_(h.order),
        stiffness_(sliders.size()),
        limit_(sliders.size()),
        first_re_(sliders.size()),
        first_im_(sliders.size()),
        re_(sliders.size()),
        im_(sliders.size()) {
    for (const auto& [stiffness, limit] : sliders) {
      sum_.stiffness += stiffness;
      sum_.slip_force += limit;
    }
    for (const auto& [stiffness, limit] : sliders)
      sliders_.push_back({(limit / sum_.slip_force) / (stiffness / sum_.stiffness),
                          stiffness / sum_.stiffness, limit / sum_.slip_force});
    double slope = 1, rest = 0;
    for (Step& step : sliders_) {
      stiffness_[&step - sliders_.data()] = step.stiffness;
      limit_[&step - sliders_.data()] = step.limit;
      slope -= step.stiffness;
      rest += step.limit;
      step.slope = &step == &sliders_.back() ? 0 : slope;
      step.rest = &step == &sliders_.back() ? 1 : rest;
    }
  }

 private:
  struct Step {
    double y, stiffness, limit;  // of the slider
    double slope = 0, rest = 0;  // of all where it and those before it slip
  };

  Scales set(std::span<const double> fields) override {
    return {fields[0] * sum_.stiffness, fields[1] * sum_.slip_force, sum_.stiffness, sum_.slip_force};
  }
  std::size_t slipping(double y) const {
    return static_cast<std::size_t>(
        std::upper_bound(sliders_.begin(), sliders_.end(), y,
                         [](double value, const Step& step) { return value < step.y; }) -
        sliders_.begin());
  }
  Backbone at(double y) const override {
    const std::size_t count = slipping(y);
    if (count == 0) return {1, 0, {}};
    return {sliders_[count - 1].slope, sliders_[count - 1].rest, {}};
  }
  double first_slip() const override { return sliders_.front().y; }
  std::uint64_t level(double y) const override { return slipping(y); }

  void integrate(In u, const BranchPart& part, Integrals& over) override {
    const int order = harmonics().order;
    const Anchor& from = anchor(part);
    const double length = part.end.theta - part.begin.theta, way = 2 * from.way;
    const double moved = from.way * (part.begin.x - from.x), end = from.way * (part.end.x - from.x);
    std::size_t j = 0;
    while (j < sliders_.size() && 2 * unit() * sliders_[j].y <= moved) ++j;
    const auto first = static_cast<Eigen::Index>(j);
    Place here(harmonics(), u, part.begin.theta);
    double stuck_time = 0, slip_time = 0;
    Eigen::Index count = 0;
    for (; j < sliders_.size(); ++j, ++count) {
      const double limit = 2 * unit() * sliders_[j].y;
      if (limit >= end) break;
      move_to_crossing(u, part.end.theta, from.x + from.way * limit, from.way, here);
      first_re_[count] = here.re;
      first_im_[count] = here.im;
      stuck_time += sliders_[j].stiffness * here.t;
      slip_time += sliders_[j].limit * here.t;
    }
    const double stuck = j == 0 ? 1 : sliders_[j - 1].slope, rest = j == 0 ? 0 : sliders_[j - 1].rest;
    powers_less_one(length, 2 * order + 1, length_);
    over.slope.re[0] = stuck_time + stuck * length;
    over.rest.re[0] = way * (rest * length - slip_time);
    // exp(i k theta_j) - 1 of all sliders, from one k to the next.
    const auto stiffness = stiffness_.segment(first, count), limit = limit_.segment(first, count);
    auto re = re_.head(count), im = im_.head(count);
    re = first_re_.head(count);
    im = first_im_.head(count);
    for (int k = 1; k <= 2 * order; ++k) {
      over.slope.re[k] = ((stiffness * im).sum() + stuck * length_.im[k]) / k;
      over.slope.im[k] = -((stiffness * re).sum() + stuck * length_.re[k]) / k;
      if (k <= order) {
        over.rest.re[k] = way * (rest * length_.im[k] - (limit * im).sum()) / k;
        over.rest.im[k] = -way * (rest * length_.re[k] - (limit * re).sum()) / k;
      }
      for (Eigen::Index i = 0; i < count; ++i) {
        const double a = first_re_[i], b = first_im_[i], x = re_[i], y = im_[i];
        re_[i] = x + a + (x * a - y * b);
        im_[i] = y + b + (x * b + y * a);
      }
    }
  }

  // An angle of a part, at t = theta - begin, with exp(i t) - 1. It moves in steps that are short, for which
  // the series of the exponential needs no sine.
  struct Place {
    Place(const Harmonics& h, In u, double angle)
        : begin(angle), c(std::cos(begin)), s(std::sin(begin)), x(series_values(h, u, c, s)) {}

    void turn(double step) {
      t += step;
      const double q = step * step;
      double a = 0, b = 0;  // exp(i step) - 1
      if (q < 0.01) {
        a = q * (-1.0 / 2 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320 - q * (1.0 / 3628800)))));
        b = step * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880)))));
      } else {
        const double half = std::sin(0.5 * step);
        a = -2 * half * half;
        b = std::sin(step);
      }
      const double before = re;
      re += a + (re * a - im * b);
      im += b + (before * b + im * a);
    }
    void evaluate(const Harmonics& h, In u) {
      x = series_values(h, u, c + (c * re - s * im), s + (s * re + c * im));
    }

    double begin, c, s;
    double t = 0, re = 0, im = 0;
    Values x;
  };

  // To the root of x = target. Halley's method, whose error is the cube of its last step, with bisection;
  // begun by the cubic at the last root, since roots follow one another closely.
  void move_to_crossing(In u, double last, double target, double way, Place& at) const {
    double lower = at.t, upper = last - at.begin;
    const double far = way * (target - at.x.x), slope = way * at.x.d1, bend = way * at.x.d2;
    const double root = slope * slope + 2 * bend * far, first = lower;
    double ahead = root > 0 ? 2 * far / (slope + std::sqrt(root)) : 0;
    ahead -= way * at.x.d3 * ahead * ahead * ahead / (6 * (slope + bend * ahead));
    double t = at.t + ahead;
    for (int k = 0; k < 60; ++k) {
      if (!(t > lower && t < upper)) t = 0.5 * (lower + upper);
      at.turn(t - at.t);
      at.evaluate(harmonics(), u);
      const double excess = way * (at.x.x - target);
      (excess > 0 ? upper : lower) = t;
      const double step = -2 * excess * at.x.d1 / (2 * at.x.d1 * at.x.d1 * way - excess * at.x.d2);
      t += step;
      if (std::abs(step) <= settled_crossing &&
          std::abs(step * at.x.d2) <= settled_crossing * std::abs(at.x.d1)) {
        at.x.x = target;
        at.x.d1 += step * at.x.d2;
        at.x.d2 += step * at.x.d3;
        break;
      }
    }
    at.turn(std::clamp(t, first, last - at.begin) - at.t);
  }

  Scales sum_{0, 0};
  std::vector<Step> sliders_;
  Powers length_;
  Eigen::ArrayXd stiffness_, limit_;    // of the sliders
  Eigen::ArrayXd first_re_, first_im_;  // exp(i theta_j) - 1 where they begin to slip
  Eigen::ArrayXd re_, im_;              // exp(i k theta_j) - 1
};

}  // namespace

std::unique_ptr<MasingElement> make_iwan_power_law(const Harmonics& harmonics, bool uniform) {
  return std::make_unique<PowerLawElement>(harmonics, uniform);
}

std::unique_ptr<MasingElement> make_iwan_table(const Harmonics& harmonics, std::vector<IwanSlider> sliders) {
  std::sort(sliders.begin(), sliders.end(),
            [](const IwanSlider& a, const IwanSlider& b) { return a.second / a.first < b.second / b.first; });
  return std::make_unique<TableElement>(harmonics, sliders);
}

}  // namespace arcslip::elements
