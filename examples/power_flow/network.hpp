#pragma once
// The buses and branches of an electric network, from the lines "bus,...", "generator,..." and "branch,..."
// of a CSV file, in MW, Mvar and per unit of 100 MVA; other lines are comments.

#include <Eigen/SparseCore>

#include <algorithm>
#include <complex>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Complex = std::complex<double>;

struct Bus {
  int number = 0;
  double P = 0, Q = 0;  // the load, per unit, of P less the generation
  bool generates = false;
  double voltage = 1;  // that the generator holds
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
};

struct Network {
  std::vector<Bus> buses;
  Eigen::SparseMatrix<Complex> Y;  // admittances
  int reference = 0;

  int size() const { return static_cast<int>(buses.size()); }
};

// A line, or a transformer with its ratio at the side of i.
inline void add_branch(std::istream& in, int i, int j, std::vector<Eigen::Triplet<Complex>>& Y) {
  double r = 0, x = 0, b = 0, ratio = 0;
  in >> r >> x >> b >> ratio;
  if (ratio == 0) ratio = 1;
  const Complex y = 1.0 / Complex(r, x), end = y + Complex(0, b / 2);
  Y.emplace_back(i, i, end / (ratio * ratio));
  Y.emplace_back(j, j, end);
  Y.emplace_back(i, j, -y / ratio);
  Y.emplace_back(j, i, -y / ratio);
}

// limits: of the reactive powers of generators; false: they have none.
inline Network read_network(const std::string& path, bool limits) {
  constexpr double MVA = 100;
  Network network;
  std::map<int, int> place;
  std::vector<Eigen::Triplet<Complex>> Y;
  std::ifstream file(path);
  for (std::string line, kind; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    int number = 0;
    if (!(in >> kind >> number)) continue;
    if (kind == "bus") {
      int type = 0;
      double P = 0, Q = 0, shunt_g = 0, shunt_b = 0;
      in >> type >> P >> Q >> shunt_g >> shunt_b;
      const int i = place[number] = network.size();
      if (type == 3) network.reference = i;
      network.buses.push_back({.number = number, .P = P / MVA, .Q = Q / MVA});
      Y.emplace_back(i, i, Complex(shunt_g, shunt_b) / MVA);
    } else if (kind == "generator") {
      Bus& bus = network.buses[place.at(number)];
      double P = 0, lowest = 0, highest = 0;
      in >> P >> lowest >> highest >> bus.voltage;
      bus.P -= P / MVA;
      bus.generates = true;
      if (limits) bus.lowest = lowest / MVA, bus.highest = highest / MVA;
    } else if (kind == "branch") {
      int to = 0;
      in >> to;
      add_branch(in, place.at(number), place.at(to), Y);
    }
  }
  if (network.buses.empty()) throw std::runtime_error(path + " has no buses");
  network.Y.resize(network.size(), network.size());
  network.Y.setFromTriplets(Y.begin(), Y.end());
  return network;
}
