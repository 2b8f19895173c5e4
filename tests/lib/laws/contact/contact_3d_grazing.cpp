#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_grazing.hpp"

#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/contact/stick_feasibility.hpp>

#include <Eigen/SVD>

#include <cmath>
#include <map>

using namespace arcslip;
using contacts::evaluate;
using continuation::Vector;
using Eigen::MatrixXd;

namespace {

const std::vector<double> fields = {2, 1.5, 0.6, 0.7};

struct AtChange {
  unsigned seed;
  Vector motion;
  std::vector<elements::Corner> corners;
};

// Random ways on which the piece changes, with the corners there.
std::vector<AtChange> random_changes(const elements::Harmonics& h, elements::Corners& corners) {
  std::vector<AtChange> all;
  for (unsigned seed = 1; seed < 400; ++seed) {
    const double size = seed % 3 == 0 ? 0.45 : 1;
    const Vector from = contacts::random_plane(h, size, size, seed),
                 way = contacts::random_plane(h, 0.1 * size, 0.1 * size, seed + 1000);
    const auto change = contacts::change_of_piece(elements::contact_3d(), h, from, from + way, fields);
    if (change) all.push_back({seed, change->before, corners.near(change->before, fields, 1e-9)});
  }
  return all;
}

}  // namespace

TEST_CASE(
    "corners of a contact in a plane have the gradients of differences, and lie where the piece changes") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_3d().corners(h);
  std::map<int, int> guards;
  for (const auto& change : random_changes(h, *corners))
    for (const auto& corner : change.corners) {
      CAPTURE(change.seed, corner.guard);
      ++guards[corner.guard];
      const auto at = every_corner::equations(*corners, corner, change.motion, fields);
      CHECK(at.values.cwiseAbs().maxCoeff() < 1e-8);
      // On both sides: the rest of a slider that slips in each period depends on the slip that is born.
      const Vector dh = at.by_motion.row(0).transpose();
      for (const double side : {-1, 1})
        every_corner::check_equations(*corners, corner, change.motion + side * 2e-4 * dh.normalized(), fields,
                                      1e-7);
      every_corner::check_polish(*corners, corner, change.motion, fields);
    }
  for (int guard = 0; guard < 5; ++guard) CHECK(guards[guard] > 3);
}

TEST_CASE("at a birth of slip in a plane the Jacobian jumps along the corner's gradient, by rank one") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_3d().corners(h);
  std::map<int, int> jumps;
  for (const auto& change : random_changes(h, *corners)) {
    if (change.corners.size() != 1 || change.corners[0].guard < 2) continue;
    const auto at = every_corner::equations(*corners, change.corners[0], change.motion, fields);
    const Vector dh = at.by_motion.row(0).transpose();
    const auto jacobian = [&](double side) {
      return evaluate(elements::contact_3d(), h, change.motion + side * dh / dh.squaredNorm(), fields).J;
    };
    // Next to the corner the Jacobian changes with the root of h, which two distances take away.
    const auto limit = [&](double side) -> MatrixXd {
      return 2 * jacobian(side * 1e-10) - jacobian(side * 4e-10);
    };
    const MatrixXd jump = limit(1) - limit(-1);
    const Eigen::JacobiSVD<MatrixXd> svd(jump, Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (svd.singularValues()[0] < 1e-2) continue;
    ++jumps[change.corners[0].guard];
    CAPTURE(change.seed, change.corners[0].guard, svd.singularValues()[0], svd.singularValues()[1]);
    CHECK(svd.singularValues()[1] < 1e-3 * svd.singularValues()[0]);
    CHECK(std::abs(svd.matrixV().col(0).dot(dh)) > (1 - 1e-6) * dh.norm());
  }
  for (int guard = 2; guard < 5; ++guard) CHECK(jumps[guard] > 1);
}

TEST_CASE("up to full stick the mean of friction in a plane does not feel motions that keep the symmetry") {
  // Odd harmonics alone: T has none of the even ones, for any change of the odd ones. What is left is the
  // error of the Jacobian.
  const elements::Harmonics h{5, false};
  const Eigen::Index c = h.size();
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Vector u = contacts::random_plane(h, 1, 0, seed);
    for (int i = 0; i < 2; ++i)
      for (const int n : {2, 4}) u[i * c + h.cosine_index(n)] = u[i * c + h.sine_index(n)] = 0;
    u.tail(c).setZero();
    elements::StickCentre centre(h);
    elements::Disc disc(h);
    disc.set(u.head(c), u.segment(c, c), u.tail(c));
    centre.find(disc);
    const double radius = centre.r();
    for (double slip = 1e-3; slip > 1e-12; slip *= 0.1) {
      const double k_t = 2, mu = 0.5;
      const auto at = evaluate(elements::contact_3d(), h, u, {k_t, 0, mu, radius * (1 - slip) * k_t / mu});
      CAPTURE(seed, slip);
      CHECK(at.friction.stick_share < 1);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          for (const int n : {1, 3, 5})
            CHECK(std::hypot(at.J(i * c, j * c + h.cosine_index(n)), at.J(i * c, j * c + h.sine_index(n))) <
                  2e-4 * k_t);
    }
  }
}
