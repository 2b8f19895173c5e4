#include "catch.hpp"

#include "lib/laws/contact/contacts.hpp"
#include "lib/laws/every_grazing.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <set>

using namespace arcslip;
using contacts::evaluate;
using continuation::Vector;
using Eigen::MatrixXd;

namespace {

const std::vector<double> fields = {2, 1.5, 0.6, 0.7};

// Along a random way two motions of different phases have corners between them.
std::optional<contacts::Change> random_change(const elements::Harmonics& h, double size, unsigned seed) {
  const Vector from = contacts::random_line(h, size, size, seed);
  return contacts::change_of_piece(elements::contact_2d(), h, from,
                                   from + contacts::random_line(h, 0.1, 0.1, seed + 1000), fields);
}

}  // namespace

TEST_CASE(
    "the corners of a contact have the gradients of their differences, and lie where the piece changes") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_2d().corners(h);
  std::set<int> guards;
  int met = 0;
  for (unsigned seed = 1; seed < 500; ++seed) {
    const auto change = random_change(h, seed % 4 == 0 ? 0.1 : 1, seed);
    if (!change) continue;
    const auto found = corners->near(change->before, fields, 1e-9);
    if (found.empty()) continue;  // of a phase of zero length after closing: no corner
    ++met;
    for (const auto& corner : found) {
      CAPTURE(seed, corner.guard);
      guards.insert(corner.guard);
      const auto at = every_corner::equations(*corners, corner, change->before, fields);
      CHECK(at.values.cwiseAbs().maxCoeff() < 1e-8);
      every_corner::check_equations(*corners, corner, change->before, fields, 1e-7);
      every_corner::check_polish(*corners, corner, change->before, fields);
    }
  }
  CHECK(met > 60);
  CHECK(guards.size() == 8);
}

TEST_CASE("at a birth of slip the Jacobian of a contact jumps along the corner's gradient, by rank one") {
  const elements::Harmonics h{3, false};
  const auto corners = elements::contact_2d().corners(h);
  int jumps = 0;
  for (unsigned seed = 1; seed < 200; ++seed) {
    const auto change = random_change(h, 1, seed);
    if (!change) continue;
    const auto found = corners->near(change->before, fields, 1e-9);
    if (found.size() != 1 || found[0].guard < 2) continue;
    const MatrixXd jump = evaluate(elements::contact_2d(), h, change->after, fields).J -
                          evaluate(elements::contact_2d(), h, change->before, fields).J;
    const Eigen::JacobiSVD<MatrixXd> svd(jump, Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (svd.singularValues()[0] < 1e-3) continue;
    ++jumps;
    const auto at = every_corner::equations(*corners, found[0], change->before, fields);
    const Eigen::RowVectorXd dh = at.by_motion.row(0) - at.by_angle.row(0) *
                                                            at.by_angle.bottomRows(2).inverse() *
                                                            at.by_motion.bottomRows(2);
    CAPTURE(seed, found[0].guard);
    CHECK(svd.singularValues()[1] < 1e-4 * svd.singularValues()[0]);
    CHECK(std::abs(svd.matrixV().col(0).dot(dh.transpose())) > (1 - 1e-6) * dh.norm());
  }
  CHECK(jumps > 10);
}
