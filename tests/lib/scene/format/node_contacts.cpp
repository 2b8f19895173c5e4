// Contacts of patches that are given by nodes and local axes.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/scene/patch.hpp>

#include <string>

using namespace arcslip;

namespace {

scene::Scene read_in(const std::string& whole, const Folder& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder.path());
}

// Nodes a1 to a<count>, of one mass, on one spring and under one force together.
std::string block(int count, const std::string& contacts) {
  const std::string n = std::to_string(count);
  const auto part = [&](const std::string& name, const std::string& axis, double value) {
    return R"({"repeat": )" + n + R"(, "name": ")" + name + R"({i}", "at": "a{i}.)" + axis +
           R"(", "value": )" + std::to_string(value / count) + "}";
  };
  return R"({"format": "arcslip-scene-2", "frequency_unit": "rad/s",
    "structure": {"dofs": [{"repeat": )" +
         n + R"(, "name": "a{i}.x"}, {"repeat": )" + n + R"(, "name": "a{i}.z"}],
      "masses": [)" +
         part("mx", "x", 1.6) + ", " + part("mz", "z", 1.6) + R"(], "springs": [)" + part("kx", "x", 16000) +
         ", " + part("kz", "z", 32000) + R"(], "dampers": [)" + part("cx", "x", 1.6) + ", " +
         part("cz", "z", 1.6) + "]}," + contacts + R"(
    "excitation": [{"repeat": )" +
         n + R"(, "name": "f{i}", "direction": {"a{i}.x": 1, "a{i}.z": 0.6}, "cosine": )" +
         std::to_string(8.0 / count) + R"(}],
    "response": {"at": "a1.x"}, "harmonics": {"order": 5}})";
}

std::string node_patch(const std::string& law = "contact_2d") {
  return R"("patches": [{"name": "pad", "law": ")" + law + R"(", "file": "pad.csv",
    "tangential_stiffness": 3e7, "normal_stiffness": 4.5e7, "friction_coefficient": 0.4}],)";
}

// So many contacts of one area in all, each the mean of as many of the nodes.
std::string contacts_of(int count, int nodes) {
  std::string text = "nodes, against, normal, area, pressure\n";
  for (int i = 0, node = 0; i < count; ++i) {
    for (int k = 0; k < nodes / count; ++k) text += "a" + std::to_string(++node) + " ";
    text += ", ground, 0 0 1, " + std::to_string(4e-4 / count) + ", 1e4\n";
  }
  return text;
}

std::string fault_of(const std::string& file) {
  const Folder folder{{"pad.csv", file}};
  try {
    read_in(block(2, node_patch()), folder);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("one contact of 16 nodes, 4 of 4 and 16 of 1 are one of the same area where all move alike") {
  const Folder folder{{"pad.csv", "tangential, normal, area, pressure\na1.x, a1.z, 4e-4, 1e4\n"}};
  const double omega = GENERATE(90.0, 120.0, 150.0);
  const auto one = scenes::response_at(read_in(block(1, node_patch()), folder), omega);
  REQUIRE(one.stops.empty());
  for (const int count : {1, 4, 16}) {
    folder.write("pad.csv", contacts_of(count, 16));
    const auto many = scenes::response_at(read_in(block(16, node_patch()), folder), omega);
    CAPTURE(omega, count);
    CHECK(many.amplitude == Approx(one.amplitude).epsilon(1e-9));
  }
}

TEST_CASE("contacts by nodes have the weighted means along their axes, of both sides") {
  const Folder folder{{"pad.csv",
                       "nodes, against, normal, tangent, area\n"
                       "1*a1 3*a2, a3, 0 0 2,, 1\n"
                       "a1, ground, 0.6 0 0.8, 1 0 0, 1\n"}};
  const scene::Scene s = read_in(block(3, node_patch()), folder);
  const auto all = scene::all_elements(s);
  REQUIRE(all.size() == 2);
  CHECK(all[0].directions[0] == scene::Direction{{0, 0.25}, {1, 0.75}, {2, -1}});
  CHECK(all[0].directions[1] == scene::Direction{{3, 0.25}, {4, 0.75}, {5, -1}});
  REQUIRE(all[1].directions[0].size() == 2);
  CHECK(all[1].directions[0][0].weight == Approx(0.8).epsilon(1e-14));
  CHECK(all[1].directions[0][1].weight == Approx(-0.6).epsilon(1e-14));
  CHECK(all[1].directions[1][0].weight == Approx(0.6).epsilon(1e-14));
  CHECK(all[1].directions[1][1].weight == Approx(0.8).epsilon(1e-14));
  CHECK(read_in(scene::write(s), folder) == s);
}

TEST_CASE("the axes of contacts in space are right-handed, and need not be given in full") {
  const Folder folder{{"pad.csv",
                       "nodes, normal, area, tangent\n"
                       "a1, 0 0 1, 1,\n"
                       "a1, 0 1 0, 1, 0 1 1\n"}};
  const std::string whole = R"({"format": "arcslip-scene-2", "structure": {"dofs": ["a1.x", "a1.y", "a1.z"],
    "masses": [{"name": "m", "at": "a1.x", "value": 1}, {"name": "n", "at": "a1.y", "value": 1},
               {"name": "o", "at": "a1.z", "value": 1}],
    "springs": [{"name": "k", "at": "a1.x", "value": 1}, {"name": "l", "at": "a1.y", "value": 1},
                {"name": "p", "at": "a1.z", "value": 1}]},)" +
                            node_patch("contact_3d") +
                            R"("excitation": [{"name": "f", "at": "a1.x", "cosine": 1}],
    "response": {"at": "a1.x"}})";
  const auto all = scene::all_elements(read_in(whole, folder));
  REQUIRE(all.size() == 2);
  const scene::Direction x{{0, 1}}, y{{1, 1}}, z{{2, 1}};
  CHECK(all[0].directions == std::vector<scene::Direction>{x, y, z});
  CHECK(all[1].directions == std::vector<scene::Direction>{z, x, y});  // y x z = x
}

TEST_CASE("faults of contacts by nodes name the line of the file") {
  const std::string head = "nodes,against,normal,tangent,area\n", line = "line 2 of \"pad.csv\": ";
  CHECK(fault_of(head + "a1,a2,0 0 1,,1\n") == "none");
  CHECK(contains(fault_of("nodes,area\na1,1\n"),
                 "line 1 of \"pad.csv\": found no column \"normal\", which is required"));
  CHECK(contains(fault_of("nodes,normal,tangential,area\n"),
                 "found the column \"tangential\", must be one of \"nodes\", \"against\", \"normal\", "
                 "\"tangent\", \"area\""));
  CHECK(contains(fault_of(head + ",a2,0 0 1,,1\n"), line + "found no nodes, must have at least one"));
  CHECK(contains(fault_of(head + "a1,a2,,,1\n"), line + "found no normal, must be three numbers"));
  CHECK(contains(fault_of(head + "a1,a2,0 0,,1\n"),
                 line + "found the normal \"0 0\", must be three numbers that are not all 0"));
  CHECK(contains(fault_of(head + "a1,a2,0 0 0,,1\n"), line + "found the normal \"0 0 0\", must be three"));
  CHECK(contains(fault_of(head + "a1,a2,0 0 1,0 0 2,1\n"),
                 line + "found the tangent \"0 0 2\", must not be along the normal"));
  CHECK(contains(fault_of(head + "-1*a1,a2,0 0 1,,1\n"),
                 line + "found the weight -1 of the node \"a1\", must be a number above 0"));
  const std::string wanted =
      ", must be names of nodes with spaces between them, each with a weight if needed, as in 0.25*a1 "
      "0.75*a2";
  CHECK(
      contains(fault_of(head + "a1 -a2,ground,0 0 1,,1\n"), line + "found \"-a2\" among the nodes" + wanted));
  CHECK(
      contains(fault_of(head + "a1 + a2,ground,0 0 1,,1\n"), line + "found \"+\" among the nodes" + wanted));
  CHECK(contains(fault_of(head + "0.5*,a2,0 0 1,,1\n"), line + "found \"0.5*\" among the nodes" + wanted));
  CHECK(contains(fault_of(head + "half*a1,a2,0 0 1,,1\n"),
                 line + "found the weight \"half\" of the node \"a1\", must be a number above 0"));
  CHECK(contains(fault_of(head + "*a1,a2,0 0 1,,1\n"),
                 line + "found the weight \"\" of the node \"a1\", must be a number above 0"));
  CHECK(contains(fault_of(head + "2*3*a1,a2,0 0 1,,1\n"), line + "found \"3*a1.x\", must be one of"));
  CHECK(contains(fault_of(head + "a1.x,a2,0 0 1,,1\n"),
                 line +
                     "found \"a1.x\", a degree of freedom, among the nodes, must be a node, as \"a1\": its "
                     "degrees of freedom are those of its name with .x, .y, .z"));
  CHECK(contains(fault_of(head + "a1,0.5*a2.z,0 0 1,,1\n"), line + "found \"a2.z\", a degree of freedom"));
  CHECK(contains(fault_of(head + "a1 ground,a2,0 0 1,,1\n"),
                 line + "found \"ground\" among other nodes, must be alone"));
  CHECK(contains(fault_of(head + "a1,a1,0 0 1,,1\n"),
                 line + "found \"a1\" on both sides, must be on one of them"));
  CHECK(contains(fault_of(head + "a1 a2,0.3*a2,0 0 1,,1\n"),
                 line + "found \"a2\" on both sides, must be on one of them"));
  CHECK(contains(fault_of(head + "ground,ground,0 0 1,,1\n"),
                 line + "found \"ground\" on both sides, must be on one of them"));
  CHECK(contains(fault_of(head + "a1,a9,0 0 1,,1\n"),
                 line + "found \"a9.x\", must be one of the degrees of freedom"));
}
