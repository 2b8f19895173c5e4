// Random joints of 5 to 40 contacts, from nearly full stick to nearly full slip: their frequency responses in
// one, two and four threads, and next to integration in time. ARCSLIP_SCENES is how many; by default 6, or
// 200 with ARCSLIP_FULL=1; ARCSLIP_FIRST_JOINT is the seed of the first one. One in four is integrated.
#include "catch.hpp"

#include "random.hpp"
#include "volume.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/scene/patch.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using namespace arcslip;
using Json = nlohmann::json;
using test_random::Random;

namespace {

const std::uint64_t first = Volume{"ARCSLIP_FIRST_JOINT", 1, 1}.count(),
                    last = first + Volume{"ARCSLIP_SCENES", 6, 200}.count() - 1;

// So that a joint takes some seconds.
constexpr int most_coordinates = 48, most_unknowns = 160;

// Of every law as many.
constexpr std::uint64_t integrated_every = 4;

const scene::PartType* law_of(std::uint64_t seed) {
  const scene::PartType* const laws[] = {&elements::jenkins(), &elements::contact_2d(),
                                         &elements::contact_3d()};
  return laws[seed % 3];
}

// A contact of area A: the displacements of its directions, and its stiffnesses, load and friction.
struct Contact {
  std::vector<scene::Direction> directions;
  double area = 1, tangential = 0, normal = 0, load = 0;
};

struct Joint {
  scene::Scene scene;
  int tangential = 1;  // directions of its contacts
  bool has_normal = false;
  std::vector<Contact> contacts;
  double friction = 0.3, tangential_per_area = 0, normal_per_area = 0;
};

void add_part(std::vector<scene::Part>& to, const char* letter, const scene::PartType& type,
              const scene::Direction& direction, double value) {
  to.push_back({letter + std::to_string(to.size()), &type, {direction}, {value}});
}

// A structure in the coordinates of a few modes, coupled by some springs. Contacts lie along a line, and
// move as the modes do there.
void modal_structure(Random& random, int count, Joint& joint) {
  scene::Scene& s = joint.scene;
  const int modes = random.count(3, 8), directions = joint.tangential + (joint.has_normal ? 1 : 0);
  const double damping = random.logarithmic(0.003, 0.02);
  double frequency = random.logarithmic(60, 300);
  const double lowest = frequency * frequency;
  for (int k = 0; k < modes; ++k, frequency *= random.between(1.3, 2.5)) {
    s.dofs.push_back("q" + std::to_string(k));
    add_part(s.masses, "m", scene::mass_type(), {{k, 1.0}}, 1);
    add_part(s.springs, "k", scene::spring_type(), {{k, 1.0}}, frequency * frequency);
    add_part(s.dampers, "c", scene::damper_type(), {{k, 1.0}}, 2 * damping * frequency);
  }
  for (int k = random.count(0, 3); k > 0; --k) {
    const int a = random.count(0, modes - 2);
    add_part(s.springs, "k", scene::spring_type(), {{a, 1.0}, {a + 1, random.between(-1, 1)}},
             lowest * random.logarithmic(0.02, 0.3));
  }
  std::vector<std::vector<double>> phases(static_cast<std::size_t>(directions));
  for (auto& each : phases)
    for (int k = 0; k < modes; ++k) each.push_back(random.between(0, 2 * std::numbers::pi));
  for (int i = 0; i < count; ++i) {
    Contact& contact = joint.contacts.emplace_back();
    for (const auto& each : phases) {
      scene::Direction& along = contact.directions.emplace_back();
      for (int k = 0; k < modes; ++k)
        along.push_back({k, std::sin((k + 1) * std::numbers::pi * (i + 0.5) / count +
                                     each[static_cast<std::size_t>(k)])});
    }
  }
  joint.tangential_per_area = 2 * lowest * random.logarithmic(0.1, 1.5) / count;
  scene::Direction force{{0, 1.0}};
  for (int k = 1; k < modes; ++k) force.push_back({k, random.between(-1, 1)});
  s.excitation.push_back({"f", &scene::force_type(), {force}, {1, 0}, 1});
  s.response() = {{0, 1.0}, {1, random.between(-1, 1)}};
}

// A chain of masses on a bed of springs, each with a contact to the ground; their tangential and normal
// displacements are coupled.
void chain(Random& random, int count, Joint& joint) {
  scene::Scene& s = joint.scene;
  const int directions = joint.tangential + (joint.has_normal ? 1 : 0);
  const double stiffness = random.logarithmic(1e3, 1e5), bed = stiffness * random.logarithmic(0.05, 0.5);
  const double damping = 2 * random.logarithmic(0.003, 0.02) * std::sqrt(bed);
  for (int i = 0; i < count; ++i) {
    Contact& contact = joint.contacts.emplace_back();
    for (int d = 0; d < directions; ++d) {
      const int at = static_cast<int>(s.dofs.size());
      s.dofs.push_back("u" + std::to_string(i) + std::string(1, "xyz"[d]));
      add_part(s.masses, "m", scene::mass_type(), {{at, 1.0}}, random.between(0.7, 1.4));
      add_part(s.springs, "k", scene::spring_type(), {{at, 1.0}}, bed * random.between(0.7, 1.4));
      add_part(s.dampers, "c", scene::damper_type(), {{at, 1.0}}, damping * random.between(0.7, 1.4));
      if (i > 0)
        add_part(s.springs, "k", scene::spring_type(), {{at, 1.0}, {at - directions, -1.0}},
                 stiffness * random.between(0.7, 1.4));
      if (d > 0)
        add_part(s.springs, "k", scene::spring_type(), {{at - 1, 1.0}, {at, random.between(-1, 1)}},
                 bed * random.between(0.1, 0.5));
      contact.directions.push_back({{at, 1.0}});
    }
  }
  joint.tangential_per_area = bed * random.logarithmic(0.2, 2);
  const int driven = directions * random.count(0, count - 1);
  s.excitation.push_back({"f", &scene::force_type(), {{{driven, 1.0}}}, {1, 0}, 1});
  s.response() = {{directions * random.count(0, count - 1), 1.0}};
}

double along(const scene::Direction& direction, const Eigen::VectorXd& x) {
  double sum = 0;
  for (const scene::Term& term : direction) sum += term.weight * x[term.dof];
  return sum;
}

Eigen::MatrixXd sum_of(const std::vector<scene::Part>& parts, Eigen::Index dofs) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dofs, dofs);
  for (const scene::Part& part : parts)
    for (const scene::Term& a : part.directions[0])
      for (const scene::Term& b : part.directions[0])
        sum(a.dof, b.dof) += part.values[0] * a.weight * b.weight;
  return sum;
}

struct FirstMode {
  double frequency;           // rad/s
  Eigen::VectorXd resonance;  // the motion at resonance, by damping alone
};

// With the contacts closed; stuck: and at rest.
FirstMode first_mode(const Joint& joint, bool stuck) {
  const scene::Scene& s = joint.scene;
  const auto dofs = static_cast<Eigen::Index>(s.dofs.size());
  std::vector<scene::Part> springs = s.springs;
  for (const Contact& contact : joint.contacts)
    for (std::size_t d = 0; d < contact.directions.size(); ++d) {
      const bool is_normal = static_cast<int>(d) == joint.tangential;
      if (is_normal || stuck)
        add_part(springs, "k", scene::spring_type(), contact.directions[d],
                 is_normal ? contact.normal : contact.tangential);
    }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(sum_of(springs, dofs),
                                                                        sum_of(s.masses, dofs));
  const Eigen::VectorXd shape = modes.eigenvectors().col(0);
  const double frequency = std::sqrt(modes.eigenvalues()[0]);
  const double damping = shape.dot(sum_of(s.dampers, dofs) * shape);
  return {frequency, shape * (along(s.excitation[0].directions[0], shape) / (damping * frequency))};
}

// Stiffnesses of the areas, and loads with which the motion stuck at resonance reaches the limits of friction
// to a share that lies between a tenth and a hundredfold, and hardly opens a contact.
void size_contacts(Random& random, Joint& joint) {
  joint.friction = random.between(0.1, 0.7);
  joint.normal_per_area = joint.tangential_per_area * random.logarithmic(0.5, 2);
  const double level = random.logarithmic(0.01, 3);
  for (Contact& contact : joint.contacts) {
    contact.area = random.between(0.5, 2);
    contact.tangential = joint.tangential_per_area * contact.area;
    contact.normal = joint.normal_per_area * contact.area;
  }
  const Eigen::VectorXd motion = first_mode(joint, true).resonance;
  std::vector<double> forces;
  for (const Contact& contact : joint.contacts) {
    double square = 0;
    for (int d = 0; d < joint.tangential; ++d)
      square += std::pow(along(contact.directions[static_cast<std::size_t>(d)], motion), 2);
    forces.push_back(contact.tangential * std::sqrt(square));
  }
  const double largest = *std::max_element(forces.begin(), forces.end());
  double share = 0;  // of the normal load that varies
  for (std::size_t i = 0; i < forces.size(); ++i) {
    Contact& contact = joint.contacts[i];
    contact.load = std::max(forces[i], 0.1 * largest) * level * random.logarithmic(0.4, 2.5) / joint.friction;
    if (joint.has_normal)
      share =
          std::max(share, contact.normal * std::abs(along(contact.directions.back(), motion)) / contact.load);
  }
  const double less = joint.has_normal ? std::min(1.0, random.between(0.2, 1.5) / share) : 1;
  joint.normal_per_area *= less;
  for (Contact& contact : joint.contacts) contact.normal *= less;
}

void add_contacts(Random& random, const scene::PartType* law, Joint& joint) {
  scene::Scene& s = joint.scene;
  if (random.one_in(2)) {
    scene::PatchOptions options{.law = law};
    options.details = random.one_in(2);
    options.file.path = "joint.csv";
    options.fields = scene::patch_fields(*law, {});
    for (const Contact& each : joint.contacts)
      options.rows.push_back({"joint." + std::to_string(options.rows.size() + 1), each.directions, each.area,
                              0, each.load / each.area});
    scene::Part patch{"joint", &scene::patch_type(), {}, {joint.tangential_per_area}};
    if (joint.has_normal) patch.values.push_back(joint.normal_per_area);
    patch.values.insert(patch.values.end(), {joint.friction, 1.0});
    patch.options = scene::Settings::of(options);
    s.patches.push_back(patch);
    return;
  }
  for (const Contact& each : joint.contacts) {
    scene::Part part{"e" + std::to_string(s.elements.size()), law, each.directions, {each.tangential}};
    if (joint.has_normal) part.values.push_back(each.normal);
    part.values.insert(part.values.end(), {joint.friction, each.load});
    s.elements.push_back(part);
  }
}

// A joint with a study of its response about its first resonance, one in four for three levels of the force.
scene::Scene random_joint(std::uint64_t seed) {
  Random random(seed);
  Joint joint;
  const scene::PartType* law = law_of(seed);
  joint.has_normal = law != &elements::jenkins();
  joint.tangential = law == &elements::contact_3d() ? 2 : 1;
  scene::Scene& s = joint.scene;
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const int directions = joint.tangential + (joint.has_normal ? 1 : 0);
  int count = random.count(5, 40);
  if (random.one_in(2)) {
    modal_structure(random, count, joint);
  } else {
    count = std::min(count, most_coordinates / directions);
    chain(random, count, joint);
  }
  const int unknowns_of_a_harmonic = 2 * std::min(static_cast<int>(s.dofs.size()), directions * count);
  s.harmonics.order = std::clamp(random.count(1, 5), 1, std::max(1, most_unknowns / unknowns_of_a_harmonic));
  size_contacts(random, joint);
  add_contacts(random, law, joint);
  const double slipping = first_mode(joint, false).frequency, stuck = first_mode(joint, true).frequency;
  s.studies.push_back({"frf", &studies::frf(),
                       scene::Settings::of(observables::FrequencyRange{random.between(0.8, 0.93) * slipping,
                                                                       random.between(1.07, 1.2) * stuck})});
  if (random.one_in(4)) s.studies[0].for_each = {{"f.cosine", {1, 0.3, 3}}};
  scene::check(s);
  return s;
}

Json computed(const scene::Scene& s, int threads) {
  std::stringstream text;
  results::write_json(text, studies::run(s, {.threads = threads}));
  Json all = Json::parse(text.str());
  for (Json& branch : all["branches"]) branch["solver"].erase("seconds");
  return all;
}

struct InTime {
  double amplitude = 0, error = 0;
  bool complete = true;
};

// Between events, exactly, where all is piecewise linear, and of contacts in planes in steps, whose error is
// of the square of their length. start: the amplitude from which it starts; 0: from rest.
InTime in_time(const scene::Scene& s, double frequency, double start) {
  observables::TimeSettings settings{.frequency = frequency, .steps = 256, .start_amplitude = start};
  const bool in_steps = scene::all_elements(s).front().type == &elements::contact_3d();
  if (in_steps) settings.method = observables::TimeMethod::newmark_shooting;
  InTime found;
  const auto next = [&] {
    const auto motion = observables::motion_in_time(s, settings);
    CAPTURE(settings.steps, motion.stop.message);
    found.complete = found.complete && motion.status == observables::Status::complete;
    CHECK(found.complete);
    settings.steps *= 2;
    return motion.amplitude;
  };
  if (!in_steps) {
    found.amplitude = next();
    return found;
  }
  const double coarse = next(), fine = next(), finest = next();
  found.amplitude = (4 * finest - fine) / 3;
  found.error = std::abs(found.amplitude - (4 * fine - coarse) / 3);
  return found;
}

// The highest point of a branch, and on both sides of it the first one that has 0.8 of its amplitude.
std::vector<Json> about_the_peak(const Json& branch) {
  const auto& points = branch["points"];
  const auto amplitude = [&](std::size_t i) { return points[i]["amplitude"].get<double>(); };
  std::size_t peak = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (amplitude(i) > amplitude(peak)) peak = i;
  std::size_t left = peak, right = peak;
  while (left > 0 && amplitude(left) > 0.8 * amplitude(peak)) --left;
  while (right + 1 < points.size() && amplitude(right) > 0.8 * amplitude(peak)) ++right;
  return {points[left], points[peak], points[right]};
}

struct Compared {
  int points = 0, flagged = 0, above_twice = 0, above_ten_times = 0, of_flagged_far = 0, other_motions = 0;
};

void compare(const scene::Scene& s, const Json& branch, Compared& to) {
  for (const Json& point : about_the_peak(branch)) {
    const double frequency = point["frequency"], amplitude = point["amplitude"],
                 estimate = point["truncation_estimate"];
    const bool flagged = point["truncation_flagged"];
    CAPTURE(frequency, amplitude, estimate, flagged);
    const auto error_of = [&](const InTime& motion) {
      return std::max(0.0, std::abs(amplitude - motion.amplitude) - motion.error - 1e-8 * amplitude);
    };
    InTime motion = in_time(s, frequency, 0);
    if (error_of(motion) > std::max(2 * estimate, 0.05 * amplitude)) {
      motion = in_time(s, frequency, amplitude);  // of several motions that next to this one
      ++to.other_motions;
    }
    const double error = error_of(motion);
    CAPTURE(motion.amplitude, motion.error, error);
    to.flagged += flagged;
    to.of_flagged_far += flagged && error > 0.1 * amplitude;
    if (flagged) continue;
    ++to.points;
    to.above_twice += error > 2 * estimate;
    to.above_ten_times += error > 10 * estimate;
  }
}

}  // namespace

namespace {

void check_in_threads(std::uint64_t seed) {
  const scene::Scene s = random_joint(seed);
  const Json alone = computed(s, 1);
  CAPTURE(seed, scene::all_elements(s).size());
  for (const Json& branch : alone["branches"]) {
    CAPTURE(branch["stop"].dump());
    CHECK(branch["status"] == "complete");
  }
  const std::string text = alone.dump();
  for (const int threads : {2, 4}) CHECK((computed(s, threads).dump() == text));
}

}  // namespace

TEST_CASE("frequency responses of random joints are complete, and the same in one, two and four threads") {
  for (std::uint64_t seed = first; seed <= last; ++seed) check_in_threads(seed);
}

TEST_CASE(
    "joints whose contacts move nearly alike, or whose matrices several threads factorize, are computed") {
  for (const std::uint64_t seed : {22, 48, 117}) check_in_threads(seed);
}

TEST_CASE("frequency responses of random joints are those of integration in time within their estimates") {
  Compared all;
  for (std::uint64_t seed = first; seed <= last; seed += integrated_every) {
    CAPTURE(seed);
    scene::Scene s = random_joint(seed);
    s.studies[0].for_each.clear();
    const Json branch = computed(s, 1)["branches"][0];
    CAPTURE(branch["stop"].dump());
    CHECK(branch["status"] == "complete");
    compare(s, branch, all);
  }
  CAPTURE(all.points, all.flagged, all.above_twice, all.above_ten_times, all.of_flagged_far,
          all.other_motions);
  CHECK(all.points > 0);
  CHECK(100 * (all.above_twice - 1) <= all.points);  // one more by chance, where they are few
  CHECK(all.above_ten_times == 0);
  CHECK(all.of_flagged_far == 0);
}
