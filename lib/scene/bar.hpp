#pragma once
// Prismatic bars in finite elements of equal length, as structures of scenes: Euler-Bernoulli beams in
// bending and rods in tension.
//
//   beam   E I w'''' + rho A w_tt = 0   cubic elements; deflection w and slope w' of each node
//   rod    E A u''   = rho A u_tt       linear elements; displacement u of each node
//
// with consistent mass matrices. The natural frequencies of a beam converge as elements^-4; rounding errors
// grow as elements^4 2e-16.

#include <arcslip/scene/sparse_matrix.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// clamped: w = w' = 0, u = 0; pinned: w = 0.
enum class BarEnd { clamped, pinned, free };

struct Bar {
  bool bends = true;  // a beam; else a rod
  int elements = 1;
  double length = 0, young = 0, density = 0;  // m, Pa, kg/m^3
  double area = 0, inertia = 0;               // of the section: m^2, m^4; rods need no inertia
  std::array<BarEnd, 2> ends{BarEnd::clamped, BarEnd::free};
  std::vector<std::pair<std::string, double>> points{};  // names of nodes and their places, m
  friend bool operator==(const Bar&, const Bar&) = default;
};

/// Its matrices, and the rows of its points in their order; those of a beam have two each, w and w', but
/// where an end holds them: -1.
struct BarMatrices {
  SparseMatrix mass, stiffness;
  std::vector<int> rows;
};
BarMatrices matrices(const Bar& bar);

}  // namespace arcslip::scene
