"""The C++ interface: Doxygen reads the header, Breathe makes the pages."""
import glob
import os
import subprocess
import xml.etree.ElementTree as tree

from examples import Calls
from interfaces import ROOT
from text import heading

DOXYFILE = """INPUT = {header}
OUTPUT_DIRECTORY = {folder}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
EXTRACT_ALL = NO
HIDE_UNDOC_MEMBERS = NO
HIDE_FRIEND_COMPOUNDS = YES
EXCLUDE_SYMBOLS = carreau::detail carreau::detail::*
JAVADOC_AUTOBRIEF = YES
MACRO_EXPANSION = YES
WARNINGS = NO
WARN_IF_UNDOCUMENTED = NO
QUIET = YES
"""


def doxygen(header, folder):
    """XML of a header in `folder`/xml."""
    os.makedirs(folder, exist_ok=True)
    subprocess.run(["doxygen", "-"], input=DOXYFILE.format(header=os.path.join(ROOT, header), folder=folder), text=True, check=True, cwd=ROOT,
                   stdout=subprocess.DEVNULL)
    return os.path.join(folder, "xml")


def said(element):
    """Whether a description has words."""
    return any("".join(element.find(part).itertext()).strip() for part in ("briefdescription", "detaileddescription") if element.find(part) is not None)


class Entity:
    def __init__(self, name, scope, kind, described):
        self.name, self.scope, self.kind, self.described = name, scope, kind, described


def entities(xml):
    """Public classes, functions, types and enumerations of the namespace, with whether they are described."""
    found = []
    for path in sorted(glob.glob(os.path.join(xml, "*.xml"))):
        for compound in tree.parse(path).getroot().findall("compounddef"):
            kind, scope = compound.get("kind"), compound.findtext("compoundname")
            if kind not in ("class", "struct", "namespace") or not scope.startswith("carreau") or compound.get("prot", "public") != "public":
                continue
            if kind != "namespace":
                found.append(Entity(scope.rsplit("::", 1)[-1], scope, kind, said(compound)))
            for member in compound.iter("memberdef"):
                name = member.findtext("name")
                trivial = member.findtext("argsstring", "").endswith(("=delete", "=default")) or name.startswith(("~", "operator"))
                if member.get("prot") == "public" and member.get("kind") in ("function", "variable", "enum", "typedef") and not trivial:
                    found.append(Entity(name, scope, member.get("kind"), said(member)))
    return found


def stage(site, header, calls: Calls):
    from c_pages import example_lines
    xml = doxygen(header, os.path.join(site.folder, "..", "doxygen"))
    lines = heading(os.path.basename(header)) + [f"``#include <{os.path.basename(header)}>``", "", ".. doxygennamespace:: carreau", "   :project: carreau", "   :members:", ""]
    lines += heading("Examples", "-")
    for entity in entities(xml):
        example = calls.find(entity.name) if entity.kind == "function" else None
        if example:
            lines += [f".. rubric:: {entity.scope}::{entity.name}", ""] + example_lines(example, "cpp", site.places.listings)
    site.write("reference/cpp/index.rst", "\n".join(lines) + "\n")
