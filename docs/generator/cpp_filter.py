#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""cpp_filter.py HEADER: prints the header for Doxygen. A function of the C++ interface without a comment does the work of the function of the
C interface that it calls. It gets a comment that refers there."""
import re
import sys

# The first line of a function: at the margin, or a member.
START = re.compile(r"^(?: {2})?(?! )(?!(?:return|if|for|struct|class|enum|using|namespace|template|static_assert|public|private|throw)\b)"
                   r"(?:\[\[nodiscard\]\] )?[\w:<>,&*~ \[\]]*?\b(\w+)\(")
CALL = re.compile(r"\bcarreau_[a-z0-9_]+\b(?=\(|\)|,)")


def body_from(lines, first):
    """The text of a function up to where its braces close, or to the semicolon of a declaration."""
    depth, text = 0, []
    for line in lines[first:]:
        text.append(line)
        depth += line.count("{") - line.count("}")
        if depth == 0 and line.rstrip().endswith(("}", ";", "};")):
            break
    return "\n".join(text)


def filtered(source):
    lines, out = source.split("\n"), []
    for i, line in enumerate(lines):
        before = next((each.strip() for each in reversed(lines[:i]) if each.strip() and not each.strip().startswith("template")), "")
        if START.match(line) and not before.startswith("///") and not line.strip().startswith(("//", "#", "}", ":")):
            called = CALL.search(body_from(lines, i))
            if called and called.group() not in ("carreau_status",):
                template = out.pop() if out and out[-1].strip().startswith("template") else None
                out.append(f"/// @verbatim embed:rst:inline As :c:func:`{called.group()}`. @endverbatim")
                if template is not None:
                    out.append(template)
        out.append(line)
    return "\n".join(out)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        sys.stdout.write(filtered(file.read()))
