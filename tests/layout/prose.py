# SPDX-License-Identifier: BSD-3-Clause
"""prose.py ROOT [--rates]: checks the English of comments and pages.

1. No sentence opens with What, Who, Whoever, Of, Where, Whether, By or Nor.
2. Comments of each group of folders, pages and manual pages use the patterns of PATTERNS at most 1.5 times as often, for 1000 words, as the model
   code bases do (pmp-library and geometry-central). --rates prints the rates.
3. Pages are short: BUDGETS."""
import os
import re
import sys

FOLDERS = ("cpp", "cabi", "cad_adapters", "tests", "fortran_examples", "docs", "cmake", "packaging")
COMMENTED = ("cpp", "cabi", "cad_adapters", "tests", "fortran_examples", "docs")
OPENING = re.compile(r"(What|Who|Whoever|Of|Where|Whether|By|Nor)\b")
FACTOR = 1.5
# Name, pattern in a sentence, occurrences in the models for 1000 words.
PATTERNS = [
    ("opens What/Who/Whoever", r"^(What|Who|Whoever|Whatever|Whose)\b(?!.*\?$)", 0.1),
    ("opens Of/Where/Whether/By/Nor/As", r"^(Of|Where|Whether|By|Nor|As long|As many|As few|No more)\b", 0.3),
    ("'what is' as a noun", r"(?<!^)\b[Ww]hat (is|are|was|has|have|it|they|he|this|these|to|of|stands|comes|lies|makes|others?|hosts?|a|an|the)\b", 0.2),
    ("tell, say, want, ask, refuse", r"\b(tells?|told|says?|said|wants?|wanted|asks?|asked|refuses?|refused|speaks?)\b", 0.7),
    ("those of, that of, another one", r"\b(those (of|that|which|who)|that of|that which|another one|the same (of|as|for)|the ones?|as such|of theirs|of its own|of before|of now)\b", 0.5),
    ("nobody, not without, none of", r"\b(nobody|not without|no one|none of|nothing of|is none|there is none|is no \w+'s)\b", 0.1),
]
BUDGETS = [("README.md", r"README\.md$", 7), ("docs/limits.md", r"docs/limits\.md$", 10), ("the pages of docs/", r"docs/.*\.md$", 130), ("all pages", r".*\.md$", 250)]  # KB of 1024 bytes
LONG = 28, 3.0  # words of a long sentence; long sentences of the models for 1000 words
OWN_LINE = {"c": r"^\s*(?:///?<?|//!|/?\*+)\s?(.*?)(?:\*/)?\s*$", "f": r"^\s*![>!<]?\s?(.*)$", "p": r"^\s*#\s?(.*)$"}
BEHIND = {"c": r"^.*?\S\s*///?<?\s(.*)$", "f": r"^.*\S\s*!\s(.*)$", "p": r"^(?!)$"}
KINDS = {".cpp": "c", ".h": "c", ".hpp": "c", ".c": "c", ".js": "c", ".f90": "f", ".py": "p", ".md": "m", ".1": "r"}


def page_blocks(text):
    """Paragraphs of a page without listings, tables, headings, pictures, code, targets of links and names such as **Source.**"""
    text = re.sub(r"```.*?```|~~~.*?~~~", "", text, flags=re.S)
    text = re.sub(r"^\s*\|.*$|^#+ .*$|!\[[^\]]*\]\([^)]*\)|\*\*\w+\.\*\*", "", text, flags=re.M)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "X", text))
    return [re.sub(r"^[#>*\-\s]+", "", block) for block in re.split(r"\n\s*\n|\n\s*[-*] ", text)]


def manual_blocks(text):
    return re.split(r"\n\.[A-Z]{2}.*", re.sub(r"\\f.|\\&", "", text).replace("\\-", "-"))


def comment_blocks(kind, text):
    """Comments of successive lines together, each comment behind code by itself."""
    blocks, block = [], []
    for line in text.split("\n"):
        own, behind = re.match(OWN_LINE[kind], line), re.match(BEHIND[kind], line)
        if own and own.group(1) and "SPDX" not in own.group(1) and "clang-format" not in own.group(1):
            block.append(own.group(1))
            continue
        blocks.append(" ".join(block))
        block = []
        if behind:
            blocks.append(behind.group(1))
    blocks.append(" ".join(block))
    return blocks + (re.findall(r'"""(.*?)"""', text, re.S) if kind == "p" else [])


def sentences(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    kind = KINDS[os.path.splitext(path)[1]]
    blocks = page_blocks(text) if kind == "m" else manual_blocks(text) if kind == "r" else comment_blocks(kind, text)
    for block in blocks:
        block = re.sub(r"\b(eq|sec|fig|no|e\.g|i\.e|cf|vs|resp)\. ", r"\1 ", re.sub(r"\s+", " ", block).strip())
        for sentence in re.split(r"(?<=[.!?:;])\s+(?=[A-Z`(])|(?<=[.!?])\s+", block):
            if len(sentence.split()) > 2:
                yield sentence


def files(root):
    """Paths from the root, folder by folder; builds and hidden folders are left out."""
    for top in ("", *FOLDERS):
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders[:] = sorted(n for n in folders if top and n not in ("build", "out", "__pycache__") and not n.startswith("."))
            for name in sorted(names):
                if os.path.splitext(name)[1] in KINDS:
                    yield os.path.relpath(os.path.join(folder, name), root)


def rates(root, paths):
    words, counts = 0, dict.fromkeys([name for name, _, _ in PATTERNS] + ["long sentences"], 0)
    for path in paths:
        for sentence in sentences(os.path.join(root, path)):
            length = len(sentence.split())
            words += length
            counts["long sentences"] += length > LONG[0]
            for name, pattern, _ in PATTERNS:
                counts[name] += len(re.findall(pattern, sentence))
    return {name: 1000 * count / max(words, 1) for name, count in counts.items()}


def too_many(root, print_them):
    models = {name: rate for name, _, rate in PATTERNS} | {"long sentences": LONG[1]}
    groups = {"pages": [p for p in files(root) if p.endswith(".md") and ("/" not in p or p.startswith("docs/"))],
              "manual pages": [p for p in files(root) if p.endswith(".1")],
              "READMEs of rooms": [p for p in files(root) if p.endswith("README.md") and "/" in p and not p.startswith("docs/")]}
    for top in COMMENTED:
        groups[f"comments of {top}"] = [p for p in files(root) if p.startswith(top + "/") and not p.endswith((".md", ".1"))]
    for group, paths in groups.items():
        for name, rate in rates(root, paths).items():
            if print_them:
                print(f"{group}: {name}: {rate:.2f}; {models[name]:g} in the models")
            if rate > FACTOR * models[name]:
                yield f"{group}: {name}: {rate:.2f} for 1000 words, {FACTOR * models[name]:g} at most"


def too_long(root):
    for name, pattern, limit in BUDGETS:
        size = sum(os.path.getsize(os.path.join(root, path)) for path in files(root) if re.match(pattern, path)) / 1024
        if size > limit:
            yield f"{name}: {size:.1f} KB, {limit} at most"


def openings(root):
    """Sentences with a forbidden opening."""
    for path in files(root):
        for sentence in sentences(os.path.join(root, path)):
            if OPENING.match(sentence) and not sentence.endswith("?"):
                yield f"{path}: {sentence[:120]}"


def main():
    root = sys.argv[1]
    sys.exit("\n".join([*openings(root), *too_many(root, "--rates" in sys.argv), *too_long(root)]) or 0)


if __name__ == "__main__":
    main()
