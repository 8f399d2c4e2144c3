#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: The SLAMBench authors
#
# Runs scripts/install_dependencies with stand-ins for dpkg-query, apt-get and sudo.
set -euo pipefail

script="$(cd "$(dirname "$0")/../../scripts" && pwd)/install_dependencies"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
bin="$work/bin"
mkdir "$bin"
for tool in bash env sed awk grep dirname readlink; do ln -s "$(command -v $tool)" "$bin/$tool"; done

stand_in() { # NAME BODY
  printf '#!/bin/bash\n%s\n' "$2" >"$bin/$1"
  chmod +x "$bin/$1"
}
fail() {
  echo "FAILED: $1" >&2
  echo "--- output" >&2
  cat "$work/output" >&2
  exit 1
}
run() { # EXPECTED_STATUS ARGUMENTS...
  local expected=$1 status=0
  shift
  rm -f "$work/apt"
  WORK="$work" PATH="$bin" "$script" "$@" >"$work/output" 2>&1 || status=$?
  [[ $status == "$expected" ]] || fail "status $status, expected $expected"
}
says() { grep -qF -- "$1" "$work/output" || fail "'$1' is not in the output"; }
installs() { grep -qxF -- "$1" "$work/apt" || fail "apt-get was not called as: $1"; }

run 4
says "no apt here"
says "libeigen3-dev"

stand_in apt-get 'echo "$*" >>"$WORK/apt"; [[ ! -e "$WORK/broken" ]]'
stand_in dpkg-query 'echo -n installed'
run 0
says "all"
[[ ! -e "$work/apt" ]] || fail "apt-get was called although nothing was missing"

# Never heard of, removed, and installed for two architectures.
stand_in dpkg-query 'case "${*: -1}" in
  libfmt-dev) exit 1 ;;
  libspng-dev) echo -n config-files ;;
  *) echo -n installedinstalled ;;
esac'
run 1 --check
says "2 of"
[[ ! -e "$work/apt" ]] || fail "--check called apt-get"

stand_in sudo 'echo sudo >>"$WORK/apt"; exec "$@"'
run 0
installs "update --quiet"
installs "install --yes --quiet --no-install-recommends libfmt-dev libspng-dev"
if ((EUID == 0)) && grep -qx sudo "$work/apt"; then fail "root used sudo"; fi
if ((EUID != 0)) && ! grep -qx sudo "$work/apt"; then fail "sudo was not used"; fi

# Packages of another architecture only on request, and dpkg knows it before apt looks.
stand_in dpkg-query 'case "${*: -1}" in *:arm64) exit 1 ;; *) echo -n installed ;; esac'
stand_in dpkg 'echo "dpkg $*" >>"$WORK/apt"'
run 0 --check
run 1 aarch64 --check
says "libhwy-dev:arm64"
run 0 aarch64
[[ $(grep -v sudo "$work/apt" | head -n 2) == $'dpkg --add-architecture arm64\nupdate --quiet' ]] ||
  fail "arm64 was not added before the update"
grep -q '^install .* libhwy-dev:arm64' "$work/apt" || fail "the arm64 packages were not installed"
stand_in dpkg 'exit 1'
run 4 aarch64
says "could not add the architecture arm64"
stand_in dpkg-query 'case "${*: -1}" in libfmt-dev | libspng-dev) exit 1 ;; *) echo -n installed ;; esac'

touch "$work/broken"
run 4
says "could not be renewed"
says "could not install: libfmt-dev libspng-dev"
rm "$work/broken"

if ((EUID != 0)); then
  rm "$bin/sudo"
  run 4
  says "As root, run:"
fi

stand_in apt-get 'echo "$*" >>"$WORK/apt"'
stand_in dpkg-query '[[ ${*: -1} == chromium ]] || echo -n installed'
run 0
[[ ! -e "$work/apt" ]] || fail "the browser was installed unasked"
run 1 browser --check
says "chromium"

# An optional package that apt does not know is left out; one that is needed is asked for all the same.
stand_in dpkg-query 'case "${*: -1}" in libassimp-dev | libspng-dev) exit 1 ;; *) echo -n installed ;; esac'
stand_in apt-cache '[[ $2 != libassimp-dev && $2 != libspng-dev ]]'
run 0
says "does not have it: libassimp-dev"
installs "install --yes --quiet --no-install-recommends libspng-dev"
stand_in dpkg-query '[[ ${*: -1} == libassimp-dev ]] || echo -n installed'
run 0
if grep -q '^install' "$work/apt"; then fail "apt-get install was called for nothing"; fi
stand_in apt-cache 'exit 0'
run 0
installs "install --yes --quiet --no-install-recommends libassimp-dev"

run 2 --force
says "unknown argument '--force'"
