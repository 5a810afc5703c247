# SPDX-License-Identifier: BSD-3-Clause
"""A Sphinx domain of Fortran: subroutines, functions, types, interfaces of callbacks, constants of modules. Sphinx has none."""
from sphinx import addnodes
from sphinx.directives import ObjectDescription
from sphinx.domains import Domain, ObjType
from sphinx.roles import XRefRole
from sphinx.util.nodes import make_id, make_refnode

KINDS = {"subroutine": "sub", "function": "func", "type": "type", "interface": "interface", "constant": "const"}


class FortranObject(ObjectDescription):
    """`.. f:subroutine:: name(arguments)` and its like; `constant` takes `name = value`."""

    def handle_signature(self, signature, node):
        name = signature.split("(")[0].split("=")[0].strip()
        if self.objtype != "constant":
            node += addnodes.desc_annotation(self.objtype, self.objtype)
            node += addnodes.desc_sig_space()
        node += addnodes.desc_name(name, name)
        rest = signature[len(name):]
        arguments, bracket, result = rest.partition(")")
        if bracket:
            parameters = addnodes.desc_parameterlist()
            for argument in filter(None, arguments.lstrip("(").split(", ")):
                parameters += addnodes.desc_parameter(argument, argument)
            node += parameters
            rest = result
        if rest:
            node += addnodes.desc_annotation(rest, rest)
        return name

    def add_target_and_index(self, name, signature, node):
        anchor = make_id(self.env, self.state.document, "f", name)
        node["ids"].append(anchor)
        self.state.document.note_explicit_target(node)
        self.env.get_domain("f").note(name, self.objtype, self.env.docname, anchor)
        self.indexnode["entries"].append(("single", f"{name} (Fortran {self.objtype})", anchor, "", None))


class FortranDomain(Domain):
    name, label = "f", "Fortran"
    object_types = {kind: ObjType(kind, role) for kind, role in KINDS.items()}
    directives = {kind: FortranObject for kind in KINDS}
    roles = {role: XRefRole() for role in KINDS.values()}
    initial_data = {"objects": {}}  # name: (kind, page, anchor)

    def note(self, name, kind, page, anchor):
        self.data["objects"][name] = (kind, page, anchor)

    def clear_doc(self, docname):
        self.data["objects"] = {name: found for name, found in self.data["objects"].items() if found[1] != docname}

    def merge_domaindata(self, docnames, otherdata):
        self.data["objects"].update({name: found for name, found in otherdata["objects"].items() if found[1] in docnames})

    def resolve_xref(self, env, fromdocname, builder, typ, target, node, contnode):
        found = self.data["objects"].get(target)
        return make_refnode(builder, fromdocname, found[1], found[2], contnode, target) if found else None

    def resolve_any_xref(self, env, fromdocname, builder, target, node, contnode):
        found = self.resolve_xref(env, fromdocname, builder, "", target, node, contnode)
        return [("f:" + KINDS[self.data["objects"][target][0]], found)] if found else []

    def get_objects(self):
        for name, (kind, page, anchor) in self.data["objects"].items():
            yield name, name, kind, page, anchor, 1


def setup(app):
    app.add_domain(FortranDomain)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
