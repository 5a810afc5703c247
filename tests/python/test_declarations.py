# SPDX-License-Identifier: BSD-3-Clause
"""Declarations for ctypes agree with the headers and with the compiler."""
import ctypes
import glob
import os
import re
import subprocess
import sys

import pytest

from carreau import _declarations, _library, capi


@pytest.fixture(scope="module")
def headers(source):
    """All that a host may include."""
    sys.path.insert(0, os.path.join(source, "cabi/fortran"))
    from c_header import Header
    paths = sorted(glob.glob(os.path.join(source, "cabi/include/*.h"))) + [os.path.join(source, "cad_adapters/cad/include/carreau_cad.h")]
    assert len(paths) >= 5
    return [Header(path) for path in paths]


def test_the_modules_are_fresh(source):
    subprocess.run([sys.executable, os.path.join(source, "cabi/python/generate.py"), "--check"], check=True)


def test_every_exported_function_is_declared(source):
    for symbols, declared in (("cabi/abi/symbols.txt", _declarations.CARREAU), ("cad_adapters/cad/abi/symbols.txt", _declarations.CARREAU_CAD)):
        with open(os.path.join(source, symbols)) as file:
            exported = {line.strip() for line in file if line.startswith("carreau_")}
        assert exported == set(declared)


def test_the_library_has_them_all():
    for name in _declarations.CARREAU:
        assert hasattr(_library.lib(), name.removeprefix("carreau_")), name


def kind_of(declared):
    """A letter for how a value is passed: by ctypes."""
    plain = {ctypes.c_int32: "i", ctypes.c_int64: "l", ctypes.c_size_t: "z", ctypes.c_double: "d", None: "v"}
    return plain.get(declared, "p")


def kind_in_c(c_type):
    plain = {"int32_t": "i", "carreau_status": "i", "int64_t": "l", "size_t": "z", "double": "d", "void": "v"}
    return plain.get(c_type.replace("const ", ""), "p") if "*" not in c_type and "[" not in c_type else "p"


def test_types_of_arguments_and_results_agree_with_the_headers(headers):
    count = 0
    for header in headers:
        for name, (result, arguments) in header.functions.items():
            declared = {**_declarations.CARREAU, **_declarations.CARREAU_CAD}[name]
            expected = [kind_in_c(c_type) for c_type, _ in arguments]
            assert [kind_of(each) for each in declared[1]] == expected and kind_of(declared[0]) == kind_in_c(result), name
            for (c_type, argument), given in zip(arguments, declared[1]):
                element = re.sub(r"const |\*|\[\d*\]", "", c_type)
                if c_type.endswith("]"):
                    arrays = {"double": capi.Doubles, "int32_t": capi.Int32s, "int64_t": capi.Int64s, "char const": ctypes.POINTER(ctypes.c_char_p)}
                    assert given is arrays[element], (name, argument)
            count += 1
    assert count == len(_declarations.CARREAU) + len(_declarations.CARREAU_CAD)


def test_structs_lie_as_the_compiler_has_them(headers, source, tmp_path):
    lines, expected = [], []
    for header in headers:
        for struct, members in header.structs.items():
            made = getattr(_declarations, struct)
            lines.append(f'printf("%zu", sizeof(struct {struct}));')
            expected.append(ctypes.sizeof(made))
            for _, member in members:
                lines.append(f'printf(" %zu", offsetof(struct {struct}, {member}));')
                expected.append(getattr(made, member).offset)
            lines.append('printf(" ");')
    names = [os.path.basename(path) for path in glob.glob(os.path.join(source, "cabi/include/*.h"))] + ["carreau_cad.h", "stdio.h"]
    program = "".join(f"#include <{name}>\n" for name in names)
    (tmp_path / "sizes.c").write_text(program + "int main(void) {\n" + "\n".join(lines) + "\nreturn 0;\n}\n")
    folders = [f"-I{os.path.join(source, folder)}" for folder in ("cabi/include", "cad_adapters/cad/include")]
    subprocess.run(["cc", *folders, str(tmp_path / "sizes.c"), "-o", str(tmp_path / "sizes")], check=True)
    printed = subprocess.run([str(tmp_path / "sizes")], check=True, capture_output=True, text=True).stdout
    assert [int(word) for word in printed.split()] == expected


def test_constants_match_the_headers(headers):
    for header in headers:
        for name, value in header.constants.items():
            assert getattr(capi, name.removeprefix("CARREAU_")) == value


def test_there_is_one_version(source):
    import carreau
    with open(os.path.join(source, "cabi/python/pyproject.toml")) as file:
        assert re.search(r'^version = "(.*)"$', file.read(), re.MULTILINE).group(1) == carreau.__version__ == carreau.version()


def test_each_status_has_its_exception():
    from carreau.errors import BY_STATUS
    errors = {value for name, value in vars(_declarations).items() if re.fullmatch(r"ERR_\w+", name)}
    assert set(BY_STATUS) == errors and len(errors) == 12
