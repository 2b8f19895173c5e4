#pragma once
// Rings whose sector comes from matrices in files, and the same rings of masses and springs, written sector
// by sector.

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace matrix_rings {

using namespace arcslip;

inline std::string text(double value) {
  std::ostringstream digits;
  digits.precision(17);
  digits << value;
  return digits.str();
}

inline std::string listed(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + text(value);
  return "[" + list + "]";
}

/// Between two rows, from 0, or one row and the ground: -1.
struct Link {
  int a, b;
  double value;
};

/// A disk, "hub", and three masses of a blade on it; the last of them is "tip.z".
struct Sector {
  std::vector<double> masses{2, 0.5, 0.4, 0.3};
  std::vector<Link> springs{{0, -1, 1.5}, {1, 0, 3}, {2, 1, 1.2}, {3, 2, 0.8}};
  std::vector<Link> dampers{{0, -1, 0.03}, {3, 2, 0.02}};
  std::vector<Link> stiffening{{1, 0, 0.2}, {2, 1, 0.15}, {3, 2, 0.1}};  // N/m s^2
};

inline std::string symmetric(int rows, const std::vector<Link>& links) {
  std::vector<double> A(static_cast<std::size_t>(rows * rows), 0.0);
  const auto at = [&](int i, int j) -> double& { return A[static_cast<std::size_t>(rows * i + j)]; };
  for (const Link& link : links) {
    at(link.a, link.a) += link.value;
    if (link.b < 0) continue;
    at(link.b, link.b) += link.value;
    at(link.a, link.b) -= link.value;
    at(link.b, link.a) -= link.value;
  }
  std::string lines =
      "%%MatrixMarket matrix array real general\n" + std::to_string(rows) + " " + std::to_string(rows) + "\n";
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < rows; ++i) lines += text(at(i, j)) + "\n";
  return lines;
}

/// M.mtx, K.mtx, C.mtx, K2.mtx, G.mtx, a gyroscopic matrix, p.mtx, two shapes, r.mtx, one of 1, and
/// names.csv.
inline Folder files(const Sector& of = {}, const std::string& names = "name,row\ntip.z,4\nhub,1\n") {
  const auto rows = static_cast<int>(of.masses.size());
  std::vector<Link> masses;
  std::string p = "%%MatrixMarket matrix array real general\n" + std::to_string(rows) + " 2\n", r = p;
  r.replace(r.find(" 2\n"), 3, " 1\n");
  for (int i = 0; i < rows; ++i) {
    masses.push_back({i, -1, of.masses[static_cast<std::size_t>(i)]});
    r += "1\n";
  }
  for (int i = 0; i < 2 * rows; ++i) p += text(0.5 - 0.2 * i) + "\n";
  return {{"M.mtx", symmetric(rows, masses)},
          {"K.mtx", symmetric(rows, of.springs)},
          {"C.mtx", symmetric(rows, of.dampers)},
          {"K2.mtx", symmetric(rows, of.stiffening)},
          {"G.mtx", "%%MatrixMarket matrix coordinate real skew-symmetric\n" + std::to_string(rows) + " " +
                        std::to_string(rows) + " 1\n3 2 0.3\n"},
          {"p.mtx", p},
          {"r.mtx", r},
          {"names.csv", names}};
}

struct Given {
  int sectors = 6, order = 2;
  std::string keys{};       // further ones of "matrices"
  std::string structure{};  // of "structure"
  std::string elements{};
  std::string excitation{};  // none: forces on tip and hub, and in the second harmonic on the hub
  int harmonics = 5;
  // Of each sector; empty: 1.
  std::vector<double> stiffness{}, link{}, mass{}, load{};
};

/// A key of "matrices", and angular frequencies below what it keeps.
inline const std::string reduced = R"(, "highest_frequency": 60)";
inline const std::vector<double> frequencies{0.4, 0.7, 0.95, 1.2, 1.6, 2.3, 3.1};

inline const std::string friction = R"({"name": "damper", "type": "jenkins",
  "between": ["tip.z", {"next": "tip.z"}], "stiffness": 0.4, "friction_coefficient": 0.5, "normal_load": 0.9})";
inline const std::string forces =
    R"({"name": "f", "direction": {"tip.z": 1, "hub": 0.4}, "cosine": 1},
       {"name": "h", "at": "hub", "harmonic": 2, "cosine": 0.3, "sine": 0.1})";
inline const std::string responses = R"([{"name": "tip", "at": "tip.z"}, {"name": "hub", "at": "hub"}])";

enum class Ring { sector, full };

/// A sector with a mass and a spring on its tip, a mass "pad" next to the matrices, and links to the next
/// hub, of which one has no mirror image.
inline std::string scene_text(const Given& given, Ring ring, const std::string& response = responses) {
  std::string cyclic = R"("sectors": )" + std::to_string(given.sectors) + R"(, "engine_order": )" +
                       std::to_string(given.order);
  if (ring == Ring::full) {
    std::string mistuning;
    const auto add = [&](const char* parameter, const std::vector<double>& factors) {
      if (!factors.empty())
        mistuning += (mistuning.empty() ? "\"" : ", \"") + std::string(parameter) + "\": " + listed(factors);
    };
    add("matrices.stiffness", given.stiffness);
    add("link.value", given.link);
    add("mt.value", given.mass);
    add("damper.normal_load", given.load);
    cyclic += ", \"full\": true" + (mistuning.empty() ? "" : ", \"mistuning\": {" + mistuning + "}");
  }
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"cyclic": {)" + cyclic +
         R"(}, "matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "damping": "C.mtx")" + given.keys +
         R"(}, "names": "names.csv", "dofs": ["pad"],
    "masses": [{"name": "mt", "at": "tip.z", "value": 0.05}, {"name": "mp", "at": "pad", "value": 0.2}],
    "springs": [{"name": "kt", "at": "tip.z", "value": 0.1}, {"name": "kp", "between": ["pad", "tip.z"], "value": 0.3},
                {"name": "link", "between": ["hub", {"next": "hub"}], "value": 0.9},
                {"name": "skew", "between": ["tip.z", {"next": "hub"}], "value": 0.07}],
    "dampers": [{"name": "cl", "between": ["hub", {"next": "hub"}], "value": 0.01},
                {"name": "cp", "between": ["pad", "hub"], "value": 0.02}])" +
         given.structure + R"(}, "elements": [)" + given.elements + R"(], "excitation": [)" +
         (given.excitation.empty() ? forces : given.excitation) + R"(], "harmonics": {"order": )" +
         std::to_string(given.harmonics) + R"(}, "response": )" + response + "}";
}

inline scene::Scene read(const std::string& whole, const Folder& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder.path());
}

inline scene::Scene from_matrices(const Given& given, Ring ring, const Folder& folder) {
  return read(scene_text(given, ring), folder);
}

/// A force on row i, the one behind the last: on the pad; -1: an acceleration of the ground under all rows.
struct Push {
  std::string name;
  int row, harmonic;
  double cosine, sine;
};

/// The full ring of masses, springs and dampers. A friction damper between tips stands for `elements`.
inline scene::Scene by_hand(const Given& given, const Sector& sector = {}, double speed = 0,
                            const std::vector<Push>& pushes = {
                                {"f", 3, 1, 1, 0}, {"g", 0, 1, 0.4, 0}, {"h", 0, 2, 0.3, 0.1}}) {
  std::string dofs, masses, springs, dampers, elements, excitation, tips, hubs;
  const auto factor = [](const std::vector<double>& factors, int i) {
    return factors.empty() ? 1 : factors[static_cast<std::size_t>(i - 1)];
  };
  const auto add = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  const auto part = [&](std::string& list, const std::string& name, const std::string& place, double value) {
    add(list, "{\"name\": \"" + name + "\", " + place + ", \"value\": " + text(value) + "}");
  };
  const auto at = [](const std::string& dof) { return "\"at\": \"" + dof + "\""; };
  const auto between = [](const std::string& a, const std::string& b) {
    return R"("between": [")" + a + R"(", ")" + b + "\"]";
  };
  const auto rows = static_cast<int>(sector.masses.size());
  for (int i = 1; i <= given.sectors; ++i) {
    const std::string own = std::to_string(i), next = std::to_string(i % given.sectors + 1);
    const auto dof = [&](int row) {
      return row == 0          ? "hub" + own
             : row == rows - 1 ? "tip" + own
             : row == rows     ? "pad" + own
                               : "inner" + std::to_string(row) + "_" + own;
    };
    const auto name = [&](const char* of, int k) { return of + std::to_string(k) + "_" + own; };
    for (int row = 0; row < rows; ++row) {
      add(dofs, '"' + dof(row) + '"');
      part(masses, name("m", row), at(dof(row)), sector.masses[static_cast<std::size_t>(row)]);
    }
    const auto add_links = [&](std::string& list, const char* of, const std::vector<Link>& links, double by) {
      for (std::size_t k = 0; k < links.size(); ++k)
        part(list, name(of, static_cast<int>(k)),
             links[k].b < 0 ? at(dof(links[k].a)) : between(dof(links[k].a), dof(links[k].b)),
             by * links[k].value);
    };
    add_links(springs, "k", sector.springs, factor(given.stiffness, i));
    if (speed > 0) add_links(springs, "s", sector.stiffening, speed * speed);
    add_links(dampers, "c", sector.dampers, 1);
    add(dofs, "\"pad" + own + '"');
    part(masses, "mt" + own, at("tip" + own), 0.05 * factor(given.mass, i));
    part(masses, "mp" + own, at("pad" + own), 0.2);
    part(springs, "kt" + own, at("tip" + own), 0.1);
    part(springs, "kp" + own, between("pad" + own, "tip" + own), 0.3);
    part(springs, "link" + own, between("hub" + own, "hub" + next), 0.9 * factor(given.link, i));
    part(springs, "skew" + own, between("tip" + own, "hub" + next), 0.07);
    part(dampers, "cl" + own, between("hub" + own, "hub" + next), 0.01);
    part(dampers, "cp" + own, between("pad" + own, "hub" + own), 0.02);
    if (!given.elements.empty())
      add(elements, R"({"name": "damper)" + own + R"(", "type": "jenkins", )" +
                        between("tip" + own, "tip" + next) +
                        R"(, "stiffness": 0.4, "friction_coefficient": 0.5, "normal_load": )" +
                        text(0.9 * factor(given.load, i)) + "}");
    for (const Push& push : pushes) {
      const double phase = 2 * std::numbers::pi * push.harmonic * given.order * (i - 1) / given.sectors;
      const double c = std::cos(phase), s = std::sin(phase);
      std::string place =
          push.row >= 0 ? at(dof(push.row)) : "\"type\": \"base_acceleration\", \"direction\": {";
      for (int row = 0; push.row < 0 && row < rows; ++row) place += '"' + dof(row) + "\": 1, ";
      if (push.row < 0) place += "\"pad" + own + "\": 1}";
      add(excitation, "{\"name\": \"" + push.name + own + "\", " + place +
                          ", \"harmonic\": " + std::to_string(push.harmonic) +
                          ", \"cosine\": " + text(c * push.cosine - s * push.sine) +
                          ", \"sine\": " + text(s * push.cosine + c * push.sine) + "}");
    }
    add(tips, R"({"name": "tip)" + own + R"(", "at": "tip)" + own + "\"}");
    add(hubs, R"({"name": "hub)" + own + R"(", "at": "hub)" + own + "\"}");
  }
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": [)" +
                       dofs + R"(], "masses": [)" + masses + R"(], "springs": [)" + springs +
                       R"(], "dampers": [)" + dampers + "]" + given.structure + R"(}, "elements": [)" +
                       elements + R"(], "excitation": [)" + excitation + R"(], "harmonics": {"order": )" +
                       std::to_string(given.harmonics) + R"(}, "response": [)" + tips + ", " + hubs + "]}");
}

/// How far a is from b, relative.
inline double off(double a, double b) {
  return std::abs(a - b) / std::abs(b);
}

}  // namespace matrix_rings
