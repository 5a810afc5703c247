# SPDX-License-Identifier: BSD-3-Clause
# Sourced by run.sh scripts: installs Debian packages that are missing, with the rights to do so; else says what to type.

# need_packages PACKAGE...: status 1 when some are missing and could not be installed.
need_packages() {
  if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "This is not a Debian system: what these Debian packages hold is needed, and not installed from here:" >&2
    echo "  $*" >&2
    return 0
  fi
  missing=
  for package in "$@"; do
    state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) || state=
    [ "$state" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" = 0 ]; then
    as_root=
  elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
    as_root="sudo -n"
  else
    echo "Missing packages, and no right to install them. Type:" >&2
    echo "  sudo apt-get update && sudo apt-get install$missing" >&2
    return 1
  fi
  echo "Installing:$missing"
  # A mirror that does not answer is the usual cause of a failure: try once more.
  install_packages || { sleep 5 && install_packages; } || {
    echo "The installation failed. Type:" >&2
    echo "  ${as_root:+sudo }apt-get update && ${as_root:+sudo }apt-get install$missing" >&2
    return 1
  }
}

install_packages() {
  # Lists of words, on purpose unquoted.
  # shellcheck disable=SC2086
  $as_root apt-get update -qq -o DPkg::Lock::Timeout=120 >/dev/null &&
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o DPkg::Lock::Timeout=120 \
      --no-install-recommends $missing >/dev/null
}

# configure SOURCE BUILD OPTION...: quiet when it succeeds.
configure() {
  source_dir=$1 build_dir=$2
  shift 2
  mkdir -p "$build_dir"
  # On other systems make will do.
  if command -v ninja >/dev/null 2>&1; then set -- -G Ninja "$@"; fi
  cmake -S "$source_dir" -B "$build_dir" "$@" >"$build_dir/configure.log" 2>&1 || {
    cat "$build_dir/configure.log" >&2
    return 1
  }
}

# Number of processors.
processors() {
  nproc 2>/dev/null || echo 1
}
