# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the C interface: one for each section of each header."""
import re

from c_source import rules_about
from text import heading, indented, summary


def file_name(title):
    return re.sub(r"[^a-z0-9]+", "_", title.lower()).strip("_")


def of_kind(entity):
    return {"function": "c:func", "struct": "c:struct", "opaque": "c:struct", "callback": "c:type", "plain": "c:type", "macro": "c:macro"}.get(entity.kind)


def roles_of(sources):
    """{name: role} of everything that the headers declare."""
    roles = {}
    for source in sources:
        for entity in source.entities:
            if entity.name:
                roles[entity.name] = of_kind(entity)
            if entity.kind in ("enum", "statuses"):
                roles.update({member.name: "c:enumerator" for member in entity.members})
    return roles


def example_lines(example, language, known):
    """known: pages of listings by path."""
    page = f"/listings/{example.path}"
    if example.path.endswith(".md"):
        page = "/" + example.path.removeprefix("docs/").removesuffix(".md")
    else:
        known.add(example.path)
    return [f".. code-block:: {language}", f"   :caption: from :doc:`{example.path} <{page}>`, line {example.line}", "",
            *indented(example.text.split("\n")), ""]


class CPages:
    def __init__(self, names, calls, listings):
        self.names, self.calls, self.listings = names, calls, listings

    def member(self, directive, member):
        text = member.text or (["sizeof the struct"] if member.name == "struct_size" else [])
        return [f".. {directive}:: {member.declaration}", "", *indented(self.names.block(text)), ""]

    def functions(self, group):
        """Functions of one comment: all signatures, the comment, examples."""
        lines = [f".. c:function:: {group[0].declaration}"] + ["                 " + function.declaration for function in group[1:]] + [""]
        body = self.names.block(group[0].text)
        shown = ""
        for function in group:
            example = self.calls.find(function.name)
            if example and not re.search(rf"\b{function.name}\b", shown):
                language = "c" if example.path.endswith((".c", ".md")) else "cpp"
                body += example_lines(example, language, self.listings)
                shown += example.text
        return lines + indented(body) + [""]

    def entity(self, entity):
        body = self.names.block(entity.text)
        if entity.kind in ("struct", "opaque"):
            members = [line for member in entity.members for line in self.member("c:member", member)]
            return [f".. c:struct:: {entity.name}", "", *indented(body + members)]
        if entity.kind in ("callback", "plain"):
            return [f".. c:type:: {entity.declaration.removeprefix('typedef ')}", "", *indented(body)]
        if entity.kind == "macro":
            return [f".. c:macro:: {entity.name}", "", *indented([f"Value: ``{entity.declaration}``.", ""] + body)]
        return body + [line for member in entity.members for line in self.member("c:enumerator", member)]

    def page(self, header, section):
        lines = [f".. index:: {section.title}", ""] + heading(section.title) + [f"``#include <{header}>``", ""]
        group = []
        for item in section.items + [[]]:
            if group and (isinstance(item, list) or item.first is not group[0]):
                lines += self.functions(group)
                group = []
            if isinstance(item, list):
                lines += self.names.block(item)
            elif item.kind == "function":
                group.append(item)
            else:
                lines += self.entity(item)
        return lines

    def rules(self, source, section):
        """Errors that other sections describe."""
        functions = [entity for entity in section.entities if entity.returns_status]
        inherited = {text for entity in functions for text in rules_about(source, entity) if "functions below" in text}
        return [line for text in sorted(inherited) for line in self.names.paragraph(text)]

    def header(self, header, source):
        """{file name: lines} of a header, its index among them."""
        folder = header.removesuffix(".h")
        pages, rows = {}, []
        for section in source.sections:
            name = file_name(section.title)
            pages[f"{folder}/{name}"] = self.page(header, section) + self.rules(source, section)
            rows.append((name, section))
        intro = list(source.intro)
        title, _, rest = " ".join(intro[0].split()).partition(": ")
        intro[0] = rest[:1].upper() + rest[1:]
        index = heading(header) + self.names.block(intro) + [".. toctree::", "   :maxdepth: 1", ""] + [f"   {name}" for name, _ in rows] + [""]
        for name, section in rows:
            functions = [entity for entity in section.entities if entity.kind == "function"]
            if functions:
                index += [f".. rubric:: {section.title}", "", ".. list-table::", "   :class: summary", "   :widths: 40 60", ""]
                for function in functions:
                    said = summary(function.text) if function.first is function or function.text is not function.first.text else summary(function.first.text)
                    index += [f"   * - :c:func:`{function.name}`", f"     - {self.names.inline(said)}"]
                index.append("")
        pages[f"{folder}/index"] = index
        return pages
