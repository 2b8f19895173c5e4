#pragma once
// The event-driven integration, piece by piece (event_driven.hpp). Private.

#include <arcslip/time/event_driven.hpp>
#include <arcslip/time/linear_motion.hpp>

#include <optional>

namespace arcslip::time {

/// A Jenkins element and its contact.
struct Friction {
  int element, slider;
  Vector direction;
  double stiffness, limit;  // k_d, mu F_n
  int slip = 0;             // sign of the slip velocity; 0: stuck, or free where the limit is 0

  bool free() const { return limit <= 0; }
  bool stuck() const { return slip == 0 && !free(); }
};

class March {
 public:
  March(const EquationOfMotion& equation, const EventLimits& limits);

  /// derivatives: columns for the change with x, x' and z of the start as well.
  void begin(const State& start, double time, bool derivatives);

  /// Finds the next piece, from time() over s() * h(), at most to `to`. False where the march has to end:
  /// reason().
  bool find(double to);
  /// Goes to the end of that piece, and through the event there.
  void finish();

  double time() const { return t_; }
  double h() const { return h_; }
  double s() const { return s_; }
  double piece_end() const { return event_ ? event_->time : end_; }
  const LinearMotion& piece() const { return linear_; }
  const std::vector<Friction>& frictions() const { return frictions_; }
  /// The event at the end of the piece; none: nullptr. Contact found at the start is no event.
  const ContactEvent* event() const { return event_ && recorded_ ? &*event_ : nullptr; }

  State state() const;
  double size() const;                                      // |(x, x'/omega)|
  Matrix monodromy() const;                                 // 2 dofs + sliders
  double slider(const Friction& friction, double q) const;  // z where the element is at q
  double force(const Friction& friction, double q) const;

  EndReason reason() const { return reason_; }
  std::string message() const;

 private:
  void locate();
  void switch_contact(Friction& friction);

  const EquationOfMotion& equation_;
  EventLimits limits_;
  LinearMotion linear_;
  std::vector<Friction> frictions_;
  Matrix X_, V_, Z_, g_;  // dofs, dofs, sliders, elements; times columns
  double t_ = 0, from_ = 0, h_ = 0, s_ = 0, end_ = 0;
  std::optional<ContactEvent> event_;
  std::size_t switching_ = 0;
  bool recorded_ = false, moved_ = false;
  long events_ = 0, pieces_ = 0;
  EndReason reason_ = EndReason::reached;
  LinearMotion::Series guard_{};
};

}  // namespace arcslip::time
