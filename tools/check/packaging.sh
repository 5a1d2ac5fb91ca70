# shellcheck shell=bash
# Sourced by tools/package and tools/check/package, which make and test what is published below build/package.

# shellcheck source=tools/check/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
package=$root/build/package
log=$package/log
mkdir -p "$package"

# quietly COMMAND...: shows the end of what it said only if it fails
quietly() {
  "$@" >>"$log" 2>&1 || { tail -20 "$log" >&2; fail "$(basename "$1") ${*:2:3} failed (build/package/log)"; }
}

# environment NAME PACKAGES...: a fresh one of Python, $package/NAME
environment() {
  quietly python3 -m venv --clear "$package/$1"
  quietly "$package/$1/bin/pip" install --quiet --disable-pip-version-check "${@:2}"
}
