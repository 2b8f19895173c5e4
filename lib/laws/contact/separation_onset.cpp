#include <arcslip/laws/contact/separation_onset.hpp>

#include <cmath>

namespace arcslip::elements {

void set_load_corner(const Harmonics& h, const Corner& corner, bool maximum, In u_n,
                     const NormalSpring& spring, Corners::Equations& at) {
  const double theta = corner.angles[0], side = maximum ? 1 : -1;
  const Values n = series_values(h, u_n, theta);
  for (Eigen::MatrixXd* m : {&at.by_motion, &at.by_angle, &at.by_field}) m->setZero();
  at.values << side * (spring.N_0 + spring.k_n * n.x), n.d1;
  at.by_angle << side * spring.k_n * n.d1, n.d2;
  at.by_field(0, spring.stiffness_field) = side * n.x;
  at.by_field(0, spring.preload_field) = side;
  auto by_load = at.by_motion.rightCols(h.size());
  if (!h.odd) by_load(0, 0) = side * spring.k_n;
  for (int j = 0; j < h.sines(); ++j) {
    const int k = h.sine_order(j);
    const double c = std::cos(k * theta), s = std::sin(k * theta);
    by_load(0, h.cosine_index(k)) = side * spring.k_n * c;
    by_load(0, h.sine_index(k)) = side * spring.k_n * s;
    by_load(1, h.cosine_index(k)) = -k * s;
    by_load(1, h.sine_index(k)) = k * c;
  }
}

}  // namespace arcslip::elements
