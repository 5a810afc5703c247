#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# build.sh OUT [BUILDER]: makes the pages: OUT/html/index.html. A warning is an error, and so is an internal link that leads
# nowhere. It does not use the network, unless BUILDER is `linkcheck`, which tries the links to other sites.
# Debian: python3-sphinx python3-myst-parser furo groff-base, and for the C++ interface doxygen python3-breathe.
set -eu
docs=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
mkdir -p "$1"
out=$(CDPATH='' cd -- "$1" && pwd)
builder=${2:-html}
python3 "$docs/generator/stage.py" "$out/source"
set -- -b "$builder" -W --keep-going -n -q -c "$docs" -d "$out/doctrees"
if [ -d "$out/doxygen/xml" ]; then set -- "$@" -D "breathe_projects.carreau=$out/doxygen/xml"; fi
sphinx-build "$@" "$out/source" "$out/$builder"
echo "$out/$builder"
