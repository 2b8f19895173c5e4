#pragma once
// Rotors from matrices in files.

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <Eigen/Core>

#include <complex>
#include <iomanip>
#include <sstream>
#include <string>

namespace rotors {

using namespace arcslip;
using Complex = std::complex<double>;

inline std::string matrix_market(const Eigen::MatrixXd& A) {
  std::ostringstream text;
  text << std::setprecision(17) << "%%MatrixMarket matrix array real general\n"
       << A.rows() << ' ' << A.cols() << '\n';
  for (const double value : A.reshaped()) text << value << '\n';
  return text.str();
}

// The matrix of a complex factor of x + i y, a block for each factor: c z is (c_r x - c_i y, c_i x + c_r y).
inline Eigen::MatrixXd planes(const Eigen::MatrixXcd& factors) {
  Eigen::MatrixXd A(2 * factors.rows(), 2 * factors.cols());
  for (Eigen::Index j = 0; j < factors.cols(); ++j)
    for (Eigen::Index i = 0; i < factors.rows(); ++i) {
      const Complex c = factors(i, j);
      A.block(2 * i, 2 * j, 2, 2) << c.real(), -c.imag(), c.imag(), c.real();
    }
  return A;
}

// Without parts beyond the matrices. keys: of "matrices"; more: next to them.
inline std::string scene_of(const std::string& keys, const std::string& more, const std::string& force,
                            const std::string& elements = "", int order = 1) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"matrices":
      {"mass": "M.mtx", "stiffness": "K.mtx")" +
         keys + R"(}, "names": "names.csv")" + more + R"(}, "elements": [)" + elements +
         R"(], "excitation": [)" + force + R"(], "response": {"at": "x"}, "harmonics": {"order": )" +
         std::to_string(order) + R"(}, "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

inline scene::Scene read(const std::string& whole, const Folder& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder.path());
}

inline std::string fault(const std::string& whole, const Folder& folder) {
  try {
    read(whole, folder);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

inline const std::string along_x = R"({"name": "f", "at": "x", "cosine": 1.5})";
// Turns with x + i y, or against it.
inline const std::string forward = along_x + R"(, {"name": "g", "at": "y", "sine": 1.5})";
inline const std::string backward = along_x + R"(, {"name": "g", "at": "y", "sine": -1.5})";

}  // namespace rotors
