#pragma once
// Contacts along one direction and in a plane: forces, random motions, changes of the piece, scenes.

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/laws/law.hpp>

#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

namespace contacts {

using namespace arcslip;
using continuation::Vector;

struct Force {
  Vector F;
  Eigen::MatrixXd J, by_field;
  std::uint64_t piece = 0;
  elements::FrictionState friction;
};

inline Force evaluate(const elements::Law& law, const elements::Harmonics& h, const Vector& u,
                      const std::vector<double>& fields) {
  const auto element = law.element(h, {});
  element->move_to(u, fields, true);
  Force at{
      element->force(), element->jacobian(), Eigen::MatrixXd(u.size(), fields.size()), element->piece(), {}};
  for (std::size_t k = 0; k < fields.size(); ++k)
    element->field_derivative(static_cast<int>(k), at.by_field.col(static_cast<Eigen::Index>(k)));
  element->friction(at.friction);
  return at;
}

/// Along one tangential direction and the normal.
inline Vector random_line(const elements::Harmonics& h, double tangential, double normal, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector u(2 * h.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = (i < h.size() ? tangential : normal) * number(bits);
  return u;
}

/// Along two tangential directions and the normal: coefficients that fall with the square of their order.
inline Vector random_plane(const elements::Harmonics& h, double tangential, double normal, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector u(3 * h.size());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < h.size(); ++j) {
      const int n = j < h.cosines() ? j : j - h.order;
      u[i * h.size() + j] = (i < 2 ? tangential : normal) * number(bits) / (1 + n * n);
    }
  return u;
}

/// Two motions that are equal but for rounding, on both sides of a change of the piece.
struct Change {
  Vector before, after;
};

/// The first that bisection finds between two motions, if their pieces differ.
inline std::optional<Change> change_of_piece(const elements::Law& law, const elements::Harmonics& h,
                                             const Vector& from, const Vector& to,
                                             const std::vector<double>& fields) {
  const auto at = [&](double s) -> Vector { return from + s * (to - from); };
  const auto piece = [&](double s) { return evaluate(law, h, at(s), fields).piece; };
  double low = 0, high = 1;
  const auto first = piece(low);
  if (first == piece(high)) return {};
  while (high - low > 1e-13) {
    const double middle = 0.5 * (low + high);
    (piece(middle) == first ? low : high) = middle;
  }
  return Change{at(low), at(high)};
}

/// Two coupled coordinates on a contact, M = 1, C = 2, K = [1e4 1500; 1500 2e4], forces f_t, f_n times
/// cos 95 t and -8 N along the normal direction.
inline scene::Scene line_pad(int order, double f_t, double f_n) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t", "n"],
      "masses": [{"name": "m_t", "at": "t", "value": 1}, {"name": "m_n", "at": "n", "value": 1}],
      "springs": [{"name": "s_t", "at": "t", "value": 8500}, {"name": "s_n", "at": "n", "value": 18500},
                  {"name": "s", "direction": {"t": 1, "n": 1}, "value": 1500}],
      "dampers": [{"name": "d_t", "at": "t", "value": 2}, {"name": "d_n", "at": "n", "value": 2}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "t"}, "normal": {"at": "n"},
      "tangential_stiffness": 6e3, "normal_stiffness": 9e3, "friction_coefficient": 0.4, "normal_load": 8}],
    "response": [{"name": "t", "at": "t"}, {"name": "n", "at": "n"}],
    "excitation": [{"name": "f_t", "at": "t", "cosine": )"
       << f_t << R"(}, {"name": "f_n", "at": "n", "cosine": )" << f_n
       << R"(}, {"name": "load", "at": "n", "cosine": -8, "harmonic": 0}], "harmonics": {"order": )" << order
       << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 60, "to": 180}]})";
  return scenes::parse(text.str());
}

/// M = 1 and C = 2 in three coordinates, coupled by springs, under forces at 95 rad/s with a phase between
/// the tangential ones.
inline scene::Scene plane_pad(int order, double f, double normal_load) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "n"],
      "masses": [{"name": "m_a", "at": "a", "value": 1}, {"name": "m_b", "at": "b", "value": 1},
                 {"name": "m_n", "at": "n", "value": 1}],
      "springs": [{"name": "s_a", "at": "a", "value": 8500}, {"name": "s_b", "at": "b", "value": 6500},
                  {"name": "s_n", "at": "n", "value": 18500},
                  {"name": "s", "direction": {"a": 1, "n": 1}, "value": 1500}],
      "dampers": [{"name": "d_a", "at": "a", "value": 2}, {"name": "d_b", "at": "b", "value": 2},
                  {"name": "d_n", "at": "n", "value": 2}]},
    "elements": [{"name": "pad", "type": "contact_3d", "tangential_1": {"at": "a"},
      "tangential_2": {"at": "b"}, "normal": {"at": "n"},
      "tangential_stiffness": 6e3, "normal_stiffness": 9e3, "friction_coefficient": 0.4, "normal_load": )"
       << normal_load << R"(}],
    "response": [{"name": "a", "at": "a"}, {"name": "b", "at": "b"}],
    "excitation": [{"name": "f_a", "at": "a", "cosine": )"
       << f << R"(}, {"name": "f_b", "at": "b", "cosine": )" << 0.3 * f << R"(, "sine": )" << 0.7 * f
       << R"(}, {"name": "f_n", "at": "n", "cosine": )" << 0.6 * f << R"(}],
    "harmonics": {"order": )"
       << order << R"(}, "studies": [{"name": "frf", "kind": "frf", "from": 60, "to": 180}]})";
  return scenes::parse(text.str());
}

}  // namespace contacts
