#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_imports.py PACKAGE: modules of the package import each other without circles, also inside functions and for types."""
import ast
import pathlib
import sys

from circles import circles


def imported(module, package):
    """Modules of the package that a module imports anywhere."""
    for node in ast.walk(ast.parse(module.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = [node.module.split(".")[0]] if node.module else [alias.name for alias in node.names]
            yield from (name for name in names if (package / f"{name}.py").is_file())


def main():
    package = pathlib.Path(sys.argv[1])
    graph = {module.stem: set(imported(module, package)) for module in sorted(package.glob("*.py"))}
    found = circles(graph)
    for group in found:
        print("modules that import each other in a circle: " + ", ".join(group))
    print(f"{len(graph)} modules, {len(found)} circles")
    return 1 if found or len(graph) < 2 else 0


if __name__ == "__main__":
    sys.exit(main())
