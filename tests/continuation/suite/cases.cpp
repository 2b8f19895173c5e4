#include "continuation/suite/cases.hpp"

#include <cmath>
#include <stdexcept>

namespace suite {

using arcslip::continuation::fold_monitor;
using arcslip::continuation::parameter_values;

namespace {

// Parameters other than the free one stay at their defaults.
Start at(const ProblemPtr& problem, Vector u, double value, int direction = 1, int free = 0) {
  Vector p = parameter_values(*problem);
  p[free] = value;
  return {std::move(u), std::move(p), free, direction};
}

Case make(std::string name, ProblemPtr problem, Vector u, double value, int direction, double lower,
          double upper, std::optional<std::vector<double>> folds = {}, double digits = 0, int free = 0) {
  Case c;
  c.name = std::move(name);
  c.start = at(problem, std::move(u), value, direction, free);
  c.problem = std::move(problem);
  c.lower = lower;
  c.upper = upper;
  c.folds = std::move(folds);
  c.digits = digits;
  return c;
}

Case crossing_others(Case c) {
  c.branch_points = true;
  return c;
}

// The response of an oscillator below resonance.
Vector quasistatic(double amplitude) {
  return Vector{{amplitude, 0.0}};
}

void reference_cases(std::vector<Case>& all) {
  const double bratu = 3.513830719125;
  all.push_back(
      make("bratu_chebyshev", bratu_chebyshev(31), Vector::Zero(31), 0.5, 1, 0.5, 5, {{bratu}}, 1e-12));
  all.push_back(make("bratu_numerov", bratu_differences(63, 4), Vector::Zero(63), 0.5, 1, 0.5, 5));
  all.push_back(make("bratu_three_points", bratu_differences(63, 2), Vector::Zero(63), 0.5, 1, 0.5, 5));
  all.push_back(make("chan", chan(100), Vector::Zero(100), 0, 1, 0, 5, {{4.06755724, 3.16019522}}, 1e-8));
  const double fold = 0.3849001794597505;
  all.push_back(make("cusp", cusp(), Vector{{-1.3}}, -1, 1, -1, 1, {{fold, -fold}}, 1e-15));
  all.push_back(make("ab", ab(), Vector::Zero(2), 0, 1, 0, 0.15, {{0.105739, 0.08893185}}, 1e-6));
  all.push_back(make("freudenstein_roth", freudenstein_roth(), Vector{{15.0, -2.0}}, 0, 1, -1, 1.5,
                     {{0.5875873, -0.6863528}}, 1e-7));
  all.push_back(make("freudenstein_roth_x1", exchanged(freudenstein_roth(), 0, 0), Vector{{0.0, -2.0}}, 15,
                     -1, 5, 70, {{14.28309, 61.66936}}, 1e-5));
  all.push_back(make("duffing_1harmonic", duffing_1harmonic(0.1), quasistatic(0.13), 0.5, 1, 0.5, 1.6,
                     {{1.227095772, 1.157717746}}, 1e-9));
  all.push_back(make("duffing_jenkins_omega", duffing_jenkins_1harmonic(0, 0.8), quasistatic(0.3), 0.5, 1,
                     0.5, 3, {{2.1150531362, 1.5063740448}}, 1e-10));
  all.push_back(make("duffing_jenkins_Fn_low", duffing_jenkins_1harmonic(2, 0), Vector{{-2.632, 0.774}}, 0.05,
                     1, 0.05, 4, {{0.9169049045}}, 1e-10, 1));
  all.push_back(make("duffing_jenkins_Fn_high", duffing_jenkins_1harmonic(2, 0), Vector{{-2.429, 0.491}}, 4,
                     -1, 0.05, 4, {{1.6884695203}}, 1e-10, 1));
  all.push_back(
      crossing_others(make("pitchfork", pitchfork(), Vector{{0.0}}, -1, 1, -1, 1, std::vector<double>{})));
  all.push_back(crossing_others(
      make("transcritical", transcritical(), Vector{{0.0}}, -1, 1, -1, 1, std::vector<double>{})));
}

void pitcon_cases(std::vector<Case>& all) {
  all.push_back(make("boggs_1", boggs({1, 0}), Vector{{1.0, 0.0}}, 0, 1, -1, 1));
  all.push_back(make("boggs_2", boggs({1, -1}), Vector{{1.0, -1.0}}, 0, 1, -1, 1));
  all.push_back(make("boggs_3", boggs({10, 10}), Vector{{10.0, 10.0}}, 0, 1, -1, 1));
  all.push_back(make("powell_1", powell({3, 6}), Vector{{3.0, 6.0}}, 0, 1, -1, 1));
  all.push_back(make("powell_2", powell({4, 5}), Vector{{4.0, 5.0}}, 0, 1, -1, 1));
  all.push_back(make("powell_3", powell({6, 3}), Vector{{6.0, 3.0}}, 0, 1, -1, 1));
  all.push_back(make("powell_4", powell({1, 1}), Vector{{1.0, 1.0}}, 0, 1, -1, 1));
  all.push_back(make("broyden", broyden({0.4, 3}), Vector{{0.4, 3.0}}, 0, 1, -1, 1));
  all.push_back(make("wacker_0.1", wacker(0.1), Vector::Zero(3), 0, 1, -0.5, 1.2));
  all.push_back(make("wacker_0.5", wacker(0.5), Vector::Zero(3), 0, 1, -0.5, 1.2));
  all.push_back(make("wacker_1", wacker(1), Vector::Zero(3), 0, 1, -0.5, 1.2, {{0.2739685}}, 1e-7));
  struct Trim {
    std::string name;
    double elevator;
    std::vector<double> folds;
  };
  // Solved for directly, from the limit points that TEST_CON prints.
  for (const Trim& trim :
       {Trim{"aircraft_1", -0.05, {-0.5048105070786}},
        Trim{"aircraft_2", -0.008, {-0.2049730045933, 0.006208207067966, -0.3776599599286}},
        Trim{"aircraft_3", 0, {-0.1869083326997, 0.5101585346486}},
        Trim{"aircraft_4", 0.05, {-0.2957724043265}}, Trim{"aircraft_5", 0.1, {-0.6897171900916}}})
    all.push_back(make(trim.name, aircraft(trim.elevator),
                       Vector{{0.0, -1.024 * trim.elevator, 0.0, -1.192 * trim.elevator, 0.0}}, 0, -1, -1, 1,
                       trim.folds, 1e-12));
  all.push_back(crossing_others(make("cell_kinetics", cell_kinetics(), Vector::Zero(5), 0, 1, 0, 60,
                                     {{34.3569249985262, 18.8870676579243}}, 1e-11)));
  all.push_back(make("riks_up", riks(), Vector::Zero(3), 0, 1, -2, 2));
  all.push_back(make("riks_down", riks(), Vector::Zero(3), 0, -1, -2, 2));
  const double load = 16 / std::sqrt(27.0);
  all.push_back(
      crossing_others(make("oden_0", oden(0), Vector::Zero(2), 0, 1, -5, 5, {{load, -load}}, 1e-12)));
  all.push_back(make("oden_0.25", oden(0.25), Vector::Zero(2), 0, 1, -5, 5,
                     {{2.004746522648, -2.464887340167, 2.464887340167, -2.004746522648}}, 1e-12));
  all.push_back(make("oden_0.5", oden(0.5), Vector::Zero(2), 0, 1, -5, 5,
                     {{1.779293550522, -1.846868519778, 1.846868519778, -1.779293550522}}, 1e-12));
  all.push_back(make("oden_1", oden(1), Vector::Zero(2), 0, 1, -5, 5,
                     {{1.837449954752, -1.253381799731, 1.253381799731, -1.837449954752}}, 1e-12));
  all.push_back(make("oden_1.252346", oden(1.252346), Vector::Zero(2), 0, 1, -5, 5));
  all.push_back(make("torsion", torsion(6), Vector::Zero(36), 0, 1, 0, 20, std::vector<double>{}));
  // Melhem's numbers are those of spacing 1/8: 7 x 7 inner points.
  all.push_back(make("simpson_exp", simpson(7, false), Vector::Zero(49), 0.5, 1, 0.5, 8, {{6.807504}}, 1e-6));
  all.push_back(
      make("simpson_exp_12", simpson(11, false), Vector::Zero(121), 0.5, 1, 0.5, 8, {{6.808004}}, 1e-6));
  all.push_back(make("simpson_rational", simpson(7, true), Vector::Zero(49), 7, 1, 7, 9, {{7.980356}}, 1e-6));
  all.push_back(
      make("keller", keller(12),
           Vector{{0.0297, 0.0297, 0.0297, 0.0399, 0.0619, 0.101, 0.165, 0.259, 0.387, 0.553, 0.757, 1.0}}, 0,
           1, 0, 1));
  all.push_back(make("trigger_circuit", trigger_circuit(), Vector::Zero(6), 0, 1, -1, 1,
                     {{0.601853012571, 0.322866124302}}, 1e-12));
  all.push_back(make("moore_spence", moore_spence(16), Vector::Ones(16), 0, 1, 0, 1));
  all.push_back(make("buckling_spring_0.01", buckling_spring(0.01), Vector{{1.0, -0.02}}, 0, 1, -1, 2));
}

void other_cases(std::vector<Case>& all) {
  all.push_back(make("circle", circle(), Vector{{1.0}}, 0, 1, -2, 2));
  all.push_back(make("brusselator", brusselator(), Vector{{1.0, 1.0}}, 1, 1, 0.5, 3, std::vector<double>{}));
  for (int k : {2, 5, 8}) {
    const double eps = std::pow(10, -k);
    const std::string to = "_1e-" + std::to_string(k);
    all.push_back(
        make("pitchfork_upper" + to, pitchfork(eps), Vector{{eps}}, -1, 1, -1, 1, std::vector<double>{}));
    all.push_back(make("pitchfork_lower" + to, pitchfork(eps), Vector{{-1.0}}, 1, -1, -1, 1,
                       {{3 * std::pow(eps / 2, 2.0 / 3)}}, 1e-12));
    all.push_back(make("transcritical_open" + to, transcritical(eps), Vector{{eps}}, -1, 1, -1, 1,
                       std::vector<double>{}));
    all.push_back(make("transcritical_folded" + to, transcritical(-eps), Vector{{1.0}}, 1, -1, -1, 1,
                       {{2 * std::sqrt(eps)}}, 1e-12));
  }
}

}  // namespace

Options window(double lower, double upper) {
  Options options;
  options.lower = lower;
  options.upper = upper;
  return options;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  reference_cases(all);
  pitcon_cases(all);
  other_cases(all);
  return all;
}

Case named(const std::string& name) {
  for (Case& c : cases())
    if (c.name == name) return c;
  throw std::out_of_range("no case \"" + name + "\"");
}

Branch trace(const Case& c) {
  Options options = window(c.lower, c.upper);
  options.points = 2000;  // a closed branch goes round and round
  return trace(c, options);
}

Branch trace(const Case& c, const Options& options) {
  return arcslip::continuation::trace(c.problem, c.start, options, {fold_monitor()});
}

std::vector<Event> folds(const Branch& branch) {
  std::vector<Event> found;
  for (const Event& event : branch.events)
    if (event.monitor == "fold") found.push_back(event);
  return found;
}

}  // namespace suite
