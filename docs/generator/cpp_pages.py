# SPDX-License-Identifier: BSD-3-Clause
"""The C++ interface: Doxygen reads the headers, Breathe makes the pages."""
import glob
import os
import subprocess
import xml.etree.ElementTree as tree

from examples import Calls
from interfaces import ROOT
from text import heading

DOXYFILE = """INPUT = {headers}
FILE_PATTERNS = *.hpp
FILTER_PATTERNS = *.hpp="python3 {filter}"
OUTPUT_DIRECTORY = {folder}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
EXTRACT_ALL = NO
HIDE_UNDOC_MEMBERS = NO
HIDE_FRIEND_COMPOUNDS = YES
EXCLUDE_SYMBOLS = carreau::detail carreau::detail::* carreau::metric::detail
JAVADOC_AUTOBRIEF = YES
MACRO_EXPANSION = YES
WARNINGS = NO
WARN_IF_UNDOCUMENTED = NO
QUIET = YES
AUTOLINK_SUPPORT = NO
WARN_IF_UNDOCUMENTED = NO
"""


def doxygen(headers, folder):
    """XML of headers in `folder`/xml."""
    os.makedirs(folder, exist_ok=True)
    text = DOXYFILE.format(headers=" ".join(f'"{os.path.join(ROOT, header)}"' for header in headers if os.path.exists(os.path.join(ROOT, header))), folder=folder,
                           filter=os.path.join(os.path.dirname(os.path.abspath(__file__)), "cpp_filter.py"))
    subprocess.run(["doxygen", "-"], input=text, text=True, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
    return os.path.join(folder, "xml")


def said(element):
    """True if a description has words."""
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
            if kind not in ("class", "struct", "namespace") or not scope.startswith("carreau") or "detail" in scope or compound.get("prot", "public") != "public":
                continue
            if kind != "namespace":
                found.append(Entity(scope.rsplit("::", 1)[-1], scope, kind, said(compound)))
            for member in compound.iter("memberdef"):
                name = member.findtext("name")
                trivial = member.findtext("argsstring", "").endswith(("=delete", "=default")) or name.startswith(("~", "operator"))
                if member.get("prot") == "public" and member.get("kind") in ("function", "variable", "enum", "typedef") and not trivial:
                    # The comment of a struct is about its members, too.
                    told = said(member) or member.get("kind") == "variable" and said(compound)
                    found.append(Entity(name, scope, member.get("kind"), told))
    return found


def stage(site, headers, calls: Calls):
    from c_pages import example_lines
    xml = doxygen(headers, os.path.join(site.folder, "..", "doxygen"))
    lines = heading("C++") + ["``#include <carreau.hpp>``, and ``<carreau_cad.hpp>`` for files of CAD, whose library is linked besides. Headers alone, for C++20.", "",
                              "A function does what the function of the C interface does that it is named after, by its rules; structs of results are those "
                              "of C.", "", ".. doxygennamespace:: carreau", "   :project: carreau", "   :members:", ""]
    lines += heading("Examples", "-")
    for entity in entities(xml):
        example = calls.find(entity.name) if entity.kind == "function" else None
        if example:
            lines += [f".. rubric:: {entity.scope}::{entity.name}", ""] + example_lines(example, "cpp", site.places.listings)
    site.write("reference/cpp/index.rst", "\n".join(lines) + "\n")
