#!/usr/bin/env python3
"""Each limit of limits.toml holds as far as it goes, and fails one step beyond, in sources made for that."""

import contextlib
import io
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest

sys.dont_write_bytecode = True
import limits  # noqa: E402

TABLE = tomllib.loads((pathlib.Path(__file__).parent / "limits.toml").read_text(encoding="utf-8"))


def function(lines, decisions=0, name="f"):
    body = [f"  if (x) {name}({i});" for i in range(decisions)]
    return "\n".join([f"int {name}(int x) {{", *body, *(f"  x += {i};" for i in range(lines - 2 - decisions)), "}", ""])


def block(lines):
    return "".join(f"int value_{i} = {i};\n" for i in range(lines))


class Limits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.table = {name: {**table, "except": {}} for name, table in TABLE.items()}
        self.table["places"] = {name: ["lib"] for name in TABLE["places"]}

    def failed(self, files):
        with tempfile.TemporaryDirectory(dir=self.folder) as place:
            for path, text in files.items():
                file = pathlib.Path(place) / "lib" / path
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            return list(limits.failures(pathlib.Path(place), self.table))

    def expect(self, files, *beginnings):
        failed = self.failed(files)
        self.assertEqual(len(failed), len(beginnings), failed)
        for failure, beginning in zip(failed, beginnings):
            self.assertTrue(failure.startswith(beginning), failure)
            self.assertIn("\n    ", failure)  # what to do

    def test_a_folder_with_one_file_too_many(self):
        files = {f"room/{i}.txt": "" for i in range(30)}
        self.expect(files | {"room/below/31.txt": ""})
        self.expect(files | {"room/31.txt": ""}, "lib/room: files in a folder: 31, must be at most 30")

    def test_a_name_in_two_files_that_are_compiled_as_one(self):
        own = "namespace a {\nnamespace {\nconstexpr int most = 3;\nint f(double x) { return 1; }\n}\n}\n"
        other = own.replace("most", "least").replace("double", "int")
        self.expect({"x/a.cpp": own, "y/b.cpp": own})
        self.expect({"x/a.cpp": own, "x/below/b.cpp": other})
        self.expect({"x/a.cpp": own, "x/below/b.cpp": other.replace("least", "most")},
                    "lib/x: most: files with a name: 2, must be at most 1, in lib/x/a.cpp, lib/x/below/b.cpp")
        self.expect({"x/a.cpp": own, "x/below/b.cpp": other.replace("int x", "double x")},
                    "lib/x: f: files with a name: 2, must be at most 1")

    def test_a_file_with_one_line_too_many(self):
        lines = [f"int i_{i};" for i in range(601)]
        self.expect({"a.cpp": "\n".join(lines[:600])})
        self.expect({"a.cpp": "\n".join(lines)}, "lib/a.cpp: lines of a file: 601, must be at most 600")

    def test_a_function_with_one_line_too_many(self):
        self.expect({"a.cpp": function(60)})
        self.expect({"a.cpp": function(61)}, "lib/a.cpp: f: lines of a function: 61, must be at most 60")
        self.expect({"a.hpp": f"namespace a {{\nclass A {{\n{function(61)}}};\n}}\n"},
                    "lib/a.hpp: A::f: lines of a function: 61, must be at most 60")
        self.expect({"a.cpp": f"template <class T>\nrequires(sizeof(T) > 1)\n{function(61)}"},
                    "lib/a.cpp: f: lines of a function: 61, must be at most 60")

    def test_a_function_with_one_decision_too_many(self):
        self.expect({"a.cpp": function(40, 19)})
        self.expect({"a.cpp": function(40, 20)}, "lib/a.cpp: f: complexity of a function: 21, must be at most 20")

    def test_every_kind_of_decision(self):
        for decision in ("if (x) y();", "for (;;) y();", "while (x) y();", "y(x ? 1 : 2);", "y(x && z);", "y(x || z);",
                         "case 1:", "catch (...) {}", "y([&] { if (x) z(); });"):
            self.expect({"a.cpp": function(40, 19).replace("x += 0;", decision, 1)},
                        "lib/a.cpp: f: complexity of a function: 21")

    def test_what_is_no_decision(self):
        for other in ("// if (x) y();", "/* if for\n while */", 'y("if (x ? y : z)");', 'y(R"(if (x) ")");', "y('?');",
                      "auto&& r = x;", "int i = 1'000'000;  // if", "const bool iffy = format(x);"):
            self.expect({"a.cpp": function(40, 19).replace("x += 0;", other, 1)})

    def test_one_header_with_a_single_user_too_many(self):
        most = self.table["headers_with_one_user"]["most"]
        files = {f"{i}/a.hpp": "" for i in range(most + 1)}
        files |= {f"{i}/a.cpp": f"#include <arcslip/{i}/a.hpp>\n" for i in range(most + 1)}  # its own, no user
        users = {f"user/{i // 20}/{i}.cpp": f"#include <arcslip/{i}/a.hpp>\n" for i in range(most + 1)}
        self.expect(files | users, f"all: headers with one user: {most + 1}, must be at most {most}\n    lib/0/a.hpp in lib/user")
        self.expect(files | users | {"other.cpp": '#include "0/a.hpp"\n'})

    def test_one_repeated_block_too_many(self):
        most, lines = self.table["repeated_blocks"]["most"], self.table["repeated_blocks"]["lines"]
        files = {f"{i}.cpp": block(lines) for i in range(most + 1)}
        self.expect(files)
        self.expect(files | {"a.cpp": "// a comment\nint other;\n\n  " + block(lines)},
                    f"all: repeated blocks: {most + 1}, must be at most {most}\n    lib/1.cpp:1 as lib/0.cpp:1")
        self.expect(files | {"a.cpp": block(lines - 1)})

    def test_a_longer_block_counts_once(self):
        self.table["repeated_blocks"]["most"] = 1
        self.expect({"a.cpp": block(40), "b.cpp": block(40)})

    def test_a_retired_word(self):
        for word in TABLE["retired_words"]["words"]:
            for text in ("// It is {}.", "int f_{} = 0;", "int {}_;", 'f("{}");'):
                for form in (word, word.capitalize()):
                    self.expect({"a.cpp": "\n" + text.format(form)},
                                f"lib/a.cpp: {word}: retired words: 1, must be at most 0, in lines 2; instead: ")
            self.expect({"a.md": f"It is\n{word}.\n"}, f"lib/a.md: {word}: retired words: 1")
            self.expect({"a.cpp": f"// {word}ed, re{word}"})

    def test_a_retired_name(self):
        for name in TABLE["retired_words"]["names"]:
            self.expect({"a.cpp": f"struct {name} {{}};"}, f"lib/a.cpp: {name}: retired words: 1")
            self.expect({"a.cpp": f'// {name}\nint i = f("{name}"), the{name} = i;\n', "a.md": name})

    def test_an_exception_holds_up_to_its_number(self):
        self.table["lines_of_a_function"]["except"] = {"lib/a.cpp: f": [65, "a reason"]}
        self.expect({"a.cpp": function(65)})
        self.expect({"a.cpp": function(66)}, "lib/a.cpp: f: lines of a function: 66, must be at most 65 by its exception")
        self.expect({"a.cpp": function(61, name="g") + function(61)}, "lib/a.cpp: g: lines of a function: 61")

    def test_a_needless_exception(self):
        self.table["lines_of_a_function"]["except"] = {"lib/a.cpp: f": [65, "a reason"]}
        self.expect({"a.cpp": function(60)}, "lib/a.cpp: f: lines of a function: its exception is needless")
        self.expect({"b.cpp": ""}, "lib/a.cpp: f: lines of a function: its exception is needless")

    def test_the_command_fails_and_names_its_table(self):
        (self.folder / "tests/limits").mkdir(parents=True)
        table = (pathlib.Path(__file__).parent / "limits.toml").read_text(encoding="utf-8")
        exception = re.compile(r'^".*\n', re.MULTILINE)
        (self.folder / "tests/limits/limits.toml").write_text(exception.sub("", table), encoding="utf-8")
        for place in TABLE["places"]["all"]:
            (self.folder / place).mkdir(exist_ok=True)
        (self.folder / "lib/a.cpp").write_text(function(61), encoding="utf-8")
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.assertEqual(limits.main([str(self.folder)]), 1)
        self.assertIn("lib/a.cpp: f: lines of a function: 61", printed.getvalue())
        self.assertIn("tests/limits/limits.toml", printed.getvalue())

    def test_every_exception_has_a_reason(self):
        for table in TABLE.values():
            for subject, (most, reason) in table.get("except", {}).items():
                self.assertGreater(most, table["most"], subject)
                self.assertGreater(len(reason.split()), 3, subject)


if __name__ == "__main__":
    unittest.main()
