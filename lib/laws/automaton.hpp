#pragma once
// A piecewise linear law in time as a hybrid automaton: linear modes, and guards for the transitions.
//
//   f = f_q q + f_z z + f_0        z: one number of memory, or none
//   z rests, or follows: z = z_q q + z_0, where f_z is 0. For a slider, the force along its direction is the
//   force that moves it.
//   A guard g = q . q + v . q' + z z + c is at least 0 in its mode, which is left when g falls below 0.
//
// An empty row means 0; f_q and f_0 are given, and f_z where there is a memory. Only sliders dissipate. A
// guard has a position or a velocity, not both. A guard with a velocity that ends a following mode is on the
// velocity of its memory, z_q q', which is thus at rest there.
//
// The first mode is the initial one; it is left at once if a guard is below 0 there.
//
// Motions in time (laws/time_law.hpp), multipliers, the bounds of sliders and forces that are sampled
// over a period (laws/sampled_automata.hpp) follow from the automata of a law.

#include <arcslip/laws/slider_offset.hpp>

#include <Eigen/Core>

#include <optional>
#include <string_view>
#include <vector>

namespace arcslip::elements {

struct Guard {
  Eigen::RowVectorXd q, v;
  double z = 0, c = 0;
  int to = 0;  // the next mode
};

struct Mode {
  std::string_view name;
  Eigen::MatrixXd f_q;  // N/m
  Eigen::VectorXd f_z, f_0;
  bool rests = true;  // the memory; false: it follows
  bool open = false;  // a contact in separation
  Eigen::RowVectorXd z_q;
  double z_0 = 0;
  int way = 0;  // sign of the velocity at which it follows; 0: either
  std::vector<Guard> leaves;

  // Of laws with one direction.
  Mode& follows(double by_q, double z_at_0, int sign);
  Mode& leaves_where(double q, double v, double z, double c, int to);
};

/// One of the automata of a law, which act in parallel.
struct Automaton {
  explicit Automaton(int memory_index) : memory(memory_index) {}

  /// f = f_q q + f_z z + f_0 with one direction. The reference holds until the next.
  Mode& add(std::string_view name, double f_q, double f_z, double f_0);

  int memory;         // index in the law's memory, the position of a slider; -1: none
  int direction = 0;  // along which the slider moves
  double weight = 1;  // in the stick share of the law
  Offset offset = Offset::centred;
  std::vector<Mode> modes;
};

/// The position z of a slider rests between two bounds that move with the displacements q.
struct Slider {
  int memory;                       // z: its index in the law's memory
  int direction;                    // along which it moves; its offset is arbitrary while it rests
  Eigen::RowVectorXd lower, upper;  // the derivatives of the bounds by q
  double centre;                    // between them at q = 0
  // Half their distance at q = 0, of a slider with a static offset (laws/slider_offset.hpp); none: it is
  // centred.
  std::optional<double> room;
};

/// That of an automaton with a memory.
Slider slider_of(const Automaton& automaton);

}  // namespace arcslip::elements
