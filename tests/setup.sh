# Sourced by run.sh scripts: installs Debian packages that are missing, with the rights to do so; else says what to type.
# Usage: . setup.sh; need_packages PACKAGE...

need_packages() {
  missing=
  if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "This is not a Debian system: these Debian packages, or what corresponds to them, are needed:" >&2
    echo "  $*" >&2
    return 0
  fi
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
    echo "  sudo apt-get install$missing" >&2
    return 1
  fi
  echo "Installing:$missing"
  export DEBIAN_FRONTEND=noninteractive
  # A list of packages that is out of date is the usual cause of a failure: renew it and try once more.
  # shellcheck disable=SC2086
  { $as_root apt-get update -qq && $as_root apt-get install -y -qq $missing; } >/dev/null ||
    { sleep 5; $as_root apt-get update -qq && $as_root apt-get install -y -qq $missing; } >/dev/null || {
    echo "The installation failed. Type:" >&2
    echo "  apt-get update && apt-get install$missing" >&2
    return 1
  }
}

jobs() {
  nproc 2>/dev/null || echo 1
}
