// Writes the matrices of a steel cantilever of 8-node bricks, as a finite-element program exports them:
//
//   arcslip_cantilever_mesh FOLDER NX NY NZ [LENGTH WIDTH HEIGHT]
//
// makes M.mtx, K.mtx and names.csv in FOLDER: the deflections (z) of the middle of the top at half length and
// at the end, "mid" and "tip", and those of the other nodes across the width, "mid_1", "tip_1" and so on.
// Bricks with incompatible modes (Wilson et al. 1973), which do not lock in bending; consistent mass.

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

constexpr double young = 2.1e11, poisson = 0.3, density = 7850;

using Square = Eigen::Matrix<double, 24, 24>;

// Of one brick a x b x c, its nodes counted x first, then y, then z.
void brick(double a, double b, double c, Square& K, Square& M) {
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)),
               mu = young / (2 * (1 + poisson));
  D.topLeftCorner<3, 3>().setConstant(lambda);
  D.diagonal().head<3>().array() += 2 * mu;
  D.diagonal().tail<3>().setConstant(mu);
  Eigen::Matrix<double, 33, 33> all = Eigen::Matrix<double, 33, 33>::Zero();
  M.setZero();
  const double gauss[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  const Eigen::Array3d half(a / 2, b / 2, c / 2);
  const double volume = half.prod();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Array3d x(gauss[i], gauss[j], gauss[k]);
        const double w = weight[i] * weight[j] * weight[k] * volume;
        Eigen::Matrix<double, 6, 33> B = Eigen::Matrix<double, 6, 33>::Zero();
        Eigen::Matrix<double, 3, 24> N = Eigen::Matrix<double, 3, 24>::Zero();
        const auto add = [&](int column, const Eigen::Vector3d& g) {  // the strains of a shape function
          for (int d = 0; d < 3; ++d) {
            const int e = (d + 1) % 3;
            B(d, column + d) = g[d];
            B(3 + d, column + d) += g[e];  // shear between d and e
            B(3 + d, column + e) += g[d];
          }
        };
        for (int node = 0; node < 8; ++node) {
          const Eigen::Array3d corner(node & 1 ? 1 : -1, node & 2 ? 1 : -1, node & 4 ? 1 : -1);
          const Eigen::Array3d f = 0.5 * (1 + corner * x), df = 0.5 * corner / half;
          add(3 * node, {df[0] * f[1] * f[2], f[0] * df[1] * f[2], f[0] * f[1] * df[2]});
          for (int d = 0; d < 3; ++d) N(d, 3 * node + d) = f.prod();
        }
        for (int mode = 0; mode < 3; ++mode) {  // 1 - x^2
          Eigen::Vector3d g = Eigen::Vector3d::Zero();
          g[mode] = -2 * x[mode] / half[mode];
          add(24 + 3 * mode, g);
        }
        all += w * B.transpose() * D * B;
        M += w * density * N.transpose() * N;
      }
  K = all.topLeftCorner<24, 24>() -
      all.topRightCorner<24, 9>() * all.bottomRightCorner<9, 9>().ldlt().solve(all.bottomLeftCorner<9, 24>());
}

// A mesh of bricks, held at x = 0.
class Cantilever {
 public:
  Cantilever(int nx, int ny, int nz, double length, double width, double height) : nx_(nx), ny_(ny), nz_(nz) {
    Square Ke, Me;
    brick(length / nx, width / ny, height / nz, Ke, Me);
    for (int x = 0; x < nx; ++x)
      for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y) add(rows_of_brick(x, y, z), Ke, Me);
  }

  bool write_matrix(const std::string& path, bool mass) const {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) return false;
    const int size = 3 * nx_ * (ny_ + 1) * (nz_ + 1);
    std::fprintf(file, "%%%%MatrixMarket matrix coordinate real symmetric\n%d %d %zu\n", size, size,
                 lower_.size());
    for (const auto& [place, values] : lower_)
      std::fprintf(file, "%d %d %.12g\n", place.second + 1, place.first + 1,
                   mass ? values.second : values.first);
    return std::fclose(file) == 0;
  }

  bool write_names(const std::string& path) const {
    std::ofstream names(path);
    names << "name,row\n";
    for (const auto& [name, x] : {std::pair{"mid", nx_ / 2}, std::pair{"tip", nx_}}) {
      names << name << ',' << row(x, ny_ / 2, nz_, 2) + 1 << '\n';
      int count = 0;
      for (int y = 0; y <= ny_ && ny_ >= 2; ++y)
        if (y != ny_ / 2) names << name << '_' << ++count << ',' << row(x, y, nz_, 2) + 1 << '\n';
    }
    return static_cast<bool>(names);
  }

 private:
  // In the order x slowest, so that the band is small; -1 where it is held.
  int row(int x, int y, int z, int d) const {
    return x == 0 ? -1 : 3 * (((x - 1) * (nz_ + 1) + z) * (ny_ + 1) + y) + d;
  }
  std::array<int, 24> rows_of_brick(int x, int y, int z) const {
    std::array<int, 24> rows{};
    for (int node = 0; node < 8; ++node)
      for (int d = 0; d < 3; ++d)
        rows[static_cast<std::size_t>(3 * node + d)] =
            row(x + (node & 1), y + (node >> 1 & 1), z + (node >> 2), d);
    return rows;
  }
  void add(const std::array<int, 24>& rows, const Square& Ke, const Square& Me) {
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < 24; ++j) {
        const int at_i = rows[static_cast<std::size_t>(i)], at_j = rows[static_cast<std::size_t>(j)];
        if (at_i < at_j || at_j < 0) continue;
        auto& [k, m] = lower_[{at_j, at_i}];
        k += Ke(i, j);
        m += Me(i, j);
      }
  }

  int nx_, ny_, nz_;
  std::map<std::pair<int, int>, std::pair<double, double>> lower_;  // K and M, by column
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 8) {
    std::fprintf(stderr, "usage: arcslip_cantilever_mesh FOLDER NX NY NZ [LENGTH WIDTH HEIGHT]\n");
    return 2;
  }
  const std::string folder = argv[1];
  const auto size = [&](int i, double usual) { return argc == 8 ? std::atof(argv[i]) : usual; };
  const Cantilever mesh(std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]), size(5, 1), size(6, 0.04),
                        size(7, 0.02));
  const bool written = mesh.write_matrix(folder + "/M.mtx", true) &&
                       mesh.write_matrix(folder + "/K.mtx", false) && mesh.write_names(folder + "/names.csv");
  return written ? 0 : 1;
}
