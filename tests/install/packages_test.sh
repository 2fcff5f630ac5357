#!/usr/bin/env bash
# Which packages studies/setup.sh would install on systems that are told here: packages_test.sh SOURCE.
set -euo pipefail
command -v dpkg >/dev/null || { echo "skipped: there is no dpkg, which compares versions"; exit 77; }
. "$1/studies/setup.sh"

available="" installed="" # lines of name and version

apt-cache() {
  case "$1" in
    pkgnames) awk -v prefix="$2" 'index($1, prefix) == 1 { print $1 }' <<<"$available" ;;
    policy) awk -v name="$2" '$1 == name { print "  Candidate: " ($2 == "none" ? "(none)" : $2) }' <<<"$available" ;;
  esac
}
dpkg-query() {
  local pattern="${*: -1}" name version
  while read -r name version; do
    [[ -z "$name" || "$name" != $pattern ]] || echo "installed:$version"
  done <<<"$installed"
}

failed=0
# expect WHAT WANTED WORD ...: of these words, the packages that are wanted.
expect() {
  local got
  got="$(missing_of "${@:3}" | tr '\n' ' ')"
  [ "$got" = "${2:+$2 }" ] || { echo "$1: '$got' instead of '$2'"; failed=1; }
}

boost="libboost-dev>=1.81|libboost1.[0-9][0-9]-dev>=1.81"
arb="libflint-dev>=3|libflint-arb-dev"
[[ " $(echo $build_packages) " == *" $boost "* && " $(echo $build_packages) " == *" $arb "* ]] ||
  { echo "studies/setup.sh asks for Boost or Arb in other words"; failed=1; }

available="libboost-dev 1.74.0.3
libboost1.74-dev 1.74.0+ds1-21
libboost1.81-dev 1.81.0-5+deb12u1
libboost1.81-all-dev 1.81.0-5+deb12u1
libflint-dev 2.9.0-5
libflint-arb-dev 1:2.23.0-1+b1
clang-tidy 1:14.0-55
clang-tidy-14 1:14.0.6-12"
expect "Debian 12" "libboost1.81-dev libflint-arb-dev" "$boost" "$arb"
installed="libboost-dev 1.74.0.3"
expect "Debian 12 with its default Boost" "libboost1.81-dev" "$boost"
installed="libboost1.81-dev 1.81.0-5+deb12u1"
expect "Debian 12 with Boost 1.81" "" "$boost"
installed=""
expect "the first of two that are there" "clang-tidy-14" "clang-tidy-14|clang-tidy"
expect "a name is not the beginning of another" "clang-tidy" "clang-tidy"

available="libboost-dev 1.83.0.2+b2
libboost1.81-dev none
libboost1.83-dev 1.83.0-4.2
libboost1.88-dev 1.88.0-1
libflint-dev 3.1.3-2
libflint-arb-dev none
clang-tidy 1:19.0-63
chromium 156.0"
expect "Debian 13" "libboost-dev libflint-dev" "$boost" libflint-dev "$arb"
installed="libboost1.88-dev 1.88.0-1"
expect "Debian 13 with the newer Boost" "" "$boost"
installed=""
expect "the second where the first is not" "clang-tidy" "clang-tidy-14|clang-tidy"
expect "what need not be" "chromium" "chromium?" "clang-format-14?"

available="libboost-dev 1.74.0"
expect "what no package is" "$boost" "$boost" "chromium?"
exit "$failed"
