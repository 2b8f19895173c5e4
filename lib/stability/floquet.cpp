#include <arcslip/stability/floquet.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/stability/piecewise_linear_monodromy.hpp>
#include <arcslip/stability/varying_coefficients.hpp>
#include <arcslip/time/event_driven/taylor_propagator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace arcslip::time {
namespace {

constexpr int pieces_at_least = 32;  // of smooth laws without memory in a period
constexpr double stiffest = 800;     // rad of the fastest motion in such a piece: beyond, a law is too stiff
constexpr double longest_piece = 4;  // piece, rad of its fastest motion
// What a piece may leave out of hysteresis, before orthogonality.
constexpr double hysteresis_left_out = 3e-7;
constexpr double shortest_piece = 1e-9;  // rad
constexpr double pieces_per_order = 1;   // of the motion's harmonics
constexpr double long_enough = 0.05;     // of the longest interval without a change, to begin in it

bool falling(const std::complex<double>& a, const std::complex<double>& b) {
  return std::abs(a) > std::abs(b);
}

}  // namespace

struct Floquet::Impl {
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

  // Of the mode of parts[of], or of the memory of a varying law.
  struct Change {
    double theta;  // from the start
    std::size_t of, index;
    bool varying = false;
  };

  Impl(const EquationOfMotion& of, const ModesKept& modes_kept, std::shared_ptr<const NaturalModes> modes,
       Impl* before)
      : equation(of), with_inertia(modes_kept) {
    const bool all_linear = std::none_of(
        equation.elements.begin(), equation.elements.end(),
        [](const auto& e) { return VaryingCoefficients::takes(*e.law) && !e.law->automata(e.fields); });
    if (!all_linear) mass.factorize(equation.M);
    for (std::size_t e = 0; e < equation.elements.size(); ++e) add(static_cast<int>(e));
    if (all_linear) {
      auto all = phase_parts();
      const bool same = before && before->phases && before->has_matrices_of(equation);
      if (same && before->phases->parts() == all)
        phases = std::move(before->phases);
      else
        phases.emplace(equation, std::move(all), with_inertia,
                       same ? before->phases->natural_modes() : std::move(modes));
      return;
    }
    std::vector<LinearMotion::Part> stiffnesses;
    for (const Part& part : parts) {
      stiffnesses.push_back({part.directions, {}});
      for (const auto& mode : part.automaton.modes) stiffnesses.back().stiffnesses.push_back(mode.f_q);
    }
    fastest_mode = fastest(equation, stiffnesses).value();
    over_mass_K = mass.solve(equation.K);
    over_mass_C = mass.solve(equation.C);
    for (Part& part : parts) part.over_mass = mass.solve(part.directions);
  }

  bool has_matrices_of(const EquationOfMotion& of) const {
    return equation.M == of.M && equation.C == of.C && equation.K == of.K;
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
    if (!VaryingCoefficients::takes(*element.law))
      throw NoVariation("the memory of \"" + element.name + "\" is of an unknown kind");
    if (element.law->may_jump())
      throw NoVariation("the force of \"" + element.name +
                        "\" may jump, and its multipliers are not computed");
    varying.add(element, e, mass.solve(element.directions));
  }

  bool compute(double base_frequency, const elements::Harmonics& harmonics,
               const std::vector<ElementCourse>& elements, const control::Control& control) {
    omega = base_frequency;
    span = harmonics.span();
    if (!varying.follow(omega, fastest_mode, harmonics, elements) || !follow(harmonics, elements))
      return false;
    begin();
    if (phases)
      phases->begin(modes_now(), kept);
    else if (!begin_varying(harmonics))
      return false;
    std::size_t next = 0;
    double theta = 0;
    while (true) {
      if (!control.keep_going()) return false;
      const double end = next < changes.size() ? changes[next].theta : span;
      const bool moved = phases ? phases->move((end - theta) / omega) : move_varying(theta, end);
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
    if (!follow_parts(harmonics, elements)) return false;
    choose_start();
    for (Change& change : changes) {
      change.theta -= start;
      if (change.theta < 0) change.theta += elements::whole_turn;
    }
    sort_changes();
    while (!changes.empty() && changes.back().theta >= span) changes.pop_back();
    breaks.clear();
    for (const double theta : varying.breaks()) {
      const double from_start = std::fmod(theta - start, span);
      breaks.push_back(from_start < 0 ? from_start + span : from_start);
    }
    std::sort(breaks.begin(), breaks.end());
    return true;
  }

  void sort_changes() {
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.theta < b.theta; });
  }

  // The courses of all automata, and their changes with those of the coefficients.
  bool follow_parts(const elements::Harmonics& harmonics, const std::vector<ElementCourse>& elements) {
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
    for (std::size_t i = 0; i < varying.changes().size(); ++i)
      changes.push_back({varying.changes()[i].theta, i, 0, true});
    sort_changes();
    return true;
  }

  // In a long interval between two changes in which few automata rest.
  void choose_start() {
    const auto length = [&](std::size_t k) {
      const bool last = k + 1 == changes.size();
      return (last ? changes.front().theta + elements::whole_turn : changes[k + 1].theta) - changes[k].theta;
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
      if (!changes[k].varying) {
        Part& part = parts[changes[k].of];
        resting -= part.rests() ? 1 : 0;
        part.now = part.course.changes[changes[k].index].to;
        resting += part.rests() ? 1 : 0;
      }
      const double is_long = length(k);
      if (is_long < long_enough * longest || std::pair(resting, -is_long) >= std::pair(fewest, -its_length))
        continue;
      fewest = resting;
      its_length = is_long;
      start = changes[k].theta + 0.5 * is_long;
    }
  }

  void begin() {
    kept.clear();
    zeros = varying.following_at(start);
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
  bool begin_varying(const elements::Harmonics& harmonics) {
    const Eigen::Index n = equation.dofs();
    const auto memories = 2 * n + static_cast<Eigen::Index>(kept.size());
    const auto starts = memories + varying.free_at(start);
    W.setZero(starts, n);
    V.setZero(starts, n);
    Z.setZero(starts, equation.memory);
    W.topRows(n).setIdentity();
    V.middleRows(n, n).setIdentity();
    for (std::size_t k = 0; k < kept.size(); ++k) Z(2 * n + static_cast<Eigen::Index>(k), kept[k]) = 1;
    varying.begin(start, starts, memories);
    C = over_mass_C / omega;
    rate = fastest_mode / omega;
    piece = elements::whole_turn / std::max<double>(pieces_at_least, pieces_per_order * harmonics.order);
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

  // False: too stiff.
  bool move_varying(double theta, double end) {
    set_modes();
    variation.set(K, C, G);
    auto next = std::upper_bound(breaks.begin(), breaks.end(), theta);
    while (theta < end) {
      const double to = next != breaks.end() && *next < end ? *next++ : end;
      const int pieces = varying.any_smooth() ? static_cast<int>(std::ceil((to - theta) / piece)) : 1;
      for (int i = 0; i < pieces; ++i)
        if (!move_piece(theta + (to - theta) * i / pieces, (to - theta) / pieces)) return false;
      theta = to;
    }
    return true;
  }

  bool move_piece(double from, double h) {
    const auto coefficients = varying.interpolate(start + from, h);
    const double fastest = fastest_with(coefficients.largest);
    if (!(fastest * piece <= stiffest)) return false;
    const double in_series = fastest_with(coefficients.sizes);
    if (!std::isfinite(in_series + coefficients.last + coefficients.memory + coefficients.last_memory))
      return false;
    const double most_left_out = h > shortest_piece ? hysteresis_left_out * fastest / h : HUGE_VAL;
    const double last = coefficients.last + fastest * coefficients.last_memory;
    if (h * std::max(in_series, coefficients.memory) <= longest_piece && last <= most_left_out &&
        varying.left_out(start + from, h) <= most_left_out) {
      variation.move(h, rate, varying.variables(), W, V);
      if (varying.any_relaxed())
        varying.relax(start + from + h, W, V, variation.acceleration(varying.variables(), W, V));
      return true;
    }
    const int shares = std::max(2, static_cast<int>(std::ceil(h * fastest / longest_piece)));
    for (int i = 0; i < shares; ++i)
      if (!move_piece(from + h * i / shares, h / shares)) return false;
    return true;
  }

  // rad/rad.
  double fastest_with(const VaryingCoefficients::Rates& rates) const {
    return std::sqrt(rate * rate + rates.stiffness) + rates.damping;
  }

  void pass(const Change& at, const elements::Harmonics& harmonics,
            const std::vector<ElementCourse>& elements) {
    if (at.varying) return varying.pass(varying.changes()[at.of], W);
    Part& part = parts[at.of];
    const ModeChange& change = part.course.changes[at.index];
    const elements::Mode& left = part.mode();
    const elements::Mode& next = part.automaton.modes[static_cast<std::size_t>(change.to)];
    if (part.memory >= 0 && !left.rests && next.rests)
      settle(at.of, *change.by, change.theta, harmonics, elements);
    part.now = change.to;
    if (phases) phases->change(at.of, change.to);
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
      const auto memories = 2 * n + static_cast<Eigen::Index>(kept.size());
      map.resize(W.rows(), W.rows());
      map.topRows(n) = W.transpose();
      map.middleRows(n, n) = V.transpose();
      for (std::size_t k = 0; k < kept.size(); ++k)
        map.row(2 * n + static_cast<Eigen::Index>(k)) = Z.col(kept[k]);
      varying.end(start, map, memories);
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
  const ModesKept with_inertia;
  std::optional<LinearPhases> phases;  // of a structure without varying laws; then no W, V and Z
  continuation::Cholesky mass;
  std::vector<Part> parts;
  VaryingCoefficients varying;
  Matrix over_mass_K, over_mass_C;
  double fastest_mode = 0;  // rad/s, of the automata's stiffest modes

  // Of one motion.
  MotionSeries series;
  double omega = 0, span = 0, start = 0, rate = 0, piece = 0;
  std::vector<Change> changes;  // in [0, span)
  std::vector<double> breaks;   // ends of pieces, in [0, span)
  std::vector<int> kept;        // memories with a column
  int zeros = 0;
  Matrix K, C, G, map;
  Matrix W, V, Z;  // a row for each start: dw, dw', dz
  Eigen::RowVectorXd by_q;
  Variation variation;
  continuation::Eigenvalues eigenvalues;
  std::vector<std::complex<double>> multipliers, half_multipliers;
};

Floquet::Floquet(const EquationOfMotion& equation, const ModesKept& kept,
                 std::shared_ptr<const NaturalModes> modes)
    : impl_(std::make_unique<Impl>(equation, kept, std::move(modes), nullptr)) {}
Floquet::~Floquet() = default;
Floquet::Floquet(Floquet&&) noexcept = default;
Floquet& Floquet::operator=(Floquet&&) noexcept = default;

void Floquet::move_to(const EquationOfMotion& equation) {
  impl_ = std::make_unique<Impl>(equation, impl_->with_inertia, nullptr, impl_.get());
}

bool Floquet::has_matrices_of(const EquationOfMotion& equation) const {
  return impl_->has_matrices_of(equation);
}

bool Floquet::compute(double omega, const elements::Harmonics& harmonics,
                      const std::vector<ElementCourse>& elements, const control::Control& control) {
  return impl_->compute(omega, harmonics, elements, control);
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
