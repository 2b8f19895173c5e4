"""The conversions of docs/finite_elements.md, run on files that other programs' formats prescribe."""

import pathlib
import re

import pytest

numpy = pytest.importorskip("numpy")
scipy_io = pytest.importorskip("scipy.io")
sparse = pytest.importorskip("scipy.sparse")

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "finite_elements.md"
K = numpy.array([[4.0, -1.0, 0.0], [-1.0, 5.0, -2.0], [0.0, -2.0, 6.0]])
M = numpy.diag([1.0, 2.0, 3.0])


def run(section: str, block: int) -> None:
    """Run a block of Python code of a section in the current folder."""
    text = PAGE.read_text().split(f"## {section}\n", 1)[1].split("\n## ", 1)[0]
    exec(re.findall(r"```python\n(.*?)```", text, re.DOTALL)[block], {})


def check() -> None:
    for path, matrix in (("blade_K.mtx", K), ("blade_M.mtx", M)):
        assert numpy.array_equal(scipy_io.mmread(path).toarray(), matrix)


def test_harwell_boeing_files_of_one_triangle(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for path, matrix in (("blade_K.hb", K), ("blade_M.hb", M)):
        scipy_io.hb_write(path, sparse.csc_matrix(numpy.tril(matrix)))
        file = pathlib.Path(path)
        file.write_text(file.read_text().replace("RUA", "RSA"))
    run("Ansys", 0)
    check()


def test_punch_files(tmp_path, monkeypatch):
    pytest.importorskip("pyNastran")
    monkeypatch.chdir(tmp_path)
    points = [(1, 1), (1, 3), (7, 0)]
    lines = []
    for name, matrix in (("KAAX", K), ("MAAX", M)):
        lines.append(f"{'DMIG':<8}{name:<8}{0:>8}{6:>8}{2:>8}{0:>8}{'':>8}{'':>8}")
        for j, (node, component) in enumerate(points):
            lines.append(f"{'DMIG*':<8}{name:<16}{node:>16}{component:>16}")
            for i in range(j, 3):
                if matrix[i, j]:
                    value = f"{matrix[i, j]:.9E}".replace("E", "D")
                    lines.append(f"{'*':<8}{points[i][0]:>16}{points[i][1]:>16}{value:>16}")
    pathlib.Path("blade.pch").write_text("\n".join(lines) + "\n")
    run("Nastran", 0)
    check()
    assert pathlib.Path("names.csv").read_text() == "name,row\nn1.x,1\nn1.z,2\nn7.s,3\n"


def test_op4_files(tmp_path, monkeypatch):
    op4 = pytest.importorskip("pyNastran.op4.op4")
    monkeypatch.chdir(tmp_path)
    op4.OP4(debug=False).write_op4("blade.op4", {"KAA": (6, K), "MAA": (6, M)}, is_binary=False)
    run("Nastran", 1)
    check()
