#include "catch.hpp"
#include "contains.hpp"

#include "lib/model/rotors.hpp"

#include <arcslip/scene/format/json_schema.hpp>

using namespace arcslip;
using namespace rotors;

TEST_CASE("what is wrong with unsymmetric matrices is reported with the entry at fault") {
  const std::string head = "%%MatrixMarket matrix coordinate real ";
  const auto files = [&] {
    const std::string diagonal = head + "general\n3 3 3\n1 1 1\n2 2 2\n3 3 3\n";
    return Folder{{"M.mtx", diagonal},
                  {"K.mtx", diagonal},
                  {"C.mtx", diagonal},
                  {"G.mtx", head + "skew-symmetric\n3 3 1\n2 1 0.5\n"},
                  {"names.csv", "name,row\nx,1\n"}};
  };
  const auto with = [&](const std::string& keys, const std::string& name, const std::string& text,
                        const std::string& more = "") {
    const Folder folder = files();
    if (!name.empty()) folder.write(name, text);
    return fault(scene_of(keys, more, along_x), folder);
  };
  const std::string gyroscopic = R"(, "gyroscopic": "G.mtx")";
  CHECK(with(gyroscopic, "", "") == "none");
  CHECK(with(gyroscopic, "", "", R"(, "rotation": {"name": "rotor", "speed": 3})") == "none");
  CHECK(
      contains(with(gyroscopic, "G.mtx", head + "symmetric\n3 3 1\n2 1 0.5\n"),
               "/structure/matrices/gyroscopic: found the gyroscopic matrix with 0.5 in row 2, column 1 and "
               "0.5 in row 1, column 2, must be skew-symmetric: entries across the diagonal of opposite "
               "signs, and 0 on it"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n3 3 1\n1 2 0.5\n"),
                 "with 0.5 in row 1, column 2 and 0 in row 2, column 1, must be skew-symmetric"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n3 3 3\n1 2 0.5\n2 1 -0.5\n3 3 2\n"),
                 "with 2 in row 3, column 3, must be skew-symmetric"));
  CHECK(contains(
      with(gyroscopic, "G.mtx", head + "general\n2 2 0\n"),
      "/structure/matrices/gyroscopic: found a matrix of 2 rows, must have 3 as the stiffness matrix"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n2 3 0\n"),
                 "found the gyroscopic matrix with 2 rows and 3 columns, must be square"));
  CHECK(contains(with(R"(, "circulatory": "G.mtx")", "G.mtx", head + "symmetric\n3 3 1\n2 1 0.5\n"),
                 "/structure/matrices/circulatory: found the circulatory matrix with 0.5 in row 2"));
  CHECK(contains(with(gyroscopic, "M.mtx", head + "general\n3 3 2\n1 1 1\n3 3 3\n"),
                 "/structure/matrices/gyroscopic: found the gyroscopic matrix with 0.5 in row 2, column 1, "
                 "where the mass matrix has 0 in row 2, column 2; -0.5 in row 1, column 2, where the mass "
                 "matrix has 0 in row 2, column 2, must have mass in both rows that it couples"));
  const std::string lopsided = head + "general\n3 3 4\n1 1 1\n2 2 2\n3 3 3\n1 2 0.5\n";
  CHECK(contains(with("", "K.mtx", lopsided),
                 "found the stiffness matrix with 0.5 in row 1, column 2 and 0 in row 2, column 1, must be "
                 "symmetric"));
  CHECK(with(R"(, "unsymmetric": ["stiffness"])", "K.mtx", lopsided) == "none");
  CHECK(contains(with(R"(, "damping": "C.mtx", "unsymmetric": ["stiffness"])", "C.mtx", lopsided),
                 "found the damping matrix with 0.5 in row 1, column 2"));
  CHECK(with(R"(, "damping": "C.mtx", "unsymmetric": ["damping"])", "C.mtx", lopsided) == "none");
  {
    const Folder folder = files();
    folder.write("C.mtx", lopsided);
    folder.write("M.mtx", head + "general\n3 3 2\n1 1 1\n3 3 3\n");
    CHECK(
        contains(fault(scene_of(R"(, "damping": "C.mtx", "unsymmetric": ["damping"])", "", along_x), folder),
                 "/structure/matrices/damping: found the damping matrix with 0.5 in row 1, column 2, where "
                 "the mass matrix has 0 in row 2, column 2"));
  }
  const std::string list = "must be a list of at least one of \"stiffness\", \"damping\"";
  CHECK(contains(with(R"(, "unsymmetric": true)", "", ""),
                 "/structure/matrices/unsymmetric: found true, " + list));
  CHECK(contains(with(R"(, "unsymmetric": [])", "", ""), "found an empty list, " + list));
  CHECK(contains(with(R"(, "unsymmetric": ["mass"])", "", ""),
                 "/structure/matrices/unsymmetric/0: found \"mass\", must be \"stiffness\" or \"damping\""));
  CHECK(contains(with(R"(, "unsymmetric": [1])", "", ""), "/structure/matrices/unsymmetric/0: found 1"));
  CHECK(contains(with(R"(, "unsymmetric": ["stiffness", "stiffness"])", "", ""),
                 "/structure/matrices/unsymmetric/1: found \"stiffness\" again, must be given once"));
  CHECK(contains(with(R"(, "unsymmetric": ["damping"])", "", ""),
                 "found \"damping\" without the key \"damping\", must be next to that matrix"));
  for (const char* key : {"\"gyroscopic\"", "\"circulatory\"", "\"unsymmetric\""})
    CHECK(contains(scene::json_schema(test_catalogue::whole()), key));
}
