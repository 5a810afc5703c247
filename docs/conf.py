# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx: the pages that docs/generator/stage.py has laid out. docs/build.sh runs both."""
import os
import re
import sys

docs = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(docs, "generator"))
with open(os.path.join(docs, "../CMakeLists.txt"), encoding="utf-8") as cmake:
    version = release = re.search(r"project\(carreau VERSION ([\d.]+)", cmake.read()).group(1)

project = "Carreau"
copyright = "the authors of Carreau, BSD-3-Clause"
extensions = ["myst_parser", "fortran_domain"]
if os.path.exists(os.path.join(docs, "../cabi/include/carreau.hpp")):
    extensions.append("breathe")  # build.sh sets the folder of Doxygen's XML
breathe_default_project = "carreau"
breathe_show_include = False
root_doc = "index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence"]
highlight_language = "none"
nitpick_ignore = [("c:identifier", name) for name in ("size_t", "int32_t", "int64_t")]
nitpick_ignore_regex = [("cpp:.*", ".*"), ("py:.*", ".*")]
# Listings of what people see printed, and blsurf.env, have no grammar.
suppress_warnings = ["misc.highlighting_failure"]

html_theme = "furo"
html_title = f"Carreau {release}"
html_static_path = []
html_css_files = []
html_show_sphinx = False
html_copy_source = False
pygments_style = "tango"
html_theme_options = {"navigation_with_keys": True, "light_css_variables": {"font-stack": "sans-serif", "font-stack--monospace": "monospace"},
                      "dark_css_variables": {"font-stack": "sans-serif", "font-stack--monospace": "monospace"}}
