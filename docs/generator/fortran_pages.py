# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the Fortran modules: one for each section. The comment of the C entity is repeated here."""
from c_pages import example_lines, file_name
from text import heading, indented, summary

ROLES = {"subroutine": "f:sub", "function": "f:func", "callback": "f:interface", "type": "f:type", "constant": "f:const"}
BASICS = "Types, constants, callbacks"


def roles_of(modules):
    return {entity.name: ROLES[entity.kind] for module in modules for entity in module.entities}


class FortranPages:
    """c: {name: C entity}; members: {name of a constant: (C member, its enumeration)}; names: of Fortran; c_names: of C."""

    def __init__(self, names, c, members, calls, listings):
        self.names, self.c, self.members = names, c, members
        self.calls, self.listings = calls, listings

    def shared(self, entity):
        """The comment of C. Its indices count from 0, by the rule of the module."""
        twin = self.c.get(entity.name)
        return self.names.block(twin.text) if twin else []

    def parts(self, entity):
        if not entity.parts:
            return []
        twin = self.c.get(entity.name)
        said = {member.name: member.text for member in twin.members} if twin else {}
        if entity.kind != "type":
            return [".. code-block:: fortran", "", *indented([part.type for part in entity.parts]), ""]
        title = "Component"
        lines = [".. list-table::", "   :header-rows: 1", "   :class: arguments", "", f"   * - {title}", "     -"]
        for part in entity.parts:
            text = self.names.inline(" ".join(part.text or said.get(part.name, [])))
            lines += [f"   * - ``{part.type}``", f"     - {text}"]
        return lines + [""]

    def example(self, entity):
        example = self.calls.find(entity.name)
        return example_lines(example, "fortran", self.listings) if example else []

    def entity(self, entity):
        own = self.names.block(entity.text)
        body = self.shared(entity) + (own if entity.text else [])
        if entity.name in self.c:
            body += [f"In C: :{self.c_role(entity.name)}:`{self.c[entity.name].name}`.", ""]
        body += self.parts(entity) + (self.example(entity) if entity.kind in ("subroutine", "function") else [])
        directive = {"callback": "interface"}.get(entity.kind, entity.kind)
        return [f".. f:{directive}:: {entity.signature or entity.name}", "", *indented(body), ""]

    def c_role(self, name):
        return {"function": "c:func", "callback": "c:type"}.get(self.c[name].kind, "c:struct")

    def constant(self, entity):
        member, group = self.members.get(entity.name, (None, None))
        body = self.names.block(entity.text or (member.text if member else []))
        return [f".. f:constant:: {entity.name} = {entity.signature}", "", *indented(body), ""]

    def constants(self, entities):
        """Constants of one enumeration of C together, below its comment."""
        lines, last = [], None
        for entity in entities:
            group = self.members.get(entity.name, (None, None))[1]
            if group is not last and group is not None:
                lines += self.names.block(group.text)
            last = group
            lines += self.constant(entity)
        return lines

    def page(self, module, section, entities):
        lines = heading(section) + [f"Module ``{module.name}``.", ""]
        lines += [line for entity in entities if entity.kind != "constant" for line in self.entity(entity)]
        constants = [entity for entity in entities if entity.kind == "constant"]
        if constants:
            lines += heading("Constants", "-") + self.constants(constants)
        return lines

    def module(self, module):
        """{file name: lines} of a module."""
        sections = {}
        for entity in module.entities:
            basic = entity.kind in ("callback", "type", "constant")
            sections.setdefault(BASICS if basic else entity.section or "Procedures", []).append(entity)
        pages = {f"{module.name}/{file_name(title)}": self.page(module, title, entities) for title, entities in sections.items()}
        index = heading(f"module {module.name}") + self.names.block([line if not line.startswith("  - ") else line for line in module.intro])
        index += [".. toctree::", "   :maxdepth: 1", ""] + [f"   {file_name(title)}" for title in sections] + [""]
        for title, entities in sections.items():
            procedures = [entity for entity in entities if entity.kind in ("subroutine", "function")]
            if procedures:
                index += [f".. rubric:: {title}", "", ".. list-table::", "   :class: summary", "   :widths: 40 60", ""]
                for entity in procedures:
                    twin = self.c.get(entity.name)
                    said = summary(twin.text) if twin else ""
                    index += [f"   * - :{ROLES[entity.kind]}:`{entity.name}`", f"     - {self.names.inline(said or summary(entity.text))}"]
                index.append("")
        pages[f"{module.name}/index"] = index
        return pages
