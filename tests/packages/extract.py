#!/usr/bin/env python3
"""Writes the only fenced block of a language of a Markdown file to a file: extract.py README.md LANGUAGE OUT."""
import re
import sys

readme, language, out = sys.argv[1:]
blocks = re.findall(rf"^```{language}\n(.*?)^```", open(readme, encoding="utf-8").read(), re.S | re.M)
if len(blocks) != 1:
    sys.exit(f"{readme}: {len(blocks)} blocks of {language}, one is expected")
open(out, "w", encoding="utf-8").write(blocks[0])
