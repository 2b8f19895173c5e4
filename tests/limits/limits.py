#!/usr/bin/env python3
"""limits.py [--all] [FOLDER]

Fails where the sources in FOLDER, by default those that this file belongs to, are beyond a limit of
tests/limits/limits.toml, and where an exception in it is needless. With --all it prints what is beyond a limit, excepted or
not, and does not fail. Needs ctags of Debian's package universal-ctags, which finds the functions.
"""

import collections
import functools
import pathlib
import posixpath
import re
import subprocess
import sys
import tomllib

TABLE = "tests/limits/limits.toml"
COMMENT = r"//[^\n]*|/\*.*?\*/"
STRING = r'R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\''
NO_CODE = re.compile(STRING + "|" + COMMENT, re.DOTALL)
DECISION = re.compile(r"\b(?:if|for|while|case|catch|and|or)\b|(?<=\s)(?:&&|\|\|)(?=\s)|\?")
INCLUDE = re.compile(r'^#include (?:<arcslip/([^>]+)>|"([^"]+)")', re.MULTILINE)

# What was measured: of what, its size, and where or what that is in detail.
Found = collections.namedtuple("Found", "subject size detail", defaults=[""])


@functools.cache
def read(file):
    """Returns the text of a file and the code in it, lines of C++ without comments and the contents of strings, or None."""
    try:
        text = file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return None, None
    if file.suffix not in (".cpp", ".hpp"):
        return text, None
    return text, NO_CODE.sub(lambda found: '""' + "\n" * found[0].count("\n"), text).splitlines()


class Sources:
    """The files below some folders, their texts, and the code of those in C++."""

    def __init__(self, folder, places):
        self.folder = folder
        self.paths, self.texts, self.code = [], {}, {}
        for place in places:
            if not (folder / place).exists():
                sys.exit(f"{TABLE}: there is no {place} in {folder}")
            for file in [folder / place] if (folder / place).is_file() else sorted((folder / place).rglob("*")):
                if file.is_dir() or "__pycache__" in file.parts:
                    continue
                path = file.relative_to(folder).as_posix()
                self.paths.append(path)
                text, code = read(file)
                if text is not None:
                    self.texts[path] = text
                if code is not None:
                    self.code[path] = code


@functools.cache
def sources_in(folder, places):
    return Sources(folder, places)


def files_in_a_folder(sources, _):
    for folder, size in collections.Counter(path.rpartition("/")[0] for path in sources.paths).items():
        yield Found(folder, size)


def lines_of_a_file(sources, _):
    for path in sources.code:
        yield Found(path, len(sources.texts[path].splitlines()))


def tags(sources, kinds):
    """Yields name, file, kind and fields of what ctags finds."""
    try:
        found = subprocess.run(["ctags", "-L", "-", "--languages=C++", f"--kinds-C++={kinds}", "--fields=KneSsZ", "-f", "-"],
                               check=True, cwd=sources.folder, input="\n".join(sources.code), capture_output=True,
                               text=True).stdout
    except (FileNotFoundError, subprocess.CalledProcessError):
        sys.exit("There is no Universal Ctags, which finds the functions: install universal-ctags.")
    for tag in found.splitlines():
        name, file, *_, others = tag.split("\t", 3)
        kind, *others = others.split("\t")
        yield name, file, kind, dict(other.split(":", 1) for other in others if ":" in other)


@functools.cache
def functions(sources):
    """Returns file, name and lines of each function."""
    found = []
    for name, file, _, fields in tags(sources, "f"):
        scope = fields.get("scope", "")
        if scope.startswith(("class:", "struct:")):
            name = scope.split(":")[-1] + "::" + name
        if not name.startswith("__anon"):  # a lambda is a part of its function
            found.append((file, name, sources.code[file][int(fields["line"]) - 1:int(fields["end"])]))
    return found


def lines_of_a_function(sources, _):
    for file, name, lines in functions(sources):
        yield Found(f"{file}: {name}", len(lines))


def complexity_of_a_function(sources, _):
    for file, name, lines in functions(sources):
        yield Found(f"{file}: {name}", 1 + len(DECISION.findall("\n".join(lines))))


def files_with_a_name(sources, _):
    """Counts the files of a room that have a name of their own: its files are compiled as one (cmake/ArcslipTarget.cmake)."""
    files = collections.defaultdict(set)
    for name, file, kind, fields in tags(sources, "fvscg"):
        scope = fields.get("scope", "")
        if not re.search(r"^namespace:.*__anon\w+$", scope) or name.startswith("__anon") or not file.endswith(".cpp"):
            continue
        room = "/".join(file.split("/")[:2 if file.startswith("lib/") else 1])
        arguments = re.sub(r"\W+", " ", fields.get("signature", "")) if kind == "function" else ""
        files[room, re.sub(r"__anon\w+", "", scope), name, arguments].add(file)
    for (room, _, name, _), of in files.items():
        yield Found(f"{room}: {name}", len(of), f", in {', '.join(sorted(of))}")


def headers_with_one_user(sources, _):
    users = collections.defaultdict(set)
    for path in sources.code:
        for below_arcslip, near in INCLUDE.findall(sources.texts[path]):
            places = [near and posixpath.normpath(pathlib.PurePosixPath(path).parent / near), below_arcslip, "lib/" + below_arcslip]
            header = next((place for place in places if place in sources.code), None)
            if header and header.removesuffix(".hpp") != path.removesuffix(".cpp"):
                users[header].add(path)
    single = sorted(f"{header} in {min(of)}" for header, of in users.items() if len(of) == 1)
    yield Found("all", len(single), "\n    ".join(["", *single]))


def repeated_blocks(sources, table):
    """Counts the places where so many lines or more stand once more; comments, includes and lone signs are no lines."""
    length = table["lines"]
    first, repeated = {}, []
    for path in sources.code:
        lines = [(number, " ".join(line.split())) for number, line in enumerate(sources.texts[path].splitlines(), 1)]
        lines = [(number, line) for number, line in lines
                 if re.search(r"\w", line) and not line.startswith(("//", "#include"))]
        last = -2  # where a block stands once more
        for at in range(len(lines) - length + 1):
            file, index, number = first.setdefault(tuple(line for _, line in lines[at:at + length]), (path, at, lines[at][0]))
            if file == path and at < index + length:
                continue
            if at != last + 1:
                repeated.append(f"{path}:{lines[at][0]} as {file}:{number}")
            last = at
    yield Found("all", len(repeated), "\n    ".join(["", *repeated]))


def retired_words(sources, table):
    words, names = table["words"], table["names"]
    in_text = re.compile(r"(?<![A-Za-z])(%s)(?![A-Za-z])" % "|".join(words), re.IGNORECASE)
    in_code = re.compile(r"(?<![A-Za-z])(%s)(?![A-Za-z])" % "|".join(names))
    for path, text in sources.texts.items():
        if path == TABLE:
            continue
        where = collections.defaultdict(list)
        for pattern, lines in (in_text, text.splitlines()), (in_code, sources.code.get(path, [])):
            for number, line in enumerate(lines, 1):
                for word in pattern.findall(line):
                    where[word if word in names else word.lower()].append(number)
        for word, lines in where.items():
            yield Found(f"{path}: {word}", len(lines),
                        f", in lines {', '.join(map(str, lines))}; instead: {(words | names)[word]}")


MEASURES = [files_in_a_folder, lines_of_a_file, lines_of_a_function, complexity_of_a_function, files_with_a_name,
            headers_with_one_user,
            repeated_blocks, retired_words]


def measured(folder, limits, measure):
    """Returns what a limit is about, the largest of a subject alone, from the largest on."""
    table = limits[measure.__name__]
    sources = sources_in(folder, tuple(limits["places"][table["in"]]))
    largest = {}
    for found in measure(sources, table):
        largest[found.subject] = max(found, largest.get(found.subject, found), key=lambda each: each.size)
    return sorted(largest.values(), key=lambda each: -each.size)


def failures(folder, limits):
    for measure in MEASURES:
        table = limits[measure.__name__]
        excepted = dict(table.get("except", {}))
        what, instead = measure.__name__.replace("_", " "), table["instead"]
        for subject, size, detail in measured(folder, limits, measure):
            most, reason = excepted.get(subject, (table["most"], ""))
            if size > table["most"]:
                excepted.pop(subject, None)
            if size > most:
                yield (f"{subject}: {what}: {size}, must be at most {most}{' by its exception' if reason else ''}{detail}\n"
                       f"    {instead}")
        for subject in excepted:
            yield (f"{subject}: {what}: its exception is needless, since it is within {table['most']} or there is none\n"
                   f"    Take it out of {TABLE}.")


def main(arguments):
    show_all = "--all" in arguments
    folders = [argument for argument in arguments if argument != "--all"]
    folder = pathlib.Path(folders[0] if folders else pathlib.Path(__file__).parents[2])
    limits = tomllib.loads((folder / TABLE).read_text(encoding="utf-8"))
    if show_all:
        for measure in MEASURES:
            most = limits[measure.__name__]["most"]
            print(f"{measure.__name__.replace('_', ' ')}, at most {most}:")
            for subject, size, detail in measured(folder, limits, measure):
                if size > most or subject == "all":
                    print(f"  {size:5} {subject}{detail}")
        return 0
    failed = list(failures(folder, limits))
    for failure in failed:
        print(failure)
    if failed:
        print(f"An exception is a line with its reason in {TABLE}, for what is best left as it is.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
