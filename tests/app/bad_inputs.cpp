#include "bad_inputs.hpp"

namespace app_test {
namespace {

std::string scene_with(const std::string& structure, const std::string& rest) {
  return R"({"format": "arcslip-scene-1", "title": "t", "structure": )" + structure +
         R"(, "excitation": [{"name": "force", "at": "x", "harmonic": 1, "cosine": 1}], "response": {"at": "x"})" +
         rest + "}";
}

std::string structure(const std::string& mass, const std::string& stiffness) {
  return R"({"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": )" + mass +
         R"(}], "springs": [{"name": "k", "at": "x", "value": )" + stiffness + "}]}";
}

std::string study(const std::string& from, const std::string& to) {
  return R"(, "studies": [{"name": "frf", "kind": "frf", "from": )" + from + R"(, "to": )" + to + "}]";
}

BadInput line(std::string name, std::vector<std::string> arguments, std::string message) {
  return {std::move(name), std::move(arguments), 1, std::move(message), "", {}};
}

BadInput printed_on(std::string output, std::string name, std::vector<std::string> arguments,
                    std::string message) {
  return {std::move(name), std::move(arguments), 1, std::move(message), "", {}, std::move(output)};
}

/// A scene without studies.
BadInput bare(std::string name, std::vector<std::string> arguments, std::string message) {
  return {std::move(name),    std::move(arguments), 1,
          std::move(message), "bare.json",          [] { return scene_with(structure("1", "100"), ""); }};
}

/// A friction damper as stiff as its spring, both tied, and the peaks over its load.
std::string peaks_scene() {
  return scene_with(structure("1", "100"), R"(, "elements": [{"name": "damper", "type": "jenkins", "at": "x",
    "stiffness": 100, "friction_coefficient": 0.5, "normal_load": 3}],
    "ties": {"both": ["k.value", "damper.stiffness"]},
    "studies": [{"name": "peaks", "kind": "peaks", "over": "damper.normal_load", "from": 0.01, "to": 500,
                 "frequency": [1, 3]}])");
}

BadInput peaks(std::string name, std::vector<std::string> options, std::string message) {
  options.insert(options.begin(), {"peaks", "bad.json"});
  return {std::move(name), std::move(options), 1, std::move(message), "bad.json", peaks_scene};
}

BadInput scene(std::string name, std::string message, std::function<std::string()> content) {
  return {std::move(name), {"run", "bad.json"}, 2, std::move(message), "bad.json", std::move(content)};
}

std::vector<BadInput> make() {
  return {
      // the command line
      line("no verb", {}, "Give a verb and a scene"),
      line("an unknown verb", {"fry", "scene.json"},
           "unknown verb \"fry\", must be run, frf, trace, peaks, folds, bifurcations, time, point, modes, "
           "sweep, accuracy, "
           "optimize, ensemble, merge, reduce, check, new, show, plot, compare, schema, manual or "
           "completions; did you mean "
           "frf?"),
      bare("a structure that is not reduced", {"reduce", "bare.json"},
           "the structure is not reduced: give its matrices, its beam or its rod a \"highest_frequency\""),
      {"a reduced structure over the scene that it is of",
       {"reduce", "reduced.json", "--out", "."},
       1,
       "reduced.json is the scene file itself: choose another path for the results",
       "reduced.json",
       [] {
         return scene_with(
             R"({"beam": {"elements": 4, "length": 1, "young": 2e11, "density": 7800, "width": 0.1,
           "height": 0.1, "points": {"x": 1}, "highest_frequency": 500}})",
             "");
       }},
      line("an amplitude that is no number", {"modes", "scene.json", "--amplitude", "x", "1"},
           "--amplitude x: must be two numbers, [from, to], 0 < from < to"),
      line("one amplitude", {"modes", "scene.json", "--amplitude", "1"},
           "--amplitude: At least 2 required but received 1"),
      line("amplitudes that fall", {"modes", "scene.json", "--amplitude", "1", "0.5"},
           "--amplitude 1 0.5: found 0.5, must be above the lower end, which is 1 m"),
      line("no scene", {"run"}, "SCENE is required"),
      line("an unknown option", {"frf", "scene.json", "--harmonic", "3"},
           "unknown option --harmonic; did you mean --harmonics?"),
      line("--set without a value", {"frf", "scene.json", "--set", "damper.normal_load"},
           "give it as name.field=value"),
      line("--set with what is no number", {"frf", "scene.json", "--set", "damper.normal_load=3kg"},
           "found \"3kg\", must be in a unit of the same dimension as N"),
      line("--set with a decimal comma", {"frf", "scene.json", "--set", "m=0,8 kg"},
           "parameter \"m.value\": found \"0,8 kg\", must have a decimal point: \"0.8 kg\""),
      line("--set in a unit with another capital", {"frf", "scene.json", "--set", "m=0.8 Kg"},
           "parameter \"m.value\": found the unknown unit \"Kg\", must be a unit as \"N/m\", \"mm\", or \"N "
           "s/m\"; did you mean \"kg\"?"),
      line("--set to a sum with a unit", {"frf", "scene.json", "--set", "damper.normal_load=m*9.81 + 3 N"},
           "column 12: found \"N\", must be an operator or the end; numbers in formulas have no units, but "
           "those of the SI"),
      line("--set with a constant in capitals", {"frf", "scene.json", "--set", "k=2*PI"},
           "found the unknown name \"PI\" (the constant is \"pi\")"),
      line("a column by its beginning", {"frf", "scene.json", "--columns", "freq"},
           "; did you mean frequency?"),
      line("--set to NaN", {"frf", "scene.json", "--set", "damper.normal_load=nan"},
           "column 1: found the unknown name \"nan\""),
      line("--set to 1e999", {"frf", "scene.json", "--set", "damper.normal_load=1e999"},
           "found a number beyond the range of doubles"),
      line("--set of an unknown name", {"frf", "scene.json", "--set", "damper.normal_lod=3"},
           "did you mean \"damper.normal_load\"?"),
      line("--set out of bounds", {"frf", "scene.json", "--set", "damper.normal_load=-3"},
           "found -3, must be at least 0 N"),
      line("--set of all stiffness to zero",
           {"frf", "scene.json", "--set", "k.value=0", "--set", "damper.stiffness=0"},
           "parameter \"damper.stiffness\": found 0, must be above 0 N/m"),
      line("--harmonics 0", {"frf", "scene.json", "--harmonics", "0"},
           "found 0, must be an integer from 1 to 2000"),
      line("--harmonics 1e6", {"frf", "scene.json", "--harmonics", "1000000"},
           "must be an integer from 1 to 2000"),
      line("--harmonics beyond every integer", {"frf", "scene.json", "--harmonics", "99999999999999999999"},
           "must be a whole number"),
      line("--accuracy 0", {"frf", "scene.json", "--accuracy", "0"},
           "--accuracy 0: must be a number from 1e-10 to 0.1"),
      line("--accuracy 1", {"frf", "scene.json", "--accuracy", "1"},
           "--accuracy 1: must be a number from 1e-10 to 0.1"),
      line("--accuracy high", {"frf", "scene.json", "--accuracy", "high"},
           "--accuracy high: must be a number from 1e-10 to 0.1"),
      line("--threads 0", {"frf", "scene.json", "--threads", "0"},
           "--threads 0: must be an integer from 1 to 1024"),
      line("--threads without a value", {"frf", "scene.json", "--threads", ""}, "--threads: found no value"),
      line("--accuracy without a value", {"frf", "scene.json", "--accuracy", ""},
           "--accuracy: found no value"),
      line("--harmonics without a value", {"frf", "scene.json", "--harmonics", ""},
           "--harmonics: found no value"),
      line("--combinations without a value", {"frf", "scene.json", "--combinations", ""},
           "--combinations: found no value"),
      line("--threads 1.5", {"frf", "scene.json", "--threads", "1.5"}, "must be a whole number"),
      line("--harmonics 5.5", {"frf", "scene.json", "--harmonics", "5.5"}, "must be a whole number"),
      line("--from above --to", {"frf", "scene.json", "--from", "22", "--to", "18"},
           "--from must be below --to; found --from 22 and --to 18"),
      line("--from above the study's end", {"run", "scene.json", "--from", "30"},
           "--from must be below 22 Hz, where the study \"frf\" ends; found 30 Hz"),
      line("--to below the study's beginning", {"frf", "scene.json", "--to", "1"},
           "--to must be above 18 Hz, where the study \"frf\" begins; found 1 Hz"),
      line("--from 0", {"frf", "scene.json", "--from", "0"}, "must be a frequency above 0"),
      line("--from that is no number", {"frf", "scene.json", "--from", "low"}, "must be a frequency above 0"),
      {"frf with half a range",
       {"frf", "bare.json", "--from", "1"},
       1,
       "with the options, /studies/0/to: found no key \"to\", which is required: must be above 0 Hz",
       "bare.json",
       [] { return scene_with(structure("1", "100"), ""); }},
      {"run without a study",
       {"run", "bare.json"},
       1,
       "the scene has no studies",
       "bare.json",
       [] { return scene_with(structure("1", "100"), ""); }},
      // studies over a parameter
      bare("peaks without a study", {"peaks", "bare.json"},
           "the scene has no study of kind peaks: give --over, --from and --to, or "
           "add such a study to the scene"),
      bare("trace without a study, half reported", {"trace", "bare.json", "--over", "k.value", "--to", "200"},
           "the scene has no study of kind trace: give --from and --frequency"),
      peaks("--over another parameter than the study's", {"--over", "m.value"},
            "the scene has no study of kind peaks over m.value: give --from and --to"),
      peaks("--over an unknown parameter", {"--over", "damper.normal_lod"},
            "--over damper.normal_lod: unknown parameter \"damper.normal_lod\""),
      peaks("--over the frequency", {"--over", "frequency", "--from", "1", "--to", "2"},
            "--over frequency: found \"frequency\", must be another parameter; over the frequency is"),
      peaks("--over nothing", {"--over", ""}, "--over needs the name of a parameter"),
      peaks("--over a tied field", {"--over", "damper.stiffness", "--from", "1", "--to", "2"},
            "--over damper.stiffness: found \"damper.stiffness\", which is given by the formula \"both\"; "
            "must be what that follows: \"both\""),
      peaks("--set of the parameter that is varied", {"--set", "damper.normal_load=3"},
            "--set damper.normal_load=3: the study varies this parameter; give --from and --to"),
      peaks("--from below the parameter's bound", {"--from", "-1"},
            "--from -1: found -1, must be at least 0 N"),
      peaks("--from above the study's last load", {"--from", "600"},
            "--from must be below 500 N, where the study \"peaks\" ends; found 600 N"),
      peaks("--to below the study's first load", {"--to", "0.001"},
            "--to must be above 0.01 N, where the study \"peaks\" begins; found 0.001 N"),
      peaks("a value of the parameter that is no number", {"--from", "low"},
            "--from low: must be a value of the parameter, a finite number"),
      peaks("one frequency in place of a window", {"--frequency", "20"},
            "--frequency: At least 2 required but received 1"),
      peaks("three frequencies", {"--frequency", "18", "20", "22"}, "argument was not expected: 22"),
      peaks("a window that ends before it begins", {"--frequency", "22", "18"},
            "--frequency 22 18: must be a window, the lower frequency before the upper one"),
      peaks("a window from zero", {"--frequency", "0", "18"}, "--frequency 0: must be a frequency above 0"),
      bare("a window in place of one frequency", {"trace", "bare.json", "--frequency", "18", "22"},
           "argument was not expected: 22"),
      line("--over in a frequency response", {"frf", "scene.json", "--over", "k.value"},
           "unknown option --over"),
      {"a range of frequencies where no study has one",
       {"run", "bad.json", "--from", "18"},
       1,
       "with run, --from and --to apply to frequency responses, but the scene has none",
       "bad.json",
       peaks_scene},
      // motions in time
      bare("optimize without a study", {"optimize", "bare.json", "--frequency", "18", "22"},
           "the scene has no study of kind optimum: give --over with bounds"),
      bare("time without a frequency", {"time", "bare.json"},
           "the scene has no study of kind time: give --frequency, or add such a study to the scene"),
      line("time at two frequencies", {"time", "scene.json", "--frequency", "18", "22"},
           "argument was not expected: 22"),
      line("time by an unknown method", {"time", "scene.json", "--frequency", "20", "--method", "euler"},
           "--method euler: found \"euler\", must be one of \"shooting\", \"newmark-shooting\", \"newmark\", "
           "\"event-driven\""),
      line("time without steps", {"time", "scene.json", "--frequency", "20", "--steps", "0"},
           "--steps 0: found 0, must be an integer from 1 to 10000000"),
      line("an empty value of a number", {"frf", "scene.json", "--from", ""},
           "--from needs a nonempty value"),
      line("an empty value of a whole number", {"time", "scene.json", "--frequency", "20", "--steps", ""},
           "--steps needs a nonempty value"),
      line("an empty end of a window", {"peaks", "scene.json", "--frequency", "18", ""},
           "--frequency needs a nonempty value"),
      line("a design over nothing", {"optimize", "scene.json", "--over", ""},
           "--over needs the name of a parameter, such as --over damper.normal_load=0.1:100"),
      line("--coefficients where they change nothing", {"optimize", "scene.json", "--coefficients"},
           "--coefficients"),
      line("half a period of time", {"time", "scene.json", "--frequency", "20", "--periods", "0.5"},
           "--periods 0.5: must be an integer from 1 to 100000000"),
      line("more history than a result can hold",
           {"time", "scene.json", "--frequency", "20", "--recorded", "100000"},
           "found 100000 periods of 1000 steps to record, must be at most 10000000 steps together"),
      line("a tolerance of time above 1", {"time", "scene.json", "--frequency", "20", "--tolerance", "2"},
           "--tolerance 2: found 2, must be"),
      {"motions and branches in one table",
       {"run", "bad.json", "--csv", "a.csv"},
       1,
       "--csv holds one table, but the results of the studies \"frf\" and \"time\" have different columns",
       "bad.json",
       [] {
         return scene_with(
             structure("1", "100"),
             R"(, "studies": [{"kind": "frf", "from": 1, "to": 2}, {"kind": "time", "frequency": 1}])");
       }},
      {"more combinations than anybody meant",
       {"frf", "bad.json"},
       1,
       "the lists of for_each in the study \"frf\" have 1000 x 1000 x 1000 = 1000000000 combinations, must "
       "be at most 100000: give fewer values, or allow more with --combinations N",
       "bad.json",
       [] {
         std::string values = "1";
         for (int i = 2; i <= 1000; ++i) values += ", " + std::to_string(i);
         return scene_with(structure("1", "100"),
                           R"(, "studies": [{"kind": "frf", "from": 1, "to": 2, "for_each": {"m.value": [)" +
                               values + R"(], "k.value": [)" + values + R"(], "force.cosine": [)" + values +
                               "]}}]");
       }},
      line("fewer combinations allowed than there are", {"frf", "scene.json", "--combinations", "11"},
           "have 12 combinations, must be at most 11"),
      line("--to beyond every frequency", {"frf", "scene.json", "--to", "1e300"},
           "--to 1e+300: found 1e+300, must be at most 1e+100 Hz"),
      line("--to beyond every frequency in run", {"run", "scene.json", "--to", "1e300"},
           "--to 1e+300: found 1e+300, must be at most 1e+100 Hz"),
      // places
      line("a scene that is not there", {"run", "nothing.json"}, "nothing.json: No such file or directory"),
      line("a folder as the scene", {"run", "."}, ". is a directory, must be a scene file"),
      line("results into a folder that is not there", {"frf", "scene.json", "--json", "nowhere/frf.json"},
           "cannot write nowhere/frf.json: No such file or directory (create the folder first, or check its "
           "name)"),
      line("results into a folder", {"frf", "scene.json", "--csv", "."}, "Is a directory (it is a folder"),
      line("results into the scene file itself", {"frf", "scene.json", "--json", "./scene.json"},
           "./scene.json is the scene file itself"),
      line("JSON and CSV into one place", {"frf", "scene.json", "--json", "-", "--csv", "-"},
           "--json and --csv both go to standard output"),
      line("an output folder that is a file", {"run", "scene.json", "--out", "scene.json"},
           "cannot create the folder scene.json"),
      line("an output folder that cannot be made", {"run", "scene.json", "--out", "/proc/arcslip"},
           "cannot create the folder /proc/arcslip"),
      line("a file where no file can be made", {"frf", "scene.json", "--json", "/proc/frf.json"},
           "cannot write /proc/frf.json"),
      line(
          "a full disk", {"frf", "scene.json", "--set", "damper.normal_load=3", "--json", "/dev/full"},
          "cannot write /dev/full: No space left on device (free some space there or write to another disk)"),
      line("a full disk for the table",
           {"frf", "scene.json", "--set", "damper.normal_load=3", "--csv", "/dev/full"},
           "cannot write /dev/full: No space left on device"),
      line("a verb with control characters", {"\x1b[31mfry\xc2\x9b", "scene.json"},
           "unknown verb \"\\u001b[31mfry\\u009b\""),
      line("results into two files that are one",
           {"frf", "scene.json", "--json", "a.json", "--csv", "./a.json"},
           "--json and --csv both go to ./a.json: choose another path for one of them"),
      printed_on("/dev/full", "a full disk below standard output",
                 {"frf", "scene.json", "--set", "damper.normal_load=3", "--json", "-"},
                 "cannot write standard output: No space left on device"),
      printed_on("/dev/full", "a full disk below the resolved scene", {"check", "scene.json"},
                 "cannot write standard output: No space left on device"),
      printed_on("/dev/full", "a full disk below the help", {"--help"},
                 "cannot write standard output: No space left on device"),
      // scenes
      scene("an empty scene", "the file is empty", [] { return ""; }),
      scene("a truncated scene", "bad.json: line 1, column 37: the file ends too early",
            [] { return R"({"format": "arcslip-scene-1", "struc)"; }),
      scene("nesting 100 000 deep", "nested deeper than 64", [] { return std::string(100'000, '['); }),
      scene("a number of more than 64 MB", "found a file of 67108866 bytes, a scene must be at most 64 MB",
            [] { return "[" + std::string((64u << 20) + 1, '1'); }),
      scene("a number of 10 MB", "a number that is too large",
            [] { return "[" + std::string(10'000'000, '1') + "]"; }),
      scene("a negative mass", "bad.json: /structure/masses/0/value: found -1.24",
            [] { return scene_with(structure("-1.24", "100"), study("1", "2")); }),
      scene("NaN", "a number must be finite (JSON has no NaN and no Infinity)",
            [] { return scene_with(structure("NaN", "100"), study("1", "2")); }),
      scene(
          "two parts of one name", "bad.json: /structure/springs/0/name: found the name \"m\" again",
          [] {
            return scene_with(
                R"({"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "m", "at": "x", "value": 100}]})",
                study("1", "2"));
          }),
      scene(
          "a degree of freedom that is not there",
          "bad.json: /structure/springs/0/at: found \"y\", must be one of the degrees of freedom",
          [] {
            return scene_with(
                R"({"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "y", "value": 100}]})",
                study("1", "2"));
          }),
      scene("no stiffness at all",
            "bad.json: /structure/springs: found no stiffness, must have at least one spring",
            [] { return scene_with(structure("1", "0"), study("1", "2")); }),
      scene(
          "a study over a parameter that is not there",
          "bad.json: /studies/0/over: found the unknown parameter \"k.valeu\"",
          [] {
            return scene_with(
                structure("1", "100"),
                R"(, "studies": [{"kind": "trace", "over": "k.valeu", "from": 1, "to": 2, "frequency": 1}])");
          }),
      scene("a study that ends before it begins", "bad.json: /studies/0/to: found 1, must be above \"from\"",
            [] { return scene_with(structure("1", "100"), study("2", "1")); }),
  };
}

}  // namespace

const std::vector<BadInput>& bad_inputs() {
  static const std::vector<BadInput> all = make();
  return all;
}

}  // namespace app_test
