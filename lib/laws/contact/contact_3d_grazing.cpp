// Corners of a contact with friction in a plane: guards 0 and 1 of its load, 2 and 3 at the end of full
// stick, 4 where slip is born in a rest that follows slip or a closing.
//
// With the disc of centre x and radius R = mu N/k_t the guards of the slider w are, over k_t,
//
//   full stick  r = |x_i - w| - R_i at the two opposite angles, or the three, that decide it
//   (stick_feasibility.hpp):
//               dr = sum_i lambda_i (n_i.dx_i - dR_i),   sum_i lambda_i n_i = 0,   sum_i lambda_i = 1
//   a rest      |x - w| - R at its largest value, with dw from the history (slider_deflection.hpp)
//
// Each angle has the equation n.x' = R'.
#include <arcslip/laws/contact/contact_3d.hpp>

#include <arcslip/laws/contact/normal_contact.hpp>
#include <arcslip/laws/contact/separation_onset.hpp>
#include <arcslip/laws/contact/slider_deflection.hpp>
#include <arcslip/laws/reversal_condition.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {
namespace {

using Eigen::Vector2d;

constexpr double same_corner = 0.3;  // rad: an angle that moves farther is another one
constexpr double just_born = 1e-5;   // rad: the root of rounding
constexpr double short_slip = 0.3;   // rad: slip that may just have been born
constexpr int corner_newton_steps = 30;

enum { stick_of_two = load_guard::count, stick_of_three, birth_in_rest };

class Contact3dCorners final : public Corners {
 public:
  explicit Contact3dCorners(const Harmonics& h)
      : h_(h),
        c_(h.size()),
        normal_(h),
        disc_(h),
        stretch_(h),
        centre_(h),
        w_(3 * c_),
        radius_(c_),
        phi_(c_),
        slope_(c_) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    set(w, fields);
    if (corner.guard <= load_guard::closing)
      return set_load_corner(h_, corner, corner.guard == load_guard::closing, w.tail(c_),
                             {fields_[contact_field::normal_stiffness], fields_[contact_field::normal_load],
                              contact_field::normal_stiffness, contact_field::normal_load},
                             at);
    at.by_angle.setZero();
    rows_.setZero(at.values.size(), 3 * c_);
    if (corner.guard == stick_of_two)
      set_two(corner.angles, at);
    else if (corner.guard == stick_of_three)
      set_three(corner.angles, at);
    else
      set_birth(corner.angles[0], at);
    to_unknowns(at);
  }

  double size(const Corner&, In w, Fields fields) override {
    set(w, fields);
    return size();
  }

  bool polish(Corner& corner, In w, Fields fields) override {
    if (corner.guard <= load_guard::closing)
      return polish_reversal(h_, w.tail(c_), corner.guard == load_guard::closing ? 1 : -1, corner.angles[0]);
    set(w, fields);
    if (!std::isfinite(size())) return false;
    if (corner.guard != birth_in_rest) return polish_stick(corner);
    find_phases();
    const auto rest = rest_before(corner.angles[0]);
    return rest && polish_in_rest(corner.angles[0], list()[*rest].w);
  }

  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    std::vector<Corner> found;
    set(w, fields);
    find_phases();
    const double most = tolerance * size();
    Equations at(0, 0, 0);
    const auto add = [&](int guard, std::vector<double> angles, double limit) {
      const Corner corner{guard, std::move(angles)};
      at = {w.size(), static_cast<int>(corner.angles.size()), static_cast<Eigen::Index>(fields.size())};
      equations(corner, w, fields, at);
      if (std::abs(at.values[0]) <= limit && !is_listed(found, corner)) found.push_back(corner);
    };
    for (const Reversal& turn : normal_.reversals())
      add(series_values(h_, w.tail(c_), turn.theta).d2 < 0 ? load_guard::closing : load_guard::separation,
          {turn.theta}, most);
    if (!(fields_[contact_field::friction_coefficient] > 0) || list().empty()) return found;
    double limit = most;
    if (!normal_.opens()) {
      // Where a rest of the whole period is almost possible all slips are short, and this is their corner.
      centre_.find(disc_);
      const StickCentre& centre = centre_;
      limit = std::min(most, fields_[contact_field::tangential_stiffness] * std::abs(centre.r()));
      if (centre.active().size() == 2) add(stick_of_two, centre.active(), most);
      if (centre.active().size() == 3) add(stick_of_three, centre.active(), most);
    }
    if (stretch_.phases().full_stick()) return found;
    for (std::size_t i = 0; i < list().size(); ++i)
      if (list()[i].state == DiscPhase::State::stick)
        for (const double theta : tops_of_rest(i)) add(birth_in_rest, {theta}, limit);
    return found;
  }

 private:
  void set(In w, Fields fields) {
    std::copy(fields.begin(), fields.end(), fields_);
    w_ = w;
    radius_ = fields_[contact_field::normal_stiffness] * w.tail(c_);
    radius_[0] += fields_[contact_field::normal_load];
    radius_ *= fields_[contact_field::friction_coefficient] / fields_[contact_field::tangential_stiffness];
    disc_.set(w.head(c_), w.segment(c_, c_), radius_);
  }
  double size() const {
    const double normal =
        fields_[contact_field::normal_stiffness] * (std::abs(w_[2 * c_]) + series_bound(h_, w_.tail(c_), 0));
    return std::max(std::abs(fields_[contact_field::normal_load]) + normal,
                    fields_[contact_field::tangential_stiffness] * disc_.motion_bound(0));
  }
  void find_phases() {
    normal_.move_to(w_.tail(c_), fields_[contact_field::normal_stiffness],
                    fields_[contact_field::normal_load]);
    if (fields_[contact_field::friction_coefficient] > 0 && std::isfinite(disc_.motion_bound(3)))
      stretch_.move_to(disc_, normal_.closed(), normal_.opens());
  }
  const std::vector<DiscPhase>& list() const { return stretch_.phases().list(); }

  // by_x.dx + by_R dR at an angle, or of their derivatives by it, to a row.
  void add(Eigen::Index row, double theta, bool slope, const Vector2d& by_x, double by_R) {
    series_basis(h_, theta, phi_);
    if (slope) {
      slope_[0] = 0;
      for (int n = 1; n <= h_.order; ++n) {
        slope_[h_.cosine_index(n)] = -n * phi_[h_.sine_index(n)];
        slope_[h_.sine_index(n)] = n * phi_[h_.cosine_index(n)];
      }
      phi_ = slope_;
    }
    for (int i = 0; i < 2; ++i) rows_.row(row).segment(i * c_, c_) += by_x[i] * phi_.transpose();
    rows_.row(row).tail(c_) += by_R * phi_.transpose();
  }

  void set_two(const std::vector<double>& angles, Equations& at) {
    const DiscPoint p[] = {disc_.at(angles[0]), disc_.at(angles[1])};
    const Vector2d apart = p[0].x - p[1].x;
    const double d = apart.norm();
    const Vector2d n = apart / d, t = quarter_turn(n);
    at.values[0] = 0.5 * (d - p[0].h - p[1].h);
    for (int i = 0; i < 2; ++i) {
      const double side = i == 0 ? 1 : -1, turning = side * t.dot(p[i].v) / d;
      const auto k = static_cast<std::size_t>(i);
      at.values[1 + i] = side * n.dot(p[i].v) - p[i].dh;
      add(0, angles[k], false, 0.5 * side * n, -0.5);
      at.by_angle(0, i) = 0.5 * at.values[1 + i];
      add(1 + i, angles[k], true, side * n, -1);
      add(1 + i, angles[0], false, turning * t, 0);
      add(1 + i, angles[1], false, -turning * t, 0);
      at.by_angle(1 + i, i) = side * n.dot(p[i].a) - p[i].ddh;
      at.by_angle(1 + i, 0) += turning * t.dot(p[0].v);
      at.by_angle(1 + i, 1) -= turning * t.dot(p[1].v);
    }
  }

  void set_three(const std::vector<double>& angles, Equations& at) {
    DiscPoint p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = disc_.at(angles[i]);
    const auto instant = [&](std::size_t i) { return DiscInstant{angles[i], p[i].x, p[i].h}; };
    const auto margin = stick_margin(instant(0), instant(1), instant(2));
    if (!margin) return at.values.setConstant(std::numeric_limits<double>::quiet_NaN()), void();
    Vector2d n[3], t[3];
    double d[3];
    Eigen::Matrix3d A;
    for (int i = 0; i < 3; ++i) {
      const Vector2d y = p[i].x - margin->w;
      d[i] = y.norm();
      n[i] = y / d[i];
      t[i] = quarter_turn(n[i]);
      A.row(i) << n[i].transpose(), 1;
    }
    const Eigen::Matrix3d by_excess = A.inverse();  // of (w, r) by n_i.dx_i - dR_i
    at.values[0] = margin->r;
    for (int i = 0; i < 3; ++i) at.values[1 + i] = n[i].dot(p[i].v) - p[i].dh;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double share = by_excess(2, i), turning = t[i].dot(p[i].v) / d[i];
      add(0, angles[k], false, share * n[i], -share);
      at.by_angle(0, i) = share * at.values[1 + i];
      add(1 + i, angles[k], true, n[i], -1);
      add(1 + i, angles[k], false, turning * t[i], 0);
      at.by_angle(1 + i, i) = n[i].dot(p[i].a) - p[i].ddh + turning * t[i].dot(p[i].v);
      for (int j = 0; j < 3; ++j) {
        const double moved = turning * t[i].dot(by_excess.col(j).head<2>());
        add(1 + i, angles[static_cast<std::size_t>(j)], false, -moved * n[j], moved);
        at.by_angle(1 + i, j) -= moved * at.values[1 + j];
      }
    }
  }

  void set_birth(double theta, Equations& at) {
    find_phases();
    const auto rest = rest_before(theta);
    if (!rest) return at.values.setConstant(std::numeric_limits<double>::quiet_NaN()), void();
    const DiscPoint p = disc_.at(theta);
    const Vector2d y = p.x - list()[*rest].w;
    const double d = y.norm();
    const Vector2d n = y / d, t = quarter_turn(n);
    const double turning = t.dot(p.v) / d;
    dw_.resize(2, 3 * c_);
    stretch_.rest_derivative(*rest, dw_);
    at.values << d - p.h, n.dot(p.v) - p.dh;
    add(0, theta, false, n, -1);
    rows_.row(0) -= n.transpose() * dw_;
    add(1, theta, true, n, -1);
    add(1, theta, false, turning * t, 0);
    rows_.row(1) -= turning * t.transpose() * dw_;
    at.by_angle << at.values[1], n.dot(p.a) - p.ddh + turning * t.dot(p.v);
  }

  // From x and R to the motion and the fields, times k_t in the first row.
  void to_unknowns(Equations& at) {
    const double k_t = fields_[contact_field::tangential_stiffness],
                 k_n = fields_[contact_field::normal_stiffness],
                 mu = fields_[contact_field::friction_coefficient];
    const auto by_R = rows_.rightCols(c_);
    at.by_motion << rows_.leftCols(2 * c_), mu * k_n / k_t * by_R;
    at.by_field.col(contact_field::tangential_stiffness) = -by_R * radius_ / k_t;
    at.by_field.col(contact_field::normal_stiffness) = mu / k_t * by_R * w_.tail(c_);
    at.by_field.col(contact_field::friction_coefficient) = by_R * radius_ / mu;
    at.by_field.col(contact_field::normal_load) = mu / k_t * by_R.col(0);
    at.by_field.row(0) *= k_t;
    at.by_field(0, contact_field::tangential_stiffness) += at.values[0];
    at.values[0] *= k_t;
    at.by_motion.row(0) *= k_t;
    at.by_angle.row(0) *= k_t;
  }

  static double after(double theta, double begin) {
    return theta - begin - std::floor((theta - begin) / whole_turn) * whole_turn;
  }
  // Slip after the rest that ends soon in another rest: it may just have been born.
  const DiscPhase* short_slip_after(std::size_t rest) const {
    const DiscPhase &next = list()[(rest + 1) % list().size()], &then = list()[(rest + 2) % list().size()];
    return next.state == DiscPhase::State::slip && then.state == DiscPhase::State::stick &&
                   next.end - next.begin < short_slip
               ? &next
               : nullptr;
  }
  // The rest in which slip is born at an angle, or has just been.
  std::optional<std::size_t> rest_before(double theta) const {
    std::optional<std::size_t> last;
    double least = whole_turn;
    for (std::size_t i = 0; i < list().size(); ++i) {
      if (list()[i].state != DiscPhase::State::stick) continue;
      const DiscPhase* slip = short_slip_after(i);
      if (slip && after(theta, slip->begin) <= 2 * (slip->end - slip->begin) + just_born) return i;
      const double since = after(theta, list()[i].begin);
      if (since > least) continue;
      least = since;
      last = i;
    }
    return last;
  }

  // |x - w| - R and its slope and second derivative.
  Vector2d slope_in_rest(double theta, const Vector2d& w) const {
    const DiscPoint p = disc_.at(theta);
    const Vector2d y = p.x - w, n = y.normalized(), t = quarter_turn(n);
    const double across = t.dot(p.v);
    return {n.dot(p.v) - p.dh, n.dot(p.a) - p.ddh + across * across / y.norm()};
  }

  bool polish_in_rest(double& theta, const Vector2d& w) const {
    const double begin = theta;
    for (int k = 0; k < corner_newton_steps; ++k) {
      const Vector2d slope = slope_in_rest(theta, w);
      if (!(slope[1] < 0)) return false;
      const double step = -slope[0] / slope[1];
      theta += step;
      if (!(std::abs(theta - begin) <= same_corner)) return false;
      if (std::abs(step) <= 1e-14) break;
    }
    return true;
  }

  bool polish_stick(Corner& corner) {
    const auto count = static_cast<Eigen::Index>(corner.angles.size());
    Equations at(3 * c_, static_cast<int>(count), 4);
    const std::vector<double> begin = corner.angles;
    for (int k = 0; k < corner_newton_steps; ++k) {
      at.by_angle.setZero();
      rows_.setZero(1 + count, 3 * c_);
      corner.guard == stick_of_two ? set_two(corner.angles, at) : set_three(corner.angles, at);
      const auto A = at.by_angle.bottomRows(count);
      if (!at.values.allFinite() || !(A.diagonal().maxCoeff() < 0)) return false;
      const Eigen::VectorXd step = -A.partialPivLu().solve(at.values.tail(count));
      for (std::size_t i = 0; i < begin.size(); ++i) {
        corner.angles[i] += step[static_cast<Eigen::Index>(i)];
        if (!(std::abs(corner.angles[i] - begin[i]) <= same_corner)) return false;
      }
      if (step.cwiseAbs().maxCoeff() <= 1e-14) break;
    }
    return true;
  }

  // Where |x - w| - R is largest within a rest, or in short slip after it.
  std::vector<double> tops_of_rest(std::size_t rest) const {
    const DiscPhase& phase = list()[rest];
    const DiscPhase* slip = short_slip_after(rest);
    const double step = 1.0 / (2 * h_.order + 8);
    const double end = slip ? phase.end + std::max(2 * (slip->end - slip->begin), 2 * step) : phase.end;
    const int count = std::max(8, static_cast<int>((end - phase.begin) / step));
    const auto excess = [&](int k) {
      const DiscPoint p = disc_.at(phase.begin + (end - phase.begin) * k / count);
      return (p.x - phase.w).norm() - p.h;
    };
    std::vector<double> tops;
    double before = excess(0), here = excess(1);
    for (int k = 1; k < count; ++k) {
      const double next = excess(k + 1);
      double theta = phase.begin + (end - phase.begin) * k / count;
      if (here > before && here >= next && polish_in_rest(theta, phase.w) && theta > phase.begin + just_born)
        tops.push_back(theta);
      before = here;
      here = next;
    }
    return tops;
  }

  // The same corner, or an image of it in a motion of a shorter period.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner) const {
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      if (other.guard != corner.guard) return false;
      const double turn = corner.angles[0] - other.angles[0];
      for (std::size_t i = 1; i < corner.angles.size(); ++i) {
        const double apart = corner.angles[i] - other.angles[i] - turn;
        if (std::abs(std::remainder(apart, whole_turn)) > same_corner_angle) return false;
      }
      for (int i = 0; i < 3; ++i)
        if (!is_image(h_, w_.segment(i * c_, c_), turn, 1)) return false;
      return true;
    });
  }

  Harmonics h_;
  Eigen::Index c_;
  double fields_[4] = {};
  NormalContact normal_;
  Disc disc_;
  DiscStretch stretch_;
  StickCentre centre_;
  Eigen::VectorXd w_, radius_, phi_, slope_;
  Eigen::MatrixXd rows_, dw_;
};

}  // namespace

std::unique_ptr<Corners> make_contact_3d_corners(const Harmonics& harmonics) {
  return std::make_unique<Contact3dCorners>(harmonics);
}

}  // namespace arcslip::elements
