// Patches of contacts: their files, their elements, and their faults.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/patch.hpp>

using namespace arcslip;

namespace {

constexpr const char* rows =
    "tangential, normal, area, pressure, gap\n"
    "# the middle, then the edges\n"
    "t, n, 2e-4, 2e4, 0\n"
    "\n"
    "t, n - 0.05*r, 1e-4, 5e4, 0\r\n"
    "t - ground, 1*n + 0.05*r, 1e-4, 0, 2e-4\n";

Folder pad() {
  return {{"contacts/pad.csv", rows}, {"out/scene.json", ""}};
}

std::string text(const std::string& contacts) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["t", "n", "r"],
      "masses": [{"name": "m_t", "at": "t", "value": 1}, {"name": "m_n", "at": "n", "value": 1},
                 {"name": "m_r", "at": "r", "value": 0.001}],
      "springs": [{"name": "s_t", "at": "t", "value": 1e4}, {"name": "s_n", "at": "n", "value": 2e4},
                  {"name": "s_r", "at": "r", "value": 20}]},)" +
         contacts + R"(
    "excitation": [{"name": "f", "direction": {"t": 1, "n": 0.6, "r": 0.01}, "cosine": 5}],
    "response": {"at": "t"}, "harmonics": {"order": 5},
    "studies": [{"kind": "frf", "from": 60, "to": 180}]})";
}

constexpr const char* patch = R"("patches": [{"name": "pad", "law": "contact_2d", "file": "contacts/pad.csv",
    "tangential_stiffness": 3e7, "normal_stiffness": 4.5e7, "friction_coefficient": 0.4}],)";

scene::Scene read(const std::string& whole, const std::string& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder);
}

// "pointer: message" of each fault.
std::string faults(const std::string& whole, const std::string& folder) {
  try {
    read(whole, folder);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("a patch has an element for each row, with fields by area, pressure and gap") {
  const Folder folder = pad();
  const scene::Scene s = read(text(patch), folder.path());
  REQUIRE(s.elements.empty());
  const auto elements = scene::all_elements(s);
  REQUIRE(elements.size() == 3);
  const std::vector<double> fields[] = {{6e3, 9e3, 0.4, 4}, {3e3, 4.5e3, 0.4, 5}, {3e3, 4.5e3, 0.4, -0.9}};
  const std::vector<scene::Term> normals[] = {{{1, 1}}, {{1, 1}, {2, -0.05}}, {{1, 1}, {2, 0.05}}};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(elements[i].name == "pad." + std::to_string(i + 1));
    CHECK(elements[i].directions[0] == scene::Direction{{0, 1}});
    CHECK(elements[i].directions[1] == normals[i]);
    for (std::size_t k = 0; k < 4; ++k) CHECK(elements[i].values[k] == Approx(fields[i][k]).epsilon(1e-14));
  }
}

TEST_CASE("the parameters of a patch are those of all its elements") {
  const Folder folder = pad();
  scene::Scene s = read(text(patch), folder.path());
  const std::vector<std::string> own = {"pad.tangential_stiffness", "pad.normal_stiffness",
                                        "pad.friction_coefficient", "pad.pressure_factor"};
  const auto names = scene::parameter_names(s);
  for (const std::string& name : own) CHECK(std::count(names.begin(), names.end(), name) == 1);
  CHECK(scene::parameter_field(s, own[0]).unit == "N/m^3");
  CHECK(scene::value(s, "pad.pressure_factor") == 1);
  scene::set(s, "pad.pressure_factor", 3);
  scene::set(s, "pad.normal_stiffness", 9e7);
  const auto elements = scene::all_elements(s);
  CHECK(elements[0].values[3] == Approx(12).epsilon(1e-14));
  CHECK(elements[2].values[3] == Approx(-1.8).epsilon(1e-14));
  CHECK(elements[2].values[1] == Approx(9e3).epsilon(1e-14));
  CHECK_THROWS_AS(scene::set(s, "pad.pressure_factor", -1), scene::ParameterError);
  CHECK_THROWS_AS(scene::set(s, "pad.1.normal_load", 1), scene::ParameterError);

  // Tied to another part.
  const std::string tied = text(std::string(R"("elements": [{"name": "damper", "type": "jenkins", "at": "t",
      "stiffness": 1, "friction_coefficient": 0.4, "normal_load": 1}],
      "ties": {"mu": ["damper.friction_coefficient", "pad.friction_coefficient"]},)") +
                                patch);
  scene::Scene two = read(tied, folder.path());
  scene::set(two, "mu", 0.2);
  CHECK(scene::all_elements(two)[0].values[1] == 0.2);
  CHECK(scene::all_elements(two)[3].values[2] == 0.2);
}

TEST_CASE("a scene with a patch is written, read, checked and hashed with its file") {
  const Folder folder = pad();
  const scene::Scene s = read(text(patch), folder.path());
  CHECK(read(scene::write(s), folder.path()) == s);
  scene::check(s);
  const std::string hash = scene::hash(s);
  const scene::Scene moved = scene::from_folder(s, folder / "out");
  CHECK(contains(scene::write(moved), "\"../contacts/pad.csv\""));
  CHECK(scene::hash(moved) == hash);
  const scene::Scene again = read(scene::write(moved), folder / "out");
  CHECK(scene::all_elements(again) == scene::all_elements(s));
  folder.write("contacts/pad.csv", "tangential,normal,area\nt,n,1\n");
  CHECK(scene::hash(read(text(patch), folder.path())) != hash);
  CHECK(scene::hash(s) == hash);
  scene::check(s);
  CHECK(contains(scene::json_schema(test_catalogue::whole()), "\"patches\""));
}

TEST_CASE("contacts may have names, and laws of one direction a place") {
  const Folder folder = pad();
  folder.write("one.csv",
               "name,at,area,pressure\nleft,-t,1e-4,1e4\nright,t - n,2e-4,1e4\n"
               "low,-0.5*t + -n,1,0\n");
  const scene::Scene s =
      read(text(R"("patches": [{"name": "rim", "law": "jenkins", "file": "one.csv", "details": false,
        "stiffness": 1e7, "friction_coefficient": 0.3, "pressure_factor": 2, "wear_coefficient": 1e-13}],)"),
           folder.path());
  const auto elements = scene::all_elements(s);
  REQUIRE(elements.size() == 3);
  CHECK(elements[0].directions[0] == scene::Direction{{0, -1}});
  CHECK(elements[2].directions[0] == scene::Direction{{0, -0.5}, {1, -1}});
  CHECK(elements[1].name == "rim.right");
  CHECK(elements[1].directions[0] == scene::Direction{{0, 1}, {1, -1}});
  CHECK(elements[1].values[2] == Approx(4).epsilon(1e-14));
  CHECK_FALSE(elements[1].detailed);
  CHECK(elements[1].wear_coefficient == 1e-13);
  CHECK(read(scene::write(s), folder.path()) == s);
}

TEST_CASE("faults of a patch name the line of its file") {
  const Folder folder = pad();
  struct Case {
    const char *file, *fault;
  };
  const Case cases[] = {
      {"", "in \"contacts/pad.csv\": found no rows, must have a header and at least one row"},
      {"tangential,normal,area\n", "found no rows"},
      {"tangential,normal\nt,n\n",
       "line 1 of \"contacts/pad.csv\": found no column \"area\", which is required"},
      {"tangential,normal,area,presure\n",
       "line 1 of \"contacts/pad.csv\": found the column \"presure\", must be one of \"tangential\", "
       "\"normal\", "
       "\"area\", \"pressure\", \"name\", \"x\", \"y\", \"gap\"; did you mean \"pressure\"?"},
      {"tangential,normal,area,x\nt,n,1,0\n",
       "line 1 of \"contacts/pad.csv\": found no column \"y\", which is required"},
      {"tangential,normal,area,y\nt,n,1,0\n",
       "line 1 of \"contacts/pad.csv\": found no column \"x\", which is required"},
      {"tangential,normal,area,x,y\nt,n,1,0,1e7\n",
       "line 2 of \"contacts/pad.csv\": found the y \"1e7\", must be a number, at least -1e+06 and at "
       "most 1e+06 m"},
      {"tangential,normal,area,x,y\nt,n,1,0,\n",
       "line 2 of \"contacts/pad.csv\": found the y \"\", must be a number"},
      {"tangential,normal,area,area\n", "line 1 of \"contacts/pad.csv\": found the column \"area\" again"},
      {"tangential,normal,area\nt,n\n",
       "line 2 of \"contacts/pad.csv\": found 2 values, must be 3 as in the header"},
      {"tangential,normal,area\n\nt,n,0\n",
       "line 3 of \"contacts/pad.csv\": found the area \"0\", must be a number, above 0 m^2"},
      {"tangential,normal,area\nt,n,1e-4x\n", "line 2 of \"contacts/pad.csv\": found the area \"1e-4x\""},
      {"tangential,normal,area\nt,n,nan\n", "line 2 of \"contacts/pad.csv\": found the area \"nan\""},
      {"tangential,normal,area,pressure\nt,n,1,-1\n",
       "line 2 of \"contacts/pad.csv\": found the pressure \"-1\", must be a number, at least 0 Pa"},
      {"tangential,normal,area\nt,m,1\n",
       "line 2 of \"contacts/pad.csv\": found \"m\", must be one of the degrees of freedom \"t\", \"n\", "
       "\"r\" or "
       "\"ground\""},
      {"tangential,normal,area\nt,n - n,1\n", "line 2 of \"contacts/pad.csv\": found the place \"n - n\""},
      {"tangential,normal,area\nt,n -,1\n", "line 2 of \"contacts/pad.csv\": found the place \"n -\""},
      {"tangential,normal,area\nt,n r,1\n",
       "line 2 of \"contacts/pad.csv\": found \"n r\", must be a sum of"},
      {"tangential,normal,area\nt,,1\n", "line 2 of \"contacts/pad.csv\": found the place \"\""},
      {"tangential,normal,area,name\nt,n,1,a\nt,n,1,a\n",
       "line 3 of \"contacts/pad.csv\": found the name \"a\" again"},
      {"tangential,normal,area,name\nt,n,1,a.b\n",
       "line 2 of \"contacts/pad.csv\": found the name \"a.b\", must be a name without '.'"},
      {"tangential,normal,area\nt,n,1e-200\nt,n,1e308\n",
       "line 3 of \"contacts/pad.csv\": gives tangential_stiffness = inf, must be above 0 N/m"},
  };
  for (const Case& each : cases) {
    CAPTURE(each.file);
    folder.write("contacts/pad.csv", each.file);
    const std::string found = faults(text(patch), folder.path());
    CAPTURE(found);
    CHECK(contains(found, "/patches/0/file"));
    CHECK(contains(found, each.fault));
    CHECK(contains(found, "found no rows") == contains(each.fault, "found no rows"));
  }
  std::string many = "tangential,normal,area\n";
  for (int i = 0; i < 5000; ++i) many += "t,n\n";
  folder.write("contacts/pad.csv", many);
  CHECK(faults(text(patch), folder.path()).size() < 1'000'000);
}

TEST_CASE("faults of a patch in the scene name its keys") {
  const Folder folder = pad();
  const auto with = [&](const std::string& entry) {
    return faults(text("\"patches\": [" + entry + "],"), folder.path());
  };
  CHECK(contains(with("3"), "/patches/0"));
  CHECK(contains(with("[3]"), "/patches/0: found a list"));
  CHECK(contains(faults(text(R"("elements": [["wear_coefficient"]],)"), folder.path()),
                 "/elements/0: found a list"));
  CHECK(contains(with(R"({"name": "pad", "file": "contacts/pad.csv"})"), "\"law\""));
  const std::string spring = with(R"({"name": "pad", "law": "gap_spring", "file": "contacts/pad.csv"})");
  CHECK(contains(spring, "/patches/0/law: found \"gap_spring\", must be one of \"jenkins\""));
  const std::string none = with(R"({"name": "pad", "law": "contact_2d", "file": "nowhere.csv"})");
  CHECK(contains(none, "/patches/0/file: found \"nowhere.csv\", which cannot be read"));
  CHECK(contains(none, "above 0 N/m^3"));
  CHECK(contains(with(R"({"name": "a.b", "law": "jenkins", "file": "contacts/pad.csv"})"), "without '.'"));
  CHECK(contains(with(R"({"name": "pad", "law": "contact_2d", "file": "contacts/pad.csv", "detail": true,
    "tangential_stiffness": 1, "normal_stiffness": 1, "friction_coefficient": 0.4})"),
                 "did you mean \"details\"?"));
  CHECK(contains(faults(text(R"("elements": [{"name": "s", "type": "gap_spring", "at": "n", "stiffness": 1,
      "gap": 0, "wear_coefficient": 1}],)"),
                        folder.path()),
                 "wear_coefficient"));
}
