#include <arcslip/laws/automaton.hpp>

namespace arcslip::elements {

Mode& Mode::follows(double by_q, double z_at_0, int sign) {
  rests = false;
  z_q = Eigen::RowVectorXd::Constant(1, by_q);
  z_0 = z_at_0;
  way = sign;
  return *this;
}

Mode& Mode::leaves_where(double q, double v, double z, double c, int to) {
  leaves.push_back({Eigen::RowVectorXd::Constant(1, q), Eigen::RowVectorXd::Constant(1, v), z, c, to});
  return *this;
}

Mode& Automaton::add(std::string_view name, double f_q, double f_z, double f_0) {
  modes.emplace_back();
  Mode& mode = modes.back();
  mode.name = name;
  mode.f_q = Eigen::MatrixXd::Constant(1, 1, f_q);
  mode.f_z = Eigen::VectorXd::Constant(1, f_z);
  mode.f_0 = Eigen::VectorXd::Constant(1, f_0);
  return mode;
}

}  // namespace arcslip::elements
