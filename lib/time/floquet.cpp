#include <arcslip/time/floquet.hpp>

#include <arcslip/time/linear_motion.hpp>
#include <arcslip/time/linear_phases.hpp>
#include <arcslip/time/variation.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace arcslip::time {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int nodes = 4;             // of Gauss, in a piece with coefficients that change
constexpr int pieces_at_least = 64;  // of such ones in a period
constexpr double most_pieces = 200;  // into which one is divided further
constexpr double fastest_turns =
    1e12;  // of the fastest motion in a period: beyond, nothing is left of its phase
constexpr double pieces_per_order = 2;  // of the motion's harmonics
constexpr double long_enough = 0.05;    // of the longest interval without a change, to begin in it

// Gauss-Legendre nodes on [0, 1].
std::array<double, nodes> gauss_nodes() {
  const double a = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5)),
               b = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
  return {0.5 * (1 - b), 0.5 * (1 - a), 0.5 * (1 + a), 0.5 * (1 + b)};
}

// Row j: the coefficients of s^j by the values at the nodes.
Eigen::Matrix4d interpolation() {
  const auto at = gauss_nodes();
  Eigen::Matrix4d powers;
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) powers(i, j) = std::pow(at[static_cast<std::size_t>(i)], j);
  return powers.inverse();
}

// An automaton, where it acts, and what it does along the motion.
struct Part {
  int element;
  elements::Automaton automaton;
  int memory;  // in MotionState::z; -1: none
  Matrix over_mass, directions;
  Course course{};
  int now = 0;

  const elements::Mode& mode() const { return automaton.modes[static_cast<std::size_t>(now)]; }
  bool rests() const { return memory >= 0 && mode().rests; }
};

// A law without memory that is not piecewise linear.
struct Smooth {
  int element;
  bool moving;  // its force depends on velocities
  elements::StepEnd at;
  std::array<Matrix, nodes> T, B;  // at the nodes
};

struct Change {
  double theta;  // from the start
  std::size_t part, index;
};

bool falling(const std::complex<double>& a, const std::complex<double>& b) {
  return std::abs(a) > std::abs(b);
}

}  // namespace

struct Floquet::Impl {
  Impl(const EquationOfMotion& of, double highest_natural, Impl* before)
      : equation(of), highest(highest_natural), along(interpolation()) {
    const bool all_linear =
        std::none_of(equation.elements.begin(), equation.elements.end(),
                     [](const auto& e) { return e.law->memory() == 0 && !e.law->automata(e.fields); });
    if (!all_linear) mass.factorize(equation.M);
    for (std::size_t e = 0; e < equation.elements.size(); ++e) add(static_cast<int>(e));
    if (all_linear) {
      auto all = phase_parts();
      if (before && before->phases && before->phases->parts() == all && before->equation.M == equation.M &&
          before->equation.C == equation.C && before->equation.K == equation.K)
        phases = std::move(before->phases);
      else
        phases.emplace(equation, std::move(all), highest);
      return;
    }
    std::vector<LinearMotion::Part> stiffnesses;
    for (const Part& part : parts) {
      stiffnesses.push_back({part.directions, {}});
      for (const auto& mode : part.automaton.modes) stiffnesses.back().stiffnesses.push_back(mode.f_q);
    }
    fastest_mode = fastest(equation, stiffnesses);
    over_mass_K = mass.solve(equation.K);
    over_mass_C = mass.solve(equation.C);
    for (Part& part : parts) part.over_mass = mass.solve(part.directions);
  }

  std::vector<PhasePart> phase_parts() const {
    std::vector<PhasePart> all;
    for (const Part& part : parts) {
      PhasePart& each = all.emplace_back(PhasePart{part.directions, {}, {}, part.memory});
      for (const auto& mode : part.automaton.modes) {
        each.stiffness.push_back(mode.f_q);
        each.by_memory.push_back(mode.rests ? mode.f_z : Vector::Zero(mode.f_z.size()));
      }
    }
    return all;
  }

  void add(int e) {
    const TimeElement& element = equation.elements[static_cast<std::size_t>(e)];
    if (auto automata = element.law->automata(element.fields)) {
      for (auto& automaton : *automata) {
        const int memory = automaton.memory < 0 ? -1 : element.memory + automaton.memory;
        parts.push_back({e, std::move(automaton), memory, {}, element.directions});
      }
      return;
    }
    if (element.law->memory() > 0)
      throw NoVariation("the memory of \"" + element.name + "\" is not piecewise linear");
    smooth.push_back({e, element.law->rate_dependent(), {element.law->directions(), 0}, {}, {}});
    variables.emplace_back(mass.solve(element.directions), element.directions, nodes, smooth.back().moving);
  }

  bool compute(double base_frequency, const elements::Harmonics& harmonics,
               const std::vector<ElementCourse>& elements, const GoOn& go_on) {
    omega = base_frequency;
    span = harmonics.span();
    if (!follow(harmonics, elements)) return false;
    begin();
    if (phases)
      phases->begin(modes_now(), kept);
    else if (!begin_with_smooth(harmonics))
      return false;
    std::size_t next = 0;
    double theta = 0;
    while (true) {
      if (go_on && !go_on()) return false;
      const double end = next < changes.size() ? changes[next].theta : span;
      const bool moved =
          phases ? phases->move((end - theta) / omega) : move_with_smooth(theta, end, harmonics, elements);
      if (!moved) return false;
      theta = end;
      if (next == changes.size()) break;
      pass(changes[next++], harmonics, elements);
    }
    return finish(harmonics.odd);
  }

  std::vector<int> modes_now() const {
    std::vector<int> all;
    for (const Part& part : parts) all.push_back(part.now);
    return all;
  }

  // The courses, and the changes of all of them from the middle of an interval without one: a long one in
  // which the fewest sliders rest, as each of these is one more start.
  bool follow(const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements) {
    changes.clear();
    int expanded = -1;  // the element whose motion `series` is
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Part& part = parts[i];
      const ElementCourse& element = elements[static_cast<std::size_t>(part.element)];
      if (!element.q.allFinite()) return false;
      if (!course_of(part.automaton, element.contact, part.course)) {
        if (expanded != part.element) series.expand(harmonics, element.q);
        expanded = part.element;
        if (!course_along(part.automaton, series, part.course)) return false;
      }
      for (std::size_t k = 0; k < part.course.changes.size(); ++k)
        changes.push_back({part.course.changes[k].theta, i, k});
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.theta < b.theta; });
    const auto length = [&](std::size_t k) {
      const bool last = k + 1 == changes.size();
      return (last ? changes.front().theta + turn : changes[k + 1].theta) - changes[k].theta;
    };
    double longest = 0;
    for (std::size_t k = 0; k < changes.size(); ++k) longest = std::max(longest, length(k));
    int resting = 0;
    for (Part& part : parts) {
      part.now = part.course.first;
      resting += part.rests() && !part.course.changes.empty() ? 1 : 0;
    }
    start = 0;
    int fewest = std::numeric_limits<int>::max();
    double its_length = 0;
    for (std::size_t k = 0; k < changes.size(); ++k) {
      Part& part = parts[changes[k].part];
      resting -= part.rests() ? 1 : 0;
      part.now = part.course.changes[changes[k].index].to;
      resting += part.rests() ? 1 : 0;
      const double is_long = length(k);
      if (is_long < long_enough * longest || std::pair(resting, -is_long) >= std::pair(fewest, -its_length))
        continue;
      fewest = resting;
      its_length = is_long;
      start = changes[k].theta + 0.5 * is_long;
    }
    for (Change& change : changes) {
      change.theta -= start;
      if (change.theta < 0) change.theta += turn;
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.theta < b.theta; });
    while (!changes.empty() && changes.back().theta >= span) changes.pop_back();
    return true;
  }

  void begin() {
    kept.clear();
    zeros = 0;
    for (Part& part : parts) {
      part.now = part.course.first;
      for (const ModeChange& change : part.course.changes)
        if (change.theta <= start) part.now = change.to;
      if (part.memory < 0) continue;
      const bool always = part.course.changes.empty();
      if (!part.rests()) ++zeros;
      if (part.rests() && !always) kept.push_back(part.memory);
    }
  }

  // False: too fast.
  bool begin_with_smooth(const elements::Harmonics& harmonics) {
    const Eigen::Index n = equation.dofs();
    const auto starts = 2 * n + static_cast<Eigen::Index>(kept.size());
    W.setZero(starts, n);
    V.setZero(starts, n);
    Z.setZero(starts, equation.memory);
    W.topRows(n).setIdentity();
    V.middleRows(n, n).setIdentity();
    for (std::size_t k = 0; k < kept.size(); ++k) Z(2 * n + static_cast<Eigen::Index>(k), kept[k]) = 1;
    C = over_mass_C / omega;
    rate = fastest_mode / omega;
    piece = turn / std::max<double>(pieces_at_least, pieces_per_order * harmonics.order);
    return rate < fastest_turns;
  }

  void set_modes() {
    const double scale = 1 / (omega * omega);
    K = over_mass_K;
    bool driven = false;
    for (const Part& part : parts) {
      if (!part.mode().f_q.isZero(0))
        K.noalias() += part.over_mass * part.mode().f_q * part.directions.transpose();
      driven = driven || (part.rests() && Z.col(part.memory).any());
    }
    K *= scale;
    G.resize(0, 0);
    if (!driven) return;
    G.setZero(W.rows(), W.cols());
    for (const Part& part : parts)
      if (part.rests())
        G.noalias() -= Z.col(part.memory) * (scale * (part.over_mass * part.mode().f_z)).transpose();
  }

  // False: too many pieces.
  bool move_with_smooth(double theta, double end, const elements::Harmonics& harmonics,
                        const std::vector<ElementCourse>& elements) {
    set_modes();
    const double length = end - theta;
    const int coarse = static_cast<int>(std::ceil(length / piece));
    for (int i = 0; i < coarse; ++i) {
      const double from = theta + length * i / coarse, h = length / coarse;
      const double stiffest = interpolate(from, h, harmonics, elements);
      // With the largest coefficients at the nodes.
      const double needed = std::ceil(h * stiffest / 2);
      if (!(needed <= most_pieces)) return false;
      const int fine = std::max(1, static_cast<int>(needed));
      if (fine == 1) {
        variation.move(h, stiffest, K, C, G, variables, W, V);
        continue;
      }
      for (int j = 0; j < fine; ++j) {
        const double finest = interpolate(from + h * j / fine, h / fine, harmonics, elements);
        variation.move(h / fine, finest, K, C, G, variables, W, V);
      }
    }
    return true;
  }

  // Returns the rate of the fastest motion, from above, in rad/rad.
  double interpolate(double from, double h, const elements::Harmonics& harmonics,
                     const std::vector<ElementCourse>& elements) {
    static const auto at = gauss_nodes();
    double stiffness = 0, damping = 0;
    for (std::size_t s = 0; s < smooth.size(); ++s) {
      Smooth& law = smooth[s];
      const TimeElement& element = equation.elements[static_cast<std::size_t>(law.element)];
      const Matrix& motion = elements[static_cast<std::size_t>(law.element)].q;
      q.resize(motion.cols());
      double most_T = 0, most_B = 0;
      for (std::size_t i = 0; i < nodes; ++i) {
        const double theta = start + from + h * at[i];
        const double c = std::cos(theta), sine = std::sin(theta);
        for (Eigen::Index k = 0; k < motion.cols(); ++k) {
          const auto values = elements::series_values(harmonics, motion.col(k), c, sine);
          q[k] = values.x;
          law.at.v[k] = omega * values.d1;
        }
        none.resize(0);
        element.law->begin(element.fields, q, none, law.at);
        law.T[i] = law.at.f_q;
        most_T = std::max(most_T, law.T[i].cwiseAbs().sum());
        if (!law.moving) continue;
        law.B[i] = law.at.f_v;
        most_B = std::max(most_B, law.B[i].cwiseAbs().sum());
      }
      Variable& variable = variables[s];
      for (std::size_t j = 0; j < nodes; ++j) {
        variable.T[j].setZero(q.size(), q.size());
        if (law.moving) variable.B[j].setZero(q.size(), q.size());
        for (std::size_t i = 0; i < nodes; ++i) {
          const double weight = along(static_cast<int>(j), static_cast<int>(i));
          variable.T[j] += weight / (omega * omega) * law.T[i];
          if (law.moving) variable.B[j] += weight / omega * law.B[i];
        }
      }
      stiffness += variable.size * most_T / (omega * omega);
      damping += variable.size * most_B / omega;
    }
    return std::sqrt(rate * rate + stiffness) + damping;
  }

  void pass(const Change& at, const elements::Harmonics& harmonics,
            const std::vector<ElementCourse>& elements) {
    Part& part = parts[at.part];
    const ModeChange& change = part.course.changes[at.index];
    const elements::Mode& left = part.mode();
    const elements::Mode& next = part.automaton.modes[static_cast<std::size_t>(change.to)];
    if (part.memory >= 0 && !left.rests && next.rests)
      settle(at.part, *change.by, change.theta, harmonics, elements);
    part.now = change.to;
    if (phases) phases->change(at.part, change.to);
  }

  // The memory that followed comes to rest: where the instant moves, by -dg/g', dz moves along.
  void settle(std::size_t index, const elements::Guard& guard, double theta,
              const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements) {
    const Part& part = parts[index];
    const elements::Mode& left = part.mode();
    const Matrix& motion = elements[static_cast<std::size_t>(part.element)].q;
    const Matrix dq = phases ? phases->along(index) : Matrix(W * part.directions);
    auto dz = (phases ? phases->memory() : Z).col(part.memory);
    dz.noalias() = dq * left.z_q.transpose();
    if (guard.v.size() > 0 && !guard.v.isZero(0)) return;  // of the memory's velocity: it is at rest
    by_q = guard.z * left.z_q;
    if (guard.q.size() > 0) by_q += guard.q;
    double velocity = 0, falls = 0;
    for (Eigen::Index k = 0; k < by_q.size(); ++k) {
      const double d1 = elements::series_values(harmonics, motion.col(k), theta).d1;
      velocity += left.z_q[k] * d1;
      falls += by_q[k] * d1;
    }
    if (velocity != 0 && falls != 0) dz -= velocity / falls * (dq * by_q.transpose());
  }

  bool finish(bool half) {
    if (phases) {
      map = phases->map();
    } else {
      const Eigen::Index n = equation.dofs();
      const auto size = 2 * n + static_cast<Eigen::Index>(kept.size());
      map.resize(size, size);
      map.topRows(n) = W.transpose();
      map.middleRows(n, n) = V.transpose();
      for (std::size_t k = 0; k < kept.size(); ++k)
        map.row(2 * n + static_cast<Eigen::Index>(k)) = Z.col(kept[k]);
    }
    if (half) map = -map;
    if (!map.allFinite() || !set_eigenvalues()) return false;
    half_multipliers.clear();
    if (half) {
      half_multipliers = multipliers;
      for (auto& each : multipliers) each *= each;
    }
    multipliers.resize(multipliers.size() + static_cast<std::size_t>(zeros), 0);
    std::stable_sort(multipliers.begin(), multipliers.end(), falling);
    return true;
  }

  bool set_eigenvalues() {
    if (map.rows() == 2) {
      const double mean = 0.5 * (map(0, 0) + map(1, 1)), difference = 0.5 * (map(0, 0) - map(1, 1));
      const double square = difference * difference + map(0, 1) * map(1, 0);
      const std::complex<double> root = std::sqrt(std::complex<double>(square));
      multipliers.assign({mean + root, mean - root});
      return true;
    }
    if (!eigenvalues.compute(map)) return false;
    multipliers.assign(eigenvalues.values().begin(), eigenvalues.values().end());
    return true;
  }

  const EquationOfMotion equation;
  const double highest;
  const Eigen::Matrix4d along;
  std::optional<LinearPhases> phases;  // of a structure without smooth laws; then no W, V and Z
  continuation::Cholesky mass;
  std::vector<Part> parts;
  std::vector<Smooth> smooth;
  std::vector<Variable> variables;  // of smooth
  Matrix over_mass_K, over_mass_C;
  double fastest_mode = 0;  // rad/s, of the automata's stiffest modes

  // Of one motion.
  MotionSeries series;
  double omega = 0, span = 0, start = 0, rate = 0, piece = 0;
  std::vector<Change> changes;  // in [0, span)
  std::vector<int> kept;        // memories with a column
  int zeros = 0;
  Matrix K, C, G, map;
  Matrix W, V, Z;  // a row for each start: dw, dw', dz
  Vector q, none;
  Eigen::RowVectorXd by_q;
  Variation variation;
  continuation::Eigenvalues eigenvalues;
  std::vector<std::complex<double>> multipliers, half_multipliers;
};

Floquet::Floquet(const EquationOfMotion& equation, double highest)
    : impl_(std::make_unique<Impl>(equation, highest, nullptr)) {}
Floquet::~Floquet() = default;
Floquet::Floquet(Floquet&&) noexcept = default;
Floquet& Floquet::operator=(Floquet&&) noexcept = default;

void Floquet::move_to(const EquationOfMotion& equation) {
  impl_ = std::make_unique<Impl>(equation, impl_->highest, impl_.get());
}

bool Floquet::compute(double omega, const elements::Harmonics& harmonics,
                      const std::vector<ElementCourse>& elements, const GoOn& go_on) {
  return impl_->compute(omega, harmonics, elements, go_on);
}

int Floquet::modes() const {
  return impl_->phases ? static_cast<int>(impl_->phases->modes()) : impl_->equation.dofs();
}

const std::vector<std::complex<double>>& Floquet::multipliers() const {
  return impl_->multipliers;
}

const std::vector<std::complex<double>>& Floquet::half_multipliers() const {
  return impl_->half_multipliers;
}

const Matrix& Floquet::map() const {
  return impl_->map;
}

}  // namespace arcslip::time
