# Shared by studies/run and tests/run: packages and builds. Sourced with the project's folder as the current one.

# A|B: the first that the system has. A>=N: of at least this version. A?: where the system has it.
build_packages="g++ cmake ninja-build libboost-dev>=1.81|libboost1.[0-9][0-9]-dev>=1.81 libeigen3-dev libmpfr-dev
  libflint-dev libflint-dev>=3|libflint-arb-dev libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libmd4c-dev libjs-dygraphs gnuplot-nox python3-dev? pybind11-dev? python3-numpy? python3-mpmath?"
test_packages="libgtest-dev pkg-config doxygen python3 clang-tidy-14|clang-tidy clang-format-14? chromium?
  python3-pytest? python3-pandas? python3-matplotlib? python3-tqdm? python3-venv? python3-nbclient? python3-ipykernel?"
clang_packages="clang libclang-rt-dev"
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

# is_installed PACKAGE: NAME or NAME>=VERSION; the name may be a pattern.
is_installed() {
  local version
  for version in $(dpkg-query -W -f '${db:Status-Status}:${Version}\n' "${1%%>=*}" 2>/dev/null | sed -n 's/^installed://p'); do
    [ "${1%%>=*}" = "$1" ] || dpkg --compare-versions "$version" ge "${1##*>=}" || continue
    return 0
  done
  return 1
}

# candidate PACKAGE: the name of one that apt can install.
candidate() {
  local pattern="${1%%>=*}" name version
  for name in $(apt-cache pkgnames "${pattern%%\[*}" | sort -V); do
    [[ "$name" == $pattern ]] || continue
    version="$(LC_ALL=C apt-cache policy "$name" | sed -n 's/^ *Candidate: *//p')"
    [ -n "$version" ] && [ "$version" != "(none)" ] || continue
    [ "$pattern" = "$1" ] || dpkg --compare-versions "$version" ge "${1##*>=}" || continue
    echo "$name"
    return 0
  done
  return 1
}

# missing_of PACKAGE ...: what to install of those that are missing. Of one that apt does not have, the word itself.
missing_of() {
  local word one found
  local -a alternatives
  for word in "$@"; do
    IFS='|' read -ra alternatives <<<"${word%\?}"
    for one in "${alternatives[@]}"; do is_installed "$one" && continue 2; done
    found=""
    for one in "${alternatives[@]}"; do found="$(candidate "$one")" && break; done
    [ -z "$found" ] && [[ "$word" == *\? ]] || echo "${found:-$word}"
  done | sort -u
}

# Installs those of the named packages of Debian or Ubuntu that are missing.
need_packages() {
  local missing removed word sudo=""
  command -v apt-get >/dev/null || {
    echo "no apt-get here: CMake will say what is missing of $*" >&2
    return 0
  }
  [ -n "$(missing_of "$@")" ] || return 0
  [ "$(id -u)" = 0 ] || sudo="sudo"
  $sudo apt-get update -qq
  missing="$(missing_of "$@")"
  for word in $missing; do
    case "$word" in
      *[\>\|]*)
        echo "This system has no package $word. Debian 12 and 13 and Ubuntu 24.04 have one." >&2
        return 1
        ;;
    esac
  done
  echo "installing:" $missing
  # --no-remove: Boost 1.81 and the distribution's 1.74 exclude each other, and no other package may swap them.
  $sudo env LC_ALL=C DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes \
    apt-get install -y --no-remove --no-install-recommends $missing | show_installing || {
    removed=$(LC_ALL=C apt-get install -s --no-install-recommends $missing | awk '/^Remv / { printf " %s", $2 }')
    [ -z "$removed" ] || echo "These exclude packages of this machine, which stay until you remove them:" \
      "${sudo:+$sudo }apt-get remove$removed" >&2
    return 1
  }
}

# configure PRESET [CMAKE OPTION ...]; warnings are errors where the environment says so (tests/run --ci)
configure() {
  cmake --preset "$1" -DHBVM_WARNINGS_AS_ERRORS="${HBVM_WARNINGS_AS_ERRORS:-OFF}" "${@:2}" >/dev/null
  echo "building build/$1 (a first build takes some minutes)"
}

# build PRESET [CMAKE OPTION ...]
build() {
  configure "$@"
  cmake --build --preset "$1"
}
