#include <arcslip/continuation/correction/kink_location.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace arcslip::continuation {
namespace {

constexpr double least_slope = 0.1;   // of a tangent relative to the first one, to predict along it
constexpr double farther = 8;         // factor after a prediction short of the end of the piece
constexpr double farthest_cubic = 8;  // of the interval of its two points
constexpr double first_margin = 1e-2;
constexpr double chord_share = 1e-3;      // accuracy of the end of the piece on a chord
constexpr double retry_share = 1.0 / 64;  // of the distance from which a correction failed, to try it anew
constexpr int most_kink_corrections = 60;
constexpr int most_blind_aims = 40;  // where no prediction leaves the piece

// The branch beyond its last known point in steps x along a direction d: dv/dx = t / <t, d> with its tangent
// t. With two points it is the cubic through both, with one the tangent.
class Prediction {
 public:
  Prediction(const Vector& direction, const Vector& row)
      : direction_(direction), row_(row), second_(direction.size()), third_(direction.size()) {}

  void begin_at(double x, const CurvePoint& place) {
    h_ = 0;
    x_ = x;
    v_ = place.v;
    const double along = row_.dot(place.tangent);
    goes_on_ = along > least_slope;  // else the branch turns away
    slope_ = goes_on_ ? Vector(place.tangent / along) : direction_;
  }
  void continue_to(double x, const CurvePoint& place) {
    const double h = x - x_;
    const bool went_on = goes_on_;
    second_ = v_;
    third_ = slope_;
    begin_at(x, place);
    if (!went_on || !goes_on_ || !(h > 0)) return;
    h_ = h;
    const Vector mean = (v_ - second_) / h;
    third_ = (third_ + slope_ - 2 * mean) / (h * h);
    second_ = (slope_ - mean) / h;
  }
  /// Uses the tangent alone at distances that are too far for the cubic.
  void prepare_for(double distance) {
    if (distance > farthest_cubic * h_) h_ = 0;
  }

  bool is_cubic() const { return h_ > 0; }
  void at(double x, Vector& v) const {
    const double d = x - x_;
    v = v_ + d * slope_;
    if (is_cubic()) v += d * d * (second_ + (d + h_) * third_);
  }
  /// At a distance, up to a factor.
  double error(double d) const { return is_cubic() ? d * d * (d + h_) * (d + h_) : d * d; }

 private:
  const Vector &direction_, &row_;
  double x_ = 0, h_ = 0;
  bool goes_on_ = false;
  Vector v_, slope_, second_, third_;
};

// Distances along the tangent of `from` are those of predictions and corrections. The branch is in the piece
// at lower_, where `kink` is, and is taken to be outside of it at upper_.
class KinkSearch {
 public:
  KinkSearch(Corrector& with, const CurvePoint& from, double length, CurvePoint& kink, Correction& last,
             const Inside& is_inside, double accuracy)
      : with_(with),
        from_(from),
        length_(length),
        kink_(kink),
        last_(last),
        is_inside_(is_inside),
        row_(with.border_row(from.tangent)),
        finest_(accuracy * std::max(length, with.norm_u(from.v))),
        upper_(length),
        ahead_(length),
        outside_at_(length),
        v_(from.v),
        prediction_(from.tangent, row_) {
    kink_ = from;
    prediction_.begin_at(0, from);
  }

  bool run() {
    for (int k = 0; k < most_kink_corrections && upper_ - lower_ > finest_; ++k)
      if (const Finding found = step(); found != Finding::nothing_yet) return found == Finding::end_of_piece;
    return upper_ - lower_ <= finest_;
  }

 private:
  enum class Finding { nothing_yet, end_of_piece, none };
  // What a correction aims at: just before the predicted end of the piece; or, where the prediction does not
  // leave the piece before upper_, the whole length, to see whether the piece ends at all; upper_, where a
  // correction failed from farther away; or some place between.
  enum class Aim { predicted_end, length, again, between };
  struct Bracket {  // of a place at which a path leaves the piece
    double inside, outside;
  };

  Finding step() {
    Bracket end = bracket_of_prediction();
    const double margin = margin_of(end.outside);
    bisect(end, 0.5 * margin, [this](double x, PieceTest test) { return is_predicted_inside(x, test); });
    if (end.inside == lower_ || end.outside - lower_ <= finest_) return Finding::end_of_piece;
    const Aim aim = aim_at(end);
    if (aim != Aim::predicted_end && ++blind_aims_ > most_blind_aims) return Finding::none;
    end_tested_ = end_tested_ || aim == Aim::length;
    const double x = place_of(aim, end, margin);
    prediction_.at(x, v_);
    const Correction at = with_.correct(v_, row_, factors_fit_);
    factors_fit_ = at.converged && is_here_inside();
    if (!factors_fit_) {
      end_before(x, at.converged);
      return Finding::nothing_yet;
    }
    if (x == length_) return Finding::none;  // the piece does not end
    if (aim == Aim::again) return_to_outside();
    return continue_to(x, aim, end.outside, at) ? Finding::nothing_yet : Finding::none;
  }

  // Goes ahead on the prediction until it leaves the piece, or reaches upper_.
  Bracket bracket_of_prediction() {
    Bracket end{lower_, std::min(upper_, lower_ + ahead_)};
    prediction_.prepare_for(end.outside - lower_);
    while (is_predicted_inside(end.outside, PieceTest::whole)) {
      end.inside = end.outside;
      if (end.outside == upper_) break;
      end.outside = std::min(upper_, lower_ + farther * (end.outside - lower_));
      prediction_.prepare_for(end.outside - lower_);
    }
    return end;
  }

  // The share of the distance to the predicted end of the piece that is kept, so that it is not passed. The
  // error of a prediction is known from the next one.
  double margin_of(double outside) const {
    if (!(error_ > 0) || (error_of_cubic_ && !prediction_.is_cubic())) return first_margin;
    const double distance = outside - lower_;
    const double next = error_of_cubic_ ? prediction_.error(distance) : distance * distance;
    return std::min(first_margin, 2 * std::abs(outside - predicted_) * (next / error_) / distance);
  }

  // The end of the piece on a path, to a share of its distance.
  template <class IsInside>
  void bisect(Bracket& end, double share, const IsInside& is_inside) const {
    for (double tested = end.inside;;) {  // by all of F; what left the piece last is asked first
      while (end.outside - end.inside > std::max(finest_ / 4, share * (end.outside - lower_))) {
        const double middle = 0.5 * (end.inside + end.outside);
        (is_inside(middle, PieceTest::part) ? end.inside : end.outside) = middle;
      }
      if (end.inside == tested || is_inside(end.inside, PieceTest::whole)) return;
      end.outside = end.inside;
      end.inside = tested;
    }
  }

  Aim aim_at(const Bracket& end) const {
    if (end.inside != upper_) return Aim::predicted_end;
    if (upper_ == length_ && !end_tested_) return Aim::length;
    return failed_from_ > 0 && upper_ - lower_ < retry_share * failed_from_ ? Aim::again : Aim::between;
  }

  double place_of(Aim aim, const Bracket& end, double margin) {
    if (aim == Aim::predicted_end) return end.inside - margin * (end.inside - lower_);
    return aim == Aim::between ? place_between() : upper_;
  }

  // Where the predicted branch stays in the piece but the branch does not: on the chord to its point beyond,
  // and in the middle in turns.
  double place_between() {
    if (beyond_.size() == 0 || blind_aims_ % 2 == 0) return 0.5 * (lower_ + upper_);
    Bracket end{lower_, upper_};
    bisect(end, chord_share, [this](double x, PieceTest test) {
      v_ = kink_.v + (x - lower_) / (upper_ - lower_) * (beyond_ - kink_.v);
      return is_inside(test);
    });
    return end.inside > lower_ ? end.inside : 0.5 * (lower_ + end.outside);
  }

  // Where a correction fails, the branch may be in the piece for all that: `x` is then tried again from
  // nearby, before it is taken for the end of the piece.
  void end_before(double x, bool converged) {
    upper_ = x;
    ahead_ = upper_ - lower_;
    beyond_ = converged ? v_ : Vector();
    failed_from_ = converged ? 0 : ahead_;
    error_ = 0;
    if (!converged) return;
    outside_at_ = upper_;
    branch_outside_ = v_;
  }

  // What failed is inside: back to what was found outside.
  void return_to_outside() {
    upper_ = outside_at_;
    beyond_ = branch_outside_;
    failed_from_ = 0;
    blind_aims_ = 0;
    end_tested_ = upper_ < length_;
  }

  // False if there is no tangent.
  bool continue_to(double x, Aim aim, double predicted, const Correction& at) {
    const bool by_prediction = aim == Aim::predicted_end;
    error_ = by_prediction ? prediction_.error(x - lower_) : 0;
    error_of_cubic_ = prediction_.is_cubic();
    predicted_ = predicted;
    ahead_ = by_prediction ? 2 * (predicted - x) : upper_ - x;
    lower_ = x;
    kink_.v = v_;
    kink_.arclength = from_.arclength + lower_;
    last_ = at;
    if (!settle(with_, kink_)) return false;
    prediction_.continue_to(lower_, kink_);
    return true;
  }

  bool is_here_inside() {
    std::uint64_t piece = 0;
    return with_.piece(piece) && piece == from_.piece && (!is_inside_ || is_inside_(v_));
  }
  bool is_inside(PieceTest test) {
    return is_inside_ ? with_.move_to(v_) && is_here_inside() : with_.is_in_piece(v_, from_.piece, test);
  }
  bool is_predicted_inside(double x, PieceTest test) {
    prediction_.at(x, v_);
    return is_inside(test);
  }

  Corrector& with_;
  const CurvePoint& from_;
  const double length_;
  CurvePoint& kink_;
  Correction& last_;
  const Inside& is_inside_;
  const Vector row_;
  const double finest_;
  double lower_ = 0, upper_;
  double ahead_;   // where the prediction is looked at first, from lower_
  Vector beyond_;  // the branch at upper_, or nothing
  double predicted_ = 0,
         error_ = 0;  // the last predicted end of the piece, and the error of predictions there
  bool error_of_cubic_ = false;
  double failed_from_ = 0;  // the distance from which the correction to upper_ failed; 0: it did not
  double outside_at_;       // the last place found outside, and the branch there
  Vector branch_outside_;
  bool factors_fit_ = false;
  int blind_aims_ = 0;
  bool end_tested_ = false;  // whether the branch is in the piece at `length`
  Vector v_;
  Prediction prediction_;
};

}  // namespace

bool locate_kink(Corrector& with, const CurvePoint& from, double length, CurvePoint& kink, Correction& last,
                 const Inside& is_inside, double accuracy) {
  return KinkSearch(with, from, length, kink, last, is_inside, accuracy).run();
}

}  // namespace arcslip::continuation
