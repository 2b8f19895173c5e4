// What follows from the automata of piecewise linear laws: forces that are sampled, traits, sliders, motions
// in time. Exact elements, closed forms and the laws' own functions are the witnesses.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/laws/hysteresis/iwan_laws.hpp"
#include "lib/laws/memoryless/piecewise_linear_laws.hpp"
#include "lib/laws/unequal_slider.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/sampled_automata.hpp>
#include <arcslip/scene/format/scene_file.hpp>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

using namespace arcslip;
using namespace elements;
using Eigen::MatrixXd, Eigen::VectorXd;

namespace {

const own_laws::UnequalSlider unequal_slider;
const auto four_springs = piecewise_linear_laws::table({{-0.6, -0.9}, {-0.2, -1}, {0.1, 0.8}, {0.5, 0.3}}),
           two_sided_gap = piecewise_linear_laws::gap(true),
           table_of_sliders = iwan_laws::law(iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}}));

constexpr std::string_view link_places[] = {"one", "other"};

struct Sampled {
  const Law& law;
  std::vector<double> fields;
};
const Sampled piecewise_linear[] = {
    {jenkins(), {2, 0.5, 1}},       {contact_2d(), {2, 1.5, 0.5, 1}}, {contact_2d(), {2, 1.5, 0.5, -0.3}},
    {contact_2d(), {2, 0, 0.5, 1}}, {*table_of_sliders, {1.2, 0.9}},  {*four_springs, {1.7}},
    {*two_sided_gap, {3, 0.2}}};

VectorXd motion(const Law& law, const Harmonics& h, double amplitude, unsigned seed) {
  VectorXd u(law.directions() * h.size());
  for (int i = 0; i < law.directions(); ++i)
    u.segment(i * h.size(), h.size()) =
        every_law::falling_motion(h, amplitude, seed + 100u * static_cast<unsigned>(i));
  return u;
}

double difference(const Element& a, const Element& b) {
  return (a.force() - b.force()).norm() + (a.jacobian() - b.jacobian()).norm();
}

}  // namespace

TEST_CASE("sampled forces of every piecewise linear law converge to the exact ones as samples^-2") {
  for (const Sampled& each : piecewise_linear)
    for (const bool odd : {false, true}) {
      if (odd && !each.law.antisymmetric()) continue;
      const Harmonics h{5, odd};
      const VectorXd u = motion(each.law, h, 1, 11);
      const auto exact = each.law.element(h, {});
      exact->move_to(u, each.fields, true);
      CAPTURE(each.fields, odd);
      for (const int samples : {1000, 10000, 100000}) {
        const auto sampled = sampled_automata(each.law, h, samples);
        sampled->move_to(u, each.fields, true);
        CHECK((sampled->force() - exact->force()).norm() < 100.0 / samples / samples);
        CHECK(difference(*sampled, *exact) < 200.0 / samples);
      }
    }
}

TEST_CASE("derivatives of sampled forces are those of their differences within a piece") {
  int within = 0;
  for (const Sampled& each : piecewise_linear)
    for (const bool odd : {false, true})
      for (unsigned seed = 1; seed < 20; ++seed) {
        if (odd && !each.law.antisymmetric()) continue;
        const Harmonics h{4, odd};
        const auto element = sampled_automata(each.law, h, 64);
        const VectorXd u = motion(each.law, h, 0.3 * seed / 5.0, seed);
        element->move_to(u, each.fields, true);
        const auto piece = element->piece();
        const MatrixXd J = element->jacobian();
        MatrixXd by_field(u.size(), static_cast<Eigen::Index>(each.fields.size()));
        for (std::size_t k = 0; k < each.fields.size(); ++k)
          element->field_derivative(static_cast<int>(k), by_field.col(static_cast<Eigen::Index>(k)));
        CAPTURE(each.fields, odd, seed);
        const auto slope = [&](auto&& move, double step) {
          move(step);
          const VectorXd above = element->force();
          bool same = element->piece() == piece;
          move(-step);
          same = same && element->piece() == piece;
          within += same;
          return std::pair(same, VectorXd((above - element->force()) / (2 * step)));
        };
        for (Eigen::Index i = 0; i < u.size(); ++i) {
          const auto [same, of] = slope(
              [&](double step) {
                VectorXd v = u;
                v[i] += step;
                element->move_to(v, each.fields, false);
              },
              1e-6);
          if (same) CHECK((of - J.col(i)).norm() < 1e-8);
        }
        for (std::size_t k = 0; k < each.fields.size(); ++k) {
          const auto [same, of] = slope(
              [&](double step) {
                std::vector<double> fields = each.fields;
                fields[k] += step;
                element->move_to(u, fields, false);
              },
              1e-6);
          if (same) CHECK((of - by_field.col(static_cast<Eigen::Index>(k))).norm() < 1e-7);
        }
      }
  CHECK(within > 1000);
}

TEST_CASE("what a sampled contact does is what it does exactly, and its force at an angle, too") {
  const Harmonics h{5, false};
  for (const Sampled& each : piecewise_linear)
    for (const double amplitude : {0.05, 1.0}) {
      const VectorXd u = motion(each.law, h, amplitude, 7);
      const std::vector<double> angles = {0.1, 1.3, 2.9, 4.4, 6.1, -0.4, 8.0};
      CAPTURE(each.fields, amplitude);
      CHECK((each.law.Law::force_at(h, u, each.fields, angles) - each.law.force_at(h, u, each.fields, angles))
                .cwiseAbs()
                .maxCoeff() < 0.02 * amplitude);
      const auto exact = each.law.element(h, {}), sampled = sampled_automata(each.law, h, 20000);
      exact->move_to(u, each.fields, false);
      sampled->move_to(u, each.fields, false);
      FrictionState one, other;
      const bool reports = exact->friction(one);
      REQUIRE(sampled->friction(other) == reports);
      if (!reports) continue;
      CHECK(std::abs(one.stick_share - other.stick_share) < 1e-3);
      CHECK(std::abs(one.open_share - other.open_share) < 1e-3);
      if (!each.law.has_normal_load()) continue;
      CHECK(std::abs(one.load_max - other.load_max) < 1e-6);
      CHECK(std::abs(one.load_min - other.load_min) < 1e-6);
    }
}

TEST_CASE("traits, stiffnesses and sliders that follow from automata are those that the laws state") {
  for (const Sampled& each : std::initializer_list<Sampled>{{jenkins(), {2, 0.5, 1}},
                                                            {contact_2d(), {2, 1.5, 0.5, 1}},
                                                            {contact_2d(), {2, 1.5, 0.5, -0.3}},
                                                            {contact_2d(), {2, 0, 0.5, 1}},
                                                            {*table_of_sliders, {1.2, 0.9}}})
    for (int i = 0; i < each.law.directions(); ++i) {
      CAPTURE(each.fields, i);
      const Traits own = each.law.traits(each.fields, i), derived = each.law.Law::traits(each.fields, i);
      CHECK(derived.stiffness == Approx(own.stiffness).epsilon(1e-15));
      CHECK(derived.holds_mean == own.holds_mean);
      CHECK(derived.holds_in_stick == own.holds_in_stick);
      CHECK(derived.several_responses == own.several_responses);
      CHECK(derived.far_power == own.far_power);
      CHECK(derived.far_work == Approx(own.far_work).epsilon(1e-15));
      CHECK(derived.limit == Approx(own.limit).epsilon(1e-15));
      CHECK(each.law.Law::stiffness(each.fields, i, 1) ==
            Approx(each.law.stiffness(each.fields, i, 1)).epsilon(1e-15));
    }
  const auto sliders = contact_2d().sliders(std::array{2.0, 1.5, 0.5, 1.0});
  REQUIRE(sliders.size() == 1);
  CHECK(sliders[0].direction == 0);
  CHECK(sliders[0].lower == Eigen::RowVector2d(1, -0.5 * 1.5 / 2));
  CHECK(sliders[0].upper == Eigen::RowVector2d(1, 0.5 * 1.5 / 2));
  CHECK_FALSE(sliders[0].room);
}

TEST_CASE("several sliders take a force as after a first loading, in time") {
  const auto law = table_of_sliders->in_time(std::array{1.2, 0.9});
  VectorXd q = VectorXd::Constant(1, 0.4), f(1), z(3);
  StepEnd at(1, 3);
  for (const double force : {-0.8, -0.3, 0.0, 0.2, 0.7, 0.85}) {
    f[0] = force;
    law->memory_at(q, f, z);
    law->begin(q, z, at);
    CHECK(at.f[0] == Approx(force).epsilon(1e-12).margin(1e-14));
  }
}

TEST_CASE("sliders along several directions take a force each, next to springs") {
  // k = 2 to a slider of limit 1 along each of two directions, and a spring of 5 N/m along the first.
  std::vector<Automaton> automata;
  for (const int along : {0, 1}) {
    Automaton& slider = automata.emplace_back(along);
    slider.direction = along;
    const Eigen::RowVectorXd unit = Eigen::RowVectorXd::Unit(2, along), none = Eigen::RowVectorXd::Zero(2);
    const auto add = [&](double k, double f, bool rests) -> Mode& {
      Mode& mode = slider.modes.emplace_back();
      mode.f_q = k * unit.transpose() * unit;
      mode.f_z = -k * unit.transpose();
      mode.f_0 = f * unit.transpose();
      mode.rests = rests;
      return mode;
    };
    Mode& stick = add(2, 0, true);
    stick.leaves = {{-2 * unit, none, 2, 1, 1}, {2 * unit, none, -2, 1, 2}};
    for (const int sign : {1, -1}) {
      Mode& slip = add(0, sign, false);
      slip.z_q = unit;
      slip.z_0 = -0.5 * sign;
      slip.way = sign;
      slip.leaves = {{none, sign * unit, 0, 0, 0}};
    }
  }
  Mode& spring = automata.emplace_back(-1).modes.emplace_back();
  spring.f_q = Eigen::Matrix2d{{5, 0}, {0, 0}};
  spring.f_0 = Eigen::Vector2d::Zero();
  const auto law = time_law(automata);
  const VectorXd q = Eigen::Vector2d(0.3, 0.5), f = Eigen::Vector2d(1.5 + 0.4, -0.6);
  VectorXd z(2);
  StepEnd at(2, 2);
  law->memory_at(q, f, z);
  law->begin(q, z, at);
  CHECK((at.f - f).norm() < 1e-14);
}

TEST_CASE("a slider with unequal limits rests midway between them in time, too") {
  auto catalogue = test_catalogue::whole();
  catalogue.elements.push_back(scene::lasting(unequal_slider));
  std::istringstream in(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "s", "type": "unequal_slider", "at": "x", "stiffness": 0.6, "up": 0.3, "down": 0.02}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.1}], "harmonics": {"order": 9}})");
  const scene::Scene s = scene::read(in, catalogue);
  const double w = 0.8, dynamic = 0.1 / std::hypot(1.6 - w * w, 0.05 * w);  // stuck
  const auto balance = observables::point_responses(s, {.frequency = w});
  REQUIRE(balance.size() == 1);
  // The mean force (0.3 - 0.02)/2 is that of the slider midway: x_0 = -0.14.
  CHECK(std::abs(balance[0].point.amplitude - (dynamic + 0.14)) < 1e-9);
  for (const auto method : {observables::TimeMethod::shooting, observables::TimeMethod::newmark_shooting}) {
    const auto motion = observables::motion_in_time(s, {.frequency = w, .method = method, .steps = 2000});
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(std::abs(motion.amplitude - balance[0].point.amplitude) < 1e-5);
    CHECK(std::abs(motion.energy.friction) < 1e-9);
  }
}

TEST_CASE("sampled friction keeps its digits where the slip limit is far beyond the motion") {
  const Harmonics h{5, false};
  const VectorXd u = 1e-6 * every_law::falling_motion(h, 1, 3);
  const auto exact = jenkins().element(h, {}), sampled = sampled_automata(jenkins(), h, 64);
  std::optional<VectorXd> first;
  for (const double load : {1e3, 1e9, 1e15, 1e300, std::numeric_limits<double>::infinity()}) {
    sampled->move_to(u, std::array{1e6, 1.0, load}, true);
    if (!first) first = sampled->force();
    CAPTURE(load);
    CHECK((sampled->force() - *first).norm() < 1e-14);
    CHECK(sampled->jacobian().allFinite());
  }
}

TEST_CASE("derivatives of sampled friction by a coefficient that is 0 hold for motions of any size") {
  const Harmonics h{3, false};
  for (const double amplitude : {1.0, 1e-6, 1e-11}) {
    VectorXd u = VectorXd::Zero(h.size());
    u[h.cosine_index(1)] = amplitude;
    const auto exact = jenkins().element(h, {}), sampled = sampled_automata(jenkins(), h, 20000);
    const std::array fields{1e6, 0.0, 100.0};
    exact->move_to(u, fields, false);
    sampled->move_to(u, fields, false);
    VectorXd wanted(h.size()), found(h.size());
    exact->field_derivative(1, wanted);
    sampled->field_derivative(1, found);
    CAPTURE(amplitude);
    CHECK((found - wanted).norm() < 1e-3 * wanted.norm());
  }
}

TEST_CASE("a spring between two places is one from its force alone, and automata must fit their law") {
  struct Link final : SampledLaw {
    std::string_view name() const override { return "link"; }
    std::span<const scene::Field> fields(const scene::Settings&) const override { return {}; }
    std::span<const std::string_view> slots() const override { return link_places; }
    void sample(Fields, const MatrixXd& q, SampledForce& at) const override {
      for (Eigen::Index s = 0; s < q.rows(); ++s) {
        const double d = q(s, 0) - q(s, 1);
        at.f.row(s) << d * d * d, -d * d * d;
        at.f_q.row(s) << 3 * d * d, -3 * d * d, -3 * d * d, 3 * d * d;
      }
    }
  };
  const Link link;
  for (const int direction : {0, 1}) {
    const Traits traits = link.traits({}, direction);
    CHECK(std::isinf(traits.stiffness));
    CHECK(traits.holds_mean);
    CHECK(traits.several_responses);
    CHECK(traits.far_power == Approx(3).epsilon(1e-3));
    CHECK(link.stiffness({}, direction, 0.5) == Approx(6.0));
  }
  const VectorXd q = Eigen::Vector2d(0.7, -0.2);
  CHECK(link.stored({}, q) == Approx(std::pow(0.9, 4) / 4).epsilon(1e-12));

  struct Forgetful final : PlainLaw {  // of its memory in facts()
    std::string_view name() const override { return "forgetful"; }
    std::span<const scene::Field> fields(const scene::Settings&) const override { return {}; }
    std::optional<std::vector<Automaton>> automata(Fields) const override {
      return unequal_slider.automata(std::array{1.0, 1.0, 1.0});
    }
  };
  CHECK_THROWS_AS(Forgetful().in_time({}), std::logic_error);
  CHECK_THROWS_AS(Forgetful().element({1, false}, {})->move_to(VectorXd::Zero(3), {}, true),
                  std::logic_error);
}

TEST_CASE("a step from slip to stick and back in one goes through both, with the energy of a closed form") {
  // k = 2, limits 0.5 up and 0.3 down: from slip up at q = 1 down by 2, of which 0.4 stick.
  const auto law = unequal_slider.in_time(std::array{2.0, 0.5, 0.3});
  StepEnd end(1, 1);
  VectorXd q = VectorXd::Constant(1, 1.0), z = VectorXd::Constant(1, 0.0), dq = VectorXd::Constant(1, -2.0);
  law->begin(q, z, end);
  CHECK(z[0] == 0.75);
  const VectorXd f = end.f;
  CHECK(f[0] == 0.5);
  CHECK(law->stored(q, z) == Approx(0.5 * 0.5 / (2 * 2)).epsilon(1e-15));
  law->step({q, z, f}, dq, end);
  CHECK(end.f[0] == -0.3);
  CHECK(z[0] + end.dz[0] == Approx(-1 + 0.15).epsilon(1e-15));
  CHECK(end.stick_share == Approx(0.2).epsilon(1e-14));
  CHECK(end.f_q(0, 0) == 0);
  CHECK(end.z_q(0, 0) == 1);
}

TEST_CASE("a law that is its automaton works in responses, time and stability") {
  auto catalogue = test_catalogue::whole();
  catalogue.elements.push_back(scene::lasting(unequal_slider));
  std::istringstream in(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "s", "type": "unequal_slider", "at": "x", "stiffness": 0.6, "up": 0.3, "down": 0.2}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.5}], "harmonics": {"order": 25, "samples": 2000},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.6, "to": 2}]})");
  const scene::Scene s = scene::read(in, catalogue);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::complete);
  const double w = 1.1;
  const auto at = observables::point_responses(s, {.frequency = w});
  REQUIRE(at.size() == 1);
  const auto exact =
      observables::motion_in_time(s, {.frequency = w, .method = observables::TimeMethod::shooting});
  REQUIRE(exact.status == observables::Status::complete);
  CHECK(exact.integrator == "event-driven");
  const double amplitude = exact.amplitude;
  CHECK(std::abs(at[0].point.amplitude - amplitude) < 1e-4 * amplitude);
  CHECK(std::abs(at[0].point.energy_friction - exact.energy.friction) < 1e-3 * exact.energy.friction);
  CHECK(std::abs(exact.energy.defect()) < 1e-12);
  const auto steps = observables::motion_in_time(
      s, {.frequency = w, .method = observables::TimeMethod::newmark_shooting, .steps = 4000});
  CHECK(std::abs(steps.amplitude - amplitude) < 1e-5 * amplitude);
  REQUIRE(steps.multipliers.size() == exact.multipliers.size());
  CHECK(std::abs(steps.multipliers[0] - exact.multipliers[0]) < 1e-4);
}

TEST_CASE("scenes sample every piecewise linear friction where they ask for it") {
  const auto amplitude_with = [](const std::string& friction) {
    std::istringstream in(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "at": "y", "value": 2}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.05}, {"name": "cy", "at": "y", "value": 0.05}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "x"}, "normal": {"at": "y"},
                  "tangential_stiffness": 0.8, "normal_stiffness": 0.5, "friction_coefficient": 0.4,
                  "normal_load": 0.6},
                 {"name": "joint", "type": "iwan", "at": "x", "sliders": 20, "stiffness": 0.5, "slip_force": 0.3}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}, {"name": "g", "at": "y", "sine": 0.2}],
    "harmonics": {"order": 9, "friction": ")" +
                          friction + R"(", "samples": 4000}, "response": {"at": "x"}})");
    const auto at =
        observables::point_responses(scene::read(in, test_catalogue::whole()), {.frequency = 1.1});
    REQUIRE(at.size() == 1);
    return at[0].point.amplitude;
  };
  const double exact = amplitude_with("exact"), sampled = amplitude_with("sampled");
  CHECK(std::abs(sampled - exact) < 1e-3 * exact);
  CHECK(sampled != exact);
}
