#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""interface_test.py CARREAU MANUAL: help, manual pages and completion of shells agree on the sub-commands of CARREAU."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MANUAL = sys.argv[1:3]


def output(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=True, **options).stdout


def commands():
    """Names from the help of the program."""
    lines = output(PROGRAM, "--help").split("Subcommands:\n")[1].split("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines]


def options_of(command):
    """Spellings from the help of a sub-command."""
    names = set()
    for line in output(PROGRAM, command, "--help-all").splitlines():
        if re.match(r"  -", line):
            for word in line.split()[0].split(","):
                names.add(re.sub(r"\{.*\}", "", word))
    return names


def plain(roff):
    """Text of a manual page without fonts."""
    return re.sub(r"\\f.", "", roff).replace("\\-", "-").replace('"', "")


class Interface(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau shell ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def script(self, shell):
        path = os.path.join(self.folder, shell)
        with open(path, "w") as file:
            file.write(output(PROGRAM, "completion", shell))
        return path

    def test_each_command_has_a_page_that_the_main_page_names(self):
        self.assertEqual(commands(), ["mesh", "volume", "plane", "adapt", "refine", "info", "areas", "curve", "project", "check", "picture", "report", "fields", "params", "completion"])
        pages = {name for name in os.listdir(MANUAL) if name.startswith("carreau")}
        self.assertEqual(pages, {"carreau.1"} | {f"carreau-{name}.1" for name in commands()})
        with open(os.path.join(MANUAL, "carreau.1")) as file:
            named = re.findall(r"^\.BR carreau-(\w+) \(1\)$", plain(file.read()), re.M)
        self.assertEqual(named, commands())

    def test_pages_describe_the_options_that_help_shows_and_no_others(self):
        for command in commands():
            with self.subTest(command=command), open(os.path.join(MANUAL, f"carreau-{command}.1")) as file:
                section = plain(file.read()).split(".SH OPTIONS\n")[1].split(".SH ")[0]
                # The paragraph after .TP names the option.
                heads = " ".join(re.findall(r"^\.TP\n(.*)$", section, re.M))
                described = set(re.findall(r"(?<![\w-])(--?[a-z][a-z-]*)", heads))
                self.assertEqual(described, options_of(command))

    def test_short_help_has_twelve_options_and_names_the_rest(self):
        for command in ("mesh", "plane", "adapt", "fields"):
            lines = [line for line in output(PROGRAM, command, "--help").splitlines() if line.startswith("  -")]
            self.assertLessEqual(len(lines), 17, command)
            self.assertTrue(lines[-1].startswith("  --help-all"), command)
        lines = [line for line in output(PROGRAM, "mesh", "--help").splitlines() if line.startswith("  -")]
        self.assertEqual(len(lines), 12 + 1)

    def test_each_option_has_one_line_in_a_group(self):
        for command in commands():
            text = output(PROGRAM, command, "--help-all")
            groups = re.findall(r"^[A-Z][\w ]*:$", text, re.M)
            self.assertEqual(len(groups), len(set(groups)), command)
            self.assertNotIn("Options:", groups, command)
            for line in text.splitlines():
                if line.startswith("  -"):
                    self.assertRegex(line, r"^  -\S.*?  +[A-Za-z]\S*.*[^.]$", command)
                    self.assertLessEqual(len(line), 125, line)

    def test_pages_have_no_errors_of_roff(self):
        if shutil.which("groff") is None:
            self.skipTest("no groff")
        for name in sorted(os.listdir(MANUAL)):
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z", os.path.join(MANUAL, name)], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    def completed_by_bash(self, *words):
        """Completions of bash for the last of the words."""
        line = " ".join(f"'{word}'" for word in ("carreau", *words))
        program = (f"source '{self.script('bash')}'\ncompopt() {{ :; }}\nCOMP_WORDS=({line})\nCOMP_CWORD={len(words)}\n_carreau\n"
                   'printf "%s\\n" "${COMPREPLY[@]}"\n')
        return set(output("bash", "-c", program, cwd=self.folder).split("\n")[:-1]) - {""}

    def test_bash_completes_commands_options_values_and_files(self):
        self.assertEqual(self.completed_by_bash(""), set(commands()) | {"--help", "--version"})
        self.assertEqual(self.completed_by_bash("pic"), {"picture"})
        for command in commands():
            self.assertEqual(self.completed_by_bash(command, "-"), options_of(command))
        self.assertEqual(self.completed_by_bash("picture", "--color", ""), {"face", "reference", "quality", "size", "none"})
        self.assertEqual(self.completed_by_bash("picture", "a.mesh", "--view", "b"), {"back", "bottom"})
        self.assertEqual(self.completed_by_bash("completion", ""), {"bash", "zsh", "fish"})
        self.assertEqual(self.completed_by_bash("params", "hphyd"), {"hphydef"})
        self.assertEqual(self.completed_by_bash("mesh", "--set", "hphyd"), {"hphydef="})
        self.assertEqual(self.completed_by_bash("mesh", "--size", ""), set())
        for name in ("a part.step", "another.brep", "b.step"):
            open(os.path.join(self.folder, name), "w").close()
        self.assertEqual(self.completed_by_bash("mesh", "a"), {"a part.step", "another.brep"})
        self.assertEqual(self.completed_by_bash("mesh", "b.step", "-o", "an"), {"another.brep"})

    def test_zsh_and_fish_know_every_option(self):
        zsh, fish = (output(PROGRAM, "completion", shell) for shell in ("zsh", "fish"))
        self.assertTrue(zsh.startswith("#compdef carreau\n"))
        for command in commands():
            block = re.search(rf"^    {command}\)\n(.*?);;$", zsh, re.M | re.S)[1]
            self.assertEqual(set(re.findall(r"'\*(--?[a-z-]+)\[", block)), options_of(command))
            lines = [line for line in fish.splitlines() if f"__fish_seen_subcommand_from {command}'" in line]
            names = {"--" + name for line in lines for name in re.findall(r" -l (\S+)", line)}
            names |= {"-" + name for line in lines for name in re.findall(r" -s (\S+)", line)}
            self.assertEqual(names, options_of(command))

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_takes_the_script(self):
        output("zsh", "-n", self.script("zsh"))
        output("zsh", "-f", "-c", f"autoload -U compinit; compinit -u -D; source '{self.script('zsh')}'; [[ $_comps[carreau] == _carreau ]]")

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish_completes(self):
        def complete(line):
            text = output("fish", "--no-config", "-c", f"source '{self.script('fish')}'; complete -C '{line}'",
                          env=os.environ | {"HOME": self.folder})
            return {row.split("\t")[0] for row in text.splitlines()}
        self.assertTrue(set(commands()) <= complete("carreau "))
        self.assertEqual(complete("carreau picture --color "), {"face", "reference", "quality", "size", "none"})
        self.assertTrue({"--size-map", "--size"} <= complete("carreau mesh --siz"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
