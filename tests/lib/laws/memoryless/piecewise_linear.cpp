// Springs whose force is piecewise linear: coefficients in closed form, descriptions that are the same, exact
// motions in time.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/every_law.hpp"
#include "lib/laws/memoryless/piecewise_linear_laws.hpp"

#include <cmath>
#include <numbers>

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;
using elements::Harmonics;
using piecewise_linear_laws::bilinear;
using piecewise_linear_laws::gap;
using piecewise_linear_laws::table;
using std::numbers::pi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// a + b cos theta
VectorXd cosine(const Harmonics& h, double a, double b) {
  VectorXd u = VectorXd::Zero(h.size());
  if (!h.odd) u[0] = a;
  u[h.cosine_index(1)] = b;
  return u;
}

VectorXd random_motion(const Harmonics& h, unsigned seed) {
  std::mt19937 bits(seed);
  return every_law::random(h.size(), 1, bits);
}

struct Result {
  VectorXd F;
  MatrixXd J;
  std::vector<VectorXd> by_field;
};

Result result_of(const elements::Law& law, const Harmonics& h, const VectorXd& u,
                 const std::vector<double>& fields) {
  const auto element = law.element(h, {});
  element->move_to(u, fields, true);
  Result result{element->force(), element->jacobian(), {}};
  for (std::size_t k = 0; k < fields.size(); ++k) {
    result.by_field.emplace_back(h.size());
    element->field_derivative(static_cast<int>(k), result.by_field.back());
  }
  return result;
}

// Of a cosine of amplitude b through a stop at r b: what it passes on of the spring's stiffness.
double share_beyond(double r) {
  return 1 - 2 / pi * (std::asin(r) + r * std::sqrt((1 - r) * (1 + r)));
}

void check_equal(const Result& a, const Result& b, double tolerance) {
  CHECK((a.F - b.F).norm() <= tolerance * (1 + b.F.norm()));
  CHECK((a.J - b.J).norm() <= tolerance * (1 + b.J.norm()));
}

}  // namespace

TEST_CASE("the coefficients of a + b cos theta behind a gap are those of its integrals in closed form") {
  const Harmonics h{6, false};
  for (const auto& [k, g, a, b] : {std::array{2.0, 0.5, 0.1, 1.0},
                                   {2.0, 0.5, 0.4, 3.0},
                                   {1e-9, -0.3, -0.2, 0.7},
                                   {3e5, 1e-6, 2e-7, 2e-6},
                                   {7.0, 0.0, -0.5, 0.6}}) {
    CAPTURE(k, g, a, b);
    const double t = std::acos((g - a) / b), mean = (k / pi) * ((a - g) * t + b * std::sin(t));
    const Result at = result_of(*gap(false), h, cosine(h, a, b), {k, g});
    CHECK(std::abs(at.F[0] - (mean - k * std::max(-g, 0.0))) < 1e-14 * k * (b + std::abs(g)));
    for (int n = 1; n <= 6; ++n) {
      const double below = n == 1 ? t : std::sin((n - 1) * t) / (n - 1);
      const double expected =
          k / pi * (2 * (a - g) * std::sin(n * t) / n + b * (below + std::sin((n + 1) * t) / (n + 1)));
      CHECK(std::abs(at.F[n] - expected) < 1e-14 * k * b);
      CHECK(std::abs(at.J(n, 0) - 2 * k / pi * std::sin(n * t) / n) < 1e-14 * k);
    }
    CHECK(std::abs(at.J(0, 0) - k * t / pi) < 1e-14 * k);
    CHECK(at.F.tail(h.sines()).cwiseAbs().maxCoeff() < 1e-14 * k * b);
    CHECK(std::abs(at.by_field[1][0] - (g < 0 ? k * (1 - t / pi) : -k * t / pi)) < 1e-14 * k);
  }
}

TEST_CASE("symmetric springs of a cosine have the known describing functions, over 24 decades of stiffness") {
  for (const bool odd : {false, true}) {
    const Harmonics h{5, odd};
    const int first = h.cosine_index(1);
    for (const double r : {1e-9, 0.001, 0.3, 0.9, 0.999999}) {
      const double b = 0.02, c = r * b;
      CAPTURE(odd, r);
      const VectorXd u = cosine(h, 0, b);
      const Result dead = result_of(*gap(true), h, u, {5, c});
      CHECK(std::abs(dead.F[first] / (5 * b) - share_beyond(r)) < 4e-15);
      // Two preloaded springs: 2 k as long as both touch.
      const Result preloaded = result_of(*gap(true), h, u, {5, -c});
      CHECK(std::abs(preloaded.F[first] / (5 * b) - (2 - share_beyond(r))) < 8e-15);
      CHECK(std::abs(preloaded.J(first, first) -
                     5 * (2 - (1 - 2 / pi * (std::asin(r) - r * std::sqrt((1 - r) * (1 + r)))))) < 4e-14);
      for (const double ratio : {1e-12, 1e-3, -0.5, 1.0, 7.0, 1e12}) {
        CAPTURE(ratio);
        const Result both = result_of(*bilinear(false), h, u, {3, 3 * ratio, c});
        const double within = 2 / pi * (std::asin(r) + r * std::sqrt((1 - r) * (1 + r)));
        const double expected = 3 * b * (within + ratio * share_beyond(r));
        CHECK(std::abs(both.F[first] - expected) < 1e-14 * 3 * b * (within + std::abs(ratio)));
        CHECK(both.F.tail(h.sines()).cwiseAbs().maxCoeff() < 1e-14 * (1 + std::abs(ratio)) * b);
      }
    }
  }
}

TEST_CASE("a stiff spring within its corner takes no digits from the soft one beyond") {
  // Constant far beyond: k_2 is all of the Jacobian, though k_1 is 1e24 times as stiff.
  const Harmonics h{4, false};
  VectorXd u = cosine(h, 2, 0.5);
  const Result at = result_of(*bilinear(false), h, u, {1e12, 1e-12, 1e-12});
  CHECK((at.J - 1e-12 * MatrixXd::Identity(h.size(), h.size())).norm() < 1e-26);
  CHECK(std::abs(at.F[0] - 1) < 1e-11);
  CHECK(std::abs(at.F[1] - 0.5e-12) < 1e-15);
}

TEST_CASE("springs that are the same by different descriptions have the same coefficients to rounding") {
  for (const bool odd : {false, true})
    for (unsigned seed = 1; seed <= 30; ++seed) {
      const Harmonics h{5, odd};
      const VectorXd u = random_motion(h, seed);
      CAPTURE(odd, seed);
      for (const double g : {0.4, 0.0, -0.3}) {
        CAPTURE(g);
        const Result one = result_of(*gap(false), h, u, {3, g});
        const double preload = 3 * std::max(-g, 0.0);
        check_equal(one,
                    result_of(*table({{g - 1, -preload}, {g, -preload}, {g + 1, 3 - preload}}), h, u, {1}),
                    1e-13);
        // One on each side: the second sees the motion with the other sign.
        const Result two = result_of(*gap(true), h, u, {3, g}), other = result_of(*gap(false), h, -u, {3, g});
        check_equal(two, {one.F - other.F, one.J + other.J, {}}, 1e-13);
        CHECK((two.by_field[0] - (one.by_field[0] - other.by_field[0])).norm() < 1e-13);
        if (g != 0) CHECK((two.by_field[1] - (one.by_field[1] - other.by_field[1])).norm() < 1e-12);
      }
      const double k = 1.3, beyond = 4.1, c = 0.4;
      const Result bi = result_of(*bilinear(false), h, u, {k, beyond, c});
      const Result stops = result_of(*gap(true), h, u, {beyond - k, c});
      const MatrixXd I = MatrixXd::Identity(h.size(), h.size());
      check_equal(bi, {k * u + stops.F, k * I + stops.J, {}}, 1e-13);
      CHECK((bi.by_field[0] - (u - stops.by_field[0])).norm() < 1e-13);
      CHECK((bi.by_field[1] - stops.by_field[0]).norm() < 1e-13);
      CHECK((bi.by_field[2] - stops.by_field[1]).norm() < 1e-12);
      const Result half = result_of(*bilinear(true), h, u, {k, beyond, c});
      const Result stop = result_of(*gap(false), h, u, {beyond - k, c});
      check_equal(half, {k * u + stop.F, k * I + stop.J, {}}, 1e-13);
      const auto mirrored =
          table({{-1, -k * c - beyond * (1 - c)}, {-c, -k * c}, {c, k * c}, {1, k * c + beyond * (1 - c)}});
      CHECK(mirrored->antisymmetric());
      check_equal(bi, result_of(*mirrored, h, u, {1}), 1e-13);
      // Softening: the same with a negative jump.
      const Result soft = result_of(*bilinear(false), h, u, {beyond, -0.5, c});
      const Result by = result_of(*gap(true), h, u, {beyond + 0.5, c});
      check_equal(soft, {beyond * u - by.F, beyond * I - by.J, {}}, 1e-13);
    }
}

TEST_CASE("points of a table on one line change nothing, and f(0) is a constant force") {
  const Harmonics h{4, false};
  const VectorXd u = random_motion(h, 3);
  const Result few = result_of(*table({{-2, -3}, {0.3, 1.6}, {1, 5}}), h, u, {2});
  const Result many = result_of(*table({{-2, -3}, {-1, -1}, {0.3, 1.6}, {0.65, 3.3}, {1, 5}}), h, u, {2});
  check_equal(few, many, 1e-13);
  CHECK((few.F - 2 * few.by_field[0]).norm() < 1e-14);
  const Result line = result_of(*table({{1, 5}, {2, 8}}), h, u, {1});  // f = 2 + 3 q
  VectorXd expected = 3 * u;
  expected[0] += 2;
  CHECK((line.F - expected).norm() < 1e-14);
  CHECK_FALSE(table({{1, 5}, {2, 8}})->antisymmetric());
  CHECK(table({{1, 3}, {2, 6}})->antisymmetric());
  CHECK_THROWS_AS(table({}), std::invalid_argument);
  CHECK_THROWS_AS(table({{0, 0}, {0, 1}}), std::invalid_argument);
}

TEST_CASE("at a corner the derivatives are those from the left, and the others come from the right") {
  const Harmonics h{3, false};
  struct Kinked {
    piecewise_linear_laws::LawPointer law;
    std::vector<double> fields;
    double corner, left, right;
  };
  for (const auto& [law, fields, corner, left, right] :
       {Kinked{gap(false), {3, 0.5}, 0.5, 0, 3},
        {gap(true), {3, 0.5}, -0.5, 3, 0},
        {gap(false), {3, -0.5}, -0.5, 0, 3},
        {gap(true), {3, -0.5}, 0.5, 6, 3},
        {bilinear(false), {4, -1, 0.25}, 0.25, 4, -1},
        {bilinear(true), {4, 9, 0}, 0, 4, 9},
        {table({{-1, 0}, {0.1, 1}, {1.1, 6}}), {2}, 0.1, 2 / 1.1, 10}}) {
    const VectorXd u = cosine(h, corner, 0), up = cosine(h, corner + 1e-6, 0),
                   down = cosine(h, corner - 1e-6, 0);
    const Result at = result_of(*law, h, u, fields);
    CAPTURE(corner, left, right);
    CHECK(std::abs((result_of(*law, h, up, fields).F[0] - at.F[0]) / 1e-6 - right) < 1e-8);
    CHECK(std::abs((at.F[0] - result_of(*law, h, down, fields).F[0]) / 1e-6 - left) < 1e-8);
    CHECK((at.J - left * MatrixXd::Identity(h.size(), h.size())).norm() < 1e-13);
    CHECK((result_of(*law, h, up, fields).J - right * MatrixXd::Identity(h.size(), h.size())).norm() < 1e-13);
  }
}

TEST_CASE("through zero a gap becomes a preload: the derivatives by it are one-sided there") {
  const Harmonics h{5, false};
  for (const bool two_sided : {false, true})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const VectorXd u = random_motion(h, seed);
      const auto law = gap(two_sided);
      const double d = 1e-7;
      const Result at = result_of(*law, h, u, {3, 0}), up = result_of(*law, h, u, {3, d}),
                   down = result_of(*law, h, u, {3, -d});
      CAPTURE(two_sided, seed);
      CHECK(((up.F - at.F) / d - at.by_field[1]).norm() < 1e-5);
      CHECK(((at.F - down.F) / d - down.by_field[1]).norm() < 1e-5);
      const VectorXd other = VectorXd::Unit(h.size(), 0) * (two_sided ? 0 : 3);  // the preload
      CHECK((down.by_field[1] - up.by_field[1] - other).norm() < 1e-5);
      const auto piece = [&](double g) {
        const auto element = law->element(h, {});
        element->move_to(u, std::vector{3.0, g}, false);
        return element->piece();
      };
      CHECK(piece(0) == piece(d));
      CHECK(piece(0) != piece(-d));
      // Without a gap, one on each side is a spring.
      if (two_sided) CHECK((at.F - 3 * u).norm() < 1e-14);
    }
}

TEST_CASE("grazing changes the force as the penetration to the power 3/2") {
  const Harmonics h{5, false};
  const std::vector<double> fields = {3, 1};
  const auto law = gap(false);
  for (const double d : {1e-4, 1e-6, 1e-8}) {
    // k (1/pi) integral of (d - theta^2/2) over |theta| < sqrt(2 d), for small d
    const double expected = 3 / pi * (4.0 / 3) * d * std::sqrt(2 * d);
    const Result at = result_of(*law, h, cosine(h, 0, 1 + d), fields);
    CAPTURE(d);
    for (int n = 1; n <= 5; ++n) CHECK(std::abs(at.F[n] / expected - 1) < 20 * d);
    CHECK(std::abs(at.F[0] / (expected / 2) - 1) < 20 * d);
    CHECK(result_of(*law, h, cosine(h, 0, 1 - d), fields).F.norm() == 0);
  }
  const Result touching = result_of(*law, h, cosine(h, 0, 1), fields);
  CHECK(touching.F.norm() == 0);
  CHECK(touching.J.norm() == 0);
}

TEST_CASE("extreme numbers give finite coefficients") {
  const Harmonics h{4, false};
  for (const double size : {0.0, 5e-324, 1e-300, 1e-150, 1.0, 1e100})
    for (const double corner : {0.0, 5e-324, 1e-200, 1.0, 1e100})
      for (const double k : {1e-300, 1.0, 1e150})
        for (const auto& [law, fields] : {std::pair{gap(false), std::vector{k, corner}},
                                          {gap(false), {k, -corner}},
                                          {gap(true), {k, corner}},
                                          {gap(true), {k, -corner}},
                                          {bilinear(false), {k, -k, corner}},
                                          {bilinear(true), {-k, 1, corner}},
                                          {table({{-1, -1}, {1e-300, 0}, {2, 1e30}}), {k}}}) {
          CAPTURE(size, corner, k);
          const Result at = result_of(*law, h, size * random_motion(h, 4), fields);
          CHECK(at.F.allFinite());
          CHECK(at.J.allFinite());
          for (const VectorXd& d : at.by_field) CHECK(d.allFinite());
          const elements::Traits traits = law->traits(fields, 0);
          CHECK(std::isfinite(traits.stiffness));
          CHECK(law->stiffness(fields, 0, size) <= traits.stiffness);
        }
}

TEST_CASE("the traits of piecewise linear springs are those of their lines") {
  const auto of = [](const piecewise_linear_laws::LawPointer& law, const std::vector<double>& fields) {
    return law->traits(fields, 0);
  };
  CHECK(of(gap(false), {3, 0.2}).stiffness == 3);
  CHECK(of(gap(false), {3, 0.2}).stiffness_field == 0);
  CHECK(of(gap(false), {3, 0.2}).several_responses);
  CHECK_FALSE(of(gap(false), {3, 0.2}).holds_mean);
  CHECK(of(gap(false), {3, -0.2}).holds_mean);
  CHECK(of(gap(true), {3, 0.2}).holds_mean);
  CHECK(of(gap(true), {3, -0.2}).stiffness == 6);
  CHECK_FALSE(of(gap(true), {3, 0}).several_responses);  // a spring
  CHECK(of(gap(true), {3, 0}).stiffness == 3);
  CHECK(of(gap(true), {3, 0.2}).far_power == 1);
  CHECK(of(bilinear(false), {2, -5, 1}).stiffness == 5);
  CHECK(of(bilinear(false), {2, 7, 1}).stiffness_field == 1);
  CHECK(of(bilinear(false), {9, 7, 0}).stiffness == 7);  // nothing lies within
  CHECK(of(bilinear(false), {2, 0, 1}).far_power == 0);
  CHECK(of(bilinear(false), {2, 0, 1}).holds_mean);
  CHECK_FALSE(of(bilinear(false), {2, 2, 1}).several_responses);
  CHECK_FALSE(of(bilinear(true), {0, 2, 0}).holds_mean);
  CHECK(of(bilinear(true), {1, 2, 0}).holds_mean);
  CHECK(of(table({{0, 0}, {1, 1}, {2, 1}}), {2}).stiffness == 2);
  CHECK(of(table({{0, 0}, {1, 1}, {2, 1}}), {2}).stiffness_field == -1);
  CHECK(gap(false)->stiffness(std::vector{3.0, 0.2}, 0, 0.1) == 0);
  CHECK(gap(false)->stiffness(std::vector{3.0, 0.2}, 0, 0.3) == 3);
  CHECK(bilinear(false)->stiffness(std::vector{3.0, 7.0, 0.2}, 0, 0.1) == 3);
  CHECK(bilinear(false)->stiffness(std::vector{3.0, 7.0, 0.2}, 0, 0.3) == 7);
  CHECK(gap(true)->antisymmetric());
  CHECK_FALSE(gap(false)->antisymmetric());
  CHECK(bilinear(false)->antisymmetric());
  CHECK_FALSE(bilinear(true)->antisymmetric());
}

TEST_CASE("the equations of corners have the derivatives of their differences") {
  const Harmonics h{4, false};
  const VectorXd w = random_motion(h, 5);
  for (const auto& [law, fields] : {std::pair{gap(false), std::vector{3.0, 0.4}},
                                    {gap(false), {3, -0.4}},
                                    {gap(true), {3, 0.4}},
                                    {gap(true), {3, -0.4}},
                                    {bilinear(false), {3, 1, 0.4}},
                                    {bilinear(true), {-3, 1, 0.4}},
                                    {table({{-1, -1}, {0, 0}, {2, 7}, {3, 0}}), {1.5}}}) {
    const auto corners = law->corners(h);
    const auto count = static_cast<Eigen::Index>(fields.size());
    const int guards = law == nullptr ? 0 : (law->antisymmetric() || count == 1 ? 4 : 2);
    for (int guard = 0; guard < guards; ++guard) {
      const auto values = [&](const VectorXd& all) {  // w, the angle, the fields
        elements::Corners::Equations at(h.size(), 1, count);
        const std::vector<double> f(all.data() + h.size() + 1, all.data() + all.size());
        corners->equations({guard, {all[h.size()]}}, all.head(h.size()), f, at);
        return VectorXd(at.values);
      };
      VectorXd all(h.size() + 1 + count);
      all << w, 0.7, Eigen::Map<const VectorXd>(fields.data(), count);
      elements::Corners::Equations at(h.size(), 1, count);
      corners->equations({guard, {0.7}}, w, fields, at);
      MatrixXd expected(2, all.size());
      expected << at.by_motion, at.by_angle, at.by_field;
      CAPTURE(guard);
      CHECK((every_law::differences(values, all, 1e-6) - expected).cwiseAbs().maxCoeff() < 1e-8);
    }
  }
}

TEST_CASE(
    "a reversal that touches a corner is found, with its side, and once where the motion mirrors itself") {
  const std::vector<double> fields = {3, 0.5};
  for (const bool odd : {false, true}) {
    const Harmonics h{4, odd};
    const VectorXd w = cosine(h, 0, 0.5 * (1 + 1e-9));
    CHECK(gap(true)->corners(h)->near(w, fields, 1e-6).size() == 1);
    CHECK(gap(true)->corners(h)->near(w, fields, 1e-12).empty());
  }
  const Harmonics h{4, false};
  const auto above = gap(true)->corners(h)->near(cosine(h, 0.1, 0.4), fields, 1e-9);
  REQUIRE(above.size() == 1);
  CHECK(above[0].guard == 3);  // a maximum at the upper stop
  const auto below = gap(true)->corners(h)->near(cosine(h, -0.1, 0.4), fields, 1e-9);
  REQUIRE(below.size() == 1);
  CHECK(below[0].guard == 0);  // a minimum at the lower one
  CHECK(bilinear(false)->corners(h)->near(cosine(h, 0.1, 0.4), std::vector{3.0, 3.0, 0.5}, 1e-9).empty());
}

TEST_CASE("the work of a piecewise linear spring on its way is the energy stored") {
  for (const auto& [law, fields] : {std::pair{gap(false), std::vector{3.0, 0.2}},
                                    {gap(false), {3, -0.2}},
                                    {gap(true), {3, 0.2}},
                                    {gap(true), {3, -0.2}},
                                    {bilinear(false), {3, -1, 0.4}},
                                    {bilinear(true), {3, 8, 0.4}},
                                    {table({{-0.7, -1}, {-0.2, 0.3}, {0.4, 0.4}, {1.3, -2}}), {1.5}}})
    for (const double q : {-1.5, -0.3, 0.1, 0.9}) {
      const auto stored = [&](double at) {
        return law->in_time(fields)->stored(VectorXd::Constant(1, at), VectorXd());
      };
      elements::StepEnd at(1, 0);
      VectorXd none;
      law->in_time(fields)->begin(VectorXd::Constant(1, q), none, at);
      CHECK(stored(0) == 0);
      CHECK(std::abs((stored(q + 1e-5) - stored(q - 1e-5)) / 2e-5 - at.f[0]) < 1e-9);
    }
}
