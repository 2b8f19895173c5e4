// Piecewise linear laws in time, from their automata. A step in which the displacements move along a line
// goes through the modes of each automaton, from guard to guard; it is exact. With the share s of the step at
// which a slider that follows comes to rest, where the guard g = 0 is left,
//
//   z = z_q q(s) + z_0,   dz = (z_q - (z_q D) g_q / (g_q D)) ((1 - s) dq_0 + s dq_1)
//
// of the displacements q_0 at the start and q_1 at the end, D = q_1 - q_0; g_q: the derivative of the guard
// by q while z follows.

#include <arcslip/laws/automaton.hpp>
#include <arcslip/laws/time_law.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace arcslip::elements {
namespace {

// Of its terms: a guard of this size is 0.
constexpr double guard_rounding = 8 * std::numeric_limits<double>::epsilon();
constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr int bisections = 100;

// Automata of D directions, or of any number of them: their numbers, with 0 for what is empty.
template <int D>
struct Numbers {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Row = Eigen::Matrix<double, 1, D>;

  struct Leave {
    explicit Leave(const Guard& guard, Eigen::Index d)
        : q(row(guard.q, d)), v(row(guard.v, d)), z(guard.z), c(guard.c), to(guard.to), moves(!v.isZero(0)) {}

    Row q, v;
    double z, c;
    int to;
    bool moves;  // it has a velocity
  };

  struct Line {
    explicit Line(const Mode& mode)
        : f_q(mode.f_q),
          f_z(mode.f_z.size() > 0 ? Vector(mode.f_z) : Vector(Vector::Zero(mode.f_q.cols()))),
          f_0(mode.f_0),
          z_q(row(mode.z_q, mode.f_q.cols())),
          z_0(mode.z_0),
          way(mode.way),
          rests(mode.rests),
          open(mode.open) {
      for (const Guard& guard : mode.leaves) leaves.emplace_back(guard, mode.f_q.cols());
    }
    double following(const Vector& q) const { return z_q.dot(q) + z_0; }
    Vector force(const Vector& q, double z) const { return f_q * q + f_z * z + f_0; }

    Eigen::Matrix<double, D, D> f_q;
    Vector f_z, f_0;
    Row z_q;
    double z_0;
    int way;
    bool rests, open;
    std::vector<Leave> leaves;
  };

  explicit Numbers(const Automaton& automaton)
      : memory(automaton.memory), direction(automaton.direction), weight(automaton.weight) {
    for (const Mode& mode : automaton.modes) modes.emplace_back(mode);
  }
  static Row row(const Eigen::RowVectorXd& given, Eigen::Index d) {
    return given.size() > 0 ? Row(given) : Row(Row::Zero(d));
  }

  // The stiffness of the spring to the slider, which sticks in the first mode.
  double spring() const { return modes.front().rests ? -modes.front().f_z[direction] : 0; }
  // How far the slider may be moved from q, down with sign 1, up with -1.
  double room(double sign, const Vector& q) const {
    double least = no_limit;
    for (const Line& mode : modes)
      if (!mode.rests && !mode.open && mode.way != -sign)
        least = std::min(least, std::max(sign * (q[direction] - mode.following(q)), 0.0));
    return least;
  }

  int memory, direction;
  double weight;
  std::vector<Line> modes;
};

template <int D>
class AutomataInTime final : public TimeLaw {
 public:
  explicit AutomataInTime(const std::vector<Automaton>& automata) {
    for (const Automaton& automaton : automata) {
      automata_.emplace_back(automaton);
      if (automaton.memory >= 0) weights_ += automaton.weight;
    }
  }

  /// Of several sliders as after a first loading to f: all have been moved alike, up to their bounds.
  void memory_at(In q, In f, Out z) override;
  void begin(In q, Out z, StepEnd& at) override;
  void step(const StepStart& start, In dq, StepEnd& end) override;
  double stored(In q, In z) override;

 private:
  using All = Numbers<D>;
  using Line = typename All::Line;
  using Leave = typename All::Leave;
  using Vector = typename All::Vector;
  using Row = typename All::Row;

  /// Where a step is in one automaton.
  struct Place {
    const Line* mode = nullptr;
    double s = 0;    // share of the step
    double z = 0;    // the memory, where it rests
    double z_z = 1;  // its derivatives, by itself at the start; where that is 0, by the displacements
    Row z_q, z_start;
    Vector f;
    double work = 0, friction = 0, stick_share = 0, open_share = 0;  // so far
  };

  void load_along(int along, const Vector& q, double force, Out z) const;
  static void locate(const All& automaton, const Vector& q, Place& at);
  static void go_through(const All& automaton, const Vector& q, const Vector& dq, Place& at);
  static void advance(int along, double to, const Vector& q, const Vector& dq, Place& at);
  static void enter(const All& automaton, const Leave& by, const Vector& q, const Vector& dq, Place& at);
  // f, f_q and f_start, of a size that is known.
  static auto forces_of(StepEnd& end) {
    using Matrix = Eigen::Matrix<double, D, D>;
    const Eigen::Index d = end.f.size();
    return std::tuple(Eigen::Map<Vector>(end.f.data(), d), Eigen::Map<Matrix>(end.f_q.data(), d, d),
                      Eigen::Map<Matrix>(end.f_start.data(), d, d));
  }
  static void add_end(int k, const Vector& q, double z, const Place& at, StepEnd& end);

  std::vector<All> automata_;
  double weights_ = 0;  // of all sliders
};

// A guard without its velocity, and the rounding error of that.
template <class Leave, class Vector>
std::pair<double, double> value(const Leave& guard, const Vector& q, double z) {
  double sum = guard.z * z + guard.c, size = std::abs(guard.z * z) + std::abs(guard.c);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double part = guard.q[i] * q[i];
    sum += part;
    size += std::abs(part);
  }
  return {sum, guard_rounding * size};
}

template <int D>
void AutomataInTime<D>::memory_at(In at, In f, Out z) {
  const Vector q = at;
  for (int along = 0; along < q.size(); ++along) load_along(along, q, f[along], z);
}

// The sliders along one direction.
template <int D>
void AutomataInTime<D>::load_along(int along, const Vector& q, double force, Out z) const {
  std::vector<const All*> sliders;
  for (const All& automaton : automata_) {
    Place at;
    at.z = q[automaton.direction];
    locate(automaton, q, at);
    const bool slides = automaton.memory >= 0;
    const Line& mode = slides ? automaton.modes.front() : *at.mode;
    // The part of the force that is there where the springs to the sliders are unstretched.
    force -= mode.force(q, slides ? q[automaton.direction] : 0)[along];
    if (slides && automaton.direction == along) sliders.push_back(&automaton);
  }
  if (sliders.size() == 1 && sliders.front()->spring() > 0) {
    z[sliders.front()->memory] = q[along] - force / sliders.front()->spring();
    return;
  }
  const double sign = force < 0 ? -1 : 1;
  double low = 0, high = 0;
  for (const All* each : sliders)
    high = std::max(high, std::min(each->room(sign, q), std::abs(force) / each->spring()));
  for (int i = 0; i < bisections && !sliders.empty(); ++i) {
    const double middle = 0.5 * (low + high);
    double all = 0;
    for (const All* each : sliders) all += each->spring() * std::min(each->room(sign, q), middle);
    (all < std::abs(force) ? low : high) = middle;
  }
  for (const All* each : sliders) z[each->memory] = q[along] - sign * std::min(each->room(sign, q), high);
}

// The mode at a place, by its guards without velocities; a slider beyond a bound is moved to it.
template <int D>
void AutomataInTime<D>::locate(const All& automaton, const Vector& q, Place& at) {
  at.mode = &automaton.modes.front();
  for (std::size_t left = automaton.modes.size(); left > 0; --left) {
    if (!at.mode->rests) at.z = at.mode->following(q);
    const Leave* leaves = nullptr;
    for (const Leave& guard : at.mode->leaves) {
      if (guard.moves) continue;
      const auto [g, rounding] = value(guard, q, at.z);
      if (g < -rounding) {
        leaves = &guard;
        break;
      }
    }
    if (leaves == nullptr) return;
    at.mode = &automaton.modes[static_cast<std::size_t>(leaves->to)];
  }
}

template <int D>
void AutomataInTime<D>::begin(In start, Out z, StepEnd& at) {
  const Vector q = start;
  at.f.setZero();
  at.f_q.setZero();
  for (const All& automaton : automata_) {
    Place place;
    place.z = automaton.memory < 0 ? 0 : z[automaton.memory];
    locate(automaton, q, place);
    at.f += place.mode->force(q, place.z);
    // A slider at its bound would stick.
    for (const Leave& guard : place.mode->leaves)
      if (guard.moves) place.mode = &automaton.modes[static_cast<std::size_t>(guard.to)];
    at.f_q += place.mode->f_q;
    if (automaton.memory < 0) continue;
    z[automaton.memory] = place.z;
    at.f_z.col(automaton.memory).setZero();
    if (place.mode->rests) at.f_z.col(automaton.memory) = place.mode->f_z;
  }
}

template <int D>
void AutomataInTime<D>::step(const StepStart& start, In change, StepEnd& end) {
  const Vector q = start.q, dq = change, q_end = q + dq;
  auto [f, f_q, f_start] = forces_of(end);
  f.setZero();
  f_q.setZero();
  f_start.setZero();
  end.dissipated = end.stick_share = end.open_share = 0;
  Place at;
  for (const All& automaton : automata_) {
    const int k = automaton.memory;
    if (k < 0) {
      locate(automaton, q_end, at);
      f += at.mode->force(q_end, 0);
      f_q += at.mode->f_q;
      continue;
    }
    at.z = start.z[k];
    locate(automaton, q, at);
    // Of one alone, without the rounding errors of a difference.
    at.f = automata_.size() == 1 ? Vector(start.f) : at.mode->force(q, at.z);
    const double before = at.f[automaton.direction];
    go_through(automaton, q, dq, at);
    add_end(k, q_end, start.z[k], at, end);
    const double weight = automaton.weight / weights_;
    // Under a constant load by the trapezoidal rule, as the work of a step: what the spring stores is the
    // rest of that, to rounding. Else on the way.
    end.dissipated += q.size() == 1 ? 0.5 * (before + at.f[automaton.direction]) * end.dz[k] : at.friction;
    end.stick_share += weight * at.stick_share;
    end.open_share += weight * at.open_share;
  }
}

template <int D>
void AutomataInTime<D>::add_end(int k, const Vector& q, double z, const Place& at, StepEnd& end) {
  const Line& mode = *at.mode;
  auto [f, f_q, f_start] = forces_of(end);
  f += at.f;
  f_q += mode.f_q;
  const bool rests = mode.rests, moved = rests && at.z_z == 0;
  end.dz[k] = (rests ? at.z : mode.following(q)) - z;
  end.z_z(k, k) = rests ? at.z_z : 0;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    end.z_q(k, i) = !rests ? mode.z_q[i] : moved ? at.z_q[i] : 0;
    end.z_start(k, i) = moved ? at.z_start[i] : 0;
    end.f_z(i, k) = rests && !moved ? mode.f_z[i] : 0;
  }
  if (!moved) return;
  f_q += mode.f_z * at.z_q;
  f_start += mode.f_z * at.z_start;
}

// From a mode, its force and memory at q to those at q + dq.
template <int D>
void AutomataInTime<D>::go_through(const All& automaton, const Vector& q, const Vector& dq, Place& at) {
  at.s = at.work = at.friction = at.stick_share = at.open_share = 0;
  at.z_z = 1;
  // Each is entered twice at most, but for rounding errors.
  for (std::size_t left = 2 * automaton.modes.size(); left > 0; --left) {
    const Line& mode = *at.mode;
    const Vector here = q + at.s * dq;
    const double z = mode.rests ? at.z : mode.following(here), z_rate = mode.rests ? 0 : mode.z_q.dot(dq);
    const Leave* next = nullptr;
    double to = 1;
    for (const Leave& guard : mode.leaves) {
      const auto [g, rounding] = value(guard, here, z);
      const double rate = guard.q.dot(dq) + guard.z * z_rate, all = guard.moves ? g + guard.v.dot(dq) : g;
      double leaves = no_limit;
      if (rate < 0)
        leaves = at.s + (g <= 0 || g < rounding ? 0 : all / -rate);
      else if (rate == 0 && all < -rounding)
        leaves = at.s;
      if (leaves < to) {
        to = leaves;
        next = &guard;
      }
    }
    advance(automaton.direction, to, q, dq, at);
    if (next == nullptr) return;
    enter(automaton, *next, q, dq, at);
  }
  advance(automaton.direction, 1, q, dq, at);
}

// To a share of the step within its mode.
template <int D>
void AutomataInTime<D>::advance(int along, double to, const Vector& q, const Vector& dq, Place& at) {
  const Line& mode = *at.mode;
  const double share = to - at.s;
  if (!mode.rests) at.f = mode.force(q + at.s * dq, 0);
  const double before = at.f[along];
  at.work += 0.5 * share * at.f.dot(dq);
  if (mode.rests)
    at.f += share * (mode.f_q * dq);
  else
    at.f = mode.force(q + to * dq, 0);
  at.work += 0.5 * share * at.f.dot(dq);
  if (mode.open)
    at.open_share += share;
  else if (mode.rests)
    at.stick_share += share;
  else
    at.friction += 0.5 * (before + at.f[along]) * share * mode.z_q.dot(dq);
  at.s = to;
}

// The next mode, at the share of the step where the guard is 0.
template <int D>
void AutomataInTime<D>::enter(const All& automaton, const Leave& by, const Vector& q, const Vector& dq,
                              Place& at) {
  const Line& last = *at.mode;
  at.mode = &automaton.modes[static_cast<std::size_t>(by.to)];
  if (last.rests || !at.mode->rests || at.s <= 0) return;
  const Row by_q = by.q + by.z * last.z_q;
  const Row moved = last.z_q - last.z_q.dot(dq) / by_q.dot(dq) * by_q;
  at.z = last.following(q + at.s * dq);
  at.z_q = at.s * moved;
  at.z_start = (1 - at.s) * moved;
  at.z_z = 0;
}

// The work on the way there: first all but the sliders move, then these with what they slip on, and then the
// springs to them are stretched.
template <int D>
double AutomataInTime<D>::stored(In at_q, In z) {
  const Vector q = at_q;
  double energy = 0;
  for (const All& automaton : automata_) {
    const int k = automaton.memory;
    Vector way = q;
    if (k >= 0) way[automaton.direction] = 0;
    const Vector from = 0 * way;
    Place at;
    locate(automaton, from, at);
    at.f = at.mode->force(from, at.z);
    go_through(automaton, from, way, at);
    energy += at.work;
    if (k < 0) continue;
    at.z = z[k];
    locate(automaton, q, at);
    energy += 0.5 * at.mode->force(q, at.z)[automaton.direction] * (q[automaton.direction] - at.z);
  }
  return energy;
}

}  // namespace

std::unique_ptr<TimeLaw> time_law(const std::vector<Automaton>& automata) {
  switch (automata.front().modes.front().f_q.cols()) {
    case 1:
      return std::make_unique<AutomataInTime<1>>(automata);
    case 2:
      return std::make_unique<AutomataInTime<2>>(automata);
    default:
      return std::make_unique<AutomataInTime<Eigen::Dynamic>>(automata);
  }
}

}  // namespace arcslip::elements
