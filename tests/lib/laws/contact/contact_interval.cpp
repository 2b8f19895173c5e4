// What contacts do over the period, in addition to their shares, closed forms and the exact march in time.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace arcslip;
using continuation::Vector;
using elements::ContactInterval;
using std::numbers::pi;

using Intervals = std::vector<ContactInterval>;

namespace {

Intervals contact_of(const elements::Element& element) {
  Intervals intervals{{"left over", 0, 1}};
  element.contact(intervals);
  elements::put_in_order(intervals);
  return intervals;
}

double share(const Intervals& intervals, std::string_view state) {
  double sum = 0;
  for (const ContactInterval& each : intervals)
    if (each.state.starts_with(state)) sum += each.end - each.begin;
  return sum / (2 * pi);
}

void check_partition(const Intervals& intervals) {
  REQUIRE_FALSE(intervals.empty());
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const bool last = i + 1 == intervals.size();
    const ContactInterval& next = intervals[last ? 0 : i + 1];
    CHECK(intervals[i].begin >= 0);
    CHECK(intervals[i].begin < 2 * pi);
    CHECK(intervals[i].begin < intervals[i].end);
    CHECK(std::abs(intervals[i].end - next.begin - (last ? 2 * pi : 0)) < 2e-9);
    if (intervals.size() > 1) CHECK(intervals[i].state != next.state);
  }
}

Vector random_motion(const elements::Harmonics& h, int directions, std::mt19937& bits) {
  Vector u = every_law::random(directions * h.size(), 1, bits);
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const auto j = static_cast<int>(i % h.size());
    const int n = j < h.cosines() ? h.cosine_order(j) : h.sine_order(j - h.cosines());
    u[i] /= 1 + n * n;
  }
  return u;
}

// Of the law of an element of a scene, in the exact periodic motion: the mode behind each event.
Intervals marched(const time::PeriodicMotion& exact, int element, double omega) {
  Intervals intervals;
  for (const time::ContactEvent& event : exact.period.events) {
    if (event.element != element) continue;
    if (!intervals.empty()) intervals.back().end = omega * event.time;
    intervals.push_back({event.to, omega * event.time, 0});
  }
  if (!intervals.empty()) intervals.back().end = intervals.front().begin + 2 * pi;
  elements::put_in_order(intervals);
  return intervals;
}

}  // namespace

TEST_CASE("intervals are joined and ordered over the period") {
  const auto ordered = [](Intervals intervals) {
    elements::put_in_order(intervals);
    return intervals;
  };
  CHECK(ordered({}).empty());
  CHECK(ordered({{"stick", 3, 3 + 2 * pi}}) == Intervals{{"stick", 0, 2 * pi}});
  CHECK(ordered({{"stick", 1, 2}, {"stick", 2, 1 + 2 * pi}}) == Intervals{{"stick", 0, 2 * pi}});
  CHECK(ordered({{"stick", 1, 2}, {"slip+", 2, 2}, {"stick", 2, 4}, {"open", 4, 1 + 2 * pi}}) ==
        Intervals{{"stick", 1, 4}, {"open", 4, 1 + 2 * pi}});
  const auto turned =
      ordered({{"stick", 6, 7}, {"slip+", 7, 9}, {"slip-", 9, 11}, {"stick", 11, 6 + 2 * pi}});
  REQUIRE(turned.size() == 3);
  CHECK(turned[0].state == "slip+");
  CHECK(std::abs(turned[0].begin - (7 - 2 * pi)) < 1e-15);
  CHECK(turned[2].state == "stick");
  CHECK(std::abs(turned[2].end - turned[2].begin - (2 * pi - 4)) < 1e-15);
}

TEST_CASE("the intervals of a contact fill the period and have the shares of stick and separation") {
  struct Law {
    std::shared_ptr<const elements::Law> law;
    std::vector<double> fields;  // the last one: a load
  };
  const Law laws[] = {{elements::jenkins().law({}), {1, 0.5, 1}},
                      {elements::contact_2d().law({}), {1, 1.5, 0.5, 1}},
                      {elements::contact_3d().law({}), {1, 1.5, 0.5, 1}}};
  for (const auto& [law, fields] : laws) {
    for (const bool odd : {false, true}) {
      if (odd && law->directions() > 1) continue;  // a normal load is even
      const elements::Harmonics h{5, odd};
      const auto element = law->element(h, {});
      std::mt19937 bits(7);
      int in_slip = 0, separated = 0;
      for (int i = 0; i < 200; ++i) {
        const Vector u = random_motion(h, law->directions(), bits);
        std::vector<double> values = fields;
        values.back() = std::pow(10, -1.5 + 0.01 * i) * (law->directions() > 1 && i % 7 == 0 ? -1 : 1);
        CAPTURE(i, values.back(), odd, law->directions());
        element->move_to(u, values, false);
        elements::FrictionState state;
        REQUIRE(element->friction(state));
        const Intervals found = contact_of(*element);
        check_partition(found);
        CHECK(std::abs(share(found, "stick") - state.stick_share) < 1e-9);
        CHECK(std::abs(share(found, "open") - state.open_share) < 1e-9);
        if (state.stick_share + state.open_share < 1) ++in_slip;
        if (state.open_share > 0) ++separated;
      }
      CHECK(in_slip > 40);
      CHECK((separated > 20) == (law->directions() > 1));
    }
  }
}

TEST_CASE("the slip of a friction damper takes the sign of its force, also without friction or motion") {
  const elements::Harmonics h{1, true};
  const auto element = elements::jenkins().law({})->element(h, {});
  Vector u = Vector::Zero(h.size());
  element->move_to(u, std::vector<double>{1, 0.5, 0}, false);
  CHECK(contact_of(*element) == Intervals{{"slip", 0, 2 * pi}});
  u[h.cosine_index(1)] = 2;
  element->move_to(u, std::vector<double>{1, 0.5, 4}, false);
  CHECK(contact_of(*element) == Intervals{{"stick", 0, 2 * pi}});
  // From its largest displacement it sticks over 2 x_s = 2: cos theta = 0.
  element->move_to(u, std::vector<double>{1, 0.5, 2}, false);
  const Intervals found = contact_of(*element);
  REQUIRE(found.size() == 4);
  const char* states[] = {"stick", "slip-", "stick", "slip+"};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(found[i].state == states[i]);
    CHECK(std::abs(found[i].begin - static_cast<double>(i) * pi / 2) < 1e-14);
  }
  element->move_to(u, std::vector<double>{1, 0.5, 0}, false);
  CHECK(std::abs(share(contact_of(*element), "slip+") - 0.5) < 1e-14);
  CHECK(std::abs(share(contact_of(*element), "slip-") - 0.5) < 1e-14);
}

TEST_CASE("a gap spring is closed where a cosine is beyond its gaps") {
  const auto found = [](bool two_sided, double mean, double gap) {
    const elements::Harmonics h{3, false};
    const auto law = elements::gap_spring().law(scene::Settings::of(elements::GapSpringOptions{two_sided}));
    const auto element = law->element(h, {});
    Vector u = Vector::Zero(h.size());
    u[0] = mean;
    u[h.cosine_index(1)] = 2;
    element->move_to(u, std::vector<double>{5, gap}, false);
    const Intervals intervals = contact_of(*element);
    check_partition(intervals);
    return intervals;
  };
  const double a = std::acos((0.7 - 0.3) / 2), b = std::acos((-0.7 - 0.3) / 2);
  const Intervals one = found(false, 0.3, 0.7);
  REQUIRE(one.size() == 2);
  CHECK(one[0].state == "open");
  CHECK(std::abs(one[0].begin - a) < 1e-14);
  CHECK(std::abs(one[0].end - (2 * pi - a)) < 1e-14);
  CHECK(one[1].state == "closed");
  const Intervals two = found(true, 0.3, 0.7);
  REQUIRE(two.size() == 4);
  const std::pair<const char*, double> wanted[] = {
      {"open", a}, {"closed-", b}, {"open", 2 * pi - b}, {"closed+", 2 * pi - a}};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(two[i].state == wanted[i].first);
    CHECK(std::abs(two[i].begin - wanted[i].second) < 1e-14);
  }
  CHECK(found(true, 0.3, -0.7)[0].state == "closed");  // both sides touch
  CHECK(found(false, 0.3, 3) == Intervals{{"open", 0, 2 * pi}});
  CHECK(found(false, 0.3, -3) == Intervals{{"closed", 0, 2 * pi}});
}

TEST_CASE("along a line of the plane a contact does at each instant what the contact in one direction does") {
  const elements::Harmonics h{4, false};
  std::mt19937 bits(3);
  const auto one = elements::contact_2d().law({})->element(h, {});
  const auto plane = elements::contact_3d().law({})->element(h, {});
  for (int i = 0; i < 50; ++i) {
    CAPTURE(i);
    const Vector u = random_motion(h, 2, bits);
    Vector v = Vector::Zero(3 * h.size());
    v.head(h.size()) = 0.6 * u.head(h.size());
    v.segment(h.size(), h.size()) = 0.8 * u.head(h.size());
    v.tail(h.size()) = u.tail(h.size());
    const std::vector<double> fields{1, 1.5, 0.5, std::pow(10, -1 + 0.03 * i)};
    one->move_to(u, fields, false);
    plane->move_to(v, fields, false);
    Intervals wanted = contact_of(*one);
    for (ContactInterval& each : wanted)
      if (each.state.starts_with("slip")) each.state = "slip";
    elements::put_in_order(wanted);
    const Intervals found = contact_of(*plane);
    REQUIRE(found.size() == wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(found[k].state == wanted[k].state);
      CHECK(std::abs(found[k].begin - wanted[k].begin) < 1e-7);
    }
  }
}

TEST_CASE("without friction a contact in a plane slips while it is closed") {
  const elements::Harmonics h{2, false};
  const auto element = elements::contact_3d().law({})->element(h, {});
  Vector u = Vector::Zero(3 * h.size());
  u[h.cosine_index(1)] = 1;
  u[2 * h.size() + h.cosine_index(1)] = 1;
  element->move_to(u, std::vector<double>{1, 1, 0, 0}, false);
  const Intervals found = contact_of(*element);
  REQUIRE(found.size() == 2);
  CHECK(found[0].state == "open");
  CHECK(std::abs(found[0].begin - pi / 2) < 1e-14);
  CHECK(found[1].state == "slip");
  element->move_to(u, std::vector<double>{1, 1, 0, -2}, false);
  CHECK(contact_of(*element) == Intervals{{"open", 0, 2 * pi}});
  element->move_to(u, std::vector<double>{1, 1, 0, 2}, false);
  CHECK(contact_of(*element) == Intervals{{"slip", 0, 2 * pi}});
}

TEST_CASE("each contact does at each instant what it does in the exact motion in time") {
  const auto pad = [](double f_t, double f_n) {
    scene::Scene scene = contacts::line_pad(101, f_t, f_n);
    scene::set(scene, "load.cosine", 0);
    return scene;
  };
  const auto stop = [](double gap, bool two_sided) {
    std::ostringstream text;
    text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
        "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
      "elements": [{"name": "stop", "type": "gap_spring", "at": "x", "stiffness": 2, "two_sided": )"
         << (two_sided ? "true" : "false") << R"(, "gap": )" << gap
         << R"(}], "excitation": [{"name": "f", "at": "x", "cosine": 1}], "harmonics": {"order": 101},
      "studies": [{"kind": "frf", "from": 0.4, "to": 2.5}]})";
    return scenes::parse(text.str());
  };
  struct Case {
    scene::Scene scene;
    double frequency, error;
    std::size_t intervals;
  };
  const Case cases[] = {{scenes::paper(101), 20, 1e-5, 4}, {scenes::paper(401, 0.1), 0.2, 1e-4, 20},
                        {pad(5, 3), 95, 1e-5, 4},          {pad(20, 12), 95, 1e-5, 6},
                        {pad(5, 60), 95, 1e-5, 0},         {stop(0.5, false), 1.1, 1e-5, 2},
                        {stop(0.5, true), 1.1, 1e-5, 4},   {stop(-0.3, false), 1.1, 1e-5, 2}};
  for (const Case& each : cases) {
    CAPTURE(each.scene.elements[0].type->name(), each.frequency, each.intervals);
    const auto pair = compared_with_exact::balanced(each.scene, each.frequency);
    const auto at = pair.problem->hbm_evaluator();
    REQUIRE(at->move_to(pair.u, pair.p, continuation::Needs::residual) == continuation::Evaluated::ok);
    const Intervals found = contact_of(at->element(0));
    const Intervals wanted = marched(compared_with_exact::difference(pair, 3).exact, 0, pair.equation.omega);
    REQUIRE(found.size() == wanted.size());
    if (each.intervals > 0) CHECK(found.size() == each.intervals);
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].state == wanted[i].state);
      CHECK(std::abs(found[i].begin - wanted[i].begin) < each.error);
    }
  }
}
