#include <arcslip/stability/contact_states_along.hpp>

#include <arcslip/time/event_driven/polynomial_roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arcslip::time {
namespace {

using elements::Automaton;
using elements::Guard;
using elements::Mode;

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

constexpr int most_periods = 6;
constexpr int most_changes = 10'000;
constexpr double touch = 1e-7;         // rad
constexpr double same_memory = 1e-11;  // of the memory, relative to the motion

using Series = MotionSeries::Series;

// c(s_0 + (1 - s_0) s), by Horner's scheme.
void begin_at(double s_0, Series& c) {
  for (std::size_t k = 0; k < c.size(); ++k)
    for (std::size_t j = c.size() - 1; j-- > k;) c[j] += s_0 * c[j + 1];
  double factor = 1;
  for (double& term : c) {
    term *= factor;
    factor *= 1 - s_0;
  }
}

}  // namespace

void MotionSeries::expand(const elements::Harmonics& harmonics, const Eigen::MatrixXd& q) {
  order_ = harmonics.order;
  pieces_ = static_cast<int>(std::ceil(elements::whole_turn * order_));
  directions_ = static_cast<std::size_t>(q.cols());
  length_ = elements::whole_turn / pieces_;
  size_ = q.colwise().norm().sum();
  series_.assign(static_cast<std::size_t>(pieces_) * directions_, Series{});
  for (int piece = 0; piece < pieces_; ++piece) {
    const double theta = elements::whole_turn * piece / pieces_;
    for (int j = 0; j < harmonics.cosines(); ++j) {
      const int n = harmonics.cosine_order(j);
      const double cosine = std::cos(n * theta), sine = std::sin(n * theta);
      for (std::size_t i = 0; i < directions_; ++i) {
        const auto column = q.col(static_cast<Eigen::Index>(i));
        const double a = column[j], b = n > 0 ? column[harmonics.sine_index(n)] : 0;
        // x and its derivative by n theta turn by a quarter with each term.
        const double x = a * cosine + b * sine, d = b * cosine - a * sine;
        Series& c = series_[static_cast<std::size_t>(piece) * directions_ + i];
        double factor = 1;
        for (std::size_t k = 0; k < terms; ++k) {
          const double part = k % 2 == 0 ? x : d;
          c[k] += (k % 4 < 2 ? factor : -factor) * part;
          factor *= n * length_ / static_cast<double>(k + 1);
        }
      }
    }
  }
  const int groups = (pieces_ + in_group - 1) / in_group;
  const Range none{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  displacements_.assign(static_cast<std::size_t>(groups) * directions_, none);
  velocities_ = displacements_;
  for (int piece = 0; piece < pieces_; ++piece)
    for (std::size_t i = 0; i < directions_; ++i) {
      const Series& c = series(piece, i);
      double swing = 0, bend = 0;
      for (std::size_t k = 1; k < terms; ++k) {
        swing += std::abs(c[k]);
        if (k > 1) bend += static_cast<double>(k) * std::abs(c[k]);
      }
      const auto widen = [](Range& range, double middle, double by) {
        range.low = std::min(range.low, middle - by);
        range.high = std::max(range.high, middle + by);
      };
      const auto at = static_cast<std::size_t>(piece / in_group) * directions_ + i;
      widen(displacements_[at], c[0], swing);
      widen(velocities_[at], c[1] / length_, bend / length_);
    }
}

namespace {

// One automaton that is led along a motion.
class Follower {
 public:
  Follower(const Automaton& automaton, const MotionSeries& motion)
      : automaton_(automaton), motion_(motion), series_(motion.directions()) {}

  bool run(Course& course) {
    for (int period = 0; period < most_periods; ++period) {
      course.changes.clear();
      course.first = now_;
      const double before = memory_at_start();
      if (!one_period(course.changes)) return false;
      const bool again =
          now_ == course.first && std::abs(memory_at_start() - before) <= same_memory * motion_.size();
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

  void look_at(int piece) {
    for (std::size_t i = 0; i < series_.size(); ++i) series_[i] = motion_.series(piece, i);
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
    look_at(0);
    return automaton_.memory < 0 ? 0 : memory(0);
  }

  // A guard as c + sum by_q q + by_v q' (by the angle) along what the memory does now.
  struct Along {
    double c, size;  // size: of its terms at the start of a piece
  };
  Along along(const Guard& guard) {
    const double by_z = automaton_.memory < 0 ? 0 : guard.z;
    const double shift = by_z == 0 ? 0 : by_z * (follows() ? mode().z_0 : z_);
    Along result{guard.c + shift, std::abs(guard.c) + std::abs(shift)};
    by_q_.resize(series_.size());
    by_v_.resize(series_.size());
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      by_q_[i] = (guard.q.size() > 0 ? guard.q[k] : 0) + (follows() && by_z != 0 ? by_z * mode().z_q[k] : 0);
      by_v_[i] = guard.v.size() > 0 ? guard.v[k] : 0;
      result.size += (std::abs(by_q_[i]) + std::abs(by_v_[i]) * motion_.order()) * motion_.size();
    }
    return result;
  }

  // The first guard that falls on [0, 1] of a piece of length h.
  const Guard* first(double h, double& s) {
    const Guard* found = nullptr;
    s = 1;
    Series c{};
    for (const Guard& guard : mode().leaves) {
      const Along now = along(guard);
      c.fill(0);
      c[0] = now.c;
      for (std::size_t i = 0; i < series_.size(); ++i) {
        const double by_q = by_q_[i], by_v = by_v_[i] / h;
        if (by_q != 0)
          for (std::size_t j = 0; j < c.size(); ++j) c[j] += by_q * series_[i][j];
        if (by_v != 0)
          for (std::size_t j = 0; j + 1 < c.size(); ++j)
            c[j] += by_v * static_cast<double>(j + 1) * series_[i][j + 1];
      }
      const auto fall = first_fall(c, sum_rounding * now.size);
      if (!fall || (found && *fall >= s)) continue;
      s = *fall;
      found = &guard;
    }
    return found;
  }

  // Whether no guard comes near zero in a group of pieces.
  bool stays(int group) {
    for (const Guard& guard : mode().leaves) {
      const Along now = along(guard);
      double least = now.c - sum_rounding * now.size;
      const auto take = [&](double by, const MotionSeries::Range& range) {
        least += std::min(by * range.low, by * range.high);
      };
      for (std::size_t i = 0; i < series_.size(); ++i) {
        if (by_q_[i] != 0) take(by_q_[i], motion_.displacement(group, i));
        if (by_v_[i] != 0) take(by_v_[i], motion_.velocity(group, i));
      }
      if (!(least > 0)) return false;
    }
    return true;
  }

  bool one_period(std::vector<ModeChange>& changes) {
    for (int piece = 0; piece < motion_.pieces(); ++piece) {
      if (piece % MotionSeries::in_group == 0 && stays(piece / MotionSeries::in_group)) {
        piece += MotionSeries::in_group - 1;
        continue;
      }
      look_at(piece);
      double theta = elements::whole_turn * piece / motion_.pieces(), h = motion_.length();
      while (true) {
        double s = 1;
        const Guard* guard = first(h, s);
        if (!guard) break;
        if (changes.size() > most_changes) return false;
        if (follows()) z_ = memory(s);
        theta += s * h;
        changes.push_back(
            {std::min(theta, std::nexttoward(elements::whole_turn, 0.0L)), now_, guard->to, guard});
        now_ = guard->to;
        h *= 1 - s;
        if (!(h > 0)) break;
        for (Series& each : series_) begin_at(s, each);
      }
    }
    return true;
  }

  const Automaton& automaton_;
  const MotionSeries& motion_;
  std::vector<Series> series_;  // on the piece
  std::vector<double> by_q_, by_v_;
  double z_ = 0;
  int now_ = 0;
};

}  // namespace

bool course_along(const Automaton& automaton, const MotionSeries& motion, Course& course) {
  if (std::all_of(automaton.modes.begin(), automaton.modes.end(),
                  [](const Mode& mode) { return mode.leaves.empty(); })) {
    course.changes.clear();
    course.first = 0;
    return true;
  }
  return Follower(automaton, motion).run(course);
}

}  // namespace arcslip::time
