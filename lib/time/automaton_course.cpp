#include <arcslip/time/automaton_course.hpp>

#include <arcslip/time/polynomial.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace arcslip::time {
namespace {

using elements::Automaton;
using elements::Guard;
using elements::Mode;

constexpr double turn = 2 * std::numbers::pi;
constexpr std::size_t most_modes = 64;

const Mode& mode_of(const Automaton& automaton, int at) {
  return automaton.modes[static_cast<std::size_t>(at)];
}

int named(const Automaton& automaton, std::string_view state) {
  for (std::size_t i = 0; i < automaton.modes.size(); ++i)
    if (automaton.modes[i].name == state) return static_cast<int>(i);
  return -1;
}

// The shortest way by guards, breadth first from its end.
bool add_way(const Automaton& automaton, int from, int to, double theta, std::vector<ModeChange>& changes) {
  const std::size_t count = automaton.modes.size();
  if (count > most_modes) return false;
  std::array<int, most_modes> distance;
  distance.fill(-1);
  distance[static_cast<std::size_t>(to)] = 0;
  for (int d = 0; distance[static_cast<std::size_t>(from)] < 0; ++d) {
    bool reached = false;
    for (std::size_t i = 0; i < count; ++i) {
      if (distance[i] >= 0) continue;
      for (const Guard& guard : automaton.modes[i].leaves)
        if (distance[static_cast<std::size_t>(guard.to)] == d) distance[i] = d + 1, reached = true;
    }
    if (!reached) return false;
  }
  while (from != to) {
    const int left = distance[static_cast<std::size_t>(from)];
    for (const Guard& guard : mode_of(automaton, from).leaves)
      if (distance[static_cast<std::size_t>(guard.to)] == left - 1) {
        changes.push_back({theta, from, guard.to, &guard});
        from = guard.to;
        break;
      }
  }
  return true;
}

}  // namespace

bool course_of(const Automaton& automaton, const std::vector<elements::ContactInterval>& intervals,
               Course& course) {
  course.changes.clear();
  course.first = 0;
  if (intervals.empty()) return false;
  int now = named(automaton, intervals.back().state);
  course.first = now;
  if (now < 0 || intervals.size() == 1) return now >= 0;
  for (const auto& each : intervals) {
    const int next = named(automaton, each.state);
    if (next < 0 || !add_way(automaton, now, next, each.begin, course.changes)) return false;
    now = next;
  }
  return true;
}

namespace {

constexpr std::size_t terms = 21;
constexpr int most_periods = 6;
constexpr int most_changes = 10'000;
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
constexpr double touch = 1e-7;     // rad
constexpr double repeats = 1e-11;  // of the memory, relative to the motion

using Series = std::array<double, terms>;

// One automaton that is led along a motion.
class Follower {
 public:
  Follower(const Automaton& automaton, const elements::Harmonics& harmonics, const Eigen::MatrixXd& q)
      : automaton_(automaton), harmonics_(harmonics), q_(q), series_(static_cast<std::size_t>(q.cols())) {
    for (const auto& column : q.colwise()) size_ += column.norm();
  }

  bool run(Course& course) {
    for (int period = 0; period < most_periods; ++period) {
      course.changes.clear();
      course.first = now_;
      const double before = memory_at_start();
      if (!one_period(course.changes)) return false;
      const bool again = now_ == course.first && std::abs(memory_at_start() - before) <= repeats * size_;
      if (again && period > 0) {
        drop_touches(course.changes);
        return true;
      }
    }
    return false;
  }

 private:
  const Mode& mode() const { return mode_of(automaton_, now_); }
  bool follows() const { return automaton_.memory >= 0 && !mode().rests; }

  // The series of each direction over [theta, theta + h].
  void expand(double theta, double h) {
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const auto column = q_.col(static_cast<Eigen::Index>(i));
      Series& c = series_[i];
      c.fill(0);
      for (int j = 0; j < harmonics_.cosines(); ++j) {
        const int n = harmonics_.cosine_order(j);
        const double a = column[j], b = n > 0 ? column[harmonics_.sine_index(n)] : 0;
        const double cosine = std::cos(n * theta), sine = std::sin(n * theta);
        // x and its derivative by n theta turn by a quarter with each term.
        const double x = a * cosine + b * sine, d = b * cosine - a * sine;
        double factor = 1;
        for (std::size_t k = 0; k < terms; ++k) {
          const double part = k % 2 == 0 ? x : d;
          c[k] += (k % 4 < 2 ? factor : -factor) * part;
          factor *= n * h / static_cast<double>(k + 1);
        }
      }
    }
  }

  double at(std::size_t i, double s) const { return value(series_[i], s); }

  double memory(double s) const {
    if (!follows()) return z_;
    double z = mode().z_0;
    for (std::size_t i = 0; i < series_.size(); ++i) z += mode().z_q[static_cast<Eigen::Index>(i)] * at(i, s);
    return z;
  }

  // A slider that was drawn to where its limit is just reached touches it once in each period.
  static void drop_touches(std::vector<ModeChange>& changes) {
    for (std::size_t k = 0; k + 1 < changes.size();) {
      const ModeChange &out = changes[k], &back = changes[k + 1];
      if (out.from == back.to && out.to == back.from && back.theta - out.theta < touch)
        changes.erase(changes.begin() + static_cast<std::ptrdiff_t>(k),
                      changes.begin() + static_cast<std::ptrdiff_t>(k) + 2);
      else
        ++k;
    }
  }

  double memory_at_start() {
    expand(0, 1);
    return automaton_.memory < 0 ? 0 : memory(0);
  }

  // The first guard that falls on [0, 1] of a piece of length h.
  const Guard* first(double h, double& s) const {
    const Guard* found = nullptr;
    s = 1;
    Series c{};
    for (const Guard& guard : mode().leaves) {
      const double by_z = automaton_.memory < 0 ? 0 : guard.z;
      c.fill(0);
      c[0] = guard.c + (by_z == 0 ? 0 : by_z * (follows() ? mode().z_0 : z_));
      double size = std::abs(guard.c) + std::abs(c[0] - guard.c);
      for (std::size_t i = 0; i < series_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const double by_q =
            (guard.q.size() > 0 ? guard.q[k] : 0) + (follows() && by_z != 0 ? by_z * mode().z_q[k] : 0);
        const double by_v = guard.v.size() > 0 ? guard.v[k] : 0;
        for (std::size_t j = 0; j < terms; ++j) c[j] += by_q * series_[i][j];
        for (std::size_t j = 0; j + 1 < terms; ++j)
          c[j] += by_v * static_cast<double>(j + 1) * series_[i][j + 1] / h;
        size += (std::abs(by_q) + std::abs(by_v) * harmonics_.order) * size_;
      }
      const auto fall = first_fall(c, rounding * size);
      if (!fall || (found && *fall >= s)) continue;
      s = *fall;
      found = &guard;
    }
    return found;
  }

  bool one_period(std::vector<ModeChange>& changes) {
    const int pieces = static_cast<int>(std::ceil(turn * harmonics_.order));
    for (int piece = 0; piece < pieces; ++piece) {
      double theta = turn * piece / pieces;
      const double end = turn * (piece + 1) / pieces;
      while (theta < end) {
        const double h = end - theta;
        expand(theta, h);
        double s = 1;
        const Guard* guard = first(h, s);
        if (!guard) break;
        if (changes.size() > most_changes) return false;
        if (follows()) z_ = memory(s);
        theta += s * h;
        changes.push_back({std::min(theta, std::nexttoward(turn, 0.0L)), now_, guard->to, guard});
        now_ = guard->to;
      }
    }
    return true;
  }

  const Automaton& automaton_;
  const elements::Harmonics& harmonics_;
  const Eigen::MatrixXd& q_;
  std::vector<Series> series_;
  double size_ = 0, z_ = 0;
  int now_ = 0;
};

}  // namespace

bool course_along(const Automaton& automaton, const elements::Harmonics& harmonics, const Eigen::MatrixXd& q,
                  Course& course) {
  if (std::all_of(automaton.modes.begin(), automaton.modes.end(),
                  [](const Mode& mode) { return mode.leaves.empty(); })) {
    course.changes.clear();
    course.first = 0;
    return true;
  }
  return Follower(automaton, harmonics, q).run(course);
}

}  // namespace arcslip::time
