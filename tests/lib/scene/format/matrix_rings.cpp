// Matrices in several copies, and full rings of them: reading, writing, and their faults.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/scene/format/matrix_rings.hpp"
#include "lib/scene/format/only_fault.hpp"

#include <arcslip/model/model.hpp>
#include <arcslip/model/reduced_scene.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <string>
#include <vector>

using namespace arcslip;
using namespace matrix_rings;

namespace {

std::string with(std::string whole, const std::string& piece, const std::string& replacement) {
  const std::size_t at = whole.find(piece);
  REQUIRE(at != std::string::npos);
  return whole.replace(at, piece.size(), replacement);
}

std::string full(const std::string& mistuning = "") {
  std::string whole = scene_text({3, 1, "", "", friction}, Ring::full);
  return mistuning.empty() ? whole
                           : with(whole, "\"full\": true", "\"full\": true, \"mistuning\": " + mistuning);
}

// Two rows "a" and "b" of three in so many copies, which stand for themselves.
std::string row_of(const std::string& keys,
                   const std::string& excitation = R"({"name": "f", "at": "a1", "cosine": 1})") {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "matrices": {"mass": "M.mtx", "stiffness": "K.mtx")" +
         keys + R"(}, "names": "names.csv",
    "springs": [{"name": "link", "between": ["b1", "a2"], "value": 0.5}]},
    "excitation": [)" +
         excitation + R"(], "harmonics": {"order": 3}, "response": {"at": "b2"}})";
}

Folder three_rows() {
  Sector sector;
  sector.masses = {1, 2, 3};
  sector.springs = {{0, -1, 1}, {1, 0, 2}, {2, 1, 3}};
  sector.dampers = sector.stiffening = {};
  return files(sector, "name,row\na,1\nb,3\n");
}

void check_fault(const std::string& whole, const Folder& folder, const std::string& pointer,
                 const std::string& part) {
  CAPTURE(whole);
  scene::test::check_only_fault([&] { observables::prepare(read(whole, folder), {}); }, pointer, part);
}

}  // namespace

TEST_CASE("copies of matrices have the names of their rows with the number of the copy") {
  const Folder folder = files();
  const scene::Scene s = read(full(), folder);
  CHECK(s.matrices->copies == 3);
  CHECK(s.matrices->named() == 6);
  CHECK(s.dofs == std::vector<std::string>{"tip.z1", "tip.z2", "tip.z3", "hub1", "hub2", "hub3", "pad1",
                                           "pad2", "pad3"});
  CHECK(s.springs[8].directions[0] == scene::Direction{{5, 1.0}, {3, -1.0}});
  CHECK(s.elements[2].directions[0] == scene::Direction{{2, 1.0}, {0, -1.0}});
  CHECK(s.responses[1].direction == scene::Direction{{1, 1.0}});
  const model::Model model = model::build(s);
  CHECK(model.dofs == 3 * 5);
  CHECK(model.dof_names[7] == "row 3 of copy 1");
}

TEST_CASE("a full ring from matrices is written so that it is read again, and its hash has all of it") {
  const Folder folder = files();
  std::string hash;
  for (const std::string& mistuning :
       {std::string(), std::string(R"({"matrices.stiffness": [1, 1.1, 0.9]})"),
        std::string(R"({"matrices.stiffness": [1, 1.1, 0.95], "link.value": [1, 2, 1]})")}) {
    const scene::Scene s = read(full(mistuning), folder);
    CHECK(read(scene::write(s), folder) == s);
    scene::check(s);
    CHECK(contains(scene::write(s), "\"copies\": 3"));
    CHECK(contains(scene::write(s), "\"stiffness_factors\": ") == !mistuning.empty());
    CHECK(scene::hash(s) != hash);
    hash = scene::hash(s);
    CHECK(scene::hash(scene::from_folder(s, folder / "out")) == hash);
  }
  CHECK_FALSE(contains(scene::write(read(scene_text({}, Ring::sector), folder)), "copies"));
  for (const char* key : {"\"copies\"", "\"stiffness_factors\"", "\"copy\""})
    CHECK(contains(scene::json_schema(test_catalogue::whole()), key));
}

TEST_CASE("the parameters of a full ring from matrices are those of its parts, tied unless they differ") {
  const Folder folder = files();
  scene::Scene s = read(full(R"({"link.value": [1, 2, 1], "matrices.stiffness": [1, 1.1, 0.9]})"), folder);
  scene::set(s, "mt.value", 0.07);
  CHECK(scene::value(s, "mt3.value") == 0.07);
  CHECK(scene::value(s, "link2.value") == 1.8);
  CHECK_THROWS_WITH(scene::value(s, "matrices.stiffness"), Catch::Contains("unknown parameter"));
}

TEST_CASE("a response of a ring whose matrices have one name need not be given") {
  const Folder folder = files();
  folder.write("names.csv", "# alone\nname,row\n\n hub , 1\n");
  const std::string one = R"({"format": "arcslip-scene-1", "structure": {
    "cyclic": {"sectors": 4, "engine_order": 1, "full": true},
    "matrices": {"mass": "M.mtx", "stiffness": "K.mtx"}, "names": "names.csv"},
    "excitation": [{"name": "f", "at": "hub", "cosine": 1}]})";
  const scene::Scene s = read(one, folder);
  CHECK(s.response() == scene::Direction{{0, 1.0}});
  CHECK(s.dofs[3] == "hub4");
  CHECK(s.excitation[1].values == std::vector<double>{0, 1});
}

TEST_CASE("places of a full ring may name sectors, as in the envelope of all tips") {
  const Folder folder = files();
  const std::string envelope = R"({"max_of": [{"repeat": 3, "at": "tip.z{i}"}]})";
  const scene::Scene s = read(scene_text({3, 1}, Ring::full, envelope), folder);
  CHECK(s.response() == scene::Direction{{0, 1.0}});
  CHECK(s.responses.front().others == std::vector<scene::Direction>{{{1, 1.0}}, {{2, 1.0}}});
}

TEST_CASE("copies of matrices may stand in a row, without a ring") {
  const Folder folder = three_rows();
  for (const std::string keys : {R"(, "copies": 2)", R"(, "copies": 2, "highest_frequency": 30)"}) {
    const scene::Scene s = read(row_of(keys), folder);
    CHECK(s.dofs == std::vector<std::string>{"a1", "a2", "b1", "b2"});
    CHECK(read(scene::write(s), folder) == s);
    // Next to two structures in one pair of files, in which the names are written out.
    Sector both;
    both.masses = {1, 2, 3, 1, 2, 3};
    both.springs = {{0, -1, 1}, {1, 0, 2}, {2, 1, 3}, {3, -1, 1}, {4, 3, 2}, {5, 4, 3}};
    both.dampers = both.stiffening = {};
    const Folder other = files(both, "name,row\na1,1\nb1,3\na2,4\nb2,6\n");
    const scene::Scene twice = read(row_of(""), other);
    for (const double w : {0.3, 0.9, 1.7})
      CHECK(scenes::response_at(s, w).amplitude ==
            Approx(scenes::response_at(twice, w).amplitude).epsilon(1e-11));
  }
}

TEST_CASE("a shape acts on the copy that it names") {
  const Folder folder = three_rows();
  const auto at = [&](int copy, double w) {
    return scenes::response_at(read(row_of(R"(, "copies": 2)", R"({"name": "p", "shape": "p.mtx", "copy": )" +
                                                                   std::to_string(copy) + ", \"cosine\": 1}"),
                                    folder),
                               w)
        .amplitude;
  };
  // The response is in the second.
  CHECK(at(2, 0.3) > 2 * at(1, 0.3));
}

TEST_CASE("what is wrong with copies of matrices is reported") {
  const Folder folder = three_rows();
  const std::string matrices = "/structure/matrices";
  const auto of = [&](const std::string& keys, const std::string& pointer, const std::string& part) {
    check_fault(row_of(keys), folder, matrices + pointer, part);
  };
  of(R"(, "copies": 0)", "/copies", "found 0, must be an integer from 1 to 10000");
  of(R"(, "copies": "3")", "/copies", "found \"3\" (a string), must be an integer from 1 to 10000");
  of(R"(, "copies": 10001)", "/copies", "found 10001, must be an integer from 1 to 10000");
  of(R"(, "copies": 2, "stiffness_factors": 1)", "/stiffness_factors",
     "found 1 (a number), must be a list of 2 numbers, a factor of the stiffness for each copy");
  of(R"(, "copies": 2, "stiffness_factors": [1, 1, 1])", "/stiffness_factors",
     "found a list of 3, must be a list of 2 numbers");
  of(R"(, "copies": 2, "stiffness_factors": [1, 0])", "/stiffness_factors/1", "found 0, must be above 0");
  of(R"(, "copies": 2, "stiffness_factors": [1, true])", "/stiffness_factors/1",
     "found true, must be a number, above 0");
  of(R"(, "copies": 2, "stiffness_factors": [1, 1e308])", "/stiffness_factors/1",
     "found 1e+308, with which the stiffness matrix is too large for a number");
  of(R"(, "copies": 167)", "",
     "found 167 copies of matrices of 3 rows without \"highest_frequency\", must have it above 500 rows in "
     "all");
  CHECK_NOTHROW(read(row_of(R"(, "copies": 166)"), folder));
  // Three degrees of freedom in each copy: two rows that the scene uses, and a coordinate.
  of(R"(, "copies": 1251, "highest_frequency": 30)", "",
     "1251 copies have 2502 degrees of freedom together, must have at most 2500");
  of(R"(, "copies": 834, "highest_frequency": 30)", "",
     "834 copies have 2502 degrees of freedom together, must have at most 2500, since the matrices of the "
     "model "
     "are dense; lower \"highest_frequency\", let the scene use fewer rows");
  check_fault(
      with(row_of(R"(, "copies": 2)"), "\"names\"",
           R"("cyclic": {"sectors": 2, "engine_order": 1}, "names")"),
      folder, matrices + "/copies",
      "found 2 next to \"cyclic\", must be left out: one sector has one copy, and with \"full\": true "
      "there are as many as sectors");
  const std::string names = "/structure/names";
  const auto named = [&](const std::string& text, const std::string& keys, const std::string& part) {
    folder.write("names.csv", "name,row\n" + text);
    check_fault(row_of(keys), folder, names, part);
  };
  named(
      "a,1\na1,3\nb,2\n", R"(, "copies": 12)",
      "line 3 of \"names.csv\": found the name \"a1\", of which copy 1 is \"a11\", which stands for another "
      "degree of freedom; each must stand once");
  named("ground,1\na,2\nb,3\n", R"(, "copies": 2)",
        "line 2 of \"names.csv\": found the name \"ground\", which is reserved");
  named(",1\na,2\nb,3\n", R"(, "copies": 2)",
        "line 2 of \"names.csv\": found the name \"\", must be a name of at least one character");
  Sector many;
  std::string all = "name,row\na,1\nb,2\n";
  many.masses.assign(101, 1.0);
  many.springs = {};
  many.dampers = many.stiffening = {};
  for (int i = 0; i < 101; ++i) {
    many.springs.push_back({i, -1, 1});
    if (i > 1) all += "c" + std::to_string(i) + "_," + std::to_string(i + 1) + "\n";
  }
  const Folder large = files(many, all);
  check_fault(
      row_of(R"(, "copies": 10000, "highest_frequency": 30)"), large, names,
      "line 102 of \"names.csv\": found more than 1000000 names in all 10000 copies together, must be at "
      "most as many: leave out those that the scene does not use");
}

TEST_CASE("what is wrong with shapes on copies is reported") {
  const Folder folder = three_rows();
  const auto of = [&](const std::string& keys, const std::string& pointer, const std::string& part,
                      const std::string& copies = R"(, "copies": 2)") {
    check_fault(row_of(copies, R"({"name": "p", )" + keys + R"("cosine": 1})"), folder,
                "/excitation/0" + pointer, part);
  };
  of(R"("shape": "p.mtx", )", "",
     "found \"shape\" without \"copy\", must have it next to it, an integer from 1 to 2: on which of the "
     "copies "
     "of the matrices the shape acts; \"repeat\" makes excitations for several");
  of(R"("shape": "p.mtx", "copy": 3, )", "/copy",
     "found 3, must be an integer from 1 to 2, one of the copies");
  of(R"("shape": "p.mtx", "copy": 0, )", "/copy", "found 0, must be an integer from 1 to 10000");
  of(R"("at": "a1", "copy": 1, )", "/copy",
     "found a copy of matrices without \"shape\", must stand next to it");
  check_fault(
      with(full(), R"("direction": {"tip.z": 1, "hub": 0.4}, "cosine")",
           R"("shape": "p.mtx", "copy": 1, "cosine")"),
      files(), "/excitation/0/copy",
      "found a copy in a full ring, must be left out: a shape acts on all sectors, later by the engine "
      "order");
}

TEST_CASE("what is wrong with full rings from matrices is reported") {
  const Folder folder = files();
  const std::string at = "/structure/cyclic", matrices = "/structure/matrices";
  check_fault(scene_text({3, 1, R"(, "copies": 3)"}, Ring::full), folder, matrices + "/copies",
              "found copies in a full ring, must be left out: each sector has one");
  check_fault(scene_text({3, 1, R"(, "stiffness_factors": [1, 1, 1])"}, Ring::full), folder,
              matrices + "/stiffness_factors",
              "found factors in a full ring, must be \"matrices.stiffness\" in \"mistuning\" of \"cyclic\"");
  check_fault(full(R"({"matrices.stiffness": [1, 1]})"), folder, at + "/mistuning/matrices.stiffness",
              "found a list of 2, must be a list of 3 numbers, a factor for each sector");
  check_fault(full(R"({"matrices.stiffness": [1, 0, 1]})"), folder, at + "/mistuning/matrices.stiffness/1",
              "found 0, must be above 0");
  check_fault(full(R"({"matrices.stiffness": [1, 1.7e308, 1]})"), folder,
              at + "/mistuning/matrices.stiffness/1",
              "found 1.7e+308, with which the stiffness matrix is too large for a number");
  check_fault(full(R"({"matrices.mass": [1, 1, 1]})"), folder, at + "/mistuning/matrices.mass",
              "\"matrices.stiffness\"");
  check_fault(
      with(full(R"({"matrices.stiffness": [1, 1, 1]})"), "\"name\": \"damper\"", "\"name\": \"matrices\""),
      folder, at + "/mistuning/matrices.stiffness",
      "found the stiffness of the matrices, which a part named \"matrices\" has as well; the part must "
      "have another name");
  check_fault(with(full(), "\"hub\", {\"next\"", "\"hbu\", {\"next\""), folder,
              "/structure/springs/2/between/0", "for sector = 1, 2, 3: found \"hbu\"");
  check_fault(with(full(), "\"names.csv\"", "\"none.csv\""), folder, "/structure/names",
              "found \"none.csv\", which cannot be read");
  for (const std::string bar : {"beam", "rod"})
    check_fault(
        R"({"format": "arcslip-scene-1", "structure": {"cyclic": {"sectors": 3, "engine_order": 1, "full": true},
      ")" + bar +
            R"(": {}}, "excitation": [{"name": "f", "at": "a", "cosine": 1}]})",
        folder, at + "/full",
        "found true next to \"" + bar +
            "\", must be false, or the sector must be of masses and springs, or of matrices");
  check_fault(with(full(), "\"excitation\"", "\"patches\": [], \"excitation\""), folder, at + "/full",
              "found true next to \"patches\", must be false, or the contacts must be elements");
}

TEST_CASE("a structure in copies is not written in reduced form, one of its sectors is") {
  const Folder folder = files();
  const Given given{3, 1, R"(, "highest_frequency": 60)", "", friction};
  CHECK_THROWS_WITH(
      model::reduced_scene(from_matrices(given, Ring::full, folder), folder.path()),
      "the structure stands in 3 copies: reduce one of them, without \"copies\", or one sector of "
      "a full ring, without \"full\": true, which may then stand in the reduced scene");
  const model::ReducedScene one =
      model::reduced_scene(from_matrices(given, Ring::sector, folder), folder.path());
  const Folder out;
  for (const auto& [name, text] : one.files) out.write(name, text);
  const scene::Scene again =
      read(with(one.scene, "\"engine_order\"", "\"full\": true, \"engine_order\""), out);
  const scene::Scene all = from_matrices(given, Ring::full, folder);
  for (const double w : {0.7, 1.6})
    CHECK(scenes::response_at(again, w).amplitude ==
          Approx(scenes::response_at(all, w).amplitude).epsilon(1e-10));
}
