# Shared by studies/run and tests/run: packages and builds. Sourced with the project's folder as the current one.

build_packages="g++ cmake ninja-build libboost1.81-dev libeigen3-dev libmpfr-dev libflint-arb-dev
  libflint-dev libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev libjs-dygraphs gnuplot-nox"
test_packages="libgtest-dev pkg-config doxygen clang-format-14 clang-tidy-14 chromium"
clang_packages="clang libclang-rt-14-dev"
speed_packages="libbenchmark-dev"

# What apt-get says, in one line that grows on a terminal, and in a few elsewhere.
show_installing() {
  awk -v terminal="$([ -t 1 ] && echo yes)" '
    / newly installed/ { all = $3 }
    /^Get:/ { ++fetched }
    /^Setting up / { ++ready }
    /^(Get:|Setting up )/ {
      line = sprintf("  %d fetched, %d ready of %d packages", fetched, ready, all)
      if (terminal) printf "\r%s", line
      else if (++lines % 25 == 0) print line
      fflush()
    }
    END { if (line) print (terminal ? "\r" : "") line }'
}

# Installs those of the named Debian packages that are missing.
need_packages() {
  local missing="" package sudo=""
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  echo "installing:$missing"
  [ "$(id -u)" = 0 ] || sudo="sudo"
  $sudo apt-get update -qq
  # --no-remove: Boost 1.81 and the distribution's 1.74 exclude each other, and no other package may swap them.
  $sudo env DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes apt-get install -y --no-remove --no-install-recommends $missing |
    show_installing || {
    local removed
    removed=$(apt-get install -s --no-install-recommends $missing | awk '/^Remv / { printf " %s", $2 }')
    [ -z "$removed" ] || echo "These exclude packages of this machine, which stay until you remove them:" \
      "${sudo:+$sudo }apt-get remove$removed" >&2
    return 1
  }
}

# build PRESET [CMAKE OPTION ...]
build() {
  local preset="$1"
  shift
  cmake --preset "$preset" "$@" >/dev/null
  echo "building build/$preset (a first build takes some minutes)"
  cmake --build --preset "$preset"
}
