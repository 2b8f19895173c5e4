#include <arcslip/stability/hill.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>
#include <arcslip/time/event_driven/taylor_propagator.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

using Complex = std::complex<double>;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr int further_orders = 10;                // of z above twice those of the motion
constexpr double negligible_coefficient = 1e-17;  // coefficient of T or B, over the largest
constexpr double longest_in_series = 2;           // of the fastest rate, in one series
constexpr int most_hill_terms = 60;
constexpr double last_term_left_out = 1e-18;  // of a series, by its last term
constexpr int most_attempts = 5;              // with twice as many orders each
constexpr double small_tail = 1e-11;          // of z, at the last quarter of the orders, over the largest
constexpr double most_rates = 1e5;            // rad/rad: beyond, no one waits

}  // namespace

struct Hill::Impl {
  struct HillLaw {
    int element;
    Matrix over_mass, directions;
    std::vector<elements::Automaton> automata;  // without memory; empty: smooth
    bool moving;                                // depends on velocities
    std::vector<ComplexMatrix> T, B;            // coefficients m = 0, 1, ...
  };

  explicit Impl(const EquationOfMotion& of) : equation(of) {
    for (const TimeElement& element : equation.elements)
      if (element.law->memory() > 0)
        throw NoVariation("Hill's method is for laws without memory: that of \"" + element.name +
                          "\" makes its spectrum fragment");
      else if (element.law->may_jump())
        throw NoVariation("the force of \"" + element.name +
                          "\" may jump, and its multipliers are not computed");
    std::vector<LinearMotion::Part> none;
    fastest_mode = fastest(equation, none).value();
    continuation::Cholesky mass;
    mass.factorize(equation.M);
    over_mass_K = mass.solve(equation.K);
    over_mass_C = mass.solve(equation.C);
    for (std::size_t e = 0; e < equation.elements.size(); ++e) {
      const TimeElement& element = equation.elements[e];
      HillLaw& law = laws.emplace_back(HillLaw{static_cast<int>(e),
                                               mass.solve(element.directions),
                                               element.directions,
                                               {},
                                               element.law->rate_dependent(),
                                               {},
                                               {}});
      if (auto automata = element.law->automata(element.fields)) law.automata = std::move(*automata);
    }
  }

  bool compute(double base_frequency, const elements::Harmonics& harmonics,
               const std::vector<ElementCourse>& elements, const control::Control& control) {
    omega = base_frequency;
    const bool smooth =
        std::all_of(laws.begin(), laws.end(), [](const HillLaw& law) { return law.automata.empty(); });
    for (const auto& element : elements)
      if (!element.q.allFinite()) return false;
    order = 2 * harmonics.order + further_orders;
    for (int attempt = 0; attempt < most_attempts; ++attempt, order *= 2) {
      double stiffness = 0, damping = 0;
      for (HillLaw& law : laws) {
        const ElementCourse& element = elements[static_cast<std::size_t>(law.element)];
        law.T.clear();
        law.B.clear();
        if (law.automata.empty())
          expand(law, harmonics, element.q);
        else if (!expand_modes(law, harmonics, element))
          return false;
        const double size = law.over_mass.norm() * law.directions.norm();
        for (const auto& each : law.T) stiffness += 2 * size * each.norm();
        for (const auto& each : law.B) damping += 2 * size * each.norm();
      }
      const double rate = order + (fastest_mode + std::sqrt(stiffness) + damping) / omega;
      if (!(rate < most_rates) || !follow(harmonics.span(), rate, control)) return false;
      if (!smooth || last_orders() <= small_tail) return finish(harmonics.odd);
    }
    return false;
  }

  // The largest z among the last orders, over the largest of all.
  double last_orders() const {
    double last = 0, all = 0;
    for (std::size_t k = 0; k < w.size(); ++k) {
      const double size = std::max(w[k].cwiseAbs().maxCoeff(), v[k].cwiseAbs().maxCoeff());
      all = std::max(all, size);
      if (4 * k > 3 * w.size()) last = std::max(last, size);
    }
    return last / all;
  }

  // Coefficients of samples over the period.
  void expand(HillLaw& law, const elements::Harmonics& harmonics, const Matrix& motion) {
    const TimeElement& element = equation.elements[static_cast<std::size_t>(law.element)];
    const int samples = 4 * order + 4, directions = element.law->directions();
    law.T.assign(static_cast<std::size_t>(2 * order + 1), ComplexMatrix::Zero(directions, directions));
    if (law.moving) law.B = law.T;
    const auto in_time = element.law->in_time(element.fields);
    elements::StepEnd at{directions, 0};
    Vector q(directions), none(0);
    for (int i = 0; i < samples; ++i) {
      const double theta = elements::whole_turn * i / samples;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        const auto values = elements::series_values(harmonics, motion.col(k), theta);
        q[k] = values.x;
        at.v[k] = omega * values.d1;
      }
      at.phase = harmonics.period * theta;
      in_time->begin(q, none, at);
      for (std::size_t m = 0; m < law.T.size(); ++m) {
        const Complex by = std::polar(
            1.0 / samples, -elements::whole_turn * ((static_cast<int>(m) * i) % samples) / samples);
        law.T[m] += by * at.f_q;
        if (law.moving) law.B[m] += by * at.f_v;
      }
    }
    drop_tail(law.T);
    drop_tail(law.B);
  }

  // The sum of each mode's stiffness over its intervals.
  bool expand_modes(HillLaw& law, const elements::Harmonics& harmonics, const ElementCourse& element) {
    const auto directions = law.directions.cols();
    law.T.assign(static_cast<std::size_t>(2 * order + 1), ComplexMatrix::Zero(directions, directions));
    series.expand(harmonics, element.q);
    for (const auto& automaton : law.automata) {
      if (!course_of(automaton, element.contact, course) && !course_along(automaton, series, course))
        return false;
      double from = 0;
      int mode = course.first;
      const auto add = [&](double to) {
        const Matrix& stiffness = automaton.modes[static_cast<std::size_t>(mode)].f_q;
        law.T[0] += (to - from) / elements::whole_turn * stiffness;
        for (std::size_t m = 1; m < law.T.size(); ++m) {
          const double n = static_cast<double>(m);
          law.T[m] += Complex(0, 1) / (elements::whole_turn * n) *
                      (std::polar(1.0, -n * to) - std::polar(1.0, -n * from)) * stiffness;
        }
        from = to;
      };
      for (const ModeChange& change : course.changes) {
        add(change.theta);
        mode = change.to;
      }
      add(elements::whole_turn);
    }
    return true;
  }

  static void drop_tail(std::vector<ComplexMatrix>& of) {
    double largest = 0;
    for (const auto& each : of) largest = std::max(largest, each.norm());
    while (!of.empty() && of.back().norm() <= negligible_coefficient * largest) of.pop_back();
  }

  // z_k of (w, w') for k >= 0, as z_(-k) is its conjugate: a row for each start.
  bool follow(double span, double rate, const control::Control& control) {
    const Eigen::Index n = equation.dofs();
    const auto count = static_cast<std::size_t>(order + 1);
    w.assign(count, ComplexMatrix::Zero(2 * n, n));
    v = w;
    w[0].topRows(n).setIdentity();
    v[0].bottomRows(n).setIdentity();
    const int steps = static_cast<int>(std::ceil(span * rate / longest_in_series));
    const double h = span / steps;
    for (int step = 0; step < steps; ++step) {
      if (!control.keep_going()) return false;
      term_w = w;
      term_v = v;
      double size = 0;
      for (const auto& each : w) size += each.cwiseAbs().sum();
      for (const auto& each : v) size += each.cwiseAbs().sum();
      for (int j = 1; j < most_hill_terms; ++j) {
        const double last = next_term(h / j);
        for (std::size_t k = 0; k < count; ++k) {
          w[k] += term_w[k];
          v[k] += term_v[k];
        }
        if (!(last > last_term_left_out * size)) break;
      }
    }
    return true;
  }

  // The next term of the power series; its size.
  double next_term(double factor) {
    const auto count = static_cast<int>(term_w.size());
    next_w.resize(term_w.size());
    next_v.resize(term_w.size());
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Complex shift(0, k);
      next_w[i] = factor * (term_v[i] - shift * term_w[i]);
      next_v[i] = -factor * (shift * term_v[i] + term_w[i] * (over_mass_K.transpose() / (omega * omega)) +
                             term_v[i] * (over_mass_C.transpose() / omega));
    }
    for (const HillLaw& law : laws) {
      add(law, law.T, term_w, factor / (omega * omega));
      add(law, law.B, term_v, factor / omega);
    }
    double size = 0;
    for (std::size_t i = 0; i < term_w.size(); ++i) {
      term_w[i].swap(next_w[i]);
      term_v[i].swap(next_v[i]);
      size += term_w[i].cwiseAbs().sum() + term_v[i].cwiseAbs().sum();
    }
    return size;
  }

  // next_v_k -= sum_l D_M T_(k-l) D^T of_l.
  void add(const HillLaw& law, const std::vector<ComplexMatrix>& T, const std::vector<ComplexMatrix>& of,
           double factor) {
    if (T.empty()) return;
    const int count = static_cast<int>(of.size()), reach = static_cast<int>(T.size()) - 1;
    along.resize(of.size());
    for (std::size_t l = 0; l < of.size(); ++l) along[l] = of[l] * law.directions;
    for (int k = 0; k < count; ++k) {
      force.setZero(of[0].rows(), law.directions.cols());
      for (int l = std::max(1 - count, k - reach); l <= std::min(count - 1, k + reach); ++l) {
        const int m = k - l;
        const auto& coefficient = T[static_cast<std::size_t>(std::abs(m))];
        const auto& each = along[static_cast<std::size_t>(std::abs(l))];
        const ComplexMatrix by =
            m >= 0 ? ComplexMatrix(coefficient.transpose()) : ComplexMatrix(coefficient.adjoint());
        if (l >= 0)
          force += each * by;
        else
          force += each.conjugate() * by;
      }
      next_v[static_cast<std::size_t>(k)] -= factor * (force * law.over_mass.transpose());
    }
  }

  bool finish(bool half) {
    const Eigen::Index n = equation.dofs();
    Matrix rows = Matrix::Zero(2 * n, 2 * n);
    for (std::size_t k = 0; k < w.size(); ++k) {
      const double by = (k == 0 ? 1 : 2) * (half && k % 2 == 1 ? -1 : 1);
      rows.leftCols(n) += by * w[k].real();
      rows.rightCols(n) += by * v[k].real();
    }
    map = half ? Matrix(-rows.transpose()) : Matrix(rows.transpose());
    if (!map.allFinite() || !eigenvalues.compute(map)) return false;
    multipliers.assign(eigenvalues.values().begin(), eigenvalues.values().end());
    half_multipliers.clear();
    if (half) {
      half_multipliers = multipliers;
      for (auto& each : multipliers) each *= each;
    }
    std::stable_sort(multipliers.begin(), multipliers.end(),
                     [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
    return true;
  }

  const EquationOfMotion equation;
  std::vector<HillLaw> laws;
  Matrix over_mass_K, over_mass_C;
  double fastest_mode = 0;  // rad/s, without elements

  // Of one motion.
  double omega = 0;
  int order = 0;  // H
  MotionSeries series;
  Course course;
  std::vector<ComplexMatrix> w, v, term_w, term_v, next_w, next_v, along;
  ComplexMatrix force;
  Matrix map;
  continuation::Eigenvalues eigenvalues;
  std::vector<Complex> multipliers, half_multipliers;
};

Hill::Hill(const EquationOfMotion& equation) : impl_(std::make_unique<Impl>(equation)) {}
Hill::~Hill() = default;
Hill::Hill(Hill&&) noexcept = default;
Hill& Hill::operator=(Hill&&) noexcept = default;

bool Hill::compute(double omega, const elements::Harmonics& harmonics,
                   const std::vector<ElementCourse>& elements, const control::Control& control) {
  return impl_->compute(omega, harmonics, elements, control);
}

const std::vector<Complex>& Hill::multipliers() const {
  return impl_->multipliers;
}

const std::vector<Complex>& Hill::half_multipliers() const {
  return impl_->half_multipliers;
}

const Matrix& Hill::map() const {
  return impl_->map;
}

}  // namespace arcslip::time
