#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""fields_test.py CARREAU PARTIAL HOST...: `carreau fields` with geometries in shared libraries, C and Fortran: the same paraboloid.
The content of pixels is tested in tests/cpp/fields/fields_test.cpp."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PARTIAL, HOSTS = sys.argv[1], sys.argv[2], sys.argv[3:]  # PARTIAL: without surf0

FACE = "{0} 1 4  1 0 0 0  1 0 0 0  1 0 0 0  1 0 0 0  0\n"  # reference, orientation, four curves, no point


def attributes(path):
    """Headers of the parts of an EXR file: {name: value}, as the format's documentation describes them."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version = struct.unpack("<II", data[:8])
    assert magic == 20000630 and version & 0xff == 2
    at, parts = 8, []

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        word, at = data[at:end].decode(), end + 1
        return word

    while True:
        part = {}
        while name := text():
            kind = text()
            size, = struct.unpack("<I", data[at:at + 4])
            value, at = data[at + 4:at + 4 + size], at + 4 + size
            if kind == "int":
                value, = struct.unpack("<i", value)
            elif kind == "double":
                value, = struct.unpack("<d", value)
            elif kind == "string":
                value = value.decode()
            elif kind == "box2i":
                value = struct.unpack("<4i", value)
            elif kind == "chlist":  # names of 8 bytes and more, each with 16 bytes behind
                names = []
                while value[0]:
                    end = value.index(b"\0")
                    names.append(value[:end].decode())
                    value = value[end + 17:]
                value = names
            part[name] = value
        parts.append(part)
        if not version & 0x1000 or not data[at]:
            return parts


class Fields(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau fields ")
        self.pardom = self.write("x.pardom", "1\n" + FACE.format(1))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_fields(self, *arguments, host=HOSTS[0], code=0):
        done = subprocess.run([PROGRAM, "fields", *arguments, *(["--host", host] if host else [])], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_hosts_in_c_and_fortran_give_one_file_a_face(self):
        for host in HOSTS:
            with self.subTest(host=host):
                done = self.run_fields(self.pardom, "-o", "a.exr", "--pixels", "40x30", "--set", "hphydef=0.5", host=host)
                self.assertEqual((done.stdout, done.stderr), ("a.face.1.exr\n", ""))
                part, = attributes(self.path("a.face.1.exr"))
                self.assertEqual(part["dataWindow"], (0, 0, 39, 29))
                self.assertEqual(part["face"], 1)
                self.assertEqual(part["face.status"], "meshed")
                self.assertEqual(part["parameter.hphydef"], 0.5)
                self.assertGreater(part["triangle.count"], 100)
                self.assertIn("curvature.k1", part["channels"])
                self.assertEqual(len(part["channels"]), 35)

    def test_sizes_apart_have_channels_that_openexr_lists(self):
        self.run_fields(self.pardom, "-o", "a.exr", "--pixels", "20", "--multi-part", "--channels", "governs", "--angle", "8", "--size", "0.5")
        channels = ["geometric.angle", "geometric.h", "geometric.h1", "geometric.h2", "governs", "physical.angle", "physical.h", "physical.h1",
                    "physical.h2"]
        part, = attributes(self.path("a.exr"))
        self.assertEqual(part["channels"], channels)
        if not shutil.which("exrheader"):
            self.skipTest("no exrheader (Debian package openexr)")
        told = subprocess.run(["exrheader", self.path("a.exr")], capture_output=True, text=True, check=True).stdout
        for channel in channels:
            self.assertIn(f"    {channel}, " + ("32-bit unsigned integer" if channel == "governs" else "32-bit floating-point"), told)

    def test_an_env_file_is_run_and_then_shown(self):
        self.write("blsurf.env", "hphydef 0.5\ncall inimesh\npref mine\ncall export\ncall exit\n")
        done = self.run_fields("blsurf.env", "-o", "a.exr", "--pixels", "20", "--multi-part", "--channels", "mask,size")
        self.assertEqual(done.stdout, "a.exr\n")
        part, = attributes(self.path("a.exr"))
        self.assertEqual(part["channels"], ["mask", "size.angle", "size.h", "size.h1", "size.h2"])
        self.assertEqual(part["face.status"], "meshed")
        self.assertTrue(os.path.exists(self.path("mine.mesh")))

    def test_an_env_file_can_export_fields_itself(self):
        self.write("blsurf.env", "hphydef 0.5\ncall inimesh\nformat exr\ncall export\ncall exit\n")
        self.run_fields("blsurf.env", "-o", "a.exr", "--pixels", "8")
        part, = attributes(self.path("x.exr"))
        self.assertEqual(part["dataWindow"], (0, 0, 1023, 1023))

    def test_raw_needs_no_mesh(self):
        self.run_fields(self.pardom, "-o", "a.exr", "--pixels", "16", "--raw", "--face", "1", "--piz")
        part, = attributes(self.path("a.exr"))
        self.assertEqual((part["face.status"], part["dataWindow"]), ("not meshed", (0, 0, 15, 15)))

    def test_a_face_that_fails_is_shown_and_the_exit_code_is_1(self):
        self.write("two.pardom", "1\n" + FACE.format(2))
        done = self.run_fields("two.pardom", "-o", "a.exr", "--pixels", "20", code=1)
        self.assertIn("carreau: face 2, u = ", done.stderr)
        self.assertIn("pixels of the fields of face 2", done.stderr)
        part, = attributes(self.path("a.face.2.exr"))
        self.assertEqual(part["face.status"], "not meshed")

    def fails(self, *arguments, sentence, host=HOSTS[0]):
        before = sorted(os.listdir(self.folder))
        self.assertIn(sentence, self.run_fields(*arguments, host=host, code=2).stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_wrong_command_lines_and_files_give_a_sentence_and_exit_code_2(self):
        self.fails(self.pardom, "-o", "a.exr", host=self.path("no.so"), sentence="no.so' cannot be loaded")
        self.fails(self.pardom, "-o", "a.exr", host="libc.so.6", sentence="cannot be loaded")  # not the system's
        self.fails(self.pardom, "-o", "a.exr", host=self.pardom, sentence="cannot be loaded")
        self.fails(self.pardom, "-o", "a.exr", host=PARTIAL, sentence="lacks surf0, alone or in a Fortran module cad_m")
        self.fails(self.pardom, "-o", "a.tif", sentence="'a.tif' ends neither in .exr nor in .png")
        self.fails("x.step", "-o", "a.exr", sentence="--host goes with a .pardom or .env file, not with 'x.step'")
        self.fails("x.step", "-o", "a.exr", host="", sentence="x.step")
        self.fails(self.pardom, "-o", "a.exr", host="", sentence="--host names the shared library")
        self.fails("no.pardom", "-o", "a.exr", sentence="no.pardom")
        self.fails("no.env", "-o", "a.exr", sentence="no.env")
        self.fails("no.env", "-o", "a.exr", "--raw", sentence="--raw")
        self.fails("no.env", "-o", "a.exr", "--set", "hphydef=1", sentence="--set")
        self.fails(self.pardom, "-o", "a.exr", "--set", "hphydef", sentence="NAME=VALUE")
        self.fails(self.pardom, "-o", "a.exr", "--set", "hphydeff=1", sentence="did you mean 'hphydef'")
        self.fails(self.pardom, "-o", "a.exr", "--pixels", "0", sentence="'0' is neither")
        self.fails(self.pardom, "-o", "a.exr", "--pixels", "12x", sentence="'12x' is neither")
        self.fails(self.pardom, "-o", "a.exr", "--pixels", "99999", "--raw", sentence="from 1 to 65536")
        self.fails(self.pardom, "-o", "a.exr", "--channels", "colour", sentence="colour")
        self.fails(self.pardom, "-o", "a.exr", "--face", "7", "--raw", sentence="reference 7")
        self.fails(self.pardom, "-o", "a.exr", "--face", "2000000000", "--raw", sentence="reference 2000000000")
        self.fails(self.pardom, "-o", "none/a.exr", "--raw", sentence="No such file or directory")


unittest.main(argv=sys.argv[:1])
