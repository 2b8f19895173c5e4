#pragma once
// The event-driven integration, piece by piece (event_driven.hpp). Private.

#include <arcslip/time/event_driven/event_driven.hpp>
#include <arcslip/time/event_driven/taylor_propagator.hpp>

#include <optional>
#include <vector>

namespace arcslip::time {

/// An automaton of an element, and the mode that it is in.
struct Contact {
  int element;
  elements::Automaton automaton;
  Matrix directions;          // dofs x directions
  std::vector<Vector> along;  // its columns
  Eigen::Index row;           // of its first direction among those of all
  int memory;                 // in MotionState::z; -1: none
  int slider;                 // the direction that this memory follows; -1: it is no slider
  Vector lower, upper;        // its bounds move with lower . x and upper . x
  int now = 0;                // index of the mode
  // Between its bounds: elements::Slider::room.
  std::optional<double> room{};
  double centre = 0;
  const elements::Automaton* rates = nullptr;  // by the parameter of the variation; null: none changes
  const ElementRates::Slider* slider_rates = nullptr;

  const elements::Mode& mode() const { return automaton.modes[static_cast<std::size_t>(now)]; }
  const elements::Mode* mode_rates() const {
    return rates ? &rates->modes[static_cast<std::size_t>(now)] : nullptr;
  }
  bool follows() const { return memory >= 0 && !mode().rests; }
};

/// What a march carries: the motion, or also its change with x, x' and z of the start.
enum class Columns { motion, start };

class March {
 public:
  March(const EquationOfMotion& equation, const EventLimits& limits);

  /// by: with Columns::start, its change with a parameter of these rates, too, which outlive the march.
  void begin(const MotionState& start, double time, Columns columns, const EquationRates* by = nullptr);

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
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// The event at the end of the piece; none: nullptr. Modes found at the start are no event.
  const ContactEvent* event() const { return event_ && recorded_ ? &*event_ : nullptr; }
  /// Of this event: the index of the contact, and that of the mode which it goes to.
  std::size_t switching() const { return switching_; }
  int next_mode() const { return leaving_->to; }

  MotionState state() const;
  double size() const;       // |(x, x'/omega)|
  Matrix monodromy() const;  // 2 dofs + memory
  /// d(x, x', z)/dp where the march ended, at an instant that moves by `rate` with the parameter.
  Vector by_parameter(double rate) const;
  /// z, and f along the first direction, where the element is at q.
  double memory(const Contact& contact, const Vector& q) const;
  double force(const Contact& contact, const Vector& q) const;

  EndReason reason() const { return reason_; }
  std::string message() const;

 private:
  void locate();
  void draw(const Contact& contact);
  void enter(Contact& contact);  // its mode
  void settle(const Contact& contact);

  const EquationOfMotion& equation_;
  EventLimits limits_;
  std::vector<Contact> contacts_;
  LinearMotion linear_;
  Matrix X_, V_, Z_, g_;  // dofs, dofs, memory, directions; times columns
  Eigen::RowVectorXd change_;
  double t_ = 0, from_ = 0, h_ = 0, s_ = 0, end_ = 0;
  std::optional<ContactEvent> event_;
  std::size_t switching_ = 0;
  const elements::Guard* leaving_ = nullptr;
  bool recorded_ = false, moved_ = false;
  long events_ = 0, pieces_ = 0;
  EndReason reason_ = EndReason::reached;
  struct Sized {
    LinearMotion::Series series{};
    double size = 0;
    bool made = false;
  };
  std::vector<Sized> displacement_, velocity_;  // of one contact on the piece, along its directions
  LinearMotion::Series guard_{};
};

}  // namespace arcslip::time
