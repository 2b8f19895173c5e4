#pragma once
// Sectors whose parts or matrices reach into the next one.

#include "lib/hbm/scenes.hpp"

#include <arcslip/model/model.hpp>

#include <Eigen/Dense>

#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace scenes {

/// A disk, a blade and its tip in each sector, with parts of every kind to the next one.
inline scene::Scene ring(int sectors, int order, const std::string& elements, bool odd = false) {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "cyclic": {"sectors": )" +
                       std::to_string(sectors) + R"(, "engine_order": )" + std::to_string(order) + R"(},
    "dofs": ["disk", "blade", "tip"],
    "masses": [{"name": "md", "at": "disk", "value": 2}, {"name": "mb", "at": "blade", "value": 0.9},
               {"name": "mt", "at": "tip", "value": 0.7},
               {"name": "mn", "direction": {"tip": 0.6, "next": {"blade": 0.3}}, "value": 0.2}],
    "springs": [{"name": "kd", "at": "disk", "value": 1.5}, {"name": "kb", "between": ["blade", "disk"], "value": 1.1},
                {"name": "kt", "between": ["tip", "blade"], "value": 1.3},
                {"name": "kn", "between": ["disk", {"next": "disk"}], "value": 0.8},
                {"name": "ks", "between": [{"next": "disk"}, "blade"], "value": 0.3}],
    "dampers": [{"name": "cd", "at": {"next": "disk"}, "value": 0.04},
                {"name": "cs", "direction": {"tip": 1, "next": {"disk": -0.7}}, "value": 0.05}],
    "damping": [{"name": "all", "type": "rayleigh", "alpha": 0.02, "beta": 0.03},
                {"name": "loss", "type": "loss_factor", "loss_factor": 0.01}]},
    "elements": [)" + elements +
                       R"(],
    "excitation": [)" + (odd ? "" : R"({"name": "mean", "at": "tip", "harmonic": 0, "cosine": 0.4},
                   {"name": "f2", "at": "disk", "harmonic": 2, "cosine": 0.2},)") +
                       R"(
                   {"name": "f1", "at": "tip", "cosine": 1, "sine": 0.3},
                   {"name": "f3", "direction": {"tip": 1, "disk": -2}, "harmonic": 3, "sine": 0.5}],
    "harmonics": {"order": 3}, "response": {"at": "tip"}})");
}

/// A matrix of a ring, of one sector and between neighbours, in its waves.
struct Reaching {
  Eigen::MatrixXd own, next, previous;

  static Reaching of(const Eigen::VectorXd& d, const Eigen::VectorXd& next) {
    return {d * d.transpose() + next * next.transpose(), d * next.transpose(), next * d.transpose()};
  }
  /// sign 1: symmetric, -1: skew-symmetric, 0: neither.
  static Reaching random(int dofs, int sign) {
    Reaching all{Eigen::MatrixXd::Random(dofs, dofs), 0.4 * Eigen::MatrixXd::Random(dofs, dofs),
                 0.4 * Eigen::MatrixXd::Random(dofs, dofs)};
    if (sign == 0) return all;
    all.own = (all.own + sign * all.own.transpose()).eval();
    all.previous = sign * all.next.transpose();
    return all;
  }
  Eigen::MatrixXcd in_wave(int diameter, int count) const {
    const std::complex<double> t = std::polar(1.0, -2 * std::numbers::pi * diameter / count);
    return own.cast<std::complex<double>>() + t * next + std::conj(t) * previous;
  }
  model::MatrixPart part(model::LinearKind kind, int parameter, int count, bool symmetric = true) const {
    std::vector<Eigen::MatrixXcd> of_diameter;
    for (int d = 0; 2 * d <= count; ++d) of_diameter.push_back(in_wave(d, count));
    model::MatrixPart made{kind, parameter, std::make_shared<const Eigen::MatrixXd>(own + next + previous)};
    made.symmetric = symmetric;
    made.waves = std::make_shared<const model::WaveMatrices>(count, std::move(of_diameter));
    return made;
  }
};

/// The same model with every part, or every second one, as a matrix in waves.
inline model::Model in_matrices(model::Model model, int of_which) {
  const auto move = [&](model::LinearKind kind, std::vector<model::LinearPart>& parts) {
    std::vector<model::LinearPart> rest;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if ((k + parts.size()) % static_cast<std::size_t>(of_which) > 0) {
        rest.push_back(parts[k]);
        continue;
      }
      const continuation::Vector next = parts[k].next.size() > 0 ? continuation::Vector(parts[k].next)
                                                                 : continuation::Vector::Zero(model.dofs);
      model.matrices.push_back(Reaching::of(parts[k].direction, next)
                                   .part(kind, parts[k].number.parameter(), model.sector->count));
    }
    parts = rest;
  };
  move(model::LinearKind::mass, model.masses);
  move(model::LinearKind::damper, model.dampers);
  move(model::LinearKind::spring, model.springs);
  model.linked = true;
  return model;
}

}  // namespace scenes
