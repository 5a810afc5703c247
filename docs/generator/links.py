# SPDX-License-Identifier: BSD-3-Clause
"""The places of the files of the repository among the pages, and links of Markdown."""
import os
import re

LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^)\s]+)(\))")
FENCE = re.compile(r"^(```|~~~)")
IMAGES = (".png", ".svg")


class Places:
    """root: of the repository. headers, modules: paths of headers and modules with separate pages. listings: filled with the files that pages link to."""

    def __init__(self, root, headers, modules):
        self.root, self.listings = root, set()
        self.own = {path: f"reference/c/{os.path.basename(path).removesuffix('.h')}/index.rst" for path in headers}
        self.own.update({path: f"reference/fortran/{os.path.basename(path).removesuffix('.f90')}/index.rst" for path in modules})

    def page(self, path):
        """The staged file of a file of the repository, or None."""
        full = os.path.join(self.root, path)
        if os.path.isdir(full):
            return self.page(os.path.join(path, "README.md")) if os.path.exists(os.path.join(full, "README.md")) else None
        if not os.path.exists(full):
            return None
        if path in self.own:
            return self.own[path]
        if path.endswith(IMAGES):
            return path.removeprefix("docs/") if path.startswith("docs/") else path
        if path.startswith("docs/man/"):
            return "reference/command/" + os.path.basename(path) + ".rst"
        if path.endswith(".md"):
            return markdown_page(path)
        self.listings.add(path)
        return f"listings/{path}.rst"

    def rewritten(self, text, path):
        """The links of a page of Markdown as they are among the staged pages; code is left alone."""
        here, lines, fenced, toctree = os.path.dirname(markdown_page(path)), [], None, False

        def link(match):
            before, target, after = match.groups()
            if re.match(r"[a-z]+:|#", target):
                return match.group(0)
            file, hash_sign, anchor = target.partition("#")
            page = self.page(os.path.normpath(os.path.join(os.path.dirname(path), file)))
            if page is None:
                return match.group(0)  # Sphinx says that it leads nowhere
            shown = os.path.relpath(page, here or ".")
            return before + (shown if shown.endswith(".md") or shown.endswith(IMAGES) else shown.removesuffix(".rst")) + hash_sign + anchor + after

        for line in text.split("\n"):
            fence = FENCE.match(line)
            if fence and fenced is None:
                fenced, toctree = fence.group(1), "{toctree}" in line
                line = re.sub(r"^```layers.*", "```text", line).replace("```sh slow", "```sh")
            elif fence and fence.group(1) == fenced:
                fenced = None
            elif fenced is not None:
                entry = re.match(r"(.*<)?([^\s<]+\.md)(>?)$", line) if toctree else None
                if entry:
                    page = self.page(os.path.normpath(os.path.join(os.path.dirname(path), entry.group(2))))
                    line = (entry.group(1) or "") + os.path.relpath(page, here or ".") + entry.group(3)
            else:
                line = "`".join(part if i % 2 else LINK.sub(link, part) for i, part in enumerate(line.split("`"))) if "](" in line and not code_in_link(line) \
                    else LINK.sub(link, line)
            lines.append(line)
        return "\n".join(lines)


def code_in_link(line):
    return re.search(r"\[[^\]]*`[^\]]*\]\(", line)


def markdown_page(path):
    """docs/x.md: x.md; x/README.md: code/x.md; X.md: x.md."""
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    if path.endswith("/README.md"):
        return "code/" + path.removesuffix("/README.md") + ".md"
    return path.lower()
