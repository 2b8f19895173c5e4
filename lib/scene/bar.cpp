#include <arcslip/scene/bar.hpp>

#include <cmath>

namespace arcslip::scene {
namespace {

struct ElementMatrices {
  std::vector<std::vector<double>> M, K;
};

// K. J. Bathe, Finite Element Procedures, 2nd ed. (2014), sections 4.2 and 5.4.
ElementMatrices of_beam(double EI, double mass, double l) {
  const double k = EI / (l * l * l), m = mass * l / 420;
  return {{{156 * m, 22 * l * m, 54 * m, -13 * l * m},
           {22 * l * m, 4 * l * l * m, 13 * l * m, -3 * l * l * m},
           {54 * m, 13 * l * m, 156 * m, -22 * l * m},
           {-13 * l * m, -3 * l * l * m, -22 * l * m, 4 * l * l * m}},
          {{12 * k, 6 * l * k, -12 * k, 6 * l * k},
           {6 * l * k, 4 * l * l * k, -6 * l * k, 2 * l * l * k},
           {-12 * k, -6 * l * k, 12 * k, -6 * l * k},
           {6 * l * k, 2 * l * l * k, -6 * l * k, 4 * l * l * k}}};
}

ElementMatrices of_rod(double EA, double mass, double l) {
  const double k = EA / l, m = mass * l / 6;
  return {{{2 * m, m}, {m, 2 * m}}, {{k, -k}, {-k, k}}};
}

}  // namespace

BarMatrices matrices(const Bar& bar) {
  const int per_node = bar.bends ? 2 : 1, nodes = bar.elements + 1;
  const double l = bar.length / bar.elements, mass = bar.density * bar.area;
  const ElementMatrices element =
      bar.bends ? of_beam(bar.young * bar.inertia, mass, l) : of_rod(bar.young * bar.area, mass, l);
  std::vector<int> row(static_cast<std::size_t>(per_node * nodes), 0);
  for (const int end : {0, 1}) {
    const auto first = static_cast<std::size_t>(end == 0 ? 0 : per_node * bar.elements);
    const BarEnd held = bar.ends[static_cast<std::size_t>(end)];
    if (held != BarEnd::free) row[first] = -1;
    if (held == BarEnd::clamped && bar.bends) row[first + 1] = -1;
  }
  int size = 0;
  for (int& each : row)
    if (each == 0) each = size++;

  std::vector<MatrixEntry> M, K;
  for (int e = 0; e < bar.elements; ++e)
    for (std::size_t a = 0; a < element.M.size(); ++a)
      for (std::size_t b = 0; b < element.M.size(); ++b) {
        const auto first = static_cast<std::size_t>(per_node * e);
        const int i = row[first + a], j = row[first + b];
        if (i < 0 || j < 0) continue;
        M.push_back({i, j, element.M[a][b]});
        K.push_back({i, j, element.K[a][b]});
      }
  BarMatrices all{sparse_matrix(size, size, M), sparse_matrix(size, size, K), {}};
  for (const auto& [name, place] : bar.points) {
    const auto node = static_cast<std::size_t>(std::lround(place / l));
    for (std::size_t k = 0; k < static_cast<std::size_t>(per_node); ++k)
      all.rows.push_back(row[static_cast<std::size_t>(per_node) * node + k]);
  }
  return all;
}

}  // namespace arcslip::scene
