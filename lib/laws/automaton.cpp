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

Slider slider_of(const Automaton& automaton) {
  const Eigen::Index d = automaton.modes.front().f_q.cols();
  Slider slider{
      automaton.memory, automaton.direction, Eigen::RowVectorXd::Unit(d, automaton.direction), {}, 0, {}};
  slider.upper = slider.lower;
  double lower = 0, upper = 0;
  for (const Mode& mode : automaton.modes) {
    if (mode.rests || mode.open) continue;
    if (mode.way >= 0) {
      slider.lower = mode.z_q;
      lower = mode.z_0;
    }
    if (mode.way <= 0) {
      slider.upper = mode.z_q;
      upper = mode.z_0;
    }
  }
  if (lower != -upper) slider.centre = 0.5 * (lower + upper);
  if (automaton.offset != Offset::centred) slider.room = 0.5 * (upper - lower);
  return slider;
}

}  // namespace arcslip::elements
