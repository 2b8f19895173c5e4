#pragma once
// An independent march of structures with hysteresis of Bouc and Wen, friction dampers and cubic springs,
// with formulas of its own: the classical method of Runge and Kutta in steps of equal length, divided where
// the right side has a kink. Multipliers by differences of it.
//
//   M x'' + C x' + K x + sum d f = g cos(omega t) + g_2 sin(2 omega t)

#include "catch.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace rate_march {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// f = k (a q + (1 - a) z), z' = q' (1 - |z/z_y|^n (s sgn(q' z) + 1 - s)).
struct Wire {
  VectorXd d;
  double k, a, z_y, n, s;
};
/// f = k (q - z), |f| <= limit.
struct Slider {
  VectorXd d;
  double k, limit;
};
/// f = k q^3.
struct Cubic {
  VectorXd d;
  double k;
};

struct Structure {
  MatrixXd M, C, K;
  VectorXd g, g_2;
  double omega = 1;
  std::vector<Wire> wires{};
  std::vector<Slider> sliders{};
  std::vector<Cubic> cubics{};

  Eigen::Index dofs() const { return M.rows(); }
  Eigen::Index size() const { return 2 * dofs() + static_cast<Eigen::Index>(wires.size() + sliders.size()); }
  double period() const { return 2 * std::numbers::pi / omega; }
};

/// State: x, v, z of the wires, z of the sliders.
class March {
 public:
  March(const Structure& structure, int steps)
      : s_(structure), steps_(steps), inverse_(s_.M.inverse()), modes_(s_.sliders.size(), Mode::stick) {}

  /// Over `count` of the steps of a period, from step `from`; the sliders go on as they did before.
  void advance(VectorXd& y, int from, int count) {
    begin(y);
    const double h = s_.period() / steps_;
    for (int i = 0; i < count; ++i) {
      double t = (from + i) * h, rest = h;
      for (int events = 0; rest > 1e-15 * h; ++events) {
        REQUIRE(events < 100);
        VectorXd end = step(t, y, rest);
        double taken = rest;
        std::size_t which = 0;
        if (violated(end, which)) {
          double low = 0, high = rest;
          for (int k = 0; k < 200 && high - low > 1e-16 * h; ++k) {
            const double middle = 0.5 * (low + high);
            std::size_t other = 0;
            if (violated(step(t, y, middle), other)) {
              high = middle;
              which = other;
            } else {
              low = middle;
            }
          }
          taken = high;
          end = step(t, y, taken);
          pass(which);
        }
        y = end;
        t += taken;
        rest -= taken;
      }
    }
  }
  /// From the sliders' modes of the periodic motion.
  VectorXd period(VectorXd y) {
    modes_ = start_;
    advance(y, 0, steps_);
    return y;
  }

  /// By differences of fourth order.
  MatrixXd monodromy(const VectorXd& y, double step) {
    MatrixXd map(y.size(), y.size());
    for (Eigen::Index j = 0; j < y.size(); ++j) {
      const auto at = [&](double share) { return period(y + share * step * VectorXd::Unit(y.size(), j)); };
      map.col(j) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
    }
    return map;
  }

  /// The periodic motion: after some periods, by Newton's method.
  VectorXd periodic(int transients) {
    VectorXd y = VectorXd::Zero(s_.size());
    for (int i = 0; i < transients; ++i) advance(y, 0, steps_);
    start_ = modes_;
    for (int i = 0; i < 8; ++i) {
      const VectorXd r = period(y) - y;
      if (r.norm() < 1e-13 * y.norm()) return y;
      const MatrixXd J = MatrixXd::Identity(y.size(), y.size()) - monodromy(y, 1e-4 * y.norm());
      y += J.fullPivLu().solve(r);
    }
    CHECK((period(y) - y).norm() < 1e-11 * y.norm());
    return y;
  }

  std::vector<std::complex<double>> multipliers(const VectorXd& y, double step) {
    const Eigen::VectorXcd all = monodromy(y, step).eigenvalues();
    return {all.begin(), all.end()};
  }

 private:
  struct Way {
    double way, side;  // signs of q' and z
  };
  enum class Mode { stick, slip_up, slip_down };

  double q(const VectorXd& d, const VectorXd& y) const { return d.dot(y.head(s_.dofs())); }
  double velocity(const VectorXd& d, const VectorXd& y) const {
    return d.dot(y.segment(s_.dofs(), s_.dofs()));
  }

  // A slider that slips follows at once.
  void begin(VectorXd& y) {
    const auto n = 2 * s_.dofs();
    ways_.clear();
    for (std::size_t i = 0; i < s_.wires.size(); ++i)
      ways_.push_back({velocity(s_.wires[i].d, y) >= 0 ? 1.0 : -1.0,
                       y[n + static_cast<Eigen::Index>(i)] >= 0 ? 1.0 : -1.0});
    for (std::size_t i = 0; i < s_.sliders.size(); ++i) {
      const Slider& slider = s_.sliders[i];
      const double way = modes_[i] == Mode::slip_up ? 1 : -1;
      if (modes_[i] != Mode::stick) y[slider_at(i)] = q(slider.d, y) - way * slider.limit / slider.k;
    }
  }
  Eigen::Index slider_at(std::size_t i) const {
    return 2 * s_.dofs() + static_cast<Eigen::Index>(s_.wires.size() + i);
  }

  VectorXd rate(double t, const VectorXd& y) const {
    const auto n = s_.dofs();
    VectorXd f = s_.g * std::cos(s_.omega * t) + s_.g_2 * std::sin(2 * s_.omega * t) - s_.K * y.head(n) -
                 s_.C * y.segment(n, n);
    VectorXd by_t(y.size());
    by_t.head(n) = y.segment(n, n);
    for (std::size_t i = 0; i < s_.wires.size(); ++i) {
      const Wire& w = s_.wires[i];
      const auto at = 2 * n + static_cast<Eigen::Index>(i);
      f -= w.k * (w.a * q(w.d, y) + (1 - w.a) * y[at]) * w.d;
      const double power = std::pow(std::max(ways_[i].side * y[at] / w.z_y, 0.0), w.n);
      by_t[at] = velocity(w.d, y) * (1 - power * (w.s * ways_[i].way * ways_[i].side + 1 - w.s));
    }
    for (std::size_t i = 0; i < s_.sliders.size(); ++i) {
      const Slider& slider = s_.sliders[i];
      f -= slider.k * (q(slider.d, y) - y[slider_at(i)]) * slider.d;
      by_t[slider_at(i)] = modes_[i] == Mode::stick ? 0 : velocity(slider.d, y);
    }
    for (const Cubic& c : s_.cubics) f -= c.k * std::pow(q(c.d, y), 3) * c.d;
    by_t.segment(n, n) = inverse_ * f;
    return by_t;
  }
  VectorXd step(double t, const VectorXd& y, double h) const {
    const VectorXd a = rate(t, y), b = rate(t + h / 2, y + h / 2 * a), c = rate(t + h / 2, y + h / 2 * b),
                   d = rate(t + h, y + h * c);
    return y + h / 6 * (a + 2 * b + 2 * c + d);
  }

  // Guards: two of each wire, one of each slider.
  bool violated(const VectorXd& y, std::size_t& which) const {
    const auto n = 2 * s_.dofs();
    for (std::size_t i = 0; i < s_.wires.size(); ++i) {
      which = 2 * i;
      if (ways_[i].way * velocity(s_.wires[i].d, y) < 0) return true;
      which = 2 * i + 1;
      if (ways_[i].side * y[n + static_cast<Eigen::Index>(i)] < 0) return true;
    }
    for (std::size_t i = 0; i < s_.sliders.size(); ++i) {
      const Slider& slider = s_.sliders[i];
      const double f = slider.k * (q(slider.d, y) - y[slider_at(i)]), v = velocity(slider.d, y);
      which = 2 * s_.wires.size() + i;
      up_ = f > 0;
      if (modes_[i] == Mode::stick ? std::abs(f) > slider.limit
                                   : (modes_[i] == Mode::slip_up ? v < 0 : v > 0))
        return true;
    }
    return false;
  }
  void pass(std::size_t which) {
    if (which < 2 * s_.wires.size()) {
      double& sign = which % 2 == 0 ? ways_[which / 2].way : ways_[which / 2].side;
      sign = -sign;
      return;
    }
    Mode& mode = modes_[which - 2 * s_.wires.size()];
    mode = mode != Mode::stick ? Mode::stick : up_ ? Mode::slip_up : Mode::slip_down;
  }

  const Structure s_;
  const int steps_;
  const MatrixXd inverse_;
  std::vector<Way> ways_;
  std::vector<Mode> modes_, start_;
  mutable bool up_ = false;
};

}  // namespace rate_march
