# SPDX-License-Identifier: BSD-3-Clause
"""The plain text of comments as reStructuredText: names become links, rows of columns become tables, errors a paragraph."""
import re
import textwrap

NAME = re.compile(r"`([^`]+)`|\b(\w+\.(?:h|md|f90|pardom|env))\b|\b((?:carreau|CARREAU)_\w*\w)(\.\.\.)?|(\*?\w*[a-z]_\w+)\b|\b([A-Z][A-Z_]{3,})\b")
COLUMNS = re.compile(r" {2,}")


def escaped(text):
    return re.sub(r"([\\*|`_])", r"\\\1", text)


class Names:
    """roles: {name: role}. statuses: what CARREAU_ERR_ has, without that."""

    def __init__(self, roles, statuses=()):
        self.roles, self.statuses = roles, set(statuses)

    def link(self, name, shown=None):
        role = self.roles.get(name)
        if role is None:
            return f"``{shown or name}``"
        return f":{role}:`{shown} <{name}>`" if shown else f":{role}:`{name}`"

    def inline(self, text):
        """One run of text."""
        parts, place = [], 0
        for match in NAME.finditer(text):
            quoted, file, name, dots, with_underscore, capitals = match.groups()
            if capitals and capitals not in self.statuses:
                continue
            parts.append(self._glued(escaped(text[place:match.start()]), parts))
            place = match.end()
            if quoted:
                new = self.link(quoted) if quoted in self.roles else f"``{quoted}``"
            elif name:
                new = f"``{name}{dots}``" if dots else self.link(name)
            elif capitals:
                new = self.link("CARREAU_" + ("" if capitals == "OK" else "ERR_") + capitals, capitals)
            else:
                new = f"``{file or with_underscore}``"
            parts.append(self._glued(new, parts))
        return "".join(parts) + self._glued(escaped(text[place:]), parts)

    @staticmethod
    def _glued(new, parts):
        """Markup needs a space or some punctuation on both sides: `\\ ` disappears in the page."""
        last = next((part for part in reversed(parts) if part), "")
        after_markup = last.endswith("`") and new and not re.match(r"[\s'\")\]}>\-/\\:.,;!?]", new)
        before_markup = re.match(r"[`:]\w*", new) and new.endswith("`") and last and not re.search(r"[\s'\"(\[{<\-/:]$", last)
        return "\\ " + new if after_markup or before_markup else new

    def table(self, lines):
        """Rows of columns, which two spaces or more separate; lines that are indented deeper go on."""
        base = min(len(line) - len(line.lstrip()) for line in lines)
        rows = []
        for line in lines:
            parts = COLUMNS.split(line.strip())
            deeper = len(line) - len(line.lstrip()) > base
            if not deeper:
                rows.append(parts)
            elif len(parts) > 1 and len(rows[-1]) > 2:
                rows.append([""] + parts)
            else:
                rows[-1][-1] += " " + " ".join(parts)
        width = max(len(row) for row in rows)
        if width < 2 or len(rows[0]) < 2:
            return ["::", ""] + ["   " + line for line in textwrap.dedent("\n".join(lines)).split("\n")] + [""]
        out = [".. list-table::", "   :class: columns", ""]
        for row in rows:
            row = row + [""] * (width - len(row))
            out += [("   * - " if i == 0 else "     - ") + (self.inline(cell) if i else f"``{cell}``" if cell else "") for i, cell in enumerate(row)]
        return out + [""]

    def paragraph(self, text):
        errors = re.search(r"(?:^|(?<=[.)\"] ))Errors?\b", text)
        if not errors or errors.start() == 0:
            return [self.inline(text), ""] if not errors else [self._errors(text), ""]
        return [self.inline(text[:errors.start()].strip()), "", self._errors(text[errors.start():]), ""]

    def _errors(self, text):
        head, colon, rest = text.partition(":")
        return f"**{head}**: {self.inline(rest.strip())}" if colon else self.inline(text)

    def block(self, lines):
        """The lines of a comment as reStructuredText."""
        out, flow, rows = [], [], []

        def flush():
            if flow:
                out.extend(self.paragraph(" ".join(" ".join(flow).split())))
            if rows:
                out.extend(self.table(rows))
            flow.clear(), rows.clear()

        for line in lines:
            if not line.strip():
                flush()
            elif line.startswith("  "):
                if flow:
                    flush()
                rows.append(line)
            else:
                if rows:
                    flush()
                flow.append(line)
        flush()
        return out


def indented(lines, by="   "):
    return [by + line if line else "" for line in lines]


def heading(title, line="="):
    return [title, line * max(3, len(title)), ""]


def summary(lines):
    """The first sentence of a comment, for tables."""
    flow = []
    for line in lines:
        if not line.strip() or line.startswith("  "):
            break
        flow.append(line)
    text = " ".join(" ".join(flow).split())
    end = re.search(r"[.:](?=\s+[A-Z*`\"])|[.:]$", text)
    text = text[:end.start()] + "." if end else text
    return "" if text.startswith("Error") else text
