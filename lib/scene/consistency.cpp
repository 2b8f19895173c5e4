#include <arcslip/scene/consistency.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/rotation.hpp>
#include <arcslip/scene/shape.hpp>

#include <algorithm>

namespace arcslip::scene::file {
namespace {

constexpr int most_waves = 200;  // sectors whose matrices are made for each nodal diameter

bool any_value(const std::vector<Part>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.values.front() != 0; });
}

// Marks the degrees of freedom on which parts act. A value of zero does nothing; an element counts as it is.
void mark(const std::vector<Part>& parts, bool even_zero, std::vector<bool>& acted_on) {
  for (const Part& part : parts) {
    if (!even_zero && part.values.front() == 0) continue;
    for (const Direction& direction : part.directions)
      for (const Term& term : direction) acted_on[static_cast<std::size_t>(term.dof)] = true;
  }
}

void check_rotation(const Scene& scene, Faults& faults) {
  if (scene.rotation.empty() && scene.matrices && scene.matrices->stiffness_speed_squared.matrix)
    faults.add(
        "/structure/matrices/stiffness_speed_squared",
        "found no \"rotation\", must stand next to \"matrices\": the speed by which this stiffness grows");
  if (scene.rotation.empty()) return;
  if (!scene.matrices || !scene.matrices->turns()) {
    faults.add("/structure/rotation",
               "found no \"stiffness_speed_squared\", \"gyroscopic\" or \"circulatory\" among \"matrices\", "
               "must be there: what the speed changes");
    return;
  }
  const Part& part = scene.rotation.front();
  const Rotation rotation = part.options.empty() ? Rotation{} : part.options.as<Rotation>();
  if (scene.matrices->highest_frequency > 0 && rotation.highest_speed == 0 && rotation.engine_order == 0)
    faults.add(
        "/structure/rotation",
        "found no \"highest_speed\" next to \"highest_frequency\", must have it: the highest speed for which "
        "the structure is reduced");
  if (rotation.highest_speed > 0 && rotation.engine_order > 0)
    faults.add("/structure/rotation/highest_speed",
               "found it next to \"engine_order\", must be one of them: the highest speed is then "
               "highest_frequency/engine_order");
}

// What acts on all rows of the matrices.
void check_shape(const Scene& scene, std::size_t i, Faults& faults) {
  const Part& part = scene.excitation[i];
  const std::string pointer = child("/excitation", i);
  const bool moves_ground = is_base_motion(*part.type), from_files = scene.matrices && !scene.matrices->bar;
  const Shape* shape = shape_of(part);
  if (shape == nullptr) {
    if (scene.matrices && moves_ground)
      faults.add(
          child(pointer, "type"),
          "found " + shown(part.type->name()) +
              (from_files ? " without \"shape\", must have it with matrices from files: the motion of "
                            "the ground under all rows, also those without names"
                          : ", must be \"force\" with a beam or a rod: the ground would move its nodes "
                            "without names as well"));
    return;
  }
  if (!from_files) {
    faults.add(child(pointer, "shape"),
               "found a vector over the rows of matrices, must stand next to \"matrices\" from files");
    return;
  }
  const auto check_rows = [&](const char* key, const ShapeFile& file) {
    if (file.is_given() && file.from.matrix && file.from.matrix->rows != scene.matrices->size())
      faults.add(child(pointer, key), "found a vector of " + std::to_string(file.from.matrix->rows) +
                                          " rows, must have " + std::to_string(scene.matrices->size()) +
                                          " as the matrices");
  };
  check_rows("shape", shape->real);
  check_rows("imaginary_shape", shape->imaginary);
  if (shape->imaginary.is_given() && part.harmonic == 0)
    faults.add(child(pointer, "imaginary_shape"),
               "found an imaginary part where the harmonic is 0: what is constant has none");
  const int copies = scene.matrices->copies;
  if (shape->copy > copies)
    faults.add(child(pointer, "copy"), "found " + std::to_string(shape->copy) +
                                           ", must be an integer from 1 to " + std::to_string(copies) +
                                           ", one of the copies of the matrices");
  if (shape->copy == 0 && copies > 1)
    faults.add(pointer, "found \"shape\" without \"copy\", must have it next to it, an integer from 1 to " +
                            std::to_string(copies) +
                            ": on which of the copies of the matrices the shape acts; \"repeat\" makes "
                            "excitations for several");
  const std::size_t rows = scene.matrices->named();
  for (const Term& term : part.directions.front())
    if (static_cast<std::size_t>(term.dof) < rows)
      faults.add(pointer, "found " + shown(scene.dofs[static_cast<std::size_t>(term.dof)]) +
                              " next to \"shape\", which has it among the rows of the matrices; must name "
                              "other degrees of freedom alone");
  if (moves_ground && part.directions.front().empty() && scene.dofs.size() > rows)
    faults.add(pointer,
               "found \"shape\" alone, must have \"direction\" next to it: how the ground moves under " +
                   shown(scene.dofs[rows]) + ", which is no row of the matrices");
}

}  // namespace

void check_samples(const Scene& scene, Faults& faults) {
  const Harmonics& harmonics = scene.harmonics;
  const int least = 4 * harmonics.order + 4;
  if (harmonics.friction == Friction::sampled && harmonics.samples < least && harmonics.accuracy == 0) {
    faults.add("/harmonics/samples", "found " + std::to_string(harmonics.samples) +
                                         (harmonics.samples == Harmonics{}.samples ? " (the default)" : "") +
                                         ", must be an integer from " + std::to_string(least) +
                                         " (4*order + 4) to " + std::to_string(largest_samples) +
                                         " where friction is sampled");
  } else if (harmonics.friction == Friction::sampled && harmonics.samples % harmonics.period != 0) {
    faults.add("/harmonics/samples", "found " + std::to_string(harmonics.samples) +
                                         ", must be a multiple of harmonics.period, which is " +
                                         std::to_string(harmonics.period) + ", where friction is sampled");
  }
}

void check_cyclic(const Scene& scene, Faults& faults) {
  if (scene.harmonics.period > 1)
    faults.add("/harmonics/period",
               "found " + std::to_string(scene.harmonics.period) +
                   ", must be 1 for one sector: a ring whose motion repeats after several periods moves in "
                   "other waves; give \"cyclic\" the key \"full\": true");
  const auto is_linked = [](const std::vector<Part>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const Part& part) {
      return std::any_of(part.directions.front().begin(), part.directions.front().end(),
                         [](const Term& term) { return term.next; });
    });
  };
  const bool has_faces = scene.matrices && !scene.matrices->faces.empty();
  for (std::size_t i = 0; i < scene.damping.size(); ++i)
    if (scene.damping[i].type == &modal_damping_type() &&
        (is_linked(scene.masses) || is_linked(scene.springs) || has_faces))
      faults.add(
          child(child("/structure/damping", i), "type"),
          "found " + shown(scene.damping[i].type->name()) +
              ", must be another damping where masses, springs or matrices reach into the next sector: the "
              "modes of a ring are not those of one sector; give \"cyclic\" the key \"full\": true");
  for (std::size_t i = 0; i < scene.elements.size(); ++i)
    if (scene.elements[i].type != nullptr &&  // unknown: a fault already
        scene.elements[i].type->depends_on_phase(scene.elements[i].options))
      faults.add(child("/elements", i),
                 "found a force that depends on the phase of the excitation, which is another one in each "
                 "sector; give "
                 "\"cyclic\" the key \"full\": true");
  if (!has_faces) return;
  if (scene.cyclic->sectors > most_waves)
    faults.add("/structure/cyclic/sectors",
               "found " + std::to_string(scene.cyclic->sectors) + ", must be at most " +
                   std::to_string(most_waves) +
                   " where the matrices have \"faces\": they are made for each nodal diameter");
  for (std::size_t i = 0; i < scene.excitation.size(); ++i)
    if (is_base_motion(*scene.excitation[i].type) && shape_of(scene.excitation[i]) != nullptr)
      faults.add(child(child("/excitation", i), "shape"),
                 "found a motion of the ground under a sector with \"faces\", must be the forces M r as the "
                 "shape of a force; or give \"cyclic\" the key \"full\": true");
}

void check_excitation(const Scene& scene, Faults& faults) {
  for (std::size_t i = 0; i < scene.excitation.size(); ++i) {
    const int harmonic = scene.excitation[i].harmonic;
    const int order = scene.harmonics.order, period = scene.harmonics.period;
    if (harmonic > order / period) {
      faults.add(child(child("/excitation", i), "harmonic"),
                 "found " + std::to_string(harmonic) + ", must be at most harmonics.order" +
                     (period == 1 ? ", which is " + std::to_string(order)
                                  : "/harmonics.period, which is " + std::to_string(order) + "/" +
                                        std::to_string(period)));
    }
    check_shape(scene, i, faults);
    if (harmonic == 0 && scene.excitation[i].type == &base_displacement_type())
      faults.add(child(child("/excitation", i), "harmonic"),
                 "found 0, must be at least 1 for a displacement of the ground: a constant one moves nothing "
                 "relative to it");
    if (const double sine = scene.excitation[i].values[1]; harmonic == 0 && sine != 0) {
      faults.add(child(child("/excitation", i), "sine"),
                 "found " + number_text(sine) + ", must be 0 where the harmonic is 0: the " +
                     (is_base_motion(*scene.excitation[i].type) ? "acceleration" : "force") + " is constant");
    }
  }
  const bool oscillates = std::any_of(scene.excitation.begin(), scene.excitation.end(),
                                      [](const Part& force) { return force.harmonic > 0; });
  if (!oscillates && !scene.excitation.empty())
    faults.add(
        "/excitation",
        "found constant forces alone, must have a force or a motion of the ground of a harmonic above 0");
}

void check_frames(const Scene& scene, Faults& faults) {
  const bool runs_away = std::any_of(scene.excitation.begin(), scene.excitation.end(), [](const Part& part) {
    return part.type == &base_acceleration_type() && part.harmonic == 0;
  });
  if (!runs_away) return;
  for (std::size_t i = 0; i < scene.responses.size(); ++i) {
    if (scene.responses[i].frame == Frame::relative) continue;
    const bool listed = !scene.responses[i].name.empty();
    faults.add(child(listed ? child("/response", i) : "/response", "frame"),
               "found \"absolute\", must be \"relative\" where the ground has a constant acceleration");
  }
}

void check_structure(const Scene& scene, Faults& faults) {
  for (std::size_t i = 0; i < scene.damping.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (scene.damping[k].type == scene.damping[i].type)
        faults.add(child(child("/structure/damping", i), "type"),
                   "found " + shown(scene.damping[i].type->name()) + " again, must be given once");
  check_rotation(scene, faults);
  if (!scene.matrices && !any_value(scene.masses))
    faults.add("/structure/masses", "found no mass, must have at least one mass with a value above 0 kg");
  const std::vector<Part> elements = all_elements(scene);
  if (!scene.matrices && !any_value(scene.springs) && elements.empty()) {
    faults.add(
        "/structure/springs",
        "found no stiffness, must have at least one spring with a value other than 0 N/m, or an element");
  }
  std::vector<bool> acted_on(scene.dofs.size(), false);
  mark(scene.masses, false, acted_on);
  mark(scene.springs, false, acted_on);
  mark(scene.dampers, false, acted_on);
  mark(elements, true, acted_on);
  if (!scene.matrices && std::find(acted_on.begin(), acted_on.end(), true) == acted_on.end())
    return;  // reported above
  const std::size_t rows = scene.matrices ? scene.matrices->named() : 0;
  for (std::size_t i = rows; i < acted_on.size(); ++i) {
    if (!acted_on[i]) {
      faults.add(child("/structure/dofs", i - rows),
                 "found nothing that acts on " + shown(scene.dofs[i]) +
                     ", must have a mass, spring or damper with a value other than 0, or an element");
    }
  }
}

}  // namespace arcslip::scene::file
