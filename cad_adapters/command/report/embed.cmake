# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=... -DOUT=page_parts.cpp -P embed.cmake: the files of the page of a report as texts of the program.
# Scripts become one, in this order, inside one function; hashes let the page run and show these two and nothing else.
set(scripts decode camera colours clusters renderer controls viewer page main)

set(script "\n(() => {\n'use strict';\n")
foreach(name IN LISTS scripts)
  file(READ ${FOLDER}/${name}.js content)
  string(APPEND script "\n${content}")
endforeach()
string(APPEND script "})();\n")
file(READ ${FOLDER}/style.css style)
set(style "\n${style}")
file(READ ${FOLDER}/page.html page)
string(SHA256 script_hash "${script}")
string(SHA256 style_hash "${style}")

file(WRITE ${OUT}.new "// Made by embed.cmake of the files in report/viewer.
#include \"report/page_parts.h\"

namespace command::page_parts {

const char* const page = R\"~~(${page})~~\";
const char* const style = R\"~~(${style})~~\";
const char* const script = R\"~~(${script})~~\";
const char* const style_sha256 = \"${style_hash}\";
const char* const script_sha256 = \"${script_hash}\";

}  // namespace command::page_parts
")
file(RENAME ${OUT}.new ${OUT})
