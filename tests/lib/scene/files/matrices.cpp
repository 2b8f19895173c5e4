// Structures from matrices in files: next to the same structures of masses and springs, and their faults.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/model/reduction_report.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <sstream>

using namespace arcslip;

namespace {

// A chain of five masses of 1 to 1.4 kg, held at its left end by the first of springs of 1000 to 1400 N/m.
std::string mass_file() {
  std::string text = "%%MatrixMarket matrix coordinate real symmetric\n5 5 5\n";
  for (int i = 1; i <= 5; ++i)
    text += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(0.9 + 0.1 * i) + "\n";
  return text;
}
std::string stiffness_file() {
  std::string text = "%%MatrixMarket matrix coordinate real symmetric\n5 5 9\n";
  for (int i = 1; i <= 5; ++i) {
    const int own = 900 + 100 * i, next = i < 5 ? own + 100 : 0;
    text += std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(own + next) + "\n";
    if (i < 5) text += std::to_string(i + 1) + " " + std::to_string(i) + " " + std::to_string(-next) + "\n";
  }
  return text;
}
std::string damping_file() {
  return "%%MatrixMarket matrix coordinate real general\n5 5 4\n2 2 0.3\n3 3 0.3\n2 3 -0.3\n3 2 -0.3\n";
}

Folder chain_files() {
  return {{"M.mtx", mass_file()},
          {"K.mtx", stiffness_file()},
          {"C.mtx", damping_file()},
          {"names.csv", "name,row\n# the free end, then the one that rubs\nend.x, 5\nb,2\n"}};
}

constexpr const char* files = R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "damping": "C.mtx"},
  "names": "names.csv", "dofs": ["tuned"],
  "masses": [{"name": "m_t", "at": "tuned", "value": 0.1}, {"name": "tip", "at": "end.x", "value": 0.2}],
  "springs": [{"name": "k_t", "between": ["tuned", "end.x"], "value": 60}])";
constexpr const char* parts = R"("dofs": ["a", "b", "c", "d", "end.x", "tuned"],
  "masses": [{"name": "m1", "at": "a", "value": 1}, {"name": "m2", "at": "b", "value": 1.1},
    {"name": "m3", "at": "c", "value": 1.2}, {"name": "m4", "at": "d", "value": 1.3},
    {"name": "m5", "at": "end.x", "value": 1.4}, {"name": "m_t", "at": "tuned", "value": 0.1},
    {"name": "tip", "at": "end.x", "value": 0.2}],
  "springs": [{"name": "k1", "at": "a", "value": 1000}, {"name": "k2", "between": ["b", "a"], "value": 1100},
    {"name": "k3", "between": ["c", "b"], "value": 1200}, {"name": "k4", "between": ["d", "c"], "value": 1300},
    {"name": "k5", "between": ["end.x", "d"], "value": 1400},
    {"name": "k_t", "between": ["tuned", "end.x"], "value": 60}],
  "dampers": [{"name": "c3", "between": ["c", "b"], "value": 0.3}])";

std::string scene_of(const std::string& structure) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {)" + structure + R"(},
    "elements": [{"name": "d", "type": "jenkins", "at": "b", "stiffness": 300, "friction_coefficient": 0.5,
                  "normal_load": 0.4}],
    "excitation": [{"name": "f", "at": "end.x", "cosine": 1}],
    "response": {"at": "end.x"}, "harmonics": {"order": 5},
    "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

std::string fault_in_folder(const std::string& structure, const Folder& folder) {
  try {
    observables::prepare(scenes::parse(scene_of(structure), folder.path()), {});
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

void check_same(const scene::Scene& one, const scene::Scene& other, double tolerance) {
  for (const double omega : {3.0, 8.0, 14.0, 33.0}) {
    CAPTURE(omega);
    const auto a = scenes::response_at(one, omega), b = scenes::response_at(other, omega);
    CHECK(b.amplitude == Approx(a.amplitude).epsilon(tolerance));
    CHECK(b.energy_viscous == Approx(a.energy_viscous).epsilon(10 * tolerance));
    CHECK(b.energy_input == Approx(a.energy_input).epsilon(10 * tolerance));
    CHECK(b.forces.inertia == Approx(a.forces.inertia).epsilon(10 * tolerance));
    CHECK(b.forces.viscous == Approx(a.forces.viscous).epsilon(10 * tolerance));
    CHECK(b.truncation_estimate == Approx(a.truncation_estimate).epsilon(1e-6).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("a structure from matrices is that of its masses and springs") {
  const Folder folder = chain_files();
  const scene::Scene by_parts = scenes::parse(scene_of(parts), folder.path());
  SECTION("whole") {
    check_same(by_parts, scenes::parse(scene_of(files), folder.path()), 1e-11);
  }
  SECTION("reduced to the rows that the scene uses") {
    std::string text = scene_of(files);
    text.replace(text.find("\"damping\": \"C"), 0, "\"highest_frequency\": 200, ");
    scene::Scene s = scenes::parse(text, folder.path());
    CHECK(contains(observables::prepare(s, {}), "of 5 rows was reduced to 2 of them and 3 coordinates"));
    check_same(by_parts, s, 1e-10);
  }
}

TEST_CASE("a long structure from matrices with dampers anywhere is that of its masses and springs") {
  constexpr int masses = 60;
  const auto number = [](int i) { return std::to_string(i); };
  std::string M, K, dofs, by_mass, springs;
  for (int i = 1; i <= masses; ++i) {
    const std::string n = number(i), comma = i > 1 ? ", " : "";
    M += n + " " + n + " " + number(1 + i % 3) + "\n";
    K += n + " " + n + " " + number(i < masses ? 2000 : 1000) + "\n";
    if (i < masses) K += number(i + 1) + " " + n + " -1000\n";
    dofs += comma + "\"x" + n + "\"";
    by_mass +=
        comma + R"({"name": "m)" + n + R"(", "at": "x)" + n + R"(", "value": )" + number(1 + i % 3) + "}";
    springs += comma + R"({"name": "k)" + n + R"(", "value": 1000, )" +
               (i > 1 ? R"("between": ["x)" + n + R"(", "x)" + number(i - 1) + R"("]})" : R"("at": "x1"})");
  }
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n60 60 ";
  std::string names = "name,row\n";
  for (const int i : {2, 20, 41, 42, 60}) names += "x" + number(i) + "," + number(i) + "\n";
  const Folder folder{{"M.mtx", head + "60\n" + M},
                      {"K.mtx", head + "119\n" + K},
                      {"C.mtx", head + "3\n20 20 2\n42 42 2\n42 20 -2\n"},
                      {"names.csv", names}};
  // Next to the matrix of dampers one of the scene.
  const std::string tip = R"({"name": "tip", "between": ["x60", "x41"], "value": 3})";
  const auto scene = [&](const std::string& structure) {
    return scenes::parse(
        R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {)" + structure + R"(},
      "elements": [{"name": "d", "type": "jenkins", "at": "x2", "stiffness": 300, "friction_coefficient": 0.5,
                    "normal_load": 0.4}],
      "excitation": [{"name": "f", "at": "x60", "cosine": 1}],
      "response": {"at": "x60"}, "harmonics": {"order": 5}})",
        folder.path());
  };
  const scene::Scene by_parts =
      scene(R"("dofs": [)" + dofs + R"(], "masses": [)" + by_mass + R"(], "springs": [)" + springs +
            R"(], "dampers": [{"name": "c", "between": ["x42", "x20"], "value": 2}, )" + tip + "]");
  const std::string from_files = R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "damping": "C.mtx")";
  const std::string rest = R"(}, "names": "names.csv", "dampers": [)" + tip + "]";
  SECTION("whole") {
    check_same(by_parts, scene(from_files + rest), 1e-10);
  }
  SECTION("reduced") {
    check_same(by_parts, scene(from_files + R"(, "highest_frequency": 170)" + rest), 1e-9);
  }
}

TEST_CASE("rigid friction stops the same motions of matrices alone as of masses and springs") {
  const Folder folder = chain_files();
  const auto with_rigid_friction = [&](const std::string& structure) {
    std::string text = scene_of(structure);
    text.replace(text.find("\"jenkins\""), 9, "\"coulomb\"");
    text.erase(text.find("\"stiffness\": 300, "), 18);
    return scenes::parse(text, folder.path());
  };
  scene::Scene masses = with_rigid_friction(parts);
  masses.dofs.pop_back();  // with what acts on it alone, and the mass at the tip
  masses.masses.erase(masses.masses.begin() + 5, masses.masses.end());
  masses.springs.pop_back();
  const std::string key = GENERATE("", R"(, "highest_frequency": 200)");
  const scene::Scene matrices =
      with_rigid_friction(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "damping": "C.mtx")" + key +
                          R"(}, "names": "names.csv")");
  int stopped = 0, going_on = 0;
  for (const double omega : {3.0, 5.0, 8.0, 12.0, 14.0, 20.0, 26.0, 33.0}) {
    const auto one = scenes::response_at(masses, omega), other = scenes::response_at(matrices, omega);
    CAPTURE(omega, key, one.amplitude);
    CHECK(other.amplitude == Approx(one.amplitude).epsilon(1e-9));
    CHECK(other.stops == one.stops);
    ++(one.stops.empty() ? going_on : stopped);
  }
  CHECK(stopped > 0);
  CHECK(going_on > 0);
}

TEST_CASE("damping in proportion to the structure is that of its dampers") {
  const Folder folder = chain_files();
  std::string structure = files;
  structure.erase(structure.find(", \"damping\": \"C.mtx\""), 20);
  const std::string rayleigh = R"(, "damping": [{"name": "steel", "type": "rayleigh", "beta": 2e-3}])";
  std::string dampers = parts;
  dampers.erase(dampers.find("\"dampers\""));
  dampers +=
      R"("dampers": [{"name": "c1", "at": "a", "value": 2}, {"name": "c2", "between": ["b", "a"], "value": 2.2},
    {"name": "c3", "between": ["c", "b"], "value": 2.4}, {"name": "c4", "between": ["d", "c"], "value": 2.6},
    {"name": "c5", "between": ["end.x", "d"], "value": 2.8},
    {"name": "c_t", "between": ["tuned", "end.x"], "value": 0.12}])";
  const scene::Scene by_parts = scenes::parse(scene_of(dampers), folder.path());
  check_same(by_parts, scenes::parse(scene_of(structure + rayleigh), folder.path()), 1e-11);
  // The parameter is one of the scene.
  scene::Scene s = scenes::parse(
      scene_of(structure + R"(, "damping": [{"name": "steel", "type": "rayleigh", "alpha": 0.5}])"),
      folder.path());
  scene::set(s, "steel.alpha", 0);
  scene::set(s, "steel.beta", 2e-3);
  check_same(by_parts, s, 1e-11);
}

TEST_CASE("a scene with matrices is written, read, checked and hashed with its files") {
  const Folder folder = chain_files();
  const scene::Scene s = scenes::parse(scene_of(files), folder.path());
  CHECK(s.dofs == std::vector<std::string>{"end.x", "b", "tuned"});
  CHECK(s.matrices->rows == std::vector<int>{4, 1});
  CHECK(scenes::parse(scene::write(s), folder.path()) == s);
  scene::check(s);
  const std::string hash = scene::hash(s);
  folder.write("out/scene.json", "");
  const scene::Scene moved = scene::from_folder(s, folder / "out");
  CHECK(contains(scene::write(moved), "\"../K.mtx\""));
  CHECK(scene::hash(moved) == hash);
  CHECK(contains(scene::json_schema(test_catalogue::whole()), "\"highest_frequency\""));
  std::string changed = stiffness_file();
  changed.replace(changed.find("2100"), 4, "2101");
  folder.write("K.mtx", changed);
  CHECK(scene::hash(scenes::parse(scene_of(files), folder.path())) != hash);
}

namespace {

std::string files_reduced(const std::string& reduction, const std::string& highest = "200") {
  std::string text = files;
  text.insert(text.find("\"damping\": \"C"),
              (highest.empty() ? "" : "\"highest_frequency\": " + highest + ", ") +
                  "\"reduction\": " + reduction + ", ");
  return text;
}

}  // namespace

TEST_CASE("a structure reduced by all of its modes is that of its masses and springs") {
  const Folder folder = chain_files();
  const scene::Scene by_parts = scenes::parse(scene_of(parts), folder.path());
  const auto reduced = [&](const std::string& reduction) {
    return scenes::parse(scene_of(files_reduced(reduction)), folder.path());
  };
  const scene::Scene fixed = reduced(R"({"method": "craig_bampton", "modes": 3})");
  CHECK(contains(observables::prepare(fixed, {}),
                 "of 5 rows was reduced to 2 of them and 3 coordinates of fixed-interface modes; error of"));
  check_same(by_parts, fixed, 1e-10);
  // The five natural frequencies are from 9 to 64 rad/s.
  const scene::Scene free = reduced(R"({"method": "rubin", "cutoff": 50})");
  CHECK(contains(observables::prepare(free, {}),
                 "of 5 rows was reduced to 2 of them and 3 coordinates of free-interface modes; error of"));
  check_same(by_parts, free, 1e-10);
  const scene::Scene one = reduced(R"({"method": "craig_bampton", "modes": 1})");
  CHECK(contains(observables::prepare(one, {}), "and 1 coordinates of fixed-interface modes"));
  CHECK(scenes::response_at(one, 3).amplitude ==
        Approx(scenes::response_at(by_parts, 3).amplitude).epsilon(2e-3));  // next to statics
  CHECK(contains(observables::prepare(reduced(R"({"accuracy": 1e-6})"), {}), "and 3 coordinates; error of"));
}

TEST_CASE("how matrices are reduced is written, read, hashed and in the schema") {
  const Folder folder = chain_files();
  const std::string plain = scene::hash(scenes::parse(scene_of(files_reduced("{}")), folder.path()));
  for (const std::string reduction :
       {R"({"method": "krylov", "accuracy": 0.0001})", R"({"method": "craig_bampton", "modes": 0})",
        R"({"method": "rubin", "cutoff": 50.0})"}) {
    const scene::Scene s = scenes::parse(scene_of(files_reduced(reduction)), folder.path());
    CAPTURE(reduction, scene::write(s));
    CHECK(scenes::parse(scene::write(s), folder.path()) == s);
    CHECK(scene::hash(s) != plain);
    CHECK(scene::write(s).find("\"reduction\"") != std::string::npos);
  }
  CHECK(contains(scene::json_schema(test_catalogue::whole()), "\"craig_bampton\""));
}

TEST_CASE("the errors of a reduction that made the matrices are written, read, hashed and doubted") {
  const Folder folder = chain_files();
  const auto with = [&](const std::string& errors) {
    std::string text = files;
    text.insert(text.find("\"damping\": \"C"), "\"errors\": " + errors + ", ");
    return text;
  };
  const scene::Scene s = scenes::parse(scene_of(with("[[20, 1e-5], [200, 0.03]]")), folder.path());
  CHECK(s.matrices->errors == std::vector<scene::ErrorOfReduction>{{20, 1e-5}, {200, 0.03}});
  CHECK(scenes::parse(scene::write(s), folder.path()) == s);
  CHECK(scene::hash(s) != scene::hash(scenes::parse(scene_of(files), folder.path())));
  CHECK(contains(scene::json_schema(test_catalogue::whole()), "\"errors\""));
  CHECK(observables::error_of_reduction(s, 20)->error == 1e-5);
  CHECK(observables::error_of_reduction(s, 21)->error == 0.03);
  CHECK(observables::error_of_reduction(s, 0)->error == 0.03);
  CHECK(!observables::error_of_reduction(scenes::parse(scene_of(files), folder.path()), 20));
  const auto fault = [&](const std::string& errors) { return fault_in_folder(with(errors), folder); };
  CHECK(contains(fault("3"), "/structure/matrices/errors: found "));
  CHECK(contains(fault("[[20]]"),
                 "/structure/matrices/errors/0: found a list of 1, must be a list of 2 numbers, a "
                 "frequency and the error up to it"));
  CHECK(contains(fault("[[20, -1]]"), "/structure/matrices/errors/0/1: found -1"));
  CHECK(contains(fault("[[20, 1], [20, 2]]"),
                 "/structure/matrices/errors/1/0: found 20, must be above 20, the frequency before it"));
}

TEST_CASE(
    "the error of modes up to a lower frequency is that of a reduction up to there with the same modes") {
  const Folder folder = chain_files();
  const auto reduced = [&](const std::string& highest, const std::string& reduction) {
    return scenes::parse(scene_of(files_reduced(reduction, highest)), folder.path());
  };
  const scene::Scene s = reduced("40", R"({"method": "craig_bampton", "cutoff": 25})");
  const auto all = observables::error_of_reduction(s, 0), low = observables::error_of_reduction(s, 5),
             beyond = observables::error_of_reduction(s, 50);
  const auto of_low = observables::reduction(reduced("5", R"({"method": "craig_bampton", "cutoff": 25})"));
  CHECK(all->frequency == 40);
  CHECK(beyond->frequency == 40);
  CHECK(beyond->error == all->error);
  CHECK(low->frequency == 5);
  CHECK(low->error == of_low->error);
  CHECK(low->error < 0.01 * all->error);
}

TEST_CASE("faults of how matrices are reduced name the key") {
  const Folder folder = chain_files();
  const auto fault = [&](const std::string& reduction, const std::string& highest = "200") {
    return fault_in_folder(files_reduced(reduction, highest), folder);
  };
  CHECK(fault("{}") == "none");
  CHECK(contains(fault("3"), "/structure/matrices/reduction: found "));
  CHECK(contains(fault("{}", ""), "/structure/matrices/reduction: found it without \"highest_frequency\""));
  CHECK(contains(fault(R"({"method": "guyan"})"),
                 "/structure/matrices/reduction/method: found \"guyan\", must be "));
  CHECK(contains(fault(R"({"mode": 3})"), "did you mean \"modes\"?"));
  CHECK(contains(fault(R"({"accuracy": 1e-12})"), "/structure/matrices/reduction/accuracy: found 1e-12"));
  CHECK(contains(fault(R"({"method": "rubin", "modes": -1})"),
                 "/structure/matrices/reduction/modes: found -1"));
  CHECK(contains(fault(R"({"method": "rubin", "cutoff": 0})"),
                 "/structure/matrices/reduction/cutoff: found 0"));
  CHECK(contains(fault(R"({"method": "rubin", "accuracy": 1e-5})"),
                 "/accuracy: found the key \"accuracy\" next to the method \"rubin\", must be left out"));
  CHECK(contains(fault(R"({"modes": 3})"),
                 "/modes: found the key \"modes\" next to the method \"krylov\", must be left out"));
  CHECK(contains(fault(R"({"cutoff": 3})"), "/cutoff: found the key \"cutoff\" next to the method"));
  CHECK(contains(fault(R"({"method": "rubin", "modes": 3, "cutoff": 3})"),
                 "/modes: found the key \"modes\" next to \"cutoff\", must be one of them"));
}

TEST_CASE("what is wrong with matrices is reported with file, line and cause") {
  const Folder folder = chain_files();
  const auto with = [&](const std::string& name, const std::string& text) {
    const Folder own = chain_files();
    own.write(name, text);
    return fault_in_folder(files, own);
  };
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  CHECK(fault_in_folder(files, folder) == "none");
  CHECK(contains(with("K.mtx", "nothing"), "/structure/matrices/stiffness: \"K.mtx\", line 1"));
  CHECK(contains(with("K.mtx", head + "2 2 1\n1 1 nan\n"), "\"K.mtx\", line 3: found \"nan\""));
  CHECK(contains(with("M.mtx", head + "2 2 2\n1 1 1\n2 2 1\n"),
                 "/structure/matrices/mass: found a matrix of 2 rows, must have 5 as the stiffness matrix"));
  CHECK(contains(
      with("C.mtx", head + "5 5 2\n1 2 0.5\n2 1 0.4\n"),
      "/structure/matrices/damping: found the damping matrix with 0.4 in row 2, column 1 and 0.5 in row "
      "1, column 2, must be symmetric"));
  CHECK(contains(with("C.mtx", head + "5 5 1\n1 2 0.5\n"), "must be symmetric"));
  CHECK(contains(with("C.mtx", head + "5 5 2\n1 2 0.5\n2 1 0\n"),
                 "with 0.5 in row 1, column 2 and 0 in row 2, column 1, must be symmetric"));
  CHECK(contains(with("C.mtx", head + "5 5 4\n1 1 1e300\n2 2 1e300\n1 2 1e300\n2 1 0.9e300\n"),
                 "with 9e+299 in row 2, column 1 and 1e+300 in row 1, column 2, must be symmetric"));
  CHECK(contains(with("C.mtx", head + "5 5 5\n1 2 1\n1 3 2\n5 1 3\n1 4 4\n3 2 5\n"),
                 "with 3 in row 5, column 1 and 0 in row 1, column 5; 1 in row 1, column 2 and 0 in row 2, "
                 "column 1; 5 in row 3, column 2 and 0 in row 2, column 3; and 2 more, must be symmetric"));
  CHECK(contains(
      with("M.mtx", head + "5 5 5\n1 1 -1\n2 2 -2\n3 3 -3\n4 4 -4\n5 5 -5\n"),
      "with -1 in row 1, column 1; -2 in row 2, column 2; -3 in row 3, column 3; and 2 more, must be "
      "positive semidefinite: no negative entry on the diagonal"));
  CHECK(contains(with("M.mtx", head + "5 5 1\n3 3 -1\n"),
                 "found the mass matrix with -1 in row 3, column 3, must be positive semidefinite"));
  CHECK(contains(with("M.mtx", head + "5 4 1\n3 3 1\n"), "with 5 rows and 4 columns, must be square"));
  CHECK(contains(with("M.mtx", head + "5 5 0\n"), "/structure/matrices/mass: found no mass"));
  {
    const Folder own = chain_files();
    own.write("M.mtx", head + "5 5 1\n5 5 1\n");
    own.write("K.mtx", head + "5 5 1\n5 5 1\n");
    CHECK(contains(fault_in_folder(files, own),
                   "/structure/matrices: found neither mass nor stiffness in row 1; 2; 3; and 1 more, must "
                   "have one of them on the diagonal in each row"));
  }
  CHECK(contains(with("K.mtx", head + "6 6 1\n1 1 1\n"), "must have 6 as the stiffness matrix"));
  CHECK(contains(with("names.csv", "b,2\n"), "line 1 of \"names.csv\": found \"b,2\", must be the header"));
  CHECK(
      contains(with("names.csv", "name,row\nb,6\n"), "found the row \"6\", must be an integer from 1 to 5"));
  CHECK(contains(with("names.csv", "name,row\nb,2\nc,2\n"),
                 "found the row 2 again, which has a name in line 2"));
  CHECK(contains(with("names.csv", "name,row\nb,2\nb,3\n"), "which stands for another degree of freedom"));
  CHECK(contains(with("names.csv", "name,row\nground,2\n"), "which is reserved for the fixed frame"));
  CHECK(contains(with("names.csv", "name,row\nb,2,3\n"), "found 3 values, must be 2"));
  CHECK(contains(with("names.csv", "name,row\n"), "found no names in \"names.csv\""));
  CHECK(contains(with("names.csv", "name,row\ntuned,2\nend.x,5\nb,1\n"),
                 "which is also a row of the matrices"));
  CHECK(contains(fault_in_folder(R"("names": "names.csv", "dofs": ["a"])", folder), "without \"matrices\""));
  CHECK(contains(fault_in_folder(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx"})", folder),
                 "\"names\""));
  CHECK(
      contains(fault_in_folder(
                   R"("matrices": {"mass": "none.mtx", "stiffness": "K.mtx"}, "names": "names.csv")", folder),
               "found \"none.mtx\", which cannot be read"));
}

TEST_CASE("motions of the ground are refused with matrices without a shape") {
  const Folder folder = chain_files();
  std::string text = scene_of(files);
  text.replace(text.find("\"at\": \"end.x\", \"cosine\": 1"), 26,
               "\"type\": \"base_acceleration\", \"cosine\": 1");
  try {
    scenes::parse(text, folder.path());
    FAIL("accepted");
  } catch (const scene::SceneError& error) {
    CHECK(contains(error.what(), "/excitation/0/type: found \"base_acceleration\" without \"shape\""));
  }
}

TEST_CASE("a structure that cannot be reduced is reported with the row at fault") {
  const Folder folder = chain_files();
  std::string text = stiffness_file();
  text.replace(text.find("4 3 -1300"), 9, "4 3 -9300");  // indefinite, in rows that are not kept
  folder.write("K.mtx", text);
  CHECK(contains(
      fault_in_folder(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "highest_frequency": 10},
                       "names": "names.csv")",
                      folder),
      "/structure/matrices: the matrices cannot be reduced"));
}

TEST_CASE(
    "a structure whose lowest natural frequency is lost in the last digits of its entries is reported") {
  const Folder folder = chain_files();
  folder.write("M.mtx",
               "%%MatrixMarket matrix coordinate real symmetric\n5 5 5\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n5 5 1\n");
  std::string text = "%%MatrixMarket matrix coordinate real symmetric\n5 5 9\n1 1 1000000000001\n";
  for (int i = 2; i <= 5; ++i) {
    const std::string row = std::to_string(i), before = std::to_string(i - 1);
    text += row + " " + row + (i < 5 ? " 2e12\n" : " 1e12\n") + row + " " + before + " -1e12\n";
  }
  folder.write("K.mtx", text);
  CHECK(contains(
      fault_in_folder(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "highest_frequency": 10},
                       "names": "names.csv")",
                      folder),
      "/structure/matrices: the matrices cannot be reduced: the last digits of their entries"));
}

TEST_CASE("a structure that floats says so, and drifts by its name where it has one") {
  const Folder folder = chain_files();
  const auto first_message = [&](const std::string& key) {
    std::string whole = scene_of(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx")" + key +
                                 R"(}, "names": "names.csv")");
    whole.replace(whole.find("\"cosine\": 1"), 11, "\"cosine\": 1, \"harmonic\": 2");
    const scene::Scene s = scenes::parse(whole, folder.path());
    return observables::prepare(s, {}) + "\n" +
           observables::frequency_response(s, {2, 20}).at(0).stop.message;
  };
  const std::string reduced = R"(, "highest_frequency": 200)",
                    free = " are not distinguished from 0, that of motions as a rigid body";
  CHECK_FALSE(contains(first_message(reduced), free));
  // Without the spring to the ground, then with a part of its own that has no name.
  std::string text = stiffness_file();
  text.replace(text.find("1 1 2100"), 8, "1 1 1100");
  folder.write("K.mtx", text);
  CHECK(contains(first_message(reduced), free));
  for (const std::string& key : {std::string(), reduced})
    CHECK((contains(first_message(key), "no spring holds the mean position of \"b\"") ||
           contains(first_message(key), "no spring holds the mean position of \"end.x\"")));
  folder.write("K.mtx",
               "%%MatrixMarket matrix coordinate real symmetric\n5 5 8\n1 1 100\n2 1 -100\n2 2 100\n"
               "3 3 200\n4 3 -100\n4 4 200\n5 4 -100\n5 5 100\n");
  folder.write("names.csv", "name,row\nend.x,5\nb,4\n");
  CHECK(contains(first_message(""), "no spring holds the mean position of the structure, and friction"));
  CHECK_FALSE(contains(first_message(reduced), "no spring holds"));  // nothing links that part to the names
}

TEST_CASE("results have the reduction, and a doubt where harmonics are beyond its highest frequency") {
  const Folder folder = chain_files();
  const auto run = [&](double highest) {
    std::string text = scene_of(files);  // 5 times 20 rad/s
    text.replace(text.find("\"damping\": \"C"), 0,
                 "\"highest_frequency\": " + std::to_string(highest) + ", ");
    return studies::run(scenes::parse(text, folder.path()));
  };
  const results::Results enough = run(100), too_low = run(99);
  REQUIRE(enough.results.size() == 1);
  CHECK(enough.results[0].end.doubt.empty());
  REQUIRE(too_low.results.size() == 1);
  CHECK(too_low.results[0].end.doubt ==
        "harmonics beyond highest_frequency of the reduction: 5 times 20 rad/s is 100 rad/s, above 99 rad/s");
  std::ostringstream json;
  results::write_json(json, too_low);
  CHECK(contains(json.str(), R"("reduction": {"rows":5,"kept":2,"coordinates":3,"error":)"));
  CHECK(contains(json.str(), R"("highest_frequency":99.0})"));
  CHECK(contains(json.str(), R"("doubt": "harmonics beyond)"));
  CHECK(studies::header(scenes::parse(scene_of(files), folder.path())).reduction.empty());
}

TEST_CASE("large matrices need the highest frequency to which they are reduced") {
  const Folder folder = chain_files();
  std::string K = "%%MatrixMarket matrix coordinate real symmetric\n600 600 1199\n1 1 2\n", M = K;
  for (int i = 2; i <= 600; ++i) {
    K += std::to_string(i) + " " + std::to_string(i) + " 2\n" + std::to_string(i) + " " +
         std::to_string(i - 1) + " -1\n";
    M += std::to_string(i) + " " + std::to_string(i) + " 2\n" + std::to_string(i) + " " +
         std::to_string(i - 1) + " 0\n";
  }
  folder.write("K.mtx", K);
  folder.write("M.mtx", M);
  CHECK(contains(
      fault_in_folder(R"("matrices": {"mass": "M.mtx", "stiffness": "K.mtx"}, "names": "names.csv")", folder),
      "found matrices of 600 rows without \"highest_frequency\""));
}
