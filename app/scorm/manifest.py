"""The file imsmanifest.xml of a package, as SCORM 1.2 wants it: one organization, one item, one SCO."""

from __future__ import annotations

import re
from collections.abc import Iterable
from urllib.parse import quote
from xml.etree import ElementTree

FILE = "imsmanifest.xml"
"""Its name; it stands at the package's root."""

_CONTENT = "http://www.imsproject.org/xsd/imscp_rootv1p1p2"
_ADL = "http://www.adlnet.org/xsd/adlcp_rootv1p2"
_LONGEST_TITLE = 200
"""Letters of a title that every LMS takes."""
_NO_NAME = re.compile(r"[^A-Za-z0-9._-]")


def manifest(name: str, title: str, files: Iterable[str], page: str) -> bytes:
    """The manifest.

    The standard's schemas are not named: they would have to lie beside it, and no LMS needs them. No
    ``masteryscore`` is given either: an LMS that has one overwrites the status which the page tells, with
    "failed" while a student is still on the way.

    Args:
        name: of the lab, from which the identifiers follow. A new package of the same lab has the same
            identifiers, so that an LMS keeps what its students have done.
        title: of the lab.
        files: every file of the package but the manifest, as paths from its root.
        page: which of them is launched.

    Returns:
        XML, with one end for the same arguments.
    """
    own = _NO_NAME.sub("-", name)
    root = ElementTree.Element("manifest", {"identifier": f"heli2dof-{own}", "version": "1.0"})
    root.set("xmlns", _CONTENT)
    root.set("xmlns:adlcp", _ADL)
    metadata = ElementTree.SubElement(root, "metadata")
    ElementTree.SubElement(metadata, "schema").text = "ADL SCORM"
    ElementTree.SubElement(metadata, "schemaversion").text = "1.2"
    organizations = ElementTree.SubElement(root, "organizations", {"default": f"course-{own}"})
    organization = ElementTree.SubElement(organizations, "organization", {"identifier": f"course-{own}"})
    ElementTree.SubElement(organization, "title").text = title[:_LONGEST_TITLE]
    launched = {"identifier": f"item-{own}", "identifierref": f"page-{own}", "isvisible": "true"}
    item = ElementTree.SubElement(organization, "item", launched)
    ElementTree.SubElement(item, "title").text = title[:_LONGEST_TITLE]
    resources = ElementTree.SubElement(root, "resources")
    # in 1.2 the attribute's name is in small letters throughout
    sco = {"identifier": f"page-{own}", "type": "webcontent", "adlcp:scormtype": "sco", "href": quote(page)}
    resource = ElementTree.SubElement(resources, "resource", sco)
    for file in sorted(files):
        ElementTree.SubElement(resource, "file", {"href": quote(file)})
    ElementTree.indent(root)
    return ElementTree.tostring(root, "utf-8", xml_declaration=True) + b"\n"
