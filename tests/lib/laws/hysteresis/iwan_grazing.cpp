#include "catch.hpp"

#include "lib/laws/every_grazing.hpp"
#include "lib/laws/hysteresis/iwan_laws.hpp"

#include <cmath>

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;
using elements::Harmonics;

TEST_CASE(
    "a corner lies where the piece changes, and its equations have the derivatives of their differences") {
  const std::vector<std::pair<std::string, std::vector<double>>> all{
      {iwan_laws::uniform, {2, 0.8}},
      {iwan_laws::four_parameter, {2, 0.8, -0.3, 0.4}},
      {iwan_laws::table({{0.7, 0.2}, {1.1, 0.4}, {0.3, 0.35}}), {1.2, 0.9}}};
  int found = 0;
  for (const auto& [text, fields] : all)
    for (const bool odd : {false, true})
      for (unsigned seed = 1; seed <= 30; ++seed) {
        const auto law = iwan_laws::law(text);
        const Harmonics h{4, odd};
        const auto element = law->element(h, {});
        const auto corners = law->corners(h);
        // Along a line of motions, up to the first change of the piece.
        const VectorXd from = every_law::falling_motion(h, 1, seed),
                       along = every_law::falling_motion(h, 1, seed + 500);
        const auto piece = [&](double s) {
          element->move_to(from + s * along, fields, false);
          return element->piece();
        };
        double low = 0, high = 0;
        while (high < 2 && piece(high) == piece(0)) high += 0.02;
        if (high >= 2) continue;
        for (int k = 0; k < 80; ++k) {
          const double middle = 0.5 * (low + high);
          (piece(middle) == piece(0) ? low : high) = middle;
        }
        const VectorXd w = from + 0.5 * (low + high) * along;
        element->move_to(from + (low - 1e-7) * along, fields, true);
        const MatrixXd before = element->jacobian();
        element->move_to(from + (high + 1e-7) * along, fields, true);
        const double jump = (element->jacobian() - before).norm();
        const auto near = corners->near(w, fields, 1e-9);
        CAPTURE(text, odd, seed, jump, near.size());
        if (jump < 1e-2) continue;  // the birth of a loop
        CHECK(near.size() == 1);
        for (const elements::Corner& corner : near) {
          ++found;
          const auto at = every_corner::equations(*corners, corner, w, fields);
          CHECK(std::abs(at.values[0]) <= 1e-9 * corners->size(corner, w, fields));
          CHECK(at.values.tail(2).norm() < 1e-7);
          every_corner::check_equations(*corners, corner, w, fields, 1e-8);
        }
      }
  CHECK(found > 40);
}
