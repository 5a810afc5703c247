# SPDX-License-Identifier: BSD-3-Clause
"""The Python package, read without being imported."""
import ast
import os
from dataclasses import dataclass, field

from c_pages import example_lines
from interfaces import ROOT
from text import heading, indented


@dataclass
class Entity:
    """kind: module, class, function, method, attribute. path: in the package, with dots."""
    kind: str
    path: str
    name: str
    signature: str
    doc: str
    inside: list = field(default_factory=list)

    @property
    def described(self):
        return bool(self.doc.strip())


def is_public(name):
    return not name.startswith("_") or name == "__init__"


def is_property(node):
    return any("property" in ast.unparse(decorator) or "setter" in ast.unparse(decorator) for decorator in node.decorator_list)


def entity(node, path):
    doc = ast.get_docstring(node) or ""
    if isinstance(node, ast.ClassDef):
        inside = [entity(child, f"{path}.{node.name}") for child in node.body
                  if isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)) and is_public(child.name) and child.name != "__init__"]
        start = next((child for child in node.body if isinstance(child, ast.FunctionDef) and child.name == "__init__"), None)
        signature = f"({arguments(start)})" if start else ""
        if start and ast.get_docstring(start):
            doc = (doc + "\n\n" + ast.get_docstring(start)).strip()
        return Entity("class", path, node.name, signature, doc, inside)
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    if is_property(node):
        return Entity("attribute", path, node.name, "", doc)
    return Entity("method", path, node.name, f"({arguments(node)}){result}", doc)


def arguments(node):
    text = ast.unparse(node.args)
    return ", ".join(part for part in text.split(", ") if part not in ("self", "cls"))


def parsed(package):
    """{name: syntax tree} of the modules of a package."""
    base, found = os.path.join(ROOT, package), {}
    for name in sorted(os.listdir(base)):
        if name.endswith(".py"):
            with open(os.path.join(base, name), encoding="utf-8") as file:
                found[name.removesuffix(".py")] = ast.parse(file.read())
    return found


def listed(body):
    """The names of __all__, or None."""
    for node in body.body:
        if isinstance(node, ast.Assign) and any(isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets):
            return ast.literal_eval(node.value) if isinstance(node.value, (ast.List, ast.Tuple)) else None
    return None


def defined(body, names=None):
    """Public functions and classes of a module, limited to `names` if given."""
    return [node for node in body.body if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and is_public(node.name) and (names is None or node.name in names)]


def described(node, module):
    item = entity(node, module)
    return item if item.kind == "class" else Entity("function", item.path, item.name, item.signature, item.doc)


def of_package(trees, package, names):
    """The names of __all__ of a package: defined in it, or imported from its modules."""
    nodes = defined(trees["__init__"], names)
    for node in trees["__init__"].body:
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module in trees:
            nodes += defined(trees[node.module], [alias.name for alias in node.names if (alias.asname or alias.name) in names])
    return [described(node, package) for node in nodes]


def modules(package):
    """[(module, docstring, entities)] of a package. With an __all__, only the modules that it names are public."""
    trees, name = parsed(package), os.path.basename(package)
    names = listed(trees["__init__"])
    inside = [described(node, name) for node in defined(trees["__init__"])] if names is None else of_package(trees, name, names)
    found = [(name, ast.get_docstring(trees["__init__"]) or "", inside)]
    for module, body in trees.items():
        if not module.startswith("_") and (names is None or module in names):
            path = f"{name}.{module}"
            found.append((path, ast.get_docstring(body) or "", [described(node, path) for node in defined(body, listed(body))]))
    return found


def entities(package):
    """All public entities, flat."""
    return [found for _, _, inside in modules(package) for item in inside for found in [item] + item.inside]


class PythonPages:
    def __init__(self, names, calls, listings):
        self.names, self.calls, self.listings = names, calls, listings

    def entity(self, item):
        body = self.names.block(item.doc.split("\n"))
        example = self.calls.find(item.name) if item.kind != "attribute" else None
        body += example_lines(example, "python", self.listings) if example else []
        for child in item.inside:
            body += self.entity(child)
        return [f".. py:{item.kind}:: {item.name}{item.signature}", "", *indented(body), ""]

    def page(self, module, doc, inside):
        lines = heading(module) + self.names.block(doc.split("\n")) + [f".. py:module:: {module}", ""]
        return lines + [line for item in inside for line in self.entity(item)]


def stage(site, package, names, calls):
    pages = PythonPages(names, calls, site.places.listings)
    found = modules(package)
    for module, doc, inside in found:
        site.write(f"reference/python/{module}.rst", "\n".join(pages.page(module, doc, inside)) + "\n")
    lines = heading("Python") + [".. toctree::", "   :maxdepth: 2", ""] + [f"   {module}" for module, _, _ in found]
    site.write("reference/python/index.rst", "\n".join(lines) + "\n")
