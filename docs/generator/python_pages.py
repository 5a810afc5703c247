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
    return Entity("method" if path.count(".") else "function", path, node.name, f"({arguments(node)}){result}", doc)


def arguments(node):
    text = ast.unparse(node.args)
    return ", ".join(part for part in text.split(", ") if part not in ("self", "cls"))


def parsed(base, module):
    with open(os.path.join(base, module + ".py"), encoding="utf-8") as file:
        return ast.parse(file.read())


def listed(body):
    """The names of __all__."""
    return next(ast.literal_eval(node.value) for node in body.body if isinstance(node, ast.Assign) and
                any(isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets))


def modules(package):
    """[(module, docstring, entities)]: what the package's __all__ has, wherever it is defined, and the modules that it has, with what else is
    public in them."""
    base, name = os.path.join(ROOT, package), os.path.basename(package)
    whole = parsed(base, "__init__")
    exported, taken, rest = set(listed(whole)), [], []
    for module in sorted(file.removesuffix(".py") for file in os.listdir(base) if file.endswith(".py") and file != "__init__.py"):
        body, inside = parsed(base, module), []
        for node in body.body:
            if not isinstance(node, (ast.FunctionDef, ast.ClassDef)) or not is_public(node.name):
                continue
            if node.name in exported:
                taken.append(top(entity(node, name)))
            elif module in exported:
                inside.append(top(entity(node, f"{name}.{module}")))
        if inside:
            rest.append((f"{name}.{module}", ast.get_docstring(body) or "", inside))
    return [(name, ast.get_docstring(whole) or "", sorted(taken, key=lambda item: (item.kind == "class", item.name.lower())))] + rest


def top(item):
    """An entity that is no method, whatever dots its module has."""
    return item if item.kind == "class" else Entity("function", item.path, item.name, item.signature, item.doc)


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
