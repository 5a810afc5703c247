# SPDX-License-Identifier: BSD-3-Clause
"""Folders in which commands of pages run as pasted. `apt-get`, `sudo` and `ldconfig` change nothing outside, and `cmake` takes an existing build for
build/release."""
import os
import shutil
import subprocess
import sys

CMAKE = """#!/bin/sh
# The existing build is build/release.
case "$*" in
  "--preset release") exit 0 ;;
  "--build --preset release") exit 0 ;;
  "-S @CLONE@ -B @CLONE@/build/release"*) exit 0 ;;
  "--build @CLONE@/build/release"*) exit 0 ;;
  "--install build/release") exec "@REAL@" --install "@BUILD@" --prefix "@PREFIX@" ;;
  "--install build/release --prefix P") exec "@REAL@" --install "@BUILD@" --prefix "$PWD/P" ;;
esac
echo "a command of cmake that this test does not know: $*" >&2
exit 1
"""


class Sandbox:
    """A reader's machine. work: the folder, made anew. build: a build of source. prefix: where the build is, or will be, installed. The commands run in
    `folder`: an empty one, with the clone as ~/carreau."""

    def __init__(self, work, build, source, prefix):
        self.work, self.build, self.source, self.prefix = work, build, source, prefix
        self.home, self.bin, self.folder = (os.path.join(work, name) for name in ("home", "bin", "page"))
        shutil.rmtree(work, ignore_errors=True)
        for folder in (self.home, self.bin, self.folder):
            os.makedirs(folder)
        os.symlink(source, os.path.join(self.home, "carreau"))

    def shim(self, name, text):
        path = os.path.join(self.bin, name)
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)

    def environment(self):
        libraries = os.path.join(self.prefix, "lib")
        return os.environ | {"HOME": self.home, "PATH": self.bin + ":" + os.path.join(self.prefix, "bin") + ":" + os.environ["PATH"], "NO_COLOR": "1",
                             "PKG_CONFIG_PATH": os.path.join(libraries, "pkgconfig"), "LD_LIBRARY_PATH": libraries, "CMAKE_PREFIX_PATH": self.prefix,
                             "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}

    def run(self, script, check=True):
        """Returns the output of a script of bash; its status is 0 unless `check` is False."""
        done = subprocess.run(["bash", "-e", "-c", script], cwd=self.folder, env=self.environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=600)
        if check and done.returncode != 0:
            sys.exit(f"status {done.returncode} of\n{script}\n{done.stdout}")
        return done.stdout

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def size(self, name):
        """Size of a file in bytes; 0 if it is missing."""
        path = os.path.join(self.folder, name)
        return os.path.getsize(path) if os.path.exists(path) else 0


class Clone(Sandbox):
    """The folder is a clone, whose build can be installed."""

    def __init__(self, work, build, source):
        super().__init__(work, build, source, os.path.join(work, "usr local"))
        os.makedirs(os.path.join(self.folder, "build"))
        for name in os.listdir(source):
            if name not in ("build", "out", ".git"):
                os.symlink(os.path.join(source, name), os.path.join(self.folder, name))
        os.symlink(build, os.path.join(self.folder, "build/release"))
        cmake = CMAKE.replace("@CLONE@", self.folder).replace("@REAL@", shutil.which("cmake"))
        self.shim("cmake", cmake.replace("@BUILD@", build).replace("@PREFIX@", self.prefix))
        self.shim("sudo", '#!/bin/sh\nexec "$@"\n')
        for name in ("apt-get", "ldconfig", "ctest"):  # ctest: of tests/run.sh, which runs this test
            self.shim(name, "#!/bin/sh\nexit 0\n")
        self.shim("dpkg-query", "#!/bin/sh\nprintf installed\n")
