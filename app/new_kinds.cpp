#include "new_scene.hpp"

#include <cmath>

namespace arcslip::app {

const std::vector<NewKind>& new_kinds() {
  const NewNumber mass{"mass", "mass", 1, "kg"},
      frequency{"frequency", "natural frequency without friction", 50, "Hz"},
      ratio{"damping-ratio", "damping ratio without friction, of critical damping", 0.002, "-", false, 1},
      stiffness{"contact-stiffness-ratio", "stiffness of the contact, over that of the structure", 0.1, "-"},
      friction{"friction", "friction coefficient", 0.3, "-"}, load{"force", "amplitude of the force", 1, "N"};
  static const std::vector<NewKind> kinds = {
      {"damper",
       "a mass with a friction damper, and its best load",
       {mass, frequency, ratio, stiffness, friction, load}},
      {"beam",
       "a cantilever with a friction damper, and its best load",
       {{"length", "length", 1, "m"},
        {"width", "width", 0.04, "m"},
        {"height", "height, along which it bends", 0.02, "m"},
        {"young", "Young's modulus", 2.1e11, "Pa"},
        {"density", "density", 7850, "kg/m^3"},
        ratio,
        {"contact-position", "place of the contact, over the length", 0.5, "-", true, 1},
        stiffness,
        friction,
        load}},
      {"duffing",
       "a Duffing oscillator: responses with their stability, and the backbone",
       {mass,
        {"frequency", "natural frequency of small motions", 1, "Hz"},
        {"damping-ratio", "damping ratio of small motions", 0.01, "-", true, 1},
        {"cubic-stiffness", "stiffness of the cubic spring", 500, "N/m^3", false},
        {"force", "amplitude of the force", 0.1, "N"}}},
      {"contact",
       "a mass on a contact whose normal load varies, and its best load",
       {mass, frequency, ratio, stiffness, friction, load}},
      {"joint",
       "a mass on a joint with microslip: responses, and damping over the amplitude",
       {mass,
        frequency,
        ratio,
        {"joint-stiffness-ratio", "stiffness of the joint, over that of the rest", 1, "-"},
        {"slip-force", "force of macroslip", 50, "N"},
        load}},
      {"from-matrices",
       "a structure of mass and stiffness matrices",
       {{"highest-frequency", "reduce the matrices up to this frequency; required above 500 rows", NAN, "Hz"},
        {"damping-ratio", "damping ratio of each mode, in addition to --damping", 0.005, "-", false, 1},
        {"contact-stiffness", "stiffness of a friction damper at the row of --contact", NAN, "N/m"},
        friction,
        load},
       {{"at", "row of the force: its number, from 1, or its name", "ROW"},
        {"response", "row of the response (default: that of the force)", "ROW"},
        {"contact", "row of a friction damper to ground (default: none)", "ROW"},
        {"names", "names of rows, a CSV file with the columns name and row", "FILE"},
        {"damping", "damping matrix", "C.mtx"}},
       {"M.mtx", "K.mtx"}}};
  return kinds;
}

}  // namespace arcslip::app
