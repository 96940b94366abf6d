"""SCORM packages: the manifest by the rules of SCORM 1.2, whole, the same bytes each time, small."""

from __future__ import annotations

import io
import json
import posixpath
import re
import zipfile
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest

from app.ops.settings import static_folder
from app.scorm import lab_content, steps_left_out
from app.scorm.package import scorm_package
from app.scorm.page_files import REPLACED
from heli2dof_core.labs import instructor_view, read_lab, shipped_labs, student_rig
from tests.app.test_cli import run
from tests.children import ROOT

PACKED = read_lab((ROOT / "tests/packed.yaml").read_text("utf-8"))
CONTENT = "{http://www.imsproject.org/xsd/imscp_rootv1p1p2}"
ADL = "{http://www.adlnet.org/xsd/adlcp_rootv1p2}"
NCNAME = re.compile(r"[A-Za-z_][A-Za-z0-9._-]*")
MOST = 500_000
"""Bytes of a package: a course's server takes many of them, and each student fetches one."""
IMPORTED = re.compile(r"""(?:\bfrom|\bimport|\bnew Worker\(new URL)\s*\(?\s*["'](\.[^"']+)["']""")
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)

CHILDREN = {
    "manifest": ["metadata", "organizations", "resources"],
    "metadata": ["schema", "schemaversion"],
    "organizations": ["organization"],
    "organization": ["title", "item"],
    "item": ["title"],
    "resources": ["resource"],
    "resource": ["file"],
}
"""In the order of the standard's sequences."""
ATTRIBUTES = {
    "manifest": {"identifier", "version"},
    "organizations": {"default"},
    "organization": {"identifier"},
    "item": {"identifier", "identifierref", "isvisible"},
    "resource": {"identifier", "type", "href", f"{ADL}scormtype"},
    "file": {"href"},
}


def package(name: str = "one-pair", title: str = "One pair of poles", content: Any = None) -> zipfile.ZipFile:
    made = scorm_package(name, title, content or {"lab": {}}, static_folder())
    return zipfile.ZipFile(io.BytesIO(made.content))


@pytest.fixture(scope="module")
def zipped() -> zipfile.ZipFile:
    return package()


def manifest_of(zipped: zipfile.ZipFile) -> ElementTree.Element:
    return ElementTree.fromstring(zipped.read("imsmanifest.xml"))


def checked(element: ElementTree.Element) -> None:
    """Elements and attributes are those of the schemas, in their order."""
    assert element.tag.startswith(CONTENT)
    name = element.tag.removeprefix(CONTENT)
    order = [child.tag.removeprefix(CONTENT) for child in element]
    known = CHILDREN.get(name, [])
    assert [each for each in known if each in order] == list(dict.fromkeys(order))
    assert set(element.attrib) <= ATTRIBUTES.get(name, set()), name
    for child in element:
        checked(child)


@pytest.mark.parametrize("name", ["one-pair", "2nd lab", "quälend"])
def test_the_manifest_keeps_the_standards_rules(name: str):
    zipped = package(name, "A < B & “C”")
    root = manifest_of(zipped)
    assert root.tag == f"{CONTENT}manifest"
    checked(root)
    assert root.findtext(f"{CONTENT}metadata/{CONTENT}schema") == "ADL SCORM"
    assert root.findtext(f"{CONTENT}metadata/{CONTENT}schemaversion") == "1.2"
    identifiers = [element.attrib["identifier"] for element in root.iter() if "identifier" in element.attrib]
    assert len(identifiers) == len(set(identifiers)) == 4
    assert all(NCNAME.fullmatch(each) for each in identifiers)  # of the type xs:ID
    organizations = root.find(f"{CONTENT}organizations")
    assert organizations is not None
    (organization,) = organizations
    assert organizations.attrib["default"] == organization.attrib["identifier"]
    (item,) = organization.findall(f"{CONTENT}item")
    assert item.findtext(f"{CONTENT}title") == organization.findtext(f"{CONTENT}title") == "A < B & “C”"
    (resource,) = root.iter(f"{CONTENT}resource")
    assert item.attrib["identifierref"] == resource.attrib["identifier"]
    assert resource.attrib["type"] == "webcontent" and resource.attrib[f"{ADL}scormtype"] == "sco"


def test_the_manifest_lists_every_file_and_no_other(zipped):
    (resource,) = manifest_of(zipped).iter(f"{CONTENT}resource")
    files = [unquote(file.attrib["href"]) for file in resource]
    assert len(files) == len(set(files))
    assert set(files) == set(zipped.namelist()) - {"imsmanifest.xml"}
    assert resource.attrib["href"] == "index.html" and "index.html" in files
    assert not any(re.search(r"\\|^/|\.\.|[^\x21-\x7e]", file) for file in zipped.namelist())


def test_the_same_lab_gives_the_same_bytes_and_stays_the_same_course():
    content = {"lab": {"b": 1, "a": [1.5, True]}}
    first, again = (scorm_package("one-pair", "One", content, static_folder()) for _ in range(2))
    assert first == again
    other = scorm_package("one-pair", "One pair", {"lab": {"b": 2}}, static_folder())
    assert other.content != first.content
    identifiers = [
        [element.attrib.get("identifier") for element in manifest_of(zipped).iter()]
        for zipped in (zipfile.ZipFile(io.BytesIO(made.content)) for made in (first, other))
    ]
    assert identifiers[0] == identifiers[1]


def test_whatever_a_module_names_is_there(zipped):
    names = set(zipped.namelist())
    modules = [name for name in names if name.endswith(".js") and "/vendor/" not in name]
    assert {"static/scorm/main.js", "static/splane/splane.js", "static/kernel/rigs_worker.js"} <= set(modules)
    for module in modules:
        for named in IMPORTED.findall(COMMENT.sub("", zipped.read(module).decode())):
            assert posixpath.normpath(posixpath.join(posixpath.dirname(module), named)) in names, module
    page = zipped.read("index.html").decode()
    for named in re.findall(r"""\b(?:href|src)="([^"#]+)\"""", page):
        assert named in names


def test_a_package_is_small_and_holds_nothing_that_it_does_not_use(zipped):
    names = zipped.namelist()
    assert sum(entry.compress_size for entry in zipped.infolist()) < MOST
    assert not any("swagger" in name or name.endswith((".wasm", ".json", ".d.ts")) for name in names)
    assert "static/vendor/uplot/LICENSE" in names
    assert not any(name.startswith(("static/scene/", "static/paper/", "static/exports/")) for name in names)


def test_nobody_is_asked_from_a_package(zipped):
    for own, source in REPLACED.items():
        assert zipped.read(f"static/{own}") == (static_folder() / source).read_bytes()
    assert b"http" not in zipped.read("static/net/index.js").split(b"*/", 1)[1]


def test_a_title_stays_text(zipped):
    page = package(title="</title><script>alert(1)</script>").read("index.html").decode()
    assert "<script>alert" not in page
    assert "&lt;script&gt;alert(1)" in page


def test_what_needs_a_server_is_left_out_with_the_reason():
    content, left_out = lab_content(PACKED, rigs=2)
    assert {each.step: each.why for each in left_out} == {
        "noise": "it starts with noise, which a server computes",
        "quieter": "it goes on with “With noise”, which is left out",
        "methods": "it compares methods, which a server computes",
    }
    assert [step["name"] for step in content["lab"]["steps"]] == ["settle", "loop"]
    assert [each["title"] for each in content["left_out"]] == [
        "With noise",
        "With less noise",
        "Other methods",
    ]


def test_points_are_those_that_a_page_can_give():
    content, _ = lab_content(PACKED, rigs=1)
    settle, loop = content["lab"]["steps"]
    assert {question["name"]: question["points"] for question in settle["questions"]}["why"] == 0
    assert (settle["points"], loop["points"], content["lab"]["points"]) == (14, 6, 20)


def test_a_package_holds_rigs_and_what_is_right_on_each_and_nothing_of_the_instructors():
    content, _ = lab_content(PACKED, rigs=5)
    assert [each["rig"] for each in content["rigs"]] == [student_rig(PACKED, seed) for seed in range(5)]
    for each in content["rigs"]:
        assert each["right"]["settle"]["gain"] == each["rig"]["parameters"]["K_pp"]
    assert len({each["right"]["settle"]["before"] for each in content["rigs"]}) == 5
    assert "pole" not in content["rigs"][0]["right"]["settle"]  # it is of the student's own design
    text = json.dumps(content)
    assert instructor_view(PACKED)["instructor"] and PACKED.instructor not in text
    assert "solution" not in text and "It dies away last" not in text


@pytest.mark.parametrize("name", [*shipped_labs()])
def test_every_lab_that_ships_is_packed_or_refused_with_the_reason(name: str, tmp_path: Path):
    lab, file = shipped_labs()[name], tmp_path / "lab.zip"
    left_out = steps_left_out(lab)
    if len(left_out) == len(lab.steps):
        told = run("lab", "scorm", name, "-o", str(file), status=2)
        assert "cannot be done without a server" in told.stderr and left_out[0].why in told.stderr
        assert not file.exists()
        return
    told = run("lab", "scorm", name, "-o", str(file))
    assert told.stdout == f"{file}\n" and "Practice: the page marks itself" in told.stderr
    assert all(f"left out: {each.title}: {each.why}" in told.stderr for each in left_out)
    assert file.stat().st_size < MOST
    with zipfile.ZipFile(file) as zipped:
        assert zipped.testzip() is None
        assert zipped.namelist()[0] == "imsmanifest.xml"
    run("lab", "scorm", name, "-o", str(file), status=1)  # it is there already


def test_what_needs_no_server_of_the_course_can_be_packed():
    """Noise and hidden rigs are the server's to compute, flights its to mark."""
    left_out = {lab.name for lab in shipped_labs().values() if len(steps_left_out(lab)) == len(lab.steps)}
    assert left_out == {"observer-noise", "identify", "fly-by-hand", "gust"}
